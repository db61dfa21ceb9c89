#!/usr/bin/python3
"""Spheres that settle freely in resolved flow: free_spheres.py PROGRAM FOLDER [TABLE] [--voidage ...] [--boxes N] [--spheres N] [--until S]

one_size: hindered settling of beads of one size beside Richardson and Zaki's law (1954), resolved settling of Yin and Koch (2007) and a law of
held spheres. box: more and more beads in a box, with the limit of a large one. grid, viscous: finer cells, a more viscous liquid. relative: forces
by relative motion on finer and finer grids. inertia: the same above Stokes flow. system_b: fine and coarse of cases/matsuura-akehata, free and held; the held species at the slip at
which its drag bears its own weight; then the same boxes over half of the time, and the first of them on a finer grid. mixtures: two sizes of one
density. Prints the rows of the record; s is the time on the clock of all boxes of a row. Boxes that are finished are kept: the same command goes
on, more --boxes add to them.
"""
import argparse
import csv
import inspect
import json
import subprocess
from pathlib import Path

import numpy as np
from inversion_from_rows import with_error
from scipy.optimize import brentq
from strips import ROOT

GRAVITY = 9.81
LIQUID = {"density": 1000.0, "viscosity": 5e-3}
# Re alone, prefactor and exponent of k (1 - phi)^n, Yin and Koch, Phys. Fluids 19 (2007) 093302, as quoted in the scripts of Willen and
# Prosperetti's group (errors of k 0.02 to 0.06, of n 0.1 to 0.3).
YIN_KOCH = np.array([[1.02, 0.92, 4.2], [1.83, 0.90, 4.1], [5.00, 0.86, 4.0], [9.98, 0.86, 3.8], [20.0, 0.88, 3.6]])
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


FILM = ['effects.lubrication="film"']
HELD_RE = {0.87: (20, 35), 0.8: (12, 24)}  # rows around the velocities that carry fine and coarse of system B
HELD = "vbk_theory"  # of one size: Beetstra, van der Hoef and Kuipers (2007)
UNTIL = {0.95: '"2 s"', 0.8: '"2 s"'}  # half of the default: means over more spheres need less time
TWO = """[[species]]
name = "coarse"
diameter = {coarse}
density = 1300.0
[bed]
volume_share = [{fine}, {share}]"""


def rows(program, case, folder, *settings, effects=()):
    """Those of polybed resolve, by name, and the seconds on the clock of all their boxes."""
    words = [word for setting in [f"resolve.{name}" for name in settings] + list(effects) for word in ("--set", setting)]
    again = ["--resume"] if (folder / "boxes.csv").exists() else []
    done = subprocess.run([program, "resolve", case, "-o", folder, "--quiet", *again, *words], stdout=subprocess.PIPE, text=True, check=True)
    seconds = sum(float(line.split(",")[6]) for line in (folder / "boxes.csv").read_text().splitlines()[1:])
    return [{**{name: float(cell) for name, cell in row.items() if cell}, "seconds": seconds} for row in csv.DictReader(done.stdout.splitlines())]


def alone(viscosity):
    """Stokes velocity, velocity (Schiller and Naumann), m/s, and Reynolds number of a bead alone."""
    d, rho = BEADS["diameter"], LIQUID["density"]
    u = stokes = d**2 * (BEADS["density"] - rho) * GRAVITY / (18 * viscosity)
    for _ in range(200):
        u = stokes / (1 + 0.15 * (rho * u * d / viscosity) ** 0.687)
    return stokes, u, rho * u * d / viscosity


def richardson_zaki(voidage, viscosity=LIQUID["viscosity"]):
    """Superficial velocity, m/s."""
    _, u, re = alone(viscosity)
    exponent = 4.65 if re < 0.2 else 4.35 * re**-0.03 if re < 1 else 4.45 * re**-0.1 if re < 500 else 2.39
    return u * voidage**exponent


def yin_koch(voidage):
    """The same from resolved settling, between the Reynolds numbers of its table."""
    _, u, re = alone(LIQUID["viscosity"])
    k, n = (np.interp(np.log(re), np.log(YIN_KOCH[:, 0]), YIN_KOCH[:, column]) for column in (1, 2))
    return k * u * voidage**n


