"""What a sweep leaves: cost.json, cost.md and pictures."""

import os
from dataclasses import dataclass
from math import isfinite

from polybed.cost.judge import level_of, scale_of
from polybed.cost.markdown import sweep_markdown
from polybed.cost.work import VERSION, weighed
from polybed.in_place import put_text
from polybed.runner import commit_and_build
from polybed.study.record import json_text


@dataclass
class SweepOf:
    """Names the case of a sweep."""
    path: str
    scene: object
    overrides: list

    def __post_init__(self):
        self.commit, self.build = commit_and_build()


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
