"""One dense periodic packing of equal spheres for all programs that dem_peers.py compares; numpy alone makes it.

Random points relax as soft spheres until their forces vanish (O'Hern et al. 2003): that jams at a solid fraction of
0.64 with six contacts per particle, however many there are. Lengths inside are particle diameters.
"""
import math

import numpy as np

HALF_STENCIL = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1) if (i, j, k) > (0, 0, 0)]


def within(x, box, reach):
    """Pairs (i, j), i and j arrays of indices, closer than `reach` in a periodic cube; each pair once."""
    n = int(box / reach)
    if n < 3:
        raise ValueError(f"a box of {box} needs three cells of {reach}")
    table, cell = cells_of(x, box, n)
    i, j = [], []
    for shift in [(0, 0, 0), *HALF_STENCIL]:
        other = table[tuple(((cell + shift) % n).T)]
        first = np.repeat(np.arange(len(x)), other.shape[1])
        second = other.ravel()
        real = (second > first) if shift == (0, 0, 0) else (second >= 0)
        first, second = first[real], second[real]
        close = np.sum(nearest(x[first] - x[second], box) ** 2, axis=1) < reach * reach
        i.append(first[close])
        j.append(second[close])
    return np.concatenate(i), np.concatenate(j)


def cells_of(x, box, n):
    """Table of cell by place in it, -1 where empty, and the cell of each point."""
    cell = np.minimum((x / box % 1 * n).astype(int), n - 1)
    flat = (cell[:, 0] * n + cell[:, 1]) * n + cell[:, 2]
    order = np.argsort(flat, kind="stable")
    count = np.bincount(flat, minlength=n**3)
    place = np.arange(len(x)) - np.repeat(np.cumsum(count) - count, count)
    table = np.full((n**3, count.max()), -1)
    table[flat[order], place] = order
    return table.reshape(n, n, n, -1), cell


def nearest(difference, box):
    return difference - box * np.rint(difference / box)


def overlaps(x, box, pairs):
    """1 - r of the pairs, and their unit vectors."""
    d = nearest(x[pairs[0]] - x[pairs[1]], box)
    r = np.sqrt(np.einsum("ij,ij->i", d, d))
    return 1 - r, d / r[:, None]


def forces(x, box, pairs):
    overlap, normal = overlaps(x, box, pairs)
    touching = overlap > 0
    i, j = pairs[0][touching], pairs[1][touching]
    f = overlap[touching, None] * normal[touching]
    return np.stack([np.bincount(i, f[:, c], len(x)) - np.bincount(j, f[:, c], len(x)) for c in range(3)], axis=1)


def settle(count, fraction, seed, tolerance=1e-4, most=4000):
    """Positions and box of `count` soft spheres at rest: FIRE (Bitzek et al. 2006) on the energy sum (1 - r)^2/2.

    tolerance: root mean square of the net forces, whose unit is the stiffness times the diameter.
    """
    box = (count * math.pi / 6 / fraction) ** (1 / 3)
    x = np.random.default_rng(seed).random((count, 3)) * box
    v, listed, step, mixing, downhill = np.zeros_like(x), None, 0.1, 0.1, 0
    for _ in range(most):
        if listed is None or np.abs(x - listed).max() > 0.08:
            listed, pairs = x.copy(), within(x, box, 1.3)  # 2 sqrt(3) 0.08 < 0.3
        f = forces(x, box, pairs)
        norm = np.linalg.norm(f)
        if norm < tolerance * math.sqrt(count):
            return x % box, box
        downhill = downhill + 1 if np.vdot(f, v) > 0 else 0
        if downhill == 0:
            v[:], step, mixing = 0, step / 2, 0.1
        elif downhill > 5:
            step, mixing = min(1.1 * step, 0.5), 0.99 * mixing
        v += step * f
        v = (1 - mixing) * v + mixing * np.linalg.norm(v) / norm * f
        x = x + step * v
    raise RuntimeError(f"{count} spheres are not at rest after {most} steps")


def tile(x, box, copies):
    """The packing repeated `copies` times along each axis."""
    shifts = np.array([(i, j, k) for i in range(copies) for j in range(copies) for k in range(copies)]) * box
    return (shifts[:, None] + x[None]).reshape(-1, 3), copies * box
