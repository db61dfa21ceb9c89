"""A run directory as an object: fields, particles, profiles and history by name, as NumPy arrays.

Nothing is read before it is asked for, and a run that is still going on can be read: each file is whole.
"""

from __future__ import annotations

import difflib
import functools
import os
from collections.abc import Iterable
from itertools import count, takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from polybed import quantities
from polybed.errors import NoFieldError, NoStepError
from polybed.files import DamagedError, contents_of, finite, fits, open_hdf5, rising, whole_lines
from polybed.folder import RunFolder
from polybed.packages import plain
from polybed.particles import Particles, nearest

if TYPE_CHECKING:
    import xarray


class Series:
    """One field over all stored steps: series[-1] is the last array, series[2:5] a list made one array."""

    def __init__(self, run, name):
        self._run, self._name = run, name

    def __len__(self):
        return len(self._run.time)

    def __getitem__(self, step):
        if isinstance(step, slice):
            return np.array([self[n] for n in range(*step.indices(len(self)))])
        return self._run.fields_at(step, [self._name])[self._name]


def kinds_among(names: list[str]) -> dict[str, list[str]]:
    """Species, each with its size classes, found by their names: name.1, name.2, ..."""
    found: dict[str, list[str]] = {}
    for name in names:
        whole = name.rpartition(".")[0]
        classes = list(takewhile(names.__contains__, (f"{whole}.{n}" for n in count(1))))
        is_class = whole not in names and len(classes) > 1 and name in classes
        found.setdefault(whole if is_class else name, []).append(name)
    return found


def sums_among(names: Iterable[str]) -> dict[str, list[str]]:
    """Volume fractions of species with size classes, each with those of its classes: {"phi_sand": ["phi_sand.1", "phi_sand.2"]}."""
    found = kinds_among([name for name in names if name.startswith("phi_")])
    return {whole: parts for whole, parts in found.items() if len(parts) > 1}


