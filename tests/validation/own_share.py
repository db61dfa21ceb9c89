#!/usr/bin/python3
"""The small binary bed with and without a particle's own share in what it sees: own_share.py PROGRAM RUNS [-n STARTS]

Six velocities, three starts each, by particles with `dem.own_share` kept and removed and by the two-fluid model: some two CPU minutes a
run of particles. A run that is done is not run again, one that was stopped goes on. Prints means over the last 16 of 24 s and the
velocity at which the centres meet.
"""
import argparse
from pathlib import Path

import numpy as np
from strips import finished, run, table

import polybed

VELOCITIES = (24, 30, 33, 36, 39, 44)  # mm/s
NEAR = (30, 33, 36, 39)  # where the difference of the centres is about linear
MODELS = {"particles, kept": ("dem", ["dem.own_share=kept"]), "particles, removed": ("dem", ["dem.own_share=removed"]),
          "two-fluid": ("tfm", [])}
UNTIL, FROM = 24, 8  # s


def measured(directory):
    """Bed height in mm and coarse over fine over the height, means over the later part of a run."""
    read = polybed.read(directory)
    history = read.history
    late = history["time_s"] >= FROM
    fine, coarse = (history[f"centre_{species}_m"][late] for species in read.species)
    height = history["bed_height_m"][late]
    return 1e3 * np.mean(height), np.mean((coarse - fine) / height)


def spread(values, digits):
    """Mean and standard error over the starts."""
    error = np.std(values, ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.nan
    return f"{np.mean(values):.{digits}f} ± {error:.{digits}f}"


def crossings(found, name, starts):
    """Velocity at which a straight line through the differences of the centres is zero, one a start."""
    lines = [np.polyfit(NEAR, [found[name, u, seed][1] for u in NEAR], 1)
             for seed in starts if all((name, u, seed) in found for u in NEAR)]
    return [-line[1] / line[0] for line in lines]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("runs", type=Path)
    parser.add_argument("-n", "--starts", type=int, default=3)
    parser.add_argument("--read", action="store_true", help="run nothing, read what is there")
    given = parser.parse_args()
    starts = range(1, given.starts + 1)
    found = {}
    for seed in starts:
        for velocity in VELOCITIES:
            for name, (model, settings) in MODELS.items():
                directory = given.runs / f"{name.replace(', ', '-')}-{velocity}-{seed}"
                if not given.read:
                    keys = [f"inlet.superficial_velocity={velocity * 1e-3:g}", f"bed.seed={seed}", f"run.until={UNTIL}", *settings]
                    run(given.program.resolve(), model, "small-binary", directory, keys)
                if finished(directory):
                    found[name, velocity, seed] = measured(directory)
    rows = []
    for name in MODELS:
        for velocity in VELOCITIES:
            here = np.array([found[name, velocity, seed] for seed in starts if (name, velocity, seed) in found])
            if len(here):
                rows.append([name, f"{velocity}", f"{len(here)}", spread(here[:, 0], 1), spread(here[:, 1], 3)])
    table(["model", "mm/s", "starts", "bed height, mm", "coarse over fine, over the height"], rows)
    for name in MODELS:
        if at := crossings(found, name, starts):
            print(f"{name}: the centres meet at {spread(at, 2)} mm/s")


if __name__ == "__main__":
    main()
