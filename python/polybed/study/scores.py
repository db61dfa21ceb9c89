"""Two runs of one case, one by each model, measured over the same window and scored, as comparison.json has it."""

import math

import numpy as np

from polybed.quantities import measure_words
from polybed.read import kinds_among
from polybed.folder import drift_lines
from polybed.study.measured import centre_column, means_of

ENOUGH = 30  # autocorrelation times in a window
ENOUGH_ROWS = 20  # of the history, for an interval
WINDOW_PARTS = 4  # windows in a run
GOAL = 0.05
COMPOSITION_GOAL_NEAR_INVERSION = 0.1
NEAR_INVERSION = 0.05  # of a velocity over that of the inversion, less 1
CONFIDENCE = 0.95  # of all intervals
MODELS = ("tfm", "dem")


def joint_error(first, second):
    """Half-width of the 95 % interval of the difference of two means; None if one is not known."""
    known = first and second and None not in (first.error, second.error)
    return math.hypot(first.error, second.error) if known else None


def measure(tfm, dem):
    """Time means by both models, None where a run has none, and their difference."""
    found = {}
    for model, mean in zip(MODELS, (tfm, dem)):
        found |= {model: mean and mean.mean, f"{model}_error": mean and mean.error}
    return found | {"difference": tfm.mean - dem.mean if tfm and dem else None, "difference_error": joint_error(tfm, dem)}


def score(value=None, error=None, goal=None):
    """How far apart the models are, and how far they may be; it is reached if the value itself, whatever its interval, is within the goal."""
    return {"value": value, "error": error, "goal": goal, "reached": None if value is None or goal is None else abs(value) <= goal}


def on_top(centres):
    """The species with the highest centre; certain if the two highest differ by more than the interval of their difference. None for one
    species. centres: time means by species"""
    if len(centres) < 2 or None in centres.values():
        return None
    (name, first), (_, second) = sorted(centres.items(), key=lambda entry: -entry[1].mean)[:2]
    error = joint_error(first, second)
    return {"species": name, "certain": error is not None and first.mean - second.mean > error}


def too_short(run, means):
    """(the slowest quantity, how long a run has to be for its mean, s, up to the next two digits), of a window that is too short; else None.
    means: by name"""
    times = {name: mean.correlation for name, mean in means.items() if mean and mean.error is not None}
    slowest = max(times, key=times.get, default=None)
    if slowest is None or run.rows >= ENOUGH * times[slowest]:
        return None
    least = WINDOW_PARTS * ENOUGH * times[slowest] * run.step
    digit = 10.0 ** (math.floor(math.log10(least)) - 1)
    return slowest, math.ceil(least / digit) * digit


def warnings_of(run, short):
    """Warnings of means that rest on too short a window. short: of too_short"""
    warnings = []
    if run.rows < ENOUGH_ROWS:
        warnings.append(f"{run.rows} rows of its history in the window: intervals need {ENOUGH_ROWS}; a smaller output.history_every gives more")
    if short:
        warnings.append(f"window too short for {measure_words(short[0])}: run at least {short[1]:.4g} s")
    return warnings


def distance_score(found, goal=None):
    return score(found.mean, found.error, goal) if found else score(goal=goal)


def height_score(tfm, dem):
    """The ratio of the bed heights, less 1."""
    if not (tfm and dem):
        return score(goal=GOAL)
    quotient, error = tfm.mean / dem.mean, None
    if None not in (tfm.error, dem.error):
        error = math.hypot(tfm.error / dem.mean, quotient * dem.error / dem.mean)
    return score(quotient - 1, error, GOAL)


def scores_of(means, measures, distances, species, kinds):
    """Scores by name, e_H, e_b, D1, profile_<name>, and the order of the layers. means: by model and name; kinds: species with their classes
    as one"""
    found = {"e_H": height_score(*(of["bed_height_m"] for of in means.values()))}
    if len(kinds) > 1:
        b = measures["centre_difference"]
        found |= {"e_b": score(b["difference"], b["difference_error"], GOAL), "D1": distance_score(distances.get("composition"), GOAL)}
    found |= {f"profile_{name}": distance_score(distances.get(f"profile_{name}")) for name in species}
    top = {model: on_top({name: of[centre_column(name)] for name in kinds}) for model, of in means.items()}
    same = top["tfm"]["species"] == top["dem"]["species"] if all(top.values()) else None
    return found | {"order": top | {"same": same}}


def compare(tfm, dem):
    """What comparison.json says of two runs of one case, opened by `measured`, the number of their profiles in the window, and how long runs
    have to be for their means, s, or 0. Raises ProgramError if their species or slabs are not the same."""
    window, runs, distances = means_of(tfm.directory, beside=dem.directory)
    by_model, species = dict(zip(MODELS, runs)), list(runs[0].fraction)
    kinds = list(kinds_among(species))
    several, centres = ["centre_difference", "mixing"] if len(kinds) > 1 else [], dict.fromkeys(map(centre_column, [*species, *kinds]))
    names = ["bed_height_m", "pressure_drop_Pa", "pressure_drop_over_weight", *centres, *several]
    means = {model: {name: run.means.get(name) for name in names} for model, run in by_model.items()}
    for model, run in by_model.items() if several else ():
        means[model]["interface_m"] = run.of_profile.get("interface_m")
    measures = {name: measure(means["tfm"][name], means["dem"][name]) for name in means["tfm"]}
    fractions = {model: {f"phi_{name}": {"mean": of["mean"], "error": of["interval"]} for name, of in run.fraction.items()}
                 for model, run in by_model.items()}
    profiles = {model: run.profiles for model, run in by_model.items()}
    short = {model: too_short(run, means[model]) for model, run in by_model.items()}
    warnings = [f"{model}: {line}" for model, of in (("tfm", tfm), ("dem", dem))
                for line in (*warnings_of(by_model[model], short[model]), *drift_lines(of.record))]
    if not all(profiles.values()):
        warnings.append("no stored profile of both runs in the window: a smaller output.every stores more")
    return {"window": {"begin_s": window.begin, "end_s": window.end, "shortened": window.shortened, "confidence": CONFIDENCE},
            "measures": measures, "mean_profiles": {"y_m": runs[0].height} | fractions,
            "scores": scores_of(means, measures, distances, species, kinds), "profiles": profiles, "warnings": warnings,
            "least_time": max((one[1] for one in short.values() if one), default=0.0)}


def add_inversion(comparison, scan, path, velocity):
    """Adds the result of a scan by both models as the score u_inv. Near an inversion the goal of D1 is wider, because a small difference
    decides about the layers there.

    scan: inversion.json; path: its file; velocity: at which the runs of the comparison are, m/s, or None
    """
    scores = comparison["scores"]
    found = [scan["models"][model]["velocity_m_s"] for model in MODELS]
    near = velocity is not None and bool((np.abs(velocity / np.array(found) - 1) <= NEAR_INVERSION).any())
    if near and "D1" in scores:
        scores["D1"] = score(scores["D1"]["value"], scores["D1"]["error"], COMPOSITION_GOAL_NEAR_INVERSION)
    agreement = scan["agreement"]
    scores["u_inv"] = score(agreement["value"], agreement["error"], agreement["goal"])
    scores["order"] = scores.pop("order")  # remains the last
    comparison["inversion_file"] = str(path)
