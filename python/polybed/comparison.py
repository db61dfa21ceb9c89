"""Makes comparison.html of a comparison.json: one page that stands alone, which `polybed compare` writes at its end."""

import shlex
from pathlib import Path

from polybed.page import Html, file_name, listing, markup, page, picture, section, source, table, warnings

from polybed.drawing import comparison as drawing
from polybed.drawing.profiles import shown_top
from polybed.drawing.style import NAMES
from polybed.files import read_json
from polybed.plot import stored_times
from polybed.read import nearest, read
from polybed.record import title_of_case
from polybed.runner import words_of
from polybed.drawing.inversion_scan import commands as scan_command
from polybed.study.compare_report import measure_cells, with_error


def number(value, error=None):
    return "\u2013" if value is None else with_error(value, error).replace("+-", "\u00b1 ")


def on_ranks(ranks):
    return ["mpirun", "-n", str(ranks)] if ranks > 1 else []


def commands(found, records, scan=None):
    """The lines that make the runs, in place of those that are there, the scan that the inversion velocity is from (if it says
    what it was asked for), and the comparison again, from the folder in which they were made."""
    case = found["case"]
    lines = []
    for model, record in records.items():
        words = [*on_ranks(record["ranks"]), "polybed", model, case, *words_of(record["overrides"])]
        lines.append(words + ["-o", found["models"][model]["directory"], "--force"])
    if scan and "scan" in scan:
        lines.append(scan_command(scan))
    words = ["polybed", "compare", case, *words_of(found["overrides"])]
    for model in records:
        words += [f"--{model}", found["models"][model]["directory"]]
    if "inversion_file" in found:
        words += ["--inversion", str(Path(found["inversion_file"]).parent)]
    return "\n".join(shlex.join(words) for words in [*lines, words + ["-o", found["directory"]]])


def folder_of(run, *parts):
    """Name of a run's folder, or of a file in it, with the commit of the program that made the run."""
    return file_name(run["directory"], *parts) + f" (commit {run['git_commit']})"


SCORES = {"e_H": "bed height: two-fluid model over particles, less 1",
          "e_b": "distance of the centres of two species over the bed height: difference of the models",
          "D1": "layering: 0 if both models layer the species alike, 1 if one is upside down; "
                "the difference in the share of species 2 over the solids counted from below, integrated",
          "u_inv": "inversion velocity: two-fluid model over particles, less 1"}


def score_words(name):
    if name.startswith("profile_"):
        return f"vertical profile of {name[len('profile_'):]}: difference of the models over height, over that of the particles"
    return SCORES.get(name, name)


def measure_row(name, measure):
    """Words, numbers in the unit that fits, and the file."""
    title, *numbers = measure_cells(name, measure)
    return [title, *(number(*pair) for pair in numbers), "profiles.h5" if name == "interface_m" else "history.csv"]


def measures(found):
    rows = [measure_row(name, measure) for name, measure in found["measures"].items()]
    folders = [folder_of(found["models"][model]) for model in ("tfm", "dem")]
    return table(["", "two-fluid", "particles", "difference", "from"], rows) + source(
        f"time means from {found['window']['begin_s']:.4g} to {found['window']['end_s']:.4g} s, with the half-width of their "
        "95 % interval; files of " + Html(" and of ").join(folders))


def scores(found):
    rows = []
    for name, score in found["scores"].items():
        if name == "order":
            continue
        verdict = {True: "reached", False: Html('<span class="missed">missed</span>'), None: ""}[score["reached"]]
        rows.append([score_words(name), number(score["value"], score["error"]), number(score["goal"]) if score["goal"] else "", verdict])
    order = found["scores"]["order"]
    top = [f"{NAMES[model]}: {order[model]['species']}" + ("" if order[model]["certain"] else " (within the uncertainty)")
           for model in ("tfm", "dem") if order[model]]
    verdict = {True: "the same", False: Html('<span class="missed">not the same</span>'), None: ""}[order["same"]]
    told = markup("<p>On top: {}; {}.</p>", "; ".join(top), verdict) + source("means of the heights of the centres in history.csv of both runs") \
        if top else ""
    return Html("<p>How far apart the models are: 0 is no difference; a goal is reached if the value, whatever its interval, is at most the goal."
                "</p>") + table(["", "value", "goal", ""], rows) + told + source(
            "bed height and distance of the centres from history.csv, layering and profiles from profiles.h5 of both runs"
            + ("; inversion velocity from " + file_name(found["inversion_file"]) if "inversion_file" in found else ""))


