"""Commands that read a run or make a study, as functions; `polybed.compare` and `polybed.inversion` are in polybed.program."""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from polybed.checks import Check
from polybed.files import read_json
from polybed.folder import RunFolder, runs_in
from polybed.overrides import Overrides, Value
from polybed.program import Place, names_itself, options_of, settings, study_folder, teller
from polybed.read import Run, read
from polybed.runner import answer_of, call


@names_itself
def measure(run: Run | Place) -> dict[str, Any]:
    """Numbers read off the stored profiles of a run, without a run: what `polybed measure RUN --json` prints.

    run: a run, or its directory
    Returns {"time_s": [...], "measures": {name: {"unit", "help", "values"}}}: lists over the stored times, None where a measure
    has no value; "window" and "in_window", means over its last part. Raises ProgramError, FileNotFoundError.
    """
    return answer_of("measure", run.directory if isinstance(run, Run) else RunFolder(run).path)


def table(runs: Iterable[Run | Check | Place] | Run | Check | Place) -> Any:
    """Runs as a pandas.DataFrame with a row each: the keys in which their cases differ, the model if there are both, the state of the run,
    and its card, what differs first. The unit ends a column's name; NAME_interval is half of the 95 % interval of the mean NAME.

    runs: runs, or their directories, as `polybed.sweep` returns them; a folder stands for the runs directly in it; also a single one. Answers of
    polybed.check have what they expect in the row of a model "check": [polybed.check(case, {key: value}) for value in values]
    """
    from polybed import frames
    each = [runs] if isinstance(runs, Run | Check | str | os.PathLike) else list(runs)
    opened = [[one] if isinstance(one, Run | Check) else list(map(read, runs_in(Path(one)) or [one])) for one in each]
    return frames.table(itertools.chain(*opened))


@names_itself
def cost(case: Place, model: str | None = None, axes: tuple[str, ...] = (), target: str | None = None, budget: str | None = None,
         overrides: Overrides | None = None, output: Place | None = None, until: Value | None = None, picture: bool = False,
         quiet: bool = False) -> dict[str, Any]:
    """Measures error against computing time over the settings of a case: what `polybed cost CASE` finds.

    model: "tfm", "dem", or None for what the command takes by default
    axes: settings that are varied, ("rtol", "grid", "drag"); target: error, "1%"; budget: wall time, "20min"
    output: default runs/<case name>-cost-<hash of the resolved case>; a sweep that stands there goes on where it ended
    Returns cost.json as a dictionary: errors relative, times in seconds. Raises ProgramError.
    """
    words = settings(overrides, until)
    folder = study_folder(output, case, "cost", words)
    again = ["--resume"] if (folder / "cost.json").exists() else []
    call("cost", case, *words, "-o", folder, *options_of(model=model, axes=",".join(axes) or None, target=target, budget=budget), *again,
         *([] if picture else ["--no-picture"]), tell=teller(quiet))
    return read_json(folder / "cost.json", "polybed cost")


@names_itself
def fit(rows: Place | Sequence[Place], form: str = "brinkman_oseen", output: Place | None = None, bootstrap: int = 100, seed: int = 1,
        force: bool = False, picture: bool = False, quiet: bool = False) -> dict[str, Any]:
    """Fits a drag law to rows of resolved flow and writes its law file: what `polybed fit ROWS` finds.

    rows: one table or several, of `polybed resolve` or of tests/data/lbm; of a folder its tab_A_*.csv
    form: "cello" or "brinkman_oseen"; bootstrap: draws for the intervals of the constants, from the number seed
    output: default runs/<name of the rows>-fit; the same fit of the same rows is opened there, another one is replaced only with force
    Returns fit.json as a dictionary: "law" is the path of the law file, for {"effects.drag": "file:<law>"}; "constants" without unit,
    "interval" their 95 % intervals, "errors" in per cent of the force, "band" relative. Raises ProgramError, with code 3 if the law
    that was written breaks a constraint.
    """
    tables = [Path(one) for one in ([rows] if isinstance(rows, str | os.PathLike) else rows)]
    name = tables[0].stem if len(tables) == 1 else tables[0].parent.name or "rows"
    found = Path(output or f"runs/{name}-fit") / "fit.json"
    if not force and found.exists():
        there, files = read_json(found, "polybed drag fit"), [file for one in tables for file in (one, *one.glob("tab_A_*.csv"))]
        asked = {"rows": list(map(str, tables)), "form": form, "bootstrap": bootstrap, "seed": seed}
        if asked.items() <= there.items() and all(file.stat().st_mtime < found.stat().st_mtime for file in files if file.exists()):
            return there
    options = options_of(form=form, bootstrap=bootstrap, seed=seed, output=output)
    flags = (("--force", force), ("--no-picture", not picture), ("--quiet", quiet))
    return answer_of("fit", *tables, *options, *(flag for flag, wanted in flags if wanted), tell=teller(quiet))
