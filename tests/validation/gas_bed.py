#!/usr/bin/python3
"""The flat gas bed of van Wachem et al., one thing switched at a time: gas_bed.py PROGRAM RUNS [NAME ...]

NAME, for instance "no slip", chooses; without it all are run: minutes on cells of 5 mm, an hour on those of 2.5 mm. A run that is done is
not run again, one that was stopped goes on. Prints a table of what is there beside the measurements.
"""
import argparse
import sys
from pathlib import Path

from strips import ROOT, run, table

import polybed

sys.path.insert(0, str(ROOT / "cases" / "van-wachem"))
from fluctuations import cells_of, measured, simulated

BASE = ["column.size=[0.09,0.3]", "column.cells=[18,60]", "output.checkpoint_every=1"]
DEEP = ["column.size=[0.09,0.008,0.3]", "column.cells=[18,2,60]"]
SWITCHES = {
    "base": [],
    "restitution 0.8": ["dem.restitution=0.8"],
    "no slip of solids": ["tfm.solids_wall=no_slip"],
    "partial slip of solids": ["tfm.solids_wall=johnson_jackson"],
    "viscous stress of the gas": ["effects.fluid_stress=newtonian"],
    "momentum of second order": ["tfm.momentum=conservative_limited"],
    "drag, hkl": ["effects.drag=hkl"],
    "three dimensions": DEEP,
    "three dimensions, no slip of both": [*DEEP, "effects.fluid_stress=newtonian", "tfm.solids_wall=no_slip"],
    "three dimensions, partial slip": [*DEEP, "effects.fluid_stress=newtonian", "tfm.solids_wall=johnson_jackson"],
    "cells of 2.5 mm": ["column.cells=[36,120]"],
}
AFTER = 2  # s


def three_dimensional(runs):
    """Folder of the case without the depth that a two-dimensional one has."""
    folder = runs / "three-dimensional-case"
    folder.mkdir(parents=True, exist_ok=True)
    lines = (ROOT / "cases" / "van-wachem" / "case.toml").read_text().splitlines(keepends=True)
    (folder / "case.toml").write_text("".join(line for line in lines if not line.startswith("depth")))
    return folder


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("runs", type=Path)
    parser.add_argument("name", nargs="*", help="; ".join(SWITCHES))
    parser.add_argument("--read", action="store_true", help="run nothing, read what is there, finished or not")
    given = parser.parse_args()
    if unknown := set(given.name) - set(SWITCHES):
        parser.error(f"unknown: {unknown}")
    rows = [["measured", *cells_of(measured()), ""]]
    for name, settings in SWITCHES.items():
        directory = given.runs / name.replace(", ", "-").replace(" ", "-")
        if not given.read and (not given.name or name in given.name):
            case = three_dimensional(given.runs.resolve()) if DEEP[0] in settings else "van-wachem"
            run(given.program.resolve(), "tfm", case, directory, [*BASE, *settings])
        if (directory / "history.csv").exists():
            read = polybed.read(directory)
            if read.time[-1] < AFTER + 1:  # s: too short for any mean
                continue
            rows.append([name, *cells_of(simulated(read, AFTER)), f"{read.record.get('cpu_s', float('nan')):.0f}"])
    table(["switched", "s", "height, mm", "from, to", "Hz", "pressure's deviation, Pa", "from, to", "Hz", "by measures.md, mm", "CPU s"], rows)


if __name__ == "__main__":
    main()
