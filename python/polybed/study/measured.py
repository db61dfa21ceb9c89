"""What runs have measured: columns of their histories and stored profiles, the time over which means are taken, and the measures of
profiles, which the program defines: `polybed measure`."""

import json
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from polybed.files import DamagedError, FormatError
from polybed.runner import call
from polybed.read import read
from polybed.record import drift_lines
from polybed.study.time_mean import TimeMean, groups_left_out, jackknife_error, rows_to_drop

WINDOW_SHARE = 0.25  # of a run: the last quarter
ROUNDING = 1e-9  # of times at the ends of the window


class Columns(dict):
    """Arrays by name of a file of a run; what is missing is said of that file."""

    def __init__(self, path, columns):
        super().__init__(columns)
        self.path = path

    def __missing__(self, name):
        raise DamagedError(self.path, f"it has no {name}")


@dataclass
class Measured:
    """What a run has measured."""
    history: Columns
    profiles: Columns
    drifts: list = field(default_factory=list)  # what still drifts at its end, a line each


class Window(NamedTuple):
    """The time over which means are taken, s."""
    begin: float
    end: float
    shortened: bool = False  # by the marginal standard error rule


@dataclass
class Profile:
    """Lateral averages on slabs of one thickness from the bottom up."""
    slab: float  # m
    fraction: np.ndarray  # [species][slab]
    pressure: list = field(default_factory=list)  # Pa; may be empty

    def plain(self):
        """As `polybed measure` reads it."""
        return {"slab": self.slab, "fraction": np.asarray(self.fraction).tolist(), "pressure": list(self.pressure)}

    @staticmethod
    def of(plain):
        return Profile(plain["slab"], np.array(plain["fraction"], float), plain["pressure"])


def history_of(run):
    """The columns of the history of a run that has been opened."""
    return Columns(run.directory / "history.csv", run.history)


def measured(directory):
    """Opens what a run directory holds. Raises FileNotFoundError or FormatError."""
    run = read(directory)
    for name in ("history.csv", "profiles.h5"):
        if not (run.directory / name).exists():
            raise FileNotFoundError(f"{run.directory / name} is missing: make it again with polybed, or restore it from a copy")
    return Measured(history_of(run), Columns(run.directory / "profiles.h5", run.profiles), drift_lines(run.record))


def species_of(history):
    """Names of the species, from the columns of a history."""
    return [name.removeprefix("centre_").removesuffix("_m") for name in history if name.startswith("centre_") and name.endswith("_m")]


def centre_column(species):
    """The column of a history that has the centre of a species."""
    return f"centre_{species}_m"


def ratio(above, below):
    """Quotients; NaN where the divisor is not above 0."""
    return np.divide(above, below, out=np.full(len(above), np.nan), where=np.asarray(below) > 0)


def centre_difference(history, species):
    """Centre of species 2 less that of species 1, over the bed height, row by row; empty for one species."""
    if len(species) < 2:
        return np.empty(0)
    return ratio(history[centre_column(species[1])] - history[centre_column(species[0])], history["bed_height_m"])


def in_window(time, window):
    """Which of these times the window has, truths; its end may lie beyond all of them."""
    slack = ROUNDING * min([window.end, *time[-1:]])
    return (time >= window.begin - slack) & (time <= window.end + slack)


def within(time, values, window):
    """The part of a series in the window; an empty series stays one."""
    return values[in_window(time, window)] if len(values) else values


def begin_by_rule(history, values, window):
    """Where the marginal standard error rule would have the window begin, for one series, s."""
    time = within(history["time_s"], history["time_s"], window)
    drop = rows_to_drop(within(history["time_s"], values, window))
    return time[drop] if 0 < drop < len(time) else window.begin


def window_of(*histories):
    """The last quarter of the time that all have, or what the marginal standard error rule leaves of it for bed height and centre
    difference of each. Raises FormatError if they have no time in common."""
    times = [history["time_s"] for history in histories]
    if not all(len(time) for time in times):
        raise FormatError("a history without a row: nothing to compare")
    first, last = max(0.0, *(time[0] for time in times)), min(time[-1] for time in times)
    if not last > first:
        spans = " and ".join(f"{time[0]:.4g} to {time[-1]:.4g} s" for time in times)
        raise FormatError(f"the runs have no time in common: {spans}")
    quarter = Window(last - WINDOW_SHARE * (last - first), last)
    begin = max(begin_by_rule(history, values, quarter) for history in histories
                for values in (history["bed_height_m"], centre_difference(history, species_of(history))))
    return Window(float(begin), float(last), bool(begin > quarter.begin))


class WindowProfiles:
    """Profiles of a run in the window. Raises FormatError if one of the species has none."""

    def __init__(self, profiles, species, window):
        self.slab = 2 * float(profiles["y_m"][0])
        stored = np.array([profiles[f"phi_{name}"] for name in species])
        self.fraction = stored[:, in_window(profiles["time_s"], window)]  # [species][row][slab]

    def count(self):
        return self.fraction.shape[1]

    def at(self, row):
        """The profile of a row."""
        return Profile(self.slab, self.fraction[:, row])

    def mean(self, kept=slice(None)):
        """Mean over time, or over the rows that are kept."""
        rows = self.fraction[:, kept]
        return Profile(self.slab, (rows / rows.shape[1]).sum(axis=1))

    def means_without_groups(self):
        """Means over time without each of the groups of a jackknife."""
        return [self.mean(kept) for kept in groups_left_out(self.count())]

    def time_means(self):
        """Mean solids fractions over time, [species][slab], each with its interval from leaving out groups of profiles, which of a mean
        is that of batch means; without one for less than four profiles. Without a profile in the window no species has a slab."""
        if not self.count():
            return [[] for _ in self.fraction]
        kept = groups_left_out(self.count())
        found = []
        for rows in self.fraction:
            error = jackknife_error([rows[part].sum(axis=0) / part.sum() for part in kept])
            errors = [None] * rows.shape[1] if error is None else error.tolist()
            found.append([TimeMean(*pair) for pair in zip((rows.sum(axis=0) / self.count()).tolist(), errors)])
        return found


def measures_of(profiles, species, on=None, reference=None):
    """What `polybed measure --profiles` says of profiles, as a dictionary: "measures" by name, each with its "values", and what was
    asked for: "profiles" laid on other slabs, "distances" from the reference.

    on: (thickness, m, and number) of slabs on which the profiles are laid first
    """
    if not profiles:
        return {"measures": {}, "distances": {}, "profiles": []}
    asked = {"species": list(species), "profiles": [profile.plain() for profile in profiles]}
    if on:
        asked["on"] = {"slab": on[0], "count": on[1]}
    if reference:
        asked["reference"] = reference.plain()
    return json.loads(call("measure", "--profiles", "-", "--json", given=json.dumps(asked)))
