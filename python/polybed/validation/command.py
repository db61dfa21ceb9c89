"""Runs the entries of cases/validation and compares them with what was measured: `polybed validate`."""

import datetime
import math
import shlex
from pathlib import Path

from polybed.ending import DONE, FILE, NUMBERS, WRONG_CASE, StudyError, answer, guarded, parser_of, whole
from polybed.texts import duration, text_table
from polybed.folder import read_record
from polybed.files import put_text
from polybed.program import finished
from polybed.runner import commit_and_build, flags, has_checkpoint, run, sources, words_of
from polybed.study.cases import Case
from polybed.study.output import json_text, remark, taken
from polybed.validation import report
from polybed.validation.entries import MODELS, NO_RUN, entry_named, folder, names
from polybed.validation.numbers import UNDECIDED, Undecided, inversion_interval, inversion_of, measured_number, of_seeds, verdict

DIGITS = 8  # of the hash of a case in the name of a folder
AT_MOST = 300.0  # CPU seconds of an entry that runs without being named


def part_of(number):
    return None if number is None else [number.value, number.error]


def row_of(entry, of, model, compare, judged, cpu):
    """judged: (measured, result, verdict, joint half-width, reason)"""
    measured, result, found, joint, reason = judged
    return {"entry": entry.name, "run": of.name, "model": model, "quantity": compare["quantity"], "unit": compare["unit"],
            "measured": part_of(measured), "result": part_of(result), "runs": result.repeats if result else 1, "joint": joint,
            "verdict": found, "reason": reason, "cpu_s": cpu}


def made(options, entry, of, model, seed):
    """Runs a model, unless its run is finished, and returns its folder. A run that was stopped continues from its checkpoint."""
    overrides, name = of.overrides(seed), of.name if of.seeds == 1 else f"{of.name}-{seed}"
    case = Case(entry.case, overrides)
    if case.refused[model]:
        raise StudyError(WRONG_CASE, "\n".join(case.refused[model]))
    output = Path(options.output) / f"{entry.name}-{name}-{model}-{case.hash[:DIGITS]}"
    if options.force or not finished(output, model, case.text):
        again = ["--force"] if options.force else ["--resume"] if has_checkpoint(output) else []
        run(model, entry.case, *words_of(overrides), "-o", output, *again, *flags(vars(options), "quiet"), "--no-picture")
    return output


def judged(measured, give):
    """The verdict on a number that a run gives."""
    try:
        result = give()
    except Undecided as error:
        return measured, error.number, UNDECIDED, None, str(error)
    found, joint, reason = verdict(measured, result)
    return measured, result, found, joint, reason


def of_run(options, entry, of, model):
    """Rows of one run, or of its seeds together, and the commits of the program that made them."""
    try:
        outputs = [made(options, entry, of, model, seed) for seed in range(1, min(of.seeds, options.seeds or of.seeds) + 1)]
    except StudyError as error:
        if error.code != NUMBERS or str(error):  # what has a text was killed, and has said nothing itself
            raise
        return [row_of(entry, of, model, compare, (measured_number(entry, of, compare), None, UNDECIDED, None, "the run failed"), None)
                for compare in entry.compared(of)], set()
    records = [read_record(output / "run.json") for output in outputs]
    cpu = math.fsum(record["cpu_s"] for record in records)
    return [row_of(entry, of, model, compare, judged(measured_number(entry, of, compare), lambda: of_seeds(entry, compare, outputs)), cpu)
            for compare in entry.compared(of)], {record["git_commit"] for record in records}


def block_of(options, entry, model, commit):
    """All that a model gives for an entry, as it is recorded."""
    rows, commits = [], set()
    for of in entry.runs:
        if model not in of.models or options.run and of.name not in options.run:
            continue
        if model == NO_RUN:  # `polybed inversion` answers
            rows += [row_of(entry, of, model, compare, judged(measured_number(entry, of, compare),
                                                              lambda: inversion_interval(inversion_of(entry, of))), None)
                     for compare in entry.compared(of)]
            commits.add(commit)
            continue
        found, made_by = of_run(options, entry, of, model)
        rows += found
        commits |= made_by or {commit}
    seconds = {row["run"]: row["cpu_s"] for row in rows}
    words = [f"--run={name}" for name in options.run] + ([f"--seeds={options.seeds}"] if options.seeds else [])
    return {"entry": entry.name, "model": model, "date": datetime.date.today().isoformat(), "git_commit": ", ".join(sorted(commits)),
            "command": shlex.join(["polybed", "validate", entry.name, "--model", model, *words, "--record"]), "runs": options.run,
            "cpu_s": math.fsum(second or 0.0 for second in seconds.values()), "rows": rows}


