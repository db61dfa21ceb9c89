"""Two runs of one case, one by each model, measured over the same window and scored: as comparison.json has it, and as tables for the screen."""

import math
import os

import numpy as np

from polybed.files import contents_of
from polybed.folder import drift_lines
from polybed.quantities import measure_words, unit_of_column
from polybed.read import kinds_among
from polybed.study.measured import centre_column, means_of
from polybed.study.recovery import is_recovery, recoveries
from polybed.texts import fitting

ENOUGH = 30  # autocorrelation times in a window
ENOUGH_ROWS = 20  # of the history, for an interval
WINDOW_PARTS = 4  # windows in a run
GOAL = 0.05
COMPOSITION_GOAL_NEAR_INVERSION = 0.1
NEAR_INVERSION = 0.05  # of a velocity over that of the inversion, less 1
CONFIDENCE = 0.95  # of all intervals
MODELS = ("tfm", "dem")
SLIP = "superficial_slip_m_s"  # of a box whose ends are joined


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
    """How far apart the models are, and how far they are allowed to be; it is reached if the value itself, whatever its interval, is within the goal."""
    return {"value": value, "error": error, "goal": goal, "reached": None if value is None or goal is None else abs(value) <= goal}


def on_top(centres):
    """The species with the highest mean centre, certain beyond the interval of the difference; None for one. centres: by species"""
    if len(centres) < 2 or None in centres.values():
        return None
    (name, first), (_, second) = sorted(centres.items(), key=lambda entry: -entry[1].mean)[:2]
    error = joint_error(first, second)
    return {"species": name, "certain": error is not None and first.mean - second.mean > error}


def too_short(run, means):
    """(the slowest quantity, how long a run has to be for its mean, s, up to the next two digits), of a window that is too short; else None.
    means: by name"""
    swing = 1e-4  # of the mean: below it a longer window tells no more
    known = {name: mean for name, mean in means.items() if mean and mean.error is not None}
    times = {name: mean.correlation for name, mean in known.items() if mean.error > swing * abs(mean.mean)}
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


def ratio_score(tfm, dem):
    """The ratio of two means, less 1."""
    if not (tfm and dem):
        return score(goal=GOAL)
    quotient, error = tfm.mean / dem.mean, None
    if None not in (tfm.error, dem.error):
        error = math.hypot(tfm.error / dem.mean, quotient * dem.error / dem.mean)
    return score(quotient - 1, error, GOAL)


def recovery_score(of):
    """The goal is the interval of the difference. Without one it is the least that it can be, that of the particles, and a greater difference is
    undecided."""
    known = of["difference_error"] is not None
    found = score(of["difference"], of["difference_error"], of["difference_error"] if known else of["dem_error"])
    return found if known or found["reached"] else found | {"reached": None}


def scores_of(means, measures, distances, species, kinds):
    """Scores by name, and the order of the layers. means: by model and name; kinds: species with their classes as one."""
    if SLIP in measures:
        return {"e_slip": ratio_score(*(of[SLIP] for of in means.values())), "order": {"tfm": None, "dem": None, "same": None}}
    found = {"e_H": ratio_score(*(of["bed_height_m"] for of in means.values()))}
    if len(kinds) > 1:
        b = measures["centre_difference"]
        found |= {"e_b": score(b["difference"], b["difference_error"], GOAL), "D1": distance_score(distances.get("composition"), GOAL)}
    found |= {f"profile_{name}": distance_score(distances.get(f"profile_{name}")) for name in species}
    found |= {name: recovery_score(of) for name, of in measures.items() if is_recovery(name)}
    top = {model: on_top({name: of[centre_column(name)] for name in kinds}) for model, of in means.items()}
    same = top["tfm"]["species"] == top["dem"]["species"] if all(top.values()) else None
    return found | {"order": top | {"same": same}}


def compare(tfm, dem):
    """comparison.json of two runs of one case, their profiles in the window, and the least time, s, for their means, or 0. Raises ProgramError if
    species or slabs differ."""
    window, runs, distances = means_of(tfm.directory, beside=dem.directory)
    by_model, species = dict(zip(MODELS, runs)), list(runs[0].fraction)
    kinds = list(kinds_among(species))
    several, centres = ["centre_difference", "mixing"] if len(kinds) > 1 else [], dict.fromkeys(map(centre_column, [*species, *kinds]))
    names = ["bed_height_m", "pressure_drop_Pa", "pressure_drop_over_weight", *centres, *several]
    if SLIP in runs[0].means:  # a box without ends has no heights
        names, several = [SLIP, *(f"slip_{name}_m_s" for name in species), "pressure_gradient_Pa_m"], []
    means = {model: {name: run.means.get(name) for name in names} for model, run in by_model.items()}
    for model, run in by_model.items() if several else ():
        means[model]["interface_m"] = run.of_profile.get("interface_m")
    measures = {name: measure(means["tfm"][name], means["dem"][name]) for name in means["tfm"]}
    measures |= {name: measure(*pair) for name, pair in recoveries(tfm, dem, species, window).items()}
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
    """Adds a scan by both models (inversion.json at a path) as the score u_inv. Near an inversion the goal of D1 is wider, because a small
    difference decides about the layers there. velocity: of the comparison, m/s, or None"""
    scores = comparison["scores"]
    found = [scan["models"][model]["velocity_m_s"] for model in MODELS]
    near = velocity is not None and bool((np.abs(velocity / np.array(found) - 1) <= NEAR_INVERSION).any())
    if near and "D1" in scores:
        scores["D1"] = score(scores["D1"]["value"], scores["D1"]["error"], COMPOSITION_GOAL_NEAR_INVERSION)
    agreement = scan["agreement"]
    scores["u_inv"] = score(agreement["value"], agreement["error"], agreement["goal"])
    scores["order"] = scores.pop("order")  # remains the last
    comparison["inversion_file"] = str(path)


