"""Two runs of one case side by side, and comparison.html. The two-fluid model is drawn in full lines, the particles in broken ones, a
species in its colour in both."""

import shlex
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing import inversion_scan, particles
from polybed.drawing.curves import heights, recovery
from polybed.drawing.maps import axes_at, draw_bar, draw_map, fractions, frame, map_size
from polybed.drawing.history import key
from polybed.drawing.profiles import shown_top
from polybed.drawing.style import NAMES, PALE, colour, drop_over_weight, length_unit
from polybed.files import read_json
from polybed.page import Html, file_name, listing, markup, page, picture, section, source, table, warnings
from polybed.quantities import measure_words
from polybed.read import nearest, read, stored_times
from polybed.folder import title_of_case
from polybed.runner import words_of
from polybed.study.recovery import is_recovery
from polybed.study.scores import RECOVERY, measure_cells, top_text, with_error

LINES = {"tfm": "-", "dem": "--"}
DOTS = {"tfm": (0, (1, 2)), "dem": (0, (1, 5))}  # of the interface, which no species has a colour for
MAP_HEIGHT = 4.0  # inches
GAP, LEFT, HEAD, BARS = 0.35, 0.75, 0.7, 0.9  # inches


def panels_at(runs, time):
    """("map", run, title, values, group) and ("particles", run, title, step, None) at a time; fractions of both models on one scale."""
    found, groups = [], []
    for model, run in runs.items():
        step = nearest(run.time, time)
        if step is not None and run.species:
            group = fractions(run, step)
            groups.append(group)
            found += [("map", run, f"{NAMES[model]}: {name}", values, group) for name, values in group.maps]
    most = max((group.limits[1] for group in groups), default=1)
    for group in groups:
        group.limits = (0, most)
    run = runs["dem"]
    step = nearest(run.particles.time, time)
    if step is not None:
        found.append(("particles", run, NAMES["dem"], run.particles[step], None))
    return found


def draw_instant(runs, time, top):
    """Both models at the stored times nearest to a time, up to a height, m. None if nothing is stored."""
    panels = panels_at(runs, time)
    if not panels:
        return None
    wide, high = map_size(panels[0][1], top, MAP_HEIGHT)
    wide = max(wide, 1.25)  # room for a title
    figure = plt.figure(figsize=(LEFT + len(panels) * (wide + GAP), HEAD + high + BARS))
    for n, (kind, run, title, shown, group) in enumerate(panels):
        left = LEFT + n * (wide + GAP)
        axes = axes_at(figure, left, BARS, wide, high)
        if kind == "map":
            mesh = draw_map(axes, run, group, title, shown, top, first=n == 0)
        else:
            frame(axes, run, title, top, first=n == 0)
            particles.circles(axes, run, shown, particles.species_colours(run, shown))
            particles.name_species(axes_at(figure, left, 0.3, wide, 0.1), run)
        axes.set_title(title, fontsize=8)
    if panels[0][0] == "map":
        draw_bar(mesh, axes_at(figure, LEFT, 0.38, wide, 0.1), panels[0][4])
    return figure


def draw_profiles(runs, means):
    """Mean profile of each species over the window, `mean_profiles` of comparison.json, with the band of its 95 % interval; None without any."""
    species = runs["tfm"].species or runs["dem"].species
    figure, all_axes = plt.subplots(1, len(species), figsize=(1 + 2.6 * len(species), 4.2), sharey=True, squeeze=False,
                                    constrained_layout=True)
    factor, unit = length_unit(runs["tfm"])
    height = np.array(means["y_m"]) * factor
    drawn, top = False, 0
    for model, run in runs.items():
        for n, name in enumerate(species):
            mean, error = (np.array(means[model][f"phi_{name}"][what], float) for what in ("mean", "error"))
            if not len(mean):
                continue
            drawn, top = True, max(top, shown_top(run))
            axes, told = all_axes[0][n], np.isfinite(error).any()
            axes.plot(mean, height, color=colour(n), linestyle=LINES[model],
                      label=NAMES[model] + ("" if told else ", too few profiles for a band"))
            axes.fill_betweenx(height, mean - error, mean + error, color=colour(n), alpha=0.2, linewidth=0,
                               label=f"{NAMES[model]}: 95 % interval of the mean" if told else None)
            axes.set(title=name, xlabel="solids fraction")
            axes.legend(fontsize=7)
    if not drawn:
        plt.close(figure)
        return None
    all_axes[0][0].set(ylabel=f"height ({unit})", ylim=(0, top * factor))
    return figure


