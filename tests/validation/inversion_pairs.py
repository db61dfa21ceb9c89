#!/usr/bin/python3
"""The inversion point by force balance, of laws of mixtures and of mean laws with partitions, against the experiments of
tests/data/lbm/tab_5_ii.csv and the systems A, B, C of the thesis: tables in Markdown.

    tests/validation/inversion_pairs.py build/polybed
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Laws of mixtures, then means of expanded beds with partitions of fixed ones.
PAIRS = [("cello", None), ("vbk_theory", None), ("brinkman_oseen", None), ("wen_yu", "brinkman_oseen"), ("di_felice", "brinkman_oseen"),
         ("richardson_zaki", "brinkman_oseen"), ("wen_yu", "cello"), ("richardson_zaki", "cello"), ("richardson_zaki", "vbk_theory")]
SYSTEMS = {"A": (1.8, 0.76), "B": (30.0, 0.87), "C": (12.5, 0.84)}
WATER = (998.21, 1.0016e-3)  # 20 degC


def experiments():
    lines = (ROOT / "tests/data/lbm/tab_5_ii.csv").read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def case_of(row):
    x2 = float(row["x2"])
    species = "".join(f'[[species]]\nname = "s{j}"\ndiameter = "{row[f"D{j}_mm"]} mm"\ndensity = {row[f"rho{j}_used"]}\n' for j in (1, 2))
    return f"""title = "source {row['ref']}"
[column]
size = ["60 mm", "600 mm"]
cells = [1, 50]
[fluid]
name = "water"
density = {WATER[0]}
viscosity = {WATER[1]}
{species}[bed]
volume_share = [{1 - x2}, {x2}]
static_height = "100 mm"
solids_fraction = 0.6
[inlet]
superficial_velocity = "10 mm/s"
[effects]
others = "none"
drag = "cello"
solids_stress = "frictional"
[run]
until = "1 s"
"""


def inversion(program, case, pair):
    """(mm/s, voidage) of the greatest root, or None."""
    law, partition = pair
    words = [program, "inversion", case, "--json", "--law", law, *(["--partition", partition] if partition else [])]
    found = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    return None if found["velocity_m_s"] is None else (1e3 * found["velocity_m_s"], found["voidage"])


def text_of(point):
    return "-" if point is None else f"{point[0]:.2f} / {point[1]:.3f}"


def print_table(names, measured, found):
    print("| drag | partition | " + " | ".join(names) + " | mean of abs ln(u/u_exp) | bias |")
    print("| --- | --- |" + " ---: |" * (len(names) + 2))
    print("| **experiment** | | " + " | ".join(f"{u} / {eps}" for u, eps in measured) + " | | |")
    for (law, partition), points in found.items():
        ratios = [math.log(p[0] / m[0]) for p, m in zip(points, measured) if p]
        means = [f"{sum(map(abs, ratios)) / len(ratios):.3f}", f"{sum(ratios) / len(ratios):+.3f}"] if len(ratios) == len(points) else ["-", "-"]
        print(f"| `{law}` | " + (f"`{partition}`" if partition else "") + " | " + " | ".join([*map(text_of, points), *means]) + " |")


if __name__ == "__main__":
    program = sys.argv[1]
    systems = {name: ROOT / f"cases/thesis-{name.lower()}/case.toml" for name in SYSTEMS}
    print_table([*SYSTEMS], [*SYSTEMS.values()], {pair: [inversion(program, case, pair) for case in systems.values()] for pair in PAIRS})
    rows = experiments()
    with tempfile.TemporaryDirectory() as folder:
        cases = []
        for row in rows:
            cases.append(pathlib.Path(folder) / f"{row['ref']}.toml")
            cases[-1].write_text(case_of(row))
        print()
        print_table([f"[{row['ref']}]" for row in rows], [(float(row["u_EXP"]), float(row["eps_EXP"])) for row in rows],
                    {pair: [inversion(program, case, pair) for case in cases] for pair in PAIRS})
