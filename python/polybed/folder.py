"""The folder of a run, which another run can replace while it is read, and what its run.json says of the case."""

import tomllib
from pathlib import Path

from polybed.errors import MissingError
from polybed.files import DamagedError, ReplacedError, contents_of, read_json

# Any of them makes a run directory; an empty one belongs to a run that starts.
CONTENTS = {".polybed", "run.json", "history.csv", "fields.h5", "profiles.h5", "particles.h5"}


def runs_in(folder):
    """The run directories in a folder, by their names."""
    return sorted(path.parent for path in Path(folder).glob("*/run.json"))


class RunFolder:
    """A run directory that hands out the paths of its files as long as it contains the run that was opened: the one
    of the model and of the resolved case that run.json names. A continuation can change keys of `run` and `output`."""

    def __init__(self, directory):
        self.path = Path(directory)
        names = {path.name for path in self.path.iterdir()} if self.path.is_dir() else {""}
        if names and not names & CONTENTS:
            raise MissingError(f"{directory} is no run directory; it contains {'some: use polybed.table' if runs_in(self.path) else 'none'}"
                               if self.path.is_dir() else f"{directory}: no such run directory")
        self._record, self._stamp, self._first = {}, None, None
        self.record()

    def record(self):
        """run.json as a dictionary; empty if there is none yet. Raises ReplacedError."""
        path = self.path / "run.json"
        if not path.exists():
            return {}
        status = path.stat()
        stamp = (status.st_mtime_ns, status.st_ino, status.st_size)
        if stamp != self._stamp:
            found = read_record(path)
            first = self._first = self._first or found
            if first["case_hash"] != found["case_hash"] and lasting(first) != lasting(found) or first["model"] != found["model"]:
                raise ReplacedError(f"{self.path} held a run by {first['model']} of the case {first['case_hash']} and now holds another, by "
                                    f"{found['model']} of {found['case_hash']}: open it again with polybed.read, and give each run a folder of its own")
            self._record, self._stamp = found, stamp
        return self._record

    def file(self, *names):
        """Path of a file of the run, there or not. Raises ReplacedError."""
        self.record()
        return self.path.joinpath(*names)


def read_record(path):
    """The contents of run.json, which always has model, state and hash of the case as texts, and what each invariant came to."""
    record = read_json(path, "polybed run")
    with contents_of(path):
        for key in ("model", "state", "case_hash"):
            if not isinstance(record[key], str):
                raise TypeError(f"{key} is no text")
        for entry in record.get("invariants", []):
            for key, kind in (("name", str), ("worst", (int, float)), ("limit", (int, float))):
                if not isinstance(entry[key], kind):
                    raise TypeError(f"{key} of an invariant is {entry[key]!r}")
    return record


def case_of(record):
    """The resolved case of a record as a dictionary; empty if it has none. Raises DamagedError."""
    try:
        return tomllib.loads(record.get("case") or "")
    except (tomllib.TOMLDecodeError, TypeError, AttributeError) as error:
        raise DamagedError("the case in run.json", error) from error


def lasting(record):
    """What no continuation of a run changes: its case without the keys of `run` and `output`, and its drag law."""
    return {part: keys for part, keys in case_of(record).items() if part not in ("run", "output")} or record["case_hash"], record.get("drag_law")


def drift_lines(record):
    """What a run still drifts by at its end, a line each: the slope is certain, and matters (docs/reference/measures.md)."""
    try:
        return list(record.get("drift", {}).get("lines", []))
    except (AttributeError, TypeError) as error:
        raise DamagedError("the drift in run.json", error) from error


def title_of_case(record):
    """The title that the case gives itself; empty without one, or where the case cannot be read."""
    try:
        title = case_of(record).get("title", "")
    except DamagedError:
        return ""
    return title if isinstance(title, str) else ""


def velocity_of(case):
    """The last superficial velocity of the inlet, m/s; None without one, and of several side by side."""
    rows = case.get("inlet", {}).get("superficial_velocity")
    if isinstance(rows, (int, float)):
        return float(rows)
    try:
        return float(rows[-1][1])
    except (TypeError, IndexError, ValueError):
        return None
