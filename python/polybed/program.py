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

from __future__ import annotations

import contextlib
import functools
import itertools
import math
import os
import tomllib
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from polybed.ending import NUMBERS
from polybed.errors import ProgramError
from polybed.files import FAULTS, MISFITS, read_json
from polybed.overrides import Overrides, Value, plain, toml, words
from polybed.progress import BarOfRuns, put, redrawn
from polybed.read import Run, read
from polybed.runner import answer_of, call, has_checkpoint, program, side_by_side, sources
from polybed.solids_table import SolidsTable, read_table

Place = str | os.PathLike[str]  # of a file or a folder

MODELS = ("tfm", "dem")
DIGITS = 10  # of a hash in the name of a folder
STEADY = "steady"  # as `until`
LONGEST_TO_STEADY = 20  # times run.until
SAME_TIME = 1e-9  # relative difference of two times that are one


Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")


def names_itself(function: Callable[Arguments, Answer]) -> Callable[Arguments, Answer]:
    """A function whose ProgramError names it with its first argument: what the user has called, not the command behind it."""
    @functools.wraps(function)
    def called(*arguments: Arguments.args, **options: Arguments.kwargs) -> Answer:
        try:
            return function(*arguments, **options)
        except ProgramError as error:
            first = str(next(iter((*arguments, *options.values())), ""))
            raise ProgramError(error.words, error.code, error.said, f"polybed.{function.__name__}({first!r})") from None
    return called


def teller(quiet: bool, name: str = "") -> Callable[[str], None]:
    """Shows lines of a command on standard error. Of a run among others, which has a name, only progress and warnings, behind the name."""
    def tell(line: str) -> None:
        if not quiet and (not name or line.startswith(("t ", "warning"))):
            put((name and f"{name}: ") + line)
    return tell


def settings(overrides: Overrides | None, until: Value | None = None) -> list[str]:
    return words(overrides) + ([] if until is None else ["--until", str(plain(until, "until"))])


def cases_folder() -> Path | None:
    """Folder of the shipped cases: of the sources, or that installed beside the program; None without one."""
    own = [found / "cases"] if (found := sources()) else []
    tried = [*own, *(Path(program()).parents[1] / beside for beside in ("share/polybed/cases", "cases"))]
    return next((each for each in tried if each.is_dir()), None)


def case(name: str) -> Path:
    """Path of the case file of a shipped case, by the name of its folder: case("small-binary"). Raises KeyError with the names."""
    folder = cases_folder()
    names = sorted(path.parent.name for path in folder.glob("*/case.toml")) if folder else []
    if folder is None or name not in names:
        raise KeyError(f"there is no case {name!r}; there are {', '.join(names) or 'none beside the program'}")
    return folder / name / "case.toml"


def resolved(case: Place, overrides: Overrides | None, until: Value | None) -> tuple[str, str]:
    """The case as the record of a run of it has it, and its hash."""
    found = answer_of("check", case, *settings(overrides, until), "--resolved")
    return found["case"], found["hash"]


def record_in(output: Path) -> dict[str, Any]:
    """The record of the run in a folder; empty if there is no whole one."""
    try:
        return read(output).record
    except FAULTS:
        return {}


def finished(output: Path, model: str, text: str, to_steady: bool = False) -> bool:
    """Whether a folder contains a finished run by this model of this very case, which has ended at run.until, or earlier because nothing
    was left. to_steady: the run had to go on until its bed is steady instead"""
    record, until = record_in(output), tomllib.loads(text)["run"]["until"]
    with contextlib.suppress(*MISFITS):  # of a record that was edited
        if (record["state"], record["model"], record["case"]) != ("done", model, text):
            return False
        steady = (record["card"] or {}).get("steady") is True
        at_until = math.isclose(record["time_s"], until, rel_tol=SAME_TIME)
        return steady or not at_until if to_steady else at_until or (record["time_s"] < until and not steady)
    return False


def physics(text: str) -> dict[str, Any]:
    """A resolved case without its end and its output times, which may change when a run is resumed."""
    return {part: keys for part, keys in tomllib.loads(text).items() if part not in ("run", "output")}


def resumable(output: Path, model: str, text: str, to_steady: bool = False) -> bool:
    """Whether the run in a folder can continue to run.until of a resolved case: it has a checkpoint, has not failed, is by this model and of
    this case apart from `run.` and `output.` keys, and is not later than run.until already."""
    record, until = record_in(output), tomllib.loads(text)["run"]["until"] * (LONGEST_TO_STEADY if to_steady else 1)
    with contextlib.suppress(*MISFITS):
        return (has_checkpoint(output) and record["model"] == model and not record["state"].startswith("failed") and
                physics(record["case"]) == physics(text) and record["time_s"] <= until * (1 + SAME_TIME))
    return False


