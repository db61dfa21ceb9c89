"""What a scan for the inversion velocity has found, by one model or by both: as lines and as inversion.json."""

import math
from dataclasses import dataclass, field

from polybed.study.inversion_search import Found

AT_HEIGHT = 0.98  # interface over bed height of a mixed bed
GOAL = 0.05  # relative difference of the models' velocities


@dataclass
class ScanOfModel:
    model: str
    found: Found
    runs: list  # as inversion.json has them, in the order of the steps
    # Scans of the same range with the case's table of the solids stress at minus and plus one standard error, if they were asked for.
    moved: list = field(default_factory=list)

    def plain(self):
        found = self.found
        steps = [{"velocity_m_s": step.velocity, "from": step.source} | run
                 for step, run in zip(found.steps, self.runs, strict=True)]
        plain = {"outcome": found.outcome, "velocity_m_s": found.velocity, "error_m_s": found.error, "low_m_s": found.low,
                 "high_m_s": found.high, "slope_s_m": found.slope, "mixed": mixed_interval(self),
                 "cpu_s": sum(run["cpu_s"] for run in self.runs), "runs": steps}
        if self.moved:
            low, high = stress_band(self) or (None, None)
            minus, plus = self.moved
            plain["stress_uncertainty"] = {"standard_errors": 1, "low_m_s": low, "high_m_s": high, "minus": minus.plain(),
                                           "plus": plus.plain()}
        return plain


def mixed_velocities(scan):
    """By velocity, m/s, whether the bed is mixed: with several runs, in all of them."""
    mixed = {}
    for step, run in zip(scan.found.steps, scan.runs, strict=True):
        at_height = (run["interface_over_height"] or 0.0) >= AT_HEIGHT
        mixed[step.velocity] = mixed.get(step.velocity, True) and at_height
    return mixed


def mixed_interval(scan):
    """Between which velocities a scan's beds are mixed: their interface, x* = 5 %, is at their height. Of the least and the greatest such
    velocity, m/s: "least_m_s" and "greatest_m_s", and the nearest that are not mixed, "below_m_s" and "above_m_s", None where there is
    none. None if no bed is mixed."""
    mixed = mixed_velocities(scan)
    inside = [velocity for velocity, is_mixed in mixed.items() if is_mixed]
    if not inside:
        return None
    least, greatest = min(inside), max(inside)
    others = mixed.keys() - set(inside)
    return {"least_m_s": least, "greatest_m_s": greatest, "below_m_s": max((u for u in others if u < least), default=None),
            "above_m_s": min((u for u in others if u > greatest), default=None)}


def stress_band(scan):
    """Velocities between which the answer lies with the table moved by a standard error, m/s; None unless all three were found."""
    velocities = [of.found.velocity for of in (scan, *scan.moved)]
    return (min(velocities), max(velocities)) if scan.moved and None not in velocities else None


def drifting(scan):
    """How many runs from one end of the bracket to the other still drift, and how many there are."""
    there = [run for step, run in zip(scan.found.steps, scan.runs, strict=True) if scan.found.low <= step.velocity <= scan.found.high]
    return sum(bool(run["warnings"]) for run in there), len(there)


def agreement_of(scans):
    """Whether the models agree: relative difference of the velocities, against the greater of 5 % and half of what both are unknown by.
    None unless both have found one; reached is None, undecided, while runs at their brackets still drift."""
    found = {scan.model: scan.found for scan in scans if scan.found.velocity is not None}
    if not {"tfm", "dem"} <= found.keys():
        return None
    tfm, dem = found["tfm"], found["dem"]
    quotient = tfm.velocity / dem.velocity
    goal = max(GOAL, 0.5 * (tfm.width + dem.width))
    return {"value": quotient - 1, "error": quotient * math.hypot(tfm.error / tfm.velocity, dem.error / dem.velocity), "goal": goal,
            "reached": abs(quotient - 1) <= goal if not any(drifting(scan)[0] for scan in scans) else None}


def head():
    return f"{'model':5} {'mm/s':>8} {'from mm/s':>10} {'centre_difference':>20} {'bed height, mm':>16} {'CPU s':>8}"


