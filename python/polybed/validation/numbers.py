"""Both sides of a comparison, a measured number and the number of a run, each with its 95 % interval; and the verdict."""

import math
from typing import NamedTuple

import numpy as np

from polybed.errors import PlainError
from polybed.files import FormatError, contents_of, finite
from polybed.read import read
from polybed.folder import case_of, drift_lines
from polybed.runner import answer_of, words_of
from polybed.study.measured import means_of, statistics_of, within
from polybed.validation.entries import chosen_rows, script_of

PACKED = (0.1, 0.6)  # pressure drop over weight between which the bed is packed
INSIDE, OUTSIDE, UNDECIDED = "inside", "outside", "undecided"


class Number(NamedTuple):
    value: float
    error: float | None = None  # half-width of the 95 % interval
    repeats: int = 1  # of the experiment, or of a model's runs


class Undecided(PlainError):
    """A run gives no number to judge; the text says why. number: of a bed that still drifts, as it is so far"""

    def __init__(self, reason, number=None):
        super().__init__(reason)
        self.number = number


def of_repeats(values, error=None):
    """Mean of repeats with Student's interval. A single value has the error that is stated. Raises FormatError for two or three."""
    if len(values) == 1:
        return Number(values[0], error)
    if len(values) < 4:
        raise FormatError("an interval needs four repeats")
    [found] = statistics_of([values])["series"]
    return Number(found["mean"], found["interval_of_repeats"], len(values))


def of_series(how, values):
    """Mean or standard deviation in time."""
    [found] = statistics_of([values])["series"]
    if found is None:
        raise Undecided("no row in the window")
    return Number(*(found[name] for name in {"mean": ("mean", "interval"), "deviation": ("deviation", "deviation_interval")}[how]))


def measured_number(entry, run, compare):
    """What was measured. Raises FormatError."""
    stated = compare.get("measured_error")
    if compare["how"] == "inversion":
        return Number(inversion_of(entry, run)["measured_m_s"][0], stated)
    if entry.measured is None:
        return of_series(compare["how"], script_of(entry).measured()[compare["series"]][1])
    rows = chosen_rows(entry.measured, run.where | compare.get("where", {}))
    with contents_of(entry.measured):
        error = finite(rows[0]["error"]) if rows[0].get("error") else stated
        return of_repeats([finite(row[compare.get("value", "value")]) for row in rows], error)


def inversion_of(entry, run):
    return answer_of("inversion", entry.case, *words_of(run.overrides()))


def inversion_interval(found):
    """Between the ends of the mixed interval neither order of the layers is stable."""
    low, high = found["mixed_interval_m_s"]
    return Number((low + high) / 2, (high - low) / 2)


def column_of(record, history, name):
    """A column of the history, or `bed_voidage`: 1 less the solids of the settled bed over the bed height."""
    if name != "bed_voidage":
        return history[name]
    bed, column = (case_of(record).get(table, {}) for table in ("bed", "column"))
    if "profile" in column:
        raise FormatError("bed_voidage is that of a straight column, and this one tapers: compare bed_height_m")
    return 1 - bed["solids_fraction"] * bed["static_height"] / history["bed_height_m"]


def first_time(time, above, since):
    """Time at which something is first reached, counted from `since`."""
    reached = np.nonzero(above & (time > since))[0]
    if not len(reached):
        raise Undecided(f"not reached within {time[-1] - since:.3g} s")
    return Number(float(time[reached[0]] - since), float(time[reached[0]] - time[reached[0] - 1]))


def meets_weight(record, history):
    """The velocity at which the line of the packed bed meets the weight, as u_mf is read off a measured curve; the velocity rises in
    time. The interval leaves out parts of the line in turn."""
    points = np.array(case_of(record)["inlet"]["superficial_velocity"], float)
    carried = history["pressure_drop_Pa"] / history["buoyant_weight_Pa"]
    packed = (carried >= PACKED[0]) & (carried <= PACKED[1]) & (np.maximum.accumulate(carried) <= PACKED[1])
    velocity, carried = np.interp(history["time_s"], *points.T)[packed], carried[packed]
    if len(velocity) < 4:
        raise Undecided("fewer than four rows of a packed bed")
    [found] = statistics_of(ratios=[(velocity * velocity, velocity * carried)])["ratios"]  # of the straight line through the origin
    return Number(found["value"], found["interval"])


def run_number(entry, compare, directory):
    """What a run gives. Raises Undecided, FormatError or FileNotFoundError."""
    how, run = compare["how"], read(directory)
    history = run.history
    if how == "meets_weight":
        return meets_weight(run.record, history)
    if how == "first_time" and "series" in compare:
        time, above = script_of(entry).simulated(run, compare["since"])[compare["series"]]
        return first_time(time, above >= 0, compare["since"])
    if how == "first_time":
        return first_time(history["time_s"], history[compare["column"]] + compare.get("plus", 0) >= history[compare["reaches"]],
                          compare["since"])
    window = means_of(directory).window
    if "series" in compare:
        found = of_series(how, script_of(entry).simulated(run, window.begin)[compare["series"]][1])
    else:
        found = of_series(how, within(history["time_s"], column_of(run.record, history, compare["column"]), window))
    if run.record.get("card", {}).get("steady") is not True:
        raise Undecided((drift_lines(run.record) or ["too few rows to tell whether the bed drifts"])[0], found)
    return found


def of_seeds(entry, compare, directories):
    """What runs give that differ in seed and drawn inputs: their mean, with the interval in which one more would lie: an input that
    is wrong in the experiment is so in each of its repeats, and no mean takes it away. Raises as run_number."""
    if len(directories) == 1:
        return run_number(entry, compare, directories[0])
    found, reasons = [], []
    for directory in directories:
        try:
            found.append(run_number(entry, compare, directory).value)
        except Undecided as error:
            reasons.append(str(error))
    if reasons:
        raise Undecided(f"{len(reasons)} of {len(directories)} runs give no number: {reasons[0]}")
    if len(found) < 4:
        raise Undecided(f"an interval needs four runs, and there are {len(found)}", Number(float(np.mean(found))))
    mean = of_repeats(found)
    return mean._replace(error=mean.error * math.sqrt(len(found) + 1))


def joint_interval(measured, model):
    """95 % half-width of the difference; a single run is one more repeat of a repeated experiment. None if one is unknown."""
    if measured.error is None or model.error is None:
        return None
    one_more = measured.error * math.sqrt(measured.repeats) if measured.repeats > 1 and model.repeats == 1 else 0.0
    return math.hypot(measured.error, model.error, one_more)


def verdict(measured, model):
    """(verdict, joint half-width, why there is none)"""
    joint = joint_interval(measured, model)
    if joint is None:
        return UNDECIDED, None, "no interval of the measurement" if measured.error is None else "too few rows for an interval"
    return (INSIDE if abs(model.value - measured.value) <= joint else OUTSIDE), joint, ""