def held(program, voidage):
    """The superficial velocity at which a law of held spheres bears the weight, m/s."""
    stokes, u, _ = alone(LIQUID["viscosity"])

    def lacks(slip):
        re = LIQUID["density"] * slip * BEADS["diameter"] / LIQUID["viscosity"]
        words = [program, "drag", "--law", HELD, "--voidage", str(voidage), "--re", str(re), "--json"]
        return json.loads(subprocess.run(words, capture_output=True, text=True, check=True).stdout)["n"] * slip - stokes
    return brentq(lacks, 1e-3 * u, u, xtol=1e-4 * u)


def settled(program, folder, voidage, spheres, packings, *settings, viscosity=LIQUID["viscosity"], cells=8):
    """The row of boxes of beads."""
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / f"beads-{viscosity}.toml"
    case.write_text(CASE.format(density=LIQUID["density"], viscosity=viscosity))
    [row] = rows(program, case, folder / f"{voidage}-{spheres}-{cells}-{viscosity}", "motion=free", f"voidage=[{voidage}]",
                 f"cells_per_diameter={cells}", "grids=1", f"packings={packings}", f"spheres={spheres}", *settings)
    return row


def of_law(row, law):
    return f"{row['u_1'] / law:.3f} ± {row['u_1_se'] / law:.3f}"


def one_size(program, folder, voidages=(0.95, 0.9, 0.8, 0.65), boxes=4):
    print("| voidage | Re | free, mm/s | Richardson and Zaki | free over it | Yin and Koch over it | held law over it | s |\n" + "| --- " * 8 + "|")
    for voidage in voidages:
        row = settled(program, folder, voidage, 40, boxes)
        law = richardson_zaki(voidage)
        print(f"| {voidage} | {row['Re']:.1f} | {1e3 * row['u_1']:.1f} ± {1e3 * row['u_1_se']:.1f} | {1e3 * law:.1f} | {of_law(row, law)} | "
              f"{yin_koch(voidage) / law:.3f} | {held(program, voidage) / law:.3f} | {row['seconds']:.0f} |", flush=True)


def box(program, folder):
    """The limit is that of a line in (phi/N)^(1/3)."""
    for voidage in (0.95, 0.8):
        law = richardson_zaki(voidage)
        print(f"voidage {voidage}\n| spheres | diameters wide | boxes | free over Richardson and Zaki |\n| --- | --- | --- | --- |")
        points = []
        for spheres, packings in ((20, 4), (40, 3), (80, 2), (160, 2)):
            row = settled(program, folder, voidage, spheres, packings, *(["until=%s" % UNTIL[voidage]] if spheres > 40 else []))
            wide = (np.pi / 6 * spheres / (1 - voidage)) ** (1 / 3)
            points.append([1 / wide, row["u_1"] / law, row["u_1_se"] / law])
            print(f"| {spheres} | {wide:.1f} | {packings} | {of_law(row, law)} |")
        place, ratio, error = np.transpose(points)
        (slope, limit), cov = np.polyfit(place, ratio, 1, w=1 / np.maximum(error, 0.01), cov="unscaled")
        stokes, u, _ = alone(LIQUID["viscosity"])
        print(f"limit {limit:.3f} ± {cov[1, 1] ** 0.5:.3f}, slope over the width {slope:.2f} ± {cov[0, 0] ** 0.5:.2f}; in Stokes flow "
              f"{-1.7601 * (np.pi / 6) ** (1 / 3) * carnahan_starling(1 - voidage) * stokes / law:.2f} less what the suspension's viscosity takes off\n")


def carnahan_starling(phi):
    """Structure factor of hard spheres at long waves (Carnahan and Starling, J. Chem. Phys. 51 (1969) 635)."""
    return (1 - phi) ** 4 / (1 + 4 * phi + 4 * phi**2 - 4 * phi**3 + phi**4)


def grid(program, folder):
    print("| voidage | cells per diameter | free over Richardson and Zaki |\n| --- | --- | --- |")
    for voidage in (0.8, 0.65):
        for cells in (8, 12, 16):
            row = settled(program, folder, voidage, 20, 2, cells=cells)
            print(f"| {voidage} | {cells} | {of_law(row, richardson_zaki(voidage))} |")


