"""Folders that studies write: marked as those of polybed, and locked while a process writes there, as core/output/directory.hpp has them.

The mark, a file called .polybed, is the lock too. A folder with files and without the mark belongs to the user, and nothing in it is
ever replaced or removed.
"""

import contextlib
import fcntl
import json
import os
import socket
import stat

from polybed.files import FAULTS, MISFITS, opened, read_text
from polybed.ending import FILE, WRONG_CASE, StudyError

MARK = ".polybed"
TEXT = "polybed writes this directory: it replaces and removes files of its own here\n"
# Records that say of themselves that they are of polybed: folders of versions without marks have one.
RECORDS = ("run.json", "cost.json", "comparison.json", "inversion.json", "stability.json", "fuzz.json")
NO_LOCKS = (37, 95)  # ENOLCK and ENOTSUP: file systems without locks


def is_file(path):
    return path.is_file() and not path.is_symlink()


def is_record(path):
    try:
        return is_file(path) and json.loads(read_text(path))["filetype"].startswith("polybed ")
    except (*FAULTS, *MISFITS):  # of somebody else
        return False


def is_of_program(folder):
    return is_file(folder / MARK) or any(is_record(folder / name) for name in RECORDS)


def foreign_file(folder):
    """Name of a file in a folder that is not polybed's; None without one. Folders of polybed may lie there: a study is written around its
    runs."""
    if is_of_program(folder):
        return None
    return next((entry.name for entry in folder.iterdir()
                 if entry.is_symlink() or not entry.is_dir() or not is_of_program(entry)), None)


def opened_mark(folder):
    """The mark of a folder, both made if need be, as a file descriptor. A mark that is a link, or has a second name, could be any file."""
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise StudyError(FILE, f"cannot make the directory {folder}: {error.strerror}") from error
    name = foreign_file(folder)
    if name is not None:
        raise StudyError(WRONG_CASE, f"{folder} contains files that polybed has not written, {name} for one: -o DIR names a new or an "
                                     f"empty directory; an empty file {MARK} in {folder} allows polybed to replace its own files there")
    path = folder / MARK
    try:
        mark = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666)
    except OSError as error:
        raise StudyError(FILE, f"cannot write {path}: {error.strerror}") from error
    status = os.fstat(mark)
    if stat.S_ISREG(status.st_mode) and status.st_nlink == 1:
        return mark
    os.close(mark)
    raise StudyError(FILE, f"cannot write {path}: it is no plain file")


def holder(mark):
    """What the process that has the lock has written about itself."""
    text = os.pread(mark, 512, 0).decode(errors="replace")
    return text.removeprefix(TEXT).split("\n")[0] if text.startswith(TEXT) else "another process"


@contextlib.contextmanager
def taken(folder):
    """Makes the folder if there is none, marks it, and keeps other processes from it. Raises StudyError if it contains files and has no
    mark, if it cannot be written, or if another process writes it."""
    mark = opened_mark(folder)
    try:
        try:
            fcntl.flock(mark, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise StudyError(FILE, f"{folder}: {holder(mark)} writes into it; wait for its end, or name another directory by -o DIR"
                             ) from None
        except OSError as error:
            if error.errno not in NO_LOCKS:
                raise StudyError(FILE, f"cannot lock {folder}: {error.strerror}") from error
        os.ftruncate(mark, 0)
        os.pwrite(mark, f"{TEXT}process {os.getpid()} on {socket.gethostname()}\n".encode(), 0)
        yield folder
    finally:
        os.close(mark)


def writes(folder):
    """Whether a process writes into a run directory: it has the mark locked as long as it lives. The shared lock by which this is asked
    is given back at once."""
    try:
        with opened(folder / MARK) as mark:
            try:
                fcntl.flock(mark, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except BlockingIOError:
                return True
    except FAULTS:
        pass
    return False


def mark_folder(folder):
    """Makes and marks a folder without the lock, which the process that writes there takes."""
    number = opened_mark(folder)
    if os.fstat(number).st_size == 0:
        os.write(number, TEXT.encode())
    os.close(number)


def subfolder(folder, name):
    """Makes a folder in a folder of polybed; a link could lead anywhere, so it raises StudyError."""
    path = folder / name
    if path.is_symlink():
        raise StudyError(FILE, f"cannot write into {path}: it is a link, which could lead anywhere")
    path.mkdir(exist_ok=True)
    return path
