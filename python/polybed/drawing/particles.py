"""The particles seen from the front: circles to scale, those behind drawn first, by species and by speed."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D

from polybed.drawing.maps import BARS, GAP, HEAD, HEIGHT, LEFT, RIGHT, axes_at, draw_scale, frame, map_size
from polybed.drawing.style import colour, fitted, length_unit, title_of
from polybed.texts import fitting

MOST = 50_000  # circles in a picture; more take long and hide each other
EDGE = 1.5  # points, the radius from which a circle has an outline


def shown_top(run, steps):
    """Top of the views, m: a fifth above the highest particle, at least a quarter of the width, never above the column."""
    height = run.size[1]
    tops = [np.max(step.position[:, 1] + step.radius) for step in map(run.particles.__getitem__, steps) if len(step)]
    return min(max(1.2 * max(tops), 0.25 * run.size[0]), height) if tops and max(tops) > 0 else height


def front(step, most=MOST):
    """Numbers of the particles to draw, those behind first: all, or as many as allowed with the greatest z."""
    order = np.argsort(step.position[:, 2], kind="stable")
    return order[-most:] if most < len(order) else order


def thinned(run, step, most=MOST):
    """What a picture says where it does not show all particles; empty where it does."""
    if len(step) <= most:
        return ""
    factor, unit = length_unit(run)
    depth = run.particles.size[2] - step.position[front(step, most)[0], 2]
    return f"{most:,} of {len(step):,} particles: those within {depth * factor:.2g} {unit} of the front".replace(",", " ")


def images(run, x, radius):
    """Where sides are joined, shifts along x that show the rest of the particles that the sides cut: (number, m)."""
    width = run.size[0]
    if not run.particles.periodic[0]:
        return np.arange(len(x)), np.zeros(len(x))
    left, right = np.flatnonzero(x - radius < 0), np.flatnonzero(x + radius > width)
    number = np.concatenate([np.arange(len(x)), left, right])
    order = np.argsort(number, kind="stable")  # an image is drawn with its particle, or it would lie in front of all
    return number[order], np.repeat([0, width, -width], [len(x), len(left), len(right)])[order]


def circles(axes, run, step, colours, most=MOST):
    """Adds the particles of a step to axes of `frame`. colours: of each particle, as colours or as numbers in 0..1."""
    factor = length_unit(run)[0]
    chosen = front(step, most)
    number, shift = images(run, step.position[chosen, 0], step.radius[chosen])
    chosen = chosen[number]
    place = step.position[chosen, :2] * factor
    place[:, 0] += shift * factor
    size = 2 * step.radius[chosen] * factor
    points = axes.get_window_extent().width / axes.figure.dpi * 72 / (run.size[0] * factor)  # per unit of length
    large = len(size) > 0 and np.median(size) / 2 * points > EDGE
    drawn = EllipseCollection(size, size, np.zeros(len(size)), units="xy", offsets=place, transOffset=axes.transData,
                              facecolors=colours[chosen], edgecolors="white" if large else "none", linewidths=0.25)
    drawn.set_rasterized(True)
    axes.add_collection(drawn, autolim=False)
    return drawn


def species_colours(run, step):
    return np.array([colour(n) for n, classes in enumerate(run.kinds.values()) for _ in classes])[step.species]


def speed(step):
    """The speed of each particle, mm/s."""
    return np.sqrt((step.velocity**2).sum(axis=1)) * 1e3


def fastest(steps):
    """Upper end of the scale of speeds, mm/s, two digits, and whether some exceed it: the fastest 1 % of a step can."""
    ends = [(float(np.quantile(values, 0.99)), float(values.max())) for values in (speed(s) for s in steps if len(s))]
    most = max([1e-3] + [end for end, _ in ends])
    digit = 10.0 ** (np.floor(np.log10(most)) - 1)
    end = float(f"{np.ceil(most / digit - 1e-9) * digit:.3g}")
    return end, any(greatest > end * (1 + 1e-9) for _, greatest in ends)


def name_species(axes, run):
    dots = [Line2D([], [], linestyle="", marker="o", color=colour(n), label=name) for n, name in enumerate(run.kinds)]
    columns = 1 if max(map(len, run.kinds)) > 10 else 3
    axes.legend(handles=dots, loc="upper center", bbox_to_anchor=(0.5, 1.5), ncol=columns, fontsize=8, handletextpad=0.2,
                columnspacing=1, borderaxespad=0)
    axes.set_axis_off()


def speed_bar(axes, end, beyond):
    factor, unit = fitting("m/s", end / 1e3)
    ticks, mapped = [0, end / 2, end], plt.cm.ScalarMappable(Normalize(0, end), "viridis")
    labels = [f"{value / 1e3 * factor:.3g}" for value in ticks]
    draw_scale(axes, mapped, ticks, labels, f"speed ({unit})", extend="max" if beyond else "neither")


class Views:
    """Two views, by species and by speed, whose particles can be exchanged for another step. axes: of both, above those of keys"""

    def __init__(self, run, steps, axes, keys, top):
        self.run, self.axes, self.drawn, self.figure, self.title = run, axes, [], axes[0].figure, None
        self.end, beyond = fastest(run.particles[n] for n in steps)
        for n, title in enumerate(("species", "speed")):
            frame(axes[n], run, title, top, first=n == 0)
        name_species(keys[0], run)
        speed_bar(keys[1], self.end, beyond)
        self.note = self.figure.text(0.5, 1 - 0.36 / self.figure.get_figheight(), "", ha="center", va="top", fontsize=7)

    def show(self, number, digits=".4g"):
        """Draws the particles of a step in place of those before."""
        for collection in self.drawn:
            collection.remove()
        step = self.run.particles[number]
        colours = species_colours(self.run, step), plt.get_cmap("viridis")(np.clip(speed(step) / self.end, 0, 1))
        self.drawn = [circles(axes, self.run, step, of) for axes, of in zip(self.axes, colours)]
        self.note.set_text(thinned(self.run, step))
        if self.title:
            self.title.set_text(fitted(title_of(self.run, step.time, digits=digits), self.figure, 10))


def views_of(run, steps):
    """Both views in a figure of their own, with a title."""
    top = shown_top(run, steps)
    width, height = map_size(run, top, HEIGHT)
    across = max(LEFT + 2 * width + GAP + RIGHT, 4.2)
    start = (across - 2 * width - GAP) / 2 if across == 4.2 else LEFT
    figure = plt.figure(figsize=(across, HEAD + height + BARS))
    axes, keys = ([axes_at(figure, start + n * (width + GAP), base, width, tall) for n in (0, 1)]
                  for base, tall in ((BARS, height), (BARS - 0.6, 0.1)))
    views = Views(run, steps, axes, keys, top)
    views.title = figure.suptitle("", y=1 - 0.16 / figure.get_figheight(), fontsize=10)
    return views


def draw(run, step):
    views = views_of(run, [step])
    views.show(step)
    return views.figure
