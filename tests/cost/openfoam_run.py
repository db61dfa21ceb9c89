"""Runs a program of OpenFOAM on a case, reads its ASCII fields and its log."""
import os
import re
import resource
import shutil
import subprocess
from pathlib import Path

import numpy as np

from openfoam_cases import PRESSURE

PROGRAMS = ("blockMesh", "reactingMultiphaseEulerFoam", "twoPhaseEulerFoam")
PACKAGE = "openfoam (Debian: apt-get install --no-install-recommends openfoam)"


class Failed(Exception):
    """A program ended with an error or passed its time limit."""


def missing(programs=PROGRAMS):
    """Programs that are not on the path."""
    return [program for program in programs if shutil.which(program) is None]


def version():
    """Version that the programs print at their start."""
    banner = subprocess.run(["blockMesh", "-help"], capture_output=True, text=True, env=environment()).stdout
    found = re.search(r"OpenFOAM-[v ]*\(?([^) ]+)", banner)
    return found.group(1) if found else "unknown"


def environment():
    """Debian's programs find their settings only where WM_PROJECT_DIR says; an installation that sets it keeps it."""
    return {"WM_PROJECT_DIR": "/usr/share/openfoam"} | os.environ


def run(command, directory, log, limit, env=None):
    """CPU seconds (user and system, of the process as the kernel counts them); output goes to the file `log`."""
    with open(log, "w") as stream:
        process = subprocess.Popen([str(word) for word in command], cwd=directory, env=env, stdout=stream,
                                   stderr=subprocess.STDOUT, preexec_fn=lambda: resource.setrlimit(
                                       resource.RLIMIT_CPU, (limit, limit + 1)))
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        tail = "\n".join(Path(log).read_text(errors="replace").splitlines()[-12:])
        raise Failed(f"{Path(str(command[0])).name} ended with {process.returncode} (limit {limit} CPU s):\n{tail}")
    return usage.ru_utime + usage.ru_stime


def solve(program, directory, limit):
    """Makes the mesh, runs the program; its CPU seconds without those of the mesh."""
    run(["blockMesh"], directory, Path(directory) / "blockMesh.log", 60, environment())
    return run([program], directory, Path(directory) / "log", limit, environment())


def read_scalar(path, cells, layers=1):
    """An ASCII volScalarField as an array of y by x, its mean over the layers."""
    content = Path(path).read_text()
    uniform = re.search(r"internalField\s+uniform\s+(\S+);", content)
    if uniform:
        return np.full(cells[::-1], float(uniform.group(1)))
    found = re.search(r"internalField\s+nonuniform\s+List<scalar>\s*(\d+)\s*\(([^)]*)\)", content)
    values = np.array(found.group(2).split(), dtype=float)
    if len(values) != int(found.group(1)) or len(values) != layers * cells[0] * cells[1]:
        raise Failed(f"{path} holds {len(values)} values, not {found.group(1)} or {layers * cells[0] * cells[1]}")
    return values.reshape(layers, *cells[::-1]).mean(axis=0)


def times(directory):
    """Times with stored fields: (seconds, folder), in order."""
    folders = [f for f in Path(directory).iterdir() if re.fullmatch(r"\d+(\.\d*)?(e-?\d+)?", f.name)]
    return sorted((float(f.name), f) for f in folders)


def rows(directory, bed):
    """Rows like those of polybed's history.csv: measures of the stored fields."""
    return [{"time_s": t} | measures(folder, bed) for t, folder in times(directory)]


def measures(folder, bed):
    """Definitions of docs/reference/measures.md on the lateral averages; volume_<name>: its share of the column."""
    height, layers = bed["size"][1] / bed["cells"][1], bed.get("layers", 1)
    names = [s["name"] for s in bed["solids"]]
    profiles = {name: read_scalar(folder / f"alpha.{name}", bed["cells"], layers).mean(axis=1) for name in names}
    y = (np.arange(bed["cells"][1]) + 0.5) * height
    pressure = read_scalar(folder / "p", bed["cells"], layers).mean(axis=1) - PRESSURE + bed["fluid"]["density"] * 9.81 * y
    found = {"bed_height_m": bed_height(sum(profiles.values()), height), "pressure_drop_Pa": pressure_drop(pressure)}
    for name, phi in profiles.items():
        found |= {f"centre_{name}_m": float(np.dot(y, phi) / phi.sum()), f"volume_{name}": float(phi.mean())}
    return found


def bed_height(phi, height):
    """Highest y where phi, linear between slab centres, equals half its mean between z_0.80 and z_0.95."""
    volume = np.concatenate([[0], np.cumsum(phi)]) / phi.sum()
    edges = np.arange(len(phi) + 1) * height
    low, high = (np.interp(share, volume, edges) for share in (0.80, 0.95))
    part = np.clip(np.minimum(edges[1:], high) - np.maximum(edges[:-1], low), 0, None) * phi
    half = 0.5 * np.dot(part, phi) / part.sum()
    top = int(np.flatnonzero(phi >= half)[-1])
    if top + 1 == len(phi):
        return height * len(phi)
    return float((top + 0.5 + (phi[top] - half) / (phi[top] - phi[top + 1])) * height)


def pressure_drop(p):
    """Bottom less top, continued linearly by half a slab from the outer two."""
    return float((1.5 * p[0] - 0.5 * p[1]) - (1.5 * p[-1] - 0.5 * p[-2]))


def read_log(log, start):
    """What the program reports: steps, its CPU clock, largest relative change of the volume of each phase from `start`.

    start: {phase: its share of the column at time zero}. The last value of a time step counts, as earlier ones belong
    to iterations that are done again. phase_sum_error: how far the fractions are from summing to one.
    """
    content = Path(log).read_text(errors="replace")
    steps = content.split("\nTime = ")[1:]
    clock, drift, sums = [], dict.fromkeys(start, 0.0), []
    for step in steps:
        done = re.search(r"^ExecutionTime = (\S+) s", step, re.MULTILINE)
        if not done:
            continue
        clock.append((float(step.split(None, 1)[0]), float(done.group(1))))
        for name, share in start.items():
            now = re.findall(rf"^(?:alpha\.)?{name} (?:volume )?fraction[^=\n]*= (\S+)", step, re.MULTILINE)
            drift[name] = max(drift[name], abs(float(now[-1]) / share - 1))
        whole = re.findall(r"^Phase-sum volume fraction.*?= (\S+)", step, re.MULTILINE)
        sums += [abs(float(value) - 1) for value in whole[-1:]]
    return {"steps": len(clock), "clock": clock, "volume_change": drift, "phase_sum_error": max(sums, default=None)}


def cpu_between(clock, begin, end):
    """CPU seconds that the program counted between two simulated times."""
    before, until = ([cpu for t, cpu in clock if t <= time + 1e-9] for time in (begin, end))
    return until[-1] - before[-1]
