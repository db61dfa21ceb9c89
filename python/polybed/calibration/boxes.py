"""The boxes of a calibration: which are finished, and how the others are run."""

import itertools
import json
import time
from concurrent.futures import as_completed
from typing import NamedTuple

from polybed.texts import duration
from polybed.ending import FILE, NUMBERS, StudyError
from polybed.files import FAULTS, contents_of, finite, read_text
from polybed.runner import Door, ranks, side_by_side
from polybed.solids_table import AXES
from polybed.study.output import remark

# What is read of a box: numbers, and means with their standard error.
SINGLE = ("solids_fraction", "stokes", "restitution", "friction", "share", "seed", "balance", "drift", "shear_rate_1_s", "diameter_m",
          "density_kg_m3", "strain", "drag_rate", "softness", "max_overlap", "cpu_s", "particle_steps", "bed_phi", "slip_over_sqrt_theta",
          "velocity_m_s")
MEANS = ("theta_m2_s2", "pressure_Pa", "viscosity_Pa_s", "temperature_ratio", "p_ratio", "mu_ratio", "gamma_ratio", "exchange_ratio",
         "p_bed", "p_bed_by_balance")


class Point(NamedTuple):
    """One box: its place in the table, and the seed of its random numbers."""
    regime: str  # dry | wet | bed
    phi: float
    stokes: float
    restitution: float
    friction: float
    share: float  # of the volume, of the second species
    binary: bool = False  # two species; else one of the bed's mean size
    pushed: bool = False  # both species also pushed apart, for what they exchange; its stress is not used
    seed: int = 1


class Plan:
    """The boxes of a case. case: as the program answers"""

    def __init__(self, case):
        self.case, self.regime, self.axes = case, case["regime"], case["axes"]
        self.pushed = case["binary"] and self.regime == "dry"  # also boxes for what the species exchange: beta_12 is measured in dry boxes alone
        self.seeds = [case["seeds"]] * len(self.points())  # of each point [phi][stokes][e][mu_p][x2]

    def points(self):
        """A box of each point, without its seed."""
        return [Point(self.regime, *place, self.case["binary"]) for place in itertools.product(*(self.axes[name] for name in AXES))]

    def boxes(self):
        """The seeds of every point, then as many again of the points that are pushed."""
        boxes = [point._replace(seed=seed + 1) for point, seeds in zip(self.points(), self.seeds) for seed in range(seeds)]
        return boxes + [box._replace(pushed=True) for box in boxes if self.pushed]


def read_box(path, digest):
    """A finished box of this hash, a dictionary; None if there is none or it is damaged: it is run again."""
    try:
        with contents_of(path):
            box = json.loads(read_text(path))
            if box["hash"] != digest:
                return None
            for number in (*(box[name] for name in SINGLE), *(value for name in MEANS for value in (box[name][0], box[name][1]))):
                finite(number)
    except FAULTS:
        return None
    return box


def asked_of(points):
    """Points as `polybed ask` takes them."""
    return [point._asdict() for point in points]


class Boxes:
    """Boxes that are run, with those finished before, in the order asked for."""

    def __init__(self, door, options, points):
        self.door, self.options, self.points = door, options, points
        named = door.ask("boxes", points=asked_of(points))
        self.names, self.expected = [name for name, _ in named], [seconds for _, seconds in named]
        self.done = [self.read(n) is not None for n in range(len(points))]

    def path(self, n):
        return self.options.output / "boxes" / f"{self.names[n]}.json"

    def read(self, n):
        return read_box(self.path(n), self.names[n])

    def left(self):
        """Places of those that are not finished, the longest first."""
        return sorted((n for n, done in enumerate(self.done) if not done), key=lambda n: -self.expected[n])

    def expected_left(self):
        """s, on one core."""
        return sum(self.expected[n] for n in self.left())

    def run(self):
        """Runs the unfinished boxes; all results. Raises StudyError where boxes fail; finished ones are kept."""
        self.begin, self.all = time.monotonic(), self.expected_left()
        failed = self.run_on_ranks() if self.options.on_ranks else self.run_as_processes()
        if failed:
            raise StudyError(NUMBERS, f"{len(failed)} boxes failed, the first at phi = {self.points[failed[0]].phi:g}; finished ones are kept")
        results = [self.read(n) for n in range(len(self.points))]
        if None in results:
            raise StudyError(FILE, f"{self.path(results.index(None))}: the box that should lie here is not whole")
        return results

    def run_by(self, door, places, finished):
        """Has a program run boxes in this order, calling `finished` as its first rank finishes one; returns the places that failed."""
        answer = door.ask("run", points=asked_of(self.points[n] for n in places), files=[str(self.path(n)) for n in places])
        while answer is None:
            finished()
            answer = door.answer()
        return [places[n] for n in answer]

    def run_alone(self, n):
        """Likewise one box, by a program of its own."""
        try:
            with Door(ranks()) as door:
                door.ask("case", case=self.options.case, settings=self.options.set)
                return self.run_by(door, [n], lambda: None)
        except StudyError:  # the program has ended
            return [n]

    def run_as_processes(self):
        failed = []
        with side_by_side(self.options.jobs) as threads:
            places = {threads.submit(self.run_alone, n): n for n in self.left()}
            for future in as_completed(places):
                failed += future.result()
                if not future.result():
                    self.done[places[future]] = True
                    self.tell()
        return failed

    def run_on_ranks(self):
        """The same by the ranks of the program. The boxes that other ranks have finished are known by their files."""
        left = self.left()
        failed = self.run_by(self.door, left, self.look) if left else []
        if left and self.left():
            self.look()
        return failed

    def look(self):
        for n in self.left():
            self.done[n] = self.read(n) is not None
        self.tell()

    def tell(self):
        if not self.options.quiet:
            passed, left = time.monotonic() - self.begin, self.expected_left()
            remark(f"{sum(self.done)} of {len(self.done)} boxes; about {duration(passed * left / max(self.all - left, 1e-9))} left")
