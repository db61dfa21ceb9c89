"""Makes comparison.html of a comparison.json: one page that stands alone, which `polybed compare` writes at its end.

    python3 -m polybed.comparison DIR

Exit codes are those of polybed: 0 done, 2 the command is wrong, 4 a file or a package is missing.
"""

import argparse
import base64
import html
import io
import shlex
import sys
from pathlib import Path

from polybed.in_place import in_place
from polybed.packages import needed

with needed(__name__ == "__main__"):
    import matplotlib.pyplot as plt

    from polybed.drawing import comparison as drawing
    from polybed.drawing.profiles import shown_top
    from polybed.drawing.style import NAMES, STYLE
    from polybed.files import contents_of, print_made, read_json
    from polybed.plot import stored_times
    from polybed.read import nearest, read
    from polybed.study.compare_report import with_error

LOOKS = """body{font:15px/1.45 sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}
table{border-collapse:collapse;margin:.6rem 0}th,td{padding:.2rem .8rem;text-align:right;border-bottom:1px solid #ddd}
th:first-child,td:first-child{text-align:left}img{max-width:100%}code{background:#f3f3f3}pre{background:#f3f3f3;padding:.6rem;
overflow-x:auto;white-space:pre-wrap}.source{color:#666;font-size:85%}.missed,.warning{color:#a33}"""


def number(value, error=None):
    return "&ndash;" if value is None else with_error(value, error).replace("+-", "&plusmn; ")


def table(head, rows):
    """Cells are HTML already."""
    cells = "".join(f"<th>{cell}</th>" for cell in head)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><tr>{cells}</tr>{body}</table>"


def source(text):
    return f'<p class="source">{text}</p>'


def file_name(*parts):
    return f"<code>{html.escape(str(Path(*parts)))}</code>"


def picture(figure, told):
    """A figure in the page itself, with what it was drawn from; nothing for no figure."""
    if figure is None:
        return ""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", bbox_inches="tight")
    plt.close(figure)
    data = base64.b64encode(buffer.getvalue()).decode()
    return f'<p><img alt="" src="data:image/png;base64,{data}"></p>' + source(told)


def on_ranks(ranks):
    return ["mpirun", "-n", str(ranks)] if ranks > 1 else []


def settings(overrides):
    return [word for override in overrides for word in ("--set", override)]


def scan_command(scan):
    """The words that make a scan again, or find it finished: range and end are those that it had, given or by default."""
    words = [*on_ranks(scan["ranks"]), "polybed", "inversion", scan["case"], *settings(scan["overrides"]), "--scan", scan["scan"]]
    for option, value in (("--from", f"{scan['from_m_s']!r} m/s"), ("--to", f"{scan['to_m_s']!r} m/s"),
                          ("--until", f"{scan['until_s']!r} s")):
        words += [option, value]
    if "stress_uncertainty" in scan["models"].get("tfm", {}):
        words.append("--stress-uncertainty")
    return words + ["-o", scan["directory"]]


def commands(found, records, scan=None):
    """The lines that make the runs, in place of those that are there, the scan that the inversion velocity is from (if it says
    what it was asked for), and the comparison again, from the folder in which they were made."""
    case = found["case"]
    lines = []
    for model, record in records.items():
        words = [*on_ranks(record["ranks"]), "polybed", model, case, *settings(record["overrides"])]
        lines.append(words + ["-o", found["models"][model]["directory"], "--force"])
    if scan and "scan" in scan:
        lines.append(scan_command(scan))
    words = ["polybed", "compare", case, *settings(found["overrides"])]
    for model in records:
        words += [f"--{model}", found["models"][model]["directory"]]
    if "inversion_file" in found:
        words += ["--inversion", str(Path(found["inversion_file"]).parent)]
    return "\n".join(shlex.join(words) for words in [*lines, words + ["-o", found["directory"]]])


def folder_of(run, *parts):
    """Name of a run's folder, or of a file in it, with the commit of the program that made the run."""
    return f"{file_name(run['directory'], *parts)} (commit {html.escape(run['git_commit'])})"


def measures(found):
    rows = [[name, number(m["tfm"], m["tfm_error"]), number(m["dem"], m["dem_error"]),
             number(m["difference"], m["difference_error"]),
             ("profiles.h5" if name == "interface_m" else "history.csv")]
            for name, m in found["measures"].items()]
    folders = [folder_of(found["models"][model]) for model in ("tfm", "dem")]
    return table(["", "tfm", "dem", "tfm &minus; dem", "from"], [[html.escape(row[0]), *row[1:]] for row in rows]) + source(
        f"time means from {found['window']['begin_s']:.4g} to {found['window']['end_s']:.4g} s, with the half-width of their "
        f"95 % interval; files of {folders[0]} and of {folders[1]}")


def scores(found):
    rows = []
    for name, score in found["scores"].items():
        if name == "order":
            continue
        verdict = {True: "reached", False: '<span class="missed">missed</span>', None: ""}[score["reached"]]
        rows.append([html.escape(name), number(score["value"], score["error"]), number(score["goal"]) if score["goal"] else "", verdict])
    order = found["scores"]["order"]
    top = [f"{NAMES[model]}: {html.escape(order[model]['species'])}" + ("" if order[model]["certain"] else " (within the uncertainty)")
           for model in ("tfm", "dem") if order[model]]
    verdict = {True: "the same", False: '<span class="missed">not the same</span>', None: ""}[order["same"]]
    told = f"<p>On top: {'; '.join(top)}; {verdict}.</p>" + source("means of centre_ in history.csv of both runs") if top else ""
    return table(["", "", "goal", ""], rows) + told + source(
        "e_H and e_b from history.csv, D1 and profile_ from profiles.h5 of both runs"
        + (f"; u_inv from {file_name(found['inversion_file'])}" if "inversion_file" in found else ""))


