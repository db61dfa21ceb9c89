#!/usr/bin/python3
"""Draws docs/pictures/particle-verification.png from runs: particle_pictures.py PROGRAM PICTURE

Left: rebounds of Chung and Ooi's test 4 (alumina, 3.9 m/s, friction 0.092, e 0.98) at 40 angles in one run for each law.
Right: what is missing in the account of energy of 400 beads against the step."""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

SPEED, RADIUS, FRICTION, RESTITUTION = 3.9, 2.5e-3, 0.092, 0.98
ANGLES = np.linspace(1, 80, 40)  # degrees from the normal
# By another program, 20000 steps a contact: as in tests/verification/dem_oblique_test.cpp.
FINE = {"angle": [2, 5, 10, 15, 20, 25, 30], "hdd": [.75034, .69448, .57356, .56197, .58213, .62263, .68474],
        "mindlin": [.87033, .85746, .70669, .63385, .62248, .63937, .68474]}

# The wall has nearly the sphere's Poisson ratio and the greatest modulus a case may name; the result does not depend on it.
IMPACTS = """[column]
size = [0.42, 0.05, 0.05]
cells = [42, 5, 5]
gravity = 0
[fluid]
name = "none"
[[species]]
name = "alumina"
diameter = "5 mm"
density = 4000
youngs_modulus = "380 GPa"
[bed]
start = "list:beads.csv"
[effects]
others = "none"
contact = "hertz_mindlin"
[dem]
youngs_modulus = 1e13
poisson_ratio = 0.23
friction = 0.092
restitution = 0.98
greatest_speed = 3.9
fixed_step = 3e-8
[run]
until = 6e-5
"""

GAS = """[column]
size = [0.008, 0.008, 0.008]
cells = [4, 4, 4]
sides = "periodic"
ends = "periodic"
gravity = 0
[fluid]
name = "none"
[[species]]
name = "bead"
diameter = "1 mm"
density = 2500
[bed]
particles = [400]
start = "random"
solids_fraction = 0.6
[effects]
others = "none"
contact = "hertz_mindlin"
[dem]
start_speed = 0.05
friction = 0.5
restitution = 0.9
[run]
until = 0.01
[output]
every = 0.01
history_every = 0.001
"""


def run(program, folder, case, *settings):
    (folder / "case.toml").write_text(case)
    out = folder / "run"
    shutil.rmtree(out, ignore_errors=True)
    words = [w for s in settings for w in ("--set", s)]
    subprocess.run([program, "dem", folder / "case.toml", "-o", out, "--quiet", *words], check=True,
                   stdout=subprocess.DEVNULL)
    return out


def rebounds(program, folder, law):
    angles = np.radians(ANGLES)
    rows = ["species,x,y,z,vx,vy,vz"]
    rows += [f"alumina,{0.01 * (k + 1)},{RADIUS},0.025,{SPEED * np.sin(a)},{-SPEED * np.cos(a)},0" for k, a in enumerate(angles)]
    (folder / "beads.csv").write_text("\n".join(rows) + "\n")
    out = run(program, folder, IMPACTS, f"dem.tangential={law}")
    with h5py.File(out / "particles.h5") as file:
        step = file["step"][max(file["step"])]
        return step["velocity"][:, 0] / (SPEED * np.sin(angles))


def missing_energy(program, folder, integrator, tail, dt):
    out = run(program, folder, GAS, f"dem.integrator={integrator}", f"dem.tail={tail}", f"dem.fixed_step={dt}")
    names = ("kinetic_J", "rotational_J", "elastic_J", "potential_J", "dissipated_J")
    with open(out / "history.csv", newline="") as file:
        sums = [sum(float(row[n]) for n in names) for row in csv.DictReader(file)]
    return max(abs(s - sums[0]) for s in sums) / sums[0]


def main(program, picture):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    steps = [1.6e-5, 8e-6, 4e-6, 2e-6]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for law, colour in (("hdd", "tab:blue"), ("mindlin", "tab:orange")):
            left.plot(ANGLES, rebounds(program, folder, law), color=colour, label=f"polybed, {law}")
            left.plot(FINE["angle"], FINE[law], "o", color=colour, mfc="none", label=f"fine steps, {law}")
        for integrator in ("thesis", "synchronised"):
            for tail, line in (("clip", "-o"), ("keep", "--s")):
                errors = [missing_energy(program, folder, integrator, tail, dt) for dt in steps]
                right.loglog(np.array(steps) * 1e6, errors, line, label=f"{integrator}, {tail}")
    angles = np.linspace(32.5, 80, 100)
    sliding = 1 - FRICTION * (1 + RESTITUTION) / np.tan(np.radians(angles))
    left.plot(angles, sliding, "k:", label="sliding, closed form")
    left.set(xlabel="angle of impact, degrees", ylabel="tangential speed after over before")
    left.legend()
    right.loglog([2, 16], [2e-5, 64 * 2e-5], "k:", label="second order")
    right.axhline(1e-3, color="grey", lw=0.8)
    right.set(xlabel="step, us", ylabel="energy missing in the ledger, of that at the start")
    right.legend()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2])
