#!/usr/bin/python3
"""The small binary bed at 24 mm/s with one thing of the particle model switched at a time: small_binary_effects.py PROGRAM RUNS [NAME ...]

NAME chooses what is switched, without it all are run: about a CPU minute each. A run that is done is not run again. Prints a table of
what is there.
"""
import argparse
from pathlib import Path

import numpy as np
from strips import finished, mean, run, table

import polybed.drawing.style

AT = "inlet.superficial_velocity=0.024"
SWITCHES = {
    "nothing": [],
    "seed 2": ["bed.seed=2"],
    "added mass, zuber": ['effects.added_mass="zuber"'],
    "drag, vbk_theory": ['effects.drag="vbk_theory"'],
    "no viscous stress": ['effects.fluid_stress="none"'],
    "lubrication, wet restitution": ['effects.lubrication="wet_restitution"'],
    # A film reaches 0.3 mm further than contacts: the depth has to hold two coarse diameters and that.
    "nothing, 12.8 mm deep": ['column.depth="12.8 mm"', "dem.skin=8e-5"],
    "film, 12.8 mm deep": ['column.depth="12.8 mm"', "dem.skin=8e-5", 'effects.lubrication="film"'],
}
TWO_FLUID = ("nothing", "drag, vbk_theory", "no viscous stress")  # what is switched there too


def row(name, model, read):
    history = read.history
    late = history["time_s"] >= 0.75 * history["time_s"][-1]
    height = 1e3 * history["bed_height_m"][late]
    fine, coarse = (1e3 * history[f"centre_{species}_m"][late] for species in read.species)
    drift = np.polyfit(history["time_s"][late], height, 1)[0]
    return [name, polybed.drawing.style.NAMES[model], mean(height, 2), f"{drift:+.2f}", mean(coarse - fine, 2),
            mean((coarse - fine) / height, 4), f"{read.record['cpu_s']:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("runs", type=Path)
    parser.add_argument("name", nargs="*", help="; ".join(SWITCHES))
    given = parser.parse_args()
    if unknown := set(given.name) - set(SWITCHES):
        parser.error(f"unknown: {unknown}")
    rows = []
    for name, settings in SWITCHES.items():
        for model in ("dem", "tfm") if name in TWO_FLUID else ("dem",):
            directory = given.runs / f"{name.replace(', ', '-').replace(' ', '-')}-{model}"
            if not given.name or name in given.name:
                run(given.program.resolve(), model, "small-binary", directory, [AT, *settings])
            if finished(directory):
                rows.append(row(name, model, polybed.read(directory)))
    table(["switched", "model", "bed height, mm", "its drift, mm/s", "coarse over fine, mm", "over the height", "CPU s"], rows)


if __name__ == "__main__":
    main()
