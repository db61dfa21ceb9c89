"""Runs the program: one run, a sweep, a comparison of both models, a scan for the inversion velocity, a calibration.

    import polybed
    run = polybed.run("case.toml", "tfm", {"inlet.superficial_velocity": "30 mm/s"}, until="20 s")
    runs = polybed.sweep("case.toml", "inlet.superficial_velocity", ["20 mm/s", "30 mm/s"])
    found = polybed.compare("case.toml")
    found = polybed.inversion("case.toml", scan="tfm")
    table = polybed.calibrate("case.toml", {"calibrate.solids_fraction": [0.2, 0.4]}, jobs=2)

A run that is finished already, of the same case, is opened and not made again. Overrides are keys of the case file with their
values: texts with or without a unit, numbers, lists and arrays; {"tfm": {"rtol": 1e-4}} is {"tfm.rtol": 1e-4}. What the program says
of its progress goes to standard error as it comes, unless quiet.
"""

import contextlib
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from polybed import search
from polybed.files import FAULTS, read_json
from polybed.overrides import plain, toml, words
from polybed.read import read
from polybed.solids_table import read_table

OWN = Path(__file__).resolve()
MODELS = ("tfm", "dem")
DIGITS = 10  # of a hash in the name of a folder
# What Open MPI needs in a container and as root; one rank needs neither network nor daemon.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


class ProgramError(Exception):
    """The program ended with another code than 0; the text is what it said."""

    def __init__(self, words, code, said):
        super().__init__(f"{' '.join(words)}\nended with {code}: {said.strip()}")
        self.code, self.said = code, said.strip()


def program():
    """Path of the program: $POLYBED, or that beside which this package is installed or was built, or the one on the path."""
    in_sources = (OWN.parents[2] / "CMakeLists.txt").is_file()
    tried = [os.environ.get("POLYBED"), OWN.parents[2] / "build/polybed" if in_sources else OWN.parents[4] / "bin/polybed"]
    for path in tried:
        if path and os.access(path, os.X_OK) and not Path(path).is_dir():
            return str(Path(path).resolve())
    found = search.find("polybed")
    if not found:
        raise FileNotFoundError("there is no program polybed: build it, install it, or name it in the environment's POLYBED")
    return found


def mpirun():
    """Path of the program that starts ranks."""
    found = search.find("mpirun")
    if not found:
        raise FileNotFoundError("there is no program mpirun, which a run on several ranks needs: apt-get install openmpi-bin")
    return found


def said_by(child, label):
    """What a program says on standard error, as text; shown as it comes, behind a label, unless that is None."""
    lines = []
    for line in child.stderr:
        lines.append(line)
        if label is not None:
            with contextlib.suppress(OSError, ValueError):  # a standard error that is full or closed ends no run
                print(label + line, end="", file=sys.stderr, flush=True)
    return "".join(lines)


def call(*options, ranks=1, label=None):
    """Runs a command of the program and returns what it printed; what it says is shown behind a label, unless that is None. One that
    is interrupted, or whose caller is, ends with a checkpoint. Raises ProgramError."""
    line = [program(), *map(str, options)]
    if ranks > 1:
        line = [mpirun(), "-q", "-n", str(ranks), *line]
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(line, env=MPI | dict(os.environ, PATH=search.path()), encoding="utf-8", errors="replace", **pipes) as child, \
            ThreadPoolExecutor(1) as reader:
        try:
            printed = reader.submit(child.stdout.read)
            said = said_by(child, label)
            child.wait()
        except BaseException:
            child.terminate()
            raise
    if child.returncode != 0:
        raise ProgramError(line, child.returncode, said)
    return printed.result()


def label_of(quiet, name=""):
    """What stands before the lines that a command shows; None shows nothing."""
    return None if quiet else name and f"{name}: "


def settings(overrides, until=None):
    return words(overrides) + ([] if until is None else ["--until", str(plain(until, "until"))])


def resolved(case, overrides, until):
    """The case as the record of a run of it has it, and its hash."""
    found = json.loads(call("check", case, *settings(overrides, until), "--resolved", "--json"))
    return found["case"], found["hash"]


def finished(output, model, text):
    """Whether a folder holds a finished run by this model of this very case. What is no whole record is of no finished run."""
    try:
        record = read(output).record
    except FAULTS:
        return False
    return bool(record) and (record["state"], record["model"], record.get("case")) == ("done", model, text)


def name_of(case):
    """What a case is called: a case.toml by its folder."""
    path = Path(case).resolve()
    return path.parent.name if path.stem == "case" else path.stem


def folder_of(case, what, digest):
    """Default folder: runs/<case name>-<what>-<hash of the resolved case>, so that other overrides have another one."""
    return Path("runs") / f"{name_of(case)}-{what}-{digest}"


