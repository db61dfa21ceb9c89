"""Errors whose text says all that a user needs: scripts and notebooks show it without a traceback."""

from __future__ import annotations

import itertools
import sys
import traceback
from pathlib import Path
from types import TracebackType

from polybed.packages import plain
from polybed.progress import SIMULATED

PACKAGE = Path(__file__).resolve().parent


class PlainError(Exception):
    """An error whose text can quote a file: control characters are removed from it."""

    def __init__(self, text: str) -> None:
        super().__init__(plain(text))

    def _render_traceback_(self) -> list[str]:
        """What a notebook shows in place of a traceback."""
        return [shown(self)]


class ProgramError(PlainError):
    """The program ended with a code other than 0. The text names the function that was called and quotes the message of the program without
    progress and warnings; `said` is all that it wrote, `words` the command line."""

    def __init__(self, words: list[str], code: int, said: str, called: str = "polybed") -> None:
        message = "".join(line for line in said.splitlines(keepends=True) if not (line.startswith("warning: ") or SIMULATED.match(line)))
        super().__init__(f"{called} ended with {code}: {(message or said).strip()}")
        self.words, self.code, self.said = words, code, said.strip()


class UnknownNameError(PlainError, KeyError):
    """A name that is not there. The text says what it could mean, or the names that there are."""

    __str__ = BaseException.__str__  # KeyError shows its text in quotation marks


class NoFieldError(PlainError, AttributeError):
    """A run has no field of this name."""


class NoStepError(PlainError, IndexError):
    """No step of this number is stored."""


class ArgumentError(PlainError, ValueError, TypeError):
    """An argument that a function does not take."""


class MissingError(PlainError, FileNotFoundError):
    """There is no such file or run."""


class NoProgramError(MissingError):
    """There is no program to run."""


class StudyError(PlainError):
    """A study cannot continue. The text is for the user, and empty if the program has printed it; `code` is the exit code of the command."""

    def __init__(self, code: int, text: str = "") -> None:
        super().__init__(text)
        self.code = code


def shown(error: BaseException) -> str:
    """The error in one line, and in a second one the line of the user that called the package."""
    frames = traceback.extract_tb(error.__traceback__)
    users = list(itertools.takewhile(lambda frame: PACKAGE not in Path(frame.filename).parents, frames))
    where = f"\n  {users[-1].filename}:{users[-1].lineno}: {users[-1].line}" if users and users[-1].line else ""
    return f"polybed.{type(error).__name__}: {error}{where}"


def show(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """sys.excepthook: a PlainError is shown in a line, as is Ctrl-C within this package; any other error as Python shows it."""
    if isinstance(error, PlainError):
        print(shown(error), file=sys.stderr)
    elif isinstance(error, KeyboardInterrupt) and any(PACKAGE in Path(frame.filename).parents for frame in traceback.extract_tb(trace)):
        print("polybed: stopped by the user; resume=True continues", file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, trace)
