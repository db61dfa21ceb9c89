"""Says which packages of the system are missing. Needs none itself."""

import contextlib
import sys

NO_FILE = 4  # of polybed's exit codes: a file, or a package, is missing


@contextlib.contextmanager
def needed(of_program):
    """Around imports: ends a program that lacks one with its name and what to do, in place of a trace.

    of_program: whether the imports are those of `python3 -m polybed.MODULE`, else the error is the caller's.
    """
    try:
        yield
    except ImportError as missing:
        if not of_program or (missing.name or "").startswith("polybed"):
            raise
        print(f"Python's package {missing.name} is missing: apt-get install python3-numpy python3-h5py python3-matplotlib",
              file=sys.stderr)
        sys.exit(NO_FILE)
