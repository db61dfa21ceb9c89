"""Runs the program: one run, a sweep, a comparison of both models, a scan for the inversion velocity, a calibration.

    import polybed
    run = polybed.run("case.toml", "tfm", {"inlet.superficial_velocity": "30 mm/s"}, until="20 s")
    runs = polybed.sweep("case.toml", "inlet.superficial_velocity", ["20 mm/s", "30 mm/s"])
    found = polybed.compare("case.toml")
    found = polybed.inversion("case.toml", scan="tfm")
    table = polybed.calibrate("case.toml", {"calibrate.solids_fraction": [0.2, 0.4]}, jobs=2)

A run that is finished already, of the same case, is opened and not made again.
"""

import json
import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from polybed.read import read, read_json
from polybed.solids_table import read_table

OWN = Path(__file__).resolve()
# What Open MPI needs in a container and as root; one rank needs neither network nor daemon.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


class ProgramError(Exception):
    """The program ended with another code than 0; the text is what it said."""

    def __init__(self, words, code, said):
        super().__init__(f"{' '.join(words)}\nended with {code}: {said.strip()}")
        self.code = code


def program():
    """Path of the program: $POLYBED, or that beside which this package is installed or was built, or the one on the path."""
    tried = [os.environ.get("POLYBED"), OWN.parents[4] / "bin/polybed", OWN.parents[3] / "build/polybed"]
    for path in tried:
        if path and os.access(path, os.X_OK) and not Path(path).is_dir():
            return str(Path(path).resolve())
    found = shutil.which("polybed")
    if not found:
        raise FileNotFoundError("there is no program polybed: build it, install it, or name it in the environment's POLYBED")
    return found


def call(*words, ranks=1):
    """Runs a command of the program and returns what it printed. Raises ProgramError."""
    line = [program(), *map(str, words)]
    if ranks > 1:
        line = ["mpirun", "-q", "-n", str(ranks), *line]
    done = subprocess.run(line, env=MPI | dict(os.environ), capture_output=True, text=True)
    if done.returncode != 0:
        raise ProgramError(line, done.returncode, done.stderr)
    return done.stdout


def text_of(value):
    """A value as --set takes it: a number or a list bare, a text (with or without a unit) in quotes."""
    return json.dumps(value)


def settings(overrides, until=None):
    words = []
    for key, value in (overrides or {}).items():
        words += ["--set", f"{key}={text_of(value)}"]
    return words + ([] if until is None else ["--until", str(until)])


def case_text(case, overrides, until):
    """The case, resolved, as the record of a run of it has it."""
    overrides = dict(overrides or {}) | ({} if until is None else {"run.until": until})
    return json.loads(call("check", case, *settings(overrides), "--json"))["case"]


def finished(output, model, text):
    """Whether a folder holds a finished run by this model of this very case."""
    if not (Path(output) / "run.json").exists():
        return False
    record = read(output).record
    return record["state"] == "done" and record["model"] == model and record["case"] == text


def name_of(case):
    """What a case is called: a case.toml by its folder."""
    path = Path(case).resolve()
    return path.parent.name if path.stem == "case" else path.stem


def run(case, model="tfm", overrides=None, output=None, until=None, ranks=1):
    """Runs a case by a model, "tfm" or "dem", and opens the run. What else is in the folder is replaced.

    overrides: keys of the case file with their values, {"tfm.rtol": 1e-4, "species.fine.diameter": "1 mm"}
    output: run directory; default runs/<case name>-<model>
    """
    output = Path(output) if output else Path("runs") / f"{name_of(case)}-{model}"
    if not finished(output, model, case_text(case, overrides, until)):
        call(model, case, *settings(overrides, until), "-o", output, "--force", "--quiet", "--no-picture", ranks=ranks)
    return read(output)


def sweep(case, key, values, model="tfm", overrides=None, output=None, until=None, at_once=1):
    """Runs a case for several values of a key and returns the runs in their order, each in a folder of its own.

    at_once: how many run side by side
    """
    folder = Path(output) if output else Path("runs") / f"{name_of(case)}-{model}-sweep"

    def one(value):
        name = "".join(c if c.isalnum() or c in ".-" else "_" for c in f"{key}-{value}")
        return run(case, model, dict(overrides or {}) | {key: value}, folder / name, until)
    with ThreadPoolExecutor(at_once) as pool:
        return list(pool.map(one, values))


def compare(case, tfm=None, dem=None, overrides=None, output=None, until=None, page=False):
    """Compares both models on a case: comparison.json as a dictionary. Runs that are not given are made, or opened.

    tfm, dem: runs, or their directories
    page: also writes comparison.html
    """
    output = Path(output) if output else Path("runs") / f"{name_of(case)}-compare"
    words = []
    for model, given in (("tfm", tfm), ("dem", dem)):
        made = run(case, model, overrides, output / model, until) if given is None else given
        words += [f"--{model}", getattr(made, "directory", made)]
    call("compare", case, *settings(overrides, until), *words, "-o", output, "--quiet", *([] if page else ["--no-picture"]))
    return read_json(output / "comparison.json", "polybed comparison")


def inversion(case, scan=None, overrides=None, output=None, until=None, begin=None, end=None, method=None):
    """The inversion point: by force balance (or another method, see `polybed inversion`) without a run, or by a scan.

    scan: None, "tfm", "dem" or "both"; of a scan what inversion.json says is returned
    begin, end: velocities between which a scan begins, "30 mm/s"
    """
    words = ["inversion", case, *settings(overrides, until if scan else None), *(["--method", method] if method else [])]
    if scan is None:
        return json.loads(call(*words, "--json"))
    output = Path(output) if output else Path("runs") / f"{name_of(case)}-inversion"
    for option, velocity in (("--from", begin), ("--to", end)):
        words += [] if velocity is None else [option, velocity]
    call(*words, "--scan", scan, "-o", output, "--quiet", "--no-picture")
    return read_json(output / "inversion.json", "polybed inversion")


def calibrate(case, overrides=None, output=None, jobs=1):
    """Runs the boxes of a case and returns the table that they give, arrays by name with units. Finished boxes are kept: the
    same call runs none, another grid of points only what is new. Raises ProgramError, with code 3 if the table may not be used.

    overrides: keys of the case file, the axes of the table among them, {"calibrate.solids_fraction": [0.2, 0.4]}
    output: directory of table.h5 and the boxes; default runs/<case name>-calibrate
    jobs: boxes at once
    """
    output = Path(output) if output else Path("runs") / f"{name_of(case)}-calibrate"
    call("calibrate", case, *settings(overrides), "-o", output, "-j", jobs, "--quiet")
    return read_table(output / "table.h5")
