"""Both models on one case, or two runs of it, measured over the same window: what `polybed compare` hands over to."""

import os
import shlex
from pathlib import Path

from polybed.ending import DONE, FILE, WRONG_CASE, StudyError, answer, guarded, parser_of
from polybed.texts import duration
from polybed.files import contents_of, read_json
from polybed.folder import drift_lines, read_record
from polybed.program import name_of
from polybed.study.cases import Case, differences, roles_in_both_models
from polybed.study.measured import measured
from polybed.study.output import draw, remark, taken, write_record
from polybed.runner import answer_of, flags, has_checkpoint, ranks, run, words_of
from polybed.study.scores import MODELS, add_inversion, compare, plain, table


def record_of(directory, model):
    """A run's record. Raises StudyError if another model made it."""
    path = Path(directory) / "run.json"
    if not path.exists():
        raise StudyError(FILE, f"{directory}: no run (it has no run.json)")
    record = read_record(path)
    if record["model"] != model:
        raise StudyError(FILE, f"{path}: a run of {record['model']}, not of {model}")
    with contents_of(path):
        return record | {"case": str(record["case"])}


def refuse_difference(name, text, other_name, other):
    found = differences(text, other, roles_in_both_models())
    if found:
        lines = "".join(f"\n  {key}: {first} and {second}" for key, first, second in found)
        raise StudyError(WRONG_CASE, f"{name} and {other_name} are not of one case:{lines}")


def refuse_before_running(options, case):
    """Refuses a case that one of the models cannot run, before the other takes its hours, and a given run of another case."""
    for model in MODELS:
        given = getattr(options, model)
        if given:
            refuse_difference(case.path, case.text, given, record_of(given, model)["case"])
        elif case.refused[model]:
            raise StudyError(WRONG_CASE, "\n".join(case.refused[model]))


def made(options, case, model):
    """Runs a model into a folder of the comparison, which it returns. One that has a checkpoint there is gone on with, if asked for."""
    output = os.path.join(options.output, model)
    resume = ["--resume"] if options.resume and has_checkpoint(output) else []
    run(model, case.path, *words_of(case.overrides), "-o", output, *resume, *flags(vars(options), "force", "permissive", "quiet"),
        *([] if options.picture else ["--no-picture"]))
    return output


def forecast(options, case):
    """Says how long the runs that are not given will take."""
    for model in MODELS:
        if not getattr(options, model) and not options.quiet:
            found = answer_of("estimate", case.path, *words_of(case.overrides), "--model", model)["cpu_s"]
            remark(f"{model}: about {duration(found['expected'])} of computing, {duration(found['least'])} to {duration(found['most'])}")


def read_scan(options, case):
    """(inversion.json of a scan of the case by both models, its path), or None. The default scan can be of an earlier case."""
    path = Path(options.inversion or Path("runs") / f"{name_of(case.path)}-inversion") / "inversion.json"
    if not path.exists():
        if options.inversion:
            raise StudyError(FILE, f"{options.inversion}: no scan (it has no inversion.json)")
        return None
    scan = read_json(path, "polybed inversion")
    with contents_of(path):
        if scan["case_hash"] != case.scan_hash:
            if options.inversion:
                raise StudyError(WRONG_CASE, f"{path}: the scan is of another case")
            return None
        both = all(scan["models"].get(model, {}).get("velocity_m_s") is not None for model in MODELS)
        return (scan, path) if both else None


def command_to_go_on(options, until):
    """The command that continues both runs to a time, s."""
    words = [os.environ.get("POLYBED_TYPED", "polybed"), *(["-n", ranks()] if ranks() > 1 else []), "compare", options.case, "-o", options.output,
             "--resume", *words_of(options.set), "--until", f"{until:.4g} s"]
    return " ".join(shlex.quote(str(word)) for word in words)


def compare_runs(options, case, directories):
    records = {model: record_of(directories[model], model) for model in MODELS}
    refuse_difference(directories["tfm"], records["tfm"]["case"], directories["dem"], records["dem"]["case"])
    runs = [measured(directories[model]) for model in MODELS]
    found = compare(*runs)
    scan = read_scan(options, case)
    if scan:
        with contents_of(scan[1]):
            add_inversion(found, *scan, case.velocity)
    states = {model: record["state"] for model, record in records.items()}
    found["warnings"] += [f"{model}: the run is not done ({state})" for model, state in states.items() if state != "done"]
    record = plain(found, case, options.output, {model: (directories[model], records[model]) for model in MODELS})
    path = Path(options.output) / "comparison.json"
    text = write_record(path, record)
    made_here = not (options.tfm or options.dem)
    longer = made_here and (found["least_time"] or any(drift_lines(run.record) for run in runs))
    until = max(2 * records["tfm"]["time_s"], found["least_time"])
    more = f"\nto go on: {command_to_go_on(options, until)}" if longer else ""
    answer(text if options.json else f"{table(record)}\n{path}{more}")
    if options.picture:
        draw(path, "page", options.json or options.quiet)


def make(options):
    case = Case(options.case, options.set, options.until)
    options.output = options.output or os.path.join("runs", f"{name_of(options.case)}-compare")
    refuse_before_running(options, case)
    with taken(Path(options.output)):
        forecast(options, case)
        compare_runs(options, case, {model: getattr(options, model) or made(options, case, model) for model in MODELS})
    return DONE


def parsed(arguments):
    parser = parser_of("compare", "Runs the case by both models, or takes runs of it: how far they agree.",
                       "case", "--set", "--until", "--quiet", "--json", "--no-picture")
    parser.add_argument("-o", "--output", metavar="DIR", help="run directory; default runs/<case name>-compare")
    parser.add_argument("--resume", action="store_true", help="go on from the checkpoint in the run directory")
    parser.add_argument("--force", action="store_true", help="replace the run in the run directory")
    parser.add_argument("--permissive", action="store_true",
                        help="go on where a conservation law is broken more than tenfold, which ends a run otherwise")
    parser.add_argument("--tfm", metavar="DIR", help="directory of a run of polybed tfm, finished or not")
    parser.add_argument("--dem", metavar="DIR", help="directory of a run of polybed dem, finished or not")
    parser.add_argument("--inversion", metavar="DIR", help="folder of polybed inversion --scan both; default that of the case in runs/")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parsed(arguments)
    return guarded(lambda: make(options))