def inversion(scan, path):
    """What the scan has found of the inversion velocity itself, which the score u_inv is the quotient of."""
    def in_mm(metres):
        return None if metres is None else 1e3 * metres

    rows = [[NAMES[model], number(in_mm(of["velocity_m_s"]), in_mm(of["error_m_s"])),
             f"{number(in_mm(of['low_m_s']))} to {number(in_mm(of['high_m_s']))}", html.escape(of["outcome"]),
             str(len(of["runs"])), number(of["cpu_s"])] for model, of in scan["models"].items()]
    text = "<h2>Inversion velocity</h2>" + table(["", "mm/s", "between, mm/s", "ended by", "runs", "CPU s"], rows) + source(
        f"{file_name(path)} (commit {html.escape(scan['git_commit'])})")
    made = [[NAMES[model], number(in_mm(run["velocity_m_s"])), number(run["centre_difference"], run["error"]), folder_of(run)]
            for model, of in scan["models"].items() for run in of["runs"] if "git_commit" in run]
    return text + (table(["its runs", "mm/s", "centre_difference", "from history.csv of"], made) if made else "")


def models(found):
    rows = [[NAMES[model], html.escape(run["state"]), number(run["time_s"]), number(run["cpu_s"]), number(run["wall_s"]),
             html.escape(", ".join(f"{name} {value:.4g}" for name, value in run["work"].items())),
             folder_of(run, "run.json")] for model, run in found["models"].items()]
    return table(["", "state", "simulated s", "CPU s", "s by the clock", "work", "from"], rows)


def pictures(found, runs):
    window, folders = found["window"], {model: run.directory for model, run in runs.items()}
    both = [file_name(folders[model]) for model in ("tfm", "dem")]
    tops = [shown_top(run) for run in runs.values() if run.profiles and len(run.profiles["time_s"])]
    parts = []
    for time in (0.0, window["begin_s"], window["end_s"]) if tops else ():
        shown = [f"{NAMES[model]} at {times[nearest(times, time)]:.4g} s" for model, run in runs.items()
                 if len(times := stored_times(run))]
        parts.append(picture(drawing.draw_instant(runs, time, max(tops)),
                             f"stored nearest to {time:.4g} s: {', '.join(shown)}; fields.h5 and particles.h5 of {both[0]} and {both[1]}"))
    if "mean_profiles" in found:
        parts.append(picture(drawing.draw_profiles(runs, found["mean_profiles"]),
                             "means over the window, band: half-width of the 95 % interval of the mean, from leaving out groups of "
                             f"successive profiles in turn; mean_profiles of comparison.json, from profiles.h5 of {both[0]} and {both[1]}"))
    parts.append(picture(drawing.draw_history(runs, window), f"the window is shaded; history.csv of {both[0]} and {both[1]}"))
    return "".join(parts)


def page(directory):
    """The page as text."""
    path = Path(directory) / "comparison.json"
    found = read_json(path, "polybed comparison")
    runs = {model: read(found["models"][model]["directory"]) for model in ("tfm", "dem")}
    records = {model: run.record for model, run in runs.items()}
    scan_path = Path(found["inversion_file"]) if "inversion_file" in found else None
    scan = read_json(scan_path, "polybed inversion") if scan_path else None
    lines = list(found["warnings"])
    if scan and "scan" not in scan:
        lines.append(f"{scan_path} does not hold what its scan was asked for, so that no command below makes it: scanned again, "
                     "with the runs that are there, it does")
    warnings = "".join(f'<p class="warning">{html.escape(text)}</p>' for text in lines)
    title = html.escape(f"{found['case']}: two-fluid model and particles")
    with plt.rc_context(STYLE):
        drawn = pictures(found, runs)
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>{LOOKS}</style></head>'
            f"<body><h1>{title}</h1>{warnings}<h2>Measures</h2>{measures(found)}<h2>Scores</h2>{scores(found)}"
            f"{inversion(scan, scan_path) if scan else ''}<h2>Cost</h2>{models(found)}<h2>Pictures</h2>{drawn}<h2>How to make it again</h2>"
            f"<pre>{html.escape(commands(found, records, scan))}</pre>"
            + source(f"all numbers: {file_name(path)}; program of commit {html.escape(found['git_commit'])}") + "</body></html>\n")


def write_page(directory):
    """Puts DIR/comparison.html in place whole and returns its path."""
    path = Path(directory) / "comparison.html"
    with contents_of(path.with_name("comparison.json")):
        text = page(directory)
    with in_place(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return path


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed.comparison", description="Makes the page of a comparison.")
    parser.add_argument("directory", help="folder of comparison.json")
    directory = parser.parse_args(arguments).directory
    return print_made(lambda: [write_page(directory)])


if __name__ == "__main__":
    sys.exit(main())
