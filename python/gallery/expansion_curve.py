#!/usr/bin/python3
"""How a bed expands: voidage and bed height over the superficial velocity, by the two-fluid model.

    PYTHONPATH=python /usr/bin/python3 python/gallery/expansion_curve.py [CASE] [-o DIR] [--short]
"""

import numpy as np
from common import options, plt, save

import polybed

chosen = options(__doc__, "small-binary")
velocities = [15, 25] if chosen.short else [10, 15, 20, 25, 30, 35, 40]
runs = polybed.sweep(chosen.case, "inlet.superficial_velocity", [f"{u} mm/s" for u in velocities],
                     output=chosen.output / "expansion", until="0.2 s" if chosen.short else None)

heights, interval = np.array([list(run.card["bed_height_m"].values()) for run in runs], float).T  # NaN: too few rows for an interval
# Volume of the solids over the cross-section, from the first profile: no drift can change it.
first = runs[0].profiles
solids = sum(first[f"phi_{name}"][0].sum() for name in runs[0].species) * np.diff(first["y_m"])[0]
voidage = 1 - solids / heights

figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.6), constrained_layout=True)
left.errorbar(velocities, heights * 1e3, interval * 1e3, marker="o", capsize=2)
left.set_xlabel("superficial velocity (mm/s)")
left.set_ylabel("bed height (mm)")
right.loglog(voidage, velocities, marker="o")
right.set_xlabel("mean voidage of the bed")
right.set_ylabel("superficial velocity (mm/s)")
save(figure, chosen.output, "expansion.png")
for row in zip(velocities, heights * 1e3, voidage):
    print("{:4.0f} mm/s: {:6.1f} mm, voidage {:.3f}".format(*row))
