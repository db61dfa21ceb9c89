"""Two runs of one case beside each other: maps and particles at an instant, mean profiles, and what is measured in time.

The two-fluid model is drawn in full lines, the particles in broken ones, a species in its colour in both.
"""

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing import particles
from polybed.drawing.fields import fractions
from polybed.drawing.maps import axes_at, draw_bar, draw_map, frame, map_size
from polybed.drawing.profiles import shown_top
from polybed.drawing.style import COLOURS, GREY, NAMES, PALE, length_unit
from polybed.read import nearest

LINES = {"tfm": "-", "dem": "--"}
DOTS = {"tfm": (0, (1, 2)), "dem": (0, (1, 5))}  # of the interface, which no species has a colour for
MAP_HEIGHT = 4.0  # inches
GAP, LEFT, HEAD, BARS = 0.35, 0.75, 0.7, 0.9  # inches


def colour(n):
    return COLOURS[n % len(COLOURS)]


def panels_at(runs, time):
    """What there is to draw at a time: ("map", run, title, values, group) and ("particles", run, title, step, None); the
    volume fractions of both models on one scale."""
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
    """Mean profile of each species over the window, with the 95 % interval of that mean as a band. None if no run has stored a
    profile in the window.

    means: "mean_profiles" of comparison.json
    """
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
            axes.set_title(name)
            axes.set_xlabel("solids fraction")
            axes.legend(fontsize=7)
    if not drawn:
        plt.close(figure)
        return None
    all_axes[0][0].set_ylabel(f"height ({unit})")
    all_axes[0][0].set_ylim(0, top * factor)
    return figure


def draw_history(runs, window):
    """Centres, bed height and interface in time, above the pressure drop over the buoyant weight; the window is shaded."""
    figure, (heights, drop) = plt.subplots(2, 1, figsize=(8, 5.4), sharex=True, height_ratios=[2, 1],
                                           constrained_layout=True)
    factor, unit = length_unit(runs["tfm"])
    for model, run in runs.items():
        history, line = run.history, LINES[model]
        t = history["time_s"]
        for n, name in enumerate(run.species):
            heights.plot(t, history[f"centre_{name}_m"] * factor, color=colour(n), linestyle=line,
                         label=f"centre of {name}, {NAMES[model]}")
        heights.plot(t, history["bed_height_m"] * factor, color=GREY, linestyle=line, linewidth=1,
                     label=f"bed height, {NAMES[model]}")
        if np.isfinite(history.get("interface_m", np.nan)).any():  # empty where nothing is alike
            heights.plot(t, history["interface_m"] * factor, color="black", linestyle=DOTS[model], linewidth=1,
                         label=f"interface, {NAMES[model]}")
        weight = history["buoyant_weight_Pa"]
        ratio = np.divide(history["pressure_drop_Pa"], weight, out=np.full(len(t), np.nan), where=weight > 0)
        drop.plot(t, ratio, color="black", linestyle=line, linewidth=1, label=NAMES[model])
    for axes in (heights, drop):
        axes.axvspan(window["begin_s"], window["end_s"], color=PALE, alpha=0.3, linewidth=0, zorder=0)
        axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)
    heights.set_ylim(bottom=0)
    heights.set_ylabel(f"height ({unit})")
    drop.set_ylabel("pressure drop\nover weight")
    drop.set_xlabel("time (s)")
    return figure
