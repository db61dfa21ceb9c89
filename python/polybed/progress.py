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
NUMBER = re.compile(r"-?\d[\d.]*(e[+-]?\d+)?")


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
        if self.line:
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
    runs once, whatever their numbers. Where nothing is redrawn, each run that ends and each tenth of the whole has a line."""

    def __init__(self, count: int, quiet: bool = False) -> None:
        super().__init__("runs")
        self.share, self.lock, self.tenths = [0.0] * count, threading.Lock(), 0
        self.quiet, self.redrawn, self.warned = quiet, redrawn(), dict[str, tuple[str, set[int]]]()

    def hearer(self, run: int, name: str) -> Callable[[str], None]:
        """What hears each line of a run, by its number and name."""
        def hear(line: str) -> None:
            with self.lock:
                if found := SIMULATED.match(line):
                    self.advance(run, min(float(found[1]) / float(found[2]), 0.99))
                elif line.startswith("warning") and not self.quiet:
                    first, runs = self.warned.setdefault(NUMBER.sub("", line), (f"{name}: {line}".rstrip(), set()))
                    if not runs:
                        self.above(first)
                    runs.add(run)
        return hear

    def finish(self, run: int, name: str) -> None:
        with self.lock:
            self.advance(run, 1.0, name)
            for first, runs in self.warned.values() if min(self.share) == 1.0 else ():
                if len(runs) > 1:
                    put(plain(f"{first}; and {len(runs) - 1} more\n"))

    def advance(self, run: int, share: float, name: str = "") -> None:
        self.share[run] = share
        done, count, whole = sum(self.share), len(self.share), f"{self.share.count(1.0)} of {len(self.share)}"
        if self.quiet:
            return
        if self.redrawn:
            self.show(done, count, f"{whole} done")
        elif name or int(10 * done / count) > self.tenths:
            put(plain(f"{whole} runs done: {name}\n" if name else f"runs: {100 * done / count:.0f} % simulated, {whole} done\n"))
            self.tenths = int(10 * done / count)
