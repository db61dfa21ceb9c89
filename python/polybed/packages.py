"""What each program of this package begins with: names missing packages and prints nothing that acts on a terminal. Needs none."""

import contextlib
import re
import sys

DONE, WRONG_CASE, NUMBERS, FILE, MPI, STOPPED = 0, 2, 3, 4, 5, 130  # exit codes of polybed; FILE: a file, or a package, is missing
CONTROL = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")


def plain(text):
    """A text fit for a terminal: control characters, except line ends and tabs, and marks that turn the direction of writing are
    shown by their escapes, as core/print.hpp has it. Titles, names and keys of a file act on no terminal."""
    return CONTROL.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


@contextlib.contextmanager
def needed(of_program):
    """Around imports: names a package that the interpreter lacks, and what to do. of_program: of `python3 -m polybed.MODULE`, which ends
    there; else ImportError is raised."""
    for stream in (sys.stdout, sys.stderr) if of_program else ():  # all is plain that this process prints from now on
        if stream is not None and "write" not in vars(stream):
            stream.write = lambda text, write=stream.write: write(plain(text))
    try:
        yield
    except ImportError as missing:
        if (missing.name or "polybed").startswith("polybed"):
            raise
        package = missing.name.partition(".")[0]
        told = (f"Python's package {package} is missing for {sys.executable}: apt-get install python3-{package}, which /usr/bin/python3 sees, "
                f"or, in an environment of your own, pip install {package}")
        if not of_program:
            raise ImportError(told, name=missing.name) from None
        print(told, file=sys.stderr)
        sys.exit(FILE)