def inversion(scan, path):
    """What the scan has found of the inversion velocity itself, which the score u_inv is the quotient of."""
    def in_mm(metres):
        return None if metres is None else 1e3 * metres

    rows = [[NAMES[model], number(in_mm(of["velocity_m_s"]), in_mm(of["error_m_s"])),
             f"{number(in_mm(of['low_m_s']))} to {number(in_mm(of['high_m_s']))}", of["outcome"],
             str(len(of["runs"])), number(of["cpu_s"])] for model, of in scan["models"].items()]
    text = table(["", "mm/s", "between, mm/s", "ended by", "runs", "CPU s"], rows) + source(
        file_name(path) + f" (commit {scan['git_commit']})")
    made = [[NAMES[model], number(in_mm(run["velocity_m_s"])), number(run["centre_difference"], run["error"]), folder_of(run)]
            for model, of in scan["models"].items() for run in of["runs"] if "git_commit" in run]
    return text + (table(["its runs", "mm/s", "distance of the centres over the bed height", "from history.csv of"], made) if made else Html())


def models(found):
    rows = [[NAMES[model], run["state"], number(run["time_s"]), number(run["cpu_s"]), number(run["wall_s"]),
             ", ".join(f"{name} {value:.4g}" for name, value in run["work"].items()),
             folder_of(run, "run.json")] for model, run in found["models"].items()]
    return table(["", "state", "simulated s", "CPU s", "s by the clock", "work", "from"], rows)


def pictures(found, runs):
    window, folders = found["window"], {model: run.directory for model, run in runs.items()}
    both = Html(" and ").join(file_name(folders[model]) for model in ("tfm", "dem"))
    tops = [shown_top(run) for run in runs.values() if run.profiles and len(run.profiles["time_s"])]
    parts = []
    for time in (0.0, window["begin_s"], window["end_s"]) if tops else ():
        shown = [f"{NAMES[model]} at {times[nearest(times, time)]:.4g} s" for model, run in runs.items()
                 if len(times := stored_times(run))]
        parts.append(picture(drawing.draw_instant(runs, time, max(tops)),
                             f"stored nearest to {time:.4g} s: {', '.join(shown)}; fields.h5 and particles.h5 of " + both))
    if "mean_profiles" in found:
        parts.append(picture(drawing.draw_profiles(runs, found["mean_profiles"]),
                             "means over the window, band: half-width of the 95 % interval of the mean, from leaving out groups of "
                             "successive profiles in turn; mean_profiles of comparison.json, from profiles.h5 of " + both))
    parts.append(picture(drawing.draw_history(runs, window), "the window is shaded; history.csv of " + both))
    return Html().join(parts)


def text_of(found, path):
    runs = {model: read(found["models"][model]["directory"]) for model in ("tfm", "dem")}
    records = {model: run.record for model, run in runs.items()}
    scan_path = Path(found["inversion_file"]) if "inversion_file" in found else None
    scan = read_json(scan_path, "polybed inversion") if scan_path else None
    lines = list(found["warnings"])
    if scan and "scan" not in scan:
        lines.append(f"{scan_path} does not hold what its scan was asked for, so that no command below makes it: scanned again, "
                     "with the runs that are there, it does")
    again = listing(commands(found, records, scan)) + source("all numbers: " + file_name(path) + f"; program of commit {found['git_commit']}")
    body = [section("measures", "Both models", measures(found)), section("scores", "Scores", scores(found)),
            section("inversion", "Inversion velocity", inversion(scan, scan_path) if scan else ""),
            section("pictures", "Pictures", pictures(found, runs)), section("cost", "Cost", models(found)), warnings(lines),
            section("commands", "How to make it again", again)]
    title = title_of_case(records["tfm"]) or title_of_case(records["dem"]) or found["case"]
    return page(title, "two-fluid model and particles beside each other \u00b7 " + file_name(found["case"]), Html().join(body))
