"""What names in cost.json are called on the screen and on the page."""

# status of a run
STATUS = {"pareto": "nothing cheaper is as accurate", "dominated": "another is cheaper and as accurate",
          "hollow": "too near the reference to be ranked", "model": "not ranked: model, data or solver differ",
          "predicted": "predicted, not run", "not run": "not run", "failed": "failed", "refused": "refused"}
# kind of the reference
REFERENCE = {"exact": "the force balance of a uniform bed", "self": "the same model, solved more exactly",
             "extrapolated": "the same model, solved more exactly, extrapolated to infinitely fine cells",
             "statistical": "the longest run on the finest grid", "directory": "a run that was given", "": "there is none"}
# parts of the error
PARTS = {"space": "size of the cells", "solver and coupling tolerance": "tolerance of the pressure solver or of the coupling to the fluid",
         "statistics": "fluctuations of the bed", "closure spread": "choice of drag law, stress or stiffness",
         "level": "choice of the model: force balance, 1-D, 2-D, particles"}
# what a sweep varies
AXES = {"rtol": "relative tolerance (tfm.rtol)", "grid": "cells", "steps": "steps per contact (dem.steps_per_contact)",
        "coupling": "steps of the particles in one of the fluid (dem.fluid_every)"}
CLOCKS = {"work": "counted work", "wall": "wall time"}


def in_words(axis, level):
    """A level of an axis: "relative tolerance (tfm.rtol) 0.001"."""
    return f"{AXES.get(axis, axis)} {level}"


def part(row):
    return PARTS.get(row, row)


def percent(share, error=None):
    """"0.4 ± 0.1 %"; a dash for what is not known."""
    if share is None:
        return "\u2013"
    return f"{100 * share:.2g}" + (f" \u00b1 {100 * error:.1g}" if error else "") + " %"
