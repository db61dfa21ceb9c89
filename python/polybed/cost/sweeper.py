"""The course of a sweep: its runs, and the time that they can take."""

import numpy as np

from polybed.cost.axes import MODEL, NUMERICS, axes_of, setting
from polybed.cost.judge import settings_text
from polybed.cost.runner import RunOrder, RunOutcome
from polybed.cost.sweep import CANDIDATE, TWIN, Row, Sweep, quantities_of, quantities_of_run
from polybed.ending import WRONG_CASE, StudyError
from polybed.study.measured import ROUNDING, TimeMean, centre_column, species_of
from polybed.study.output import remark

WINDOW_BEGIN = 0.75  # of the run: the last quarter
OVERDRAFT = 1.08  # of the budget, which is kept to a tenth
PROFILES, HISTORY_ROWS = 40, 800  # of a run, a quarter of them in the window
MUCH_DEARER = 1e3  # than a continuum particles are taken to be
PARTED, CONSTANT = 1e-2, 1e-9  # shares of what a signal varies by, of its mean


def common_overrides(scene):
    """Overrides of every run of a sweep, so that all store the same."""
    until = scene.of("run.until")
    return [setting("output.every", until / PROFILES), setting("output.history_every", until / HISTORY_ROWS),
            setting("output.checkpoint_every", until)]


def checked_quantities(options, known, species):
    """The quantities asked for, or those by default. Raises StudyError for one that is unknown, or that cannot rank."""
    for name in options.quantities:
        if name not in known:
            raise StudyError(WRONG_CASE, f"--qoi {name}: no such quantity of this case")
    found = options.quantities or ["bed_height", *(["centre_difference"] if len(species) > 1 else [])]
    if found[0] in ("profile", "composition"):
        raise StudyError(WRONG_CASE, f"--qoi {found[0]}: a distance from the reference has no uncertainty to rank by; name another "
                                     "quantity first")
    return found


def is_chaotic(signal, twin):
    """Whether two runs that differ by 1e-10 part by more than a hundredth of what the signal varies by. What is constant to 1e-9 of its
    mean is steady. signal, twin: the same quantity at the same times"""
    count = min(len(signal), len(twin))
    if count < 2:
        return False
    signal, twin = np.asarray(signal[:count]), np.asarray(twin[:count])
    deviation, distance = signal.std(), np.abs(signal - twin).max()
    return bool(deviation > CONSTANT * abs(signal.mean()) and distance > PARTED * deviation)


