"""The command line of polybed cost: a sweep, and its recommendation run again."""

import argparse
import re
import tempfile
import tomllib
from pathlib import Path

from polybed.ending import DONE, FILE, NUMBERS, WRONG_CASE, StudyError, answer, guarded, parser_of
from polybed.cost import front
from polybed.cost.axes import MAKERS, MODEL, NUMERICS, Scene
from polybed.cost.judge import measure_distances, measure_errors, rank, settings_text
from polybed.cost.reference import find_reference
from polybed.cost.report import sweep_json, sweep_markdown
from polybed.cost.runner import RunOrder, Runner
from polybed.cost.sweep import CANDIDATE, quantities_of_run
from polybed.cost.sweeper import Sweeper, common_overrides
from polybed.files import contents_of, put_text, read_json, read_text
from polybed.program import name_of
from polybed.runner import call, words_of
from polybed.study.cases import Case, refuse_without_ends
from polybed.study.output import draw, json_text, subfolder, taken

TIME_ALLOWED, ROUNDING = 0.25, 1e-9  # of the time and the error of a recommendation that is run again
NUMBER = r" *\+?(\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?) *"


def number_in(units, what):
    """What reads a number above 0 with one of these units, or without. units: by their names what each is"""
    def read(text):
        found = re.fullmatch(NUMBER + rf"({'|'.join(units)})? *", text)
        if not found or not float(found[1]) > 0:
            raise argparse.ArgumentTypeError(f"{text}: expected {what}")
        return float(found[1]) * units.get(found[2], 1.0)
    return read


target_of = number_in({"%": 0.01}, "an error, e.g. 1%")
budget_of = number_in({"us": 1e-6, "ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}, "a time, e.g. 20min")  # s


def listed(text):
    return [word for word in text.split(",") if word]


def parser():
    options = parser_of("cost", "Runs a case at several settings, measures how far each is from a reference and what it costs, and recommends "
                        "the cheapest within an error.", "--set", "--until", "--quiet", "--json", "--no-picture")
    options.add_argument("words", nargs="+", metavar="WORDS",
                         help="CASE: the study; check DIR: run its recommendation again")
    options.add_argument("-o", "--output", type=Path, help="folder; default runs/<case name>-cost")
    options.add_argument("--model", choices=("tfm", "dem"), help="default: tfm where it runs the case")
    options.add_argument("--qoi", dest="quantities", type=listed, default=[],
                         help="measured quantities, separated by commas; the first decides (default: bed_height)")
    options.add_argument("--axes", type=listed, default=[],
                         help=f"what is varied, separated by commas: {', '.join(MAKERS)} (default: all that act)")
    options.add_argument("--target", type=target_of, default="1%", help="largest error allowed (default: 1%%)")
    options.add_argument("--budget", type=budget_of, default="20min", help="wall time of the whole study (default: 20min)")
    options.add_argument("--clock", choices=("work", "wall"), default="work",
                         help="time that counts: work (counted operations, the same every time) or wall (default: work)")
    options.add_argument("--reference", default="auto", help="auto, exact (force balance, one species), or the directory of a run")
    options.add_argument("--resume", action="store_true", help="go on with the runs in the folder")
    options.add_argument("--force", action="store_true", help="replace a study that exists")
    return options


def model_of(scene, wanted):
    """The model of a sweep: the continuum where it runs the case. Raises ProgramError if the one that is asked for cannot run it."""
    model = wanted or ("dem" if scene.only_for_particles else "tfm")
    runs_it = scene.as_particles or scene.only_for_particles if model == "dem" else not scene.only_for_particles
    if not runs_it:  # which keys forbid it the program says
        call("estimate", scene.path, *words_of(scene.overrides), "--model", model)
    return model


def run_sweep(scene, options, runner):
    """A sweep from its first run to its recommendation: lines, reference, front, parts of the error. One process that starts others."""
    sweeper = Sweeper(scene, options, runner)
    sweep = sweeper.sweep
    if not sweeper.find_regime():
        return sweep
    sweeper.run_lines(NUMERICS)
    find_reference(sweeper)
    if not sweep.reference.kind and sweep.outcome == "done":
        sweep.refuse("no trustworthy reference")
    if sweep.outcome == "done":
        for row in sweep.rows:
            measure_errors(sweep, row)
        front.fit_laws(sweeper)
        front.run_front(sweeper)
    front.run_solver(sweeper)
    sweeper.run_lines(MODEL)
    front.run_inputs(sweeper)
    for row in sweep.rows:
        measure_errors(sweep, row)
    measure_distances(sweep)
    rank(sweep)
    front.compare_predictions(sweeper)
    front.attribute(sweeper)
    for row in sweep.rows:
        if row.kind == CANDIDATE and row.done and sweep.chaotic and row.measured.too_short:
            sweep.warnings.append(f"{settings_text(sweep, row)}: window too short for {row.measured.too_short}: fewer than 30 "
                                  "autocorrelation times")
    return sweep


def sweep(given):
    case = given.words[0]
    scene = Scene(case, given.set, given.until)
    refuse_without_ends(scene.keys, "polybed cost")
    folder = given.output or Path("runs") / f"{name_of(case)}-cost"
    if (folder / "cost.json").exists() and not given.resume and not given.force:
        raise StudyError(WRONG_CASE, f"{folder} contains a study already: --resume continues it, --force replaces it")
    if given.reference not in ("auto", "exact") and not (Path(given.reference) / "profiles.h5").exists():
        raise StudyError(FILE, f"--reference {given.reference}: no run directory")
    given.model = model_of(scene, given.model)
    given.quiet = given.quiet or given.json
    overrides = [*scene.overrides, *common_overrides(scene)]
    with taken(folder):
        found = run_sweep(scene, given, Runner(scene, overrides, subfolder(folder, "runs"), given.resume))
        record = sweep_json(found, scene, overrides)
        text, words = json_text(record), sweep_markdown(record)
        put_text(folder / "cost.json", text + "\n")
        put_text(folder / "cost.md", words)
        answer(text if given.json else f"{words}\n{folder / 'cost.json'}")
        if given.picture:
            draw(folder / "cost.json", "picture", given.quiet)
    return found.outcome == "done"


def held(what, unit, claimed, found, allowed):
    """Whether a claim is confirmed, and a line that says so."""
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
    """Runs the recommendation of DIR/cost.json again, says whether error and time (25 %) agree, also in the file, and returns it."""
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


def work(given):
    """Does what the words ask for; returns the code to end with."""
    checks = given.words[0] == "check"
    if len(given.words) != 1 + checks:
        raise StudyError(WRONG_CASE, "usage: polybed cost CASE, or polybed cost check DIR")
    return DONE if (check_recommendation(Path(given.words[1])) if checks else sweep(given)) else NUMBERS


def main(arguments=None):
    given = parser().parse_intermixed_args(arguments)
    return guarded(lambda: work(given))