def line(name, velocity, source, run, reused):
    """The entry of a run. source: velocity of the run that it continues, m/s, or None; reused: whether it was finished before"""
    begun = "start" if source is None else f"{1e3 * source:.2f}"
    mean, height = (f"{value:{digits}} +-{error:.1g}" for value, digits, error in (
        (run["centre_difference"], ".4f", run["error"]), (1e3 * run["bed_height_m"], ".1f", 1e3 * run["bed_height_error_m"])))
    marks = ("  finished before" if reused else "") + ("  not steady" if run["warnings"] else "")
    return f"{name:5} {1e3 * velocity:8.2f} {begun:>10} {mean:>20} {height:>16} {run['cpu_s']:8.3g}{marks}"


def mm(value):
    return f"{1e3 * value:.4g}"


def finding(scan, species):
    """What a scan has found, a line each: the inversion, the band of its table, and where beds are mixed."""
    found, lines, mixed = scan.found, [], mixed_interval(scan)
    if found.velocity is None:
        full = ", where the bed fills the column: a taller one tells more" if found.outcome == "filled" else ""
        lines.append(f"no inversion between {mm(found.low)} and {mm(found.high)} mm/s{full}")
    else:
        below, above = species if found.slope > 0 else reversed(species)  # the centre of the second less that of the first grows
        lines.append(f"inversion at {mm(found.velocity)} +-{1e3 * found.error:.1g} mm/s, between {mm(found.low)} and {mm(found.high)} (ended by "
                     f"{found.outcome}), slope {found.slope:.3g} s/m; {below} on top below it, {above} above")
        some, runs = drifting(scan)
        if some:
            lines.append(f"undecided: {some} of {runs} runs in the bracket still drift, and +- covers their noise alone; use a longer --until")
    if band := stress_band(scan):
        lines.append(f"{mm(band[0])} to {mm(band[1])} mm/s within one standard error of the table")
    elif scan.moved:
        lines.append("no band of the table: not every scan has found one")
    if mixed:
        ends = [f" (not at {mm(mixed[name])})" if mixed[name] else "" for name in ("below_m_s", "above_m_s")]
        lines.append(f"mixed (interface at the bed's height, x* = 5 %) from {mm(mixed['least_m_s'])}{ends[0]} to "
                     f"{mm(mixed['greatest_m_s'])}{ends[1]} mm/s")
    elif scan.runs:
        lines.append("mixed (interface at the bed's height, x* = 5 %) in no run")
    return [f"{scan.model}: {line}" for line in lines]


def beside_lines(beside, scans):
    """Other velocities: the force balance, which runs can contradict, and published ones. beside: as in `polybed inversion --json`."""
    def between(what, values):
        return [f"{what}: {' to '.join(map(mm, values))} mm/s"] if values else []

    interval, densities = beside["mixed_interval_m_s"], beside.get("equal_bulk_density_m_s")
    lines = between("mixed by force balance", interval)
    if not interval and densities:
        lines += between("no mixed interval by force balance: equal bulk densities lie above it, at", [densities])
    for scan in scans if interval else ():
        others = [mm(velocity) for velocity, mixed in sorted(mixed_velocities(scan).items()) if interval[0] <= velocity <= interval[1] and not mixed]
        lines += [f"{scan.model}: contradicts it: not mixed at {', '.join(others)} mm/s"] if others else []
    return lines + between("measured", beside["measured_m_s"]) + between("simulated by others", beside["simulated_m_s"])


def findings(scans, balance, beside=None, species=("species 1", "species 2")):
    """What the scans have found, as lines. balance: the point by force balance, or None"""
    lines = [line for scan in scans for line in finding(scan, species)]
    lines += [f"force balance: {mm(balance['velocity_m_s'])} mm/s"] if balance else []
    lines += beside_lines(beside, scans) if beside else []
    if agreement := agreement_of(scans):
        verdict = {True: "reached", False: "missed", None: "undecided, runs still drift"}[agreement["reached"]]
        lines.append(f"tfm/dem - 1: {agreement['value']:.3f} +-{agreement['error']:.1g}, goal {agreement['goal']:.3f}: {verdict}")
    return "".join(f"{line}\n" for line in ["", *lines])
