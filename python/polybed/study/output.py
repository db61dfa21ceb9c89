"""What a study leaves: its record, pictures and remarks, and its folder, which the program marks and locks."""

import contextlib
import fcntl
import json
import sys

from polybed.ending import FILE, NUMBERS, StudyError, answer
from polybed.files import FAULTS, opened, put_text
from polybed.runner import Door

MARK = ".polybed"  # the lock, too


def json_text(found):
    """Raises StudyError if a number is not finite."""
    try:
        return json.dumps(found, ensure_ascii=False, allow_nan=False)
    except ValueError as error:
        raise StudyError(NUMBERS, "a number that is not finite was about to be written as JSON") from error


def write_record(path, found):
    """Puts a JSON file in place whole and returns its text. Raises StudyError."""
    text = json_text(found)
    try:
        put_text(path, text + "\n")
    except OSError as error:
        raise StudyError(FILE, f"cannot write {path}: {error.strerror}") from error
    return text


def remark(text):
    """Says something on standard error, as far as that can be written."""
    with contextlib.suppress(OSError):
        print(text, file=sys.stderr, flush=True)


def draw(path, what, quiet):
    """Draws a record, and says where the pictures are, or why there is no `what`: the record is complete without. quiet: says nothing"""
    try:
        from polybed.plot import study_drawn  # matplotlib takes a second to be imported
        paths = study_drawn(path)
    except Exception as error:  # whatever is wrong with a picture, the study has ended well
        if not quiet:
            remark(f"no {what}: {error}")
    else:
        if not quiet:
            answer("\n".join(map(str, paths)))


@contextlib.contextmanager
def taken(folder):
    """Makes the folder if there is none, marks it, and keeps other processes from it. Raises StudyError, after the program has said why, if
    it contains files and has no mark, if it cannot be written, or if another process writes it."""
    with Door(1) as door:
        door.ask("take", folder=folder)
        yield folder


def writes(folder):
    """Whether a process writes into a run directory: it keeps the mark locked. The lock that asks is given back at once."""
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