def made(case, model, overrides, until, ranks, label, place):
    """Opens the run that is in a folder, or makes it. place: the folder by the hash of the resolved case."""
    if model not in MODELS:
        raise ValueError(f"there is no model {model!r}; there are {', '.join(MODELS)}")
    text, digest = resolved(case, overrides, until)
    output = place(digest[:DIGITS])
    if not finished(output, model, text):
        call(model, case, *settings(overrides, until), "-o", output, "--force", "--no-picture", ranks=ranks, label=label)
    return read(output)


def run(case, model="tfm", overrides=None, output=None, until=None, ranks=1, quiet=False, label=""):
    """Runs a case by a model, "tfm" or "dem", and opens the run.

    overrides: keys of the case file with their values, {"tfm.rtol": 1e-4, "species.fine.diameter": "1 mm"}
    output: run directory, where another run is replaced, and reading that one raises ReplacedError from then on; default
        runs/<case name>-<model>-<hash of the resolved case>, so that no run replaces another
    quiet: shows no progress; label: stands before each line of it
    """
    return made(case, model, overrides, until, ranks, label_of(quiet, label),
                lambda digest: Path(output) if output else folder_of(case, model, digest))


def sweep(case, key, values, model="tfm", overrides=None, output=None, until=None, at_once=1, quiet=False):
    """Runs a case for several values of a key and returns the runs in their order, each in a folder of its own, called by the value
    and the hash of its case.

    at_once: how many run side by side
    """
    folder = Path(output) if output else Path("runs") / f"{name_of(case)}-{model}-sweep"

    def one(value):
        shown = f"{key}-{toml(plain(value, key))}".replace('"', "")[:60]
        name = "".join(c if c.isalnum() or c in ".-" else "_" for c in shown)
        return made(case, model, dict(overrides or {}) | {key: value}, until, 1, label_of(quiet, shown),
                    lambda digest: folder / f"{name}-{digest}")
    with ThreadPoolExecutor(at_once) as pool:
        return list(pool.map(one, values))


def compare(case, tfm=None, dem=None, overrides=None, output=None, until=None, page=False, quiet=False):
    """Compares both models on a case: comparison.json as a dictionary. Runs that are not given are made, or opened.

    tfm, dem: runs, or their directories
    output: default runs/<case name>-compare-<hash of the resolved case>
    page: also writes comparison.html
    """
    output = Path(output) if output else folder_of(case, "compare", resolved(case, overrides, until)[1][:DIGITS])
    options = []
    for model, given in (("tfm", tfm), ("dem", dem)):
        made = run(case, model, overrides, output / model, until, quiet=quiet, label=model) if given is None else given
        options += [f"--{model}", getattr(made, "directory", made)]
    call("compare", case, *settings(overrides, until), *options, "-o", output, *([] if page else ["--no-picture"]), label=label_of(quiet))
    return read_json(output / "comparison.json", "polybed comparison")


def inversion(case, scan=None, overrides=None, output=None, until=None, begin=None, end=None, method=None, quiet=False):
    """The inversion point: by force balance (or another method, see `polybed inversion`) without a run, or by a scan.

    scan: None, "tfm", "dem" or "both"; of a scan what inversion.json says is returned
    output: of a scan; default runs/<case name>-inversion-<hash of the resolved case>
    begin, end: velocities between which a scan begins, "30 mm/s"
    """
    options = ["inversion", case, *settings(overrides, until if scan else None), *(["--method", method] if method else [])]
    if scan is None:
        return json.loads(call(*options, "--json"))
    output = Path(output) if output else folder_of(case, "inversion", resolved(case, overrides, until)[1][:DIGITS])
    for option, velocity in (("--from", begin), ("--to", end)):
        options += [] if velocity is None else [option, velocity]
    call(*options, "--scan", scan, "-o", output, "--no-picture", label=label_of(quiet))
    return read_json(output / "inversion.json", "polybed inversion")


def calibrate(case, overrides=None, output=None, jobs=1, quiet=False):
    """Runs the boxes of a case and returns the table that they give, arrays by name with units. Finished boxes are kept: the
    same call runs none, another grid of points only what is new. Raises ProgramError, with code 3 if the table may not be used.

    overrides: keys of the case file, the axes of the table among them, {"calibrate.solids_fraction": [0.2, 0.4]}
    output: directory of table.h5 and the boxes; default runs/<case name>-calibrate
    jobs: boxes at once
    """
    output = Path(output) if output else Path("runs") / f"{name_of(case)}-calibrate"
    call("calibrate", case, *settings(overrides), "-o", output, "-j", jobs, label=label_of(quiet))
    return read_table(output / "table.h5")