def draw_history(runs, window):
    """Centres, bed height and interface in time, above the pressure drop over the buoyant weight and, if some has left, the recovery since the
    start; the window is shaded."""
    left = {model: recovery(run.history, run.kinds) for model, run in runs.items()}
    rows = [2, 1, 1] if any(left.values()) else [2, 1]
    figure, (upper, lower, *last) = plt.subplots(len(rows), 1, figsize=(8, 1.8 * sum(rows)), sharex=True, height_ratios=rows, constrained_layout=True)
    factor, unit = length_unit(runs["tfm"])
    for model, run in runs.items():
        for line in heights(run, ("bed_height_m", "interface_m"))[0].lines:
            upper.plot(line.x, line.y * factor, color=line.looks["color"], linewidth=1 if line.number is None else 1.5,
                       linestyle=DOTS[model] if line.label == "interface" else LINES[model], label=f"{line.label}, {NAMES[model]}")
        ratio = drop_over_weight(run.history)
        if ratio is not None:
            lower.plot(run.history["time_s"], ratio, color="black", linestyle=LINES[model], linewidth=1, label=NAMES[model])
        for n, name in enumerate(run.kinds if last else ()):
            if name in left[model]:
                last[0].plot(run.history["time_s"], left[model][name], color=colour(n), linestyle=LINES[model], label=f"{name}, {NAMES[model]}")
    for axes in (upper, lower, *last):
        axes.axvspan(window["begin_s"], window["end_s"], color=PALE, alpha=0.3, linewidth=0, zorder=0)
        key(axes)
    upper.set_ylim(bottom=0)
    upper.set_ylabel(f"height ({unit})")
    lower.set_ylabel("pressure drop\nover weight")
    for axes in last:
        axes.set_ylabel("recovery")
    (*last, lower)[0].set_xlabel("time (s)")
    return figure


def commands(found, records, scan=None):
    """The lines that make the runs, in place of those that are there, the scan that the inversion velocity is from (if it says
    what it was asked for), and the comparison again, from the folder in which they were made."""
    case, folders = found["case"], {model: found["models"][model]["directory"] for model in records}
    runs = [[*inversion_scan.on_ranks(record["ranks"]), "polybed", model, case, *words_of(record["overrides"]), "-o", folders[model], "--force"]
            for model, record in records.items()]
    scans = [inversion_scan.commands(scan)] if scan and "scan" in scan else []
    given = [word for model, folder in folders.items() for word in (f"--{model}", folder)]
    given += ["--inversion", str(Path(found["inversion_file"]).parent)] if "inversion_file" in found else []
    again = ["polybed", "compare", case, *words_of(found["overrides"]), *given, "-o", found["directory"]]
    return "\n".join(map(shlex.join, [*runs, *scans, again]))


def folder_of(run, *parts):
    """Name of a run's folder, or of a file in it, with the commit of the program that made the run."""
    return file_name(run["directory"], *parts) + f" (commit {run['git_commit']})"


SCORES = {"e_H": "bed height: two-fluid model over particles, less 1",
          "e_b": "distance of the centres of two species over the bed height: difference of the models",
          "D1": "layering: 0 if both models layer the species alike, 1 if one is upside down; "
                "the difference in the share of species 2 over the solids counted from below, integrated",
          "u_inv": "inversion velocity: two-fluid model over particles, less 1",
          "e_slip": "superficial slip: two-fluid model over particles, less 1"}


def score_words(name):
    if name.startswith("profile_"):
        return f"vertical profile of {name[len('profile_'):]}: difference of the models over height, over that of the particles"
    if is_recovery(name):
        return f"{measure_words(name)}: difference of the models; the goal is its interval"
    return SCORES.get(name, name)


def measure_row(name, measure):
    """Words, numbers in the unit that fits, and the file."""
    title, *numbers = measure_cells(name, measure)
    return [title, *(with_error(*pair) for pair in numbers), "profiles.h5" if name == "interface_m" else "history.csv"]


