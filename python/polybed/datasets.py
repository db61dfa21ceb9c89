"""Fields and profiles as datasets of xarray, with names and units, each stored time read when its values are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from polybed.packages import needed
from polybed.quantities import unit_of_field, unknown

with needed(False):
    import xarray as xr
    from xarray.backends.common import BackendArray
    from xarray.core import indexing

if TYPE_CHECKING:
    from polybed.read import Run

AXES = ("x", "y", "z")


class Stored(BackendArray):
    """A field over its stored times, [time][y][x] or [time][z][y][x], a vector with its component last. Each time is a file."""

    def __init__(self, run: Run, name: str) -> None:
        self.run, self.name = run, name
        shape, self.dtype = run.form_of(name)
        self.shape = (len(run.time), *shape)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> np.ndarray:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER_1VECTOR, self.values)

    def values(self, key: tuple[Any, ...]) -> np.ndarray:
        """The values at the times that a key names."""
        series = self.run.field(self.name)
        times = np.arange(len(series))[key[0]]
        if np.ndim(times) == 0:
            return series[int(times)][key[1:]]
        read = [series[int(n)][(slice(None),) * (len(key) - 1)] for n in times]
        whole = np.array(read).reshape(len(read), *self.shape[1:])
        return whole[(slice(None), *key[1:])]


def fields(run: Run) -> xr.Dataset:
    """Fields over time: dimensions time, (z,) y, x, and component for velocities; coordinates in s and m, the centres of the cells;
    each variable has `attrs["units"]`. A variable is read when its values are."""
    axes = AXES[:run.dimensions]
    grid = ("time", *reversed(axes))
    found = {}
    for name in run.fields:
        dimensions = (*grid, "component") if name.startswith("u_") else grid
        found[name] = xr.Variable(dimensions, indexing.LazilyIndexedArray(Stored(run, name)), {"units": unit_of_field(name)})
    coordinates: dict[str, Any] = {"time": ("time", run.time, {"units": "s"})}
    coordinates |= {axis: (axis, (run.faces[axis][1:] + run.faces[axis][:-1]) / 2, {"units": "m"}) for axis in axes}
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
        raise unknown("a dataset", source, SOURCES)
    return SOURCES[source](run)
