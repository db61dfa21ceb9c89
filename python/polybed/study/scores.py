"""Two runs of one case, one by each model, measured over the same window and scored."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from polybed.files import FormatError
from polybed.quantities import measure_words
from polybed.study.measured import (WindowProfiles, centre_column, centre_difference, measures_of, ratio, species_of, window_of,
                                    within)
from polybed.study.time_mean import TimeMean, jackknife_error, student_quantile, time_mean

ENOUGH = 30  # autocorrelation times in a window
ENOUGH_ROWS = 20  # of the history, for an interval
WINDOW_PARTS = 4  # windows in a run
GOAL = 0.05
COMPOSITION_GOAL_NEAR_INVERSION = 0.1
NEAR_INVERSION = 0.05  # of a velocity over that of the inversion, less 1
MODELS = ("tfm", "dem")


class Measure(NamedTuple):
    """A time mean by both models; None where a run has none."""
    tfm: TimeMean | None
    dem: TimeMean | None

    @property
    def difference(self):
        """TFM less DEM."""
        return self.tfm.mean - self.dem.mean if self.tfm and self.dem else None

    @property
    def difference_error(self):
        """Half-width of its 95 % interval."""
        known = self.tfm and self.dem and self.tfm.error is not None and self.dem.error is not None
        return math.hypot(self.tfm.error, self.dem.error) if known else None


@dataclass
class Score:
    """How far apart the models are, and how far they may be."""
    value: float | None = None
    error: float | None = None  # half-width of the 95 % interval
    goal: float | None = None

    @property
    def reached(self):
        """Whether the value itself, whatever its interval, is within the goal; None without one of them."""
        return None if self.value is None or self.goal is None else abs(self.value) <= self.goal


class OnTop(NamedTuple):
    """The species with the highest centre."""
    species: str
    certain: bool  # the centres of the two highest differ by more than the interval of their difference


@dataclass
class Comparison:
    window: tuple
    species: list
    height: list  # of the slabs' centres, m
    profiles: dict  # number of stored profiles in the window, by model
    means: dict  # mean profiles by model, [species][slab]
    measures: dict = field(default_factory=dict)  # by name with its unit
    scores: dict = field(default_factory=dict)  # by name: e_H, e_b, D1, profile_<name>, u_inv
    top: dict = field(default_factory=dict)  # by model; of one species None
    inversion_file: str | None = None  # where u_inv is from
    warnings: list = field(default_factory=list)


class Side:
    """A run with what it has in the window."""

    def __init__(self, measured, species, window):
        self.history, self.species, self.drifts = measured.history, species, measured.drifts
        self.profiles = WindowProfiles(measured.profiles, species, window)
        self.answer = None

    def mean(self):
        return self.profiles.mean() if self.profiles.count() else None

    def measure(self, reference):
        """Has the mean profile measured, and those without each group of a jackknife, against a reference that may be None."""
        if self.profiles.count():
            self.answer = measures_of([self.mean(), *self.profiles.means_without_groups()], self.species, reference=reference)

    def interface(self):
        """Of the mean profile, as the thesis defines it."""
        found, *without = self.answer["measures"]["interface"]["values"] if self.answer else [None]
        return None if found is None else TimeMean(found, jackknife_error(without))

    def distances(self, name):
        """From the other run's mean: of the mean profile, and of those without each group."""
        found, *without = self.answer["distances"][name]
        return found, without


def turned(side, other, species, without):
    """Distances of the other's mean from profiles of a side, by those of these profiles from that mean: the integral of the difference is
    the same, and is divided by the volume of the species in what it is told from."""
    whole = other.mean().fraction[species].sum()
    volumes = [profile.fraction[species].sum() for profile in side.profiles.means_without_groups()]
    return [None if value is None or not volume > 0 else value * whole / volume for value, volume in zip(without, volumes, strict=True)]


def error_of_both(without_tfm, without_dem):
    """Half-width of the interval of what either run's groups vary."""
    errors = [jackknife_error(without) for without in (without_tfm, without_dem)]
    if None in errors:
        return None
    degrees = [len(without) - 1 for without in (without_tfm, without_dem)]
    deviations = [error / student_quantile(free) for error, free in zip(errors, degrees)]
    return student_quantile(min(degrees)) * math.hypot(*deviations)


def distance_score(tfm, dem, name, goal=None, species=None):
    """A distance between the mean profiles, its interval from leaving out groups of either model's. species: number of the one whose
    profiles are told apart; None: of the composition, which is the same in both directions"""
    if not (tfm.answer and dem.answer):
        return Score(goal=goal)
    value, without_tfm = tfm.distances(name)
    _, without_dem = dem.distances(name)
    if species is not None:
        without_dem = turned(dem, tfm, species, without_dem)
    return Score(value, None if value is None else error_of_both(without_tfm, without_dem), goal)


def on_top(centres):
    """centres: time means by species"""
    if len(centres) < 2 or None in centres.values():
        return None
    (name, first), (_, second) = sorted(centres.items(), key=lambda entry: -entry[1].mean)[:2]
    known = first.error is not None and second.error is not None
    return OnTop(name, bool(known and first.mean - second.mean > math.hypot(first.error, second.error)))


