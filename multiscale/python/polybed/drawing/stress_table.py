"""The picture of a table of the solids stress: ratios over solids fraction with their standard errors, and of a wet table
what it makes of the pressure. Usage: python3 -m polybed.drawing.stress_table TABLE [-o PICTURE]
"""

import argparse
import pathlib

import h5py
import matplotlib.pyplot as plt
import numpy as np

from .style import COLOURS, STYLE

RATIOS = (("p_ratio", "pressure"), ("mu_ratio", "viscosity"), ("gamma_ratio", "dissipation"))


def lines_of(table, name):
    """(label, values, errors) along phi at every point of the other axes."""
    values, errors = table[name][:], table[name + "_se"][:]
    axes = [(axis, table[axis][:]) for axis in ("stokes", "e", "mu_p", "x2")]
    for place in np.ndindex(values.shape[1:]):
        label = ", ".join(f"{axis} {knots[n]:g}" for (axis, knots), n in zip(axes, place) if len(knots) > 1)
        yield label, values[(slice(None), *place)], errors[(slice(None), *place)]


def draw(path, picture):
    """Draws a table of sheared particles."""
    with plt.rc_context(STYLE), h5py.File(path) as table:
        if table.attrs["regime"] not in ("dry", "wet"):
            raise SystemExit(f"{path}: of regime {table.attrs['regime']}, not of sheared particles")
        figure, plots = plt.subplots(1, len(RATIOS), figsize=(9, 3), layout="constrained", sharex=True)
        for plot, (name, title) in zip(plots, RATIOS):
            for n, (label, values, errors) in enumerate(lines_of(table, name)):
                plot.errorbar(table["phi"][:], values, errors, color=COLOURS[n % len(COLOURS)], marker="o", markersize=3,
                              linewidth=1, capsize=2, label=label or None)
            plot.axhline(1, color="#bbbbbb", linewidth=0.8, zorder=0)
            plot.set_title(f"{title} over {table.attrs['reference']}")
            plot.set_xlabel("solids fraction")
            plot.set_ylim(bottom=0)
        if plots[0].get_legend_handles_labels()[1]:
            plots[0].legend()
        figure.savefig(picture)
        plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("table", type=pathlib.Path)
    parser.add_argument("-o", "--out", type=pathlib.Path, help="default: beside the table")
    words = parser.parse_args()
    picture = words.out or words.table.with_suffix(".png")
    draw(words.table, picture)
    print(picture)


if __name__ == "__main__":
    main()
