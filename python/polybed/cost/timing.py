"""What may be said of measured times, and of two runs that should be the same."""

from typing import NamedTuple

import numpy as np

MOST_NOISE, PARTED, CONSTANT = 0.1, 1e-2, 1e-9


class Timing(NamedTuple):
    """Times of one and the same run, summed up, s: median, median absolute deviation, and between the first and the third quartile."""
    median: float = 0.0
    deviation: float = 0.0
    quartiles: float = 0.0


def timing_of(seconds):
    """Quantiles are linear between the sorted values. Raises ValueError for none."""
    if not len(seconds):
        raise ValueError("no times")
    low, median, high = np.quantile(seconds, [0.25, 0.5, 0.75])
    return Timing(float(median), float(np.median(np.abs(np.asarray(seconds) - median))), float(high - low))


def too_noisy(timing, load, cores):
    """Why speeds are not to be ranked: the interquartile range exceeds 10 % of the median, or the load the cores; None if they may be."""
    if timing.quartiles > MOST_NOISE * timing.median:
        return f"machine busy: half of the times of one run span {100 * timing.quartiles / timing.median:.0f} % of their median"
    return f"machine busy: load {load:.1f} on {cores:.0f} cores" if load > cores else None


def is_chaotic(signal, twin):
    """Whether two runs that differ by 1e-10 part by more than a hundredth of what the signal varies by. What is constant to 1e-9 of its
    mean is steady. signal, twin: the same quantity at the same times"""
    count = min(len(signal), len(twin))
    if count < 2:
        return False
    signal, twin = np.asarray(signal[:count]), np.asarray(twin[:count])
    deviation, distance = signal.std(), np.abs(signal - twin).max()
    return bool(deviation > CONSTANT * abs(signal.mean()) and distance > PARTED * deviation)
