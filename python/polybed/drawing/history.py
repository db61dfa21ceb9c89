"""The run in time: heights, force balance, mixing, energies, contacts, steps; and the worst of every invariant against its limit."""

import textwrap

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing.curves import panels
from polybed.drawing.style import COLOURS, PALE, fitted, title_of


def draw_panel(axes, panel):
    """The curves of a panel; one that does not begin at 0 shows nearly all of its values, and 1 if they are about that."""
    factor = panel.scale[0]
    if not panel.zero and panel.unit == "1":
        axes.axhline(1, color=PALE, linewidth=0.8, zorder=0)
        known = np.concatenate([line.y[np.isfinite(line.y)] for line in panel.lines])
        low, high = np.quantile(known, [0.02, 0.98]) if len(known) else (1, 1)
        margin = 0.15 * max(high - low, 0.05)
        axes.set_ylim(min(low, 1) - margin, max(high, 1) + margin)
    for line in panel.lines:
        axes.plot(line.x, line.y * factor, label=line.label, linewidth=1.2 if line.number is not None else 1, **line.looks)
    if panel.logarithmic:
        axes.set_yscale("log")
    elif panel.zero:
        axes.set_ylim(bottom=0)
    axes.set_ylabel(textwrap.fill(panel.label, 16 if panel.height < 2 else 40))


def key(axes):
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)


def time_axis(axes, time):
    axes.set(xlim=(time[0], time[-1] if time[-1] > time[0] else time[0] + 1), xlabel="time (s)")


def draw_invariants(axes, run):
    """Worst value over limit on a logarithmic axis; a bar that ends before its mark at 1 has held."""
    entries = [i for i in run.record.get("invariants", []) if i["limit"] > 0]
    least, most = 1e-6, 10
    for n, entry in enumerate(entries):
        share = max(entry["worst"] / entry["limit"], least)
        axes.barh(n, share - least, left=least, height=0.4, color=COLOURS[0] if share <= 1 else COLOURS[1])
        axes.plot([1, 1], [n - 0.28, n + 0.28], color="black", linewidth=1.2)
        axes.text(least, n - 0.3, f"{entry['name']}: {entry['worst']:.1g} of {entry['limit']:.0e}", fontsize=8, va="bottom", ha="left")
    axes.set(xscale="log", xlim=(least, max([most] + [3 * i["worst"] / i["limit"] for i in entries])), yticks=[],
             ylim=(max(len(entries), 6) - 0.5, -0.8), xlabel="worst value of each invariant / its limit")
    axes.spines["left"].set_visible(False)


def draw(run, time=None):
    """The figure of the whole history; a line marks a time."""
    chosen = panels(run)
    if not chosen:
        raise FileNotFoundError(f"{run.directory} has no history yet")
    heights = [panel.height for panel in chosen]
    figure = plt.figure(figsize=(10.5, 1.2 + 1.15 * sum(heights)), constrained_layout=True)
    held = run.record.get("invariants") and len(chosen) > 1
    grid = figure.add_gridspec(len(chosen), 1 + bool(held), width_ratios=[2.2, 1] if held else [1], height_ratios=heights)
    first = None
    for n, panel in enumerate(chosen):
        axes = figure.add_subplot(grid[n, 0], sharex=first)
        first = first or axes
        draw_panel(axes, panel)
        if panel.keyed or (axes is first and not held):
            key(axes)
        if time is not None:
            axes.axvline(time, color=PALE, linewidth=0.8, zorder=0)
        axes.tick_params(labelbottom=n == len(chosen) - 1)
    time_axis(axes, run.history["time_s"])
    if held:
        side = figure.add_subplot(grid[0, 1])
        side.set_axis_off()
        side.legend(*first.get_legend_handles_labels(), loc="center left", fontsize=9)
        draw_invariants(figure.add_subplot(grid[1:, 1]), run)
    figure.suptitle(fitted(title_of(run), figure, 10), fontsize=10)
    return figure