class Sweeper:
    """Runs the rows of a sweep, each once, within its budget. centre: settings from which each axis is varied, on the coarsest grid."""

    def __init__(self, scene, options, runner):
        self.scene, self.runner, self.sweep = scene, runner, Sweep(options)
        self.sweep.quantities = quantities_of(scene.species)
        self.sweep.axes = axes_of(scene, options.model, options.axes)
        self.sweep.begin, self.sweep.slabs = WINDOW_BEGIN * scene.of("run.until"), scene.cells[1]
        options.quantities = checked_quantities(options, [q.id for q in self.sweep.quantities], scene.species)
        self.centre = {axis.name: 0 if axis.name == "grid" else axis.given for axis in self.sweep.axes}
        self.centre_row = None

    def tell(self, text):
        if not self.sweep.options.quiet:
            remark(f"{self.runner.spent:7.1f} s  {text}")

    def left(self):
        return OVERDRAFT * self.sweep.options.budget - self.runner.spent

    def order_of(self, settings, more=()):
        levels = [axis.levels[settings[axis.name]] for axis in self.sweep.axes]
        model = [self.sweep.options.model, *(level.model for level in levels if level.model)][-1]
        overrides = [override for level in levels for override in level.overrides]
        return RunOrder(model, (*overrides, *more))

    def row_on_line(self, name, level):
        """The candidate at a level of an axis, the others as in the centre; None if it was not run to its end."""
        row = self.sweep.find(self.order_of(self.centre | {name: level}), CANDIDATE)
        return row if row and row.done else None

    def grid_ratio(self, grid, level):
        """From the next coarser grid, if that was run, in proportion to the cells; else as if a step followed the cells, too."""
        powers, values = len(self.scene.cells), [one.value for one in grid.levels]
        coarser = self.row_on_line("grid", level - 1) if level > self.centre["grid"] else None
        if coarser:
            return coarser.outcome.wall / self.centre_row.outcome.wall * (values[level - 1] / values[level]) ** powers
        return (values[self.centre["grid"]] / values[level]) ** (powers + 0.5)

    def axis_ratio(self, axis, level):
        """Expected time of a level of an axis over that of the centre: from its line if it was run, else by powers that are not exceeded."""
        row = self.row_on_line(axis.name, level)
        if row:
            return row.outcome.wall / self.centre_row.outcome.wall
        if axis.name == "grid":
            return self.grid_ratio(axis, level)
        if axis.name == "steps":
            return axis.levels[level].value / axis.levels[self.centre[axis.name]].value
        return MUCH_DEARER if axis.levels[level].model == "dem" else 1.0

    def expected_wall(self, settings):
        if self.centre_row is None or not settings:
            return 0.0
        wall = self.centre_row.outcome.wall
        for axis in self.sweep.axes:
            if settings[axis.name] != self.centre[axis.name]:
                wall *= self.axis_ratio(axis, settings[axis.name])
        return wall

    def balance_forces(self, row):
        """Height by the balance of forces on a uniform bed, measured on the slabs of the case as in a run: no run."""
        height = self.scene.needs["dt_limits"]["expanded"]["bed_height_m"]
        row.outcome = RunOutcome("refused", "the fluid carries a lone particle away") if height is None else RunOutcome("done")
        row.outcome.cpu, row.outcome.simulated = self.scene.seconds, self.scene.of("run.until")
        row.measured.values["pressure_drop"] = TimeMean(1.0)
        if height is not None:
            row.measured.values["bed_height"] = TimeMean(height)

    def run(self, row, most=1.0):
        """Runs an order that is not among the rows yet; returns its row. most: share of the budget that it is allowed"""
        sweep = self.sweep
        known = sweep.find(row.order, row.kind)
        if known:
            known.predicted = row.predicted or known.predicted
            return known
        expected = self.expected_wall(row.settings)
        if row.order.model == "force_balance":
            self.balance_forces(row)
        elif expected > most * max(0.0, sweep.options.budget - self.runner.spent):
            row.outcome = RunOutcome("not run", f"expected to take {expected:.3g} s, beyond the budget")
        else:
            row.outcome = self.runner.run(row.order, self.left())
        if row.done and not row.outcome.invariants_held:
            row.outcome.reason = "an invariant exceeded its limit"
        if row.outcome.measured:
            row.measured = quantities_of_run(row.outcome.measured, sweep.begin, sweep.slabs)
        row.outcome.measured = None
        row.rate = row.outcome.rate(sweep.options.clock)
        reason = f" ({row.outcome.reason})" if row.outcome.reason else ""
        self.tell(f"{settings_text(sweep, row)}: {row.outcome.state}{reason}")
        sweep.rows.append(row)
        return row

    def run_with(self, kind, note, override):
        self.run(Row(self.order_of(self.centre, (override,)), kind, self.centre, note))

    def find_regime(self):
        """Runs the centre, and again with gravity changed by 1e-10: whether they part. False if the first run did not reach its end."""
        sweep, order = self.sweep, self.order_of(self.centre)
        first = self.runner.run(order, self.left())
        history = first.measured.history if first.done else None
        self.centre_row = self.run(Row(order, settings=self.centre))
        if not first.done:
            sweep.outcome, sweep.reason = "refused" if first.state == "not run" else "failed", f"the first run: {first.reason}"
            return False
        order = self.order_of(self.centre, (setting("column.gravity", self.scene.of("column.gravity") * (1 + 1e-10)),))
        second = self.runner.run(order, self.left())
        twin = second.measured.history if second.done else None
        self.run(Row(order, TWIN, self.centre, "again with gravity (1 + 1e-10)"))
        if not second.done:
            sweep.warnings.append("taken to be steady: the run that would tell, with gravity (1 + 1e-10), was not done")
            return True
        columns = ["bed_height_m", *map(centre_column, species_of(history))]
        if any(is_chaotic(*(h[column][h["time_s"] >= sweep.begin * (1 - ROUNDING)] for h in (history, twin))) for column in columns):
            sweep.regime = "chaotic"
        self.tell(sweep.regime)
        return True

    def run_lines(self, kind):
        """Each axis of a kind by itself."""
        for axis in self.sweep.axes:
            for level in range(len(axis.levels)) if axis.kind == kind else ():
                settings = self.centre | {axis.name: level}
                other = kind == MODEL and level != self.centre[axis.name]  # no better or worse numerics
                self.run(Row(self.order_of(settings), kind if other else CANDIDATE, settings), 0.5 if kind == MODEL else 1.0)

    def tight(self, more=()):
        """Two levels beyond the finest on each numerical axis but the grid, with more settings on top."""
        overrides = []
        for axis in self.sweep.axes:
            numeric = axis.kind == NUMERICS
            level = axis.levels[self.centre[axis.name] if numeric else axis.given]
            if numeric and axis.name != "grid" and axis.beyond:
                level = axis.beyond[-1]
            overrides += level.overrides
        if self.sweep.options.model == "tfm" and self.sweep.axis("rtol") is None:
            overrides.append("tfm.rtol=1e-7")
        return RunOrder(self.sweep.options.model, (*overrides, *more))
