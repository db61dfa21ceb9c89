"""What was run, by which quantities it is measured against what, and what follows; and what names in cost.json are called in words."""

from argparse import Namespace
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from polybed.cost.runner import RunOrder, RunOutcome
from polybed.quantities import TABLE
from polybed.study.measured import centre_column, means_of, species_of

# What a row stands for.
CANDIDATE, MODEL, REFERENCE, TWIN, SOLVER, INPUT = "candidate", "model", "reference", "twin", "solver", "input"
HELP = {row["name"]: row["help"] for part in ("bed", "distances") for row in TABLE[part]}
ENOUGH = 30  # autocorrelation times in a window
LENGTH, SHARE = "length", "share"  # what errors are relative to: the reference's bed height, or 1
# status of a run
STATUS = {"pareto": "nothing cheaper is as accurate", "dominated": "another is cheaper and as accurate",
          "hollow": "too near the reference to be ranked", "model": "not ranked: model, data or solver differ",
          "predicted": "predicted, not run", "not run": "not run", "failed": "failed", "refused": "refused"}
# kind of the reference
REFERENCES = {"exact": "the force balance of a uniform bed", "self": "the same model, solved more exactly",
              "extrapolated": "the same model, solved more exactly, extrapolated to infinitely fine cells",
              "statistical": "the longest run on the finest grid", "directory": "a run that was given", "": "there is none"}
# parts of the error
PARTS = {"space": "size of the cells", "solver and coupling tolerance": "tolerance of the pressure solver or of the coupling to the fluid",
         "statistics": "fluctuations of the bed", "closure spread": "choice of drag law, stress or stiffness",
         "level": "choice of the model: force balance, 1-D, 2-D, particles"}
# what a sweep varies
AXES = {"rtol": "relative tolerance (tfm.rtol)", "grid": "cells", "steps": "steps per contact (dem.steps_per_contact)",
        "coupling": "steps of the particles in one of the fluid (dem.fluid_every)"}
CLOCKS = {"work": "counted work", "wall": "wall time"}


def in_words(axis, level):
    """A level of an axis: "relative tolerance (tfm.rtol) 0.001"."""
    return f"{AXES.get(axis, axis)} {level}"


def part(row):
    return PARTS.get(row, row)


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
    centre: float | None = None  # of the volume of all solids in the mean profile, as in a column of one width, m


def quantities_of(species):
    several = [("centre_difference", "1", SHARE), ("mixing", "1", SHARE), ("interface", "m", LENGTH), ("composition", "1", SHARE)]
    rows = [("bed_height", "m", LENGTH), *((f"centre_{name}", "m", LENGTH) for name in species), ("pressure_drop", "1", SHARE),
            *(several if len(species) > 1 else []), ("profile", "1", SHARE)]
    words = HELP | {f"centre_{name}": HELP["centre_<name>"] for name in species} | {"pressure_drop": "over the buoyant weight"}
    return [QuantityInfo(name, unit, words[name], scale) for name, unit, scale in rows]


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
    solids = sum(np.nan_to_num(np.array(of["mean"], float)) for of in measured.fraction.values())
    found.centre = float(np.average(measured.height, weights=solids)) if np.sum(solids) > 0 else None
    if len(species) > 1 and "interface_m" in measured.of_profile:
        found.values["interface"] = measured.of_profile["interface_m"]
    return found


class Priced(NamedTuple):
    error: float
    cost: float


class RowQuantity(NamedTuple):
    """A quantity of a run with its distance from the reference, both with the half-width of a 95 % interval."""
    value: float
    error: float
    interval: float | None = None
    error_interval: float | None = None


@dataclass
class Row:
    order: RunOrder
    kind: str = CANDIDATE
    settings: dict = field(default_factory=dict)  # level of each axis by its number; an axis left out has the given one
    note: str = ""  # what the settings do not say: "temperature + 1 K"
    outcome: RunOutcome | None = None
    measured: RunQuantities = field(default_factory=RunQuantities)
    quantities: dict = field(default_factory=dict)  # RowQuantity by name
    rate: float = 0.0  # s for a simulated second, by the clock
    predicted: Priced | None = None
    status: str = ""  # pareto | dominated | hollow | model | predicted | failed | refused | not run

    @property
    def done(self):
        return self.outcome is not None and self.outcome.done


@dataclass
class Reference:
    kind: str = ""  # exact | self | extrapolated | statistical | directory; empty: none
    note: str = ""
    value: dict = field(default_factory=dict)
    floor: dict = field(default_factory=dict)  # of errors: below it nothing is ranked
    band: dict = field(default_factory=dict)
    directory: Path | None = None  # of a run with profiles


@dataclass
class Share:
    row: str
    value: float | None = None  # of the first quantity's error; None: not run
    note: str = ""
    axes: list = field(default_factory=list)  # that would measure it, of a row that no axis run has measured


@dataclass
class Sweep:
    options: Namespace  # of the command line
    axes: list = field(default_factory=list)
    quantities: list = field(default_factory=list)  # QuantityInfo
    begin: float = 0.0  # of the window, s
    slabs: int = 1  # of the case as it is given, whatever the grid of the run
    rows: list = field(default_factory=list)
    outcome: str = "done"  # done | refused | failed
    reason: str = ""
    regime: str = "steady"  # steady | chaotic
    reference: Reference = field(default_factory=Reference)
    laws: dict = field(default_factory=dict)  # of error and cost along a line, "error_of_rtol"
    additive_off: float | None = None
    attribution: list = field(default_factory=list)
    inputs: list = field(default_factory=list)
    recommended: int | None = None  # number of a row
    warnings: list = field(default_factory=list)

    @property
    def ranking(self):
        return self.options.quantities[0]

    @property
    def chaotic(self):
        return self.regime == "chaotic"

    def refuse(self, reason):
        self.outcome, self.reason = "refused", reason

    def axis(self, name):
        return next((axis for axis in self.axes if axis.name == name), None)

    def find(self, order, kind):
        """The row of this order and kind; None if there is none."""
        return next((row for row in self.rows if row.kind == kind and row.order == order), None)
