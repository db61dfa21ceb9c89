"""cost.html of a sweep: what to use, what it costs, what the error is made of, and how to make it again; one file that stands alone."""

import shlex

from polybed.cost.words import REFERENCE, STATUS, in_words, part
from polybed.drawing.cost import draw, title_of
from polybed.drawing.style import NAMES
from polybed.drawing.units import text
from polybed.page import Html, file_name, listing, markup, page, picture, section, source, table, warnings
from polybed.runner import words_of

NONE = "\u2013"  # of a number that is not known
STORED = ("output.every=", "output.history_every=", "output.checkpoint_every=")  # that every study sets by itself
OUTCOMES = {"done": "", "refused": "No recommendation: ", "failed": "The sweep failed: "}


def percent(value, error=None):
    if value is None:
        return NONE
    return f"{100 * value:.2g}" + ("" if not error else f" \u00b1 {100 * error:.1g}")


def quantity_words(name):
    return name.replace("_", " ")


def settings_words(run):
    """The settings of a row, and what is special about it."""
    words = [in_words(axis, level) for axis, level in run["settings"].items() if axis in ("rtol", "grid", "scheme")]
    return ", ".join([*words, run["note"]] if run["note"] else words) or run["kind"]


def recommendation(sweep):
    if not sweep["recommend"]:
        return markup("<p>{}{}.</p>", OUTCOMES.get(sweep["outcome"], ""), sweep["reason"] or "no run reaches the accuracy asked for")
    found = Html()
    for one in sweep["recommend"]:
        keys = " ".join(f"--set {shlex.quote(override)}" for override in one["overrides"])
        found += markup("<p>For an error of at most {} % in the {}: <b>{}</b>, error {} %, {} of computing for a simulated second{}.</p>",
                        percent(one["target"]), quantity_words(one["qoi"]), settings_words(sweep["runs"][one["run"]]),
                        percent(one["error"], one["ci"]), text(one["s_per_sim_s"], "s"),
                        "" if one["confirmed"] else " (not confirmed by a second run)")
        found += listing(keys) if keys else Html()
    return markup('<div class="card">{}</div>', found)


def runs(sweep):
    shown = [q for q in sweep["qoi"] if q["shown"]]
    advised = {one["run"] for one in sweep["recommend"]}
    rows = []
    for n, run in enumerate(sweep["runs"]):
        if run["status"] == "not run":
            continue
        errors = [run["qoi"].get(q["id"], {}) for q in shown]
        status = "not ranked: there is no reference" if run["status"] == "hollow" and not sweep["reference"]["kind"] else run["status"]
        state = Html("<b>recommended</b>") if n in advised else run["kind"] if run["kind"] == "reference" and status == "hollow" else \
            STATUS.get(status, status)
        rows.append([settings_words(run), text(run["s_per_sim_s"], "s") if run["s_per_sim_s"] > 0 else NONE,
                     *(percent(error.get("error"), error.get("error_ci")) for error in errors), state])
    left = sum(run["status"] == "not run" for run in sweep["runs"])
    definitions = "".join(f"{quantity_words(q['id'])}: {q['definition']}. " for q in shown)
    kind = sweep["reference"]["kind"]
    head = ["settings", "for a simulated second", *(f"error of the {quantity_words(q['id'])} (%)" for q in shown), ""]
    return table(head, rows, "last") + source(
        f"An error is the distance from the reference ({REFERENCE.get(kind, kind)}). {definitions}"
        + (f"{left} more were not run: the budget was {text(sweep['budget_s'], 's')}." if left else ""))


def shares(title, rows):
    """What an error is made of; nothing without a number."""
    known = [[part(row["row"]), percent(row["value"]), row["note"]] for row in rows if row["value"] is not None]
    missing = ", ".join(part(row["row"]) for row in rows if row["value"] is None)
    return table([title, "%", ""], known, "last") + (source(f"not measured: {missing}") if missing else "") if known else Html()


def text_of(sweep, path):
    measured = any(q["id"] in run["qoi"] for run in sweep["runs"] for q in sweep["qoi"] if q["shown"])
    drawn = picture(draw(sweep) if measured else None, "all runs; " + file_name(path), "error against computing time")
    overrides = [override for override in sweep["overrides"] if not override.startswith(STORED)]
    axes = next((run["settings"] for run in sweep["runs"] if run["settings"]), {})
    words = ["polybed", "cost", sweep["case_path"], *words_of(overrides), "--model", sweep["model"],
             *(["--axes", ",".join(axes)] if axes else []),
             "--clock", sweep["clock"], "--budget", f"{sweep['budget_s']:g}s", "--target", f"{100 * sweep['target']:g}%", "-o", str(path.parent), "--force"]
    body = [section("use", "What to use", recommendation(sweep)), section("picture", "Error against computing time", drawn),
            section("runs", "Runs", runs(sweep)),
            section("made", "What the error is made of", shares("part", sweep["attribution"]) + shares("datum, changed by its usual uncertainty",
                                                                                             sweep["inputs"])),
            warnings(sweep["warnings"]), section("commands", "How to make it again", listing(shlex.join(words)))]
    under = f"accuracy and computing time, {NAMES.get(sweep['model'], sweep['model'])} \u00b7 " + file_name(sweep["case_path"])
    return page(title_of(sweep), under, Html().join(body))
