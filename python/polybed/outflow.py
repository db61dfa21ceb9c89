"""What has left a bed, from the columns of its history: mass by species, recovery, and the rate of discharge."""

import numpy as np

PARTS = 40  # of the time, over each of which a rate is a mean


def mass_out(history, species):
    """Mass of each species that has left since the start, kg, by name; only of runs that count it, and in which some has left."""
    found = {name: history[f"out_{name}_kg"] for name in species if f"out_{name}_kg" in history}
    return found if any(np.nanmax(values, initial=0) > 0 for values in found.values()) else {}


def recovery(history, species):
    """Share of each species that has left, of all that was there at the start or has been fed since, by name; 0 to 1."""
    found = {}
    for name, out in mass_out(history, species).items():
        fed = history.get(f"in_{name}_kg", np.zeros_like(out))
        there = history[f"mass_{name}_kg"][0] + fed
        found[name] = np.divide(out, there, out=np.full_like(out, np.nan), where=there > 0)
    return found


def discharge_rate(history, species):
    """(times, kg/s): of all species together, means over a fortieth of the time, at its middle; empty where nothing leaves."""
    time, out = history["time_s"], list(mass_out(history, species).values())
    if not out or len(time) < 3:
        return np.empty(0), np.empty(0)
    parts = min(PARTS, len(time) - 1)
    edges = np.linspace(time[0], time[-1], parts + 1)
    mass = np.interp(edges, time, sum(out))
    return (edges[1:] + edges[:-1]) / 2, np.diff(mass) / np.diff(edges)
