"""Puts the page of a run together: what `polybed report` hands over to."""

import argparse
import json
import time
from pathlib import Path

from polybed import page
from polybed.drawing.style import length_unit
from polybed.texts import text
from polybed.ending import made
from polybed.files import contents_of, in_place
from polybed.read import Snapshot
from polybed.folder import case_of, title_of_case
from polybed.report import sections
from polybed.report.beds import maps_of, particles_of
from polybed.report.sections import card_of
from polybed.report.series import history_of, profiles_of

SCRIPT = Path(__file__).with_name("viewer.js").read_text(encoding="utf-8")
NAME = "report.html"


def under(run):
    """The line below the title: model, folder, time, state."""
    record = run.record
    parts = [sections.MODELS.get(record.get("model"), ""), page.file_name(run.directory.resolve().name)]
    times = run.history.get("time_s", ())
    time_s = times[-1] if len(times) else record.get("time_s")  # the record of a run that goes on is from its last checkpoint
    if isinstance(time_s, (int, float)):
        parts.append(f"{text(time_s, 's')} simulated")
    state = record.get("state", "no run.json yet")
    parts.append(state if state == "done" else page.markup('<span class="warning">{}</span>', state))
    return page.Html(" &middot; ").join(part for part in parts if part)


def drawn(run):
    """What the script draws, as a dictionary for JSON."""
    factor, unit = length_unit(run)
    return {"maps": maps_of(run), "particles": particles_of(run), "profiles": profiles_of(run, factor), "history": history_of(run),
            "unit": unit}


def parts(run):
    """The written sections by name: (title, body)."""
    record = run.record
    case = case_of(record)
    return {"card": ("Results", card_of(run)), "beds": ("The bed", ""), "history": ("History", ""),
            "limits": ("What limited the steps", sections.limits(run) + sections.work(record)),
            "invariants": ("Invariants", sections.invariants(record)), "effects": ("Effects", sections.effects(record, case)),
            "case": ("The case", sections.the_case(record)), "cite": ("How to cite", sections.cite(record, case)),
            "commands": ("Commands", sections.commands(run, record))}


def embedded(data):
    """JSON inside a page: no text of it can end the element that it is in."""
    return page.Html(json.dumps(data, ensure_ascii=False, allow_nan=False).replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e"))


def page_of(run, live=page.Html(), follow=()):
    """The page as text. live: what a page that renews itself shows first; follow: the script that renews it"""
    data = drawn(run)
    views = {"beds": '<div id="bed-view"></div>' if live or data["maps"] or data["particles"] or data["profiles"] else "",
             "history": '<div id="history-view" class="row"></div>' if live or data["history"] else ""}
    body = live
    for name, (title, words) in parts(run).items():
        body += page.section(name, title, page.Html(views[name]) if name in views else words)
    body += page.warnings(run.record.get("warnings", []))
    body += page.markup('<noscript><p>The pictures need JavaScript.</p></noscript><script type="application/json" id="data">{}</script>',
                        embedded(data))
    return page.page(title_of_case(run.record) or run.directory.resolve().name, under(run), body, [SCRIPT, *follow], follows=bool(follow))


def write(directory):
    """Puts RUN/report.html in place whole. Returns its path, its size in bytes and the seconds that it took."""
    begin = time.perf_counter()
    run = Snapshot(directory)
    with contents_of(run.directory):
        content = page_of(run).encode("utf-8", errors="replace")
    path = run.directory / NAME
    with in_place(path) as temporary:
        temporary.write_bytes(content)
    return path, len(content), time.perf_counter() - begin


def told(path, size, seconds):
    return f"{path} ({size / 1e6:.2g} MB, made in {seconds:.2g} s)"


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed report", description="Makes report.html of a finished or a running run.")
    parser.add_argument("run", help="run directory")
    directory = parser.parse_args(arguments).run
    return made(lambda: [told(*write(directory))])
