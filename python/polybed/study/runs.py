"""Runs that a study makes: the program as a process of its own, on as many ranks as the study was started with. A run ends in order when
the user stops the study, and with the study however that ends."""

import os
import signal
import subprocess
import sys

from polybed import search
from polybed.program import line_of
from polybed.study.child import tied_to_parent
from polybed.study.ending import MPI, NUMBERS, STOPPED, StudyError

RANKS = ("POLYBED_RANKS", "OMPI_COMM_WORLD_SIZE", "PMI_SIZE")  # of -n before the command, or of a launcher
OF_LAUNCHER = ("POLYBED_RANKS", "PMIX_", "PMI_", "OMPI_")  # beginnings of what a launcher leaves in the environment of its ranks
OF_USER = ("OMPI_ALLOW_", "OMPI_MCA_")  # but for these, which may be the user's
NOT_OF_USER = ("OMPI_MCA_orte_", "OMPI_MCA_ess", "OMPI_MCA_pmix", "OMPI_MCA_initial_wdir", "OMPI_MCA_shmem_RUNTIME",
               "OMPI_MCA_mpi_oversubscribe")
CHECKPOINTS = ("checkpoint.h5", "checkpoint.previous.h5")


def ranks():
    """How many ranks the study was started with."""
    return int(next((os.environ[name] for name in RANKS if name in os.environ), 1))


def left_by_launcher(name):
    return name.startswith(OF_LAUNCHER) and (not name.startswith(OF_USER) or name.startswith(NOT_OF_USER))


def environment():
    """That of a run: without what a launcher says of this process, which is none of the run's ranks."""
    kept = {name: value for name, value in os.environ.items() if not left_by_launcher(name)}
    return kept | {"PATH": search.path()}


def beginning(count):
    """What a run does before it becomes the program: it is tied to this process, and has all cores, of which a launcher may have left one
    to this process."""
    tie = tied_to_parent(signal.SIGTERM if count > 1 else signal.SIGKILL)

    def begin():
        tie()
        if count > 1:
            os.sched_setaffinity(0, range(os.cpu_count()))
    return begin


def wait_for(child):
    """Exit code of a run. A user who stops the study stops the run, which writes a checkpoint; one who insists ends it at once."""
    stopped = False
    while True:
        try:
            code = child.wait()
            return STOPPED if stopped else code
        except KeyboardInterrupt:
            stopped = True
            child.terminate()


def interrupt(_signal, _frame):
    raise KeyboardInterrupt


def run(*words, answers=False):
    """Runs the program with these words and waits for its end. It speaks on standard error; its answer is that of the study if it
    `answers`, and else goes there too. Raises StudyError with the run's code; the text is empty if the run has said what is wrong."""
    signal.signal(signal.SIGTERM, interrupt)
    count = ranks()
    line = line_of(words, count)
    child = subprocess.Popen(line, env=environment(), stdin=subprocess.DEVNULL, stdout=None if answers else sys.stderr,
                             process_group=0, preexec_fn=beginning(count))
    code = wait_for(child)
    if code < 0:
        raise StudyError(MPI if count > 1 else NUMBERS, f"{' '.join(line)}: ended by signal {-code}")
    if code != 0:
        raise StudyError(code, "")


def has_checkpoint(directory):
    """Whether a run can go on from what is there."""
    return any(os.path.exists(os.path.join(directory, name)) for name in CHECKPOINTS)


def flags(request, *names):
    """Those of these options that a request has, as words of the command line."""
    return [f"--{name}" for name in names if request[name]]
