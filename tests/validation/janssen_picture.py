#!/usr/bin/python3
"""Draws what the test DemJanssen wrote: vertical stress against depth in a silo, and Janssen's exponential.

    build/tests/test_validation --gtest_filter='DemJanssen*' --gtest_output=xml:FILE
    tests/validation/janssen_picture.py FILE PICTURE
"""
import itertools
import math
import re
import sys
import xml.etree.ElementTree

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

WIDTH, DIAMETER = 8.0, 1e-3  # of the silo in diameters; m
SHOWN = 3  # columns
ROW = re.compile(r"height (\S+) m, weight (\S+) Pa, mu K (\S+),.*stress from the top, Pa: (.*)")


def columns(path):
    """Height in diameters, weight over the area, mu K, stresses below equal slices from the top."""
    for item in xml.etree.ElementTree.parse(path).iter("property"):
        if item.get("name").startswith("column of"):
            height, weight, ratio, stress = ROW.match(item.get("value")).groups()
            yield float(height) / DIAMETER, float(weight), float(ratio), [float(s) for s in stress.split()]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    figure, axes = plt.subplots(figsize=(5, 4.5), layout="constrained")
    for number, (height, weight, ratio, stress) in enumerate(itertools.islice(columns(sys.argv[1]), SHOWN)):
        colour, depth = f"C{number}", [height * (n + 1) / len(stress) for n in range(len(stress))]
        length = WIDTH / (2 * ratio)
        axes.plot(stress, depth, "o", ms=4, color=colour, label=f"column {number + 1}")
        axes.plot([weight * length / height * (1 - math.exp(-z / length)) for z in depth], depth, color=colour, lw=1,
                  label=f"Janssen, mu K = {ratio:.4f}")
    axes.plot([0, weight], [0, height], "k--", lw=1, label="without walls")
    axes.invert_yaxis()
    axes.set(xlabel="vertical stress, Pa", ylabel="depth, particle diameters")
    axes.legend(frameon=False, fontsize=8)
    figure.savefig(sys.argv[2], dpi=110)


main()
