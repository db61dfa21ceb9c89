#!/usr/bin/python3
"""The inversion point by force balance where each species has the drag of what it sees: averages taken by a kernel at a particle count the
particle itself and miss the neighbours that it keeps away (docs/theory/particle-fluid.md). A table in Markdown, with the law `cello`.

    tests/validation/inversion_seen.py            10 s
    tests/validation/inversion_seen.py --check    fails where the table differs from the recorded velocities

The kernel is bilinear: uniform along the depth, along width and height the product of cubic B-splines of the cells in the mean over places.
"""
import pathlib
import re
import sys

import numpy as np
from scipy.optimize import brentq

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from polybed.fit import forms

WAVE_NUMBERS, MOST_PER_CELL, DIRECTIONS = 1000, 40, 128  # twice as many move no velocity by 1e-5
GRAVITY = 9.81
C = dict(d=(0.214e-3, 0.776e-3), rho=(2450, 1500), number=(36584, 696), cell=(16.8e-3 / 14, 135.9e-3 / 113), depth=1.6e-3)
SYSTEMS = {  # fluid: density, viscosity; last the recorded velocities, mm/s: plain, neighbours kept out, after Percus and Yevick
    "thesis-a": (dict(d=(0.645e-3, 1.079e-3), rho=(3950, 2910), number=(9938, 2064), cell=(38.106e-3 / 18, 320e-3 / 195), depth=2.185e-3),
                 (1070, 0.14), (1.50, 1.3616, 1.5329)),
    "thesis-b": (dict(d=(0.807e-3, 2.010e-3), rho=(1395, 1170), number=(20399, 1001), cell=(60e-3 / 18, 617e-3 / 198), depth=4.06e-3),
                 (999.19, 1.14e-3), (34.27, 31.330, 31.817)),
    "thesis-c, 27 degC": (C, (996.59, 0.85e-3), (14.23, 13.186, 13.604)),
    "thesis-c, 25 degC": (C, (997.05, 0.89e-3), (13.74, 12.713, 13.122)),
    "small-binary": (dict(d=(2e-3, 6e-3), rho=(2500, 1600), number=(500, 18), cell=(9.3e-3, 9.3e-3), depth=12.4e-3),
                     (1000, 0.03), (36.43, 33.437, 35.068))}


def cello_constants():
    text = (ROOT / "closures/drag_cello.hpp").read_text().split("struct CelloConstants {")[1].split("};")[0]
    return {name: float(value) for name, value in re.findall(r"(\w+) = ([\d.e+-]+)", text)}


CELLO = cello_constants()


def exclusion(k, contact):
    """Transform of h = -1 within the contact and 0 beyond, m3."""
    x = np.maximum(k * contact, 1e-3)
    return -4 * np.pi * contact**3 * (np.sin(x) - x * np.cos(x)) / x**3


def percus_yevick(k, phi, d):
    """[i][j][k]: transform of h_ij of random hard spheres, m3: Baxter, J. Chem. Phys. 52 (1970) 4559; Hiroike, J. Phys. Soc. Japan 27 (1969)
    1415. Q_ij = a_i (r^2 - R_ij^2)/2 + b_i (r - R_ij) in (D_i - D_j)/2 < r < R_ij, integrated by Gauss's rule."""
    free, squares = 1 - phi.sum(), (phi / d).sum()
    a, b = (free + 3 * d * squares) / free**2, -1.5 * d**2 * squares / free**2
    number = phi / (np.pi / 6 * d**3)
    node, weight = np.polynomial.legendre.leggauss(60)
    q = np.empty((len(k), len(d), len(d)), complex)
    for i, di in enumerate(d):
        for j, dj in enumerate(d):
            contact = 0.5 * (di + dj)
            r = contact - 0.5 * dj * (1 - node)
            inside = 0.5 * a[i] * (r**2 - contact**2) + b[i] * (r - contact)
            integral = np.exp(1j * np.outer(k, r)) @ (0.5 * dj * weight * inside)
            q[:, i, j] = (i == j) - 2 * np.pi * np.sqrt(number[i] * number[j]) * integral
    inverse = np.linalg.inv(np.conj(q).transpose(0, 2, 1) @ q).real
    return ((inverse - np.eye(len(d))) / np.sqrt(np.outer(number, number))).transpose(1, 2, 0)


