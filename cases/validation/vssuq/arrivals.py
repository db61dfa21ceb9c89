"""When plastic spheres emerge from a bed of glass beads, for `polybed validate vssuq`."""
import numpy as np

NAMES = ("first", "second", "third", "fourth")


def simulated(run, after):
    """{arrival: (times, height of the top of the n-th highest sphere so far above the bed height)} of the stored times from `after` on,
    and one before it. A sphere that has emerged may sink again: it counts as above."""
    stored = run.particles
    bed = np.interp(stored.time, run.history["time_s"], run.history["bed_height_m"])
    first = max(int(np.searchsorted(stored.time, after)) - 1, 0)
    highest, found = None, []
    for step in range(first, len(stored.time)):
        state = stored[step]
        of = state.of("intruder")
        above = state.position[of, 1] + state.radius[of] - bed[step]
        highest = above if highest is None else np.maximum(highest, above)
        found.append(np.sort(highest)[::-1])
    return {name: (stored.time[first:], column) for name, column in zip(NAMES, np.array(found).T)}
