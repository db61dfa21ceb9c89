"""The picture of a table of the solids stress: ratios over solids fraction with their standard errors, and of a wet table
what it makes of the pressure.

    python3 -m polybed.drawing.stress_table TABLE [-o PICTURE]

Exit codes are those of polybed: 0 done, 2 the command is wrong, 4 a file or a package is missing.
"""

import argparse
import sys
from pathlib import Path

from polybed.packages import needed

with needed(__name__ == "__main__"):
    import matplotlib.pyplot as plt
    import numpy as np

    from polybed.drawing.style import PALE, STYLE, colour
    from polybed.ending import made
    from polybed.files import FormatError, contents_of
    from polybed.plot import save
    from polybed.solids_table import AXES, read_table

RATIOS = (("p_ratio", "pressure"), ("mu_ratio", "viscosity"), ("gamma_ratio", "dissipation"))


def lines_of(table, name):
    """(label, values, errors) along phi at every point of the other axes."""
    values, errors = table[name], table[name + "_se"]
    axes = [(axis, table[axis]) for axis in AXES[1:]]
    for place in np.ndindex(values.shape[1:]):
        label = ", ".join(f"{axis} {knots[n]:g}" for (axis, knots), n in zip(axes, place) if len(knots) > 1)
        yield label, values[(slice(None), *place)], errors[(slice(None), *place)]


def draw_ratios(table, plots):
    """Draws the three ratios of a table of sheared particles into as many plots. Raises FormatError for another table."""
    if table.attributes["regime"] not in ("dry", "wet"):
        raise FormatError(f"{table.path}: of regime {table.attributes['regime']}, not of sheared particles")
    for plot, (name, title) in zip(plots, RATIOS):
        for n, (label, values, errors) in enumerate(lines_of(table, name)):
            plot.errorbar(table["phi"], values, errors, color=colour(n), marker="o", markersize=3,
                          linewidth=1, capsize=2, label=label or None)
        plot.axhline(1, color=PALE, linewidth=0.8, zorder=0)
        plot.set(title=f"{title} over {table.attributes['reference']}", xlabel="solids fraction")
        plot.set_ylim(bottom=0)
    if plots[0].get_legend_handles_labels()[1]:
        plots[0].legend()


def draw(path, picture):
    """Draws a table of sheared particles and returns the path of the picture."""
    table = read_table(path)
    with plt.rc_context(STYLE), contents_of(path):
        figure, plots = plt.subplots(1, len(RATIOS), figsize=(9, 3), layout="constrained", sharex=True)
        draw_ratios(table, plots)
        return save(figure, picture)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed.drawing.stress_table", description="Draws a table of the solids stress.")
    parser.add_argument("table", type=Path)
    parser.add_argument("-o", "--out", type=Path, help="default: beside the table")
    words = parser.parse_args(arguments)
    return made(lambda: [draw(words.table, words.out or words.table.with_suffix(".png"))])


if __name__ == "__main__":
    sys.exit(main())