class Kernel:
    """Wave numbers and weights with which sum weight h(k) is int h K dV, and K at the particle itself, 1/m3."""

    def __init__(self, cell, depth):
        sinc4 = lambda x: np.sinc(x / np.pi) ** 4
        self.k = np.arange(WAVE_NUMBERS + 1) * MOST_PER_CELL / (min(cell) * WAVE_NUMBERS)
        angle = 0.5 * np.pi * (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
        along = [sinc4(0.5 * a * np.outer(self.k, turn)) for a, turn in zip(cell, (np.cos(angle), np.sin(angle)))]
        ends = np.where((self.k == 0) | (self.k == self.k[-1]), 0.5, 1)
        self.weight = ends * self.k[1] * self.k / (2 * np.pi) * (along[0] * along[1]).mean(axis=1) / depth
        self.at_itself = (2 / 3) ** 2 / (cell[0] * cell[1] * depth)

    def fractions(self, phi, d, equilibrium):
        """[i][j]: of species j, seen by one of species i: phi_j (1 + int h_ij K dV) + delta_ij V_i K(0)."""
        if equilibrium:
            h = percus_yevick(self.k, phi, d)
        else:
            h = np.array([[exclusion(self.k, 0.5 * (a + b)) for b in d] for a in d])
        return np.maximum(phi * (1 + h @ self.weight) + np.diag(np.pi / 6 * d**3 * self.at_itself), 0)


def velocity(bed, fluid, seen):
    """Superficial velocity at which both species rest, m/s. seen: fractions of a mixture -> those that each species sees"""
    d, rho = np.array(bed["d"]), np.array(bed["rho"])
    share = np.array(bed["number"]) * d**3 / (np.array(bed["number"]) * d**3).sum()
    density, viscosity = fluid

    def resting(eps, around, j):
        own = 1 - around.sum()
        x = around / around.sum()
        sauter = 1 / (x / d).sum()
        bulk = (1 - eps) * (share * rho).sum() + eps * density
        y = d / sauter

        def excess(log):
            slip = np.exp(log) * own / eps
            sizes = forms.Sizes(np.zeros(2, int), *(np.broadcast_to(v, 2) for v in (own, density * slip * sauter / viscosity)), x, y,
                                np.full(2, (x * y).sum()), np.full(2, (x / y**2).sum()))
            return 18 * viscosity * slip * forms.cello(CELLO, sizes)[0][j] / d[j] ** 2 - (rho[j] - bulk) * GRAVITY
        return np.exp(brentq(excess, np.log(1e-5), np.log(0.2), xtol=1e-9)) if rho[j] > bulk else np.nan

    def residual(eps):
        around = seen((1 - eps) * share)
        return np.log(resting(eps, around[0], 0) / resting(eps, around[1], 1))

    scan = np.linspace(0.98, 0.5, 25)
    values = [residual(eps) for eps in scan]
    high, low = next((a, b) for a, b, fa, fb in zip(scan, scan[1:], values, values[1:]) if fa * fb <= 0)
    eps = brentq(residual, low, high, xtol=1e-7)
    return resting(eps, seen((1 - eps) * share)[1], 1)


def velocities(bed, fluid):
    """mm/s: with the mean of the mixture, with neighbours kept out of contact, with those in equilibrium."""
    kernel, d = Kernel(bed["cell"], bed["depth"]), np.array(bed["d"])
    ways = (lambda phi: np.array([phi, phi]), lambda phi: kernel.fractions(phi, d, False), lambda phi: kernel.fractions(phi, d, True))
    return [1e3 * velocity(bed, fluid, seen) for seen in ways]


def self_test():
    d, k = np.array([1e-3]), np.array([0.0, 3e3])
    for phi in (0.1, 0.4):  # rho h(0) = T - 1 of one size, T = (1 - phi)^4/(1 + 2 phi)^2
        t = 1 + phi / (np.pi / 6 * d[0] ** 3) * percus_yevick(k, np.array([phi]), d)[0, 0, 0]
        assert abs(t - (1 - phi) ** 4 / (1 + 2 * phi) ** 2) < 1e-12
    dilute = percus_yevick(k, np.array([1e-7, 1e-7]), np.array([1e-3, 2.5e-3]))[0, 1]  # spheres that only keep each other out
    assert np.allclose(dilute, exclusion(k, 1.75e-3), rtol=1e-5, atol=1e-5 * 1.75e-3**3)
    assert abs(exclusion(np.pi / 2e-3, 2e-3) / 2e-3**3 + 4 / np.pi) < 1e-12


if __name__ == "__main__":
    self_test()
    check, wrong = "--check" in sys.argv, 0
    if not check:
        print("| mm/s, `cello` | plain | kept out of contact | Percus and Yevick |\n| --- | ---: | ---: | ---: |")
    for name, (bed, fluid, recorded) in SYSTEMS.items():
        found = velocities(bed, fluid)
        if check:
            # the record: two digits of the plain balance, and sums over B-splines in space of the others, to 1e-3
            wrong += sum(abs(a / b - 1) > tolerance for a, b, tolerance in zip(found, recorded, (4e-3, 1e-3, 1e-3)))
        else:
            print(f"| {name} | {' | '.join(f'{v:.2f}' for v in found)} |")
    if check:
        print(f"{wrong} velocities differ")
    sys.exit(int(wrong > 0))
