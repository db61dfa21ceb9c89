#!/usr/bin/python3
"""Draws picture.png of a run: maps of the volume fractions and the voidage, their profiles, the run in time.

    python3 -m polybed.plot RUN [--time T] [--output FILE]
"""

import argparse
import os
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from polybed.read import FormatError, read

COLOURS = ["#0b6fa4", "#d1622b", "#3a8f4d", "#8a4fa3", "#8c6d1f", "#c03a5b"]
FLUID_COLOUR = "#555555"
MAP_HEIGHT = 5.2  # inches
MAP_WIDTHS = (0.9, 3.4)  # inches, least and most
STYLE = {
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "axes.grid": False,
}


def in_plane(field):
    """A field as [y][x]: of a 3-D run the plane at half depth."""
    return field[field.shape[0] // 2] if field.ndim == 3 else field


def shown_height(run, maps):
    """Top of the picture, m: a fifth above the highest solids (1 % by volume), so that a bed in a tall column is
    not a strip at the bottom; never above the column."""
    faces = run.faces["y"]
    rows = np.flatnonzero(sum(maps).max(axis=1) > 0.01) if maps else []
    top = faces[rows[-1] + 1] if len(rows) else faces[-1]
    return min(1.2 * top, faces[-1])


def draw_map(axes, run, values, title, colours, limits):
    """One map in millimetres with its colour bar below."""
    mesh = axes.pcolormesh(
        run.faces["x"] * 1e3, run.faces["y"] * 1e3, values, cmap=colours, vmin=limits[0], vmax=limits[1], rasterized=True
    )
    axes.set_aspect("equal")
    axes.set_title(title)
    width = run.faces["x"][-1] * 1e3
    axes.set_xticks([0, width], ["0", f"{width:g}"])
    axes.set_xlabel("x (mm)")
    for side in ("top", "right"):
        axes.spines[side].set_visible(True)
    return mesh


def draw_profiles(axes, run, time, legend):
    """Lateral averages against height, at the stored time nearest to that of the maps. Without its legend the
    colours are told by that of the history."""
    profiles = run.profiles
    if not profiles or len(profiles["time_s"]) == 0:
        axes.set_axis_off()
        return
    row = int(np.argmin(np.abs(profiles["time_s"] - time)))
    height = profiles["y_m"] * 1e3
    for n, name in enumerate(run.species):
        if f"phi_{name}" in profiles:
            axes.plot(profiles[f"phi_{name}"][row], height, color=COLOURS[n % len(COLOURS)], label=name)
    if "voidage" in profiles:
        axes.plot(profiles["voidage"][row], height, color=FLUID_COLOUR, linestyle="--", linewidth=1, label="voidage")
    axes.set_xlim(0, 1)
    axes.set_title("lateral mean")
    axes.set_xlabel("volume fraction")
    axes.tick_params(labelleft=False)
    if legend:
        axes.legend(loc="upper center", fontsize=8, handlelength=1.4)


def draw_history(axes, run, time):
    """Centres of mass and the bed's height in time."""
    history = run.history
    if not history or len(history["time_s"]) == 0:
        axes.set_axis_off()
        return
    t = history["time_s"]
    for n, name in enumerate(run.species):
        column = history.get(f"centre_{name}_m")
        if column is not None:
            axes.plot(t, column * 1e3, color=COLOURS[n % len(COLOURS)], label=f"centre of {name}")
    if "bed_height_m" in history:
        axes.plot(t, history["bed_height_m"] * 1e3, color=FLUID_COLOUR, linestyle="--", linewidth=1, label="bed height")
    axes.axvline(time, color="#bbbbbb", linewidth=0.8, zorder=0)
    axes.set_xlim(t[0], t[-1] if t[-1] > t[0] else t[0] + 1)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("height (mm)")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)


def title_of(run, time):
    """What the picture shows, in a line."""
    model = {"tfm": "two-fluid model", "dem": "discrete particles"}.get(run.record.get("model"), "")
    parts = [run.directory.resolve().name, model, f"t = {time:.4g} s"]
    if run.dimensions == 3:
        parts.append("plane at half depth")
    return "   ".join(part for part in parts if part)


