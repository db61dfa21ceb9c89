"""What runs have measured: columns of histories, and the means of `polybed measure` with their 95 % intervals."""

from typing import NamedTuple

import numpy as np

from polybed.files import FormatError
from polybed.read import Snapshot
from polybed.runner import answer_of, asked

ROUNDING = 1e-9  # of times at the ends of the window


class TimeMean(NamedTuple):
    mean: float
    error: float | None = None  # half-width of the interval; None: too few rows to tell
    correlation: float = 1.0  # integrated autocorrelation time, rows


class Window(NamedTuple):
    """The time over which means are taken, s."""
    begin: float
    end: float
    shortened: bool = False  # by the marginal standard error rule


def measured(directory):
    """Opens a run that has stored what studies measure. Raises FileNotFoundError or FormatError."""
    run = Snapshot(directory)
    for name in ("history.csv", "profiles.h5"):
        if not (run.directory / name).exists():
            raise FileNotFoundError(f"{run.directory / name} is missing: make it again with polybed, or restore it from a copy")
    return run


def species_of(history):
    """Names of the species, from the columns of a history; size classes one by one, without the species that they are classes of."""
    names = [name.removeprefix("centre_").removesuffix("_m") for name in history if name.startswith("centre_") and name.endswith("_m")]
    return [name for n, name in enumerate(names) if not {f"{name}.1", f"{name}.2"} <= set(names[:n])]


def centre_column(species):
    """The column of a history that has the centre of a species."""
    return f"centre_{species}_m"


def within(time, values, window):
    """The part of a series in the window, whose end can lie beyond all times."""
    slack = ROUNDING * min([window.end, *time[-1:]])
    return values[(time >= window.begin - slack) & (time <= window.end + slack)]


def time_means(found):
    return {name: TimeMean(mean["mean"], mean["interval"], mean.get("correlation_rows", 1.0)) for name, mean in found.items()}


class InWindow:
    """What a run has measured in a window. means: of the columns of its history, of pressure_drop_over_weight and centre_difference;
    height: of the slabs' centres, m; fraction: "mean" and "interval" in the slabs, by species; of_profile: measures of the mean profile"""

    def __init__(self, found):
        profile = found["mean_profile"]
        self.rows, self.step, self.profiles = found["rows"], found["step_s"], found["profiles"]
        self.means, self.of_profile = time_means(found["means"]), time_means(profile["measures"])
        self.height, self.fraction = profile["y_m"], profile["fraction"]


class Means(NamedTuple):
    """What `polybed measure` says of one run or two. distances: of their mean profiles"""
    window: Window
    runs: list
    distances: dict


def means_of(directory, beside=None, begin=None, slabs=None):
    """Means over the last quarter, or what the marginal standard error rule leaves of it. Raises FormatError or ProgramError without any.
    begin: of another window up to the end, s; slabs: number of those on which the profiles are laid first"""
    options = {"--beside": beside, "--begin": begin, "--slabs": slabs}
    words = [word for name, value in options.items() if value is not None for word in (name, value)]
    found = answer_of("measure", directory, *words)
    if found["in_window"] is None:
        raise FormatError(f"{directory}: a history too short for means")
    runs = [InWindow(found[name]) for name in ("in_window", "beside") if name in found]
    return Means(Window(*found["window"].values()), runs, time_means(found.get("distances", {})))


def statistics_of(series=(), ratios=()):
    """What `polybed measure --series` says of numbers in equal steps of time, a dictionary each or None, and of quotients of sums."""
    def plain(values):
        return [value if np.isfinite(value) else None for value in map(float, values)]

    return asked("means", series=[plain(values) for values in series],
                 ratios=[{"above": plain(above), "below": plain(below)} for above, below in ratios])
