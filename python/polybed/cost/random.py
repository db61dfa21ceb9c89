"""Random numbers that belong to their place in a sequence, not to the order in which they are drawn: those of core/numerics/random.hpp.
Numbers and arrays of whole numbers alike."""

import numpy as np


def mixed_bits(x):
    """Mixes 64 bits thoroughly (splitmix64; Steele, Lea and Flood, OOPSLA 2014)."""
    x = np.asarray(x, np.uint64) + np.uint64(0x9E3779B97F4A7C15)
    x = (x ^ (x >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    x = (x ^ (x >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return x ^ (x >> np.uint64(31))


def uniform(seed, sequence, index):
    """The number of a sequence at an index, uniform in [0, 1)."""
    with np.errstate(over="ignore"):  # 64 bits are meant
        begin = mixed_bits(mixed_bits(seed) ^ np.asarray(sequence, np.uint64))
        return (mixed_bits(begin + np.asarray(index, np.uint64)) >> np.uint64(11)) * 2.0**-53
