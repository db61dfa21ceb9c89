"""Quantities of interest of a finished run: time means over a window with their intervals, on slabs of one thickness."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from polybed.quantities import TABLE
from polybed.study.measured import Profile, Window, WindowProfiles, centre_column, centre_difference, measures_of, ratio, species_of, within
from polybed.study.time_mean import TimeMean, jackknife_error, time_mean

HELP = {row["name"]: row["help"] for part in ("bed", "distances") for row in TABLE[part]}
ENOUGH = 30  # autocorrelation times in a window
LENGTH, SHARE, ITSELF = "length", "share", "itself"  # what errors are relative to: the reference's bed height, 1, its value


class QuantityInfo(NamedTuple):
    id: str
    unit: str
    definition: str
    scale: str


class MeasureOn(NamedTuple):
    """Slabs of the case as it is given, whatever the grid of the run."""
    slab: float  # m
    count: int  # type: ignore[assignment]  # in place of the method of tuples
    window: Window


@dataclass
class RunQuantities:
    values: dict = field(default_factory=dict)  # those that the run has, TimeMean
    profile: Profile | None = None  # mean over the window
    too_short: str = ""  # a quantity with fewer than 30 autocorrelation times


def measure_on(keys, begin):
    """The slabs of a resolved case, and the window from `begin`, s, on."""
    column = keys["column"]
    return MeasureOn(column["size"][1] / column["cells"][1], column["cells"][1], Window(begin, np.inf))


def quantities_of(species):
    """Of a case with these species."""
    def measure(name, unit, scale, row=None):
        return QuantityInfo(name, unit, HELP[row or name], scale)

    found = [measure("bed_height", "m", LENGTH), *(measure(f"centre_{name}", "m", LENGTH, "centre_<name>") for name in species),
             QuantityInfo("pressure_drop", "1", "over the buoyant weight", SHARE)]
    if len(species) > 1:
        found += [measure("centre_difference", "1", SHARE), measure("mixing", "1", SHARE), measure("interface", "m", LENGTH),
                  measure("composition", "1", SHARE)]
    return [*found, measure("profile", "1", SHARE), QuantityInfo("pressure_rms", "1", "of the pressure drop over the buoyant weight", SHARE),
            QuantityInfo("pressure_frequency", "1/s", "of the greatest Fourier term of the pressure drop", ITSELF)]


class OnSlabs:
    """What the program measures of the profiles of a run in the window once they are laid on the slabs asked for."""

    def __init__(self, profiles, species, on):
        self.species, self.own = species, []
        if abs(profiles.slab - on.slab) >= 1e-9 * on.slab:
            self.own = [profiles.at(row) for row in range(profiles.count())]
        without = profiles.means_without_groups() if len(species) > 1 else []
        self.groups = len(without)
        self.there = measures_of([profiles.mean(), *without, *self.own], species, (on.slab, on.count))
        self.here = measures_of(self.own, species)
        self.profile = Profile.of(self.there["profiles"][0])

    def change(self, name):
        """Mean, over the profiles, of what a measure changes by from the run's slabs to those asked for."""
        if not self.own:
            return 0.0
        here, there = self.here["measures"][name]["values"], self.there["measures"][name]["values"][1 + self.groups :]
        changes = [b - a for a, b in zip(here, there) if a is not None and b is not None]
        return sum(changes) / len(changes) if changes else 0.0

    def interface(self):
        """Of the mean profile, with the interval that leaves out groups of profiles; None where there is none."""
        mean, *without = self.there["measures"]["interface"]["values"][: 1 + self.groups]
        return None if mean is None else TimeMean(mean, jackknife_error(without))


def frequency_of(values, step):
    """Dominant frequency of a series in equal steps, 1/s: the greatest term of its Fourier sum. None for a constant one."""
    if len(values) < 8 or not step > 0:
        return None
    power = np.abs(np.fft.rfft(values - values.mean())) ** 2
    best = 1 + int(np.argmax(power[1:]))
    return best / (len(values) * step) if power[best] > 0 else None


def fluctuations(drop, time):
    """Root mean square and frequency of the pressure drop."""
    mean = time_mean(drop)
    if mean is None or len(drop) < 8:
        return {}
    found = {"pressure_rms": TimeMean(float(np.sqrt(np.mean((drop - mean.mean) ** 2))), None, mean.correlation)}
    frequency = frequency_of(drop, (time[-1] - time[0]) / (len(time) - 1))
    return found | ({} if frequency is None else {"pressure_frequency": TimeMean(float(frequency))})


def quantities_of_run(run, on):
    """Heights and centres: means of the rows of the history, moved by what the profiles stored in the window differ by if measured on the
    slabs asked for. The rest by the definitions of docs/reference/measures.md. The interval of a mean is that of time_mean(); that of a quantity of
    the mean profile leaves out groups of profiles."""
    history, species, found = run.history, species_of(run.history), RunQuantities()
    profiles = WindowProfiles(run.profiles, species, on.window)
    laid = OnSlabs(profiles, species, on) if profiles.count() else None
    drop = ratio(history["pressure_drop_Pa"], history["buoyant_weight_Pa"])
    columns = {"bed_height": history["bed_height_m"], **{f"centre_{name}": history[centre_column(name)] for name in species}}
    moved = set(columns)
    columns["pressure_drop"] = drop
    if len(species) > 1:
        columns |= {"centre_difference": centre_difference(history, species), "mixing": history["mixing"]}
    time = history["time_s"]
    for name, column in columns.items():
        rows = within(time, column, on.window)
        mean = time_mean(rows)
        if mean is None:
            continue
        if laid and name in moved:
            mean = mean._replace(mean=mean.mean + laid.change(name))
        if mean.error and len(rows) < ENOUGH * mean.correlation:
            found.too_short = name
        found.values[name] = mean
    found.values |= fluctuations(within(time, drop, on.window), within(time, time, on.window))
    if laid:
        found.profile = laid.profile
        if len(species) > 1 and (interface := laid.interface()):
            found.values["interface"] = interface
    return found
