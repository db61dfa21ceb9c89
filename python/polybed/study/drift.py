"""Whether a run has become steady: what its heights still drift by, as measures/drift.hpp has it of a run that goes on."""

import numpy as np

PARTS = 10
STUDENT = 2.306  # 97.5 % quantile, eight degrees of freedom
WINDOW_SHARE = 0.25  # of the time seen
MATTERS = 1e-3  # of the bed's height


def drift_of(time, values):
    """(slope, half-width of its 95 % interval), 1/s, by least squares through the means of ten equal parts of the time spanned; None
    where a part has no value."""
    if not len(time) or not time[-1] > time[0]:
        return None
    part = np.minimum((PARTS * (time - time[0]) / (time[-1] - time[0])).astype(int), PARTS - 1)
    count = np.bincount(part, minlength=PARTS)
    if not count.all():
        return None
    t, y = (np.bincount(part, weights=w, minlength=PARTS) / count for w in (time, values))
    t, y = t - t.mean(), y - y.mean()
    rate = (t @ y) / (t @ t)
    return rate, STUDENT * np.sqrt(((y - rate * t) ** 2).sum() / (PARTS - 2) / (t @ t))


def drift_lines(time, heights):
    """One line for each height that still drifts in the last quarter: its slope is certain, and would move it by more than a thousandth
    of the bed's height in another run as long. heights: series by name, the first that of the bed."""
    if not len(time):
        return []
    span = time[-1] - time[0]
    window, bed = WINDOW_SHARE * span, next(iter(heights.values()))[-1]
    late = slice(int(np.searchsorted(time, time[-1] - window)), None)
    lines = []
    for name, values in heights.items():
        drift = drift_of(time[late], values[late])
        if drift is None or not np.isfinite(drift[0]) or abs(drift[0]) <= drift[1] or abs(drift[0]) * span <= MATTERS * bed:
            continue
        lines.append(f"not steady: drift of {name} {1e3 * drift[0]:.3g} ± {1e3 * drift[1]:.2g} mm/s over the last {window:.3g} s")
    return lines
