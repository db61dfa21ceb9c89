"""The program as another process, on one rank or several, within a time: one that fails or hangs ends nothing but itself."""

import ctypes
import os
import signal
import subprocess
import threading
import time
from contextlib import suppress
from typing import NamedTuple

from polybed.program import line_of

GRACE = 5  # s, in which what is asked to end may do so
ENDS_WITH_PARENT = 1  # PR_SET_PDEATHSIG
LIBC = ctypes.CDLL(None)


class Exit(NamedTuple):
    """How it ended: with 128 and the number of the signal if one ended it; `timed_out` if its time was over; s of the clock."""
    code: int
    timed_out: bool
    wall: float


def new_file(path):
    """A file to write, a new one: a link that has its name is removed and not followed."""
    with suppress(FileNotFoundError):
        path.unlink()
    return open(path, "xb")


def tied_to_parent(signal_number):
    """What a child does before it becomes a program, so that it ends with this process, however that ends."""
    parent = os.getpid()

    def tie():
        LIBC.prctl(ENDS_WITH_PARENT, signal_number)
        if os.getppid() != parent:  # it was gone before
            os._exit(1)
    return tie


def end(child):
    """Asks a child to end, and ends its group if it does not within some seconds; ranks end with the process that started them."""
    child.terminate()
    try:
        child.wait(GRACE)
    except subprocess.TimeoutExpired:
        with suppress(ProcessLookupError):
            os.killpg(child.pid, signal.SIGKILL)


def run_child(words, ranks, output, seconds):
    """Starts the program, waits for its end and returns its Exit. output: path of what it prints; seconds: after which it is ended."""
    late = threading.Event()
    begin = time.monotonic()
    with new_file(output) as file:
        child = subprocess.Popen(line_of(words, ranks), stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT, process_group=0,
                                 preexec_fn=tied_to_parent(signal.SIGTERM if ranks > 1 else signal.SIGKILL))
    left = min(max(0.0, begin + seconds - time.monotonic()), threading.TIMEOUT_MAX)
    timer = threading.Timer(left, lambda: (late.set(), end(child)))
    timer.start()
    try:
        code = child.wait()
    except BaseException:
        end(child)
        raise
    finally:
        timer.cancel()
    return Exit(code if code >= 0 else 128 - code, late.is_set(), time.monotonic() - begin)