class Comparer:
    """Makes a comparison piece by piece."""

    def __init__(self, tfm, dem, species):
        window = window_of(tfm.history, dem.history)
        self.sides = {"tfm": Side(tfm, species, window), "dem": Side(dem, species, window)}
        one, other = self.sides.values()
        one.measure(other.mean())
        other.measure(one.mean())
        self.found = Comparison(window, species, list(tfm.profiles["y_m"]), {m: s.profiles.count() for m, s in self.sides.items()},
                                {m: s.profiles.time_means() for m, s in self.sides.items()})

    def make(self):
        self.measure()
        self.score()
        species, measures = self.found.species, self.found.measures
        self.found.top = {model: on_top({name: getattr(measures[centre_column(name)], model) for name in species}) for model in MODELS}
        for model in MODELS:
            self.warn_of(model)
        if not all(self.found.profiles.values()):
            self.found.warnings.append("no stored profile of both runs in the window: a smaller output.every stores more")
        return self.found

    def add(self, name, values_of):
        means = (time_mean(within(side.history["time_s"], values_of(side.history), self.found.window)) for side in self.sides.values())
        self.found.measures[name] = Measure(*means)

    def measure(self):
        species = self.found.species
        for name in ("bed_height_m", "pressure_drop_Pa"):
            self.add(name, lambda history, name=name: history[name])
        self.add("pressure_drop_over_weight", lambda history: ratio(history["pressure_drop_Pa"], history["buoyant_weight_Pa"]))
        for name in map(centre_column, species):
            self.add(name, lambda history, name=name: history[name])
        if len(species) > 1:
            self.add("centre_difference", lambda history: centre_difference(history, species))
            self.add("mixing", lambda history: history["mixing"])
            self.found.measures["interface_m"] = Measure(*(side.interface() for side in self.sides.values()))

    def score(self):
        measures, scores, (tfm, dem) = self.found.measures, self.found.scores, self.sides.values()
        scores["e_H"] = height_score(measures["bed_height_m"])
        if len(self.found.species) > 1:
            b = measures["centre_difference"]
            scores["e_b"] = Score(b.difference, b.difference_error, GOAL)
            scores["D1"] = distance_score(tfm, dem, "composition", GOAL)
        for number, name in enumerate(self.found.species):
            scores[f"profile_{name}"] = distance_score(tfm, dem, f"profile_{name}", species=number)

    def warn_of(self, model):
        """What makes a mean of a run less than it seems: a window too short, a run that still drifts."""
        history, window = self.sides[model].history, self.found.window
        time, warnings = within(history["time_s"], history["time_s"], window), []
        if len(time) < ENOUGH_ROWS:
            warnings.append(f"{len(time)} rows of its history in the window: intervals need {ENOUGH_ROWS}; a smaller output.history_every "
                            "gives more")
        step = (time[-1] - time[0]) / (len(time) - 1) if len(time) > 1 else 0
        means = {name: getattr(measure, model) for name, measure in self.found.measures.items()}
        times = {name: mean.correlation for name, mean in means.items() if mean and mean.error is not None}
        slowest = max(times, key=times.get, default=None)
        if slowest and len(time) < ENOUGH * times[slowest]:
            warnings.append(f"window too short for {measure_words(slowest)}: run at least {WINDOW_PARTS * ENOUGH * times[slowest] * step:.3g} s")
        self.found.warnings += [f"{model}: {line}" for line in (*warnings, *self.sides[model].drifts)]


def height_score(height):
    """The quotient of the bed heights less 1."""
    if not (height.tfm and height.dem):
        return Score(goal=GOAL)
    quotient = height.tfm.mean / height.dem.mean
    score = Score(quotient - 1, goal=GOAL)
    if height.tfm.error is not None and height.dem.error is not None:
        score.error = math.hypot(height.tfm.error / height.dem.mean, quotient * height.dem.error / height.dem.mean)
    return score


def compare(tfm, dem):
    """Measures and scores of two runs of one case, both Measured. Raises FormatError if their species or slabs are not the same."""
    species = species_of(tfm.history)
    if species != species_of(dem.history) or not species:
        raise FormatError("the runs are of other species")
    heights, others = tfm.profiles["y_m"], dem.profiles["y_m"]
    if not len(heights) or len(heights) != len(others) or not abs(heights[-1] - others[-1]) < 1e-9 * heights[-1]:
        raise FormatError("the runs' profiles.h5 have other slabs")
    return Comparer(tfm, dem, species).make()


def add_inversion(comparison, scan, path, velocity):
    """Adds what a scan by both models has found as the score u_inv; a comparison near to an inversion has a wider goal of D1, as a smaller
    difference of the layers decides there.

    scan: inversion.json; path: its file; velocity: at which the runs of the comparison are, m/s, or None
    """
    found = [scan["models"][model]["velocity_m_s"] for model in MODELS]
    near = velocity is not None and bool((np.abs(velocity / np.array(found) - 1) <= NEAR_INVERSION).any())
    if near and "D1" in comparison.scores:
        comparison.scores["D1"].goal = COMPOSITION_GOAL_NEAR_INVERSION
    agreement = scan["agreement"]
    comparison.scores["u_inv"] = Score(agreement["value"], agreement["error"], agreement["goal"])
    comparison.inversion_file = str(path)
