"""Folders that studies write: marked as those of polybed, and locked while a study writes there. The program does both."""

import contextlib
import fcntl

from polybed.ending import FILE, StudyError
from polybed.files import FAULTS, opened
from polybed.runner import Door

MARK = ".polybed"  # the lock, too


@contextlib.contextmanager
def taken(folder):
    """Makes the folder if there is none, marks it, and keeps other processes from it. Raises StudyError, after the program has said why, if
    it contains files and has no mark, if it cannot be written, or if another process writes it."""
    with Door(1) as door:
        door.ask("take", folder=folder)
        yield folder


def writes(folder):
    """Whether a process writes into a run directory: it has the mark locked as long as it lives. The shared lock by which this is asked
    is given back at once."""
    with contextlib.suppress(*FAULTS), opened(folder / MARK) as mark:
        try:
            fcntl.flock(mark, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
    return False


def subfolder(folder, name):
    """Makes a folder in a folder of polybed; a link could lead anywhere, so it raises StudyError."""
    path = folder / name
    if path.is_symlink():
        raise StudyError(FILE, f"cannot write into {path}: it is a link, which could lead anywhere")
    path.mkdir(exist_ok=True)
    return path
