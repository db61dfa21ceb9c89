"""What a sweep leaves: cost.json, and cost.md and cost.html, which say the same in words."""

import os
from math import isfinite

from polybed.cost.judge import level_of, scale_of
from polybed.cost.sweep import CANDIDATE, CLOCKS, REFERENCES, STATUS, in_words, part
from polybed.cost.runner import VERSION, weighed
from polybed.texts import markdown_table, percent, text
from polybed.program import name_of
from polybed.runner import commit_and_build

ALWAYS = ("rtol", "grid", "scheme", "steps", "coupling")  # axes in each row, others where the level differs from the first row
OUTCOMES = {"refused": "No recommendation", "failed": "The sweep failed"}
MADE_OF = ("what the error is made of", "change where a datum is off by its usual uncertainty")


def processor():
    """The processor's name as the system gives it; "unknown" elsewhere."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next((line.partition(":")[2].strip() for line in file if line.startswith("model name")), "unknown")
    except OSError:
        return "unknown"


def finite(value):
    return value if value is not None and isfinite(value) else None


def settings_of(sweep, row):
    return {"settings": {axis.name: axis.levels[level_of(row, axis)].label for axis in sweep.axes} if row.settings else {},
            "note": row.note, "model": row.order.model, "overrides": row.order.overrides}


def row_json(sweep, row):
    outcome = row.outcome
    quantities = {name: {"value": q.value, "ci": finite(q.interval), "error": q.error, "error_ci": finite(q.error_interval)}
                  for name, q in sorted(row.quantities.items())}
    predicted = {"predicted": {"error": row.predicted.error, "cost": row.predicted.cost}} if row.predicted else {}
    return {"kind": row.kind, **settings_of(sweep, row), "work": dict(sorted(outcome.counters.items())), "work_s": weighed(outcome.counters),
            "simulated_s": outcome.simulated, "s_per_sim_s": row.rate, "cpu_s": [outcome.cpu], "wall_s": [outcome.wall], "qoi": quantities,
            **predicted, "status": row.status, "reason": outcome.reason}


def recommendation_json(sweep):
    if sweep.recommended is None:
        return []
    row = sweep.rows[sweep.recommended]
    quantity = row.quantities[sweep.ranking]
    given = next((one for one in sweep.rows if one.kind == CANDIDATE and one.done and not one.note
                  and all(level_of(one, axis) == axis.given for axis in sweep.axes)), row)
    return [{"target": sweep.options.target, "qoi": sweep.ranking, "run": sweep.recommended, **settings_of(sweep, row),
             "error": quantity.error, "ci": finite(quantity.error_interval), "s_per_sim_s": row.rate,
             "given_s_per_sim_s": given.rate, "confirmed": False}]


def shares_json(shares):
    most = max([0.0, *(share.value or 0.0 for share in shares)])
    return [{"row": share.row, "value": finite(share.value), "share": share.value / most if share.value is not None and most > 0 else None,
             "note": share.note, "axes": share.axes} for share in shares]


def sweep_json(sweep, scene, overrides):
    """cost.json as a dictionary."""
    laws = {f"{what}_of_{axis}": sweep.laws.get(f"{what}_of_{axis}") for axis in ("rtol", "grid") for what in ("error", "cost")}
    reference = {name: {key: value for key, value in sorted(getattr(sweep.reference, name).items()) if isfinite(value)}
                 for name in ("floor", "value", "band")}
    quantities = [q._asdict() | {"scale": scale_of(sweep, q.id), "shown": q.id in sweep.options.quantities} for q in sweep.quantities]
    commit, build = commit_and_build()
    return {
        "filetype": "polybed cost", "version": 1, "git_commit": commit, "case": scene.text, "case_path": os.path.abspath(scene.path),
        "case_hash": scene.hash, "overrides": overrides, "model": sweep.options.model, "clock": sweep.options.clock,
        "work_version": VERSION, "target": sweep.options.target, "budget_s": sweep.options.budget,
        "machine": {"cpu": processor(), "cores": len(os.sched_getaffinity(0)), "build": build}, "outcome": sweep.outcome,
        "reason": sweep.reason, "regime": sweep.regime, "window_s": sweep.begin,
        "reference": {"kind": sweep.reference.kind, "note": sweep.reference.note, **reference}, "qoi": quantities,
        "runs": [row_json(sweep, row) for row in sweep.rows],
        "fit": {name: law._asdict() if law else None for name, law in laws.items()} | {"additive_off": finite(sweep.additive_off)},
        "pareto": [n for n, row in enumerate(sweep.rows) if row.status == "pareto"], "recommend": recommendation_json(sweep),
        "attribution": shares_json(sweep.attribution), "inputs": shares_json(sweep.inputs), "warnings": sweep.warnings}


def settings_words(found, run):
    """The settings of a run in words, and its note."""
    first = next((one["settings"] for one in found["runs"] if one["settings"]), {})
    words = [in_words(axis, level) for axis, level in run["settings"].items() if axis in ALWAYS or level != first.get(axis)]
    return ", ".join(words + ([run["note"]] if run["note"] else [])) or run["kind"]


def advice(found):
    """Advice in words, a sentence each, the recommendation first."""
    name = next((q["id"] for q in found["qoi"] if q["shown"]), "")
    lines = [f"For an error of at most {percent(one['target'])} in {one['qoi']} use {settings_words(found, found['runs'][one['run']])}: "
             f"error {percent(one['error'], one['ci'])}, {text(one['s_per_sim_s'], 's')} of computing for a simulated second"
             f"{'' if one['confirmed'] else ' (not confirmed by a second run)'}; the case as given takes "
             f"{one.get('given_s_per_sim_s', one['s_per_sim_s']) / one['s_per_sim_s']:.3g} times that." for one in found["recommend"]]
    if found["outcome"] != "done":
        return [f"{OUTCOMES[found['outcome']]}: {found['reason']}."]
    lines = lines or [f"No run has an error of at most {percent(found['target'])} in {name}, its interval included."]
    known = [share for share in found["attribution"] if share["value"] is not None]
    unknown = [share for share in found["attribution"] if share.get("axes")]
    largest = max(known, key=lambda share: share["value"], default={"value": 0})
    if largest["value"] > 0:
        lines.append(f"The largest part of the error{' of those measured' if unknown else ''}: {part(largest['row'])} ({percent(largest['value'])})"
                     f"{'' if unknown else ': that is what to improve'}.")
    if unknown:
        lines.append(f"Not measured, and not part of these errors: {'; '.join(part(share['row']) for share in unknown)}. "
                     f"To measure them: --axes {','.join(axis for share in unknown for axis in share['axes'])}.")
    loose = [part(share["row"]) for share in known if largest["value"] > 0 and 10 * share["value"] < largest["value"]]
    return lines + ([f"At least ten times smaller, so it may be loosened to save time: {'; '.join(loose)}."] if loose else [])


def runs_of(found):
    """Head and rows of the table of runs."""
    shown = [q["id"] for q in found["qoi"] if q["shown"]]
    advised = {one["run"] for one in found["recommend"]}
    rows = []
    for n, run in enumerate(found["runs"]):
        state = STATUS.get(run["status"], run["status"])
        if run["status"] == "hollow" and (run["kind"] == "reference" or not found["reference"]["kind"]):
            state = "reference" if run["kind"] == "reference" else "not ranked: there is no reference"
        errors = [run["qoi"].get(name, {}) for name in shown]
        rows.append([n, settings_words(found, run), text(run["s_per_sim_s"], "s") if run["s_per_sim_s"] > 0 else percent(None),
                     *(percent(error.get("error"), error.get("error_ci")) for error in errors), "recommended" if n in advised else state])
    return ["#", "settings", "for a simulated second", *(f"error of {name}" for name in shown), ""], rows


def shares_of(found):
    """(title, rows) of what the error is made of, and of the changes by the data of the case; those with rows."""
    parts = zip(MADE_OF, (found["attribution"], found["inputs"]))
    return [(title, [[part(row["row"]), percent(row["value"]), row["note"]] for row in rows]) for title, rows in parts if rows]


def definitions(found):
    """What the numbers are, in sentences."""
    kind, note = found["reference"]["kind"], found["reference"].get("note")
    return (f"Computing times are {CLOCKS[found['clock']]}. An error is the distance from the reference: {REFERENCES.get(kind, kind)}"
            f"{f' ({note})' if note else ''}. Heights are measured on slabs as high as the cells of the case, in the reference, too: a sharp top is "
            "read up to a tenth of a slab too high or too low.")


def sweep_markdown(found):
    lines = [f"{name_of(found['case_path'])} by polybed {found['model']}; the bed is {'chaotic' if found['regime'] == 'chaotic' else 'not chaotic'}. "
             + definitions(found), "", *advice(found), "", markdown_table(*runs_of(found))]
    for title, rows in shares_of(found):
        lines += ["", markdown_table([title, "", ""], rows)]
    if found["fit"]["additive_off"] is not None:
        lines += ["", f"errors of the parts added in squares are off by {percent(found['fit']['additive_off'])}"]
    for warning in found["warnings"]:
        lines += ["", f"warning: {warning}"]
    return "\n".join([*lines, "", f"outcome {found['outcome']}, commit {found['git_commit']}"]) + "\n"
