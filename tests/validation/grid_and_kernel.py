#!/usr/bin/python3
"""Cells and kernel of a strip of system C, each changed alone: grid_and_kernel.py PROGRAM RUNS [PICTURE]

Heights of the cells are the thesis's, 1.55 and 1.80 coarse diameters; kernels bilinear weights (as wide as a cell) and a Gaussian
of four coarse diameters. A run that is done is not run again and one that was stopped goes on, so that the command may be killed
and given again.
"""
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from strips import mean, run, table

import polybed
from polybed.drawing.style import STYLE

COARSE = 0.776  # mm, diameter
END = 1.3  # s
HEIGHT = 33.6  # mm, of the column: 28 cells of 1.2 mm or 24 of 1.4 mm
CELLS = {"1.55": 28, "1.80": 24}  # height over the coarse diameter: number
KERNELS = {"bilinear": None, "4 diameters": 4 * COARSE}
COLOURS = {"1.55": "tab:blue", "1.80": "tab:orange"}
CORNERS = [(cell, kernel) for kernel in KERNELS for cell in CELLS]
# Two sevenths of the width and about a third of the bed's height, the particles in proportion; cells 1.2 mm wide. To make it cheap:
# a third of the weight bears softer contacts, a step of 0.3 sqrt(m/k) still resolves them, a little depth allows a thicker skin.
STRIP = [f'column.size=["4.8 mm","{HEIGHT} mm"]', 'column.depth="1.7 mm"', 'dem.skin="0.06 mm"', "bed.particles=[3484,66]",
         'inlet.superficial_velocity="10 mm/s"', 'dem.youngs_modulus="0.05 MPa"', 'dem.fixed_step="25 us"', "dem.fluid_every=8",
         "dem.max_overlap=0.1", "dem.ledger=false", 'output.every="0.5 s"', 'output.history_every="10 ms"',
         'output.checkpoint_every="0.5 s"', f'run.until="{END} s"']


def settings(cell, kernel):
    width = KERNELS[kernel]
    chosen = ["dem.kernel=bilinear"] if width is None else ["dem.kernel=diffusion", f'dem.kernel_width="{width} mm"']
    return [*STRIP, *chosen, f"column.cells=[4,{CELLS[cell]}]"]


def apart(history):
    """Centre of the coarse over that of the fine, mm."""
    return 1e3 * (history["centre_coarse_m"] - history["centre_fine_m"])


def row(name, run):
    """One line of the table: means over the last half, also of a run that went on for longer."""
    history = run.history
    late = (history["time_s"] >= 0.5 * END) & (history["time_s"] <= END)
    height = 1e3 * history["bed_height_m"]
    drop = np.mean(history["pressure_drop_Pa"][late] / history["buoyant_weight_Pa"][late])
    return [*name, mean(height[late]), mean(apart(history)[late]), mean((apart(history) / height)[late], 3), f"{drop:.3f}"]


def draw(runs, picture):
    with plt.rc_context(STYLE):
        figure, panels = plt.subplots(1, 2, figsize=(9, 3.4), dpi=130, sharey=True, layout="constrained")
        for panel, kernel in zip(panels, KERNELS):
            for cell in CELLS:
                history = runs[cell, kernel].history
                panel.plot(history["time_s"], apart(history), color=COLOURS[cell], lw=1.2, label=f"cells {cell} D_2 high")
            panel.set(title=f"kernel: {kernel}", xlabel="time, s")
        panels[0].set_ylabel("coarse over fine, mm")
        panels[0].legend()
        figure.savefig(picture)


def main(program, folder, picture=None):
    runs = {}
    for corner in CORNERS:
        directory = folder / "C-{}-{}".format(*corner).replace(" ", "-")
        run(program, "dem", "thesis-c", directory, settings(*corner))
        runs[corner] = polybed.read(directory)
    head = ["cell / D_2", "kernel", "bed height, mm", "coarse over fine, mm", "over the height", "drop / weight"]
    table(head, (row(corner, each) for corner, each in runs.items()))
    if picture:
        draw(runs, picture)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]), *sys.argv[3:])
