"""The front that the lines of a sweep predict, which is then run, and what the error of the sweep is made of."""

import itertools
from math import inf, isfinite, log
from statistics import median

from polybed.cost.axes import NUMERICS, acting_axes, setting
from polybed.cost.judge import distance_of, fit_power_law, pareto_front, scale_of
from polybed.cost.sweep import INPUT, MODEL, REFERENCE, SOLVER, Priced, Row, Share, in_words

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
    """All settings of the numerical axes, the others as in the centre, with errors added by squares and costs multiplied by ratios."""
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
    """Runs the predicted front, nearest the target first."""
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


def run_solver(sweeper):
    """The linear solver's tolerance a hundredth, or the particles' coupling to the fluid eight times as often."""
    scene = sweeper.scene
    if sweeper.sweep.options.model == "tfm":
        given = scene.of("tfm.pressure_tolerance", min(1e-4, 0.1 * scene.of("tfm.rtol")))
        sweeper.run_with(SOLVER, "pressure solved 100 times as exactly", setting("tfm.pressure_tolerance", given / 100))
    elif scene.has_fluid:
        sweeper.run_with(SOLVER, "fluid solved 8 times as often", f"dem.fluid_every={max(1, scene.of('dem.fluid_every', 16) // 8)}")


def run_inputs(sweeper):
    """The case with one of its data changed by what they are usually known to."""
    scene = sweeper.scene
    temperature, viscosity = scene.of("fluid.temperature"), scene.of("fluid.viscosity")
    if temperature is not None:
        sweeper.run_with(INPUT, "temperature + 1 K", f"{setting('fluid.temperature', temperature + 1)} K")
    elif viscosity is not None:
        sweeper.run_with(INPUT, "viscosity - 2.5 % (1 K of water)", setting("fluid.viscosity", 0.975 * viscosity))
    for species in [] if "size_classes" in scene.needs else scene.keys["species"]:
        for key in ("diameter", "density"):
            name = species["name"]
            sweeper.run_with(INPUT, f"{key} of {name} + 1 %", setting(f"species.{name}.{key}", 1.01 * species[key]))


def not_run(sweeper, row, axes):
    """A row that nothing has measured, with those of some axes that would."""
    return Share(row, note="not run", axes=[name for name in acting_axes(sweeper.scene, sweeper.sweep.options.model) if name in axes])


def of_line(sweeper, row, names):
    """The error of the case as given on the lines of these axes."""
    sweep, share = sweeper.sweep, not_run(sweeper, row, names)
    for axis in filter(None, map(sweep.axis, names if sweep.outcome == "done" else ())):
        error = line_error(sweeper, axis.name, axis.given)
        if isfinite(error):
            share = Share(row, max(error, share.value or 0.0), in_words(axis.name, axis.levels[axis.given].label))
    return share


def of_models(sweeper, row, names):
    """The largest distance from the centre on the lines of these axes."""
    sweep, share = sweeper.sweep, Share(row)
    for other in sweep.rows:
        for axis in filter(None, map(sweep.axis, names if other.kind == MODEL else ())):
            if other.settings[axis.name] == sweeper.centre[axis.name]:
                continue
            distance = distance_of(sweep, other, sweeper.centre_row)
            if distance is not None and (share.value is None or distance > share.value):
                share = Share(row, distance, axis.levels[other.settings[axis.name]].label)
    return not_run(sweeper, row, names) if share.value is None else share


def of_statistics(sweeper):
    sweep, row = sweeper.sweep, "statistics"
    if not sweep.chaotic:
        return Share(row, note="steady: nothing fluctuates, the mean is the same every time")
    mean = sweeper.centre_row.measured.values.get(sweep.ranking)
    value = mean.error / scale_of(sweep, sweep.ranking) if mean and mean.error is not None else None
    return Share(row, value, "95 % interval of one window")


def of_input(row, given, ranking, distance):
    """The change by a datum, of a height by the centre of all solids, which a uniform bed raises in proportion: slabs show a small step of its
    sharp top as half to twice as large."""
    a, b = row.measured.centre, given.measured.centre
    if ranking != "bed_height" or not (distance is not None and a and b):
        return Share(row.note, distance)
    return Share(row.note, abs(a / b - 1), "by the centre of the solids: slabs do not resolve a small step of the top")


def attribute(sweeper):
    """Always six rows; the inputs below them."""
    sweep = sweeper.sweep
    solver = Share("solver and coupling tolerance", note="not run")
    for row in sweep.rows:
        distance = distance_of(sweep, row, sweeper.centre_row)
        if row.kind == SOLVER and distance is not None:
            solver = Share(solver.row, distance, row.note)
        if row.kind == INPUT:
            sweep.inputs.append(of_input(row, sweeper.centre_row, sweep.ranking, distance))
    sweep.attribution = [of_line(sweeper, "time integration", ("rtol", "steps")), of_line(sweeper, "space", ("grid",)), solver,
                         of_statistics(sweeper), of_models(sweeper, "closure spread", ("drag", "effects", "stiffness")),
                         of_models(sweeper, "level", ("level",))]
