"""The matrix of hard cases as a map: a row for each case, a column for each scheme, the colour by how near to a limit it came."""

import math

from polybed.drawing.style import EMPTY, GREY  # which chooses matplotlib's way of drawing

import matplotlib.pyplot as plt
from matplotlib.colors import TwoSlopeNorm
from matplotlib.patches import Rectangle

SCHEMES = ("implicit/limited", "imex/limited", "explicit/limited", "explicit/upwind")
COLUMNS = ("implicit", "imex", "explicit", "explicit, upwind", "textbook")
LEAST, MOST = -4.0, 4.0  # log10 of value over limit, beyond which the colour stays
WORST_FIRST = ("FAIL", "REFUSED", "DEGRADED", "PASS")
STACKS = 3  # of rows side by side, so that the picture fits a screen


def place_of(cell):
    """(first column, number of columns): each scheme of the two-fluid model has one column, a case without a choice of schemes has all."""
    if cell["naive"]:
        return len(SCHEMES), 1
    return (SCHEMES.index(cell["scheme"]), 1) if cell["scheme"] in SCHEMES else (0, len(SCHEMES))


def share(cell):
    """log10 of the furthest invariant over its limit, cut off at both ends."""
    value, limit = cell["worst"]["value"], cell["worst"]["limit"]
    if value <= 0:
        return LEAST
    return MOST if limit <= 0 else min(max(math.log10(value / limit), LEAST), MOST)


def worst(cells):
    """The cell that stands for several in one place."""
    return min(cells, key=lambda cell: (WORST_FIRST.index(cell["outcome"]), -share(cell)))


def draw_cell(axes, cell, place, row, colour):
    x, width = place
    axes.add_patch(Rectangle((x, row), width, 1, facecolor=colour, edgecolor="white", linewidth=1))
    if cell["outcome"] == "REFUSED":
        axes.add_patch(Rectangle((x, row), width, 1, fill=False, hatch="////", edgecolor=GREY, linewidth=0))
    if cell["outcome"] == "FAIL":
        middle = x + width / 2
        axes.plot([middle - 0.15, middle + 0.15], [row + 0.2, row + 0.8], color="black", linewidth=1)
        axes.plot([middle - 0.15, middle + 0.15], [row + 0.8, row + 0.2], color="black", linewidth=1)
    if not cell["as_expected"]:
        axes.add_patch(Rectangle((x + 0.03, row + 0.06), width - 0.06, 0.88, fill=False, edgecolor="black", linewidth=1.5))


def draw_stack(axes, cases, rows, colour_of):
    """Some of the cases below each other. rows: number of rows of the axes, so that all stacks have rows of one height"""
    for row, (_, cells) in enumerate(cases):
        for column in range(len(COLUMNS)):
            axes.add_patch(Rectangle((column, row), 1, 1, facecolor=EMPTY, edgecolor="white", linewidth=1))
        for place in sorted({place_of(cell) for cell in cells}, key=lambda place: -place[1]):
            cell = worst([cell for cell in cells if place_of(cell) == place])
            draw_cell(axes, cell, place, row, colour_of(share(cell)))
    axes.set(xlim=(0, len(COLUMNS)), ylim=(rows, 0))
    axes.xaxis.tick_top()
    axes.set_xticks([n + 0.5 for n in range(len(COLUMNS))], COLUMNS, fontsize=7, rotation=30, ha="left", rotation_mode="anchor")
    axes.set_yticks([n + 0.5 for n in range(len(cases))], [f"{cells[0]['title']}  {name}" for name, cells in cases], fontsize=6.5)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)


def draw(matrix, _folder=None):
    cases = {}
    for cell in matrix["cells"]:
        cases.setdefault(cell["case"], []).append(cell)
    cases, norm, colours = list(cases.items()), TwoSlopeNorm(0, LEAST, MOST), plt.get_cmap("RdYlBu_r")
    rows = math.ceil(len(cases) / STACKS)
    figure, stacks = plt.subplots(1, STACKS, figsize=(13.5, 1.6 + 0.17 * rows), layout="constrained")
    for n, axes in enumerate(stacks):
        draw_stack(axes, cases[n * rows:(n + 1) * rows], rows, lambda value: colours(norm(value)))
        axes.set_visible(n * rows < len(cases))
    figure.suptitle(f"hard cases, suite {matrix['suite']}, {matrix['date']}, {matrix['git_commit'][:10]}; "
                    "hatched: refused with a reason; cross: failed; frame: not as expected", fontsize=9)
    figure.colorbar(plt.cm.ScalarMappable(norm, colours), ax=stacks, shrink=0.4, aspect=60, location="bottom", pad=0.01,
                    label="log10 of the worst value over its limit")
    return figure
