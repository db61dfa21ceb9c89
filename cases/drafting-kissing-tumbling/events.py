#!/usr/bin/python3
"""When two falling spheres draw near, touch and part sideways: events.py RUN

Until the lower one is a diameter over the floor. Code 1 if an event is missing or they come in another order.
"""
import sys
from pathlib import Path

import h5py
import numpy as np

NEAR = 0.9  # of the gap at the start: drafting
ASIDE = 0.5  # diameters between the centres, sideways: tumbling; at the start 0.01


def first(time, happens):
    """First time of `happens`; None if there is none."""
    found = np.flatnonzero(happens)
    return float(time[found[0]]) if len(found) else None


def events(time, position, diameter):
    """First times of drafting, kissing and tumbling; position [step][sphere][x, y, z], y over the floor."""
    landed = np.flatnonzero(position[:, :, 1].min(axis=1) < 1.5 * diameter)
    if len(landed):
        time, position = time[:landed[0]], position[:landed[0]]
    apart = position[:, 1] - position[:, 0]
    gap, aside = np.linalg.norm(apart, axis=1) - diameter, np.hypot(apart[:, 0], apart[:, 2])
    return {"drafting": first(time, gap < NEAR * gap[0]), "kissing": first(time, gap < 1e-3 * diameter),
            "tumbling": first(time, aside > ASIDE * diameter)}


def main():
    with h5py.File(Path(sys.argv[1]) / "particles.h5") as file:
        steps = [file[f"step/{n + 1:06d}"] for n in range(len(file["time_s"]))]
        position = np.array([step["position"][()] for step in steps])
        found = events(file["time_s"][()], position, 2 * steps[0]["radius"][0])
    for name, time in found.items():
        print(f"{name}: " + ("not seen" if time is None else f"{time:.3f} s"))
    times = list(found.values())
    sys.exit(None in times or times != sorted(times))


if __name__ == "__main__":
    main()
