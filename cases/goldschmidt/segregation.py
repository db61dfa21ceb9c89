#!/usr/bin/python3
"""Extent of segregation of a binary bed in time, 0 mixed and 1 separated with the first species on top.

    cases/goldschmidt/segregation.py runs/segregation -o segregation.png

s = (S - 1)/(S_max - 1), S = height of the centre of the fine over that of the coarse, S_max = (2 - x)/(1 - x) with x the share
of the fine in the volume of the solids: that of two pure layers of one packing, x and 1 - x thick, by hand. The definition is
remembered as that of Goldschmidt et al. (2003), which is not held here and of which no copy was found.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
import polybed


def extent(run):
    """Time, s, and extent of segregation of a run with two species, the finer first, of one density."""
    history, (fine, coarse) = run.history, run.species
    masses = [history[f"mass_{name}_kg"][0] for name in (fine, coarse)]
    share = masses[0] / sum(masses)
    ratio = history[f"centre_{fine}_m"] / history[f"centre_{coarse}_m"]
    return history["time_s"], (ratio - 1) / ((2 - share) / (1 - share) - 1)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", nargs="+", help="run directory")
    parser.add_argument("-o", "--output", help="file of the picture")
    arguments = parser.parse_args()
    figure, panel = plt.subplots(figsize=(6, 3.5), dpi=110, layout="constrained")
    for directory in arguments.run:
        run = polybed.read(directory)
        time, values = extent(run)
        panel.plot(time, values, label=Path(directory).name)
        for start in np.arange(0, time[-1] - 1e-9, max(1.0, round(time[-1] / 6))):
            span = (time >= start) & (time < start + 1)
            print(f"{Path(directory).name}: {start:4.0f} to {start + 1:.0f} s: {values[span].mean():6.3f} ± {values[span].std():.3f}"
                  f", bed height {run.history['bed_height_m'][span].mean() * 1e3:.0f} mm")
    panel.set(xlabel="time (s)", ylabel="extent of segregation")
    panel.legend(fontsize=8)
    if arguments.output:
        figure.savefig(arguments.output)
