"""Means over time of a run that fluctuates, with the half-widths of their 95 % intervals."""

from typing import NamedTuple

import numpy as np

# Two-sided 95 % quantiles of Student's distribution, by degrees of freedom.
STUDENT = {3: 3.182, 4: 2.776, 5: 2.571, 6: 2.447, 7: 2.365, 8: 2.306, 9: 2.262, 10: 2.228, 19: 2.093}
MOST_GROUPS = 10  # of rows that a jackknife leaves out in turn


class TimeMean(NamedTuple):
    mean: float
    error: float | None = None  # half-width of the interval; None: too few rows to tell
    correlation: float = 1.0  # integrated autocorrelation time, rows


def student_quantile(degrees):
    """The two-sided 95 % quantile: between and beyond the table that of the next smaller entry, which is wider."""
    if degrees < min(STUDENT):
        raise ValueError("fewer than 3 degrees of freedom")
    return STUDENT[max(entry for entry in STUDENT if entry <= degrees)]


def mean_of(values):
    """Mean over the first axis; about the first value, so that the mean of equal numbers is that number."""
    return values[0] + (values - values[0]).sum(axis=0) / len(values)


def squares_of(values):
    """Sum of squares about the mean, over the first axis."""
    return ((values - mean_of(values)) ** 2).sum(axis=0)


def autocorrelation_time(values):
    """1 + 2 sum of the autocorrelation, in rows, up to the first lag that is at least five times half of the sum (Sokal 1997,
    "Monte Carlo methods in statistical mechanics", section 3, c = 5); at least 1. So many rows count as one that is independent."""
    if len(values) < 2:
        return 1.0
    centred = values - mean_of(values)
    square = centred @ centred
    if not square > 0:
        return 1.0
    total = 1.0
    for lag in range(1, len(values)):
        total += 2 * (centred[:-lag] @ centred[lag:]) / square
        if lag >= 2.5 * total:
            break
    return float(max(total, 1.0))


def batch_error(values):
    """Half-width by 20 batches from 40 rows on, else by 10; what does not fill a batch is left out at the beginning. None for fewer
    than 20 rows."""
    batches = 20 if len(values) >= 40 else 10
    length = len(values) // batches
    if length < 2:
        return None
    means = mean_of(values[-batches * length :].reshape(batches, length).T)
    return student_quantile(batches - 1) * np.sqrt(squares_of(means) / (batches - 1) / batches)


def time_mean(values):
    """Mean of a series in equal steps of time; its interval is the wider of that by batch means and that by the autocorrelation time.
    None without rows, or if one of them is not a finite number."""
    values = np.asarray(values, float)
    if not len(values) or not np.isfinite(values).all():
        return None
    mean, error, correlation = float(mean_of(values)), batch_error(values), autocorrelation_time(values)
    if error is None:
        return TimeMean(mean, None, correlation)
    count = len(values)
    independent = max(count / correlation, 4.0)
    by_correlation = student_quantile(int(independent) - 1) * np.sqrt(correlation * squares_of(values) / (count - 1) / count)
    return TimeMean(mean, float(max(error, by_correlation)), correlation)


def rows_to_drop(values):
    """Rows to leave out at the beginning by the marginal standard error rule (White 1997, Simulation 69, 323): the number d that makes
    sum (x - mean)^2/(n - d)^2 over the rows from d on least; at most half of the rows. 0 if a row is no finite number."""
    values = np.asarray(values, float)
    if len(values) < 4 or not np.isfinite(values).all():
        return 0
    return int(np.argmin([squares_of(values[d:]) / (len(values) - d) ** 2 for d in range(len(values) // 2 + 1)]))


def groups_left_out(rows):
    """Which rows are kept while each of at most ten groups of successive rows is left out in turn, an array of truths each; none for
    fewer than four rows."""
    groups = min(rows, MOST_GROUPS)
    kept = np.ones((groups if groups >= 4 else 0, rows), bool)
    for group, row in enumerate(kept):
        row[group * rows // groups : (group + 1) * rows // groups] = False
    return kept


def jackknife_error(without):
    """Half-width of the interval of a function of all rows, by its values without each of groups_left_out() (the delete-a-group
    jackknife: Efron and Tibshirani 1993, chapter 11), a number each or an array of them. None without four groups, or where one has no
    value. Rough for a function that jumps."""
    if len(without) < 4 or any(value is None for value in without):
        return None
    without = np.asarray(without, float)
    groups = len(without)
    return student_quantile(groups - 1) * np.sqrt(squares_of(without) * (groups - 1) / groups)
