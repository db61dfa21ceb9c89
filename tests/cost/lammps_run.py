"""Writes the bed of dem_bed.py for LAMMPS.

Laws: `same`: pair_style granular with hertz/material, tsuji damping and mindlin_rescale/force is polybed's
hertz_mindlin with tangential = "mindlin", tail = "keep" and the same half-step velocities in the force; LAMMPS'
polynomial of the restitution is inverted for the same dashpot. `secant`: the same but for its tangential spring
8 G* a xi with the present contact radius a, where `mindlin` adds 8 G* a dxi step by step; this is LIGGGHTS' law.
`fast`: gran/hertz/history, the quickest pair style: the spring of `secant`, and dashpots that grow with a, not with its
root, made equal at the mean overlap of the packing.
All: newton on, the quicker of its two ways by 4 to 7 %.
"""
import math
import re
import shutil
import subprocess

import dem_bed
import granular_script
from dem_process import environment

PACKAGE, PROGRAM = "lammps", "lmp"
read = granular_script.read


def installed():
    return shutil.which(PROGRAM) is not None


def version():
    text = subprocess.run([PROGRAM, "-h"], capture_output=True, text=True, env=environment()).stdout
    found = [re.search(pattern, text) for pattern in (r"Simulator - (.+)", r"Compiler: (.+)")]
    return ", ".join(f.group(1).strip() for f in found if f) or "unknown"


def tsuji(e):
    """Damping over sqrt(k_n m*) of restitution e: the polynomial in LAMMPS' documentation of pair_style granular."""
    return 1.2728 - 4.2783 * e + 11.087 * e**2 - 22.348 * e**3 + 27.467 * e**4 - 18.022 * e**5 + 4.8218 * e**6


def tsuji_restitution(damping):
    """The restitution for which the polynomial, which falls from 1.27 to 0, gives this damping."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if tsuji(middle) > damping else (low, middle)
    return low


def pair_commands(bed, law):
    if law in ("same", "secant"):
        # c_n = 2 sqrt(5/6) beta sqrt(3/2 k_n m*) = sqrt(5) beta sqrt(k_n m*), k_n = (4/3) E* a
        restitution = tsuji_restitution(math.sqrt(5) * dem_bed.damping_ratio(dem_bed.RESTITUTION))
        spring = {"same": "mindlin_rescale/force", "secant": "mindlin"}[law]
        return ["pair_style granular",
                f"pair_coeff * * hertz/material {dem_bed.YOUNG:.17g} {restitution:.17g} {dem_bed.POISSON:.17g} "
                f"tangential {spring} NULL {dem_bed.DAMPING_RATIO:.17g} {dem_bed.FRICTION:.17g} damping tsuji"]
    damping = hertz_damping(bed["overlap_m"])
    return [f"pair_style gran/hertz/history {4 / 3 * dem_bed.YOUNG_OF_PAIR:.17g} {8 * dem_bed.SHEAR_OF_PAIR:.17g} "
            f"{damping:.17g} {dem_bed.DAMPING_RATIO * damping:.17g} {dem_bed.FRICTION:.17g} 1", "pair_coeff * *"]


def hertz_damping(overlap):
    """gamma_n of gran/hertz/history, whose dashpot is gamma_n m* a, that equals c_n at this overlap."""
    return dem_bed.normal_damping(overlap) / (math.sqrt(dem_bed.REDUCED_RADIUS * overlap) * dem_bed.REDUCED_MASS)


def write(directory, bed, settings):
    granular_script.write_data(directory / "data", bed)
    (directory / "in").write_text("\n".join([
        "units si", "atom_style sphere", "atom_modify map array", "boundary p p p", "newton on", "comm_modify vel yes",
        "read_data data", f"neighbor {dem_bed.SKIN:.17g} bin", granular_script.list_command(settings["list"]),
        *pair_commands(bed, settings["law"]), *granular_script.measure_commands(settings)]) + "\n")


def command(settings):
    return [PROGRAM, "-in", "in", "-log", "none"]
