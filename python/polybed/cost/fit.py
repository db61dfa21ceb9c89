"""Power laws for error and cost, the front of what nothing beats, and extrapolation from a sequence of grids."""

from dataclasses import dataclass
from math import log
from typing import NamedTuple

import numpy as np

LEAST_RATIO = 1.3


class PowerLaw(NamedTuple):
    """y = factor x^exponent; a law with the factor 0 is absent, its variable without influence."""
    factor: float = 0.0
    exponent: float = 0.0
    scatter: float = 0.0  # root mean square of the logarithm's residuals

    def at(self, x):
        return self.factor * x**self.exponent

    def inverse(self, y):
        """Where the law has this value; 0 for one that is absent."""
        return (y / self.factor) ** (1 / self.exponent) if self.factor > 0 else 0.0


def fit_power_law(x, y):
    """Least squares of ln y over ln x; None for fewer than two different x, or if a number is infinite. Pairs that are not above 0 are left
    out."""
    points = np.log([pair for pair in zip(x, y) if pair[0] > 0 and pair[1] > 0]).reshape(-1, 2)
    if len(points) < 2 or np.ptp(points[:, 0]) == 0 or not np.isfinite(points).all():
        return None
    x, y = points.T
    exponent, constant = np.polyfit(x, y, 1)
    return PowerLaw(float(np.exp(constant)), float(exponent), float(np.sqrt(np.mean((y - constant - exponent * x) ** 2))))


class Priced(NamedTuple):
    error: float
    cost: float


def pareto_front(points):
    """Which of the points no other one beats in both, by rising cost. Of equal points the first."""
    front = []
    for n in sorted(range(len(points)), key=lambda n: (points[n].cost, points[n].error)):
        if not front or points[n].error < points[front[-1]].error:
            front.append(n)
    return front


SAFETY_IN_RANGE, SAFETY_ELSEWHERE = 1.25, 3


@dataclass
class Refined:
    """The result of three grids. Without an order the limit is the finest value, and the band is the scatter of the values."""
    limit: float  # Richardson's value, or the value on the finest grid
    band: float  # half-width about the limit
    order: float | None = None  # p; None if the sequence is not monotone or does not converge
    safety: float = 0.0  # F_s
    note: str = ""  # why there is no order, or why the safety is large


def refine(coarse, medium, fine, ratio=2.0, formal_order=2.0):
    """Observed order p = ln((f3 - f2)/(f2 - f1))/ln r, Richardson's limit f1 + (f1 - f2)/(r^p - 1) and the band
    F_s |f1 - f2|/(r^p - 1) (Roache 1994, J. Fluids Eng. 116, 405) of one quantity on three grids: f3, f2 and f1.

    F_s = 1.25 where p_formal/2 <= p <= p_formal + 0.5; monotone otherwise: 3 with the smaller of p and p_formal, and at least |f1 - f2|. Not
    monotone, or differences that do not shrink: no order; the band is three times half the range of the values. Raises ValueError for
    r < 1.3, where rounding and noise are amplified beyond use. ratio: r, of the spacings
    """
    if not ratio >= LEAST_RATIO:
        raise ValueError("grids of a ratio below 1.3")
    first, second = medium - fine, coarse - medium

    def scattered(note):
        return Refined(fine, 3 * 0.5 * (max(coarse, medium, fine) - min(coarse, medium, fine)), note=note)
    if first == second == 0:
        return scattered("the same on all grids")
    if not first * second > 0:
        return scattered("not in the asymptotic range: the sequence is not monotone")
    observed = log(second / first) / log(ratio)
    if not observed > 0:
        return scattered("not in the asymptotic range: the differences do not shrink")
    in_range = formal_order / 2 <= observed <= formal_order + 0.5
    growth = ratio ** (observed if in_range else min(observed, formal_order))
    safety = SAFETY_IN_RANGE if in_range else SAFETY_ELSEWHERE
    band = safety * abs(first) / (growth - 1)
    return Refined(fine - first / (growth - 1), band if in_range else max(band, abs(first)), observed, safety,
                   "" if in_range else f"the observed order {observed:.2g} is not that of the scheme, {formal_order:.2g}")
