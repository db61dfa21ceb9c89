#!/usr/bin/python3
"""System B at the velocities of the thesis: one table and one picture of bed heights and layers by the two-fluid model, by particles, and
by the experiment. inversion_of_system_b.py RUN ... [-o PICTURE]

A RUN is a directory of `polybed tfm` (the whole column) or of `polybed dem` (a strip of it), finished or not; its velocity is read from
its case. Means are taken over the last quarter of its time, ± the standard error of four batches. Runs of particles that were made before
are those of tests/data/system_b/particles.csv.
"""
import argparse
import csv
import dataclasses
import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from strips import ROOT, table

import polybed
from polybed.drawing.style import COLOURS, GREY, NAMES, STYLE

VELOCITIES = [10, 20, 25, 30, 35, 37]  # mm/s, of the thesis's figure
SETTLED_HEIGHT, SETTLED_FRACTION = 66, 0.62  # mm, of the bed at three quarters of the experiment's scale


def rows_of(name):
    """Of a file of data whose lines of text begin with #."""
    return list(csv.DictReader(line for line in open(ROOT / "tests/data" / name) if not line.startswith("#")))


def experiment():
    """Velocity, mm/s, and voidage at the inversion, which are all that is printed of it."""
    row = next(r for r in rows_of("lbm/tab_5_iii.csv") if r["system"] == "B")
    return float(row["u_EXP"]), float(row["eps_EXP"])


def velocity_of(run):
    """Superficial velocity, mm/s."""
    given = tomllib.loads(run.record["case"])["inlet"]["superficial_velocity"]
    return 1e3 * (given[-1][1] if isinstance(given, list) else given)


@dataclasses.dataclass
class Bed:
    """What a run says of its bed: means and standard errors, mm."""
    model: str
    velocity: float  # mm/s
    time: float  # s
    height: tuple
    drift: float | None  # of the height, mm/s
    apart_mm: float  # centre of the coarse over that of the fine
    apart: tuple  # the same over the height
    start: str
    cpu: float | None = None


def estimate(values):
    batches = [np.mean(part) for part in np.array_split(values, 4)]
    return np.mean(values), np.std(batches, ddof=1) / 2


def read_bed(directory):
    run = polybed.read(directory)
    history = run.history
    late = history["time_s"] >= 0.75 * history["time_s"][-1]
    height = 1e3 * history["bed_height_m"][late]
    fine, coarse = (1e3 * history[f"centre_{name}_m"][late] for name in run.species)
    return Bed(run.record["model"], velocity_of(run), history["time_s"][-1], estimate(height), np.polyfit(history["time_s"][late], height, 1)[0],
               np.mean(coarse - fine), estimate((coarse - fine) / height), "mixed", run.record["cpu_s"])


def recorded_beds():
    number = lambda r, name: float(r[name]) if r[name] else None  # noqa: E731
    return [Bed("dem", number(r, "u"), number(r, "time"), (number(r, "height"), number(r, "height_se")), number(r, "drift"),
                number(r, "apart_mm"), (number(r, "apart"), number(r, "apart_se")), r["start"], number(r, "cpu")) for r in rows_of("system_b/particles.csv")]


def cell(value, digits):
    return f"{value[0]:.{digits}f} ± {value[1]:.{digits}f}"


def layers(bed):
    return f"{'coarse' if bed.apart_mm > 0 else 'fine'} on top, by {abs(bed.apart_mm):.0f} mm"


def order(velocity, inversion):
    return "mixed" if velocity == inversion else "coarse on top" if velocity < inversion else "fine on top"


def rows(beds):
    inversion, voidage = experiment()
    for velocity in sorted({*VELOCITIES, *(round(b.velocity, 3) for b in beds)}):
        height = f", {SETTLED_HEIGHT * SETTLED_FRACTION / (1 - voidage):.0f} mm" if velocity == inversion else ""
        here = sorted((b for b in beds if abs(b.velocity - velocity) < 0.01), key=lambda b: b.model != "tfm")
        for n, bed in enumerate(here or [None]):
            first = [f"{velocity:g}", order(velocity, inversion) + height] if n == 0 else ["", ""]
            yield first + (["not run"] + 6 * [""] if bed is None else [
                NAMES[bed.model], f"{bed.time:.0f}, {bed.start}", cell(bed.height, 1), "" if bed.drift is None else f"{bed.drift:+.2f}",
                layers(bed), cell(bed.apart, 3), "" if bed.cpu is None else f"{bed.cpu:.0f}"])


def draw(beds, path):
    """Bed heights above, differences of the centres below, over the velocity."""
    inversion, voidage = experiment()
    with plt.rc_context(STYLE):
        figure, (above, below) = plt.subplots(2, 1, figsize=(5.2, 6.2), sharex=True, layout="constrained")
        for model, colour, mark in (("tfm", COLOURS[0], "o-"), ("dem", COLOURS[1], "s--")):
            mine = sorted((b for b in beds if b.model == model), key=lambda b: b.velocity)
            label = NAMES[model] + (", whole column" if model == "tfm" else ", strip")
            for panel, values in ((above, [b.height for b in mine]), (below, [b.apart for b in mine])):
                panel.errorbar([b.velocity for b in mine], [v[0] for v in values], [v[1] for v in values], fmt=mark, color=colour, ms=4,
                               lw=1, label=label)
        above.plot(inversion, SETTLED_HEIGHT * SETTLED_FRACTION / (1 - voidage), "*", color="black", ms=10, label="experiment")
        for panel in (above, below):
            panel.axvline(inversion, color=GREY, lw=0.8, ls=":")
        below.axhline(0, color=GREY, lw=0.8)
        below.annotate("experiment, thesis: inversion", (inversion, 1), xycoords=("data", "axes fraction"), rotation=90, fontsize=7,
                       ha="right", va="top", color=GREY)
        above.set(ylabel="bed height, mm", ylim=(0, None))
        below.set(xlabel="superficial velocity, mm/s", ylabel="coarse over fine, over the height")
        above.legend(fontsize=8)
        figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", nargs="+", type=Path)
    parser.add_argument("-o", "--output", help="file of the picture")
    given = parser.parse_args()
    beds = [read_bed(directory) for directory in given.run] + recorded_beds()
    table(["mm/s", "expected of 30 mm/s", "model", "s, start", "bed height, mm", "its drift, mm/s", "layers", "over the height", "CPU s"], rows(beds))
    if given.output:
        draw(beds, given.output)


if __name__ == "__main__":
    main()
