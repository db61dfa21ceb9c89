#!/usr/bin/python3
"""The stress of sheared particles, calibrated: temperature and the ratios of the table over the solids fraction.

    PYTHONPATH=python /usr/bin/python3 python/gallery/calibration.py [CASE] [-o DIR] [--short]

A small calibration, of some minutes; `polybed calibrate CASE` makes the one that a case asks for. The ratios are over the form
that the table names. Beside the temperature of dry smooth spheres of one size stands theory: production meets dissipation,
theta/(gamma d)^2 = mu*/Gamma* with the viscosity and the dissipation of Lun et al., J. Fluid Mech. 140 (1984) 223, and the pair
distribution of Carnahan and Starling.
"""

import math
import os

import numpy as np
from common import options, plt, save

import polybed
from polybed.drawing.stress_table import RATIOS, draw_ratios
from polybed.solids_table import AXES

SMALL = {"calibrate.solids_fraction": [0.1, 0.2, 0.3, 0.4, 0.45, 0.5], "calibrate.particles": 500, "calibrate.strain": 10,
         "calibrate.discard_strain": 5, "calibrate.doublings": 0, "calibrate.seeds": 3}
SHORT = SMALL | {"calibrate.solids_fraction": [0.3, 0.45], "calibrate.particles": 100, "calibrate.strain": 2,
                 "calibrate.discard_strain": 1, "calibrate.seeds": 1}


def theory(e, phi):
    """theta/(gamma d)^2 in steady shear."""
    g0 = (1 - phi / 2) / (1 - phi) ** 3
    eta, m0 = (1 + e) / 2, 5 * math.sqrt(math.pi) / 96
    bulk = 256 * m0 * phi**2 * g0 / (5 * math.pi)
    viscosity = (m0 / (g0 * eta * (2 - eta)) * (1 + 1.6 * eta * phi * g0) * (1 + 1.6 * eta * (3 * eta - 2) * phi * g0)
                 + 0.6 * eta * bulk)
    return viscosity / (12 / math.sqrt(math.pi) * (1 - e**2) * phi**2 * g0)


def draw_temperature(axes, table):
    """theta/(gamma d)^2 = 1/S^2 of every point of the table, and theory where there is one."""
    phi = table["phi"]
    fine = np.linspace(phi[0], phi[-1], 100)
    for place in np.ndindex(table["S"].shape[1:]):
        at = {axis: table[axis][n] for axis, n in zip(AXES[1:], place)}
        axes.plot(phi, table["S"][(slice(None), *place)] ** -2, marker="o", linestyle="", label="particles")
        if table.attributes["regime"] == "dry" and at["mu_p"] == 0 and at["x2"] == 0:
            axes.plot(fine, theory(at["e"], fine), label="kinetic theory (Lun et al. 1984)")
    axes.set_xlabel("solids fraction")
    axes.set_ylabel(r"$\theta/(\gamma d)^2$")
    axes.set_ylim(bottom=0)
    axes.legend(fontsize=8)


if __name__ == "__main__":
    chosen = options(__doc__, "shear-box")
    table = polybed.calibrate(chosen.case, SHORT if chosen.short else SMALL, chosen.output / "calibration", jobs=os.cpu_count())
    figure, plots = plt.subplots(1, 1 + len(RATIOS), figsize=(12, 3.2), constrained_layout=True)
    draw_temperature(plots[0], table)
    draw_ratios(table, plots[1:])
    save(figure, chosen.output, "calibration.png")
    print(f"regime {table.attributes['regime']}, ratios to {table.attributes['reference']}")
    for n, phi in enumerate(table["phi"]):
        first = (n, *[0] * (len(AXES) - 1))  # of the other axes
        told = [f"{title} {table[name][first]:.3f} +- {table[name + '_se'][first]:.3f}" for name, title in RATIOS]
        print(f"phi {phi:g}: theta/(gamma d)^2 {table['S'][first] ** -2:.3f}; {', '.join(told)}")
