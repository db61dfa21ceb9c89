"""Files of polybed as they are opened: their kind and version are checked, and a damaged one is named in one line."""

import contextlib
import json
import re
import sys
from pathlib import Path

import h5py
import numpy as np

from polybed.packages import NO_FILE

VERSIONS = {
    "polybed fields": 1,
    "polybed fields step": 1,
    "polybed particles": 1,
    "polybed particles step": 1,
    "polybed profiles": 1,
    "polybed solids table": 1,
    "polybed run": 1,
    "polybed comparison": 1,
    "polybed inversion": 1,
    "polybed cost": 1,
    "polybed stability": 1,
}


class FormatError(Exception):
    """A file is of a kind or a version that this package does not know, or it is damaged."""


class DamagedError(FormatError):
    """A file does not hold what a file of its kind holds."""

    def __init__(self, path, what):
        super().__init__(f"{path} is damaged: {' '.join(str(what).split())}; make it again with polybed, or restore it from a copy")


class ReplacedError(Exception):
    """A folder holds another run than the one that was opened."""


# What a command tells in one line.
FAULTS = (FormatError, ReplacedError, OSError)
# What taking apart something that does not hold what it should may raise.
MISFITS = (KeyError, IndexError, TypeError, ValueError, AttributeError, ArithmeticError, MemoryError, RecursionError, RuntimeError)


def print_made(make):
    """Prints the paths of the files that `make` makes, or what is wrong with those it reads; returns the exit code."""
    try:
        print(*make(), sep="\n")
    except FAULTS as error:
        print(error, file=sys.stderr)
        return NO_FILE
    return 0


def reason(error):
    """What an exception says of a file, for people."""
    if isinstance(error, KeyError):
        missing = re.search("object '(.*)' doesn't exist", str(error))  # as h5py says it
        return f"it lacks {missing[1] if missing else error.args[0]}"
    return str(error) or type(error).__name__


@contextlib.contextmanager
def contents_of(path):
    """Around lines that take the contents of a file apart: what does not fit is raised as DamagedError of that file."""
    try:
        yield
    except MISFITS as error:
        raise DamagedError(path, reason(error)) from error


def check_kind(attributes, filetype, path):
    """Raises FormatError unless a file is what it should be."""
    found = (attributes.get("filetype"), attributes.get("version"))
    if found[0] != filetype or found[1] != VERSIONS[filetype]:
        raise FormatError(
            f"{path} is '{found[0]}' version {found[1]}; this package reads '{filetype}' version {VERSIONS[filetype]}"
        )


def check_regular(path):
    """Raises unless a path is that of a file: FileNotFoundError, or DamagedError of a folder, a pipe or a device."""
    if not path.exists():
        raise FileNotFoundError(f"{path} is missing: make it again with polybed, or restore it from a copy")
    if not path.is_file():
        kind = "a folder" if path.is_dir() else "a pipe or a device"
        raise DamagedError(path, f"it is no regular file, but {kind}")


def read_text(path):
    """The text of a file."""
    check_regular(path)
    with contents_of(path):
        return path.read_text(encoding="utf-8")


def read_json(path, filetype):
    """What a JSON file holds, a dictionary, if the file is what it should be."""
    with contents_of(path):
        found = json.loads(read_text(path))
        if not isinstance(found, dict):
            raise TypeError("it holds no JSON object")
    check_kind(found, filetype, path)
    return found


@contextlib.contextmanager
def open_hdf5(path, filetype):
    """An HDF5 file to read, of a kind. The lines within do nothing but read it."""
    path = Path(path)
    check_regular(path)
    try:
        with contents_of(path), h5py.File(path, "r") as file:
            check_kind(file.attrs, filetype, path)
            yield file
    except FormatError:
        raise
    except OSError as error:  # h5py's, of what HDF5 cannot read
        raise DamagedError(path, error) from error


def fits(values, shape, name):
    """Values that have the shape that the rest of their file, or of their run, gives them; raises ValueError else."""
    if values.shape != shape or values.dtype.kind not in "iuf":
        raise ValueError(f"{name} has shape {values.shape} and type {values.dtype} in place of numbers of shape {shape}")
    return values


def whole(values, name):
    """Whole numbers, as such; raises ValueError for others."""
    if values.dtype.kind not in "iuf" or not (np.abs(values) < 2**53).all() or (values != np.floor(values)).any():
        raise ValueError(f"{name} holds no whole numbers")
    return values.astype(np.int64)


def rising(values, name):
    """Places or times, which rise; raises ValueError else."""
    if values.ndim != 1 or values.dtype.kind not in "iuf" or not np.isfinite(values).all() or not (np.diff(values) > 0).all():
        raise ValueError(f"{name} does not rise")
    return values
