"""A sweep from its first run to its recommendation: lines, reference, front, attribution."""

from polybed.cost import attribution, front
from polybed.cost.axes import MACHINE, MODEL, NUMERICS, STATISTICS
from polybed.cost.judge import measure_distances, measure_errors, rank, settings_text
from polybed.cost.reference import find_reference
from polybed.cost.sweep import CANDIDATE
from polybed.cost.sweeper import Sweeper


def run_sweep(scene, options, runner):
    """Runs the sweep and returns it: one process that starts others."""
    sweeper = Sweeper(scene, options, runner)
    sweep = sweeper.sweep
    if not sweeper.find_regime():
        return sweep
    sweeper.run_lines(NUMERICS)
    sweeper.run_lines(STATISTICS)
    find_reference(sweeper)
    if not sweep.reference.kind and sweep.outcome == "done":
        sweep.refuse("no trustworthy reference")
    if sweep.outcome == "done":
        for row in sweep.rows:
            measure_errors(sweep, row)
        front.fit_laws(sweeper)
        front.run_front(sweeper)
    attribution.run_solver(sweeper)
    sweeper.run_lines(MODEL)
    attribution.run_inputs(sweeper)
    sweeper.run_lines(MACHINE)
    for row in sweep.rows:
        measure_errors(sweep, row)
    measure_distances(sweep)
    rank(sweep)
    front.compare_predictions(sweeper)
    attribution.attribute(sweeper)
    for row in sweep.rows:
        if row.kind == CANDIDATE and row.done and sweep.chaotic and row.measured.too_short:
            sweep.warnings.append(f"{settings_text(sweep, row)}: window too short for {row.measured.too_short}: fewer than 30 "
                                  "autocorrelation times")
    return sweep
