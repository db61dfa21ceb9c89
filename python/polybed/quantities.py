"""The numbers of a run by name, with their units."""

from __future__ import annotations

import difflib
import json
import pathlib
import re
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from polybed.errors import UnknownNameError

if TYPE_CHECKING:
    from polybed.read import Run

# What `polybed measure --list --json` says of every measure.
TABLE = json.loads(pathlib.Path(__file__).with_name("measures.json").read_text())
COLUMNS = {row["column"]: row for part in ("bed", "tfm", "dem") for row in TABLE[part] if row["column"]}
# Units by the end of a column's name, the longest first: m_s before s.
ENDINGS = {f"_{unit}": unit.replace("_", "/") for unit in sorted({row["unit"] for row in COLUMNS.values()} - {"1"}, key=len, reverse=True)}
# Levels in a bed, by column what a picture calls them.
LEVELS = {column: row["name"].replace("_", " ") for column, row in COLUMNS.items() if row["picture"]}
SOURCES = ("history", "profiles", "fields")  # of quantities, in the order in which they are looked for
# Units of fields and profiles by the beginning of their name.
BEGINNINGS = {"phi_": "1", "voidage": "1", "u_": "m/s", "theta_": "m2/s2", "total_pressure": "Pa", "pressure": "Pa",
              "density": "kg/m3"}


class Quantity(np.lib.mixins.NDArrayOperatorsMixin):
    """An array with its unit ("1" without) and the times of its first axis, s; NumPy and arithmetic treat it as the array. values: [time],
    [time][y], or [time][y][x] as the fields"""

    def __init__(self, values: Any, unit: str, time: Any) -> None:
        self.values, self.unit, self.time = np.asarray(values), unit, np.asarray(time)

    def __array__(self, *arguments: Any, **options: Any) -> np.ndarray:
        return np.asarray(self.values, *arguments, **options)

    def __array_ufunc__(self, ufunc: np.ufunc, method: Any, *inputs: Any, **kwargs: Any) -> Any:
        return getattr(ufunc, method)(*(each.values if isinstance(each, Quantity) else each for each in inputs), **kwargs)

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, item: Any) -> Any:
        return self.values[item]

    def __repr__(self) -> str:
        said = f"Quantity of shape {self.values.shape} in {self.unit}"
        return f"{said}, {self.values[0]:.4g} to {self.values[-1]:.4g} at {self.time[0]:g} to {self.time[-1]:g} s" if self.values.ndim == 1 < len(self) else said


def unit_of_column(name: str) -> str:
    """Unit of a column of the history; "1" for what has none, as a number of contacts."""
    return next((unit for ending, unit in ENDINGS.items() if name.endswith(ending)), "1")


def unit_of_field(name: str) -> str:
    return "Pa" if name == "p" else next((unit for beginning, unit in BEGINNINGS.items() if name.startswith(beginning)), "1")


def unknown(where: object, name: str, known: Iterable[str]) -> UnknownNameError:
    """The error for a name that is not there: what it could mean, or else the names that there are."""
    names = list(known)
    near = difflib.get_close_matches(name, names, 3)
    return UnknownNameError(f"{where} has no {name}; " + (f"did you mean {' or '.join(near)}?" if near else f"it has {', '.join(names)}"))


class Named(dict[str, Any]):
    """A dictionary of a run, whose error for a missing key names those that there are."""

    def __init__(self, where: object, entries: Mapping[str, Any]) -> None:
        super().__init__(entries)
        self.where = where

    def __missing__(self, name: str) -> Any:
        raise unknown(self.where, name, self)


def find(run: Run, name: str, source: str | None = None) -> Quantity:
    """A quantity of a run: of its history, where the unit at the end of a column's name may be left out ("bed_height"), of its
    profiles, or of its fields. The first that has it, unless a source is named."""
    for key in sources_of(source):
        if (quantity := found_in(run, key, name)) is not None:
            return quantity
    if others := [key for key in SOURCES if found_in(run, key, name) is not None]:
        raise UnknownNameError(f"{run.directory} has no {name} in {source}; it is in {' and '.join(others)}")
    raise unknown(run.directory, name, names(run, source))


def found_in(run: Run, source: str, name: str) -> Quantity | None:
    if source == "fields":
        return Quantity(run.field(name)[:], unit_of_field(name), run.time) if name in run.fields else None
    if source == "profiles":
        profiles = {} if name in ("time_s", "y_m") else run.profiles
        return Quantity(profiles[name], unit_of_field(name), profiles["time_s"]) if name in profiles else None
    history = run.history
    column = next((column for column in [name, *(name + ending for ending in ENDINGS)] if column in history), None)
    return Quantity(history[column], unit_of_column(column), history["time_s"]) if column else None


def sources_of(source: str | None) -> list[str]:
    if source is not None and source not in SOURCES:
        raise unknown("a run", source, SOURCES)
    return list(SOURCES) if source is None else [source]


class Names(list[str]):
    """Names of quantities. Shown, they are sorted by where they are stored."""

    def __init__(self, by_source: dict[str, list[str]]) -> None:
        super().__init__(sorted({name for names in by_source.values() for name in names}))
        self.by_source = by_source

    def __repr__(self) -> str:
        return "\n".join(f"{source:10}{', '.join(names)}" for source, names in self.by_source.items())


def names(run: Run, source: str | None = None) -> Names:
    """What find() knows of a run."""
    return Names({each: sorted({*getattr(run, each)} - {"y_m"}) for each in sources_of(source)})


# Measures with other words than in the table of measures.
MEASURES = {"centre_difference": "distance of centres/height", "pressure_drop_over_weight": "pressure drop/weight",
            "mixing": "mixing (1 mixed, 0 apart)"}


def measure_words(name: str) -> str:
    """What a column of the measures is called in words."""
    if name.startswith("centre_") and name.endswith("_m"):
        return f"centre of {name[len('centre_'):-len('_m')]}"
    if recovery := re.fullmatch(r"recovery_(?:(top|discharge\d+)_)?(.+)", name):
        return f"recovery of {recovery[2]}" + (f" by {recovery[1]}" if recovery[1] else "")
    if name.startswith("slip_"):
        return f"slip of the fluid over {name[len('slip_'):-len('_m_s')]}"
    unit = next((ending for ending in ENDINGS if name.endswith(ending)), "")
    return MEASURES.get(name) or (COLUMNS.get(name, {}).get("name") or name.removesuffix(unit)).replace("_", " ")
