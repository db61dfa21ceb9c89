"""Power laws for error and cost, and the front of what nothing beats."""

from typing import NamedTuple

import numpy as np


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
    mean = points.mean(axis=0)
    a, b = (points - mean).T
    exponent = (a @ b) / (a @ a)
    return PowerLaw(float(np.exp(mean[1] - exponent * mean[0])), float(exponent), float(np.sqrt(np.mean((b - exponent * a) ** 2))))


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
