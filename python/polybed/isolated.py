"""Starts a module of this package as the program does, so that nothing in the working directory is imported, run or read as settings.

    /usr/bin/python3 -I .../polybed/isolated.py polybed.plot ARGUMENTS...

-I keeps Python itself from the working directory and from the environment's PYTHONPATH.
"""

import os
import runpy
import sys
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


def import_matplotlib():
    """Imports it from this folder: it reads a matplotlibrc of the working directory, and that may name programs to run."""
    here = os.open(".", os.O_PATH)
    os.chdir(PACKAGE)
    try:
        import matplotlib  # noqa: F401
    finally:
        os.fchdir(here)
        os.close(here)


if __name__ == "__main__":
    module, sys.argv = sys.argv[1], ["-m", *sys.argv[2:]]  # as Python's own -m leaves it while it imports the package
    sys.path.insert(0, str(PACKAGE.parent))
    os.environ["MPLBACKEND"] = "Agg"  # a notebook exports one that this interpreter may not have
    from polybed.packages import needed

    if not module.startswith("polybed.study."):  # a study imports it if it draws
        with needed(True):
            import_matplotlib()
    runpy.run_module(module, run_name="__main__", alter_sys=True)