def measures(found):
    rows = [measure_row(name, measure) for name, measure in found["measures"].items()]
    folders = [folder_of(found["models"][model]) for model in NAMES]
    return table(["", "two-fluid", "particles", "difference", "from"], rows) + source(
        f"time means from {found['window']['begin_s']:.4g} to {found['window']['end_s']:.4g} s, recoveries of what is fed then or else of all until its end, with the half-width "
        "of their 95 % interval; files of " + Html(" and of ").join(folders))


def scores(found):
    def verdict_of(name, reached):
        undecided = RECOVERY[None] if is_recovery(name) else ""
        return {True: "reached", False: Html('<span class="missed">missed</span>'), None: undecided}[reached]

    rows = [[score_words(name), with_error(score["value"], score["error"]), with_error(score["goal"]) if score["goal"] else "",
             verdict_of(name, score["reached"])] for name, score in found["scores"].items() if name != "order"]
    order = found["scores"]["order"]
    top = [f"{NAMES[model]}: {top_text(order[model])}" for model in NAMES if order[model]]
    verdict = {True: "the same", False: Html('<span class="missed">not the same</span>'), None: ""}[order["same"]]
    told = markup("<p>On top: {}; {}.</p>", "; ".join(top), verdict) + source("means of the heights of the centres in history.csv of both runs") \
        if top else ""
    return Html("<p>How far apart the models are: 0 is no difference; a goal is reached if the value, whatever its interval, is at most the goal."
                "</p>") + table(["", "value", "goal", ""], rows) + told + source(
            "bed height and distance of the centres from history.csv, layering and profiles from profiles.h5 of both runs"
            + ("; inversion velocity from " + file_name(found["inversion_file"]) if "inversion_file" in found else ""))


def models(found):
    rows = [[NAMES[model], run["state"], with_error(run["time_s"]), with_error(run["cpu_s"]), with_error(run["wall_s"]),
             ", ".join(f"{name} {value:.4g}" for name, value in run["work"].items()),
             folder_of(run, "run.json")] for model, run in found["models"].items()]
    return table(["", "state", "simulated s", "CPU s", "s by the clock", "work", "from"], rows)


def pictures(found, runs):
    window, both = found["window"], Html(" and ").join(file_name(run.directory) for run in runs.values())
    tops = [shown_top(run) for run in runs.values() if run.profiles and len(run.profiles["time_s"])]
    parts = []
    for time in (0.0, window["begin_s"], window["end_s"]) if tops else ():
        shown = [f"{NAMES[model]} at {times[nearest(times, time)]:.4g} s" for model, run in runs.items()
                 if len(times := stored_times(run))]
        parts.append(picture(draw_instant(runs, time, max(tops)),
                             f"stored nearest to {time:.4g} s: {', '.join(shown)}; fields.h5 and particles.h5 of " + both))
    if "mean_profiles" in found:
        parts.append(picture(draw_profiles(runs, found["mean_profiles"]),
                             "means over the window, band: half-width of the 95 % interval of the mean, from leaving out groups of "
                             "successive profiles in turn; mean_profiles of comparison.json, from profiles.h5 of " + both))
    parts.append(picture(draw_history(runs, window), "the window is shaded; history.csv of " + both))
    return Html().join(parts)


def text_of(found, path):
    runs = {model: read(found["models"][model]["directory"]) for model in NAMES}
    records = {model: run.record for model, run in runs.items()}
    scan_path = Path(found["inversion_file"]) if "inversion_file" in found else None
    scan = read_json(scan_path, "polybed inversion") if scan_path else None
    lines = list(found["warnings"])
    if scan and "scan" not in scan:
        lines.append(f"{scan_path} does not hold what its scan was asked for, so that no command below makes it: scanned again, "
                     "with the runs that are there, it does")
    again = listing(commands(found, records, scan)) + source("all numbers: " + file_name(path) + f"; program of commit {found['git_commit']}")
    body = [section("measures", "Both models", measures(found)), section("scores", "Scores", scores(found)),
            section("inversion", "Inversion velocity", Html().join(inversion_scan.tables(scan)) + source(
                file_name(scan_path) + f" (commit {scan['git_commit']})") if scan else ""),
            section("pictures", "Pictures", pictures(found, runs)), section("cost", "Cost", models(found)), warnings(lines),
            section("commands", "How to make it again", again)]
    title = title_of_case(records["tfm"]) or title_of_case(records["dem"]) or found["case"]
    return page(title, "two-fluid model and particles beside each other \u00b7 " + file_name(found["case"]), Html().join(body))
