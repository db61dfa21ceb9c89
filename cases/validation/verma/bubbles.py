"""Diameters of bubbles in horizontal planes of a run, for `polybed validate verma`.

A bubble is a region of cells of a plane with a voidage above 0.8; cells belong together if they share a side. Its diameter is that of a circle with the same
area. Regions of fewer than three cells are left out. Planes lie at the heights of measured.csv, between two rows of cells.
"""
import numpy as np
from scipy import ndimage

THRESHOLD = 0.8  # of voidage, as in cases/taghipour/bubbles.py
LEAST_CELLS = 3
HEIGHTS = ("0.04", "0.05", "0.095", "0.10")  # m


def plane(voidage, y, height):
    """The voidage [z][x] at a height, linear between cells."""
    above = int(np.clip(np.searchsorted(y, height), 1, len(y) - 1))
    share = (height - y[above - 1]) / (y[above] - y[above - 1])
    return (1 - share) * voidage[:, above - 1] + share * voidage[:, above]


def diameters(voidage, cell):
    """Diameters of the bubbles of a plane; cell: area of a cell, m2"""
    labels, count = ndimage.label(voidage > THRESHOLD)
    sizes = ndimage.sum_labels(np.ones_like(labels), labels, np.arange(1, count + 1))
    return np.sqrt(4 / np.pi * cell * sizes[sizes >= LEAST_CELLS])


def simulated(run, after):
    """{height: (times, mean diameter in the plane)} of the stored times from `after` on at which the plane cuts a bubble."""
    x, y, z = (np.asarray(run.faces[axis]) for axis in "xyz")
    centres, cell = 0.5 * (y[1:] + y[:-1]), (x[1] - x[0]) * (z[1] - z[0])
    found = {height: [] for height in HEIGHTS}
    for step in np.nonzero(run.time >= after)[0]:
        voidage = run.voidage[int(step)]
        for height, rows in found.items():
            each = diameters(plane(voidage, centres, float(height)), cell)
            if len(each):
                rows.append((run.time[step], each.mean()))
    return {height: tuple(np.array(rows).reshape(-1, 2).T) for height, rows in found.items()}