class Layout:
    """Where everything stands, in inches: maps and profiles in a row, colour bars below them, the history last."""

    LEFT, GAP, PROFILE, RIGHT, HEAD, BARS, HISTORY, LEGEND = 0.75, 0.45, 2.0, 0.25, 0.75, 0.95, 1.9, 1.9

    def __init__(self, maps, width_over_height):
        self.map_width = float(np.clip(MAP_HEIGHT * width_over_height, *MAP_WIDTHS))
        self.map_height = min(MAP_HEIGHT, self.map_width / width_over_height)
        self.maps = maps
        row = self.LEFT + maps * (self.map_width + self.GAP) + self.PROFILE + self.RIGHT
        self.width = max(row, 7.0)
        self.height = self.HEAD + self.map_height + self.BARS + self.HISTORY
        self._start = self.LEFT + (self.width - row) / 2
        self._base = self.HISTORY + self.BARS
        self.figure = plt.figure(figsize=(self.width, self.height), dpi=160)

    def _axes(self, x, y, width, height):
        return self.figure.add_axes((x / self.width, y / self.height, width / self.width, height / self.height))

    def _left(self, n):
        return self._start + n * (self.map_width + self.GAP)

    def map(self, n):
        return self._axes(self._left(n), self._base, self.map_width, self.map_height)

    def bar(self, n):
        return self._axes(self._left(n), self._base - 0.62, self.map_width, 0.1)

    def profile(self):
        return self._axes(self._left(self.maps), self._base, self.PROFILE, self.map_height)

    def history(self):
        return self._axes(self.LEFT, 0.5, self.width - self.LEFT - self.LEGEND, self.HISTORY - 0.75)


def panels(run, step):
    """Title, values, colours and limits of each map: the species on one scale, then the voidage."""
    fractions = [in_plane(run.field(f"phi_{name}")[step]) for name in run.species]
    voidage = in_plane(run.field("voidage")[step])
    largest = max([0.1] + [float(values.max()) for values in fractions])
    maps = [(f"$\\phi$ {name}", values, "viridis", (0, largest)) for name, values in zip(run.species, fractions)]
    least = float(np.floor(voidage.min() * 10) / 10)
    return [*maps, ("voidage $\\varepsilon$", voidage, "cividis", (min(least, 0.9), 1))]


def draw(run, step):
    """The figure of a run at a stored step."""
    time = run.time[step]
    maps = panels(run, step)
    top = shown_height(run, [values for _, values, _, _ in maps[:-1]])
    layout = Layout(len(maps), run.faces["x"][-1] / top)
    for n, (label, values, colours, limits) in enumerate(maps):
        axes = layout.map(n)
        mesh = draw_map(axes, run, values, label, colours, limits)
        axes.set_ylim(0, top * 1e3)
        if n == 0:
            axes.set_ylabel("y (mm)")
        else:
            axes.tick_params(labelleft=False)
        bar = layout.figure.colorbar(mesh, cax=layout.bar(n), orientation="horizontal")
        bar.set_ticks(limits, labels=[f"{limit:.2g}" for limit in limits])
        bar.outline.set_linewidth(0.5)
    profile = layout.profile()
    draw_profiles(profile, run, time, legend=layout.map_height > 2.5)
    profile.set_ylim(0, top * 1e3)
    draw_history(layout.history(), run, time)
    layout.figure.suptitle(title_of(run, time), y=1 - 0.22 / layout.height, fontsize=11)
    return layout.figure


def picture(directory, time=None, output=None):
    """Draws a run at a time (the last one if None), puts the PNG in place whole and returns its path."""
    run = read(directory)
    if len(run.time) == 0:
        raise FileNotFoundError(f"{directory} has no stored fields yet")
    step = len(run.time) - 1 if time is None else run.step_at(time)
    path = Path(output) if output else run.directory / "picture.png"
    with plt.rc_context(STYLE):
        figure = draw(run, step)
        temporary = path.with_name(path.name + ".temporary")
        figure.savefig(temporary, format="png")
        plt.close(figure)
    os.replace(temporary, path)
    return path


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed plot", description="Draws a finished or a running run.")
    parser.add_argument("run", help="run directory")
    parser.add_argument("--time", type=float, help="s; the stored time nearest to it (default: the last)")
    parser.add_argument("-o", "--output", help="PNG file (default: RUN/picture.png)")
    options = parser.parse_args(arguments)
    try:
        print(picture(options.run, options.time, options.output))
    except (FormatError, OSError, KeyError, IndexError) as error:
        print(error, file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main())
