#!/usr/bin/python3
"""Ten exponentials that fit 1/sqrt(t) for 1 <= t <= 1e5 with the least greatest relative error: basset_tail_fitted.

Start: the midpoint rule of 1/sqrt(t) = (2/sqrt(pi)) int_0^inf exp(-t x^2) dx in log x. Then linear programs: the change
of rates and factors, within a trust region, that makes the greatest linearised error least. The best fit of 20 numbers
has 21 equal extremes of alternating sign, which is checked. Wants NumPy and SciPy; takes half a minute. Prints t_i and a_i of
a_i sqrt(e/t_i) exp(-t/(2 t_i)), and the greatest relative error.
"""
import numpy
from scipy.optimize import linprog

REACH, COUNT, POINTS = 1e5, 10, 1500
t = numpy.logspace(0, numpy.log10(REACH), POINTS)


def terms(p):
    return numpy.exp(p[COUNT:] - numpy.outer(t, numpy.exp(p[:COUNT]))) * numpy.sqrt(t)[:, None]


def error(p):
    return terms(p).sum(1) - 1


def slopes(p):
    each = terms(p)
    return numpy.hstack([-each * numpy.outer(t, numpy.exp(p[:COUNT])), each])


def best_fit():
    x = numpy.linspace(numpy.log(0.3 / numpy.sqrt(REACH)), numpy.log(1.6), COUNT)
    p = numpy.concatenate([2 * x, numpy.log(2 / numpy.sqrt(numpy.pi) * (x[1] - x[0])) + x])  # log of rate, of factor
    reach = 0.3
    while reach > 1e-9:
        e, a, one = 1e3 * error(p), 1e3 * slopes(p), numpy.ones((POINTS, 1))
        change = linprog([0] * 2 * COUNT + [1], A_ub=numpy.block([[a, -one], [-a, -one]]), b_ub=numpy.r_[-e, e],
                         bounds=[(-reach, reach)] * 2 * COUNT + [(0, None)], method="highs").x[:-1]
        better = abs(error(p + change)).max() < abs(error(p)).max()
        p, reach = (p + change, 1.3 * reach) if better else (p, 0.3 * reach)
    return p


if __name__ == "__main__":
    p = best_fit()
    e = error(p)
    turns = [n for n in range(1, POINTS - 1) if (e[n] - e[n - 1]) * (e[n + 1] - e[n]) < 0]
    extremes = e[[0, *turns, -1]]
    assert len(extremes) == 2 * COUNT + 1 and abs(extremes).min() > 0.999 * abs(extremes).max(), extremes
    time = 1 / (2 * numpy.exp(p[:COUNT]))
    for pair in sorted(zip(time, numpy.exp(p[COUNT:]) / numpy.sqrt(numpy.e / time))):
        print("%.13g %.13g" % pair)
    print(f"greatest relative error {abs(e).max():.4e}")
