"""The picture of a sweep of costs, error across and seconds for a simulated second up in a panel for each quantity; and cost.html."""

import shlex

import matplotlib.pyplot as plt

from polybed.cost.report import advice, definitions, runs_of, shares_of
from polybed.cost.sweep import AXES, CLOCKS
from polybed.drawing.style import COLOURS, GREY, NAMES, PALE, colour, fitted, shortened
from polybed.page import Html, file_name, listing, markup, page, picture, section, source, table, warnings
from polybed.program import name_of
from polybed.folder import title_of_case
from polybed.runner import words_of

MARKS = ["o", "s", "^", "D", "v", "P"]
LEAST = 1e-7  # an error of 0 is drawn here


def point(run, quantity):
    """(error, interval, cost) of a run; None where it has none."""
    measured = run["qoi"].get(quantity)
    if measured is None or not run["s_per_sim_s"] > 0:
        return None
    return max(measured["error"], LEAST), measured["error_ci"] or 0, run["s_per_sim_s"]


def lines_of(runs, quantity):
    """Runs that differ from the first in one axis alone, by axis, in the order they were run."""
    candidates = [run for run in runs if run["kind"] == "candidate" and run["settings"]]
    if not candidates:
        return {}
    centre, lines = candidates[0], {}
    for run in candidates[1:]:
        changed = [axis for axis, level in run["settings"].items() if level != centre["settings"].get(axis)]
        if len(changed) == 1 and point(run, quantity):
            lines.setdefault(changed[0], []).append(run)
    return {axis: [centre, *found] for axis, found in lines.items()}


def band(axes, runs, quantity):
    """How far models are apart: the range of their errors."""
    errors = [p[0] for p in (point(run, quantity) for run in runs if run["status"] == "model" and run["kind"] == "model") if p]
    if len(errors) > 1:
        axes.axvspan(min(errors), max(errors), color=PALE, alpha=0.3, lw=0, label="models")


def draw_points(axes, runs, quantity):
    for run in runs:
        found, predicted = point(run, quantity), run.get("predicted")
        if run["kind"] == "twin":
            continue
        if run["status"] in ("failed", "refused"):
            place = (found[0], found[2]) if found else (predicted["error"], predicted["cost"]) if predicted else None
            if place:
                axes.plot(max(place[0], LEAST), place[1], "x", color="black", zorder=4)
        elif found:
            error, interval, cost = found
            solid = run["status"] in ("pareto", "dominated")
            axes.errorbar(error, cost, xerr=[[min(interval, 0.9 * error)], [interval]], fmt="o", markersize=4.5, elinewidth=0.7, zorder=3,
                          color=GREY if run["kind"] != "model" else PALE, markerfacecolor=GREY if solid else "white")


def draw_front(axes, sweep, quantity):
    if front := sorted(filter(None, (point(sweep["runs"][n], quantity) for n in sweep["pareto"]))):
        axes.plot([p[0] for p in front], [p[2] for p in front], color="black", lw=2.5, alpha=0.6, zorder=2, label="front")
    for advised in sweep["recommend"]:
        if chosen := point(sweep["runs"][advised["run"]], quantity):
            axes.plot(chosen[0], chosen[2], "*", color=COLOURS[1], markersize=13, zorder=4, label="recommended")


def draw(sweep, _folder=None):
    """The figure of a sweep as read from cost.json."""
    shown = [q for q in sweep["qoi"] if q["shown"]]
    figure, all_axes = plt.subplots(1, len(shown), figsize=(4.6 * len(shown), 3.9), squeeze=False, layout="constrained")
    for axes, quantity in zip(all_axes[0], shown):
        band(axes, sweep["runs"], quantity["id"])
        for n, (name, runs) in enumerate(lines_of(sweep["runs"], quantity["id"]).items()):
            places = sorted(p for p in (point(run, quantity["id"]) for run in runs) if p)
            axes.plot([p[0] for p in places], [p[2] for p in places], color=colour(n), lw=1,
                      marker=MARKS[n % len(MARKS)], markersize=3, label=AXES.get(name, name))
        draw_points(axes, sweep["runs"], quantity["id"])
        draw_front(axes, sweep, quantity["id"])
        floor = sweep["reference"]["floor"].get(quantity["id"], 0)
        if floor > LEAST:
            axes.axvline(floor, color=GREY, lw=0.7, ls=":")
        words = quantity["id"].replace("_", " ")
        axes.set(xscale="log", yscale="log", xlabel=f"error of the {words}", title=words)
        if axes.get_legend_handles_labels()[1]:
            axes.legend(fontsize=7)
    all_axes[0][0].set_ylabel(f"{CLOCKS[sweep['clock']]} for a simulated second (s)")
    figure.suptitle(fitted(f"{shortened(title_of(sweep))}   {NAMES.get(sweep['model'], sweep['model'])}", figure, 9), fontsize=9)
    return figure


def title_of(sweep):
    """Title of the case, else its name."""
    return title_of_case(sweep) or name_of(sweep["case_path"])


STORED = ("output.every=", "output.history_every=", "output.checkpoint_every=")  # that every study sets by itself


def text_of(sweep, path):
    """cost.html: what to use, what it costs, what the error is made of, and how to make it again."""
    measured = any(q["id"] in run["qoi"] for run in sweep["runs"] for q in sweep["qoi"] if q["shown"])
    drawn = picture(draw(sweep) if measured else None, "all runs; " + file_name(path), "error against computing time")
    overrides = [override for override in sweep["overrides"] if not override.startswith(STORED)]
    axes = next((run["settings"] for run in sweep["runs"] if run["settings"]), {})
    words = ["polybed", "cost", sweep["case_path"], *words_of(overrides), "--model", sweep["model"],
             *(["--axes", ",".join(axes)] if axes else []),
             "--clock", sweep["clock"], "--budget", f"{sweep['budget_s']:g}s", "--target", f"{100 * sweep['target']:g}%", "-o", str(path.parent), "--force"]
    use, *more = advice(sweep)
    keys = Html().join(listing(shlex.join(words_of(one["overrides"]))) for one in sweep["recommend"] if one["overrides"])
    text = markup('<div class="card"><p>{}</p>{}</div>', use, keys) + Html().join(markup("<p>{}</p>", line) for line in more)
    body = [section("use", "What to use", text), section("picture", "Error against computing time", drawn),
            section("runs", "Runs", table(*runs_of(sweep), "last") + source(
                f"{definitions(sweep)} " + " ".join(f"{q['id']}: {q['definition']}." for q in sweep["qoi"] if q["shown"]))),
            section("made", "What the error is made of", Html().join(table([title, "", ""], rows, "last") for title, rows in shares_of(sweep))),
            warnings(sweep["warnings"]), section("commands", "How to make it again", listing(shlex.join(words)))]
    under = f"accuracy and computing time, {NAMES.get(sweep['model'], sweep['model'])} \u00b7 " + file_name(sweep["case_path"])
    return page(title_of(sweep), under, Html().join(body))
