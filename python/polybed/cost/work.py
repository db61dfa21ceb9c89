"""What a run has done, weighed: a clock that gives the same time on every run and every machine."""

VERSION = 1  # of the weights: numbers weighed by other versions are not to be compared
# ns each, fitted on 2026-11-21 to the timers of system B's strip by both integrators and by particles, of glass in air and of a bed that
# settles without a fluid. A change of one of them is a new version. What has none, such as the steps, does not count.
WEIGHTS = {"rhs_evaluations x unknowns": 23, "pressure_iterations x unknowns": 8, "jacobian_products x unknowns": 90, "particle_steps": 15,
           "pair_checks": 4, "contact_evaluations": 25, "candidates": 7, "particle_steps in the fluid": 38, "fluid_steps": 2e5,
           "fluid_steps x particles": 300, "fluid_iterations x cells": 60}


def counters_of(record, cells):
    """Counters of a run's record by the names of run.json; those that grow with the case are multiplied by its size.

    cells: of the fluid of a run of particles
    """
    work = record["work"]
    if record["model"] == "tfm":
        unknowns = record["unknowns"]
        # An explicit step solves for the pressure; an implicit one multiplies by the Jacobian in each Krylov iteration.
        iterations = "pressure_iterations" if work["pressure_solves"] > 0 else "jacobian_products"
        return {"steps": work["steps"], "rejected_steps": work["rejected_steps"],
                "rhs_evaluations x unknowns": unknowns * work["rhs_evaluations"],
                f"{iterations} x unknowns": unknowns * work["linear_iterations"]}
    counters = {name: work[name] for name in ("steps", "particle_steps", "pair_checks", "candidates")}
    counters["contact_evaluations"] = work["contact_steps"]
    if "fluid" in record:
        fluid = record["fluid"]
        counters |= {"particle_steps in the fluid": work["particle_steps"], "fluid_steps": fluid["steps"],
                     "fluid_steps x particles": record["particles"] * fluid["steps"],
                     "fluid_iterations x cells": cells * fluid["iterations"]}
    return counters


def weighed(counters):
    """Sum of the counters with their weights, s."""
    return sum(1e-9 * WEIGHTS[name] * counters[name] for name in sorted(counters) if name in WEIGHTS)
