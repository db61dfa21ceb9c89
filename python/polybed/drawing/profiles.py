"""Lateral means on the vertical axis: at one time side by side, and of each species over height and time."""

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing.curves import profile_kinds, profile_panel
from polybed.drawing.style import EMPTY, FEW_SOLIDS, GREY, PALE, fitted, length_unit, levels, title_of
from polybed.read import nearest


def value_at(run, column, time):
    """A column of the history at the time nearest; None where it has no value."""
    history = run.history
    if column not in history or len(history["time_s"]) == 0:
        return None
    value = history[column][nearest(history["time_s"], time)]
    return None if np.isnan(value) else value


def mark_levels(axes, run, time, factor, named):
    for column, name, line in levels(run.history):
        if (level := value_at(run, column, time)) is not None:
            axes.axhline(level * factor, color=GREY, linestyle=line, linewidth=1, zorder=0, label=name if named else None)


def draw_kind(axes, run, row, kind, factor):
    """One kind of profile at a stored time over height."""
    panel, profiles = profile_panel(run, kind, row), run.profiles
    for line in panel.lines:
        looks = {"color": "black" if kind != "phi" else GREY, "linestyle": (0, (3, 1)) if kind == "u" else "-", "linewidth": 1}
        axes.plot(line.x * panel.scale[0], line.y * factor, label=line.label, **(looks if line.number is None else line.looks))
    axes.set_xlabel(panel.label)
    left, right = axes.get_xlim()
    if kind == "phi":
        axes.set_xlim(0, 1)
    elif kind == "theta":
        axes.set_xlim(0, max(1e-3, right))  # of particles that move as one there is only rounding
    elif kind == "u":
        axes.axvline(0, color=PALE, linewidth=0.8, zorder=0)
        most = max(1e-3, 1.1 * max(-left, right))
        axes.set_xlim(-most, most)
    else:
        weight = value_at(run, "buoyant_weight_Pa", profiles["time_s"][row])
        if weight is not None:
            axes.axvline(weight * panel.scale[0], color=GREY, linestyle="-.", linewidth=1, label="buoyant weight")
        axes.set_xlim(left=min(0, left))


def edges(centres):
    """Ends of intervals around centres, for a map of rows stored at times that need not be even."""
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    middle = (centres[1:] + centres[:-1]) / 2
    return np.concatenate([[centres[0]], middle, [centres[-1]]])


def draw_in_time(axes, run, name, most, factor, time):
    """Volume fraction of a species over time and height, with the levels in the bed."""
    profiles, history = run.profiles, run.history
    y = profiles["y_m"]
    half = (y[1] - y[0]) / 2 if len(y) > 1 else y[0]
    faces = np.append(y - half, y[-1] + half) * factor
    axes.set_facecolor(EMPTY)
    mesh = axes.pcolormesh(edges(profiles["time_s"]), faces, profiles[f"phi_{name}"].T, cmap="viridis", vmin=0, vmax=most, rasterized=True)
    for column, _, line in levels(history):
        axes.plot(history["time_s"], history[column] * factor, color="white", linestyle=line, linewidth=1)
    axes.axvline(time, color="white", linewidth=0.6)
    axes.set(title=f"{name}: solids fraction in time", xlabel="time (s)")
    return mesh


def shown_top(run):
    """Top of the profiles, m: a fifth above the highest mean fraction worth showing at any time."""
    profiles = run.profiles
    solids = sum(profiles[f"phi_{name}"] for name in run.species)
    rows = np.flatnonzero((np.atleast_2d(solids) > FEW_SOLIDS).any(axis=0))
    y = profiles["y_m"]
    return min(1.2 * y[rows[-1]], y[-1]) if len(rows) else y[-1]


def draw(run, time):
    """The figure of the profiles stored nearest to a time, above what came before and after."""
    profiles = run.profiles
    if not profiles or len(profiles["time_s"]) == 0:
        raise FileNotFoundError(f"{run.directory} has no stored profiles yet")
    factor, unit = length_unit(run)
    row = nearest(profiles["time_s"], time)
    shown = [name for name in run.species if f"phi_{name}" in profiles]
    figure = plt.figure(figsize=(10, 7.4), constrained_layout=True)
    upper, lower = figure.subfigures(2, 1, height_ratios=[1.15, 1])
    grid = upper.add_gridspec(1, 4, width_ratios=[1, 1, 1, 0.42])
    first = upper.add_subplot(grid[0])
    axes = [first, *(upper.add_subplot(grid[n], sharey=first) for n in (1, 2))]
    time = profiles["time_s"][row]
    for ax, kind in zip(axes, profile_kinds(run)):
        draw_kind(ax, run, row, kind, factor)
        mark_levels(ax, run, time, factor, named=ax is axes[0])
    heights = {"ylabel": f"height y ({unit})", "ylim": (0, shown_top(run) * factor)}
    axes[0].set(**heights)
    for ax in axes[1:]:
        ax.tick_params(labelleft=False)
    side = upper.add_subplot(grid[3])
    side.set_axis_off()
    lines = {label: line for ax in axes for line, label in zip(*ax.get_legend_handles_labels())}
    side.legend(lines.values(), lines.keys(), loc="center left")
    most = max(0.1, max(float(profiles[f"phi_{name}"].max()) for name in shown))
    below = lower.subplots(1, len(shown), sharey=True, squeeze=False)[0]
    for ax, name in zip(below, shown):
        mesh = draw_in_time(ax, run, name, most, factor, time)
    below[0].set(**heights)
    lower.colorbar(mesh, ax=list(below), pad=0.01).set_label("solids fraction")
    figure.suptitle(fitted(title_of(run, time) + "   lateral means", figure, 10), fontsize=10)
    return figure
