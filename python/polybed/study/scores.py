"""Two runs of one case, one by each model, measured over the same window and scored."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from polybed.quantities import measure_words
from polybed.study.measured import TimeMean, centre_column, means_of

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
    fraction: dict  # mean profiles by model and species: "mean" and "interval" in the slabs
    measures: dict = field(default_factory=dict)  # by name with its unit
    scores: dict = field(default_factory=dict)  # by name: e_H, e_b, D1, profile_<name>, u_inv
    top: dict = field(default_factory=dict)  # by model; of one species None
    inversion_file: str | None = None  # where u_inv is from
    warnings: list = field(default_factory=list)


def on_top(centres):
    """centres: time means by species"""
    if len(centres) < 2 or None in centres.values():
        return None
    (name, first), (_, second) = sorted(centres.items(), key=lambda entry: -entry[1].mean)[:2]
    known = first.error is not None and second.error is not None
    return OnTop(name, bool(known and first.mean - second.mean > math.hypot(first.error, second.error)))


class Comparer:
    """Makes a comparison piece by piece."""

    def __init__(self, tfm, dem):
        window, runs, self.distances = means_of(tfm.directory, beside=dem.directory)
        self.sides, self.drifts = dict(zip(MODELS, runs)), {"tfm": tfm.drifts, "dem": dem.drifts}
        self.found = Comparison(window, list(runs[0].fraction), runs[0].height, {m: s.profiles for m, s in self.sides.items()},
                                {m: s.fraction for m, s in self.sides.items()})

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

    def measure(self):
        several = len(self.found.species) > 1
        names = ["bed_height_m", "pressure_drop_Pa", "pressure_drop_over_weight", *map(centre_column, self.found.species),
                 *(["centre_difference", "mixing"] if several else [])]
        self.found.measures = {name: Measure(*(side.means.get(name) for side in self.sides.values())) for name in names}
        if several:
            self.found.measures["interface_m"] = Measure(*(side.of_profile.get("interface_m") for side in self.sides.values()))

    def distance(self, name, goal=None):
        found = self.distances.get(name)
        return Score(found.mean, found.error, goal) if found else Score(goal=goal)

    def score(self):
        measures, scores = self.found.measures, self.found.scores
        scores["e_H"] = height_score(measures["bed_height_m"])
        if len(self.found.species) > 1:
            b = measures["centre_difference"]
            scores["e_b"] = Score(b.difference, b.difference_error, GOAL)
            scores["D1"] = self.distance("composition", GOAL)
        for name in self.found.species:
            scores[f"profile_{name}"] = self.distance(f"profile_{name}")

    def warn_of(self, model):
        """What makes a mean of a run less than it seems: a window too short, a run that still drifts."""
        side, warnings = self.sides[model], []
        if side.rows < ENOUGH_ROWS:
            warnings.append(f"{side.rows} rows of its history in the window: intervals need {ENOUGH_ROWS}; a smaller output.history_every "
                            "gives more")
        means = {name: getattr(measure, model) for name, measure in self.found.measures.items()}
        times = {name: mean.correlation for name, mean in means.items() if mean and mean.error is not None}
        slowest = max(times, key=times.get, default=None)
        if slowest and side.rows < ENOUGH * times[slowest]:
            least = WINDOW_PARTS * ENOUGH * times[slowest] * side.step
            warnings.append(f"window too short for {measure_words(slowest)}: run at least {least:.3g} s")
        self.found.warnings += [f"{model}: {line}" for line in (*warnings, *self.drifts[model])]


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
    """Measures and scores of two runs of one case, both Measured. Raises ProgramError if their species or slabs are not the same."""
    return Comparer(tfm, dem).make()


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
