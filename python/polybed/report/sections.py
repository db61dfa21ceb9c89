"""The written parts of the page of a run: what limited its steps, invariants, effects, the case, how to cite, the commands."""

import contextlib
import os
import re
import shlex
from collections import Counter

from polybed.texts import text
from polybed.files import finite, whole_lines
from polybed.page import Html, listing, markup, source, table
from polybed.folder import case_of, velocity_of

MOST_LIMITS = 8
MODELS = {"tfm": "two-fluid model", "dem": "particles, one by one"}
HEADING = 14  # columns of a line before what it says


def reason_of(limited_by):
    """What limited a step, without the place: "error test: u_fine.y (0, 1)" in every cell is one reason."""
    return re.sub(r"(\s+at)?\s*\([^()]*\)\s*$", "", limited_by).strip()


def limits_of_steps(path):
    """(simulated seconds, steps) by reason, of a steps.csv; a row being written is left out."""
    seconds, steps = Counter(), Counter()
    for dt, reason in rows_of_steps(whole_lines(path)[1:]):
        seconds[reason] += dt
        steps[reason] += 1
    return seconds, steps


def rows_of_steps(lines):
    """(length of the step, what limited it) of rows of steps.csv: time_s,dt_s,error_norm,"limited_by". Others are left out."""
    for line in lines:
        cells = line.split(",", 3)
        with contextlib.suppress(ValueError):
            _, dt, _ = map(finite, cells[:-1])
            if len(cells[-1]) > 1 and cells[-1][0] == cells[-1][-1] == '"':
                yield dt, reason_of(cells[-1][1:-1])


def limits(run):
    """What limited the steps: shares of the two-fluid model's steps, or the step of particles with its next limits."""
    path = run.directory / "steps.csv"
    if path.exists():
        seconds, steps = limits_of_steps(path)
        if total := sum(steps.values()):
            first, others = steps.most_common(MOST_LIMITS), sum(count for _, count in steps.most_common()[MOST_LIMITS:])
            rows = [[why, count, f"{100 * count / total:.3g} %", text(seconds[why] / count, "s")] for why, count in first]
            rows += [["others", others, f"{100 * others / total:.3g} %", ""]] if others else []
            return table(["limited by", "steps", "share", "mean step"], rows) + source(f"steps.csv, {total} steps")
    step = run.record.get("step", {})
    if not step.get("limits"):
        return ""
    rows = [[one["name"], text(one["dt_s"], "s")] for one in step["limits"][:MOST_LIMITS]]
    return table(["limit", "longest step allowed"], rows) + source(
        f"The step at the end, {text(step['dt_s'], 's')}, is the shortest of these; run.json.")


def percent(share):
    """A share with two digits, or all before the point: no power of ten."""
    return f"{100 * share:.0f} %" if abs(share) >= 0.995 else f"{100 * share:.2g} %"


def work(record):
    """Counters and time by term."""
    total = sum(record.get("timers", {}).values())
    rows = [[name, text(seconds, "s"), percent(seconds / total)]
            for name, seconds in sorted(record.get("timers", {}).items(), key=lambda term: -term[1]) if total > 0]
    counters = ", ".join(f"{name.replace('_', ' ')} {count:.6g}" for name, count in record.get("work", {}).items()
                         if isinstance(count, (int, float)) and not isinstance(count, bool))
    return (table(["computing time", "", "share"], rows) if rows else Html()) + (markup("<p>{}</p>", counters) if counters else "")


def invariants(record):
    verdicts = {True: Html('<span class="held">held</span>'), False: Html('<span class="bad">exceeded</span>')}
    rows = [[one["name"], f"{one['worst']:.2g}", f"{one['limit']:.2g}", verdicts[bool(one.get("held", one["worst"] <= one["limit"]))]]
            for one in record.get("invariants", [])]
    return table(["", "worst value", "limit", ""], rows) if rows else ""


def bound_of(row):
    if row.get("bound") is None:
        return "unknown"
    shown = percent(row["bound"])
    return shown + (f", up to {percent(row['up_to'])}" if row.get("up_to") is not None else "")


