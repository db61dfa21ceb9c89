"""Points that a table was not fitted to, run and compared with it."""

import math

from polybed.calibration.boxes import Point
from polybed.tables import right_table

SEED = 1001  # one that no plan has


def points_between(table, binary):
    """Three points between the knots of a table: the middle of its first, middle and last distance in phi; of a wet table between two
    Stokes numbers, in the logarithm; of the other axes the first knot."""
    phi, stokes = list(map(float, table["phi"])), list(map(float, table["stokes"]))
    half = (len(stokes) - 1) // 2
    middle = math.sqrt(stokes[half] * stokes[half + 1]) if len(stokes) > 1 else stokes[0]
    gaps = sorted({0, (len(phi) - 1) // 2, len(phi) - 2})
    first = (float(table[name][0]) for name in ("e", "mu_p", "x2"))
    place = (middle, *first, binary, False, SEED)
    return [Point(table.attributes["regime"], 0.5 * (phi[gap] + phi[gap + 1]), *place) for gap in gaps]


def deviation(box, ratios, inertia):
    """(box over table, less 1; standard error of both together, relative) of p and of mu. ratios: p, p one standard error up, mu, mu
    likewise, as a run reads the table; inertia: its lambda"""
    found = []
    for name, mean, up in (("p_ratio", *ratios[:2]), ("mu_ratio", *ratios[2:])):
        table = (1 + inertia * box["stokes"]) * mean
        found.append((box[name][0] / table - 1, math.hypot(box[name][1] / table, up / mean - 1)))
    return found


def deviation_lines(points, deviations):
    """For people, with how many standard errors each is."""
    def told(off, error):
        return f"{100 * off:+.1f} % +- {100 * error:.1f} ({abs(off) / error if error else math.inf:.1f} se)"

    head = ("phi", "St", "p, box over table", "mu, box over table")
    return right_table(head, [[f"{point.phi:.4g}", f"{point.stokes:.4g}", told(*p), told(*mu)] for point, (p, mu) in zip(points, deviations)])
