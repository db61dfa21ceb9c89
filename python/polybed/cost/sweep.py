"""What was run, what it is measured against, and what follows."""

from argparse import Namespace
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from polybed.cost.fit import Priced
from polybed.cost.quantities import RunQuantities
from polybed.cost.runner import RunOrder, RunOutcome

# What a row stands for.
CANDIDATE, MODEL, REFERENCE, TWIN, SOLVER, INPUT = "candidate", "model", "reference", "twin", "solver", "input"


class RowQuantity(NamedTuple):
    """A quantity of a run with its distance from the reference, both with the half-width of a 95 % interval."""
    value: float
    error: float
    interval: float | None = None
    error_interval: float | None = None


@dataclass
class Row:
    order: RunOrder
    kind: str = CANDIDATE
    settings: dict = field(default_factory=dict)  # level of each axis by its number; an axis left out has the given one
    note: str = ""  # of what is not told by the settings: "temperature + 1 K"
    outcome: RunOutcome | None = None
    measured: RunQuantities = field(default_factory=RunQuantities)
    quantities: dict = field(default_factory=dict)  # RowQuantity by name
    rate: float = 0.0  # s for a simulated second, by the clock
    predicted: Priced | None = None
    status: str = ""  # pareto | dominated | hollow | model | predicted | failed | refused | not run

    @property
    def done(self):
        return self.outcome is not None and self.outcome.done


@dataclass
class Reference:
    kind: str = ""  # exact | self | extrapolated | statistical | directory; empty: none
    note: str = ""
    value: dict = field(default_factory=dict)
    floor: dict = field(default_factory=dict)  # of errors: below it nothing is ranked
    band: dict = field(default_factory=dict)
    directory: Path | None = None  # of a run with profiles


@dataclass
class Share:
    row: str
    value: float | None = None  # of the first quantity's error; None: not run
    note: str = ""
    axes: list = field(default_factory=list)  # that would measure it, of a row that no axis run has measured


@dataclass
class Sweep:
    options: Namespace  # of the command line
    axes: list = field(default_factory=list)
    quantities: list = field(default_factory=list)  # QuantityInfo
    begin: float = 0.0  # of the window, s
    slabs: int = 1  # of the case as it is given, whatever the grid of the run
    rows: list = field(default_factory=list)
    outcome: str = "done"  # done | refused | failed
    reason: str = ""
    regime: str = "steady"  # steady | chaotic
    reference: Reference = field(default_factory=Reference)
    laws: dict = field(default_factory=dict)  # of error and cost along a line, "error_of_rtol"
    additive_off: float | None = None
    attribution: list = field(default_factory=list)
    inputs: list = field(default_factory=list)
    recommended: int | None = None  # number of a row
    warnings: list = field(default_factory=list)

    @property
    def ranking(self):
        return self.options.quantities[0]

    @property
    def chaotic(self):
        return self.regime == "chaotic"

    def refuse(self, reason):
        self.outcome, self.reason = "refused", reason

    def axis(self, name):
        return next((axis for axis in self.axes if axis.name == name), None)

    def find(self, order, kind):
        """The row of this order and kind; None if there is none."""
        return next((row for row in self.rows if row.kind == kind and row.order == order), None)
