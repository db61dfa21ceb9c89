"""The bed of cases/goldschmidt-2004, in SI as `polybed check` resolves it, the places its beads start from, its height.

Lattice: as OpenFOAM's tutorial starts, a simple cubic lattice of 3 mm; hardly any contacts. Packed: the bed at rest
without gas, with six contacts on a bead.
"""
import json
import subprocess
import tomllib
from pathlib import Path

import h5py
import numpy as np

import dem_process
import openfoam_run

CASE = Path(__file__).parents[2] / "cases/goldschmidt-2004/case.toml"
SPACING = 3e-3
# Soft beads fall and lie, which lets them overlap deeply; then hard ones yield what the softness pressed in: modulus
# over the case's own, seconds.
SETTLING = ((0.05, 0.2), (1.0, 0.03))


def read(program):
    """The scene as a dict of openfoam_cases.py, with the names of polybed's keys for the material."""
    text = subprocess.run([program, "check", CASE, "--resolved"], capture_output=True, text=True, check=True).stdout
    scene = tomllib.loads(text)
    (width, depth, height), (nx, nz, ny) = scene["column"]["size"], scene["column"]["cells"]
    (beads,), (pair,) = scene["species"], scene["contact_pair"]
    fluid, materials = scene["fluid"], ("youngs_modulus", "poisson_ratio", "friction", "restitution")
    own = {key: scene["dem"][key] for key in materials}
    return {"size": (width, height), "cells": (nx, ny), "depth": depth, "layers": nz, "fluid": fluid["name"],
            "fluid_density": fluid["density"], "fluid_viscosity": fluid["viscosity"],
            "gravity": scene["column"]["gravity"], "velocity": scene["inlet"]["superficial_velocity"][0][1],
            "diameter": beads["diameter"], "density": beads["density"], "species": beads["name"],
            "count": scene["bed"]["particles"][0], "solids_fraction": scene["bed"]["solids_fraction"],
            "wall": own | {key: pair[key] for key in materials if key in pair}} | own


def lattice(bed):
    (width, _), depth = bed["size"], bed["depth"]
    across, deep = round(width / SPACING), round(depth / SPACING)
    n = np.arange(bed["count"])
    return SPACING * (np.stack([n // deep % across, n // (deep * across), n % deep], axis=1) + 0.5)


def write_places(path, bed, places):
    with open(path, "w") as stream:
        stream.write("species,x,y,z\n")
        np.savetxt(stream, places, fmt=f"{bed['species']},%.17g,%.17g,%.17g", delimiter=",")


def dry_case(bed, start, modulus, until):
    (width, height), (nx, ny) = bed["size"], bed["cells"]
    tables = {"column": {"size": [width, bed["depth"], height], "cells": [nx, bed["layers"], ny]},
              "fluid": {"name": "none"}, "bed": start, "effects": {"contact": "hertz_mindlin"},
              "dem": {"youngs_modulus": modulus, "poisson_ratio": bed["poisson_ratio"], "friction": bed["friction"],
                      "restitution": 0.5, "greatest_speed": 1.0, "max_overlap": 0.2},
              "run": {"until": until}, "output": {"every": until, "history_every": until}}
    species = {"name": bed["species"], "diameter": bed["diameter"], "density": bed["density"]}
    parts = [("[[species]]", species)] + [(f"[{name}]", keys) for name, keys in tables.items()]
    return 'title = "beads come to rest"\n' + "".join(
        head + "\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items()) for head, keys in parts)


def packed(bed, program, directory, limit):
    """Places of the beads at rest on each other."""
    directory = Path(directory)
    start = {"particles": [bed["count"]], "solids_fraction": bed["solids_fraction"], "start_solids_fraction": 0.45}
    for stage, (softness, until) in enumerate(SETTLING):
        name = f"settling-{stage}"
        (directory / f"{name}.toml").write_text(dry_case(bed, start, softness * bed["youngs_modulus"], until))
        dem_process.run([program, "dem", f"{name}.toml", "-o", name, "--quiet", "--no-picture"], directory, 1, limit)
        places = stored(directory / name)
        write_places(directory / f"{name}.csv", bed, places)
        start = {"start": f"list:{name}.csv"}
    return places


def stored(run):
    """Places at the end of a run of polybed."""
    with h5py.File(run / "particles.h5") as file:
        return file[f"step/{len(file['step']):06d}/position"][()]


def measures(bed, places):
    """Mean height of the centres, and the height of the bed by the definition of docs/reference/measures.md, centres counted."""
    (_, height), (_, ny) = bed["size"], bed["cells"]
    phi, _ = np.histogram(places[:, 1], bins=ny, range=(0, height))
    return {"centre_m": float(places[:, 1].mean()),
            "bed_height_m": openfoam_run.bed_height(phi.astype(float), height / ny)}
