"""The written parts of the page of a run: what limited its steps, invariants, effects, the case, how to cite, the commands."""

import csv
import re
import shlex
from collections import Counter

from polybed.drawing.units import text
from polybed.page import escaped, folded, listing, source, table

MOST_LIMITS = 8
MODELS = {"tfm": "two-fluid model", "dem": "particles, one by one"}


def reason_of(limited_by):
    """What limited a step, without the place: "error test: u_fine.y (0, 1)" in every cell is one reason."""
    return re.sub(r"(\s+at)?\s*\([^()]*\)\s*$", "", limited_by).strip()


def limits_of_steps(path):
    """(simulated seconds, steps) by reason, of a steps.csv; a row being written is left out."""
    seconds, steps = Counter(), Counter()
    with path.open(encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        head = next(rows, [])
        if not {"dt_s", "limited_by"} <= set(head):
            return seconds, steps
        dt, why = head.index("dt_s"), head.index("limited_by")
        for row in rows:
            if len(row) != len(head):
                continue
            reason = reason_of(row[why])
            try:
                seconds[reason] += float(row[dt])
            except ValueError:
                continue
            steps[reason] += 1
    return seconds, steps


def most_common_of(lines):
    """[(reason, steps)] of rows of steps.csv, most often first."""
    return Counter(reason_of(row[-1]) for row in csv.reader(lines) if len(row) == 4).most_common()


def limits(run):
    """What limited the steps: shares of the two-fluid model's steps, or the step of particles beside its next limits."""
    path = run.directory / "steps.csv"
    if path.is_file():
        seconds, steps = limits_of_steps(path)
        total = sum(steps.values())
        if total:
            rows = [[escaped(why), f"{count}", f"{100 * count / total:.3g} %", text(seconds[why] / count, "s")]
                    for why, count in steps.most_common(MOST_LIMITS)]
            left = total - sum(count for _, count in steps.most_common(MOST_LIMITS))
            rows += [["others", f"{left}", f"{100 * left / total:.3g} %", ""]] if left else []
            return table(["limited by", "steps", "share", "mean step"], rows) + source(f"steps.csv, {total} steps")
    step = run.record.get("step", {})
    if not step.get("limits"):
        return ""
    rows = [[escaped(one["name"]), text(one["dt_s"], "s")] for one in step["limits"][:MOST_LIMITS]]
    return table(["limit", "longest step allowed"], rows) + source(
        f"The step at the end, {text(step['dt_s'], 's')}, is the shortest of these; run.json.")


def work(record):
    """Counters and time by term."""
    total = sum(record.get("timers", {}).values())
    rows = [[escaped(name), text(seconds, "s"), f"{100 * seconds / total:.2g} %"]
            for name, seconds in sorted(record.get("timers", {}).items(), key=lambda term: -term[1]) if total > 0]
    counters = ", ".join(f"{escaped(name.replace('_', ' '))} {count:.6g}" for name, count in record.get("work", {}).items()
                         if isinstance(count, (int, float)) and not isinstance(count, bool))
    return (table(["computing time", "", "share"], rows) if rows else "") + (f"<p>{counters}</p>" if counters else "")


def invariants(record):
    rows = []
    for one in record.get("invariants", []):
        held = one.get("held", one["worst"] <= one["limit"])
        rows.append([escaped(one["name"]), f"{one['worst']:.2g}", f"{one['limit']:.2g}",
                     '<span class="held">held</span>' if held else '<span class="bad">exceeded</span>'])
    return table(["", "worst value", "limit", ""], rows) if rows else ""


def bound_of(row):
    if row.get("bound") is None:
        return "unknown"
    shown = f"{100 * row['bound']:.2g} %"
    return shown + (f", up to {100 * row['up_to']:.2g} %" if row.get("up_to") is not None else "")


def effects(record, case):
    """Which laws act, and what the model leaves out with its bound."""
    laws = [[escaped(name), escaped(law)] for name, law in case.get("effects", {}).items()]
    found = table(["acts", "law"], laws, "words") if laws else ""
    neglected = record.get("neglected", {})
    rows = sorted(neglected.get("rows", []), key=lambda row: -1 if row.get("bound") is None else -row["bound"])
    rows.sort(key=lambda row: row.get("bound") is None)
    shown = [[escaped(row["effect"].replace("_", " ")), bound_of(row), escaped(row.get("number") or ""), escaped(row.get("reason") or "")]
             for row in rows if "effect" in row]
    if shown:
        found += "<h3>Left out</h3>" + table(["effect", "bound", "judged by", "why"], shown, "words")
    if isinstance(neglected.get("sum"), (int, float)):
        found += source(f"The forces left out sum to at most {100 * neglected['sum']:.2g} % of the buoyant weight of the particles; "
                        f"the case allows {100 * neglected.get('promise', 0):.2g} % (chooser.tolerance). "
                        "The bound of another row is that of the number named beside it.")
    return found


def the_case(record):
    overrides = record.get("overrides") or []
    told = source("with " + ", ".join(f"<code>--set {escaped(shlex.quote(o))}</code>" for o in overrides)) if overrides else ""
    return told + folded("all keys, in SI units, as polybed reads them", listing(record.get("case") or "")) if record.get("case") else ""


def cite(record, case):
    laws = ", ".join(f"{name} {law}" for name, law in case.get("effects", {}).items())
    lines = [f"polybed {record.get('program', '')}, commit {record.get('git_commit', '')}, {MODELS.get(record.get('model'), '')}, "
             f"case {record.get('case_hash', '')}"]
    if laws:
        lines.append(f"with the sources of its laws ({laws}), which docs/theory/closures.md lists")
    return listing("\n".join(lines))


def commands(run, record):
    """What makes the run again, and what else can be done with it."""
    model, folder = record.get("model", "tfm"), shlex.quote(str(run.directory))
    ranks = f"-n {record['ranks']} " if record.get("ranks", 1) > 1 else ""
    lines = ["# again: save the case above as case.toml", f"polybed {ranks}{model} case.toml -o again", "# more of this run",
             f"polybed plot {folder}", f"polybed measure {folder}", f"polybed report {folder}"]
    goes_on = f"polybed {ranks}{model} case.toml -o {folder} --resume"
    if record.get("state") != "done":
        lines.insert(2, f"# or go on with it\n{goes_on}")
    elif record.get("card", {}).get("steady") is False and record.get("time_s"):
        lines.insert(2, f'# not steady: go on for as long again\n{goes_on} --until "{2 * record["time_s"]:.4g} s"')
    return listing("\n".join(lines) + f'\n# in Python\nimport polybed\nrun = polybed.read({str(run.directory)!r})')
