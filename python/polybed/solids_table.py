"""A table of the solids stress, what `polybed calibrate` writes: numpy arrays by name, with their units.

    table = polybed.read_table("runs/beads-calibrate/table.h5")
    table["p_ratio"], table["p_ratio_se"]     # [phi][stokes][e][mu_p][x2]
    table["phi"], table.unit("phi"), table.names()
    table.attributes["regime"], table.attributes["reference"]
"""

from __future__ import annotations

import os
import re
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from polybed.files import DamagedError, fits, open_hdf5
from polybed.page import table
from polybed.quantities import unknown

# Units of all but ratios and fractions; pressures of a fluidised bed are over the weight of a layer of one diameter.
BED = "(rho_p - rho_f) g D"
UNITS = {"velocity": "m/s", "theta_bed": BED + "/rho_p"}
AXES = ("phi", "stokes", "e", "mu_p", "x2")  # of sheared particles, in the order of the arrays
QUANTITY = re.compile("S|.*_ratio(_12)?(_se|_n)?")  # an array over these axes


def numbers(name: str, data: Any) -> np.ndarray:
    if not hasattr(data, "shape"):
        raise ValueError(f"{name} is a group in place of numbers")
    return fits(data[...], data.shape, name)


def checksum(arrays: Any) -> int:
    """CRC-32 of arrays by name, the attribute crc32 of a table: over all numbers as doubles with the low byte first,
    in the order of the names. A table that you write yourself gets it by file.attrs["crc32"] = checksum(file)."""
    found = 0
    for name in sorted(arrays):
        found = zlib.crc32(np.ascontiguousarray(arrays[name], "<f8").tobytes(), found)
    return found


@dataclass(eq=False, repr=False)
class SolidsTable:
    """A table of the solids stress, named as in its file: table[name] is an array, table.unit(name) its unit, "1" of ratios, fractions and seeds."""
    arrays: dict[str, Any] = field(default_factory=dict)  # axes, and quantities [phi][stokes][e][mu_p][x2]
    attributes: dict[str, Any] = field(default_factory=dict)
    path: Path | None = None

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.arrays:
            raise unknown(self.path, name, self.names())
        return self.arrays[name]

    def _repr_html_(self) -> str:
        """What it contains, for notebooks."""
        return table(["", "unit", "shape", "least", "greatest"], [
            [name, self.unit(name), " \u00d7 ".join(map(str, data.shape)), f"{data.min():.4g}", f"{data.max():.4g}"]
            for name, data in sorted(self.arrays.items()) if data.size])

    def names(self) -> list[str]:
        return sorted(self.arrays)

    def unit(self, name: str) -> str:
        self[name]  # one that is not there has no unit
        return BED if name.startswith("p_bed") and not name.endswith("_n") else UNITS.get(name, "1")

    def put(self, name: str, values: Any) -> None:
        """Adds a quantity, one value for each point."""
        self.arrays[name] = np.reshape(values, [len(self.arrays[axis]) for axis in AXES])

    def points(self, name: str) -> np.ndarray:
        """A quantity, or the solids fraction, of each point."""
        values = self.arrays[name]
        return np.repeat(values, self.arrays["S"].size // len(values)) if name == "phi" else values.ravel()

    def lines(self, name: str) -> np.ndarray:
        """A quantity along phi, one row for each place in the other axes."""
        return self.arrays[name].reshape(len(self.arrays["phi"]), -1).T

    def write(self, path: Path) -> None:
        with h5py.File(path, "w") as file:
            for name, values in self.arrays.items():
                file[name] = np.asarray(values, float)
            file.attrs.update(self.attributes)
            file.attrs["crc32"] = checksum(self.arrays)


def read_table(path: str | os.PathLike[str]) -> SolidsTable:
    """Opens a table of the solids stress, table.h5, and reads it whole."""
    with open_hdf5(path, "polybed solids table") as file:
        table = SolidsTable({name: numbers(name, data) for name, data in file.items()}, dict(file.attrs), Path(path))
        for name, data in table.arrays.items():
            if name in AXES:
                fits(data, (data.size,), name)
            elif QUANTITY.fullmatch(name):
                fits(data, tuple(table.arrays[axis].size for axis in AXES), name)
    if "crc32" in table.attributes and table.attributes["crc32"] != checksum(table.arrays):
        raise DamagedError(path, "its checksum does not hold")
    return table
