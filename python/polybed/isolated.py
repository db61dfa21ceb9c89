"""Runs main() of a module of this package, as the program does, so that nothing in the working directory is imported, run or read as
settings. Its exit codes are those of polybed: 0 done, 2 the command is wrong, 4 a file or a package is missing, ...

    /usr/bin/python3 -I .../polybed/isolated.py polybed.plot ARGUMENTS...

-I keeps Python itself from the working directory and from the environment's PYTHONPATH.
"""

import importlib.util
import os
import sys
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


class MatplotlibFromPackage:
    """Imports matplotlib in this folder: it reads a matplotlibrc of the working directory, which can name programs to run."""

    @classmethod
    def find_spec(cls, name, path=None, target=None):
        if name != "matplotlib":
            return None
        sys.meta_path.remove(cls)
        spec = importlib.util.find_spec(name)
        if spec is not None:
            spec.loader.exec_module = lambda module, run=spec.loader.exec_module: in_package(run, module)
        return spec


def in_package(run, module):
    here = os.open(".", os.O_PATH)
    os.chdir(PACKAGE)
    try:
        run(module)
    finally:
        os.fchdir(here)
        os.close(here)


if __name__ == "__main__":
    module, sys.argv = sys.argv[1], ["-m", *sys.argv[2:]]  # as Python's own -m leaves it while it imports the package
    sys.path.insert(0, str(PACKAGE.parent))
    sys.meta_path.insert(0, MatplotlibFromPackage)
    os.environ["MPLBACKEND"] = "Agg"  # a notebook exports one that this interpreter can lack
    from polybed.packages import needed
    with needed(True):
        main = importlib.import_module(module).main
    sys.exit(main())