# Counters of run.json that the screen shows, with their words.
COUNTERS = {"rhs_evaluations": "evaluations of the equations", "linear_iterations": "linear iterations", "steps": "steps",
            "particle_steps": "particle steps", "pair_checks": "checks of pairs"}


def plain_run(directory, record, profiles):
    with contents_of(os.path.join(directory, "run.json")):
        counts = {name: count for name, count in sorted(record["work"].items()) if type(count) in (int, float)}
        return {"work": counts, "cpu_s": record["cpu_s"], "wall_s": record.get("wall_s"), "time_s": record["time_s"],
                "ranks": record["ranks"], "state": record["state"], "directory": directory, "case_hash": record["case_hash"],
                "git_commit": record["git_commit"], "profiles_in_window": profiles}


def plain(found, case, directory, runs):
    """comparison.json. found: of scores.compare; case: a Case; directory: of the comparison; runs: (folder, record) by model"""
    parts = {part: found[part] for part in ("window", "measures", "mean_profiles", "scores")}
    models = {model: plain_run(*runs[model], found["profiles"][model]) for model in MODELS}
    of_scan = {"inversion_file": found["inversion_file"]} if "inversion_file" in found else {}
    return {"filetype": "polybed comparison", "version": 1, "git_commit": case.git_commit, "case": case.path, "directory": directory,
            "overrides": case.overrides, **parts, "models": models, **of_scan, "warnings": found["warnings"]}


def with_error(value, error=None):
    """A number with its half-width, to the digits that the half-width leaves."""
    if value is None:
        return "\u2013"
    return f"{value:.4g}" + ("" if error is None else f" \u00b1 {error:.1g}")


def top_text(top):
    return "-" if top is None else top["species"] + ("" if top["certain"] else " (within the uncertainty)")


SCORES = {"e_H": "e_H  bed height", "e_b": "e_b  distance of centres", "D1": "D1   layering", "u_inv": "u_inv  inversion velocity",
          "e_slip": "e_slip  superficial slip"}


def score_words(name):
    return measure_words(name) if is_recovery(name) else SCORES.get(name, name)


RECOVERY = {True: "within the interval: reached", False: "outside the interval: missed", None: "undecided: no interval of the difference"}


def score_line(name, score):
    line = f"{score_words(name):30} {with_error(score['value'], score['error']):>20}"
    if is_recovery(name):
        return f"{line}   {RECOVERY[score['reached']]}"
    if score["goal"] is None:
        return line
    return line + f"   goal {score['goal']:.2g}" + {True: ": reached", False: ": missed", None: ""}[score["reached"]]


def work_lines(model, run):
    wall = "" if run["wall_s"] is None else f", {run['wall_s']:.3g} s by the clock"
    counts = ", ".join(f"{run['work'][name]:.4g} {words}" for name, words in COUNTERS.items() if name in run["work"])
    return [f"{model}: {run['state']}, {run['time_s']:.4g} s simulated, {run['cpu_s']:.3g} CPU s{wall}  "
            f"[{os.path.join(run['directory'], 'run.json')}]", *([f"     {counts}"] if counts else [])]


def measure_cells(name, measure):
    """What a measure is called, and both models and their difference in the unit that fits."""
    known = [abs(measure[model]) for model in MODELS if measure[model] is not None]
    factor, unit = fitting(unit_of_column(name), max(known, default=0))
    scaled = {key: None if value is None else value * factor for key, value in measure.items()}
    return [measure_words(name) + (f" ({unit})" if unit else ""), *((scaled[what], scaled[f"{what}_error"]) for what in (*MODELS, "difference"))]


def table(record):
    window, order = record["window"], record["scores"]["order"]
    cells = [measure_cells(name, measure) for name, measure in record["measures"].items()]
    lines = [f"means from {window['begin_s']:.4g} to {window['end_s']:.4g} s, \u00b1 95 %",
             f"{'':30} {'two-fluid (tfm)':>20} {'particles (dem)':>20} {'difference':>20}",
             *(" ".join([f"{title:30}", *(f"{with_error(*number):>20}" for number in numbers)]) for title, *numbers in cells)]
    if any(order[model] for model in MODELS):
        lines.append(f"{'on top':30} {top_text(order['tfm']):>20} {top_text(order['dem']):>20}")
    lines += ["", f"scores: 0 where the models agree (polybed explain {next(iter(record['scores']))})"]
    lines += [score_line(name, score) for name, score in record["scores"].items() if name != "order"]
    lines += ["", *(line for model, run in record["models"].items() for line in work_lines(model, run))]
    return "\n".join([*lines, *(f"warning: {line}" for line in record["warnings"])])
