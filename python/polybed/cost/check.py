"""A sweep held to what it said: its recommendation run again."""

import tempfile
import tomllib
from pathlib import Path

from polybed.cost.quantities import quantities_of_run
from polybed.cost.runner import Runner, RunOrder
from polybed.cost.scene import Scene
from polybed.files import contents_of, put_text, read_json, read_text
from polybed.ending import NUMBERS, WRONG_CASE, StudyError, answer
from polybed.study.cases import Case

TIME_ALLOWED, ROUNDING = 0.25, 1e-9


def held(what, unit, claimed, found, allowed):
    """Whether a claim holds, and a line that says so."""
    holds = abs(found - claimed) <= allowed
    return holds, (f"{what}: claimed {claimed:.4g}, found {found:.4g} {unit}, allowed {allowed:.2g} either way: "
                   f"{'holds' if holds else 'does not hold'}")


def scene_of(sweep):
    """The case of a sweep as it stands now, with the settings of all its runs. Refuses one that was changed since."""
    path, overrides = sweep["case_path"], sweep["overrides"]
    with tempfile.TemporaryDirectory() as folder:
        then = Path(folder) / "case.toml"
        then.write_text(sweep["case"], encoding="utf-8")
        before = Case(then, overrides)
    now = Scene(path, overrides)
    if now.text != before.text:
        raise StudyError(WRONG_CASE, f"{path} was changed since it was swept: `polybed cost {path} --force` first")
    return now


def run_again(sweep, advised, folder):
    """The outcome of the recommended run, done now, and what it measures."""
    with contents_of(folder / "cost.json"):
        order = RunOrder(advised["model"], tuple(advised["overrides"]))
        seconds = 60 + 20 * sweep["runs"][advised["run"]]["wall_s"][0]
        on = sweep["window_s"], tomllib.loads(sweep["case"])["column"]["cells"][1]
        overrides = sweep["overrides"]
    (folder / "check").mkdir(exist_ok=True)
    outcome = Runner(scene_of(sweep), overrides, folder / "check", False).run(order, seconds)
    if not outcome.done:
        raise StudyError(NUMBERS, f"the run that was recommended: {outcome.state}: {outcome.reason}")
    return outcome, quantities_of_run(outcome.measured, *on)


def check_recommendation(folder):
    """Runs the recommendation of DIR/cost.json again: its error has to lie within its interval, its time within 25 %. Says so, and in the
    file; returns whether both hold."""
    path = folder / "cost.json"
    sweep = read_json(path, "polybed cost")
    with contents_of(path):
        advised = next(iter(sweep["recommend"]), None)
    if advised is None:
        raise StudyError(WRONG_CASE, f"{path}: nothing is recommended")
    outcome, measured = run_again(sweep, advised, folder)
    with contents_of(path):
        name, clock, claimed = advised["qoi"], sweep["clock"], advised["s_per_sim_s"]
        scale = next(q["scale"] for q in sweep["qoi"] if q["id"] == name)
        found = abs(measured.values[name].mean - sweep["reference"]["value"][name]) / scale
        claims = (held(f"error of {name}", "", advised["error"], found, (advised["ci"] or 0) + ROUNDING),
                  held(f"time by {clock}", "s for a simulated second", claimed, outcome.rate(clock), TIME_ALLOWED * claimed))
    answer("\n".join(line for _, line in claims))
    confirmed = all(holds for holds, _ in claims)
    if confirmed:
        put_text(path, read_text(path).replace('"confirmed": false', '"confirmed": true', 1))
    return confirmed
