"""The program as another process: where it is, how it is started, and how it ends. Nothing else in this package starts it."""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
import weakref
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

from polybed.ending import MPI, NUMBERS, STOPPED
from polybed.errors import NoProgramError, ProgramError, StudyError
from polybed.files import read_text

OWN = Path(__file__).resolve()
ENDS_WITH_PARENT = 1  # PR_SET_PDEATHSIG
LIBC = ctypes.CDLL(None)
RANKS = ("POLYBED_RANKS", "OMPI_COMM_WORLD_SIZE", "PMI_SIZE")  # of -n before the command, or of a launcher
OF_LAUNCHER = ("POLYBED_RANKS", "PMIX_", "PMI_", "OMPI_")  # beginnings of what a launcher leaves in the environment of its ranks
OF_USER = ("OMPI_ALLOW_", "OMPI_MCA_")  # except these, which can be the user's
NOT_OF_USER = ("OMPI_MCA_orte_", "OMPI_MCA_ess", "OMPI_MCA_pmix", "OMPI_MCA_initial_wdir", "OMPI_MCA_shmem_RUNTIME",
               "OMPI_MCA_mpi_oversubscribe")
CHECKPOINTS = ("checkpoint.h5", "checkpoint.previous.h5")

Child = subprocess.Popen[Any]
running: weakref.WeakSet[Child] = weakref.WeakSet()
starting, stopped = threading.Lock(), threading.Event()  # by the user: nothing more is started


def search_path() -> str:
    """The environment's PATH without its relative and empty entries: the working directory can contain a stranger's files."""
    return os.pathsep.join(entry for entry in os.environ.get("PATH", os.defpath).split(os.pathsep) if os.path.isabs(entry))


def found_program(name: str) -> str | None:
    """Absolute path of another program, or None."""
    return shutil.which(name, path=search_path())


def sources() -> Path | None:
    """The folder of the sources that this package lies in, or that pip has installed it from."""
    note = OWN.with_name("sources.txt")  # of setup.py
    own = Path(read_text(note)) if note.is_file() else OWN.parents[2]
    return own if (own / "CMakeLists.txt").is_file() else None


def program() -> str:
    """Path of the program: $POLYBED, or the one next to this package, built in its sources, or on the path."""
    built = sources()
    installed = [] if built == OWN.parents[2] else [OWN.parents[4] / "bin/polybed"]
    tried = [os.environ.get("POLYBED"), *installed, built and built / "build/polybed", found_program("polybed")]
    for path in tried:
        if path and os.access(path, os.X_OK) and not Path(path).is_dir():
            return str(Path(path).resolve())
    raise NoProgramError("there is no program polybed: build it by ./polybed in its sources, install it, or name it in the environment's "
                         f"POLYBED; it is none of {', '.join(str(path) for path in tried if path)}, and not on the path")


def line_of(words: Iterable[object], ranks: int = 1) -> list[str]:
    """The command line of the program with these words on so many ranks, which it starts itself."""
    return [program(), *(["-n", str(ranks)] if ranks > 1 else []), *map(str, words)]


def ranks() -> int:
    """How many ranks this process was started with."""
    return int(next((os.environ[name] for name in RANKS if name in os.environ), 1))


def environment() -> dict[str, str]:
    """The environment of a child, without what a launcher says of this process."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(OF_LAUNCHER)
            or name.startswith(OF_USER) and not name.startswith(NOT_OF_USER)}
    return kept | {"PATH": search_path()}


def tie(count: int) -> Callable[[], None]:
    """What a child on so many ranks does before it becomes the program: it is tied to this process, so that it ends with it, however that
    ends, and has all cores, of which a launcher can have left one to this process."""
    parent = os.getpid()

    def begin() -> None:
        LIBC.prctl(ENDS_WITH_PARENT, signal.SIGTERM if count > 1 else signal.SIGKILL)
        if os.getppid() != parent:  # it was gone before
            os._exit(1)
        if count > 1:
            os.sched_setaffinity(0, range(os.cpu_count() or 1))
    return begin


def start(words: Iterable[object], ranks: int = 1, tied: bool = False, **options: Any) -> Child:
    """Starts the program. tied: it ends with this process, and the terminal's Ctrl-C reaches this process alone; options: of Popen"""
    more: dict[str, Any] = {"process_group": 0, "preexec_fn": tie(ranks)} if tied else {}
    more = {"stdin": subprocess.DEVNULL} | more | options
    with starting:
        if stopped.is_set():
            raise StudyError(STOPPED)
        child: Child = subprocess.Popen(line_of(words, ranks), env=environment(), **more)
        running.add(child)
    return child


def call(*options: object, ranks: int = 1, tell: Callable[[str], object] = str, given: str | None = None) -> str:
    """Runs a command of the program and returns what it printed; each line that it says is told as it comes, but not its error. One that is
    interrupted, or whose caller is, ends with a checkpoint. given: its standard input. Raises ProgramError."""
    said, held, pipe = list[str](), list[str](), subprocess.PIPE  # held: the last statement, which can be the error that is raised
    with start(options, ranks, stdin=subprocess.DEVNULL if given is None else pipe, stdout=pipe, stderr=pipe, encoding="utf-8",
               errors="replace") as child, ThreadPoolExecutor(1) as reader:
        try:
            printed = reader.submit(child.stdout.read)  # type: ignore[union-attr]  # it is a pipe
            if given is not None and child.stdin:
                with contextlib.suppress(BrokenPipeError), child.stdin:  # what it says tells why it has not read
                    child.stdin.write(given)
            for line in child.stderr or ():
                said.append(line)
                held.append(line)
                ended = len(held) if line.startswith(("t ", "warning")) else 0 if line.startswith(" ") else len(held) - 1
                for each in held[:ended]:
                    tell(each)
                del held[:ended]
            child.wait()
        except BaseException:
            child.terminate()
            raise
    if child.returncode != 0:
        raise ProgramError(line_of(options, ranks), child.returncode, "".join(said))
    for each in held:
        tell(each)
    return printed.result()


