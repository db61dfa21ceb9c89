"""What a sweep leaves: cost.json, cost.md and pictures."""

import os
from math import isfinite
from typing import NamedTuple

from polybed.cost.judge import advice, level_of, scale_of, settings_text
from polybed.cost.scene import Scene
from polybed.cost.sweep import REFERENCE as KIND_REFERENCE
from polybed.cost.words import CLOCKS, REFERENCE, STATUS, case_name, part
from polybed.cost.work import VERSION, weighed
from polybed.in_place import put_text
from polybed.study.record import json_text


class SweepOf(NamedTuple):
    """The case of a sweep, and the program."""
    path: str
    scene: Scene
    overrides: list
    commit: str
    build: str


def processor():
    """The processor's name as the system gives it; "unknown" elsewhere."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next((line.partition(":")[2].strip() for line in file if line.startswith("model name")), "unknown")
    except OSError:
        return "unknown"


def plain(value):
    """As the program writes JSON: whole numbers without a point, up to those that are not exact."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(entry) for entry in value]
    return int(value) if isinstance(value, float) and value.is_integer() and abs(value) < 1e16 else value


def finite(value):
    return value if value is not None and isfinite(value) else None


def settings_of(sweep, row):
    return {"settings": {axis.name: axis.levels[level_of(row, axis)].label for axis in sweep.axes} if row.settings else {},
            "note": row.note, "model": row.order.model, "ranks": row.order.ranks, "overrides": row.order.overrides}


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
    return [{"target": sweep.options.target, "qoi": sweep.ranking, "run": sweep.recommended, **settings_of(sweep, row),
             "error": quantity.error, "ci": finite(quantity.error_interval), "s_per_sim_s": row.rate, "confirmed": False}]


def shares_json(shares):
    most = max([0.0, *(share.value or 0.0 for share in shares)])
    return [{"row": share.row, "value": finite(share.value), "share": share.value / most if share.value is not None and most > 0 else None,
             "note": share.note} for share in shares]


def sweep_json(sweep, of):
    """cost.json. Raises StudyError if a number is not finite."""
    laws = {f"{what}_of_{axis}": sweep.laws.get(f"{what}_of_{axis}") for axis in ("rtol", "grid") for what in ("error", "cost")}
    reference = {name: {key: value for key, value in sorted(getattr(sweep.reference, name).items()) if isfinite(value)}
                 for name in ("floor", "value", "band")}
    quantities = [q._asdict() | {"scale": scale_of(sweep, q.id), "shown": q.id in sweep.options.quantities} for q in sweep.quantities]
    found = {
        "filetype": "polybed cost", "version": 1, "git_commit": of.commit, "case": of.scene.text, "case_path": of.path,
        "case_hash": of.scene.hash, "overrides": of.overrides, "model": sweep.options.model, "clock": sweep.options.clock,
        "work_version": VERSION, "target": sweep.options.target, "budget_s": sweep.options.budget,
        "machine": {"cpu": processor(), "cores": len(os.sched_getaffinity(0)), "build": of.build}, "outcome": sweep.outcome,
        "reason": sweep.reason, "regime": sweep.regime, "window_s": sweep.on.window.begin,
        "reference": {"kind": sweep.reference.kind, "note": sweep.reference.note, **reference}, "qoi": quantities,
        "runs": [row_json(sweep, row) for row in sweep.rows],
        "fit": {name: law._asdict() if law else None for name, law in laws.items()} | {"additive_off": finite(sweep.additive_off)},
        "pareto": [n for n, row in enumerate(sweep.rows) if row.status == "pareto"], "recommend": recommendation_json(sweep),
        "attribution": shares_json(sweep.attribution), "inputs": shares_json(sweep.inputs), "warnings": sweep.warnings}
    return json_text(plain(found))


def percent(share):
    return "-" if share is None else f"{100 * share:.2g}"


def cell_of(row, name):
    quantity = row.quantities.get(name)
    if quantity is None:
        return "-"
    return percent(quantity.error) + (f" +- {percent(quantity.error_interval)}" if quantity.error_interval else "")


def status_of(sweep, number):
    """How much dearer a dominated row is than the cheapest that is at least as accurate; whether a row is recommended."""
    row = sweep.rows[number]
    if sweep.recommended == number:
        return f"**recommended** for {100 * sweep.options.target:.2g} % in {sweep.ranking}"
    if row.kind == KIND_REFERENCE and row.done:
        return "reference"
    if row.status != "dominated":
        return STATUS.get(row.status, row.status)
    error = row.quantities[sweep.ranking].error
    least = min([row.rate, *(r.rate for r in sweep.rows if r.status == "pareto" and r.quantities[sweep.ranking].error <= error)])
    return f"{row.rate / least:.2g} times as dear as another as accurate" if 0 < least < row.rate else STATUS["dominated"]


def table_of(sweep):
    names = sweep.options.quantities
    lines = ["| # | settings | s for a simulated s | work, s | CPU, s |" + "".join(f" error of {name}, % |" for name in names) + " |",
             "| ---: | --- | ---: | ---: | ---: |" + " ---: |" * len(names) + " --- |"]
    for n, row in enumerate(sweep.rows):
        cells = [str(n), settings_text(sweep, row), f"{row.rate:.3g}", f"{weighed(row.outcome.counters):.3g}", f"{row.outcome.cpu:.3g}",
                 *(cell_of(row, name) for name in names), status_of(sweep, n)]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def shares_of(title, shares):
    rows = [f"| {part(share.row)} | {percent(share.value)} | {share.note} |" for share in shares]
    return ["", f"| {title} | % | |", "| --- | ---: | --- |", *rows] if rows else []


def sweep_markdown(sweep, of):
    reference = sweep.reference
    note = f" ({reference.note})" if reference.note else ""
    lines = [f"{case_name(of.path)} by polybed {sweep.options.model}; the bed is {'chaotic' if sweep.chaotic else 'not chaotic'}; computing times are "
             f"{CLOCKS[sweep.options.clock]}",
             f"an error is the distance from the reference: {REFERENCE[reference.kind]}{note}", "", *advice(sweep), "", *table_of(sweep),
             *shares_of(f"what the error of {sweep.ranking} is made of", sweep.attribution),
             *shares_of(f"change of {sweep.ranking} where a datum is off by its usual uncertainty", sweep.inputs)]
    if sweep.additive_off is not None:
        lines += ["", f"errors of the parts added in squares are off by {100 * sweep.additive_off:.2g} %"]
    for warning in sweep.warnings:
        lines += ["", f"warning: {warning}"]
    lines += ["", f"outcome {sweep.outcome}, commit {of.commit}"]
    return "\n".join(lines) + "\n"


def write_sweep(sweep, of, folder, picture):
    """All of them. Returns why there is no picture, if one was asked for."""
    put_text(folder / "cost.json", sweep_json(sweep, of) + "\n")
    put_text(folder / "cost.md", sweep_markdown(sweep, of))
    if not picture:
        return ""
    try:
        from polybed.plot import study_drawn  # what draws takes longer to import than all else
        study_drawn(folder / "cost.json")
    except Exception as error:  # what lies in the folder is complete without its picture
        return str(error)
    return ""
