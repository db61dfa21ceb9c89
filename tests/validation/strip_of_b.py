#!/usr/bin/python3
"""A strip of system B, one thing switched at a time, by both models: strip_of_b.py PROGRAM RUNS [NAME ...] [--model dem|tfm]

NAME, for instance base-30, chooses; without it all are run: half a CPU minute each by the two-fluid model, half a CPU hour by
particles. A run that is done is not run again, one that was stopped goes on. Prints a table of what is there.
"""
import argparse
from pathlib import Path

from strips import run, table
from thesis_systems import ALL, MODELS, STRIPS, row

import polybed

# As the thesis has it, and what each switch changes.
BASE = ["effects.fluid_stress=newtonian"]
SWITCHES = {
    "base": [],
    "no fluid stress": ["effects.fluid_stress=none"],
    "joined sides": ["column.sides=periodic"],
    "second order": ["tfm.momentum=conservative_limited"],
    "first order": ["tfm.momentum=conservative"],
    "own share removed": ["dem.own_share=removed"],
    "lift": ["effects.lift=saffman_mei"],
    "added mass": ["effects.added_mass=zuber"],
}
# Particles take second order by themselves, the two-fluid model first.
OF_MODEL = {"dem": ("base", "no fluid stress", "own share removed", "first order", "joined sides"),
            "tfm": ("base", "no fluid stress", "second order", "joined sides", "lift", "added mass")}
VELOCITIES = (30, 25, 35)  # mm/s
UNTIL = 60  # s


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("runs", type=Path)
    parser.add_argument("name", nargs="*")
    parser.add_argument("--model", choices=MODELS, action="append", help="by default both")
    parser.add_argument("--read", action="store_true", help="run nothing, read what is there, finished or not")
    given = parser.parse_args()
    rows = []
    for velocity in VELOCITIES:
        for model in given.model or MODELS:
            for switch in OF_MODEL[model]:
                name = f"{switch.replace(' ', '-')}-{velocity}"
                if given.name and name not in given.name:
                    continue
                directory = given.runs / f"{name}-{model}"
                keys = [*STRIPS["B"], *BASE, f"inlet.superficial_velocity={velocity * 1e-3:g}", f"run.until={UNTIL}", *SWITCHES[switch],
                        *(s for s in ALL if model == "dem" or not s.startswith("dem."))]
                if not given.read:
                    run(given.program.resolve(), model, "thesis-b", directory, keys)
                if (directory / "history.csv").exists():
                    rows.append([switch, *row("B", velocity, model, polybed.read(directory))[1:]])
    table(["switched", "mm/s", "model", "s", "bed height, mm", "its drift, mm/s", "centre of fine, mm", "centre of coarse, mm",
           "coarse over fine, mm", "over the height", "interface, mm (of the time)", "drop / weight", "CPU s"], rows)


if __name__ == "__main__":
    main()
