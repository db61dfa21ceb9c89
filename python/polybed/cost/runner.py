"""Runs a case by the program, one child process a run, and keeps what came of it for a sweep that continues."""

import json
import math
import re
from contextlib import suppress
from dataclasses import dataclass, field
from typing import NamedTuple

from polybed.ending import WRONG_CASE
from polybed.files import contents_of, put_text, read_json, read_text
from polybed.read import Run
from polybed.runner import asked, run_within, words_of
from polybed.study.cases import hash_of
from polybed.study.measured import measured

VERSION = 1  # of the weights: numbers weighed by other versions are not to be compared
# ns each, fitted on 2026-11-21 to the timers of system B's strip by both integrators and by particles, of glass in air and of a bed that
# settles without a fluid. A change of one of them is a new version. What has none, such as the steps, does not count.
WEIGHTS = {"rhs_evaluations x unknowns": 23, "pressure_iterations x unknowns": 8, "jacobian_products x unknowns": 90, "particle_steps": 15,
           "pair_checks": 4, "contact_evaluations": 25, "candidates": 7, "particle_steps in the fluid": 38, "fluid_steps": 2e5,
           "fluid_steps x particles": 300, "fluid_iterations x cells": 60}
MOST_SAID = 300  # characters of what a run that failed has said
# What a run stores and a sweep does not read.
NOT_READ = re.compile(r"((fields|particles)\.(h5|xdmf)|checkpoint(\.previous)?\.h5(\.new)?)(\.temporary)?")
STEP = re.compile(r"\d{6,}\.h5(\.temporary)?")


def counters_of(record, cells):
    """Counters of a run's record; those that grow with the case are multiplied by its size. cells: of the fluid of a particle run"""
    work = record["work"]
    if record["model"] == "tfm":
        unknowns = record["unknowns"]
        # An explicit step solves for the pressure; an implicit one multiplies by the Jacobian in each Krylov iteration.
        iterations = "pressure_iterations" if work["pressure_solves"] > 0 else "jacobian_products"
        return {"steps": work["steps"], "rejected_steps": work["rejected_steps"],
                "rhs_evaluations x unknowns": unknowns * work["rhs_evaluations"],
                f"{iterations} x unknowns": unknowns * work["linear_iterations"]}
    counters = {name: work[name] for name in ("steps", "particle_steps", "pair_checks", "candidates")}
    counters["contact_evaluations"] = work["contact_steps"]
    if "fluid" in record:
        fluid = record["fluid"]
        counters |= {"particle_steps in the fluid": work["particle_steps"], "fluid_steps": fluid["steps"],
                     "fluid_steps x particles": record["particles"] * fluid["steps"],
                     "fluid_iterations x cells": cells * fluid["iterations"]}
    return counters


def weighed(counters):
    """Sum of the counters with their weights, s."""
    return sum(1e-9 * WEIGHTS[name] * counters[name] for name in sorted(counters) if name in WEIGHTS)


class RunOrder(NamedTuple):
    """What is run: the case with settings of its own."""
    model: str  # tfm | dem
    overrides: tuple = ()


@dataclass
class RunOutcome:
    state: str  # done | failed | refused | not run
    reason: str = ""  # if not done
    wall: float = 0.0  # s, of the first time it was run
    cpu: float = 0.0  # s, without output
    simulated: float = 0.0
    invariants_held: bool = True
    counters: dict = field(default_factory=dict)
    measured: Run | None = None

    @property
    def done(self):
        return self.state == "done"

    def rate(self, clock):
        """s for a simulated second, by the clock; by CPU time where no work was counted."""
        if clock == "work" and self.counters:
            return weighed(self.counters) / self.simulated if self.simulated > 0 else 0.0
        if clock == "wall":
            return self.wall / max(self.simulated, 1e-300)
        return self.cpu / self.simulated if self.simulated > 0 else 0.0


def remove_not_read(folder):
    """Removes fields, particles and checkpoints from the folder of a run; what polybed has not written stays."""
    steps = [each for each in (folder / "fields", folder / "particles") if each.is_dir() and not each.is_symlink()]
    for place, pattern in ((folder, NOT_READ), *((each, STEP) for each in steps)):
        for path in place.iterdir():
            if pattern.fullmatch(path.name):
                path.unlink()
    for each in steps:
        with suppress(OSError):  # there is more in it
            each.rmdir()


class Runner:
    """folder: of the runs; what lies there is used if `resume`, else it is done again. Runs of another case have other names."""

    def __init__(self, scene, overrides, folder, resume):
        self.scene, self.overrides, self.folder, self.resume = scene, list(overrides), folder, resume
        self.cells = math.prod(scene.cells)
        self.seen = set()
        self.spent = 0.0  # s, wall time of all runs that stand for this sweep: those found there count as if they had been done now

    def run(self, order, seconds):
        """Does a run, unless it was done. seconds: wall time that it is allowed"""
        told = (self.scene.text, " ".join(self.overrides), order.model, "1", " ".join(order.overrides))
        folder = self.folder / hash_of(" ".join(told).encode())
        if folder not in self.seen and not (self.resume and self.ended(folder)):
            if not seconds > 0:
                return RunOutcome("not run", "the budget was over")
            self.start(order, folder, seconds)
        outcome = self.read(folder)
        if folder not in self.seen:
            self.seen.add(folder)
            self.spent += outcome.wall
        return outcome

    @staticmethod
    def ended(folder):
        """Whether a run there came to its own end, not to the end of an earlier budget."""
        path = folder / "end.json"
        return path.exists() and not json.loads(read_text(path))["timed_out"]

    def start(self, order, folder, seconds):
        asked("mark", folder=folder)
        (folder / "end.json").unlink(missing_ok=True)
        words = [order.model, str(self.scene.path), "--quiet", "--no-picture", "--force", "-o", str(folder)]
        words += words_of([*self.overrides, *order.overrides])
        end = run_within(seconds, words, folder / "output.txt")
        remove_not_read(folder)
        put_text(folder / "end.json", json.dumps({"code": end.code, "timed_out": end.timed_out, "wall_s": end.wall}) + "\n")

    def read(self, folder):
        with contents_of(folder / "end.json"):
            end = json.loads(read_text(folder / "end.json"))
            code, timed_out, wall = end["code"], end["timed_out"], end["wall_s"]
        if timed_out:
            return RunOutcome("not run", f"ended after {wall:.3g} s: the budget was over", wall)
        if code != 0:
            said = read_text(folder / "output.txt", errors="replace").rstrip("\n")
            reason = f"code {code}: {'...' * (len(said) > MOST_SAID)}{said[-MOST_SAID:]}"
            return RunOutcome("refused" if code == WRONG_CASE else "failed", reason, wall)
        record = read_json(folder / "run.json", "polybed run")
        with contents_of(folder / "run.json"):
            return RunOutcome("done", "", wall, record["cpu_s"] - record["timers"].get("output", 0), record["time_s"],
                              all(one["held"] for one in record.get("invariants", [])), counters_of(record, self.cells), measured(folder))