def work_of(options):
    """(entry, model) pairs to run; without names those that are quick."""
    pairs = []
    for entry in map(entry_named, options.names or names()):
        if entry.missing:
            remark(f"{entry.name}: nothing to compare with: {entry.missing}")
        for model, seconds in entry.seconds.items():
            if options.model not in (None, model):
                continue
            if not options.names and seconds > options.at_most:
                remark(f"{entry.name}: {model} takes about {duration(seconds)} and is left out: name the entry, or give --at-most")
                continue
            pairs.append((entry, model))
    return pairs


def listed():
    """What held when results were last recorded, a line for each entry and model."""
    recorded = report.read_recorded(folder())
    rows = []
    for entry in map(entry_named, names()):
        for model, seconds in entry.seconds.items() or [("-", None)]:
            blocks = [block for block in recorded if (block["entry"], block["model"]) == (entry.name, model)]
            last = blocks[-1] | {"rows": [row for block in blocks for row in block["rows"]]} if blocks else None
            held = f"{report.counted(last['rows'])} ({last['date']}, {last['git_commit'][:9]})" if last else "not run"
            rows.append({"entry": entry.name, "model": model, "seconds": seconds, "recorded": last,
                         "held": f"no measurement: {entry.missing}" if entry.missing else held, "title": entry.title})
    return rows


def list_entries(options):
    rows = listed()
    if options.json:
        answer(json_text(rows))
    else:
        answer(text_table(("bed", "model", "takes", "at the last recorded results"),
                          [(row["entry"], row["model"], "-" if row["seconds"] is None else duration(row["seconds"]), row["held"]) for row in rows]))
    return DONE


def document():
    """The page that --record renews; it is in the sources alone."""
    found = sources()
    path = found / "docs/record/validation.md" if found else None
    if path is None or not path.is_file():
        raise StudyError(FILE, "--record renews docs/record/validation.md of the sources, and this package is not in them")
    return path


def validate(options):
    target = document() if options.record else None  # refused before hours of runs
    pairs = work_of(options)
    known = {of.name for entry, _ in pairs for of in entry.runs}
    if unknown := set(options.run) - known:
        raise StudyError(WRONG_CASE, f"there is no run {min(unknown)!r}; there are {', '.join(sorted(known))}")
    if not pairs:
        raise StudyError(WRONG_CASE, "no entry is left to run: polybed validate --list shows all")
    commit = commit_and_build()[0]
    with taken(Path(options.output)):
        blocks = [block_of(options, entry, model, commit) for entry, model in pairs]
        rows = [row for block in blocks for row in block["rows"]]
        entries = list({entry.name: entry for entry, _ in pairs}.values())
        path = put_text(Path(options.output) / "validate.html", report.html_page(rows, entries, "polybed validate", commit))
    written = report.write_recorded(folder(), target, blocks) if target else []
    if options.json:
        answer(json_text({"blocks": blocks, "page": str(path)}))
    else:
        lines = [text_table(report.HEAD, [report.cells(row) for row in rows]), report.counted(rows), *map(str, (path, *written))]
        answer("\n".join(lines))
    return DONE


def parsed(arguments):
    parser = parser_of("validate", "Compares the models with beds that were measured: runs, verdicts, a page.", "--quiet", "--json")
    parser.add_argument("names", nargs="*", metavar="NAME", help="an entry: a folder of cases/validation; default all that are quick")
    parser.add_argument("--list", action="store_true", help="what held when results were last recorded, and what each entry takes")
    parser.add_argument("--model", choices=MODELS, help="only this model; balance: the force balance, without a run")
    parser.add_argument("--run", action="append", default=[], metavar="NAME", help="only this run of an entry; several: once each")
    parser.add_argument("--seeds", type=whole(1, 10000), metavar="N", help="of runs that are repeated with drawn inputs: the first N; default all")
    parser.add_argument("--at-most", type=float, default=AT_MOST, metavar="SECONDS",
                        help="CPU seconds of an entry that is not named; default %(default)g")
    parser.add_argument("--record", action="store_true", help="keep the results: recorded.json and docs/record/validation.md")
    parser.add_argument("-o", "--output", default="runs/validation", metavar="DIR", help="folder of runs and page; default %(default)s")
    parser.add_argument("--force", action="store_true", help="run again what is finished")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parsed(arguments)
    return guarded(lambda: list_entries(options) if options.list else validate(options))
