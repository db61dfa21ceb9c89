#!/usr/bin/python3
"""Bed height, pressure drop and bubbles of gas-fluidised beds, from stored fields, against published correlations.

    cases/taghipour/bubbles.py runs/gas-0.10 runs/gas-0.20 runs/gas-0.38 --after 2 -o bubbles.png

A bubble is a connected region of voidage above 0.8 (sides count, corners do not) that is not joined to the freeboard,
has at least six cells and does not touch the bottom. Its diameter is that of the circle of its area, its height that of its
centre. Two regions of successive fields are one bubble if each is the other's nearest, closer than half a diameter, and their
areas differ by less than 30 %; the rise of the centre is then its velocity. Fields 20 ms apart serve.
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

GRAVITY = 9.81
THRESHOLD = 0.8  # of voidage
LEAST_CELLS = 6


def darton(excess, height):
    """Bubble diameter, m, over a porous plate: 0.54 (U - u_mf)^0.4 h^0.8 g^-0.2. Darton et al. (Trans. Inst. Chem. Engrs. 55,
    1977, 274) with A_0 = 0. The paper is not held here; programs that cite it have 0.54 g^-0.2 (U - u_mf)^0.4 (h + 4 sqrt A_0)^0.8.
    """
    return 0.54 * excess**0.4 * height**0.8 * GRAVITY**-0.2


def davidson_harrison(diameter, excess):
    """Velocity of bubbles in a bubbling bed, m/s: U - u_mf + 0.711 sqrt(g d). Davidson and Harrison (1963), not held here:
    as worked examples of the bubbling-bed model have it.
    """
    return excess + 0.711 * np.sqrt(GRAVITY * diameter)


def regions(mask):
    """Numbers of the connected regions of a field, sides count, 0 outside of all."""
    labels, count = np.zeros(mask.shape, dtype=int), 0
    for start in zip(*np.nonzero(mask)):
        if labels[start]:
            continue
        count, ends = count + 1, [start]
        labels[start] = count
        while ends:
            j, i = ends.pop()
            for at in ((j - 1, i), (j + 1, i), (j, i - 1), (j, i + 1)):
                if 0 <= at[0] < mask.shape[0] and 0 <= at[1] < mask.shape[1] and mask[at] and not labels[at]:
                    labels[at] = count
                    ends.append(at)
    return labels, count


def bubbles_of(voidage, x, y):
    """Area, centre x and centre y of each bubble of one field [y][x]."""
    labels, count = regions(voidage > THRESHOLD)
    freeboard, bottom = set(np.unique(labels[-1])), set(np.unique(labels[0]))
    cell = (x[1] - x[0]) * (y[1] - y[0])
    found = []
    for n in range(1, count + 1):
        rows, columns = np.nonzero(labels == n)
        if n not in freeboard | bottom and len(rows) >= LEAST_CELLS:
            found.append((len(rows) * cell, x[columns].mean(), y[rows].mean()))
    return np.array(found).reshape(-1, 3)


def nearest(points, others):
    return np.argmin(np.linalg.norm(points[:, None, 1:] - others[None, :, 1:], axis=2), axis=1)


def followed(before, after, seconds):
    """Diameter, height and rise velocity of bubbles found in both fields."""
    if not len(before) or not len(after):
        return []
    forward, backward, rows = nearest(before, after), nearest(after, before), []
    for n, m in enumerate(forward):
        diameter = np.sqrt(4 * before[n, 0] / np.pi)
        shift = np.linalg.norm(after[m, 1:] - before[n, 1:])
        if backward[m] == n and shift < 0.5 * diameter and abs(after[m, 0] / before[n, 0] - 1) < 0.3:
            rows.append((diameter, before[n, 2], (after[m, 2] - before[n, 2]) / seconds))
    return rows


def bubbles_in(run, after_s):
    """Rows of (diameter, height, velocity) over all stored fields after a time."""
    centres = {axis: 0.5 * (run.faces[axis][1:] + run.faces[axis][:-1]) for axis in "xy"}
    rows, previous = [], None
    for step in np.nonzero(run.time >= after_s)[0]:
        current = bubbles_of(run.voidage[int(step)], centres["x"], centres["y"])
        if previous is not None:
            rows += followed(previous, current, run.time[step] - run.time[step - 1])
        previous = current
    return np.array(rows).reshape(-1, 3)


def velocity_of(run):
    for line in run.record["case"].split("\n"):
        if line.startswith("superficial_velocity"):
            return float(line.replace("]", " ").replace("=", ",").split(",")[-1])
    raise SystemExit(f"{run.directory}: no superficial velocity in its case")


def spread(values, digits):
    return f"{np.mean(values):.{digits}f} ± {np.std(values):.{digits}f}"


def print_row(run, rows, arguments):
    history, velocity = run.history, velocity_of(run)
    late = history["time_s"] >= arguments.after
    cells = [f"{velocity:g}", f"{arguments.after:g} to {history['time_s'][-1]:g}", spread(history["pressure_drop_Pa"][late], 0),
             f"{np.mean(history['buoyant_weight_Pa'][late]):.0f}", spread(history["bed_height_m"][late] * 1e3, 0),
             spread(history["bed_height_m"][late] / history["bed_height_m"][0], 2)]
    excess = velocity - arguments.umf
    if len(rows) and excess > 0:
        diameter, height, rise = rows.T
        cells += [f"{len(rows)}", spread(diameter * 1e3, 0), f"{np.mean(darton(excess, height)) * 1e3:.0f}", spread(rise, 2),
                  f"{np.mean(davidson_harrison(diameter, excess)):.2f}", f"{np.mean(rise / np.sqrt(GRAVITY * diameter)):.2f}"]
    else:
        cells += ["0", *["-"] * 5]
    cells.append(f"{run.record['cpu_s']:.0f}")
    print("| " + " | ".join(cells) + " |")


def draw(results, arguments):
    figure, panels = plt.subplots(1, 2, figsize=(9, 4), dpi=110, layout="constrained")
    for n, (run, rows) in enumerate(results):
        if not len(rows):
            continue
        excess, label = velocity_of(run) - arguments.umf, f"{velocity_of(run):g} m/s"
        heights = np.linspace(0.01, 1.05 * rows[:, 1].max(), 50)
        diameters = np.linspace(0.02, 1.05 * rows[:, 0].max(), 50)
        panels[0].plot(rows[:, 1] * 1e3, rows[:, 0] * 1e3, ".", color=f"C{n}", ms=3, alpha=0.5, label=label)
        panels[0].plot(heights * 1e3, darton(excess, heights) * 1e3, color=f"C{n}")
        panels[1].plot(rows[:, 0] * 1e3, rows[:, 2], ".", color=f"C{n}", ms=3, alpha=0.5)
        panels[1].plot(diameters * 1e3, davidson_harrison(diameters, excess), color=f"C{n}")
    panels[0].set(xlabel="height of centre (mm)", ylabel="diameter (mm)", title="lines: Darton et al. (1977)")
    panels[1].set(xlabel="diameter (mm)", ylabel="rise velocity (m/s)", title="lines: Davidson and Harrison (1963)")
    panels[0].legend(fontsize=8)
    figure.savefig(arguments.output)
    print(f"drawn: {arguments.output}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", nargs="+", help="run directory")
    parser.add_argument("--after", type=float, default=2.0, help="start of the means, s")
    parser.add_argument("--umf", type=float, default=0.065, help="u_mf, m/s; default: measured by Taghipour et al.")
    parser.add_argument("-o", "--output", help="file of the picture")
    arguments = parser.parse_args()
    heads = ["m/s", "mean over, s", "pressure drop, Pa", "buoyant weight, Pa", "bed height, mm", "over static height",
             "bubbles followed", "diameter, mm", "Darton, mm", "rise, m/s", "Davidson-Harrison, m/s", "rise over sqrt(g d)",
             "CPU s"]
    for line in (heads, ["---:"] * len(heads)):
        print("| " + " | ".join(line) + " |")
    results = [(run, bubbles_in(run, arguments.after)) for run in map(polybed.read, arguments.run)]
    for run, rows in results:
        print_row(run, rows, arguments)
    if arguments.output:
        draw(results, arguments)
