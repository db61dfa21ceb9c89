"""Writes the bed of dem_bed.py for LIGGGHTS.

Its model hertz has the normal law and the dashpots of polybed's hertz_mindlin, tail kept (limitForce off). Its
tangential spring is 8 G* a xi with the present contact radius a, where `mindlin` adds 8 G* a dxi step by step. newton
off: it has no other way for contacts with history.
"""
import re
import shutil
import subprocess
import tempfile

import dem_bed
import granular_script
from dem_process import environment

PACKAGE, PROGRAM = "liggghts", "liggghts"
read = granular_script.read


def installed():
    return shutil.which(PROGRAM) is not None


def version():
    with tempfile.TemporaryDirectory() as folder:  # it writes a log where it stands
        text = subprocess.run([PROGRAM], input="", capture_output=True, text=True, env=environment(), cwd=folder).stdout
    found = re.search(r"LIGGGHTS-\w+ [\d.]+, compiled \d+-\d\d-\d\d", text)
    return found.group(0) if found else "unknown"


def write(directory, bed, settings):
    granular_script.write_data(directory / "data", bed)
    kinds = {"youngsModulus peratomtype": dem_bed.YOUNG, "poissonsRatio peratomtype": dem_bed.POISSON,
             "coefficientRestitution peratomtypepair 1": dem_bed.RESTITUTION,
             "coefficientFriction peratomtypepair 1": dem_bed.FRICTION}
    properties = [f"fix m{n} all property/global {kind} {value:.17g}" for n, (kind, value) in enumerate(kinds.items())]
    (directory / "in").write_text("\n".join([
        "units si", "atom_style granular", "atom_modify map array", "boundary p p p", "newton off",
        "communicate single vel yes", "read_data data", f"neighbor {dem_bed.SKIN:.17g} bin",
        granular_script.list_command(settings["list"]), *properties,
        "pair_style gran model hertz tangential history limitForce off", "pair_coeff * *",
        *granular_script.measure_commands(settings)]) + "\n")


def command(settings):
    return [PROGRAM, "-in", "in", "-log", "none"]
