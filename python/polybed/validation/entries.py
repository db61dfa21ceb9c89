"""Folders of cases/validation, each with a bed that was measured and `validation.toml`, which says what is compared. Measured numbers come
from CSV files, a case script or the case itself."""

import importlib.util
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from statistics import NormalDist

from polybed.ending import FILE, WRONG_CASE, StudyError
from polybed.files import FormatError, contents_of, finite, read_text, rows_of
from polybed.program import cases_folder

FILE_NAME = "validation.toml"
NO_RUN = "balance"  # the model of an entry that `polybed inversion` answers without a run
MODELS = ("tfm", "dem", NO_RUN)
WAYS = ("mean", "deviation", "first_time", "meets_weight", "inversion")  # numbers.py
KEYS = {"": {"title", "source", "case", "measured", "script", "missing", "note", "seconds", "run", "compare", "set", "draw"},
        "run": {"name", "models", "set", "where", "seeds", "draw"},
        "compare": {"quantity", "unit", "how", "column", "series", "reaches", "plus", "since", "where", "value", "measured_error", "runs"}}


@dataclass
class Run:
    """One run of an entry by each of its models, or several that differ in seed and drawn inputs."""
    name: str
    models: tuple
    set: list
    where: dict  # selects rows of the measured numbers
    seeds: int = 1
    draw: dict = field(default_factory=dict)  # mean and standard deviation of inputs, by the names that `set` gives them

    def overrides(self, seed=1):
        """`set`, with the seed for {seed} and, for the names of drawn inputs, normal deviates that depend on nothing but the seed."""
        drawn = {"seed": str(seed)}
        for number, (name, (mean, deviation)) in enumerate(sorted(self.draw.items())):
            drawn[name] = f"{NormalDist(mean, deviation).inv_cdf(Random(1000 * seed + number).random()):.6g}"
        texts = list(self.set)
        for name, value in drawn.items():
            texts = [text.replace(f"{{{name}}}", value) for text in texts]
        return texts


@dataclass
class Entry:
    name: str
    folder: Path
    title: str
    source: str
    case: Path
    seconds: dict  # CPU seconds of all runs on one core, by model
    measured: Path | None = None  # CSV file
    script: Path | None = None  # of the case: series of a run, and measured ones
    missing: str = ""  # why nothing can be compared
    note: str = ""
    runs: list = field(default_factory=list)
    compares: list = field(default_factory=list)

    def compared(self, run):
        """What is compared of a run: all, but for what names other runs."""
        return [compare for compare in self.compares if run.name in compare.get("runs", [run.name])]


def folder():
    """cases/validation of the sources, or installed with the program. Raises StudyError."""
    cases = cases_folder()
    if cases is None or not (cases / "validation").is_dir():
        raise StudyError(FILE, "there is no folder cases/validation beside the program: install polybed with its cases")
    return cases / "validation"


def names():
    return sorted(path.parent.name for path in folder().glob(f"*/{FILE_NAME}"))


def check_keys(table, kind, path):
    unknown = set(table) - KEYS[kind]
    if unknown:
        raise FormatError(f"{path}: unknown key {sorted(unknown)[0]!r}{f' in [[{kind}]]' if kind else ''}; known are {', '.join(sorted(KEYS[kind]))}")


def runs_of(found, models, path):
    runs = []
    for table in found.get("run", [{}] if models else []):
        check_keys(table, "run", path)
        runs.append(Run(table.get("name", "run"), tuple(table.get("models", models)), found.get("set", []) + table.get("set", []),
                        table.get("where", {}), table.get("seeds", 1), found.get("draw", {}) | table.get("draw", {})))
    return runs


def compares_of(found, path):
    for table in found.get("compare", []):
        check_keys(table, "compare", path)
        if table["how"] not in WAYS:
            raise FormatError(f"{path}: how = {table['how']!r}; known are {', '.join(WAYS)}")
    return found.get("compare", [])


def entry_at(directory):
    """The entry of a folder. Raises FormatError or FileNotFoundError."""
    path = Path(directory) / FILE_NAME
    with contents_of(path):
        found = tomllib.loads(read_text(path))
        check_keys(found, "", path)
        seconds = found.get("seconds", {})
        if not set(seconds) <= set(MODELS):
            raise FormatError(f"{path}: models in [seconds] are {', '.join(MODELS)}")
        place = {key: (path.parent / found[key]).resolve() if key in found else None for key in ("measured", "script")}
        return Entry(path.parent.name, path.parent, found["title"], found["source"], (path.parent / found.get("case", "case.toml")).resolve(),
                     seconds, **place, missing=found.get("missing", ""), note=found.get("note", ""),
                     runs=runs_of(found, tuple(seconds), path), compares=compares_of(found, path))


def entry_named(name):
    known = names()
    if name not in known:
        raise StudyError(WRONG_CASE, f"there is no entry {name!r} in {folder()}; there are {', '.join(known)}")
    return entry_at(folder() / name)


def chosen_rows(path, where):
    """Rows of a CSV file whose columns have these values. Raises FormatError without any."""
    with contents_of(path):
        rows = [row for row in rows_of(path)
                if all((row[column] if isinstance(wanted, str) else finite(row[column])) == wanted for column, wanted in where.items())]
    if not rows:
        raise FormatError(f"{path} has no row with {', '.join(f'{column} = {wanted}' for column, wanted in where.items())}")
    return rows


def script_of(entry):
    """The module of an entry's script: `simulated(run, after)` and `measured()` return {name: (time, values)}."""
    spec = importlib.util.spec_from_file_location(f"polybed_validation_{entry.name.replace('-', '_')}", entry.script)
    if spec is None or spec.loader is None:
        raise FileNotFoundError(f"{entry.script} is missing: restore it from a copy")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
