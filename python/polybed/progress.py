"""How far something is: a bar that is drawn again in its place, on a terminal and in a notebook."""

from __future__ import annotations

import contextlib
import re
import sys
import threading
from collections.abc import Callable

from polybed.packages import plain

WIDTH = 40
SIMULATED = re.compile(r"t ([\d.e+-]+)/([\d.e+-]+) s")  # how a line of a run's progress begins


def redrawn() -> bool:
    """Whether standard error shows a line in the place of the last one: a pipe and a file do not."""
    return sys.stderr.isatty() or type(sys.stderr).__module__.startswith("ipykernel")


def put(text: str) -> None:
    """Writes to standard error; one that is full or closed ends nothing."""
    with contextlib.suppress(OSError, ValueError):
        raw = getattr(sys.stderr, "buffer", None)  # a stream that is made plain shows no "\r"
        sys.stderr.flush()
        raw.write(text.encode("utf-8", "replace")) if raw else sys.stderr.write(text)
        sys.stderr.flush()


class Bar:
    """A line "name [####....] 3/10"; at the end it is wiped."""

    def __init__(self, name: str) -> None:
        self.name, self.line = name, ""

    def wipe(self) -> None:
        put("\r" + " " * len(self.line) + "\r")

    def show(self, done: float, count: int, told: str | None = None) -> None:
        """told: behind the bar; by default how many are done"""
        full, before = int(done * WIDTH / max(count, 1)), len(self.line)
        self.line = plain(f"{self.name} [{'#' * full}{'.' * (WIDTH - full)}] {told or f'{done}/{count}'}")
        put("\r" + self.line.ljust(before))
        if done >= count:
            self.wipe()

    def above(self, text: str) -> None:
        """A line that stays, above the bar."""
        self.wipe()
        put(plain(text).rstrip("\n") + "\n" + self.line)


class BarOfRuns(Bar):
    """The bar of runs side by side: each counts by the share of its time that it has simulated. Warnings stay above it, those of several
    runs once."""

    def __init__(self, count: int) -> None:
        super().__init__("runs")
        self.share, self.lock = [0.0] * count, threading.Lock()
        self.warned: set[str] = set()

    def hearer(self, run: int, name: str) -> Callable[[str], None]:
        """What hears each line of a run, by its number and name."""
        def hear(line: str) -> None:
            with self.lock:
                if found := SIMULATED.match(line):
                    self.advance(run, min(float(found[1]) / float(found[2]), 0.99))
                elif line.startswith("warning") and line not in self.warned:
                    self.warned.add(line)
                    self.above(f"{name}: {line}")
        return hear

    def finish(self, run: int) -> None:
        with self.lock:
            self.advance(run, 1.0)

    def advance(self, run: int, share: float) -> None:
        self.share[run] = share
        whole = self.share.count(1.0)
        self.show(sum(self.share), len(self.share), f"{whole} of {len(self.share)} done")
