"""Functions that run the program: a check, one run, a sweep, a comparison of both models, a scan for the inversion velocity, a calibration."""

from __future__ import annotations

import contextlib
import functools
import itertools
import math
import os
import re
import tomllib
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from numbers import Integral
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from polybed.checks import Check
from polybed.ending import NUMBERS, WRONG_CASE
from polybed.errors import ArgumentError, ProgramError
from polybed.files import FAULTS, MISFITS, read_json
from polybed.overrides import Overrides, Value, flat, plain, toml
from polybed.progress import BarOfRuns, put
from polybed.quantities import unknown
from polybed.read import Run, read
from polybed.runner import answer_of, call, has_checkpoint, program, side_by_side, sources
from polybed.solids_table import SolidsTable, read_table

Place = str | os.PathLike[str]  # of a file or a folder

MODELS = ("tfm", "dem")
DIGITS = 10  # of a hash in the name of a folder
STEADY = "steady"  # as `until`
SAME_TIME = 1e-9  # relative difference of two times that are one


Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")


# Options of the command line as arguments of the functions, in what the program says.
IN_PYTHON = {"--set ": "overrides: ", "--until": "until", "--force": "force=True", "-o DIR": "output", "-o names": "output names"}


def names_itself(function: Callable[Arguments, Answer]) -> Callable[Arguments, Answer]:
    """A function whose ProgramError names it with its first argument and its own arguments: what the user typed."""
    @functools.wraps(function)
    def called(*arguments: Arguments.args, **options: Arguments.kwargs) -> Answer:
        try:
            return function(*arguments, **options)
        except ProgramError as error:
            first = str(next(iter((*arguments, *options.values())), ""))
            said = re.sub(r"(?<=--set )(\S+): (?=\1\b)", "", error.said)  # a key twice
            said = functools.reduce(lambda text, pair: text.replace(*pair), IN_PYTHON.items(), said)
            said += f'\nthe shipped case is polybed.case("{first}")' if first in shipped() and not Path(first).exists() else ""
            raise ProgramError(error.words, error.code, said, f"polybed.{function.__name__}({first!r})") from None
    return called


def teller(quiet: bool, name: str = "") -> Callable[[str], None]:
    """Shows lines of a command on standard error. Of a run among others, which has a name, only progress and warnings, behind the name."""
    def tell(line: str) -> None:
        if not quiet and (not name or line.startswith(("t ", "warning"))):
            put((name and f"{name}: ") + line)
    return tell


def settings(overrides: Overrides | None, until: Value | None = None) -> list[str]:
    """The options of the command line that say the same."""
    words = [word for key, value in flat(overrides) for word in ("--set", f"{key}={toml(value)}")]
    return words + ([] if until is None else ["--until", str(plain(until, "until"))])


def cases_folder() -> Path | None:
    """Folder of the shipped cases: of the sources, or that installed beside the program; None without one."""
    own = [found / "cases"] if (found := sources()) else []
    tried = [*own, *(Path(program()).parents[1] / beside for beside in ("share/polybed/cases", "cases"))]
    return next((each for each in tried if each.is_dir()), None)


def shipped() -> dict[str, Path]:
    """The case files of shipped cases and templates by name."""
    folder = cases_folder() or Path("cases")
    return {path.parent.name: path for pattern in ("templates/*/case.toml", "*/case.toml") for path in sorted(folder.glob(pattern))}


def case(name: str) -> Path:
    """Path of the case file of a shipped case or a template: case("small-binary"), case("liquid-bed"). Raises KeyError with the names.
    overrides can replace all that such a case describes, {"species": [{"name": "sand", "diameter": "1 mm", "density": 2650}, ...]}."""
    if name not in (found := shipped()):
        raise unknown(cases_folder(), name, sorted(found))
    return found[name]


def resolved(case: Place, words: list[str]) -> tuple[str, str]:
    """The case with these options as the record of a run of it has it, and its hash."""
    found = answer_of("check", case, *words, "--resolved")
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


def later(output: Path, model: str, text: str) -> float | None:
    """Time of the run in a folder if that is beyond run.until of a resolved case, and the run is by this model and of this case apart from
    `run.` and `output.` keys; None otherwise."""
    record, ours = record_in(output), tomllib.loads(text)
    with contextlib.suppress(*MISFITS):
        theirs = tomllib.loads(record["case"])
        same = record["model"] == model and all(theirs[part] == ours[part] for part in {*theirs, *ours} - {"run", "output"})
        return float(record["time_s"]) if same and record["time_s"] > ours["run"]["until"] * (1 + SAME_TIME) else None
    return None


