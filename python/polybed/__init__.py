"""Runs polybed, reads what its runs hold, and draws it. It computes no physics.

Functions have the names of the commands. Numbers that go in are in SI units, or texts with their unit ("30 mm/s"); what comes out says its
unit. A command that fails raises ProgramError with the program's message and exit code.
"""

import importlib
import sys

from polybed.packages import needed
from polybed.version import __version__

# Packages of the name of a function below: imported first, they do not take its place when one of their modules is imported.
importlib.import_module("polybed.cost")
importlib.import_module("polybed.fit")

with needed(sys.argv[:1] == ["-m"]):  # what Python calls a program that it still looks for
    from polybed.checks import Check
    from polybed.errors import show
    from polybed.files import FormatError, ReplacedError
    from polybed.particles import Particles
    from polybed.program import ProgramError, calibrate, case, check, compare, inversion, run, sweep
    from polybed.quantities import Quantity
    from polybed.read import Run, read
    from polybed.solids_table import SolidsTable, read_table
    from polybed.studies import cost, fit, measure, table

if sys.excepthook is sys.__excepthook__:  # nobody else has chosen how errors are shown
    sys.excepthook = show


def __getattr__(name: str) -> object:
    if name == "plot":  # needs Matplotlib
        return importlib.import_module("polybed.plot")
    raise AttributeError(f"module 'polybed' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, "plot"]


__all__ = ["Check", "FormatError", "Particles", "ProgramError", "Quantity", "ReplacedError", "Run", "SolidsTable", "__version__", "calibrate",
           "case", "check", "compare", "cost", "fit", "inversion", "measure", "read", "read_table", "run", "sweep", "table"]
