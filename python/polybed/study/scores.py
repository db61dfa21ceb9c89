"""Two runs of one case, one by each model, measured over the same window and scored."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from polybed.quantities import measure_words
from polybed.read import kinds_among
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


def warnings_of(run, means):
    """Warnings of means that rest on too short a window. means: by name"""
    times = {name: mean.correlation for name, mean in means.items() if mean and mean.error is not None}
    slowest = max(times, key=times.get, default=None)
    warnings = []
    if run.rows < ENOUGH_ROWS:
        warnings.append(f"{run.rows} rows of its history in the window: intervals need {ENOUGH_ROWS}; a smaller output.history_every gives more")
    if slowest and run.rows < ENOUGH * times[slowest]:
        least = WINDOW_PARTS * ENOUGH * times[slowest] * run.step
        warnings.append(f"window too short for {measure_words(slowest)}: run at least {least:.3g} s")
    return warnings


def distance_score(found, goal=None):
    return Score(found.mean, found.error, goal) if found else Score(goal=goal)


def height_score(height):
    if not (height.tfm and height.dem):
        return Score(goal=GOAL)
    quotient = height.tfm.mean / height.dem.mean
    score = Score(quotient - 1, goal=GOAL)
    if height.tfm.error is not None and height.dem.error is not None:
        score.error = math.hypot(height.tfm.error / height.dem.mean, quotient * height.dem.error / height.dem.mean)
    return score


def compare(tfm, dem):
    """Measures and scores of two runs of one case, both Measured. Raises ProgramError if their species or slabs are not the same."""
    window, runs, distances = means_of(tfm.directory, beside=dem.directory)
    species = list(runs[0].fraction)
    kinds = list(kinds_among(species))  # size classes count as one
    several, centres = len(kinds) > 1, dict.fromkeys(map(centre_column, [*species, *kinds]))
    names = ["bed_height_m", "pressure_drop_Pa", "pressure_drop_over_weight", *centres,
             *(["centre_difference", "mixing"] if several else [])]
    measures = {name: Measure(*(run.means.get(name) for run in runs)) for name in names}
    scores = {"e_H": height_score(measures["bed_height_m"])}
    if several:
        measures["interface_m"] = Measure(*(run.of_profile.get("interface_m") for run in runs))
        b = measures["centre_difference"]
        scores |= {"e_b": Score(b.difference, b.difference_error, GOAL), "D1": distance_score(distances.get("composition"), GOAL)}
    scores |= {f"profile_{name}": distance_score(distances.get(f"profile_{name}")) for name in species}
    found = Comparison(window, species, runs[0].height, {}, {}, measures, scores)
    for model, run, drifts in zip(MODELS, runs, (tfm.drifts, dem.drifts)):
        means = {name: getattr(measure, model) for name, measure in measures.items()}
        found.profiles[model], found.fraction[model] = run.profiles, run.fraction
        found.top[model] = on_top({name: means[centre_column(name)] for name in kinds})
        found.warnings += [f"{model}: {line}" for line in (*warnings_of(run, means), *drifts)]
    if not all(found.profiles.values()):
        found.warnings.append("no stored profile of both runs in the window: a smaller output.every stores more")
    return found


def add_inversion(comparison, scan, path, velocity):
    """Adds the result of a scan by both models as the score u_inv. Near an inversion the goal of D1 is wider, because a small difference
    decides about the layers there.

    scan: inversion.json; path: its file; velocity: at which the runs of the comparison are, m/s, or None
    """
    found = [scan["models"][model]["velocity_m_s"] for model in MODELS]
    near = velocity is not None and bool((np.abs(velocity / np.array(found) - 1) <= NEAR_INVERSION).any())
    if near and "D1" in comparison.scores:
        comparison.scores["D1"].goal = COMPOSITION_GOAL_NEAR_INVERSION
    agreement = scan["agreement"]
    comparison.scores["u_inv"] = Score(agreement["value"], agreement["error"], agreement["goal"])
    comparison.inversion_file = str(path)