def name_of(case: Place) -> str:
    """What a case is called: a case.toml by its folder."""
    path = Path(case).resolve()
    return path.parent.name if path.stem == "case" else path.stem


def folder_of(output: Place | None, case: Place, what: str, digest: str) -> Path:
    """output, or runs/<case name>-<what>-<hash of the resolved case>, so that other overrides have another folder."""
    return Path(output) if output else Path("runs") / f"{name_of(case)}-{what}-{digest[:DIGITS]}"


def study_folder(output: Place | None, case: Place, what: str, words: list[str]) -> Path:
    """Likewise for the case with these options."""
    return Path(output) if output else folder_of(None, case, what, resolved(case, words)[1])


def options_of(**values: Value) -> list[object]:
    """Those of these options that have a value, as words of the command line."""
    return [word for name, value in values.items() if value is not None for word in (f"--{name.strip('_')}", plain(value, name))]


@names_itself
def check(case: Place, overrides: Overrides | None = None, until: Value | None = None) -> Check:
    """What to expect of a case, without a run. Printed, and shown by a notebook, it is the text of `polybed check`.

    Returns the dictionary of `polybed check --json` with the answers first, in SI units named as in a run's card:
    "expected": "state" ("packed", "fluidised", "partly_fluidised", "carried_up"), "bed_height_m", "u_mf_m_s", "terminal_m_s" and
    others; "expansion" has the velocities at which the bed stands a share of 0.1, 0.3 and 0.5 higher than settled. See polybed.table for other velocities.
    "notes": warnings; "refused": why a model does not run it, empty if it does; "time" of computing; ...; "case": all keys, resolved
    """
    return Check(answer_of("check", case, *settings(overrides, until)))


def made(case: Place, model: str, words: list[str], known: tuple[str, str], ranks: int, tell: Callable[[str], None], output: Path,
         resume: bool = False, keep_failed: bool = False) -> Run:
    """Opens the finished run that is in a folder, or makes it. words: options of the case; known: what `resolved` says of them; resume:
    continues from the checkpoint there, of a run that has not failed; keep_failed: returns a run whose numerics failed"""
    text, to_steady = known[0], STEADY in words[-1:]
    if finished(output, model, text, to_steady):
        return read(output)
    there = record_in(output)
    goes_on = resume and has_checkpoint(output) and not str(there.get("state")).startswith("failed")
    if goes_on and there.get("model", model) != model:
        raise ArgumentError(f"{output} contains a run by {there['model']}: name another output, or leave out resume to replace it")
    if goes_on and not to_steady and (time := later(output, model, text)):
        tell(f"warning: {output} contains this run up to {time:g} s already, beyond `until`: opened as it is\n")
        return read(output)
    try:
        call(model, case, *words, "-o", output, "--resume" if goes_on else "--force", "--no-picture", ranks=ranks, tell=tell)
    except ProgramError as error:
        if not keep_failed or error.code != NUMBERS:
            raise
    return read(output)


def must_be_right(model: Any, **counts: Any) -> None:
    if model not in MODELS:
        hint = "; keys of the case are overrides=" if isinstance(model, Mapping) else ""
        raise ArgumentError(f"there is no model {model!r}; there are {', '.join(MODELS)}{hint}")
    for name, count in counts.items():
        if not isinstance(count, Integral) or count < 1:
            raise ArgumentError(f"{name} = {count!r}: a whole number from 1 on")


