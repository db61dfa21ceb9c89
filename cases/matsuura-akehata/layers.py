#!/usr/bin/python3
"""Which species lies on top, from runs at several velocities: a table on the screen, a picture if asked for.

    cases/matsuura-akehata/layers.py runs/B-20 runs/B-30 runs/B-37 -o layers.png

Means and their spread are taken over the last quarter of each run.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
import polybed
from polybed.drawing.style import COLOURS, STYLE


def last_quarter(time):
    return time >= 0.75 * time[-1]


def velocity_of(run):
    """Superficial velocity at the end, m/s, from the case that the run keeps."""
    for line in run.record["case"].split("\n"):
        if line.startswith("superficial_velocity"):
            return float(line.replace("]", " ").split(",")[-1])
    raise SystemExit(f"{run.directory}: no superficial velocity in its case")


def row(run):
    """One line of the table: means over the last quarter, mm, +- one standard deviation in time."""
    history, late = run.history, last_quarter(run.history["time_s"])
    cells = [f"{velocity_of(run) * 1e3:g}", f"{history['time_s'][-1]:g}"]
    columns = ["bed_height_m"] + [f"centre_{name}_m" for name in run.species]
    for values in (history[c][late] * 1e3 for c in columns):
        cells.append(f"{np.nanmean(values):.0f} ± {np.nanstd(values):.0f}")
    centres = [np.nanmean(history[c][late]) for c in columns[1:]]
    cells.append(f"{run.species[int(np.argmax(centres))]}, by {(max(centres) - min(centres)) * 1e3:.0f}")
    cells.append(f"{np.nanmean(history['mixing'][late]):.2f}")
    cells.append(f"{run.record['cpu_s']:.0f}")
    return cells


def print_table(runs):
    head = ["mm/s", "s", "bed height, mm", *(f"centre of {n}, mm" for n in runs[0].species), "on top, mm", "mixing", "CPU s"]
    rows = [row(run) for run in runs]
    for cells in (head, ["---:"] * len(head), *rows):
        print("| " + " | ".join(cells) + " |")


def draw(runs, path):
    """Centres in time above, mean profiles of the last quarter below, one column for each velocity."""
    with plt.rc_context(STYLE):
        figure, panels = plt.subplots(2, len(runs), figsize=(3.1 * len(runs), 6.2), dpi=160, squeeze=False,
                                      layout="constrained")
        for run, (above, below) in zip(runs, panels.T):
            for name, colour in zip(run.species, COLOURS):
                above.plot(run.history["time_s"], run.history[f"centre_{name}_m"] * 1e3, color=colour, label=name)
                late = last_quarter(run.profiles["time_s"])
                below.plot(run.profiles[f"phi_{name}"][late].mean(axis=0), run.profiles["y_m"] * 1e3, color=colour)
            above.plot(run.history["time_s"], run.history["bed_height_m"] * 1e3, color="#999999", lw=0.8, label="bed height")
            above.set(title=f"{velocity_of(run) * 1e3:g} mm/s", xlabel="time (s)", ylim=(0, None))
            below.set(xlabel="volume fraction", xlim=(0, None), ylim=(0, 1.2e3 * np.nanmax(run.history["bed_height_m"])))
        panels[0, 0].set_ylabel("centre of volume (mm)")
        panels[1, 0].set_ylabel("height (mm), last quarter")
        panels[0, 0].legend(loc="best", fontsize=8)
        figure.savefig(path)
    print(f"drawn: {path}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", nargs="+", help="run directory")
    parser.add_argument("-o", "--output", help="file of the picture")
    arguments = parser.parse_args()
    runs = [polybed.read(directory) for directory in arguments.run]
    print_table(runs)
    if arguments.output:
        draw(runs, arguments.output)
