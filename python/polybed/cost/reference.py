"""What the errors of a sweep are measured against."""

from polybed.cost.axes import setting
from polybed.cost.judge import FLOOR_FACTOR, carries, measure_errors, refine, scale_of, settings_text
from polybed.cost.runner import RunOrder
from polybed.cost.sweep import CANDIDATE, REFERENCE, Reference, Row, quantities_of_run
from polybed.study.measured import measured

FORMAL_ORDER = 2  # of the discretisation in space where nothing is sharp


def find_reference(sweeper):
    """Finds the reference of a sweep, or refuses it."""
    wanted = sweeper.sweep.options.reference
    if wanted == "exact":
        exact_reference(sweeper)
    elif wanted != "auto":
        take(sweeper.sweep, "directory", wanted, quantities_of_run(measured(wanted), sweeper.sweep.begin, sweeper.sweep.slabs))
    elif sweeper.sweep.chaotic:
        statistical_reference(sweeper)
    else:
        additive_reference(sweeper)


def take(sweep, kind, note, measured):
    """Makes the reference what a run has measured; its intervals are the bands, and so are the floors."""
    sweep.reference = Reference(kind, note, {name: mean.mean for name, mean in measured.values.items()}, directory=measured.directory)
    sweep.reference.band = {name: (mean.error or 0.0) / scale_of(sweep, name) for name, mean in measured.values.items()}
    sweep.reference.floor = dict(sweep.reference.band)


def exact_reference(sweeper):
    """The balance of forces on a bed of one species."""
    sweep = sweeper.sweep
    if sweeper.scene.is_tapered:
        return sweep.refuse("no exact value in a column that tapers: one is known of a uniform bed")
    found = sweeper.run(Row(RunOrder("force_balance"), REFERENCE, note="force balance"))
    if len(sweeper.scene.species) > 1 or not found.done or sweep.ranking not in found.measured.values:
        return sweep.refuse("no exact value of this quantity: one is known of the height and the pressure drop of a bed of one species "
                            "that is carried")
    take(sweep, "exact", "uniform expansion by the balance of forces", found.measured)


def statistical_reference(sweeper):
    """The longest and finest of what was run, and if it can be had a run three windows long on the finest grid."""
    sweep, grid = sweeper.sweep, sweeper.sweep.axis("grid")
    settings = dict(sweeper.centre)
    if grid:
        settings["grid"] = len(grid.levels) - 1
    order = sweeper.order_of(settings, (setting("run.until", 1.5 * sweeper.scene.of("run.until")),))
    found = sweeper.run(Row(order, REFERENCE, settings, "reference: finest and three windows long"), 0.6)
    for level in reversed(range(len(grid.levels) if grid else 0)):
        found = found if found.done else sweeper.row_on_line("grid", level) or found
    if not found.done:
        return
    take(sweep, "statistical", settings_text(sweep, found), found.measured)
    if found.kind == CANDIDATE:
        sweep.warnings.append("the reference is one of the runs that it ranks")


def other_family(sweeper, row):
    """An integrator of another family than the one that a run had."""
    if sweeper.sweep.options.model == "dem":
        return "dem.integrator=" + ("thesis" if sweeper.scene.of("dem.integrator") == "synchronised" else "synchronised")
    return "tfm.integrator=" + ("explicit" if "jacobian_products x unknowns" in row.outcome.counters else "implicit")


def additive_reference(sweeper):
    """Time by a run two levels beyond and one of another family, on the coarsest grid, whose errors in time are those of the others as far
    as errors add up; space by Richardson's value of the line of grids."""
    sweep = sweeper.sweep
    one = sweeper.run(Row(sweeper.tight(), REFERENCE, note="reference: tolerances tighter than all"))
    if not one.done:
        return
    two = sweeper.run(Row(sweeper.tight((other_family(sweeper, one),)), REFERENCE, note="reference by another integrator"))
    if not two.done:
        return sweep.refuse(f"no second integrator to check the reference by: {two.outcome.reason}")
    note = "tolerances two levels tighter than the tightest, checked by another kind of integrator"
    values = {name: mean.mean for name, mean in one.measured.values.items()}
    sweep.reference = reference = Reference("self", note, values, directory=one.measured.directory)
    for name, mean in two.measured.values.items():
        if name in reference.value:
            reference.floor[name] = FLOOR_FACTOR * abs(mean.mean - reference.value[name]) / scale_of(sweep, name)
    disagreement = reference.floor.setdefault(sweep.ranking, 0.0) / FLOOR_FACTOR
    if sweep.axis("grid"):
        add_space(sweeper, sweep.axis("grid"))
    if sweep.outcome != "done":
        return
    for row in sweep.rows:
        measure_errors(sweep, row)
    errors = [row.quantities[sweep.ranking].error for row in sweep.rows if row.kind == CANDIDATE and sweep.ranking in row.quantities]
    if not carries(disagreement, errors, sweep.options.target):
        sweep.refuse(f"no trustworthy reference: two kinds of integrator differ by {100 * disagreement:.2g} % in {sweep.ranking}")


def line_of_grids(sweeper, grid):
    """From the coarsest, which the reference was run on, without a gap."""
    line = []
    for level in range(len(grid.levels)):
        row = sweeper.row_on_line("grid", level)
        if row is None:
            break
        line.append(row)
        if not row.outcome.invariants_held:
            sweeper.sweep.warnings.append(f"grid {grid.levels[level].label}: an invariant exceeded its limit, and it is one of the grids "
                                          "of the reference")
    return line


def add_space(sweeper, grid):
    """Moves the reference from the grid it was run on to the limit of the line of grids."""
    sweep, line = sweeper.sweep, line_of_grids(sweeper, grid)
    if len(line) < 3:
        return sweep.refuse("no trustworthy reference: fewer than three grids were run within the budget; a larger --budget, or --axes "
                            "without grid for errors on one grid alone")
    reference, finest = sweep.reference, len(line) - 1
    reference.kind = "extrapolated"
    ratio = (grid.levels[finest - 2].value / grid.levels[finest].value) ** 0.5  # cells are whole: of 99 come 50, not 49.5
    for name in sorted(reference.value):
        if not all(name in row.measured.values for row in line[-3:]):
            continue
        refined = refine(*(row.measured.values[name].mean for row in line[-3:]), ratio, FORMAL_ORDER)
        reference.value[name] += refined.limit - line[0].measured.values[name].mean
        reference.band[name] = refined.band
        if name == sweep.ranking:
            tell_of_refinement(sweep, refined, len(line))
    reference.band = {name: band / scale_of(sweep, name) for name, band in reference.band.items()}
    reference.directory = line[-1].measured.directory
    band = reference.band.setdefault(sweep.ranking, 0.0)
    if band > 5 * sweep.options.target:
        sweep.refuse(f"not converging: the grids leave {sweep.ranking} uncertain by {100 * band:.2g} %")


def tell_of_refinement(sweep, refined, grids):
    if refined.note:
        sweep.warnings.append(f"grids: {refined.note}")
    if refined.order is not None:
        sweep.reference.note += f"; limit of {grids} grids by Richardson's extrapolation, order {refined.order:.2f}"
    elif refined.band > 0:
        sweep.reference.note += "; the grids do not converge evenly: the value of the finest, within three times half of their range"
