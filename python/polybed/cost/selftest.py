"""The tests of cost that need no run, for `polybed cost selftest`. `polybed-hard` computes the parts that test the program itself:
intervals of means, both integrators, and the counting of particles into slabs."""

import json
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from polybed.cost.fit import fit_power_law
from polybed.cost.judge import carries
from polybed.cost.refinement import refine
from polybed.cost.sweeper import is_chaotic
from polybed.runner import call
from polybed.ending import answer

SLAB = 2e-3  # m, of the layers that polybed-hard measures


class Oracle(NamedTuple):
    id: str
    found: str
    wanted: str
    passed: bool


def near(found, wanted, by):
    return found is not None and abs(found - wanted) <= by


def k1():
    """The grid convergence index by numbers known to all digits."""
    r = refine(0.961780, 0.968540, 0.970500)
    good = (near(r.order, 1.786170, 5e-7) and near(r.limit, 0.9713003, 5e-8) and near(100 * r.fine_index, 0.103083, 5e-7) and
            near(100 * r.coarse_index, 0.356249, 5e-7) and near(r.asymptotic, 0.997980, 5e-7))
    found = (f"p {r.order:.6f}, limit {r.limit:.7f}, GCI {100 * r.fine_index:.6f} % and {100 * r.coarse_index:.6f} %, "
             f"ratio {r.asymptotic:.6f}")
    return Oracle("K1", found, "p 1.786170, limit 0.9713003, GCI 0.103083 % and 0.356249 %, ratio 0.997980", good)


def k2(coverage):
    """How often the interval of a mean contains the true mean: autoregressive series of mean 0."""
    share = 100 * coverage
    return Oracle("K2", f"covers in {share:.1f} %", "93 to 97 %", 93 <= share <= 97)


def k3():
    """A solver of error 0.8 h^2: the spacing at which it errs by 1 %."""
    h = np.array([0.4, 0.2, 0.1])
    found = fit_power_law(h, 0.8 * h * h).inverse(0.01)
    wanted = (0.01 / 0.8) ** 0.5
    return Oracle("K3", f"h {found:.5f}", f"{wanted:.5f} within 5 %", near(found, wanted, 0.05 * wanted))


def k4(settling):
    """A particle settles: the error of both integrators must fall with the work at their order."""
    slopes = []
    for name in ("explicit", "implicit"):
        law = fit_power_law(*zip(*((run["steps"], run["error"]) for run in settling[name])))
        slopes.append(-law.exponent if law else 0.0)
    found = f"error falls with steps to the power {slopes[0]:.2f}, explicit, and {slopes[1]:.2f}, implicit by its tolerance"
    return Oracle("K4", found, "3 and 2 within 0.2", near(slopes[0], 3, 0.2) and near(slopes[1], 2, 0.2))


def k5():
    """A reference whose two families disagree."""
    errors = [0.05, 0.02, 0.004]
    loose, tight = carries(0.01, errors, 0.01), carries(1e-5, errors, 0.01)
    word = {True: "taken", False: "refused"}
    return Oracle("K5", f"disagreement 1 %: {word[loose]}, 0.001 %: {word[tight]}", "refused, taken", tight and not loose)


def lorenz(_, y):
    return 10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - 8 / 3 * y[2]


def damped(_, y):
    return y[1], -y[0] - 0.2 * y[1], 0.0


def course(rate, push):
    """First component of a system in time, at every 0.01 up to 50."""
    return solve_ivp(rate, (0, 50), (1 + push, 1.0, 1.0), t_eval=np.arange(1, 5001) / 100, rtol=1e-8).y[0]


def k7():
    """A chaotic system is told from one that is not."""
    first, second = (is_chaotic(course(rate, 0.0), course(rate, 1e-10)) for rate in (lorenz, damped))
    word = {True: "chaotic", False: "steady"}
    return Oracle("K7", f"Lorenz {word[first]}, damped {word[second]}", "chaotic, steady", first and not second)


def k12():
    """A sequence of grids that oscillates."""
    r = refine(1.0, 1.2, 1.1)
    return Oracle("K12", r.note if r.fine_index is None else "an index", "no index", r.fine_index is None and r.coarse_index is None)


def k13(heights):
    """The height of a bed of two layers, the lower one twice as dense, is that of its top."""
    found = heights[0] or 0.0
    return Oracle("K13", f"bed_height {found:.4f} m", "0.16 m within half a slab, not 0.06 m", near(found, 0.16, SLAB / 2))


def k14(measures, composition):
    """One profile given as cells and as particles counted into slabs by their exact parts."""
    def apart(name):
        cells, counted = measures[name]
        return 1.0 if cells is None or counted is None else abs(cells - counted)
    height, centre, interface, mixing = map(apart, ("bed_height", "centre_b", "interface", "mixing"))
    order = 1.0 if composition is None else composition
    good = max(height, centre, interface) < SLAB and max(mixing, order) < 0.02
    found = f"height {height:.1e}, centre {centre:.1e}, interface {interface:.1e} m, mixing {mixing:.1e}, composition {order:.1e}"
    return Oracle("K14", found, "lengths within a slab, 2e-3 m, shares within a slice of 50", good)


def oracles():
    """K1 to K7 and K12 to K14 of the specification of cost; the others need runs."""
    computed = json.loads(call("stability", "--oracles"))
    measures = computed["measures"]
    return [k1(), k2(computed["coverage"]), k3(), k4(computed["settling"]), k5(), k7(), k12(), k13(measures["bed_height"]),
            k14(measures, computed["composition"])]


def print_selftest():
    """All of them, as a table; whether all pass."""
    found = oracles()
    answer("\n".join(f"{o.id:4} {'passes' if o.passed else 'FAILS':6} {o.found}\n            wanted: {o.wanted}" for o in found))
    return all(o.passed for o in found)