def name_of(case: Place) -> str:
    """What a case is called: a case.toml by its folder."""
    path = Path(case).resolve()
    return path.parent.name if path.stem == "case" else path.stem


def folder_of(case: Place, what: str, digest: str) -> Path:
    """Default folder: runs/<case name>-<what>-<hash of the resolved case>, so that other overrides have another one."""
    return Path("runs") / f"{name_of(case)}-{what}-{digest}"


@names_itself
def check(case: Place, overrides: Overrides | None = None, until: Value | None = None) -> dict[str, Any]:
    """What `polybed check --json` says of a case, without a run: in "expected" the state and the height of the bed and the velocities of
    fluidisation and of fall, named as in a run's card; steps, memory and time that a run takes, notes, and why a model refuses it."""
    return answer_of("check", case, *settings(overrides, until))


def made(case: Place, model: str, overrides: Overrides | None, until: Value | None, ranks: int,
         tell: Callable[[str], None] | None, place: Callable[[str], Path], resume: bool = False,
         keep_failed: bool = False) -> Run:
    """Opens the finished run that is in a folder, or makes it. place: the folder by the hash of the resolved case; resume: continues what is
    resumable there and begins anew otherwise; keep_failed: returns a run whose numerics failed"""
    if model not in MODELS:
        raise ValueError(f"there is no model {model!r}; there are {', '.join(MODELS)}")
    text, digest = resolved(case, overrides, until)
    output, to_steady = place(digest[:DIGITS]), until == STEADY
    if not finished(output, model, text, to_steady):
        begin = "--resume" if resume and resumable(output, model, text, to_steady) else "--force"
        try:
            call(model, case, *settings(overrides, until), "-o", output, begin, "--no-picture", ranks=ranks, tell=tell)
        except ProgramError as error:
            if not keep_failed or error.code != NUMBERS:
                raise
    return read(output)


@names_itself
def run(case: Place, model: str = "tfm", overrides: Overrides | None = None, output: Place | None = None, until: Value | None = None,
        ranks: int = 1, quiet: bool = False, label: str = "", resume: bool = False) -> Run:
    """Runs a case by a model, "tfm" or "dem", and opens the run.

    overrides: keys of the case file with their values, {"tfm.rtol": 1e-4, "species.fine.diameter": "1 mm"}
    output: run directory, where another run is replaced, and reading that one raises ReplacedError from then on; by default
    runs/<case name>-<model>-<hash of the resolved case>, so that no run replaces another
    quiet: shows no progress; label: stands before each line of it
    resume: continues from the checkpoint in the folder, as `--resume` does: after a run was killed, or with a longer `until`. The run begins
    anew, as without `resume`, if the one in the folder is by another model, differs in keys other than `run.` and `output.`, is later than
    `until` already, or has failed
    """
    return made(case, model, overrides, until, ranks, teller(quiet, label),
                lambda digest: Path(output) if output else folder_of(case, model, digest), resume)


def differing_effects(texts: Iterable[str]) -> str:
    """A warning if the program chooses other effects for some of these resolved cases than for others, with the overrides that give all of
    them the same; empty if it does not. A role that any case has is on, by the law of the first."""
    laws: dict[str, list[str]] = {}
    cases = [tomllib.loads(text) for text in texts]
    for role in sorted({role for keys in cases for role in keys.get("chooser", {}).get("chosen", [])}):
        laws[role] = [keys["effects"].get(role, "none") for keys in cases]
    laws = {role: found for role, found in laws.items() if len(set(found)) > 1}
    if not laws:
        return ""
    differ = "; ".join(f"{role}: " + ", ".join(f"{law} in {count}" for law, count in Counter(found).items()) for role, found in laws.items())
    same = {f"effects.{role}": next(law for law in found if law != "none") for role, found in laws.items()}
    return (f"the {len(cases)} runs are not of the same physics, because effects are chosen for each by itself ({differ}); "
            f"for the same effects in all of them: overrides={same}")


