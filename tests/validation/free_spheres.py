#!/usr/bin/python3
"""Spheres that settle freely in resolved flow: free_spheres.py PROGRAM FOLDER [one_size | system_b]

one_size: hindered settling of beads of one size beside Richardson and Zaki's law (1954). system_b: fine and coarse of cases/matsuura-akehata at a
voidage of 0.87, free and held; the held species at the slip at which its drag bears its own weight. Prints the rows of the record.
Rows that are finished are kept: the same command goes on.
"""
import argparse
import csv
import subprocess
from pathlib import Path

import numpy as np
from inversion_from_rows import carrying
from strips import ROOT

GRAVITY = 9.81
LIQUID = {"density": 1000.0, "viscosity": 5e-3}
BEADS = {"diameter": 1.5e-3, "density": 1300.0}
CASE = """[column]
size = ["30 mm", "30 mm"]
cells = [4, 4]
[fluid]
name = "liquid"
density = {density}
viscosity = {viscosity}
[[species]]
name = "beads"
diameter = 1.5e-3
density = 1300.0
[bed]
volume_share = [1.0]
static_height = "12 mm"
solids_fraction = 0.6
[inlet]
superficial_velocity = "1 mm/s"
[effects]
others = "none"
drag = "richardson_zaki"
contact = "hertz_mindlin"
lubrication = "film"
[run]
until = "1 s"
"""


def rows(program, case, folder, *settings):
    """Those of polybed resolve, by name."""
    words = [word for setting in settings for word in ("--set", f"resolve.{setting}")]
    again = ["--resume"] if (folder / "boxes.csv").exists() else []
    done = subprocess.run([program, "resolve", case, "-o", folder, "--quiet", *again, *words], capture_output=True, text=True, check=True)
    return [{name: float(cell) for name, cell in row.items() if cell} for row in csv.DictReader(done.stdout.splitlines())]


def richardson_zaki(voidage):
    """Superficial velocity, m/s, and the Reynolds number of a bead alone (Schiller and Naumann)."""
    d, rho, mu = BEADS["diameter"], LIQUID["density"], LIQUID["viscosity"]
    stokes = d**2 * (BEADS["density"] - rho) * GRAVITY / (18 * mu)
    u = stokes
    for _ in range(100):
        u = stokes / (1 + 0.15 * (rho * u * d / mu) ** 0.687)
    re = rho * u * d / mu
    exponent = 4.65 if re < 0.2 else 4.35 * re**-0.03 if re < 1 else 4.45 * re**-0.1 if re < 500 else 2.39
    return u * voidage**exponent, re


def one_size(program, folder):
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / "beads.toml"
    case.write_text(CASE.format(**LIQUID))
    print("| voidage | Re | free, mm/s | Richardson and Zaki, mm/s | free over law |\n| --- | --- | --- | --- | --- |")
    for voidage in (0.95, 0.9, 0.8, 0.65):
        [row] = rows(program, case, folder / f"{voidage}", "motion=free", f"voidage=[{voidage}]", "cells_per_diameter=8", "grids=1",
                     "packings=2", "spheres=20")
        law, _ = richardson_zaki(voidage)
        u, error = row["u_1"], row["u_1_se"]
        print(f"| {voidage} | {row['Re']:.2f} | {1e3 * u:.1f} ± {1e3 * error:.1f} | {1e3 * law:.1f} | {u / law:.2f} ± {error / law:.2f} |")


def system_b(program, folder):
    common = ["voidage=[0.87]", "cells_per_diameter=8", "grids=1", "packings=2", "spheres=44"]
    case = ROOT / "cases/matsuura-akehata/case.toml"
    [free] = rows(program, case, folder / "free", "motion=free", 'until="0.6 s"', *common)
    held = rows(program, case, folder / "held", "reynolds=[20, 35]", *common)
    sauter = 1 / sum(free[f"x{j}"] / free[f"D{j}"] for j in (1, 2))
    reynolds = np.array([row["Re"] for row in held])
    at = [carrying(reynolds, np.array([row[f"n_{j}"] for row in held]), j - 1, sauter) for j in (1, 2)]
    print("| spheres | fine, mm/s | coarse, mm/s | coarse over fine |\n| --- | --- | --- | --- |")
    print(f"| held | {at[0]:.1f} | {at[1]:.1f} | {at[1] / at[0]:.2f} |")
    u, error = ([1e3 * free[f"u_{j}{end}"] for j in (1, 2)] for end in ("", "_se"))
    print(f"| free | {u[0]:.1f} ± {error[0]:.1f} | {u[1]:.1f} ± {error[1]:.1f} | {u[1] / u[0]:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("what", nargs="?", choices=("one_size", "system_b"))
    given = parser.parse_args()
    for name, table in (("one_size", one_size), ("system_b", system_b)):
        if given.what in (None, name):
            table(given.program, given.folder / name)


if __name__ == "__main__":
    main()
