"""Results with names and units: the history as a frame of pandas, runs as one of a row each, fields and profiles as datasets of xarray.

Nothing but names and shapes is read before values are asked for; one stored time of one field is the least that is read.
"""

from __future__ import annotations

import itertools
import tomllib
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import xarray as xr
from xarray.backends.common import BackendArray
from xarray.core import indexing

from polybed.overrides import flat
from polybed.quantities import unit_of_column, unit_of_field

if TYPE_CHECKING:
    from polybed.read import Run

AXES = ("x", "y", "z")


def frame(run: Run) -> Any:
    """The history as a pandas.DataFrame: a row for each time, index time_s in seconds, columns as in history.csv. The unit ends a
    column's name, and `frame.attrs["units"]` has it by column. Entries without value are NaN."""
    columns = dict(run.history)
    time = columns.pop("time_s", np.empty(0))
    table = pd.DataFrame(columns, index=pd.Index(time, name="time_s"))
    table.attrs["units"] = {name: unit_of_column(name) for name in columns}
    return table


def keys_of(run: Run) -> dict[str, Any]:
    """The keys of a run's resolved case by dotted names, those of a species by its name. A velocity that is constant is one number."""
    case = tomllib.loads(run.record.get("case", ""))
    for name, entries in case.items():
        if isinstance(entries, list):
            case[name] = {str(entry.get("name", n)): entry for n, entry in enumerate(entries, start=1)}
    constant = {key: value[0][1] for key, value in flat(case) if key.endswith("superficial_velocity") and isinstance(value, list) and len(value) == 1}
    return dict(flat(case)) | constant


def table(runs: Iterable[Run]) -> pd.DataFrame:
    """A row for each run: the keys in which the cases differ, the state of the run, and the numbers and words of its card, a mean with
    its interval as two columns. The index is the folder."""
    each = list(runs)
    keys = [keys_of(run) for run in each]
    differ = [key for key in dict.fromkeys(itertools.chain(*keys)) if any(one.get(key) != keys[0].get(key) for one in keys)]
    rows = [{key: own.get(key) for key in differ} | {"run_state": run.record.get("state")} | dict(card_of(run.card)) for run, own in zip(each, keys)]
    return pd.DataFrame(rows, index=pd.Index([str(run.directory) for run in each], name="run"))


def card_of(card: dict[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """The entries of a card by dotted names; {"value", "interval"} as name and name_interval."""
    for name, value in card.items():
        if isinstance(value, dict) and value.keys() == {"value", "interval"}:
            yield from ((above + name, value["value"]), (f"{above}{name}_interval", value["interval"]))
        elif isinstance(value, dict):
            yield from card_of(value, f"{above}{name}.")
        else:
            yield above + name, value


class Stored(BackendArray):
    """A field over its stored times, [time][y][x] or [time][z][y][x], a vector with its component last. Each time is a file."""

    def __init__(self, run: Run, name: str) -> None:
        self.run, self.name = run, name
        shape, self.dtype = run.form_of(name)
        self.shape = (len(run.time), *shape)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> np.ndarray:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER_1VECTOR, self.values)

    def values(self, key: tuple[Any, ...]) -> np.ndarray:
        """Of the times that a key names, the part that it names."""
        series = self.run.field(self.name)
        times = np.arange(len(series))[key[0]]
        if np.ndim(times) == 0:
            return series[int(times)][key[1:]]
        read = [series[int(n)][(slice(None),) * (len(key) - 1)] for n in times]
        whole = np.array(read).reshape(len(read), *self.shape[1:])
        return whole[(slice(None), *key[1:])]


def places(run: Run) -> dict[str, Any]:
    """Centres of the cells along each axis, m."""
    return {axis: (axis, (faces[1:] + faces[:-1]) / 2, {"units": "m"}) for axis, faces in run.faces.items()}


def fields(run: Run) -> xr.Dataset:
    """Fields over time: dimensions time, (z,) y, x, and component for velocities; coordinates in s and m, the centres of the cells;
    each variable has `attrs["units"]`. A variable is read when its values are."""
    axes = AXES[:run.dimensions]
    grid = ("time", *reversed(axes))
    found = {}
    for name in run.fields:
        dimensions = (*grid, "component") if name.startswith("u_") else grid
        found[name] = xr.Variable(dimensions, indexing.LazilyIndexedArray(Stored(run, name)), {"units": unit_of_field(name)})
    centres = places(run)
    coordinates = {"time": ("time", run.time, {"units": "s"})} | {axis: centres[axis] for axis in axes}
    if any(name.startswith("u_") for name in run.fields):
        coordinates["component"] = ("component", list(axes), {})
    return xr.Dataset(found, coordinates)


def profiles(run: Run) -> xr.Dataset:
    """Lateral means: dimensions time (s) and y (m, height of the layer's centre); each variable has `attrs["units"]`."""
    columns = dict(run.profiles)
    time, height = columns.pop("time_s", np.empty(0)), columns.pop("y_m", np.empty(0))
    coordinates = {"time": ("time", time, {"units": "s"}), "y": ("y", height, {"units": "m"})}
    return xr.Dataset({name: (("time", "y"), values, {"units": unit_of_field(name)}) for name, values in columns.items()}, coordinates)


SOURCES = {"fields": fields, "profiles": profiles}


def dataset(run: Run, source: str) -> xr.Dataset:
    """`fields` or `profiles` of a run. Raises KeyError for another source."""
    if source not in SOURCES:
        raise KeyError(f"there is no {source}; there are {', '.join(SOURCES)}")
    return SOURCES[source](run)
