"""A comparison as it is written, comparison.json, and as tables for the screen."""

import os

from polybed.drawing.units import fitting
from polybed.files import contents_of
from polybed.quantities import measure_words, unit_of_column
from polybed.study.scores import MODELS

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


SCORES = {"e_H": "e_H  bed height", "e_b": "e_b  distance of centres", "D1": "D1   layering", "u_inv": "u_inv  inversion velocity"}


def score_line(name, score):
    line = f"{SCORES.get(name, name):30} {with_error(score['value'], score['error']):>20}"
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
    lines += [f"{'on top':30} {top_text(order['tfm']):>20} {top_text(order['dem']):>20}", "",
              "scores: 0 where the models agree (polybed explain e_H)"]
    lines += [score_line(name, score) for name, score in record["scores"].items() if name != "order"]
    lines += ["", *(line for model, run in record["models"].items() for line in work_lines(model, run))]
    return "\n".join([*lines, *(f"warning: {line}" for line in record["warnings"])])
