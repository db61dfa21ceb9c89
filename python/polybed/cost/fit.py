"""Power laws for error and cost, the front of what nothing beats, and the cheapest settings for a target."""

from dataclasses import dataclass
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


@dataclass
class ErrorModel:
    """E^2 = (C_t tau^q)^2 + (C_h h^p)^2 + (A/sqrt(T))^2 at the cost (T_spin + T) R tau^-a h^-b."""
    time: PowerLaw = PowerLaw()  # C_t, q
    space: PowerLaw = PowerLaw()  # C_h, p
    fluctuation: float = 0.0  # A; 0: nothing fluctuates
    spin_up: float = 0.0  # T_spin, s
    rate: float = 0.0  # R, s per simulated s at tau = h = 1
    time_exponent: float = 0.0  # a
    space_exponent: float = 0.0  # b


class Optimum(NamedTuple):
    tolerance: float  # tau, h and T; 0 where absent
    spacing: float
    window: float
    cost: float


def settings_at(model, target, shares):
    """Settings and cost with these shares of the squared error for time, space and fluctuation."""
    tolerance, spacing = model.time.inverse(target * shares[0] ** 0.5), model.space.inverse(target * shares[1] ** 0.5)
    window = (model.fluctuation / target) ** 2 / shares[2] if model.fluctuation > 0 else 0.0
    by_time = tolerance**-model.time_exponent if model.time.factor > 0 else 1
    by_space = spacing**-model.space_exponent if model.space.factor > 0 else 1
    return Optimum(tolerance, spacing, window, (model.spin_up + window) * model.rate * by_time * by_space)


def cheapest(model, target):
    """The cheapest tau, h and T with E = target: by the shares of the squared error that each may have, found to 1e-3."""
    present = [model.time.factor > 0, model.space.factor > 0, model.fluctuation > 0]

    def shares(a, b):
        found = [part * there for part, there in zip((a, b * (1 - a), (1 - a) * (1 - b)), present)]
        return [share / (sum(found) or 1) for share in found]
    parts, best, centre, half = 40, None, (0.5, 0.5), 0.5
    for _ in range(4):
        around = [np.clip([c + half * (2 * i / parts - 1) for i in range(parts + 1)], 1e-6, 1 - 1e-6).tolist() for c in centre]
        for a in around[0]:
            for b in around[1]:
                here = settings_at(model, target, shares(a, b))
                if best is None or here.cost < best.cost:
                    best, centre = here, (a, b)
        half *= 0.15
    return best
