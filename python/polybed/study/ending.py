"""How a command that is a study ends: the exit codes of polybed, and what is wrong in a message on standard error."""

import os
import sys
from contextlib import suppress

from polybed.files import FAULTS
from polybed.program import ProgramError

DONE, WRONG_CASE, NUMBERS, FILE, MPI, STOPPED = 0, 2, 3, 4, 5, 130


class StudyError(Exception):
    """A study cannot go on. The text is for its user, the code is what the command ends with."""

    def __init__(self, code, text):
        super().__init__(text)
        self.code = code


def answer(text):
    """Prints an answer on standard output, where it has to arrive. Raises StudyError."""
    try:
        print(text, flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what is left in the buffer cannot arrive either
        raise StudyError(FILE, f"standard output: cannot be written ({error.strerror})") from error


def told(error):
    """What an exception says to a user."""
    if isinstance(error, ProgramError):
        return error.said
    if isinstance(error, OSError) and error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    return str(error)


def guarded(work):
    """Does the work of the whole process and returns the code that it ends with."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        return work()
    except (StudyError, ProgramError) as error:
        said, code = told(error), error.code
    except FAULTS as error:
        said, code = told(error), FILE
    except KeyboardInterrupt:
        said, code = "stopped by the user", STOPPED
    if said:  # a run that a study has made has said it itself
        with suppress(OSError):
            print(said, file=sys.stderr, flush=True)
    return code