class Run:
    """A run directory: run.card has the results, run.frame() the history, run.dataset() the fields, run.names() the names for run.quantity().
    Fields are also attributes: run.voidage[-1] is the last one stored, [y][x]. The stored times are those at the first look at them: open a
    run that goes on again with polybed.read for later ones."""

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self._folder = RunFolder(directory)
        self._kept: dict[str, Any] = {}
        self._stored()
        self.particles  # noqa: B018  one that cannot be read is refused here

    directory: Any = property(lambda run: run._folder.path, doc="The folder, a Path.")
    time: Any = property(lambda run: run._stored()["time"], doc="Times of the stored fields, s.")
    faces: Any = property(lambda run: run._stored()["faces"], doc="Faces of the cells along x, y, z, m, by axis.")
    open: Any = property(lambda run: run._stored()["open"],
                         doc="None, or of cells closed by a wall the open volume over that of a whole one, in the order of fields.")
    fields: Any = property(lambda run: run._stored()["fields"], doc="Names of the stored fields.")
    _sums: Any = property(lambda run: run._stored()["sums"])

    def _stored(self):
        """What fields.h5 says; kept from when it contains a step."""
        if "time" in self._kept:
            return self._kept
        found = {"time": np.empty(0), "faces": {}, "open": None, "fields": [], "sums": {}}
        path = self._folder.file("fields.h5")
        if path.exists():
            with open_hdf5(path, "polybed fields") as file:
                found["time"] = rising(file["time_s"][:], "time_s")
                faces = found["faces"] = {axis: rising(file["grid"][axis][:], f"grid/{axis}") for axis in "xyz"}
                if "open" in file["grid"]:
                    values, cells = file["grid"]["open"][...], tuple(len(faces[axis]) - 1 for axis in "zyx")
                    found["open"] = fits(values, cells[3 - values.ndim :], "grid/open")
        if len(found["time"]):
            with self._open_step(0) as file:
                names = sorted(file["step"])
            found["sums"] = sums_among(names)
            found["fields"] = sorted([*names, *found["sums"]])
            self._kept.update(found)
        return found

    @property
    def particles(self) -> Particles:
        """The particles: particles[-1] is the last step."""
        found = self._kept.get("particles") or Particles(self._folder)
        if len(found):
            self._kept["particles"] = found
        return found

    def __repr__(self) -> str:
        record = self.record
        done = f" by {record['model']}, {record['time_s']:g} s, {record['state']}" if {"model", "time_s", "state"} <= record.keys() else ""
        return plain(f"Run in {self.directory}{done}")

    def _repr_html_(self) -> str:
        """The card, for notebooks: what the page of the run begins with."""
        from polybed.page import markup
        from polybed.report.sections import card_of
        return markup("<p>{}</p>{}", repr(self), card_of(self))

    def _open_step(self, step):
        return open_hdf5(self._folder.file("fields", f"{step + 1:06d}.h5"), "polybed fields step")

    def fields_at(self, step, names):
        """Fields of a stored step by name, which is quicker than one by one. Steps count from 0; -1 is the last."""
        count = len(self.time)
        if not -count <= step < count:
            raise NoStepError(f"{self.directory} has {count} stored steps, from 0 on, none numbered {step}")
        cells = tuple(len(self.faces[axis]) - 1 for axis in "zyx")

        def stored(file, name):
            values = file["step"][name][...]
            grid = cells if values.shape[:3] == cells else cells[1:]
            return fits(values, (*grid, len(grid)) if name.startswith("u_") else grid, name)
        with self._open_step(step % count) as file:
            return {name: functools.reduce(np.add, (stored(file, one) for one in self._sums.get(name, [name]))) for name in names}

    def field(self, name: str) -> Series:
        """A field over time, as a sequence of arrays [y][x] or [z][y][x], a vector with its components behind."""
        if name not in self.fields:
            raise quantities.unknown(f"{self.directory}/fields", name, self.fields)
        return Series(self, name)

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self.fields:
            return Series(self, name)
        near = difflib.get_close_matches(name, self.names(), 1) or [name]
        raise NoFieldError(f"a run has no field '{name}', only {', '.join(self.fields)}; try run.quantity('{near[0]}')")

    def __dir__(self):
        return [*super().__dir__(), *filter(str.isidentifier, self.fields)]

    @property
    def dimensions(self) -> int:
        """2 or 3."""
        return self.field(self.fields[0])[0].ndim if self.fields and len(self.time) else 0

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the column, m; of a run without anything stored yet, zeros."""
        if self.faces:
            return self.faces["x"][-1], self.faces["y"][-1]
        return self.particles.size[0], self.particles.size[1]

    @property
    def record(self) -> dict[str, Any]:
        """run.json as a dictionary; empty if there is none yet."""
        return self._folder.record()

    @property
    def card(self) -> dict[str, Any]:
        """The result card, `card` of run.json: bed height and pressure drop with their intervals, whether the bed is steady, ...; empty if
        there is none yet. Keys end in their unit; what a case lacks is None."""
        return quantities.Named(f"the card of {self.directory}", self.record.get("card") or {})

    @property
    def species(self) -> list[str]:
        """Names of the species, in the order of the case, which the columns of the history keep."""
        stored = [name[len("phi_") :] for name in self.fields if name.startswith("phi_") and name not in self._sums] or self.particles.species
        columns = [column[len("centre_") : -len("_m")] for column in self.history if column.startswith("centre_")]
        return [name for name in columns if name in stored] + [name for name in stored if name not in columns]

    @property
    def kinds(self) -> dict[str, list[str]]:
        """The species as the case names them, each with its size classes: {"sand": ["sand.1", "sand.2"], "fines": ["fines"]}."""
        return kinds_among(self.species)

    @property
    def history(self) -> dict[str, np.ndarray]:
        """history.csv: a dictionary of columns; entries without value are NaN; a row being written is left out."""
        path = self._folder.file("history.csv")
        if not path.exists():
            return {}
        lines = whole_lines(path)
        names = lines[0].split(",") if lines else []
        if "time_s" not in names:
            raise DamagedError(path, "its first line does not name the columns, time_s among them")
        with contents_of(path):
            rows = [[finite(entry) if entry else np.nan for entry in line.split(",")] for line in lines[1:]]
            for number, row in enumerate(rows, start=2):
                if len(row) != len(names):
                    raise ValueError(f"line {number} has {len(row)} entries for {len(names)} columns")
            table = np.array(rows, dtype=float).reshape(len(rows), len(names))
            rising(table[:, names.index("time_s")], "time_s")
        return quantities.Named(f"the history of {self.directory}", {name: table[:, n] for n, name in enumerate(names)})

    @property
    def profiles(self) -> dict[str, np.ndarray]:
        """profiles.h5: a dictionary of time_s [time], y_m [y] and profiles [time][y], of species with size classes also their phi."""
        path = self._folder.file("profiles.h5")
        if not path.exists():
            return {}
        with open_hdf5(path, "polybed profiles") as file:
            axes = {name: rising(file[name][:], name) for name in ("time_s", "y_m")}
            shape = tuple(map(len, axes.values()))
            found = axes | {name: fits(data[...], shape, name) for name, data in file.items() if name not in axes}
        return found | {whole: sum(found[one] for one in parts) for whole, parts in sums_among(found).items()}

    def quantity(self, name: str, source: str | None = None) -> quantities.Quantity:
        """What is called so in the history, the profiles or the fields, with its unit; see polybed.quantities.find."""
        return quantities.find(self, name, source)

    def form_of(self, name: str) -> tuple[tuple[int, ...], np.dtype]:
        """Shape and type of a field at one stored time."""
        with self._open_step(0) as file:
            stored = file["step"][self._sums.get(name, [name])[0]]
            return stored.shape, stored.dtype

    def frame(self) -> Any:
        """The history as a pandas.DataFrame over time_s; see polybed.frames.frame."""
        from polybed import frames
        return frames.frame(self)

    def dataset(self, source: str = "fields") -> xarray.Dataset:
        """Fields or profiles as an xarray.Dataset with units, read when values are asked for; see polybed.datasets."""
        from polybed import datasets
        return datasets.dataset(self, source)

    def names(self, source: str | None = None) -> list[str]:
        """What quantity() finds: a list that is shown by where it is, "history", "profiles" or "fields"; with a source what is there."""
        return quantities.names(self, source)

    def plot(self, what: str | list[str] | None = None, **options: Any) -> list[Path]:
        """Draws the run, or one kind of picture of it, and returns the paths; see polybed.plot.pictures."""
        from polybed import plot
        return plot.pictures(self._folder.file(), (what,) if isinstance(what, str) else what, **options)

    def step_at(self, time: float) -> int:
        """Number of the stored step nearest to a time."""
        if len(self.time) == 0:
            raise NoStepError(f"{self.directory} has no stored fields yet")
        return nearest(self.time, time)


class Snapshot(Run):
    """A run whose history and profiles are read once: a picture of a run that goes on shows one state of it."""

    history = functools.cached_property(Run.history.fget)  # type: ignore[assignment, attr-defined]
    profiles = functools.cached_property(Run.profiles.fget)  # type: ignore[assignment, attr-defined]


def stored_times(run: Run) -> np.ndarray:
    """The stored times of the particles; of the fields if there are no particles."""
    return run.particles.time if len(run.particles) else run.time


def read(directory: str | os.PathLike[str]) -> Run:
    """Opens a run directory, of a finished or a running run."""
    return Run(directory)
