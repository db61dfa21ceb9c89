"""The search for the inversion velocity by runs: velocities, which run each continues, and when it ends."""

import math
from dataclasses import dataclass
from typing import NamedTuple

WIDTH = 0.03  # at which a search ends: of the bracket, over the velocity
WIDENING = 1.25  # of an end that does not enclose the zero
MOST_WIDENINGS = 6
MARGIN = 0.1  # of the bracket, which a secant keeps from its ends


class Mean(NamedTuple):
    """Time mean of the centres' difference over the window of a run."""
    value: float
    error: float  # half-width of its 95 % interval, which stands for two standard errors
    filled: bool = False  # the bed reaches the top of the column: no faster run tells more

    @property
    def certain(self):
        """Whether the interval leaves out 0: who is on top is known."""
        return abs(self.value) > self.error


class Step(NamedTuple):
    velocity: float  # m/s
    source: int | None  # number of the run it goes on from; None: it began as the case says
    mean: Mean


class Point(NamedTuple):
    """A velocity with all that its runs have told, and the number of the last of them."""
    velocity: float
    mean: Mean
    run: int


def known(outcome, low, high, velocity, error):
    """Between which velocities an inversion that was found lies: the bracket where it is narrow, else the interval by the noise, m/s."""
    return (low, high) if outcome == "bracket" else (velocity - error, velocity + error)


@dataclass
class Found:
    outcome: str  # bracket: narrow enough | indistinct: within the noise from both sides | not found | filled: the column
    steps: list  # in the order in which they were made
    low: float  # the bracket, or the range that was searched, m/s
    high: float
    velocity: float | None = None  # of the inversion, m/s; None: not found
    error: float | None = None  # half-width of its 95 % interval by the noise of the means, m/s
    slope: float | None = None  # of the means over the bracket, s/m

    @property
    def width(self):
        """How well the velocity is known, over itself."""
        low, high = known(self.outcome, self.low, self.high, self.velocity, self.error)
        return (high - low) / self.velocity


class Search:
    def __init__(self, run):
        """run: (velocity, number of the run to go on from or None) -> Mean"""
        self.run, self.steps, self.filled = run, [], False

    def at(self, velocity, source):
        mean = self.run(velocity, source)
        self.steps.append(Step(velocity, source, mean))
        return Point(velocity, mean, len(self.steps) - 1)

    def enclosed(self):
        low, high = self.low.mean, self.high.mean
        return low.certain and high.certain and low.value * high.value < 0

    def enclose(self):
        """Moves the end that is uncertain, or else the one nearer to zero, outwards; what it leaves is still inside."""
        for _ in range(MOST_WIDENINGS):
            if self.enclosed():
                return True
            low, high = self.low.mean, self.high.mean
            up = abs(high.value) < abs(low.value) if high.certain == low.certain else not high.certain
            if up and self.high.mean.filled:
                self.filled = True
                return False
            former = self.high if up else self.low
            end = self.at(former.velocity * WIDENING if up else former.velocity / WIDENING, former.run)
            # a zero that lies between the former end and the new one is enclosed by these two
            turned = former.mean.certain and end.mean.certain and former.mean.value * end.mean.value < 0
            if up:
                self.low, self.high = former if turned else self.low, end
            else:
                self.low, self.high = end, former if turned else self.high
        return self.enclosed()

    def share(self):
        """Where the line through the ends is zero, 0 to 1."""
        return self.low.mean.value / (self.low.mean.value - self.high.mean.value)

    def between(self, share):
        return self.low.velocity + share * (self.high.velocity - self.low.velocity)

    def inside(self, velocity):
        """A point in the bracket. An uncertain one is repeated from the other end: the mean of both, at least half their difference off."""
        ends = [self.low.run, self.high.run]
        if velocity - self.low.velocity > self.high.velocity - velocity:
            ends.reverse()
        point = self.at(velocity, ends[0])
        if point.mean.certain:
            return point
        a, again = point.mean, self.at(velocity, ends[1])
        b = again.mean
        error = max(0.5 * math.hypot(a.error, b.error), 0.5 * abs(a.value - b.value))
        return Point(velocity, Mean(0.5 * (a.value + b.value), error), again.run)

    def width(self):
        return self.high.velocity - self.low.velocity

    def narrow(self):
        halved = True
        while 2 * self.width() > WIDTH * (self.high.velocity + self.low.velocity):
            before = self.width()
            secant = self.between(min(max(self.share(), MARGIN), 1 - MARGIN))
            point = self.inside(secant if halved else 0.5 * (self.low.velocity + self.high.velocity))
            if not point.mean.certain:
                return self.found("indistinct", point.velocity, point.mean.error)
            if point.mean.value * self.low.mean.value > 0:
                self.low = point
            else:
                self.high = point
            halved = self.width() <= 0.5 * before
        share = self.share()
        noise = math.hypot((1 - share) * self.low.mean.error, share * self.high.mean.error)
        return self.found("bracket", self.between(share), noise)

    def found(self, outcome, velocity=None, noise=None):
        found = Found(outcome, self.steps, self.low.velocity, self.high.velocity, velocity)
        if velocity is not None:
            found.slope = (self.high.mean.value - self.low.mean.value) / self.width()
            found.error = noise / abs(found.slope)
        return found


def search(low, high, run):
    """Zero of the mean over the velocity: the range is widened until its ends are certain and of opposite sign, then cut by bisection, or
    by the secant kept within the middle 80 % after a cut that halved it. Each run goes on from the nearer end of the bracket."""
    of = Search(run)
    of.low = of.at(low, None)
    of.high = of.at(high, of.low.run)
    return of.narrow() if of.enclose() else of.found("filled" if of.filled else "not found")
