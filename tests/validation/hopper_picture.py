#!/usr/bin/python3
"""Draws what the test DemHopper wrote: spheres that leave a flat hopper in a second against its opening, and Beverloo's power.

    build/tests/test_validation --gtest_filter='DemHopper*' --gtest_output=xml:FILE
    tests/validation/hopper_picture.py FILE PICTURE
"""
import math
import sys
import xml.etree.ElementTree

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

EMPTY = 1.4  # of the opening, in diameters, that nothing flows through


def rates(path):
    """Opening in diameters, particles per second, its standard error."""
    for item in xml.etree.ElementTree.parse(path).iter("property"):
        if item.get("name").startswith("opening in diameters"):
            return [tuple(map(float, point.split())) for point in item.get("value").split(";") if point.strip()]
    sys.exit(f"{path} has no rates")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    opening, rate, error = zip(*rates(sys.argv[1]))
    figure, axes = plt.subplots(figsize=(5, 3.6), layout="constrained")
    free = [d - EMPTY for d in opening]
    axes.errorbar(free, rate, [2 * e for e in error], fmt="o", ms=5, color="C0", label="polybed, two standard errors")
    factor = math.exp(sum(math.log(r / f**2.5) for r, f in zip(rate, free)) / len(rate))
    line = [0.95 * free[0], 1.05 * free[-1]]
    axes.plot(line, [factor * f**2.5 for f in line], "k--", lw=1, label="power 2.5")
    axes.set(xscale="log", yscale="log", xlabel="opening less 1.4 diameters, diameters", ylabel="particles per second")
    axes.set_xticks(free, [f"{f:.1f}" for f in free])
    axes.set_yticks(rate, [f"{r:.0f}" for r in rate])
    axes.minorticks_off()
    axes.legend(frameon=False)
    figure.savefig(sys.argv[2], dpi=110)


main()
