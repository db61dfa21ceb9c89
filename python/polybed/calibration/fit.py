"""From boxes to a table: means over seeds, their errors, and whether the table can be used."""

import itertools
import math

import numpy as np
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator
from scipy.special import ndtr, stdtrit

from polybed.ending import NUMBERS, StudyError
from polybed.solids_table import AXES, SolidsTable

SCATTER_SEEDS = 3  # from so many seeds on their scatter alone is the error of their mean
LEAST_SEEDS = 2  # of each point of a plan whose points get more seeds where they scatter: one says nothing of scatter
MOST_SEEDS = 10  # of a point
GREATEST_RESIDUAL = 0.05  # of a fit that can be used, and the greatest standard error of its points
AGREEMENT = 0.05  # what both measures of the pressure of a bed can differ by
LEAST_TO_LEAVE_OUT = 4  # solids fractions from which on one can be left out and read from the others


def mean_of_seeds(seeds):
    """Mean of (mean, error) of seeds, and its error t s/sqrt(n), with the standard deviation s of the n boxes and Student's factor t. Blocks
    of one box are not independent: they remember the start, and count what all boxes lose on their way. Of two seeds at least the boxes'
    own errors together; of one its own."""
    (means, errors), n = zip(*seeds), len(seeds)
    mean, inner = float(np.mean(means)), math.hypot(*errors) / n
    if n < 2:
        return mean, inner
    outer = float(stdtrit(n - 1, ndtr(1)) * np.std(means, ddof=1)) / math.sqrt(n)  # 68.27 %
    return mean, max(inner, outer) if n < SCATTER_SEEDS else outer


def grouped(boxes, seeds):
    """The boxes of each point."""
    ends = list(itertools.accumulate(seeds))
    return [boxes[end - count:end] for end, count in zip(ends, seeds)]


