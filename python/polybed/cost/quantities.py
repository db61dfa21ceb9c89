"""Quantities of interest of a finished run: time means over a window with their intervals, on slabs of one thickness."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from polybed.quantities import TABLE
from polybed.study.measured import centre_column, means_of, species_of

HELP = {row["name"]: row["help"] for part in ("bed", "distances") for row in TABLE[part]}
ENOUGH = 30  # autocorrelation times in a window
LENGTH, SHARE = "length", "share"  # what errors are relative to: the reference's bed height, or 1


class QuantityInfo(NamedTuple):
    id: str
    unit: str
    definition: str
    scale: str


@dataclass
class RunQuantities:
    values: dict = field(default_factory=dict)  # those that the run has, TimeMean
    directory: Path | None = None  # of the run, if it has stored profiles in the window
    too_short: str = ""  # a quantity with fewer than 30 autocorrelation times
    centre: float | None = None  # of the volume of all solids, m


def quantities_of(species):
    several = [("centre_difference", "1", SHARE), ("mixing", "1", SHARE), ("interface", "m", LENGTH), ("composition", "1", SHARE)]
    rows = [("bed_height", "m", LENGTH), *((f"centre_{name}", "m", LENGTH) for name in species), ("pressure_drop", "1", SHARE),
            *(several if len(species) > 1 else []), ("profile", "1", SHARE)]
    words = HELP | {f"centre_{name}": HELP["centre_<name>"] for name in species} | {"pressure_drop": "over the buoyant weight"}
    return [QuantityInfo(name, unit, words[name], scale) for name, unit, scale in rows]


def centre_of(measured):
    """Height, m, of the centre of volume of all solids in a mean profile, as in a column of one width; None for an empty one."""
    solids = sum(np.nan_to_num(np.array(of["mean"], float)) for of in measured.fraction.values())
    return float(np.average(measured.height, weights=solids)) if np.sum(solids) > 0 else None


def quantities_of_run(run, begin, slabs):
    """By the definitions of docs/reference/measures.md, from a time on, s, on so many slabs of the column. Heights and centres are means of the rows of the history,
    moved by what the profiles stored in the window differ by if measured on these slabs."""
    species, found = species_of(run.history), RunQuantities()
    if not (run.history["time_s"] > begin).any():  # all particles had left before it
        return found
    [measured] = means_of(run.directory, begin=begin, slabs=slabs).runs
    columns = {"bed_height": "bed_height_m", **{f"centre_{name}": centre_column(name) for name in species},
               "pressure_drop": "pressure_drop_over_weight"}
    if len(species) > 1:
        columns |= {"centre_difference": "centre_difference", "mixing": "mixing"}
    for name, column in columns.items():
        mean = measured.means.get(column)
        if mean is None:
            continue
        if mean.error and measured.rows < ENOUGH * mean.correlation:
            found.too_short = name
        found.values[name] = mean
    found.directory = run.directory if measured.profiles else None
    found.centre = centre_of(measured)
    if len(species) > 1 and "interface_m" in measured.of_profile:
        found.values["interface"] = measured.of_profile["interface_m"]
    return found
