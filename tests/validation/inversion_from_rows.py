#!/usr/bin/python3
"""What carries the species of system B by its own drag data: inversion_from_rows.py PROGRAM ROWS [-o PICTURE]

ROWS come from `polybed resolve` at the mixture of the case. No law is fitted: log n is linear in the Reynolds number between the rows.
A species of the uniform mixture is carried where n_j(voidage, Re) 3 pi mu d_j U is its buoyant weight. Prints that velocity for each species at each
voidage with the error of the packings; layers change places where both are equal. Draws them with drag laws beside.
"""
import argparse
import csv
import io
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import brentq
from strips import ROOT

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from polybed.drawing.style import COLOURS, STYLE

# cases/matsuura-akehata: water at 15 degC, fine and coarse.
FLUID_DENSITY, VISCOSITY, GRAVITY = 999.19, 1.14e-3, 9.81
DIAMETER, DENSITY = np.array([0.807e-3, 2.010e-3]), np.array([1395.0, 1170.0])
STOKES = DIAMETER**2 * (DENSITY - FLUID_DENSITY) * GRAVITY / (18 * VISCOSITY)  # m/s
EXPERIMENT = (0.87, 30)  # voidage, mm/s: Matsuura and Akehata (1985), thesis table 5-iii
LAWS = {"cello": "-", "brinkman_oseen": "--"}


def table(rows, name):
    """Values of a column over voidage and Reynolds number."""
    voidages, reynolds = (sorted({float(r[key]) for r in rows}) for key in ("eps", "Re"))
    at = {(float(r["eps"]), float(r["Re"])): float(r[name]) for r in rows}
    return np.array(voidages), np.array(reynolds), np.array([[at[e, re] for re in reynolds] for e in voidages])


def carrying(reynolds, n, species, sauter):
    """Superficial velocity at which a species is carried, mm/s. Beyond the Reynolds numbers n is that of the last."""
    def balance(u):
        return u * np.exp(np.interp(FLUID_DENSITY * u * sauter / VISCOSITY, reynolds, np.log(n))) - STOKES[species]
    return 1e3 * brentq(balance, 1e-5, 1)


def with_error(reynolds, n, error, species, sauter):
    """The velocity that carries a species, mm/s, and its error."""
    speed = carrying(reynolds, n, species, sauter)
    return speed, speed - carrying(reynolds, n + error, species, sauter)


def by_law(program, law, rows, voidages, reynolds):
    """n of both species by a law on a grid, for the mixture of the rows."""
    head = ["x1", "D1", "x2", "D2"]
    points = "eps,Re," + ",".join(head) + "\n" + "".join(
        f"{e},{re}," + ",".join(rows[0][key] for key in head) + "\n" for e in voidages for re in reynolds)
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.write(points)
        file.flush()
        answer = subprocess.run([program, "drag", "--law", law, "--csv", file.name], capture_output=True, text=True, check=True)
    found = list(csv.DictReader(io.StringIO(answer.stdout)))
    return [table(found, f"n_{j}")[2] for j in (1, 2)]


def draw(program, rows, voidages, reynolds, n, errors, sauter, path):
    fine = np.linspace(0.80, 0.95, 31)
    several = np.array([1, 5, 10, 15, 20, 30, 40, 60, 80.0])
    with plt.rc_context(STYLE):
        figure, panel = plt.subplots(figsize=(6.4, 4), dpi=130, layout="constrained")
        for law, line in LAWS.items():
            of_law = by_law(program, law, rows, fine, several)
            for j, name in enumerate(("fine", "coarse")):
                speeds = [carrying(several, row, j, sauter) for row in of_law[j]]
                panel.plot(fine, speeds, line, color=COLOURS[j], lw=1, label=f"{name}, {law}")
        for j, name in enumerate(("fine", "coarse")):
            speeds, bars = np.transpose([with_error(reynolds, *row, j, sauter) for row in zip(n[j], errors[j])])
            panel.errorbar(voidages, speeds, yerr=bars, fmt="o", color=COLOURS[j], capsize=3, label=f"{name}, resolved flow")
        panel.plot(*EXPERIMENT, "k*", ms=10, label="experiment: inversion")
        panel.set(xlabel="voidage", ylabel="velocity that carries a species (mm/s)")
        panel.legend(fontsize=7)
        figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("rows", type=Path)
    parser.add_argument("-o", "--output", type=Path, help="file of the picture")
    given = parser.parse_args()
    rows = list(csv.DictReader(line for line in given.rows.read_text().splitlines() if not line.startswith("#")))
    voidages, reynolds, _ = table(rows, "n_1")
    n = [table(rows, f"n_{j}")[2] for j in (1, 2)]
    errors = [table(rows, f"n_{j}_se")[2] for j in (1, 2)]
    sauter = 1 / sum(float(rows[0][f"x{j}"]) / float(rows[0][f"D{j}"]) for j in (1, 2))
    for k, voidage in enumerate(voidages):
        (fine, of_fine), (coarse, of_coarse) = (with_error(reynolds, n[j][k], errors[j][k], j, sauter) for j in (0, 1))
        print(f"voidage {voidage:g}: fine carried at {fine:.1f} ± {of_fine:.1f} mm/s, coarse at {coarse:.1f} ± {of_coarse:.1f}, "
              f"apart by {100 * (coarse / fine - 1):.0f} ± {100 * np.hypot(of_fine / fine, of_coarse / coarse):.0f} %")
    if given.output:
        draw(given.program.resolve(), rows, voidages, reynolds, n, errors, sauter, given.output)


if __name__ == "__main__":
    main()
