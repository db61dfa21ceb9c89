"""Says which packages of the system are missing. Needs none itself."""

import contextlib
import sys

NO_FILE = 4  # of polybed's exit codes: a file, or a package, is missing


@contextlib.contextmanager
def needed(of_program):
    """Around imports: tells in a line which package the interpreter lacks, and what to do.

    of_program: whether the imports are those of `python3 -m polybed.MODULE`, which ends there; else ImportError is raised.
    """
    try:
        yield
    except ImportError as missing:
        if (missing.name or "polybed").startswith("polybed"):
            raise
        told = (f"Python's package {missing.name} is missing for {sys.executable}: apt-get install python3-numpy python3-h5py "
                "python3-matplotlib python3-scipy, and run /usr/bin/python3")
        if not of_program:
            raise ImportError(told, name=missing.name) from None
        print(told, file=sys.stderr)
        sys.exit(NO_FILE)
