#!/usr/bin/python3
"""The fine particles of system B alone at 20 mm/s, in boxes of one to sixteen cells across: streams.py PROGRAM RUNS [NAME ...] [--read]

Does the bed contract as streams find room? NAME, for instance 4-across, chooses; without it all are run: two hours on one core. A run
that is done is not run again, one that was stopped goes on where it was. Prints means over the last third of the time. --read: run
nothing.
"""
import numpy as np
from strips import arguments, mean, run, table

import polybed

CASE = """
[column]
sides = "periodic"
[fluid]
name        = "water"
temperature = "15 degC"
[[species]]
name     = "fine"
diameter = "0.807 mm"
density  = "1395 kg/m3"
[bed]
solids_fraction       = 0.62
start_solids_fraction = 0.50
[inlet]
superficial_velocity = "20 mm/s"
[effects]
drag         = "cello"
fluid_stress = "newtonian"
contact      = "hertz_mindlin"
others       = "none"
[dem]
youngs_modulus = "0.1 MPa"
fixed_step     = 4.5e-5
fluid_every    = 10
skin           = "0.2 mm"
max_overlap    = 0.1
ledger         = false
greatest_speed = "0.1 m/s"
[run]
until = "45 s"
[output]
every            = "1 s"
checkpoint_every = "1 s"
history_every    = "0.1 s"
"""
CELL, DEPTH, HEIGHT, LAYERS = 60 / 18, 4.422, 440, 141  # mm; upright cells of the column of B
DIAMETER, SOLIDS = 0.807, 23.04  # mm; volume of the particles over the area
# Cells across and, in three dimensions, in depth; what differs.
RUNS = {
    "1-across": (1, 0, []),
    "1-across-6mm": (1, 0, ["dem.kernel_width=6e-3"]),
    "1-across-12mm": (1, 0, ["dem.kernel_width=12e-3"]),
    "2-across": (2, 0, []),
    "4-across": (4, 0, []),
    "4-across-6mm": (4, 0, ["dem.kernel_width=6e-3"]),
    "4-across-12mm": (4, 0, ["dem.kernel_width=12e-3"]),
    "4-across-lift": (4, 0, ['effects.lift="saffman_mei"']),
    "8-across": (8, 0, []),
    "16-across": (16, 0, []),
    "4-by-4": (4, 4, []),
}


def settings(across, deep, own):
    width, depth = across * CELL, deep * CELL if deep else DEPTH
    particles = round(SOLIDS * width * depth / (np.pi / 6 * DIAMETER**3))
    size, cells = ((f"[{width:g}e-3,{depth:g}e-3,{HEIGHT}e-3]", f"[{across},{deep},{LAYERS}]") if deep else
                   (f"[{width:g}e-3,{HEIGHT}e-3]", f"[{across},{LAYERS}]"))
    return [f"column.size={size}", f"column.cells={cells}", *([] if deep else [f"column.depth={DEPTH}e-3"]),
            f"bed.particles=[{particles}]", *own]


def row(name, read):
    history = read.history
    late = history["time_s"] >= 2 / 3 * history["time_s"][-1]
    centre = 1e3 * history["centre_fine_m"][late]
    drift = np.polyfit(history["time_s"][late], centre, 1)[0]
    # A bed that is uniform between its bottom and its surface stands twice as high as its centre.
    return [name, f"{history['time_s'][-1]:.0f}", mean(SOLIDS / (2 * centre), 4), f"{drift:+.2f}",
            mean((history["pressure_drop_Pa"] / history["buoyant_weight_Pa"])[late], 4), f"{read.record.get('cpu_s', 0):.0f}"]


def main():
    given = arguments(__doc__, RUNS)
    given.runs.mkdir(parents=True, exist_ok=True)
    (given.runs / "case.toml").write_text(CASE)
    rows = []
    for name in given.name or RUNS:
        directory = given.runs / name
        if not given.read:
            run(given.program.resolve(), "dem", given.runs.resolve(), directory, settings(*RUNS[name]))
        if (directory / "history.csv").exists():
            rows.append(row(name, polybed.read(directory)))
    table(["box", "s", "solids fraction", "drift of the centre, mm/s", "drop / weight", "CPU s"], rows)


if __name__ == "__main__":
    main()