@names_itself
def run(case: Place, model: str = "tfm", overrides: Overrides | None = None, output: Place | None = None, until: Value | None = None,
        ranks: int = 1, quiet: bool = False, label: str = "", resume: bool = False) -> Run:
    """Runs a case by a model, "tfm" or "dem", and opens the run.

    overrides: keys of the case file with their values, {"tfm.rtol": 1e-4, "species.fine.diameter": "1 mm"}
    output: run directory, where another run is replaced, and reading that one raises ReplacedError from then on; by default
    runs/<case name>-<model>-<hash of the resolved case>, so that no run replaces another
    quiet: shows no progress; label: stands before each line of it
    resume: continues from the checkpoint in the folder: after a run was killed, or in the same `output` with a longer `until`. A run there
    that is later than `until` already is opened, one that failed begins anew, and one of another case or model raises ProgramError
    """
    must_be_right(model, ranks=ranks)
    words = settings(overrides, until)
    known = resolved(case, words)
    place = folder_of(output, case, model, known[1])
    if resume and not has_checkpoint(place):
        teller(quiet, label)(f"warning: {place} has no run to continue: it begins at 0 s\n")
    return made(case, model, words, known, ranks, teller(quiet, label), place, resume)


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
def sweep(case: Place, key: str | Mapping[str, Iterable[Value]], values: Iterable[Value] | None = None, model: str = "tfm",
          overrides: Overrides | None = None, output: Place | None = None, until: Value | None = None, at_once: int = 1,
          quiet: bool = False, resume: bool = False, keep_failed: bool = False) -> list[Run]:
    """Runs a case for several values of a key and returns the runs in their order, each in a folder of its own, called by the value
    and the hash of its case. With {key: values} for several keys it runs all combinations, the last key first; see polybed.table.

    values: numbers in SI, texts with a unit, or an array along its first axis; until: simulated time, "20 s" or seconds. All cases are
    checked before the first one runs.
    at_once: how many run side by side; unless quiet, a bar says how far they are, or, where standard error is no terminal and no notebook, lines
    resume: continues killed runs, as in polybed.run; failed runs begin anew; finished runs are opened in any case
    keep_failed: returns also runs whose numerics failed, code 3, of which `record["state"]` says why; otherwise the first one ends the sweep
    Warns before the runs if effects that the case leaves to the program differ between them.
    """
    must_be_right(model, at_once=at_once)
    if values is not None and not isinstance(key, str):
        raise ArgumentError("a sweep over {key: values} has all its values there: leave out the list behind it")
    axes = {key: () if values is None else values} if isinstance(key, str) else key
    lists = [list(each) if isinstance(each, Iterable) and not isinstance(each, str) else [each] for each in axes.values()]
    each = [dict(zip(axes, point)) for point in itertools.product(*lists)]
    if not axes or not each:
        raise ArgumentError(f"a sweep needs values for {' and '.join(axes) or 'a key'}")
    folder = Path(output) if output else Path("runs") / f"{name_of(case)}-{model}-sweep"
    words = [settings(dict(overrides or {}) | point, until) for point in each]
    bar = BarOfRuns(len(each), quiet)
    last = [key.rpartition(".")[2] for key in axes]
    called = {key: end if last.count(end) == 1 else key for key, end in zip(axes, last)}

    def one(number: int, known: tuple[str, str]) -> Run:
        shown = ", ".join(f"{called[key]} {toml(plain(value, key))}" for key, value in each[number].items()).replace('"', "")[:100]
        name = "".join(c if c.isalnum() or c in ".-" else "_" for c in shown)
        place = folder / f"{name}-{known[1][:DIGITS]}"
        found = made(case, model, words[number], known, 1, bar.hearer(number, shown), place, resume, keep_failed)
        bar.finish(number, shown)
        return found
    with side_by_side(at_once) as pool:
        known = list(pool.map(lambda more: resolved(case, more), words))
        for number, this in enumerate(known):
            if (first := known.index(this)) < number:
                raise ArgumentError(f"{each[first]} and {each[number]} are the same case: leave out one")
        if differ := differing_effects(text for text, _ in known):
            warnings.warn(differ, stacklevel=3)  # at the caller of sweep
        return list(pool.map(one, range(len(each)), known))


@names_itself
def compare(case: Place, tfm: Run | Place | None = None, dem: Run | Place | None = None, overrides: Overrides | None = None,
            output: Place | None = None, until: Value | None = None, page: bool = False, quiet: bool = False) -> dict[str, Any]:
    """Compares both models on a case: comparison.json as a dictionary. Runs that are not given are made, or opened.

    tfm, dem: runs, or their directories
    output: default runs/<case name>-compare-<hash of the resolved case>
    page: also writes comparison.html
    """
    words = settings(overrides, until)
    checked = answer_of("check", case, *words)
    output = folder_of(output, case, "compare", checked["hash"])
    given = {model: one if isinstance(one, Run) else read(one) for model, one in (("tfm", tfm), ("dem", dem)) if one is not None}
    if refused := [why for model in MODELS if model not in given for why in checked["refused"][model]]:
        raise ProgramError([], WRONG_CASE, "\n".join(refused))
    runs = {model: given.get(model) or run(case, model, overrides, output / model, until, quiet=quiet, label=model) for model in MODELS}
    words += [word for model, one in runs.items() for word in (f"--{model}", str(one.directory))]
    call("compare", case, *words, "-o", output, *([] if page else ["--no-picture"]), tell=teller(quiet))
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
    words = settings(overrides, until if scan else None)
    if scan is None:
        return answer_of("inversion", case, *words, *options_of(method=method))
    output = study_folder(output, case, "inversion", words)
    call("inversion", case, *words, *options_of(method=method, from_=begin, to=end, scan=scan), "-o", output, "--no-picture", tell=teller(quiet))
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
