"""Recovery of each species and size class in two runs of one case, in all and through each of several exits: the share that leaves."""

import math
import re
import tomllib

import numpy as np

from polybed.files import contents_of
from polybed.study.measured import TimeMean, statistics_of, within

NORMAL = 1.959964  # two-sided 95 % quantile
WAY = re.compile(r"out|top|discharge\d+")  # begins a column of mass that has left


def counted_interval(share, number):
    """Half-width of the 95 % interval of the share of a number of particles, above 0, that leave independently of each other: the longer side of
    Wilson's interval (J. Am. Stat. Assoc. 22, 1927, 209). It exceeds 0 even if none or all have left."""
    square = NORMAL**2 / number
    half = NORMAL * math.sqrt(share * (1 - share) / number + square / (4 * number))
    return (half + abs(share - 0.5) * square) / (1 + square)


def particle_mass(case, species):
    """Mass of one particle of a species of a resolved case, kg."""
    [keys] = [keys for keys in tomllib.loads(case)["species"] if keys["name"] == species]
    return keys["density"] * math.pi / 6 * keys["diameter"] ** 3


def is_recovery(measure):
    """By its name."""
    return measure.startswith("recovery_")


def ways_of(history, species):
    """Columns of the mass of a species that has left, by "recovery_<species>" and "recovery_<exit>_<species>"."""
    end = f"_{species}_kg"
    ways = {column.removesuffix(end): column for column in history if column.endswith(end)}
    return {f"recovery_{'' if way == 'out' else way + '_'}{species}": column for way, column in ways.items() if WAY.fullmatch(way)}


def by_count(shares, number):
    """The shares of a number of particles with at least the interval of their count."""
    return {name: TimeMean(mean, max(error or 0, counted_interval(min(max(mean, 0), 1), number))) for name, (mean, error, *_) in shares.items()}


def since_the_start(run, ways, species, window):
    """Shares of what was there and has been fed by the end of the window, without intervals; and kg of that."""
    def at_the_end(column):
        return within(run.history["time_s"], run.history[column], window)[-1]
    fed = f"in_{species}_kg"
    supplied = float(run.history[f"mass_{species}_kg"][0] + (at_the_end(fed) if fed in run.history else 0))
    return {name: TimeMean(float(at_the_end(column)) / supplied) for name, column in ways.items() if supplied > 0}, supplied


def of_the_feed(run, ways, species, window):
    """Shares of what is fed in the window with their intervals, and kg of that; ({}, 0) if nothing is or if there are too few rows."""
    gained = {column: np.diff(within(run.history["time_s"], values, window)) for column, values in run.history.items() if column.endswith("_kg")}
    fed = gained.get(f"in_{species}_kg", np.zeros(1))
    if not fed.sum() > 0:
        return {}, 0
    found = statistics_of(ratios=[(gained[column], fed) for column in ways.values()])["ratios"]
    return {name: TimeMean(one["value"], one["interval"]) for name, one in zip(ways, found) if one["interval"] is not None}, float(fed.sum())


def recoveries(tfm, dem, species, window):
    """By name the recovery in both runs: none if nothing leaves. A species that is fed in the window has the share of that feed, another the share
    of all since the start. That is one number without an interval, but particles have at least that of their count: it is a lower bound, because
    they do not leave independently."""
    found = {}
    for name in species:
        ways = [ways_of(run.history, name) for run in (tfm, dem)]
        ways = {key: column for key, column in ways[0].items() if key in ways[1]}
        if not ways:
            continue
        (first, _), (second, supplied) = (of_the_feed(run, ways, name, window) for run in (tfm, dem))
        if not (first and second):
            (first, _), (second, supplied) = (since_the_start(run, ways, name, window) for run in (tfm, dem))
        with contents_of(f"{dem.directory}/run.json"):
            second = by_count(second, supplied / particle_mass(dem.record["case"], name)) if second else {}
        found |= {key: (first[key], second[key]) for key in ways if key in first and key in second}
    return found if any(mean.mean > 0 for pair in found.values() for mean in pair) else {}