def viscous(program, folder, voidages=(0.8, 0.65), boxes=2, spheres=40, until=None):
    """At a Reynolds number alone of 0.7, where sedimentation of Stokes flow is known."""
    viscosity = 30e-3
    stokes, _, re = alone(viscosity)
    print(f"Re alone {re:.2f}\n| voidage | boxes | free over Stokes' velocity | Richardson and Zaki | (1 - phi)^4.48 | (1 - phi)^5.6 | s |\n" + "| --- " * 7 + "|")
    for voidage in voidages:
        row = settled(program, folder, voidage, spheres, boxes, *([f'until="{until} s"'] if until else []), viscosity=viscosity)
        law = richardson_zaki(voidage, viscosity) / stokes
        print(f"| {voidage} | {boxes} of {spheres} | {of_law(row, stokes)} | {law:.3f} | {voidage**4.48:.3f} | {voidage**5.6:.3f} | {row['seconds']:.0f} |")


def two_sizes(folder):
    """A case of 1.5 and 3 mm in equal volumes."""
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / "two.toml"
    case.write_text(CASE.format(**LIQUID).replace("[bed]\nvolume_share = [1.0]", TWO.format(coarse=3e-3, fine=0.5, share=0.5)))
    return case


def relative(program, folder):
    case = two_sizes(folder)
    print("| voidage | cells per fine diameter | f_11 | f_12 | f_21 | f_22 | f_11 + f_12 |\n" + "| --- " * 7 + "|")
    for voidage, grids in ((0.6, (6, 9, 12, 18)), (0.87, (6, 9))):
        for cells in grids:
            [row] = rows(program, case, folder / f"{voidage}-{cells}", "motion=moving", f"voidage=[{voidage}]", f"cells_per_diameter={cells}",
                         "grids=1", "packings=1", "spheres=18")
            f = [row[f"f_{pair}"] for pair in ("1_1", "1_2", "2_1", "2_2")]
            print(f"| {voidage} | {cells} | " + " | ".join(f"{value:.3f}" for value in f) + f" | {f[0] + f[1]:.3f} |")


def inertia(program, folder, spheres=18):
    """The last columns: forces past one species after the other, added, over the drag on held spheres."""
    case = two_sizes(folder)
    print("| Re | cells per fine diameter | boxes | f_11 | f_12 | f_21 | f_22 | added, fine | added, coarse | s |\n" + "| --- " * 10 + "|")
    for reynolds, cells, boxes in ((0, 6, 8), (1, 6, 8), (5, 6, 8), (20, 6, 8)):
        out = folder / f"{reynolds}-{cells}-{spheres}"
        [row] = rows(program, case, out, "motion=moving", "voidage=[0.8]", f"reynolds=[{reynolds}]", f"cells_per_diameter={cells}", "grids=1",
                     f"packings={boxes}", f"spheres={spheres}")
        lines = [[float(cell) for cell in line.split(",")[7:11]] for line in (out / "boxes.csv").read_text().splitlines()[1:]]
        alone = sum(np.array(line[1::2]) for n, line in enumerate(lines) if reynolds == 0 or n % 3 < 2) / boxes
        forces = [f"{row[f'f_{pair}']:.2f} ± {row.get(f'f_{pair}_se', np.nan):.2f}" for pair in ("1_1", "1_2", "2_1", "2_2")]
        added = [f"{alone[j] / row[f'f_{j + 1}']:.3f}" for j in range(2)]
        print("| " + " | ".join([str(reynolds), str(cells), str(boxes), *forces, *added, f"{row['seconds']:.0f}"]) + " |", flush=True)


def slips(row):
    """Of fine and coarse, with their errors, mm/s."""
    return [(1e3 * row[f"u_{j}"], 1e3 * row.get(f"u_{j}_se", np.nan)) for j in (1, 2)]


def two_line(what, u, seconds):
    (fine, fine_se), (coarse, coarse_se) = u
    ratio = coarse / fine
    print(f"| {what} | {fine:.1f} ± {fine_se:.1f} | {coarse:.1f} ± {coarse_se:.1f} | {ratio:.2f} ± "
          f"{ratio * np.hypot(fine_se / fine, coarse_se / coarse):.2f} | {seconds:.0f} |", flush=True)


