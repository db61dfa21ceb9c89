#!/usr/bin/python3
"""What accuracy costs: error of the bed height against CPU time, over the tolerance of the two-fluid model.

    PYTHONPATH=python /usr/bin/python3 python/gallery/accuracy_against_time.py [CASE] [-o DIR] [--short]

The error is the difference from the run with the smallest tolerance, at the end of the same time on the same grid: what the
grid and the model err by is not in it.
"""

import numpy as np
from common import options, plt, save

import polybed

chosen = options(__doc__, "small-binary")
tolerances = [1e-3, 1e-4, 1e-5] if chosen.short else [2e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7]
runs = polybed.sweep(chosen.case, "tfm.rtol", tolerances, output=chosen.output / "accuracy",
                     until="0.1 s" if chosen.short else "2 s")

height = np.array([run.quantity("bed_height")[-1] for run in runs])
seconds = np.array([run.record["cpu_s"] for run in runs])
error = abs(height / height[-1] - 1)

figure, axes = plt.subplots(figsize=(5, 3.8), constrained_layout=True)
axes.loglog(error[:-1], seconds[:-1], marker="o")
for x, y, tolerance in zip(error[:-1], seconds[:-1], tolerances):
    axes.annotate(f"{tolerance:g}", (x, y), textcoords="offset points", xytext=(4, 4), fontsize=8)
axes.set_xlabel("relative error of the bed height")
axes.set_ylabel("CPU time (s)")
save(figure, chosen.output, "accuracy.png")
for row in zip(tolerances, error, seconds):
    print("rtol {:.0e}: error {:.1e}, {:.2f} CPU s".format(*row))
