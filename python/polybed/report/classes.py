"""A species with size classes is drawn as one: its volume fractions add up, its velocities are means weighted with them."""

import numpy as np

SUMS = "the size classes of a species are added up; polybed plot RUN --what fields draws each"


def parts_of(run, name):
    """The stored names behind the name of a field or profile: ["phi_sand.1", "phi_sand.2"] for "phi_sand"."""
    kind, _, species = name.partition("_")
    return [f"{kind}_{one}" for one in run.kinds.get(species, [species])] if species else [name]


def mean_over(values, shares):
    """The mean of arrays, one for each size class, weighted with the volume fractions of the classes; 0 where all of these are 0."""
    total = sum(shares)
    weighted = sum(value * share for value, share in zip(values, shares))
    return np.divide(weighted, total, out=np.zeros_like(total), where=total > 0)
