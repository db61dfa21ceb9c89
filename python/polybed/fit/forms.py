"""The forms of drag laws as functions of their constants, over all points at once. `polybed drag` evaluates the law file that comes of a
fit; a test holds both against each other.

Arrays are one entry for each size of each point. Guards are left out: rows lie where the forms answer by themselves.
"""

from dataclasses import dataclass

import numpy as np


@dataclass
class Sizes:
    """What the forms need of each size of each point."""
    group: np.ndarray  # number of its point
    voidage: np.ndarray
    reynolds: np.ndarray  # of the Sauter diameter
    share: np.ndarray
    y: np.ndarray  # diameter over the Sauter diameter
    y_mean: np.ndarray  # sum x_k y_k of its point
    m2: np.ndarray  # sum x_k/y_k^2 of its point

    @staticmethod
    def of(points):
        columns = {name: [] for name in ("group", "voidage", "reynolds", "share", "y", "y_mean", "m2")}
        for n, p in enumerate(points):
            for name, value in (("group", n), ("voidage", p.voidage), ("reynolds", p.reynolds), ("share", p.share), ("y", p.y),
                                ("y_mean", (p.share * p.y).sum()), ("m2", (p.share / p.y**2).sum())):
                columns[name].append(np.broadcast_to(value, len(p.y)))
        return Sizes(**{name: np.concatenate(values) for name, values in columns.items()})

    @staticmethod
    def of_one_size(voidage, reynolds):
        one = np.ones(len(voidage))
        return Sizes(np.arange(len(voidage)), np.asarray(voidage, float), np.asarray(reynolds, float), one, one, one, one)


def cello_one_size(k, eps, re):
    """T(4.1)-(4.2): see closures/drag_cello.hpp."""
    k0 = (1 - eps) / (1 + 3 * eps)
    k1 = (1 + k0 * (k["k1_linear"] + k["k1_square"] * k0)) / (eps**2 * (1 + k["k1_below"] * k0))
    k2 = (1 + re * (k["k2_linear"] + k["k2_square"] * re)) / (1 + re * (k["k2_below_linear"] + k["k2_below_square"] * re)) - 1
    above = eps * (-k["k3_voidage"] + k["k3_voidage_square"] * eps) + (k["k3_dense"] * k0**20 - k["k3_reynolds"]) * re
    below = cello_pole(k, eps) + re * (k["pole_reynolds"] - k["pole_reynolds_square"] * re)
    return k1 + k2 * eps**4 + 2 * re**2 / (1 + re) * above / below * (1 - eps**4)


def cello_pole(k, eps):
    return eps * (k["pole_voidage"] + eps * (-k["pole_voidage_square"] + k["pole_voidage_cube"] * eps))


def cello_most_reynolds(k, eps):
    """Up to here the law answers by its form: Re_c of closures/drag_cello.hpp."""
    a, b = k["pole_reynolds_square"], k["pole_reynolds"]
    return np.minimum(1050, 0.5463 * (b + np.sqrt(np.maximum(b**2 + 4 * a * cello_pole(k, eps), 0))) / (2 * a))


def cello(k, s):
    """f_j and the mean f; T(4.18)-(4.21), (4.28)."""
    f = cello_one_size(k, s.voidage, s.reynolds)
    h = (1 - s.voidage) * (k["crossing"] - s.voidage) / (k["crossing"] * s.voidage)
    return s.y * (1 + h * (s.y - 1) / s.y_mean) * f, f


def brinkman_oseen(k, s):
    """f_j and the mean f: see closures/drag_brinkman_oseen.hpp."""
    phi = np.maximum(1 - s.voidage, 0)
    eps = 1 - phi
    logarithm = phi * np.log(np.maximum(phi, 1e-300))
    f0 = 10 * phi / eps**2 + eps**5 * (1 + 3 / np.sqrt(2) * np.sqrt(phi) + 135 / 64 * logarithm + 10.456 * phi)
    c = phi / (2 * eps + k["screening"] * phi**3)
    re = s.reynolds * s.y
    oseen = (1 + k["inertia_phi"] * phi) * eps**-2.25 * (1 + k["stretch"] * re) ** (-k["power"] + k["power_phi"] * phi)
    inertia = 3 / 16 * re * (oseen + k["forchheimer"] * (1 + k["forchheimer_phi"] * phi))
    viscous = np.maximum(np.sqrt(phi + eps * s.m2) * s.y * ((1 - c) * f0 - 1 / eps) + c * f0 * s.y**2, 0)
    shaded = np.maximum(inertia * (1 + 1.5 * c * (s.y - 1)), 0)
    f = 1 / eps + (viscous**1.5 + shaded**1.5) ** (2 / 3)
    return f, np.bincount(s.group, s.share * f / s.y**2)[s.group]


FORMS = {"cello": cello, "brinkman_oseen": brinkman_oseen}
ONLY_OF_MIXTURES = {"cello": ["crossing"], "brinkman_oseen": ["screening"]}
ONE_SCALE = {"cello": "pole_voidage"}  # only the ratios of the other constants of its fraction to it count


def net(form, constants, sizes):
    """n_j = f_j + phi y_j^2 f_mean/eps, T(1.31)."""
    f, mean = FORMS[form](constants, sizes)
    return f + (1 - sizes.voidage) * sizes.y**2 * mean / sizes.voidage
