"""The table of fluidised boxes: p_bed(phi), measured twice."""

import math

from polybed.calibration.fit import grouped, mean_of_seeds
from polybed.calibration.text import measured
from polybed.ending import NUMBERS, StudyError
from polybed.solids_table import SolidsTable
from polybed.texts import right_table

AGREEMENT = 0.05  # what both measures of the pressure may differ by
UNITS = "p_bed over |rho_p - rho_f| g D; theta_bed over that and rho_p; velocity m/s"


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
    }, {"regime": "bed", "units": UNITS})


def rows(table):
    """(phi, p_bed by slabs, its error, by the balance of forces, its error) of each row."""
    return list(zip(*(table[name] for name in ("phi", "p_bed", "p_bed_se", "p_bed_by_balance", "p_bed_by_balance_se"))))


def require_usable(table):
    """Raises StudyError where the pressure does not rise, or where both measures differ by more than AGREEMENT and two standard errors."""
    last = None
    for phi, slabs, slabs_error, balance, balance_error in rows(table):
        off = abs(balance - slabs)
        if off > AGREEMENT * abs(slabs) and off > 2 * math.hypot(slabs_error, balance_error):
            raise StudyError(NUMBERS, f"at phi = {phi:.3f} the pressure is {slabs:.4g} by slabs and {balance:.4g} by the balance of forces, "
                                   f"over the unit: {100 * off / abs(slabs):.0f} % apart, {100 * AGREEMENT:.0f} % are allowed")
        if last and not (phi > last[0] and slabs > last[1]):
            raise StudyError(NUMBERS, f"p_bed falls between phi = {last[0]:.3f} and {phi:.3f}: {last[1]:.4g} and {slabs:.4g}")
        last = phi, slabs


def bed_lines(boxes):
    head = ("planned", "phi", "seed", "p_bed by slabs", "by balance", "slabs/balance")
    return right_table(head, [[f"{box['solids_fraction']:g}", f"{box['bed_phi']:.4f}", box["seed"], measured(box["p_bed"]),
                               measured(box["p_bed_by_balance"]), f"{box['p_bed'][0] / box['p_bed_by_balance'][0]:.3f}"] for box in boxes])


def bed_rows(table):
    head = ("mm/s", "phi", "p_bed by slabs", "by balance", "difference", "theta")
    return right_table(head, [[f"{1e3 * velocity:.3f}", f"{phi:.4f}", measured((slabs, slabs_error)), measured((balance, balance_error)),
                               f"{100 * (balance / slabs - 1):+.1f} %", f"{theta:.3g}"]
                              for (phi, slabs, slabs_error, balance, balance_error), velocity, theta in zip(rows(table), table["velocity"],
                                                                                                           table["theta_bed"])])
