"""picture.png of a run, the one that a run draws at its end: maps, profiles and history in one."""

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing import particles
from polybed.drawing.curves import heights, profile_panel
from polybed.drawing.maps import axes_at, draw_map, draw_scale, fractions, map_size, thin_apart, voidages
from polybed.drawing.history import draw_panel, key, time_axis
from polybed.drawing.style import PALE, fitted, length_unit, shown_height, title_of
from polybed.read import nearest

MAP_HEIGHT = 5.2  # inches
MAP_WIDTHS = (0.9, 3.4)  # inches, least and most
LEFT, GAP, PROFILE, RIGHT, HEAD, BARS, HISTORY, LEGEND = 0.75, 0.45, 2.0, 0.25, 0.75, 0.95, 1.9, 1.9  # inches
SUSPENDED = 1.2  # times the top of the dense bed: above that the card, too, shows both heights


def draw_profiles(axes, run, time):
    """Lateral averages against height, at the stored time nearest to the time of the maps; the history names the colours."""
    profiles = run.profiles
    if not profiles or len(profiles["time_s"]) == 0:
        axes.set_axis_off()
        return
    for line in profile_panel(run, "phi", nearest(profiles["time_s"], time)).lines:
        axes.plot(line.x, line.y * length_unit(run)[0], **line.looks | ({"linestyle": ":", "linewidth": 1} if line.number is None else {}))
    axes.set(xlim=(0, 1), title="lateral mean", xlabel="volume fraction (dotted: voidage)" if "voidage" in profiles else "volume fraction")
    axes.tick_params(labelleft=False)


def draw_history(axes, run, time):
    history = run.history
    if not len(history.get("time_s", ())):
        axes.set_axis_off()
        return
    bed = history.get("bed_height_m", np.empty(0))
    suspended = (bed > SUSPENDED * history.get("dense_height_m", bed)).any()
    for panel in heights(run, ("bed_height_m", "dense_height_m") if suspended else ("bed_height_m",)):
        draw_panel(axes, panel)
        key(axes)
    axes.axvline(time, color=PALE, linewidth=0.8, zorder=0)
    time_axis(axes, history["time_s"])


def layout_of(count, size):
    """A figure with so many maps of a size in inches: the figure, maps, their colour bars, profiles next to the maps, history below."""
    width, height = size
    row = LEFT + count * (width + GAP) + PROFILE + RIGHT
    across = max(row, 7.0)
    figure = plt.figure(figsize=(across, HEAD + height + BARS + HISTORY))
    *places, last = (LEFT + (across - row) / 2 + n * (width + GAP) for n in range(count + 1))
    base = HISTORY + BARS
    maps = [axes_at(figure, left, base, width, height) for left in places]
    bars = [axes_at(figure, left, base - 0.62, width, 0.1) for left in places]
    profile = axes_at(figure, last, base, PROFILE, height)
    return figure, maps, bars, profile, axes_at(figure, LEFT, 0.5, across - LEFT - LEGEND, HISTORY - 0.75)


def draw_fields(run, step, maps, bars, top):
    """Volume fractions of the species and of the fluid."""
    groups = (*thin_apart(fractions(run, step, classes=False)), voidages(run, step))
    for n, (group, name, values) in enumerate((group, *entry) for group in groups for entry in group.maps):
        mesh = draw_map(maps[n], run, group, name, values, top, first=n == 0)
        draw_scale(bars[n], mesh, group.limits, [f"{limit:.2g}" for limit in group.limits], group.label, fontsize=8, labelpad=1)


def draw(run, step):
    """The figure of a run at a stored step: of particles where there are some, else of fields."""
    of_particles = len(run.particles) > 0
    time = (run.particles if of_particles else run).time[step]
    top = particles.shown_top(run, [step]) if of_particles else shown_height(run, [step])
    size = map_size(run, top, MAP_HEIGHT, MAP_WIDTHS)
    figure, maps, bars, profile, history = layout_of(2 if of_particles else len(run.kinds) + 1, size)
    if of_particles:
        particles.Views(run, [step], maps, bars, top).show(step)
    else:
        draw_fields(run, step, maps, bars, top)
    draw_profiles(profile, run, time)
    profile.set_ylim(0, top * length_unit(run)[0])
    draw_history(history, run, time)
    figure.suptitle(fitted(title_of(run, time, maps=not of_particles), figure, 11), y=1 - 0.22 / figure.get_figheight(), fontsize=11)
    return figure
