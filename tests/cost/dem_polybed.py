"""The bed of dem_bed.py as a case of polybed, and what its run reports."""
import csv
import json
import re
import subprocess
from pathlib import Path

import numpy as np

import dem_bed
from dem_process import Failed, environment

COLUMNS = "species,x,y,z,vx,vy,vz,wx,wy,wz"


def knows_particles(program):
    """Whether this build has the particle model."""
    text = subprocess.run([program, "--help"], capture_output=True, text=True, env=environment()).stdout
    return re.search(r"^ +dem\b", text, re.MULTILINE) is not None


def version(program):
    """With the options of its build, when it stands where it was built."""
    text = subprocess.run([program, "--version"], capture_output=True, text=True, env=environment()).stdout.strip()
    cache = Path(program).parent / "CMakeCache.txt"
    lines = cache.read_text().splitlines() if cache.exists() else []
    wanted = ("CMAKE_BUILD_TYPE", "CMAKE_CXX_FLAGS", "CMAKE_CXX_FLAGS_RELEASE", "POLYBED_NATIVE")
    options = [line.split(":")[0] + "=" + line.split("=", 1)[1] for line in lines if line.split(":")[0] in wanted]
    return ", ".join([text, *options])


def case_text(bed, settings):
    size = [bed["box"]] * 3
    until = settings["steps"] * dem_bed.STEP
    every = (settings["sample"] or settings["steps"]) * dem_bed.STEP
    return f"""\
title = "the same packing as another program's"
[column]
size = {size}
cells = [4, 4, 4]
sides = "periodic"
ends = "periodic"
gravity = 0.0
[fluid]
name = "none"
[[species]]
name = "spheres"
diameter = {dem_bed.DIAMETER!r}
density = {dem_bed.DENSITY!r}
[bed]
start = "list:particles.csv"
[effects]
others = "none"
contact = "hertz_mindlin"
[dem]
youngs_modulus = {dem_bed.YOUNG!r}
poisson_ratio = {dem_bed.POISSON!r}
friction = {dem_bed.FRICTION!r}
restitution = {dem_bed.RESTITUTION!r}
tangential = "mindlin"
tail = "keep"
fixed_step = {dem_bed.STEP!r}
skin = {dem_bed.SKIN!r}
ledger = false
[run]
until = {until!r}
[output]
every = {until!r}
history_every = {every!r}
checkpoint_every = {until!r}
"""


def write(directory, bed, settings):
    directory = Path(directory)
    with open(directory / "particles.csv", "w") as stream:
        stream.write(COLUMNS + "\n")
        np.savetxt(stream, np.column_stack([bed["x"], bed["v"], bed["w"]]), fmt="spheres" + ",%.17g" * 9)
    (directory / "case.toml").write_text(case_text(bed, settings))
    (directory / "drift.json").write_text(json.dumps({"drift_J": bed["drift_J"]}))


def command(settings):
    return [settings["program"], "dem", "case.toml", "-o", "run", "--quiet", "--json", "--no-picture"]


def read(directory, settings):
    """Rows of step and kinetic energy; contacts per particle, the mean of the run, in the last of them."""
    directory = Path(directory)
    work = json.loads((directory / "run/run.json").read_text())["work"]
    drift = json.loads((directory / "drift.json").read_text())["drift_J"]
    with open(directory / "run/history.csv", newline="") as stream:
        rows = [{"step": round(float(row["time_s"]) / dem_bed.STEP), "contacts": None,
                 "kinetic_J": float(row["kinetic_J"]) - drift} for row in csv.DictReader(stream)]
    if not rows or rows[-1]["step"] != settings["steps"] or work["steps"] != settings["steps"]:
        raise Failed(f"polybed has not done {settings['steps']} steps")
    if settings["ranks"] == 1:  # on more, contacts across ranks are counted by both
        rows[-1]["contacts"] = 2 * work["contact_steps"] / work["particle_steps"]
    return {"rows": rows, "rebuilds": work["rebuilds"]}
