#!/usr/bin/python3
"""Strips of the thesis's systems at its velocities, by both models: thesis_systems.py PROGRAM RUNS [NAME ...] [-o PICTURE]

NAME, for instance B-37, chooses systems and velocities, without it all are run: hours. A run that is done is not run again and one
that was stopped goes on. Prints a table of what is there and draws the centres in time.
"""
import argparse
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from strips import mean, run, table

import polybed
from polybed.drawing.style import COLOURS, STYLE

# Velocity, mm/s: time, s. The thesis ran A for 92, 170 and 31 s, B for 170 to 350 and C for 50.
TIMES = {"A": {0.3: 40, 1.8: 110, 3.7: 31}, "B": {20: 40, 37: 128}, "C": {8: 25, 17: 8}}
# So many columns of cells as fit, the particles in proportion, contacts as soft as overlaps allow. A is joined at its sides and two
# ninths of its width; B has walls, five eighteenths; C a third of its height too, two sevenths of the width. A little more depth
# than the cases have allows thicker skins; without the ledger of energy steps are cheaper.
STRIPS = {
    "A": ["column.size=[8.468e-3,0.32]", "column.cells=[4,195]", 'column.sides="periodic"', "bed.particles=[2208,459]",
          "dem.youngs_modulus=3e4", "dem.fluid_every=8"],
    "B": ["column.size=[16.667e-3,0.93]", "column.cells=[5,297]", "column.depth=4.422e-3", "dem.skin=2e-4",
          "bed.particles=[6233,306]", "dem.youngs_modulus=1e5", "dem.fixed_step=4.5e-5", "dem.fluid_every=10"],
    "C": ["column.size=[4.8e-3,67.2e-3]", "column.cells=[4,56]", "column.depth=1.7e-3", "dem.skin=6e-5", "bed.particles=[3484,66]",
          "dem.youngs_modulus=1e5", "dem.fixed_step=1.75e-5", "dem.fluid_every=11"],
}
ALL = ["dem.ledger=false", "dem.max_overlap=0.1", "output.every=1", "output.history_every=0.1", "output.checkpoint_every=1"]
MODELS = {"dem": "particles", "tfm": "two-fluid"}


def settings(system, velocity, model):
    flow = [f"inlet.superficial_velocity={velocity * 1e-3:g}", f"run.until={TIMES[system][velocity]}"]
    # Outputs are far apart in time for a continuum as well, but it needs no checkpoint each second.
    return [*STRIPS[system], *flow, *(s for s in ALL if model == "dem" or not s.startswith("dem."))]


def scaled(history, name):
    """A column of lengths, mm."""
    return 1e3 * history[name]


def row(system, velocity, model, read):
    """One line of the table: means over the last quarter and how fast the bed still moves there."""
    history = read.history
    late = history["time_s"] >= 0.75 * history["time_s"][-1]
    centres = [scaled(history, f"centre_{name}_m") for name in read.species]
    height, apart = scaled(history, "bed_height_m"), centres[1] - centres[0]
    drift = np.polyfit(history["time_s"][late], height[late], 1)[0]
    drop = np.mean(history["pressure_drop_Pa"][late] / history["buoyant_weight_Pa"][late])
    interface = scaled(history, "interface_m")[late]
    seen = interface[np.isfinite(interface)]  # of mixed layers there is none
    return [system, f"{velocity:g}", MODELS[model], f"{history['time_s'][-1]:.0f}", mean(height[late], 1), f"{drift:+.2f}",
            *(mean(c[late], 1) for c in centres), mean(apart[late], 1), mean((apart / height)[late], 3),
            f"{np.mean(seen):.0f} ({100 * len(seen) / len(interface):.0f} %)" if len(seen) else "none", f"{drop:.4f}",
            f"{read.record['cpu_s']:.0f}" if "cpu_s" in read.record else ""]


def draw(reads, picture):
    """Centres of both species in time, one panel a run of particles, the two-fluid model dashed."""
    runs = sorted({(system, velocity) for system, velocity, _ in reads})
    columns = min(4, len(runs))
    rows = -(-len(runs) // columns)
    with plt.rc_context(STYLE):
        figure, panels = plt.subplots(rows, columns, figsize=(3.1 * columns, 2.7 * rows), dpi=130, squeeze=False, layout="constrained")
        for panel in panels.flat[len(runs):]:
            panel.set_axis_off()
        for panel, (system, velocity) in zip(panels.flat, runs):
            for model, line in zip(MODELS, ("-", "--")):
                read = reads.get((system, velocity, model))
                if read is None:
                    continue
                for name, colour in zip(read.species, COLOURS):
                    panel.plot(read.history["time_s"], scaled(read.history, f"centre_{name}_m"), line, color=colour, lw=1.2,
                               label=f"{name}, {MODELS[model]}")
            panel.set(title=f"{system}, {velocity:g} mm/s", xlabel="time, s", ylim=(0, None))
        panels[0, 0].set_ylabel("centre of volume, mm")
        panels[0, 0].legend(fontsize=7)
        figure.savefig(picture)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("runs", type=Path)
    parser.add_argument("name", nargs="*")
    parser.add_argument("-o", "--output", help="file of the picture")
    parser.add_argument("--read", action="store_true", help="run nothing, read what is there, finished or not")
    parser.add_argument("--model", choices=MODELS, action="append", help="by default both")
    given = parser.parse_args()
    reads = {}
    for system, times in TIMES.items():
        for velocity in times:
            if given.name and f"{system}-{velocity:g}" not in given.name:
                continue
            for model in given.model or MODELS:
                directory = given.runs / f"{system}-{velocity:g}-{model}"
                if not given.read:
                    case = f"thesis-{system.lower()}"
                    run(given.program.resolve(), model, case, directory, settings(system, velocity, model))
                if (directory / "history.csv").exists():
                    reads[system, velocity, model] = polybed.read(directory)
    table(["system", "mm/s", "model", "s", "bed height, mm", "its drift, mm/s", "centre of fine, mm", "centre of coarse, mm",
           "coarse over fine, mm", "over the height", "interface, mm (of the time)", "drop / weight", "CPU s"],
          (row(*key, read) for key, read in reads.items()))
    if given.output:
        draw(reads, given.output)


if __name__ == "__main__":
    main()
