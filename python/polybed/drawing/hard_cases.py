"""The matrix of hard cases as a map: one row per case, one column per scheme, colour by how near to a limit it came."""

import math

from polybed.drawing.style import EMPTY, GREY, STYLE  # which chooses matplotlib's way of drawing

import matplotlib.pyplot as plt
from matplotlib.colors import TwoSlopeNorm
from matplotlib.patches import Rectangle

COLUMNS = ("implicit/limited", "explicit/limited", "explicit/upwind", "other schemes", "textbook")
LEAST, MOST = -4.0, 4.0  # log10 of value over limit, beyond which the colour stays
WORST_FIRST = ("FAIL", "REFUSED", "DEGRADED", "PASS")


def column_of(cell):
    if cell["naive"]:
        return COLUMNS.index("textbook")
    return COLUMNS.index(cell["scheme"]) if cell["scheme"] in COLUMNS[:3] else COLUMNS.index("other schemes")


def share(cell):
    """log10 of the furthest invariant over its limit, cut off at both ends."""
    value, limit = cell["worst"]["value"], cell["worst"]["limit"]
    if value <= 0:
        return LEAST
    return MOST if limit <= 0 else min(max(math.log10(value / limit), LEAST), MOST)


def worst(cells):
    """The cell that stands for several in one place."""
    return min(cells, key=lambda cell: (WORST_FIRST.index(cell["outcome"]), -share(cell)))


def draw_cell(axes, cell, x, y, colour):
    axes.add_patch(Rectangle((x, y), 1, 1, facecolor=colour, edgecolor="white", linewidth=1))
    if cell["outcome"] == "REFUSED":
        axes.add_patch(Rectangle((x, y), 1, 1, fill=False, hatch="////", edgecolor=GREY, linewidth=0))
    if cell["outcome"] == "FAIL":
        axes.plot([x + 0.35, x + 0.65], [y + 0.2, y + 0.8], color="black", linewidth=1)
        axes.plot([x + 0.35, x + 0.65], [y + 0.8, y + 0.2], color="black", linewidth=1)
    if not cell["as_expected"]:
        axes.add_patch(Rectangle((x + 0.03, y + 0.06), 0.94, 0.88, fill=False, edgecolor="black", linewidth=1.5))


def draw(matrix):
    """The figure of a parsed stability.json."""
    names = list(dict.fromkeys(cell["case"] for cell in matrix["cells"]))
    places = {}
    for cell in matrix["cells"]:
        places.setdefault((names.index(cell["case"]), column_of(cell)), []).append(cell)
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(7, 1.6 + 0.19 * len(names)), layout="constrained")
        norm, colours = TwoSlopeNorm(0, LEAST, MOST), plt.get_cmap("RdYlBu_r")
        for row in range(len(names)):
            for column in range(len(COLUMNS)):
                cells = places.get((row, column))
                if cells:
                    cell = worst(cells)
                    draw_cell(axes, cell, column, row, colours(norm(share(cell))))
                else:
                    axes.add_patch(Rectangle((column, row), 1, 1, facecolor=EMPTY, edgecolor="white", linewidth=1))
        axes.set(xlim=(0, len(COLUMNS)), ylim=(len(names), 0))
        axes.set_xticks([n + 0.5 for n in range(len(COLUMNS))], COLUMNS)
        axes.set_yticks([n + 0.5 for n in range(len(names))], names, fontsize=7)
        axes.tick_params(length=0)
        axes.spines[:].set_visible(False)
        axes.set_title(f"hard cases, suite {matrix['suite']}, {matrix['date']}, {matrix['git_commit'][:10]}\n"
                       "hatched: refused with a reason; cross: failed; frame: not as expected")
        figure.colorbar(plt.cm.ScalarMappable(norm, colours), ax=axes, shrink=0.5, label="log10 of the worst value over its limit")
    return figure