@names_itself
def sweep(case: Place, key: str | Mapping[str, Iterable[Value]], values: Iterable[Value] = (), model: str = "tfm",
          overrides: Overrides | None = None, output: Place | None = None, until: Value | None = None, at_once: int = 1,
          quiet: bool = False, resume: bool = False, keep_failed: bool = False) -> list[Run]:
    """Runs a case for several values of a key and returns the runs in their order, each in a folder of its own, called by the value
    and the hash of its case. With {key: values} for several keys it runs all combinations, the last key first; see polybed.table.

    values: numbers in SI, texts with a unit, or an array along its first axis; until: simulated time, "20 s" or seconds
    at_once: how many run side by side; unless quiet, a bar says how far they are, or, where standard error is no terminal and no notebook, lines
    resume: continues runs that were killed from their checkpoints, under the conditions of polybed.run; others begin anew, failed ones among
    them; finished runs are opened in any case
    keep_failed: returns also runs whose numerics failed, code 3, of which `record["state"]` says why; otherwise the first one ends the sweep
    Warns before the runs if effects that the case leaves to the program differ between them.
    """
    axes = {key: values} if isinstance(key, str) else key
    each, done = [dict(zip(axes, point)) for point in itertools.product(*map(list, axes.values()))], itertools.count(1)
    folder = Path(output) if output else Path("runs") / f"{name_of(case)}-{model}-sweep"
    bar = BarOfRuns(len(each)) if redrawn() and not quiet else None
    last = [key.rpartition(".")[2] for key in axes]
    called = {key: end if last.count(end) == 1 else key for key, end in zip(axes, last)}

    def one(number: int) -> Run:
        point = each[number]
        shown = ", ".join(f"{called[key]} {toml(plain(value, key))}" for key, value in point.items()).replace('"', "")[:100]
        name = "".join(c if c.isalnum() or c in ".-" else "_" for c in shown)
        tell = bar.hearer(number, shown) if bar else teller(quiet, shown)
        found = made(case, model, dict(overrides or {}) | point, until, 1, tell, lambda digest: folder / f"{name}-{digest}", resume, keep_failed)
        if bar:
            bar.finish(number)
        else:
            teller(quiet)(f"{next(done)} of {len(each)} runs done: {shown}\n")
        return found
    with side_by_side(at_once) as pool:
        texts = pool.map(lambda point: resolved(case, dict(overrides or {}) | point, until)[0], each)
        if differ := differing_effects(texts):
            warnings.warn(differ, stacklevel=3)  # at the caller of sweep
        return list(pool.map(one, range(len(each))))


@names_itself
def compare(case: Place, tfm: Run | Place | None = None, dem: Run | Place | None = None, overrides: Overrides | None = None,
            output: Place | None = None, until: Value | None = None, page: bool = False, quiet: bool = False) -> dict[str, Any]:
    """Compares both models on a case: comparison.json as a dictionary. Runs that are not given are made, or opened.

    tfm, dem: runs, or their directories
    output: default runs/<case name>-compare-<hash of the resolved case>
    page: also writes comparison.html
    """
    output = Path(output) if output else folder_of(case, "compare", resolved(case, overrides, until)[1][:DIGITS])
    options: list[object] = []
    for model, given in (("tfm", tfm), ("dem", dem)):
        made = run(case, model, overrides, output / model, until, quiet=quiet, label=model) if given is None else given
        options += [f"--{model}", getattr(made, "directory", made)]
    call("compare", case, *settings(overrides, until), *options, "-o", output, *([] if page else ["--no-picture"]), tell=teller(quiet))
    return read_json(output / "comparison.json", "polybed comparison")


@names_itself
def inversion(case: Place, scan: str | None = None, overrides: Overrides | None = None, output: Place | None = None,
              until: Value | None = None, begin: Value | None = None, end: Value | None = None, method: str | None = None,
              quiet: bool = False) -> dict[str, Any]:
    """The inversion point: by force balance (or another method, see `polybed inversion`) without a run, or by a scan.

    scan: None, "tfm", "dem" or "both"; of a scan what inversion.json says is returned
    output: of a scan; default runs/<case name>-inversion-<hash of the resolved case>
    begin, end: velocities between which a scan begins, "30 mm/s"
    """
    options: list[object] = ["inversion", case, *settings(overrides, until if scan else None), *(["--method", method] if method else [])]
    if scan is None:
        return answer_of(*options)
    output = Path(output) if output else folder_of(case, "inversion", resolved(case, overrides, until)[1][:DIGITS])
    for option, velocity in (("--from", begin), ("--to", end)):
        options += [] if velocity is None else [option, plain(velocity, option)]
    call(*options, "--scan", scan, "-o", output, "--no-picture", tell=teller(quiet))
    return read_json(output / "inversion.json", "polybed inversion")


@names_itself
def calibrate(case: Place, overrides: Overrides | None = None, output: Place | None = None, jobs: int = 1,
              quiet: bool = False) -> SolidsTable:
    """Runs the boxes of a case and returns the table that they give, arrays by name with units. Finished boxes are kept: the
    same call runs none, another grid of points only what is new. Raises ProgramError, with code 3 if the table may not be used.

    overrides: keys of the case file, the axes of the table among them, {"calibrate.solids_fraction": [0.2, 0.4]}
    output: directory of table.h5 and the boxes; default runs/<case name>-calibrate
    jobs: boxes at once
    """
    output = Path(output) if output else Path("runs") / f"{name_of(case)}-calibrate"
    call("calibrate", case, *settings(overrides), "-o", output, "-j", jobs, tell=teller(quiet))
    return read_table(output / "table.h5")
