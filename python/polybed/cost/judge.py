"""From runs to errors, ranks and one recommendation: functions of what a sweep has measured; power laws, what nothing beats, extrapolation."""

from dataclasses import dataclass
from math import hypot, log
from typing import NamedTuple

import numpy as np

from polybed.cost.axes import NUMERICS
from polybed.cost.sweep import CANDIDATE, REFERENCE, SHARE, Priced, RowQuantity, in_words
from polybed.study.measured import means_of

LEAST_RATIO = 1.3  # of the spacings of two grids
SAFETY_IN_RANGE, SAFETY_ELSEWHERE = 1.25, 3
FLOOR_FACTOR = 10  # of the disagreement of two references


class PowerLaw(NamedTuple):
    """y = factor x^exponent; a law with the factor 0 is absent, its variable without influence."""
    factor: float = 0.0
    exponent: float = 0.0
    scatter: float = 0.0  # root mean square of the logarithm's residuals


def fit_power_law(x, y):
    """Least squares of ln y over ln x of the pairs above 0; None for fewer than two different x, or if a number is infinite."""
    points = np.log([pair for pair in zip(x, y) if pair[0] > 0 and pair[1] > 0]).reshape(-1, 2)
    if len(points) < 2 or np.ptp(points[:, 0]) == 0 or not np.isfinite(points).all():
        return None
    x, y = points.T
    exponent, constant = np.polyfit(x, y, 1)
    return PowerLaw(float(np.exp(constant)), float(exponent), float(np.sqrt(np.mean((y - constant - exponent * x) ** 2))))


def pareto_front(points):
    """Which of the points no other one beats in both, by rising cost. Of equal points the first."""
    front = []
    for n in sorted(range(len(points)), key=lambda n: (points[n].cost, points[n].error)):
        if not front or points[n].error < points[front[-1]].error:
            front.append(n)
    return front


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


def carries(disagreement, errors, target):
    """Whether a reference carries a ranking. Two references, of two families, disagree by `disagreement`; errors below ten times that are
    not ranked. It does if an error is above that floor, or if the floor itself is below the target."""
    floor = FLOOR_FACTOR * disagreement
    return floor <= target or any(error >= floor for error in errors)


def scale_of(sweep, quantity):
    """What errors of a quantity are relative to."""
    info = next((q for q in sweep.quantities if q.id == quantity), None)
    if info is None or info.scale == SHARE:
        return 1.0
    return abs(sweep.reference.value.get("bed_height", 0)) or 1.0


def measure_errors(sweep, row):
    """Gives a row its quantities with their distances from the reference."""
    row.quantities = {}
    if not row.done:
        return
    reference = sweep.reference
    for name, mean in row.measured.values.items():
        if name not in reference.value:
            continue
        scale, band = scale_of(sweep, name), reference.band.get(name, 0.0)
        interval = hypot(mean.error or 0, band * scale) / scale if sweep.chaotic else band
        row.quantities[name] = RowQuantity(mean.mean, abs(mean.mean - reference.value[name]) / scale, mean.error, interval)


def measure_distances(sweep):
    """Gives the rows the distances of their mean profiles from the reference's."""
    for row in sweep.rows:
        if row.done and row.measured.directory and sweep.reference.directory:
            found = means_of(row.measured.directory, sweep.reference.directory, sweep.begin, sweep.slabs).distances
            row.quantities |= {name: RowQuantity(found[name].mean, found[name].mean) for name in ("composition", "profile") if name in found}


def distance_of(sweep, row, other):
    """How far apart two runs are in the first quantity, relative; None where one has none."""
    a, b = (r.measured.values.get(sweep.ranking) for r in (row, other))
    return abs(a.mean - b.mean) / scale_of(sweep, sweep.ranking) if row.done and other.done and a and b else None


def ranked(sweep, row):
    """Error and interval of the ranking quantity; None if it is not ranked."""
    ranks = row.kind == CANDIDATE and row.done and row.outcome.invariants_held
    return row.quantities.get(sweep.ranking) if ranks else None


def is_hollow(sweep, quantity):
    within = sweep.chaotic and quantity.error_interval is not None and quantity.error < quantity.error_interval
    return within or quantity.error < sweep.reference.floor.get(sweep.ranking, 0)


def unranked_status(row):
    if not row.done:
        return row.outcome.state
    if not row.outcome.invariants_held:
        return "failed"
    return "hollow" if row.kind in (CANDIDATE, REFERENCE) else "model"


def recommend(sweep):
    """The cheapest row whose error is within the target, interval included."""
    target = sweep.options.target
    high_floor = sweep.reference.floor.get(sweep.ranking, 0) > target  # below it nothing is known of an error
    quantities = [ranked(sweep, row) for row in sweep.rows]
    within = [n for n, quantity in enumerate(quantities) if quantity and quantity.error + (quantity.error_interval or 0) <= target
              and not (high_floor and is_hollow(sweep, quantity))]
    sweep.recommended = min(within, key=lambda n: sweep.rows[n].rate, default=None)


def rank(sweep):
    """Statuses of all rows, and the recommendation."""
    competing = []
    for row in sweep.rows:
        row.status = unranked_status(row)
        quantity = ranked(sweep, row) if sweep.outcome == "done" else None
        if quantity is not None and not is_hollow(sweep, quantity):
            competing.append((row, Priced(quantity.error, row.rate)))
            row.status = "dominated"
    for n in pareto_front([point for _, point in competing]):
        competing[n][0].status = "pareto"
    for row in sweep.rows:
        if row.predicted and row.outcome.state == "not run":
            row.status = "predicted"
    if sweep.outcome == "done":
        recommend(sweep)


def level_of(row, axis):
    return row.settings.get(axis.name, axis.given)


def settings_text(sweep, row):
    """Settings of a row in words: "relative tolerance (tfm.rtol) 1e-3, cells 9x64"."""
    if not row.settings:
        return row.note
    shown = [in_words(axis.name, axis.levels[level_of(row, axis)].label) for axis in sweep.axes
             if axis.kind == NUMERICS or level_of(row, axis) != axis.given]
    return ", ".join(shown + ([row.note] if row.note else [])) or "as given"
