"""Opens files to read, here alone: regular ones, of polybed's of the right kind and version; a damaged one is named in one line."""

import contextlib
import csv
import io
import json
import math
import os
import re
import stat
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from polybed.errors import MissingError, PlainError, UnknownNameError

VERSION = 1  # of every kind of file


class FormatError(PlainError):
    """A file is of a kind or a version that this package does not know, or it is damaged."""


class DamagedError(FormatError):
    """A file lacks what a file of its kind contains."""

    def __init__(self, path, what):
        super().__init__(f"{path} is damaged: {' '.join(str(what).split())}; make it again with polybed, or restore it from a copy")


class ReplacedError(PlainError):
    """A folder contains another run than the one that was opened."""


# What a command tells in one line.
FAULTS = (FormatError, ReplacedError, UnknownNameError, OSError)
# What reading contents that are not as they should be can raise.
MISFITS = (KeyError, IndexError, TypeError, ValueError, AttributeError, ArithmeticError, MemoryError, RecursionError, RuntimeError)


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
    if found != (filetype, VERSION):
        raise FormatError(f"{path} is '{found[0]}' version {found[1]}; this package reads '{filetype}' version {VERSION}")


def opened(path):
    """A file to read its bytes. Raises FileNotFoundError, or FormatError for a folder, a pipe or a device, which can block for ever."""
    try:
        number = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except FileNotFoundError as error:
        raise MissingError(f"{path} is missing: there is no such file") from error
    mode = os.fstat(number).st_mode
    if stat.S_ISREG(mode):
        return os.fdopen(number, "rb")
    os.close(number)
    raise FormatError(f"cannot read {path}: it is no regular file, but {'a folder' if stat.S_ISDIR(mode) else 'a pipe or a device'}")


def read_text(path, errors="strict"):
    with io.TextIOWrapper(opened(path), encoding="utf-8", errors=errors) as file, contents_of(path):
        return file.read()


def read_bytes(path):
    with opened(path) as file:
        return file.read()


def whole_lines(path):
    """The lines of a text file that end, without their ends: what follows the last end can be cut short."""
    return read_text(path).split("\n")[:-1]


def rows_of(path):
    """Rows of a CSV file as dictionaries of texts; lines that begin with # are comments."""
    return list(csv.DictReader(line for line in read_text(path).splitlines() if line and not line.startswith("#")))


def finite(text):
    """The number that a text is; raises ValueError unless it is finite."""
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is no finite number")
    return value


def read_json(path: str | os.PathLike[str], filetype: str) -> dict[str, Any]:
    """The contents of a JSON file, a dictionary, if the file is what it should be."""
    with contents_of(path):
        found = json.loads(read_text(path))
        if not isinstance(found, dict):
            raise TypeError("it holds no JSON object")
    check_kind(found, filetype, path)
    return found


class Group(Mapping):
    """A group of an HDF5 file. Links and external numbers raise ValueError: HDF5 follows them to any file that the user can read."""

    def __init__(self, group):
        self._group, self.attrs = group, group.attrs

    def __getitem__(self, name):
        first, _, rest = name.partition("/")
        if rest:
            return self[first][rest]
        link = self._group.get(name, getlink=True)
        if link is None:
            raise KeyError(name)
        if not isinstance(link, h5py.HardLink):
            raise ValueError(f"{name} is a link to another place: only what the file itself contains is read")
        found = self._group[name]
        if isinstance(found, h5py.Group):
            return Group(found)
        if isinstance(found, h5py.Dataset) and (found.external or found.is_virtual):
            raise ValueError(f"the numbers of {name} are in another file: only what the file itself contains is read")
        return found

    def __iter__(self):
        return iter(self._group)

    def __len__(self):
        return len(self._group)


@contextlib.contextmanager
def open_hdf5(path, filetype):
    """An HDF5 file to read, of a kind, as a Group. The lines within do nothing but read it."""
    path = Path(path)
    opened(path).close()
    try:
        with contents_of(path), h5py.File(path, "r") as file:
            check_kind(file.attrs, filetype, path)
            yield Group(file)
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


@contextlib.contextmanager
def in_place(path, ending=".temporary"):
    """The path to write under a temporary name in the same folder, which is then flushed to the disk and renamed. It is new: a link that has
    its name, in a folder that others can write, is removed and not followed."""
    temporary = path.with_name(path.name + ending)
    temporary.unlink(missing_ok=True)
    os.close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o666))
    try:
        yield temporary
        with open(temporary, "rb") as written:
            os.fsync(written)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def put_text(path, text, errors="strict"):
    """Puts a text file in place whole and returns its path."""
    with in_place(path) as temporary:
        temporary.write_text(text, encoding="utf-8", errors=errors)
    return path
