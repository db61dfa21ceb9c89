"""Runs polybed, reads what its runs hold, and draws it. It computes no physics."""

import sys

from polybed.packages import needed
from polybed.version import __version__

with needed(sys.argv[:1] == ["-m"]):  # what Python calls a program that it still looks for
    from polybed.files import FormatError, ReplacedError
    from polybed.particles import Particles
    from polybed.program import ProgramError, calibrate, compare, inversion, run, sweep
    from polybed.quantities import Quantity
    from polybed.read import Run, read
    from polybed.solids_table import SolidsTable, read_table

__all__ = ["FormatError", "Particles", "ProgramError", "Quantity", "ReplacedError", "Run", "SolidsTable", "__version__", "calibrate", "compare",
           "inversion", "read", "read_table", "run", "sweep"]
