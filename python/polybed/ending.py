"""Command lines: options that several commands take, exit codes, and messages on standard error."""

import argparse
import os
import sys
from contextlib import suppress

from polybed.errors import ProgramError, StudyError
from polybed.files import FAULTS
from polybed.packages import DONE, FILE, MPI, NUMBERS, STOPPED, WRONG_CASE


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


def guarded(work, stopped="stopped by the user"):
    """Does the work of the whole process and returns the code that it ends with. stopped: what is said when the user stops it"""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        return work()
    except (StudyError, ProgramError) as error:
        said, code = told(error), error.code
    except FAULTS as error:
        said, code = told(error), FILE
    except KeyboardInterrupt:
        said, code = stopped, STOPPED
    if said:  # a run that a study has made has said it itself
        with suppress(OSError):
            print(said, file=sys.stderr, flush=True)
    return code


def made(paths):
    """Runs `paths`, which makes files and returns where they are. Prints the paths, or what is wrong; returns the exit code."""
    def work():
        answer("\n".join(map(str, paths())))
        return DONE
    return guarded(work)


# Options by name: as argparse takes them.
ALIKE = {"case": {"metavar": "CASE", "help": "the case file"},
         "--set": {"action": "append", "default": [], "metavar": "KEY=VALUE", "help": "in place of what the file says"},
         "--until": {"metavar": "TIME", "help": 'simulated time, e.g. "20 s"'},
         "--quiet": {"action": "store_true", "help": "no progress"},
         "--json": {"action": "store_true", "help": "one JSON object on standard output, nothing else there"},
         "--no-picture": {"dest": "picture", "action": "store_false", "help": "no pictures and pages at the end"}}


def parser_of(command, description, *alike):
    """The parser of a command with some of these options."""
    parser = argparse.ArgumentParser(prog=f"polybed {command}", allow_abbrev=False, description=description)
    for name in alike:
        parser.add_argument(name, **ALIKE[name])
    return parser


def whole(low, high):
    """What reads a whole number in a range."""
    def read(text):
        number = int(text)
        if not low <= number <= high:
            raise argparse.ArgumentTypeError(f"{number} is not in range {low} to {high}")
        return number
    read.__name__ = "whole number"
    return read
