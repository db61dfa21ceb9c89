#!/usr/bin/python3
"""Granular temperature of a sheared box of particles against kinetic theory, over the restitution.

    PYTHONPATH=multiscale/python /usr/bin/python3 multiscale/python/gallery/sheared_box.py [CASE] [-o DIR] [--short]

Theory: production meets dissipation, theta/(gamma d)^2 = mu*/Gamma* with the viscosity and the dissipation of Lun et al.,
J. Fluid Mech. 140 (1984) 223, and the pair distribution of Carnahan and Starling. It is of smooth spheres of one size.
"""

import math
import tomllib

import numpy as np
from common import options, plt, save

import polybed
from polybed.program import case_text


def box_of(path):
    """Diameter, m, shear rate, 1/s, and solids fraction of a case; one that the theory is not of is refused."""
    case = tomllib.loads(case_text(path, None, None))
    species, dem = case["species"], case["dem"]
    smooth = species[0].get("friction", dem["friction"]) == 0 and "restitution" not in species[0]
    if len(species) != 1 or case["fluid"]["name"] != "none" or not smooth or not dem.get("shear_rate"):
        raise SystemExit(f"{path}: the theory is of one species of smooth spheres, with the case's restitution, sheared "
                         "without a fluid")
    diameter = species[0]["diameter"]
    volume = case["bed"]["particles"][0] * math.pi / 6 * diameter**3
    return diameter, dem["shear_rate"], volume / math.prod(case["column"]["size"])


def theory(e, phi):
    """theta/(gamma d)^2 in steady shear."""
    g0 = (1 - phi / 2) / (1 - phi) ** 3
    eta, m0 = (1 + e) / 2, 5 * math.sqrt(math.pi) / 96
    bulk = 256 * m0 * phi**2 * g0 / (5 * math.pi)
    viscosity = (m0 / (g0 * eta * (2 - eta)) * (1 + 1.6 * eta * phi * g0) * (1 + 1.6 * eta * (3 * eta - 2) * phi * g0)
                 + 0.6 * eta * bulk)
    return viscosity / (12 / math.sqrt(math.pi) * (1 - e**2) * phi**2 * g0)


def temperature(run):
    """Mean over the last half of the stored times of <v'^2>/3, v' without the mean flow of the box, and its error."""
    found = []
    for step in range(len(run.particles) // 2, len(run.particles)):
        at = run.particles[step]
        own = at.velocity.copy()
        own[:, 0] -= np.polyval(np.polyfit(at.position[:, 1], own[:, 0], 1), at.position[:, 1])
        found.append((own**2).sum(axis=1).mean() / 3)
    return np.mean(found), np.std(found) / math.sqrt(max(len(found) - 1, 1))


if __name__ == "__main__":
    chosen = options(__doc__, "shear-box")
    diameter, shear_rate, phi = box_of(chosen.case)
    restitutions = [0.9] if chosen.short else [0.8, 0.85, 0.9, 0.95]
    short = {"until": "2 ms", "overrides": {"output.every": "0.5 ms"}}
    runs = polybed.sweep(chosen.case, "dem.restitution", restitutions, "dem", output=chosen.output / "shear",
                         **(short if chosen.short else {}))
    theta, error = np.array([temperature(run) for run in runs]).T / (shear_rate * diameter) ** 2
    figure, axes = plt.subplots(figsize=(5, 3.8), constrained_layout=True)
    fine = np.linspace(min(restitutions) - 0.02, max(restitutions) + 0.01, 100)
    axes.plot(fine, [theory(e, phi) for e in fine], label="kinetic theory (Lun et al. 1984)")
    axes.errorbar(restitutions, theta, error, marker="o", linestyle="", capsize=2, label="particles")
    axes.set_xlabel("restitution")
    axes.set_ylabel(r"$\theta/(\gamma d)^2$")
    axes.legend()
    save(figure, chosen.output, "shear.png")
    for e, value, half in zip(restitutions, theta, error):
        print(f"e = {e}: {value:.3f} +- {half:.3f}, theory {theory(e, phi):.3f}")