def fitted_inertia(stokes, pressure):
    """lambda of p = mu_f gamma V (1 + lambda St): slope over intercept of p/(mu_f gamma V) in St, by relative deviations, the median over
    the solids fractions; 0 where it would not be positive. pressure: [phi][stokes]"""
    lines = [np.polyfit(stokes, row, 1, w=1 / np.asarray(row)) for row in pressure]
    found = [slope / intercept if intercept > 0 else 0.0 for slope, intercept in lines]
    return max(float(sorted(found)[len(found) // 2]), 0.0)


def shear_number(box):
    """S = gamma d/sqrt(theta)."""
    return box["shear_rate_1_s"] * box["diameter_m"] / math.sqrt(box["theta_m2_s2"][0])


def fitted(plan, boxes):
    """The table of sheared boxes in the order of a plan. Its curves pass through the means of the seeds."""
    axes = {name: list(map(float, plan.axes[name])) for name in AXES}
    points = grouped(boxes, plan.seeds)
    plain = [sum(box["p_ratio"][0] / len(point) for box in point) for point in points]
    inertia = 0.0
    if plan.regime == "wet" and len(axes["stokes"]) > 1:  # of the first restitution, friction and share
        inertia = fitted_inertia(axes["stokes"], np.reshape(plain, (len(axes["phi"]), len(axes["stokes"]), -1))[:, :, 0].tolist())
    table = SolidsTable(axes, {"regime": plan.regime, "reference": plan.case["reference"], "lambda": inertia})
    for name in ("p_ratio", "mu_ratio", "gamma_ratio"):
        add_means(table, name, name, points, np.array([1 / (1 + inertia * point.stokes) for point in plan.points()]))
    add_means(table, "T_ratio_12", "temperature_ratio", points)
    table.put("S", [sum(shear_number(box) / len(point) for box in point) for point in points])
    if plan.pushed:
        pushed = grouped(boxes[sum(plan.seeds):], plan.seeds)
        add_means(table, "beta_12_ratio", "exchange_ratio", pushed)
        # the drift over sqrt(theta) up to which all points were measured
        table.arrays["beta_12_drift"] = [min(max(abs(box["slip_over_sqrt_theta"]) for box in point) for point in pushed)]
    table.attributes["left_out_residual"], table.attributes["fit_residual"] = left_out(table)
    return table


def add_means(table, name, of_box, points, per=1.0):
    """Adds the means over the seeds of each point, times `per`, with their errors and numbers of seeds."""
    means, errors = np.transpose([mean_of_seeds([tuple(box[of_box]) for box in point]) for point in points])
    table.put(name, means * per)
    table.put(f"{name}_se", errors * per)
    table.put(f"{name}_n", [float(len(point)) for point in points])


def curve(x, y):
    """The monotone cubic by which a run reads a table: slopes of Fritsch and Carlson, 0 at both ends. y: one column for each curve"""
    slopes = PchipInterpolator(x, y).derivative()(x)
    slopes[[0, -1]] = 0
    return CubicHermiteSpline(x, y, slopes)


def missed_at(phi, value, error, p):
    """What a curve through all knots but one misses there, over the value: in all, and beyond two standard errors of both."""
    knots, others, errors = (np.delete(values, p) for values in (phi, value, error))
    read, *moved = curve(knots, np.column_stack([others, others[:, None] + np.diag(errors)]))(phi[p])
    off = abs(read - value[p])
    both = math.sqrt(error[p]**2 + sum((one - read)**2 for one in moved))
    return off / value[p], (off - 2 * both) / value[p]


def missed(table):
    """For p and mu at each inner solids fraction: |curve/point - 1| where that is left out of the curve, the same beyond two standard errors
    of both together, the name, and the number of the solids fraction; none where there are too few."""
    phi = np.array(table["phi"])
    if len(phi) < LEAST_TO_LEAVE_OUT:
        return []
    return [(*missed_at(phi, value, error, p), name, p) for name in ("p", "mu")
            for value, error in zip(table.lines(f"{name}_ratio"), table.lines(f"{name}_ratio_se")) for p in range(1, len(phi) - 1)]


def left_out(table):
    """The greatest of both in missed(table); 0 where there are too few."""
    return tuple(max([0.0, *(float(one[n]) for one in missed(table))]) for n in range(2))


def relative_errors(table):
    """Standard error over value of p or mu at every point, whichever is more."""
    p, p_error, mu, mu_error = (table.points(name) for name in ("p_ratio", "p_ratio_se", "mu_ratio", "mu_ratio_se"))
    return np.maximum(p_error / p, mu_error / np.abs(mu))


def add_seeds(plan, table):
    """Adds a seed at each point that scatters too much and has fewer than MOST_SEEDS, if seeds are to be added; whether there is one."""
    if min(plan.seeds) < LEAST_SEEDS:
        return False
    more = [error > GREATEST_RESIDUAL and seeds < MOST_SEEDS for error, seeds in zip(relative_errors(table), plan.seeds)]
    plan.seeds = [seeds + one for seeds, one in zip(plan.seeds, more)]
    return any(more)


def require_exchange(table):
    """Raises StudyError where species seem to be sped up by each other."""
    if "beta_12_ratio" not in table.arrays:
        return
    for phi, ratio, error in zip(*map(table.points, ("phi", "beta_12_ratio", "beta_12_ratio_se"))):
        if not ratio > 0:
            raise StudyError(NUMBERS, f"at phi = {phi:g} beta_12 is {ratio:.3g} of its form, +- {error:.2g}: boxes too short to tell the "
                                   "drift of species that are pushed apart; raise calibrate.particles or calibrate.strain")


def require_usable(table, falls):
    """Raises StudyError if the pressure falls, the residual or, of several seeds, a standard error is too great. falls: places"""
    if falls:
        raise StudyError(NUMBERS, "the pressure of the table falls with the solids fraction, which no bed can follow: " + "; ".join(falls))
    residual, allowed = table.attributes["fit_residual"], f"{100 * GREATEST_RESIDUAL:.0f} % are allowed"
    if not residual <= GREATEST_RESIDUAL:
        _, _, name, p = max(missed(table), key=lambda one: one[1])
        below, phi, above = table["phi"][p - 1:p + 2]
        raise StudyError(NUMBERS, f"left out, the solids fraction {phi:g} is missed: the curve through the others has a {name} that is off by "
                               f"{100 * residual:.1f} % more than two standard errors of both, {allowed}. Half the distance leaves about a "
                               f"quarter: add {(below + phi) / 2:.4g} and {(phi + above) / 2:.4g} to calibrate.solids_fraction, "
                               "or, where that gains nothing, raise calibrate.particles")
    for phi, seeds, error in zip(table.points("phi"), table.points("p_ratio_n"), relative_errors(table)):
        if seeds > 1 and not error <= GREATEST_RESIDUAL:
            more = math.ceil((error / GREATEST_RESIDUAL) ** 2 * seeds)
            raise StudyError(NUMBERS, f"at phi = {phi:g} the seeds scatter: p or mu has a standard error of {100 * error:.1f} %, {allowed}; "
                                   f"raise calibrate.seeds to about {more} ({seeds:g} at this point), or calibrate.particles likewise")


def bed_table(seeds, boxes, weight):
    """Means over the seeds of each point, in rising phi. weight: |rho_p - rho_f| g D/rho_p, m2/s2"""
    points = grouped(boxes, seeds)
    slabs, balance = ([mean_of_seeds([tuple(box[name]) for box in point]) for point in points] for name in ("p_bed", "p_bed_by_balance"))
    return SolidsTable({
        "phi": [sum(box["bed_phi"] / len(point) for box in point) for point in points],
        "p_bed": [mean for mean, _ in slabs], "p_bed_se": [error for _, error in slabs],
        "p_bed_n": [float(len(point)) for point in points],
        "p_bed_by_balance": [mean for mean, _ in balance], "p_bed_by_balance_se": [error for _, error in balance],
        "theta_bed": [sum(box["theta_m2_s2"][0] / len(point) for box in point) / weight for point in points],
        "velocity": [point[0]["velocity_m_s"] for point in points],
    }, {"regime": "bed", "units": "p_bed over |rho_p - rho_f| g D; theta_bed over that and rho_p; velocity m/s"})


def rows_of_bed(table):
    """(phi, p_bed by slabs, its error, by the balance of forces, its error) of each row."""
    return list(zip(*(table[name] for name in ("phi", "p_bed", "p_bed_se", "p_bed_by_balance", "p_bed_by_balance_se"))))


def require_usable_bed(table):
    """Raises StudyError where the pressure does not rise, or where both measures differ by more than AGREEMENT and two standard errors."""
    last = None
    for phi, slabs, slabs_error, balance, balance_error in rows_of_bed(table):
        off = abs(balance - slabs)
        if off > AGREEMENT * abs(slabs) and off > 2 * math.hypot(slabs_error, balance_error):
            raise StudyError(NUMBERS, f"at phi = {phi:.3f} the pressure is {slabs:.4g} by slabs and {balance:.4g} by the balance of forces, "
                                   f"over the unit: {100 * off / abs(slabs):.0f} % apart, {100 * AGREEMENT:.0f} % are allowed")
        if last and not (phi > last[0] and slabs > last[1]):
            raise StudyError(NUMBERS, f"p_bed falls between phi = {last[0]:.3f} and {phi:.3f}: {last[1]:.4g} and {slabs:.4g}")
        last = phi, slabs