def answer_of(*words: object, **options: Any) -> dict[str, Any]:
    """What a command answers with --json. options: of call. Raises ProgramError."""
    found: dict[str, Any] = json.loads(call(*words, "--json", **options))
    return found


def commit_and_build() -> tuple[str, str]:
    """Of the program, which says "polybed VERSION (COMMIT), built with KIND"; the kind is empty for the usual one."""
    commit, _, build = call("--version").partition("(")[2].partition(")")
    return commit, build.partition(", built with ")[2].strip()


def line_to_ask(question: str, about: dict[str, Any]) -> str:
    return json.dumps({"ask": question} | about, ensure_ascii=False, default=str) + "\n"


def asked(question: str, **about: Any) -> Any:
    """What `polybed ask` (app/ask.cpp) answers to one question. Raises ProgramError."""
    return json.loads(call("ask", given=line_to_ask(question, about)))


class Door:
    """`polybed ask` on some ranks, for questions that follow each other. It speaks on standard error."""

    def __init__(self, ranks: int) -> None:
        self.child = start(["ask"], ranks, True, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8", errors="surrogateescape")
        self.questions: Any = self.child.stdin
        self.answers: Any = self.child.stdout

    def ask(self, question: str, **about: Any) -> Any:
        with contextlib.suppress(BrokenPipeError):  # the program has ended; reading its answer shows that
            self.questions.write(line_to_ask(question, about))
            self.questions.flush()
        return self.answer()

    def answer(self) -> Any:
        """The next line that is answered. Raises StudyError with the code of a program that has ended."""
        line = self.answers.readline()
        if not line:
            code = self.child.wait()
            raise StudyError(code if code >= 0 else 128 - code)
        return json.loads(line)

    def __enter__(self) -> Door:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is KeyboardInterrupt:
            self.child.terminate()  # it can be in a box
        with contextlib.suppress(BrokenPipeError):
            self.questions.close()
        self.answers.close()
        self.child.wait()


@contextlib.contextmanager
def side_by_side(count: int) -> Iterator[ThreadPoolExecutor]:
    """Threads that run the program. Where the user stops them, nothing more is started and what runs is asked to end."""
    threads = ThreadPoolExecutor(count)
    try:
        yield threads
    except KeyboardInterrupt:
        with starting:
            stopped.set()
            for child in running:
                child.terminate()
        raise
    finally:
        threads.shutdown(cancel_futures=True)
        stopped.clear()


class Exit(NamedTuple):
    """How a child ended: with 128 and the number of the signal if one ended it; `timed_out` if its time was over; s of the clock."""
    code: int
    timed_out: bool
    wall: float


def run_within(seconds: float, words: Iterable[object], output: Path) -> Exit:
    """Runs the program, and ends it when its time is over. output: a new file of what it prints; a link of its name is not followed."""
    late, begin = threading.Event(), time.monotonic()
    output.unlink(missing_ok=True)
    with open(output, "xb") as file:
        child = start(words, 1, True, stdout=file, stderr=subprocess.STDOUT)
    left = min(max(0.0, begin + seconds - time.monotonic()), threading.TIMEOUT_MAX)

    def over() -> None:
        late.set()
        child.kill()
    timer = threading.Timer(left, over)
    timer.start()
    try:
        code = child.wait()
    except BaseException:
        child.kill()
        raise
    finally:
        timer.cancel()
    return Exit(code if code >= 0 else 128 - code, late.is_set(), time.monotonic() - begin)


def run(*words: object, answers: bool = False) -> None:
    """Runs the program, on as many ranks as this process was started with, and waits for its end. It speaks on standard error; its answer
    is that of the study if it `answers`, and else goes there too. A user who stops the study stops the run, which writes a checkpoint; one
    who insists ends it at once. Raises StudyError with the run's code; the text is empty if the run has said what is wrong."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    count, interrupted = ranks(), False
    child = start(words, count, True, stdout=None if answers else sys.stderr)
    while child.returncode is None:
        try:
            child.wait()
        except KeyboardInterrupt:
            interrupted = True
            child.terminate()
    code = STOPPED if interrupted else child.returncode
    if code < 0:
        raise StudyError(MPI if count > 1 else NUMBERS, f"{' '.join(line_of(words, count))}: ended by signal {-code}")
    if code != 0:
        raise StudyError(code, "")


def has_checkpoint(directory: str | os.PathLike[str]) -> bool:
    """Whether a run can continue from this directory."""
    return any(os.path.exists(os.path.join(directory, name)) for name in CHECKPOINTS)


def words_of(overrides: Iterable[str]) -> list[str]:
    """Overrides as words of the command line."""
    return [word for override in overrides for word in ("--set", override)]


def flags(request: dict[str, Any], *names: str) -> list[str]:
    """Those of these options that a request has, likewise."""
    return [f"--{name}" for name in names if request[name]]
