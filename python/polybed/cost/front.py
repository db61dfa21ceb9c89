"""The front that the lines predict, which is then run."""

import itertools
from math import inf, isfinite, log
from statistics import median

from polybed.cost.axes import NUMERICS
from polybed.cost.fit import Priced, fit_power_law, pareto_front
from polybed.cost.judge import distance_of
from polybed.cost.sweep import REFERENCE, Row

MOST_FRONT = 6  # runs of the predicted front


def line_error(sweeper, name, level):
    """What one axis alone contributes at a level: on the line of grids the distance from the reference; on another line, which lies on the
    coarsest grid, the distance from its own tightest run; infinite where the line was not run."""
    sweep, row = sweeper.sweep, sweeper.row_on_line(name, level)
    if row is None or not row.outcome.invariants_held:
        return inf
    if name == "grid":
        found = row.quantities.get(sweep.ranking)
        return inf if found is None else found.error
    tightest = sweep.find(sweeper.tight(), REFERENCE)
    tightest = tightest if tightest and tightest.done and not sweep.chaotic else None
    for finest in reversed(range(len(sweep.axis(name).levels))):
        tightest = tightest or sweeper.row_on_line(name, finest)
    distance = distance_of(sweep, row, tightest)
    return inf if distance is None else distance


def fit_laws(sweeper):
    """Error and cost along the lines as power laws of the tolerance and of the spacing."""
    for name in ("rtol", "grid"):
        axis = sweeper.sweep.axis(name)
        rows = [(level, sweeper.row_on_line(name, level)) for level in range(len(axis.levels) if axis else 0)]
        run = [(axis.levels[level].value, line_error(sweeper, name, level), row.rate) for level, row in rows if row]
        values, errors, costs = zip(*run) if run else ((), (), ())
        sweeper.sweep.laws |= {f"error_of_{name}": fit_power_law(values, errors), f"cost_of_{name}": fit_power_law(values, costs)}


def predicted(sweeper):
    """All settings of the numerical axes, the others as in the centre, with their errors, which add by their squares, and their costs,
    which multiply by their ratios."""
    axes = [axis for axis in sweeper.sweep.axes if axis.kind == NUMERICS]
    centre = sweeper.centre_row.rate

    def cost(name, level):
        row = sweeper.row_on_line(name, level)
        return row.rate / centre if row and centre > 0 else 1.0
    lines = [[(axis.name, level, line_error(sweeper, axis.name, level), cost(axis.name, level)) for level in range(len(axis.levels))]
             for axis in axes]
    for point in itertools.product(*lines):
        square, price = 0.0, centre
        for _, _, error, ratio in point:
            square, price = square + error**2, price * ratio
        yield sweeper.centre | {name: level for name, level, _, _ in point}, Priced(square**0.5, price)


def run_front(sweeper):
    """Runs the front of what is predicted, nearest the target first."""
    points = list(predicted(sweeper))
    front = [points[n] for n in pareto_front([priced for _, priced in points]) if isfinite(points[n][1].error)]
    front.sort(key=lambda point: abs(log(max(point[1].error, 1e-12) / sweeper.sweep.options.target)))
    for settings, priced in front[:MOST_FRONT]:
        sweeper.run(Row(sweeper.order_of(settings), settings=settings, predicted=priced))


def compare_predictions(sweeper):
    """Median, over the front that was run, of how far the additive model was off: of settings that differ from the centre on more than one
    axis, as those on a line are not predicted but known."""
    sweep, off = sweeper.sweep, []
    floor = sweep.reference.floor.get(sweep.ranking, 0.0)
    for row in sweep.rows:
        quantity = row.quantities.get(sweep.ranking)
        changed = sum(level != sweeper.centre[name] for name, level in row.settings.items())
        if row.predicted and row.done and changed >= 2 and quantity is not None and quantity.error > max(floor, 0.0):
            off.append(abs(row.predicted.error - quantity.error) / quantity.error)
    if off:
        sweep.additive_off = median(off)
