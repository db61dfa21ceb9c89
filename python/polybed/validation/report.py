"""What `polybed validate` shows: the table of a comparison, its page, and the record of results with its part of docs/record/validation.md."""

import json

from polybed.files import FormatError, put_text, read_json, read_text
from polybed.page import Html, markup, page, section, source
from polybed.page import table as html_table
from polybed.texts import markdown_table
from polybed.validation.numbers import INSIDE, OUTSIDE, UNDECIDED

HEAD = ("bed", "run", "model", "quantity", "measured", "of the model", "joint", "verdict", "CPU s")
RECORDED = "recorded.json"  # numbers of models: next to the entries, never in them
BEGIN, END = "<!-- polybed validate --record: begin -->", "<!-- polybed validate --record: end -->"
NEGLIGIBLE = 1e-6  # of a value: an interval of a bed that stands still
VERDICTS = (INSIDE, OUTSIDE, UNDECIDED)


def shown(number):
    if number is None:
        return "-"
    value, error = number
    if error is not None and error < NEGLIGIBLE * abs(value):
        error = 0.0
    return f"{value:.4g}" if error is None else f"{value:.4g} ± {error:.2g}"


def cells(row):
    """A row of results as texts, in the order of HEAD."""
    joint, unit = row["joint"], f", {row['unit']}" if row["unit"] != "1" else ""
    told = f"{row['verdict']}: {row['reason']}" if row["reason"] else row["verdict"]
    runs = f" ({row['runs']} runs)" if row.get("runs", 1) > 1 else ""
    seconds = "-" if row["cpu_s"] is None else f"{row['cpu_s']:.2g}"
    return [row["entry"], row["run"], row["model"], row["quantity"] + unit, shown(row["measured"]), shown(row["result"]) + runs,
            "-" if joint is None else f"± {joint:.2g}", told, seconds]


def counted(rows):
    """How many rows have each verdict, in words."""
    found = [row["verdict"] for row in rows]
    return ", ".join(f"{found.count(verdict)} {verdict}" for verdict in dict.fromkeys((*VERDICTS, *found)) if verdict in found)


def html_page(rows, entries, command, commit):
    body = section("results", "Results", html_table(HEAD, [cells(row) for row in rows]) + source(
        "Measured and computed numbers with their 95 % intervals. A row is inside where the two differ by no more than the joint interval; "
        "a bed that still drifts is undecided."))
    parts = [section(entry.name, entry.title, markup("<p>{}</p><p>{}</p>", f"Measured: {entry.source}", entry.note or entry.missing))
             for entry in entries]
    return page("Measured beds against the models", f"{command}, commit {commit}", body + Html().join(parts))


def read_recorded(folder):
    """Recorded blocks: an entry and a model each, with `date`, `git_commit`, `command` and `rows`."""
    path = folder / RECORDED
    return read_json(path, "polybed validation")["blocks"] if path.exists() else []


def merged(blocks, new):
    """Recorded blocks with those of the same entry, model and runs replaced; one of all runs replaces those of some. Sorted."""
    whole = {(block["entry"], block["model"]) for block in new if not block.get("runs")}
    kept = [block for block in blocks if (block["entry"], block["model"]) not in whole]
    found = {(block["entry"], block["model"], *block.get("runs", [])): block for block in (*kept, *new)}
    return [found[key] for key in sorted(found)]


def section_text(blocks):
    """The generated part of docs/record/validation.md."""
    total = [row for block in blocks for row in block["rows"]]
    commands = "\n".join(f"- `{block['command']}`, {block['date']}, commit {block['git_commit'][:9]}, {block['cpu_s']:.2g} CPU s" for block in blocks)
    shown_of = [cells(row)[:6] + [cells(row)[7]] for row in total]  # the joint interval follows from both, CPU s stand by the command
    return f"{BEGIN}\n{counted(total)}.\n\n{markdown_table(HEAD[:6] + HEAD[7:8], shown_of)}\n\n{commands}\n{END}"


def with_section(text, blocks):
    """A page with its generated part renewed. Raises FormatError without the marks."""
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise FormatError(f"docs/record/validation.md lacks the marks {BEGIN} and {END}")
    return before + section_text(blocks) + after


def write_recorded(folder, document, new):
    """Adds results to the record next to the entries and renews the document. Returns the paths."""
    blocks = merged(read_recorded(folder), new)
    text = with_section(read_text(document), blocks)
    record = json.dumps({"filetype": "polybed validation", "version": 1, "blocks": blocks}, ensure_ascii=False, allow_nan=False, indent=1)
    return [put_text(folder / RECORDED, record + "\n"), put_text(document, text)]