def system_b(program, folder, voidages=(0.87, 0.8), boxes=4, spheres=44, until=0.6):
    case = ROOT / "cases/matsuura-akehata/case.toml"
    print("| voidage | spheres | boxes | cells | until, s | fine, mm/s | coarse, mm/s | coarse over fine | s |\n" + "| --- " * 9 + "|")

    def free(voidage, until, cells=8, packings=boxes):
        [row] = rows(program, case, folder / f"{voidage}-{spheres}-{until}-{cells}", "motion=free", f'until="{until} s"', f"voidage=[{voidage}]",
                     f"cells_per_diameter={cells}", "grids=1", f"packings={packings}", f"spheres={spheres}", effects=FILM)
        two_line(f"{voidage} | {spheres} free | {packings} | {cells} | {until}", slips(row), row["seconds"])

    def held(voidage):
        found = rows(program, case, folder / f"{voidage}-{spheres}-held", f"reynolds={list(HELD_RE.get(voidage, (15, 30)))}", f"voidage=[{voidage}]",
                     "cells_per_diameter=8", "grids=1", f"packings={boxes}", f"spheres={spheres}")
        sauter = 1 / sum(found[0][f"x{j}"] / found[0][f"D{j}"] for j in (1, 2))
        reynolds = np.array([row["Re"] for row in found])
        u = [with_error(reynolds, *(np.array([row[f"n_{j}{end}"] for row in found]) for end in ("", "_se")), j - 1, sauter) for j in (1, 2)]
        two_line(f"{voidage} | {spheres} held | {boxes} | 8 | ", u, found[0]["seconds"])

    for voidage in voidages:
        free(voidage, until)
        held(voidage)
    free(voidages[0], 0.5 * until)
    free(voidages[0], 0.5 * until, cells=12, packings=1)


def mixtures(program, folder, voidages=(0.9, 0.8, 0.65), boxes=4):
    print("| ratio | share | voidage | fine, mm/s | coarse, mm/s | coarse over fine | s |\n" + "| --- " * 7 + "|")
    for ratio in (1.5, 2, 3):
        for share in (0.1, 0.5, 0.9):
            two = TWO.format(coarse=ratio * BEADS["diameter"], fine=1 - share, share=share)
            case = folder / f"{ratio}-{share}.toml"
            folder.mkdir(parents=True, exist_ok=True)
            case.write_text(CASE.format(**LIQUID).replace("[bed]\nvolume_share = [1.0]", two))
            numbers = np.array([1 - share, share / ratio**3])
            for voidage in voidages:
                coarse = max(2, 19 * share * (1 - voidage))  # at least two, in a box at least 2.1 of them wide
                spheres = max(40, int(np.ceil(coarse * sum(numbers) / numbers[1])))
                [row] = rows(program, case, folder / f"{ratio}-{share}-{voidage}", "motion=free", f"voidage=[{voidage}]", "cells_per_diameter=8",
                             "grids=1", f"packings={boxes}", f"spheres={spheres}")
                two_line(f"{ratio} | {share} | {voidage}", slips(row), row["seconds"])


TABLES = {table.__name__: table for table in (one_size, box, grid, viscous, relative, inertia, system_b, mixtures)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("what", nargs="?", choices=TABLES)
    parser.add_argument("--voidage", type=float, nargs="+", help="of one_size, viscous, system_b and mixtures")
    parser.add_argument("--boxes", type=int, help="of each of their rows")
    parser.add_argument("--spheres", type=int, help="in a box of viscous, inertia and system_b")
    parser.add_argument("--until", type=float, help="simulated time of viscous and system_b, s")
    given = parser.parse_args()
    asked = {"voidages": given.voidage, "boxes": given.boxes, "spheres": given.spheres, "until": given.until}
    asked = {name: value for name, value in asked.items() if value}
    for name, table in TABLES.items():
        if given.what in (None, name):
            takes = inspect.signature(table).parameters
            table(given.program, given.folder / name, **{key: value for key, value in asked.items() if key in takes})


if __name__ == "__main__":
    main()
