"""Which boxes a calibration runs: every point of the axes with its seeds."""

import itertools
from dataclasses import dataclass
from typing import NamedTuple

from polybed.solids_table import AXES


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


@dataclass
class Plan:
    case: dict  # as the program answers
    seeds: list  # of each point [phi][stokes][e][mu_p][x2]

    @classmethod
    def of_case(cls, case):
        plan = cls(case, [])
        plan.seeds = [case["seeds"]] * len(plan.points())
        return plan

    @property
    def regime(self):
        return self.case["regime"]

    @property
    def axes(self):
        return self.case["axes"]

    @property
    def pushed(self):
        """Whether boxes are run for what the species exchange: beta_12 is measured in dry boxes alone."""
        return self.case["binary"] and self.regime == "dry"

    def points(self):
        """A box of each point, without its seed."""
        return [Point(self.regime, *place, self.case["binary"]) for place in itertools.product(*(self.axes[name] for name in AXES))]

    def boxes(self):
        """The seeds of every point, then as many again of the points that are pushed."""
        boxes = [point._replace(seed=seed + 1) for point, seeds in zip(self.points(), self.seeds) for seed in range(seeds)]
        return boxes + [box._replace(pushed=True) for box in boxes if self.pushed]