def effects(record, case):
    """Which laws act, and what the model leaves out with its bound."""
    laws = [list(law) for law in case.get("effects", {}).items()]
    found = table(["acts", "law"], laws, "words") if laws else Html()
    neglected = record.get("neglected", {})
    rows = sorted(neglected.get("rows", []), key=lambda row: (row.get("bound") is None, -(row.get("bound") or 0)))
    shown = [[row["effect"].replace("_", " "), bound_of(row), row.get("number") or "", row.get("reason") or ""] for row in rows if "effect" in row]
    if shown:
        found += Html("<h3>Left out</h3>") + table(["effect", "bound", "judged by", "why"], shown, "words")
    if isinstance(neglected.get("sum"), (int, float)):
        found += source(f"The forces left out sum to at most {percent(neglected['sum'])} of the buoyant weight of the particles; "
                        f"the case allows {percent(neglected.get('promise', 0))} (chooser.tolerance). "
                        "The bound of another row is that of the number named beside it.")
    return found


def the_case(record):
    overrides = record.get("overrides") or []
    told = source("with " + Html(", ").join(markup("<code>--set {}</code>", shlex.quote(o)) for o in overrides)) if overrides else Html()
    return told + markup(
        "<details><summary>all keys, in SI units, as polybed reads them</summary>{}</details>", listing(record["case"])) if record.get("case") else ""


def cite(record, case):
    laws = ", ".join(f"{name} {law}" for name, law in case.get("effects", {}).items())
    sources = f"\nwith the sources of its laws ({laws}), which docs/theory/closures.md lists" if laws else ""
    return listing(f"polybed {record.get('program', '')}, commit {record.get('git_commit', '')}, {MODELS.get(record.get('model'), '')}, "
                   f"case {record.get('case_hash', '')}{sources}")


def commands(run, record):
    """What makes the run again, and what else can be done with it."""
    model, folder = shlex.quote(str(record.get("model", "tfm"))), shlex.quote(str(run.directory))
    ranks = f"-n {int(record['ranks'])} " if record.get("ranks", 1) > 1 else ""
    program = shlex.quote(os.environ.get("POLYBED_TYPED", "polybed"))
    lines = ["# again: save the case above as case.toml", f"{program} {ranks}{model} case.toml -o again", "# more of this run",
             f"{program} plot {folder}", f"{program} measure {folder}", f"{program} report {folder}"]
    goes_on = f"{program} {ranks}{model} case.toml -o {folder} --resume"
    if record.get("state") != "done":
        lines.insert(2, f"# or go on with it\n{goes_on}")
    elif record.get("card", {}).get("steady") is False and record.get("time_s"):
        lines.insert(2, f'# not steady: go on for as long again\n{goes_on} --until "{2 * record["time_s"]:.4g} s"')
    return listing("\n".join(lines) + f'\n# in Python\nimport polybed\nrun = polybed.read({str(run.directory)!r})')


def recorded(lines):
    """The lines of the card, as the screen has them."""
    note = source("means over the last quarter of the time with their 95 % intervals; polybed explain WORD says what a word means")
    return table([], [[line[:HEADING].strip(), line[HEADING:]] for line in lines], "words") + note


def species_rows(case):
    return [[species["name"], f"{text(species['diameter'], 'm')}, {species['density']:.4g} kg/m\u00b3"]
            for species in case.get("species", []) if {"name", "diameter", "density"} <= species.keys()]


def time_row(record):
    predicted = record.get("prediction", {})
    if "cpu_s" not in record or record.get("state") == "running":  # then it is of the last checkpoint
        return []
    shown = f"{text(record['cpu_s'], 's')} of computing for {text(record.get('time_s', 0), 's')} simulated"
    if "least_s" in predicted and "most_s" in predicted:
        shown += f"; predicted {text(predicted['least_s'], 's')} to {text(predicted['most_s'], 's')}"
    return [["time", shown]]


def of_case(run):
    """The bed of a run that has not yet written a card."""
    record = run.record
    case = case_of(record)
    fluid, velocity = case.get("fluid", {}).get("name"), velocity_of(case)
    rows = species_rows(case) + time_row(record)
    if fluid and fluid != "none":
        rows.append(["fluid", fluid + (f", superficial velocity {text(velocity, 'm/s')}" if velocity else "")])
    return table([], rows, "words") if rows else ""


def card_of(run):
    lines = run.card.get("lines")
    return markup('<div class="card">{}</div>', recorded(lines) if lines else of_case(run))
