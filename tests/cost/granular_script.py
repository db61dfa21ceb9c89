"""What LAMMPS and LIGGGHTS, which grew from it, are given and report alike."""
import re
from pathlib import Path

import numpy as np

import dem_bed
from dem_process import Failed


def write_data(path, bed):
    """A data file for read_data with atom_style sphere of LAMMPS or granular of LIGGGHTS."""
    ids, ones = np.arange(1, bed["count"] + 1), np.ones(bed["count"])
    atoms = np.column_stack([ids, ones, dem_bed.DIAMETER * ones, dem_bed.DENSITY * ones, bed["x"]])
    bounds = "".join(f"0 {bed['box']:.17g} {axis}lo {axis}hi\n" for axis in "xyz")
    with open(path, "w") as stream:
        stream.write(f"packing\n\n{bed['count']} atoms\n1 atom types\n\n{bounds}\nAtoms\n\n")
        np.savetxt(stream, atoms, fmt="%d %d" + " %.17g" * 5)
        stream.write("\nVelocities\n\n")
        np.savetxt(stream, np.column_stack([ids, bed["v"], bed["w"]]), fmt="%d" + " %.17g" * 6)


def list_command(how):
    """how: "interval" renews the neighbour list every LIST_EVERY steps, "displacement" once half the skin is passed."""
    return {"interval": f"neigh_modify every {dem_bed.LIST_EVERY} delay 0 check no",
            "displacement": "neigh_modify every 1 delay 0 check yes"}[how]


def measure_commands(settings):
    """Kinetic energy without that of the drift and contacts per particle, every `sample` steps or at the end."""
    return [f"timestep {dem_bed.STEP:.17g}", "fix move all nve/sphere", "compute touching all contact/atom",
            "compute moving all ke", "compute mean all reduce ave c_touching",
            "variable own equal c_moving-0.5*mass(all)*(vcm(all,x)^2+vcm(all,y)^2+vcm(all,z)^2)",
            "variable contacts equal c_mean", "thermo_style custom step v_own v_contacts", "thermo_modify norm no",
            f"thermo {settings['sample'] or settings['steps']}", f"run {settings['steps']}"]


def read(directory, settings):
    """Rows of step, kinetic energy and contacts; how often the list was renewed, and how often too late, if known."""
    text = (Path(directory) / "log").read_text(errors="replace")
    rows = [line.split() for line in text.splitlines() if re.fullmatch(r"\s*\d+(\s+[-+.\deE]+){2}\s*", line)]
    rows = [{"step": int(step), "kinetic_J": float(own), "contacts": float(mean)} for step, own, mean in rows]
    if not rows or rows[-1]["step"] != settings["steps"]:
        raise Failed(f"no measures at step {settings['steps']}")
    dangerous = re.search(r"Dangerous builds = (\d+)", text)
    if dangerous and int(dangerous.group(1)):
        raise Failed(f"the neighbour list was renewed too late {dangerous.group(1)} times")
    return {"rows": rows, "rebuilds": int(re.search(r"Neighbor list builds = (\d+)", text).group(1))}
