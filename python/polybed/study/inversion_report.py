"""What a scan for the inversion velocity has found, by one model or by both: as lines and as inversion.json."""

import math
from dataclasses import asdict, dataclass, field

from polybed.study.inversion_search import Found

GOAL = 0.05  # relative difference of the models' velocities (docs/calibration.md, section 8)


@dataclass
class RunOfScan:
    """A run of a scan with what its folder tells; the names are those of inversion.json."""
    centre_difference: float
    error: float
    bed_height_m: float
    bed_height_error_m: float
    begin_s: float  # of the window
    end_s: float
    cpu_s: float
    directory: str
    git_commit: str
    warnings: list  # what is not steady
    integrator: str = ""
    reused: bool = False  # finished before

    def plain(self):
        found = asdict(self)
        del found["integrator"], found["reused"]
        return found


@dataclass
class ScanOfModel:
    model: str
    found: Found
    runs: list
    # Scans of the same range with the case's table of the solids stress at minus and plus one standard error; none where that was not
    # asked for.
    moved: list = field(default_factory=list)

    def plain(self):
        found = self.found
        steps = [{"velocity_m_s": step.velocity, "from": step.source} | run.plain()
                 for step, run in zip(found.steps, self.runs, strict=True)]
        plain = {"outcome": found.outcome, "velocity_m_s": found.velocity, "error_m_s": found.error, "low_m_s": found.low,
                 "high_m_s": found.high, "slope_s_m": found.slope, "cpu_s": sum(run.cpu_s for run in self.runs), "runs": steps}
        if self.moved:
            low, high = stress_band(self) or (None, None)
            minus, plus = self.moved
            plain["stress_uncertainty"] = {"standard_errors": 1, "low_m_s": low, "high_m_s": high, "minus": minus.plain(),
                                           "plus": plus.plain()}
        return plain


def stress_band(scan):
    """Between which velocities a scan's answer lies with its table moved by one standard error, m/s; None unless it was moved and each
    of the three has found one."""
    velocities = [of.found.velocity for of in (scan, *scan.moved)]
    return (min(velocities), max(velocities)) if scan.moved and None not in velocities else None


def agreement_of(scans):
    """Whether the models agree: relative difference of the velocities, against the greater of 5 % and half of what both are unknown by.
    None unless both have found one."""
    found = {scan.model: scan.found for scan in scans if scan.found.velocity is not None}
    if not {"tfm", "dem"} <= found.keys():
        return None
    tfm, dem = found["tfm"], found["dem"]
    quotient = tfm.velocity / dem.velocity
    goal = max(GOAL, 0.5 * (tfm.width + dem.width))
    return {"value": quotient - 1, "error": quotient * math.hypot(tfm.error / tfm.velocity, dem.error / dem.velocity), "goal": goal,
            "reached": abs(quotient - 1) <= goal}


def head():
    return f"{'model':5} {'mm/s':>8} {'from mm/s':>10} {'centre_difference':>20} {'bed height, mm':>16} {'CPU s':>8}"


def line(name, velocity, source, run):
    """Of a run. source: velocity of the run that it goes on from, m/s, or None"""
    begun = "start" if source is None else f"{1e3 * source:.2f}"
    mean, height = (f"{value:{digits}} +-{error:.1g}" for value, digits, error in (
        (run.centre_difference, ".4f", run.error), (1e3 * run.bed_height_m, ".1f", 1e3 * run.bed_height_error_m)))
    marks = ("  finished before" if run.reused else "") + ("  not steady" if run.warnings else "")
    return f"{name:5} {1e3 * velocity:8.2f} {begun:>10} {mean:>20} {height:>16} {run.cpu_s:8.3g}{marks}"


def finding(scan):
    found = scan.found
    low, high = 1e3 * found.low, 1e3 * found.high
    if found.velocity is None:
        return f"{scan.model}: no inversion between {low:.4g} and {high:.4g} mm/s\n"
    return (f"{scan.model}: inversion at {1e3 * found.velocity:.4g} +-{1e3 * found.error:.1g} mm/s, between {low:.4g} and {high:.4g} "
            f"(ended by {found.outcome}), slope {found.slope:.3g} s/m\n")


def band_line(scan):
    band = stress_band(scan)
    if band:
        return f"{scan.model}: {1e3 * band[0]:.4g} to {1e3 * band[1]:.4g} mm/s within one standard error of the table\n"
    return f"{scan.model}: no band of the table: not every scan has found one\n" if scan.moved else ""


def findings(scans, balance):
    """What the scans have found, as lines. balance: the point by force balance, or None"""
    text = "\n" + "".join(finding(scan) + band_line(scan) for scan in scans)
    if balance:
        text += f"force balance: {1e3 * balance['velocity_m_s']:.4g} mm/s\n"
    agreement = agreement_of(scans)
    if agreement:
        text += (f"tfm/dem - 1: {agreement['value']:.3f} +-{agreement['error']:.1g}, goal {agreement['goal']:.3f}: "
                 f"{'reached' if agreement['reached'] else 'missed'}\n")
    return text
