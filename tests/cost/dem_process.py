"""Runs a program on given cores: its CPU and wall seconds and its memory as the kernel counts them."""
import os
import resource
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import open_mpi  # noqa: E402

# One thread each.
SETTINGS = open_mpi.SETTINGS | open_mpi.MORE_THAN_CORES | {"OMP_NUM_THREADS": "1"}


class Failed(Exception):
    """A program ended with an error, passed its limit or did not report what it was asked for."""


def environment():
    return os.environ | SETTINGS


def cores(ranks):
    """The first cores that this process may use, one for each rank."""
    found = sorted(os.sched_getaffinity(0))
    if len(found) < ranks:
        raise Failed(f"{ranks} ranks want {ranks} cores, there are {len(found)}")
    return set(found[:ranks])


def on_ranks(ranks, command):
    return ["mpirun", "-q", "-n", ranks, *command] if ranks > 1 else command


def run(command, directory, ranks, limit):
    """cpu_s of all processes together, wall_s, and memory_B: the peak of the largest process. Output goes to `log`."""
    words, log, allowed = [str(word) for word in on_ranks(ranks, command)], Path(directory) / "log", cores(ranks)

    def prepare():
        os.sched_setaffinity(0, allowed)
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))

    begin = time.monotonic()
    with open(log, "w") as stream:
        process = subprocess.Popen(words, cwd=directory, stdout=stream, stderr=subprocess.STDOUT, preexec_fn=prepare,
                                   env=environment())
        _, status, usage = os.wait4(process.pid, 0)
    wall = time.monotonic() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        tail = "\n".join(log.read_text(errors="replace").splitlines()[-12:])
        raise Failed(f"{Path(words[0]).name} ended with {process.returncode} (limit {limit} CPU s):\n{tail}")
    return {"cpu_s": usage.ru_utime + usage.ru_stime, "wall_s": wall, "memory_B": usage.ru_maxrss * 1024}
