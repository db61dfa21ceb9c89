"""Draws inversion.json of a scan and makes its page, as `polybed inversion --scan` does at its end."""

import shlex
from pathlib import Path

from polybed.texts import fitting, text
from polybed.page import Html, file_name, listing, page, picture, section, source, table

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing.style import COLOURS, GREY, NAMES, PALE
from polybed.read import read
from polybed.folder import title_of_case
from polybed.runner import words_of
from polybed.study.scores import with_error
from polybed.study.inversion_search import known


def draw(found, _folder=None):
    """Mean difference of the centres over the velocity, by each model, with what was found."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    factor, unit = fitting("m/s", max((run["velocity_m_s"] for scan in found["models"].values() for run in scan["runs"]), default=0))
    for n, (model, scan) in enumerate(found["models"].items()):
        velocity, value, error = np.array(sorted((run["velocity_m_s"], run["centre_difference"], run["error"]) for run in scan["runs"])).T
        label = NAMES[model]
        if scan["velocity_m_s"] is not None:
            low, high = known(scan["outcome"], *(scan[f"{name}_m_s"] for name in ("low", "high", "velocity", "error")))
            axes.axvspan(low * factor, high * factor, color=COLOURS[n], alpha=0.15, linewidth=0)
            label += f": {text(scan['velocity_m_s'], 'm/s')}"
        axes.errorbar(velocity * factor, value, error, color=COLOURS[n], marker="os"[n % 2], markersize=4, linewidth=1, capsize=2,
                      label=label)
    axes.axhline(0, color=PALE, linewidth=0.8, zorder=0)
    balance = found["force_balance"]
    if balance:
        axes.axvline(balance["velocity_m_s"] * factor, color=GREY, linestyle=":", linewidth=1,
                     label=f"force balance: {text(balance['velocity_m_s'], 'm/s')}")
    first, second = found["species"]
    axes.set(xlabel=f"superficial velocity ({unit})", ylabel=f"centre of {second} less that of {first}, over the bed height")
    axes.legend(fontsize=8)
    return figure


OUTCOMES = {"bracket": "the range is narrow enough", "indistinct": "what is left is within the uncertainty of the runs",
            "not found": "no change of places in the range", "filled": "no change of places before the bed fills the column"}


def on_ranks(ranks):
    return ["mpirun", "-n", str(ranks)] if ranks > 1 else []


def commands(scan):
    """The words that make a scan again, or find it finished: range and end are those that it had, given or by default."""
    moved = ["--stress-uncertainty"] if "stress_uncertainty" in scan["models"].get("tfm", {}) else []
    return [*on_ranks(scan["ranks"]), "polybed", "inversion", scan["case"], *words_of(scan["overrides"]), "--scan", scan["scan"],
            "--from", f"{scan['from_m_s']!r} m/s", "--to", f"{scan['to_m_s']!r} m/s", "--until", f"{scan['until_s']!r} s",
            *moved, "-o", scan["directory"]]


def velocity_row(model, of):
    if of["velocity_m_s"] is None:
        found = "not found"
    else:
        factor, unit = fitting("m/s", of["velocity_m_s"])
        error = None if of["error_m_s"] is None else of["error_m_s"] * factor
        found = f"{with_error(of['velocity_m_s'] * factor, error)} {unit}"
    between = " to ".join("?" if of[f"{end}_m_s"] is None else text(of[f"{end}_m_s"], "m/s") for end in ("low", "high"))
    return [NAMES[model], found, between, OUTCOMES.get(of["outcome"], of["outcome"]), str(len(of["runs"])), text(of["cpu_s"], "s")]


def title_of(found):
    """Title of the case by the record of a run of it, else its path."""
    folders = (run["directory"] for of in found["models"].values() for run in of["runs"] if Path(run["directory"]).is_dir())
    return next(filter(None, (title_of_case(read(folder).record) for folder in folders)), found["case"])


def tables(found):
    """What the scan of each model has found, and its runs."""
    first, second = found["species"]
    rows = [velocity_row(model, of) for model, of in found["models"].items()]
    if balance := found["force_balance"]:
        rows.append(["force balance, without a run", text(balance["velocity_m_s"], "m/s"), "", "", "", ""])
    made = [[NAMES[model], text(run["velocity_m_s"], "m/s"), f"{run['centre_difference']:.3g} \u00b1 {run['error']:.1g}",
             file_name(run["directory"]) + (f" (commit {run['git_commit']})" if "git_commit" in run else "")]
            for model, of in found["models"].items() for run in of["runs"]]
    return (table(["", "superficial velocity", "between", "ended because", "runs", "computing"], rows) + source(
        f"The velocity at which {first} and {second} change places."),
        table(["", "velocity", f"centre of {second} less that of {first}, over the bed height", "run"], made))


def text_of(found, path):
    drawn = picture(draw(found), "means over the last part of each run, with their 95 % intervals; " + file_name(path),
                    "distance of the centres over the velocity")
    velocities, runs = tables(found)
    body = [section("found", "Inversion velocity", velocities), section("picture", "Runs", drawn + runs),
            section("commands", "How to make it again", listing(shlex.join(commands(found))) if "scan" in found else "")]
    return page(title_of(found), "inversion velocity by runs \u00b7 " + file_name(found["case"]), Html().join(body))
