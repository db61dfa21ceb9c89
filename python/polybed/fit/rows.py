"""Rows of drag data: the output of `polybed resolve`, and the tables of tests/data/lbm.

A point is one voidage, Reynolds number and composition with the net force on each of its sizes. Files are told apart by their header:

    eps,Re,n               one size; also f, f_LBM or f_TL, the pure drag, n = f/eps
    eps,Re,x1,D1,...       shares and diameters, then n_1,n_1_se,... the net force on each size and its standard error
    eps,Rebar,D1_over_D2_used,x1,n1_LBM,n2_LBM     two sizes
    eps,Rebar,y_j,n_j_LBM,...                      a row for each size; shares x_j, or those of inferred_xj_sarkar.csv beside it
"""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from polybed.files import finite, read_text
from polybed.ending import FILE, WRONG_CASE, StudyError

SHARES = "inferred_xj_sarkar.csv"
FORCES = ("f_LBM", "f_TL", "n", "f")  # columns of one size; n is the net force, the others the pure drag


@dataclass
class Point:
    """Net forces are over Stokes, n_j = N_j/(3 pi mu D_j u); NaN where a size was not measured."""
    source: str  # name of the file
    where: str  # file and line
    voidage: float
    reynolds: float  # of the Sauter diameter
    share: np.ndarray
    diameter: np.ndarray
    net: np.ndarray
    error: np.ndarray  # standard errors of net; NaN where they are not known

    @property
    def y(self):
        """Diameters over the Sauter diameter."""
        return self.diameter * (self.share / self.diameter).sum()

    def key(self):
        """Equal for repeated points."""
        return (self.voidage, self.reynolds, *self.share, *self.diameter / self.diameter[0], *self.net)


class Row(dict):
    """A line of a table by its columns."""

    def __init__(self, path, line, cells):
        super().__init__(cells)
        self.path, self.where = path, f"{path}:{line}"

    def number(self, column, missing=None):
        """A cell as a number. missing: the value of an empty cell or a missing column; None refuses it"""
        text = self.get(column, "")
        if text == "" and missing is not None:
            return missing
        try:
            return finite(text)
        except ValueError:
            place = list(self).index(column) + 1 if column in self else 0
            raise StudyError(WRONG_CASE, f"{self.where}: {column} (cell {place}) = '{text}' is no number") from None


def rows_of(path):
    """The lines of a table below its header."""
    numbered = [(n, line) for n, line in enumerate(read_text(path).split("\n"), 1) if line.strip() and not line.startswith("#")]
    if not numbered:
        raise StudyError(WRONG_CASE, f"{path}: no header and no rows")
    try:
        columns, *lines = csv.reader(line for _, line in numbered)
    except csv.Error as error:
        raise StudyError(WRONG_CASE, f"{path}: no table: {error}") from error
    for (number, _), cells in zip(numbered[1:], lines):
        if len(cells) != len(columns):
            raise StudyError(WRONG_CASE, f"{path}:{number}: {len(cells)} cells, the header has {len(columns)}")
    return set(columns), [Row(path, number, zip(columns, cells)) for (number, _), cells in zip(numbered[1:], lines)]


def point(row, reynolds, share, diameter, net, error=None):
    """reynolds: its column"""
    share, diameter, net = (np.array(values, float) for values in (share, diameter, net))
    error = np.full(len(net), np.nan) if error is None else np.array(error, float)
    voidage, reynolds = row.number("eps"), row.number(reynolds)
    refuse = [(not 0 < voidage <= 1, f"eps = {voidage:g} is outside (0, 1]"),
              (not reynolds >= 0, f"Reynolds number {reynolds:g} is below 0"),
              (not (share >= 0).all() or abs(share.sum() - 1) > 0.02, f"shares {share} are below 0 or do not sum to 1"),
              (not (diameter > 0).all(), f"diameters {diameter} are not above 0"),
              (np.isnan(net).all() or (net <= 0).any(), f"net forces {net} are not above 0")]
    for wrong, what in refuse:
        if wrong:
            raise StudyError(WRONG_CASE, f"{row.where}: {what}")
    return Point(Path(row.path).name, row.where, voidage, reynolds, share / share.sum(), diameter, net, error)


def one_size(row):
    column = next(name for name in FORCES if name in row)
    per, error = (1, row.number("n_se", np.nan)) if column == "n" else (1 / row.number("eps"), np.nan)
    return point(row, "Re", [1], [1], [per * row.number(column)], [error])


def any_sizes(row):
    """A row of `polybed resolve`. A size without share has an empty cell, or share 0, and no force."""
    found = [j for j in range(1, len(row)) if row.number(f"x{j}", 0.0) > 0]
    return point(row, "Re", *([row.number(name.format(j), missing) for j in found]
                              for name, missing in (("x{}", None), ("D{}", None), ("n_{}", np.nan), ("n_{}_se", np.nan))))


def two_sizes(row):
    first = row.number("x1")
    return point(row, "Rebar", [first, 1 - first], [row.number("D1_over_D2_used"), 1], [row.number(f"n{j}_LBM", np.nan) for j in (1, 2)])


def inferred_shares(path):
    """The shares by system and y_j."""
    beside = Path(path).parent / SHARES
    if not beside.is_file():
        raise StudyError(FILE, f"{path} has no shares x_j, and {beside} is missing")
    return {(row["system"], row.number("y_j")): row.number("x_j") for row in rows_of(beside)[1]}


def row_for_each_size(rows):
    """Joins the rows of one system, voidage and Reynolds number to a point."""
    shares = {} if "x_j" in rows[0] else inferred_shares(rows[0].path)
    groups = {}
    for row in rows:
        groups.setdefault((row["system"], row.number("eps"), row.number("Rebar")), []).append(row)
    points = []
    for (system, _, _), sizes in groups.items():
        y = [row.number("y_j") for row in sizes]
        x = np.array([shares.get((system, size), np.nan) if shares else row.number("x_j") for row, size in zip(sizes, y)])
        x = x / x.sum() if abs(x.sum() - 1) < 0.1 else x  # some classes are not printed
        points.append(point(sizes[0], "Rebar", x, y, [row.number("n_j_LBM", np.nan) for row in sizes]))
    return points


def points_of_file(path):
    columns, rows = rows_of(path)
    if {"x1", "u_1"} <= columns:
        raise StudyError(WRONG_CASE, f"{path}:1: rows of free spheres have a slip u_j of each species at its weight, not the forces n_j at one "
                                     'slip, and cannot be fitted: run polybed resolve with resolve.motion = "held"')
    if {"eps", "Re"} <= columns and "D1" not in columns and columns & set(FORCES):
        return list(map(one_size, rows))
    if {"eps", "Re", "x1", "D1", "n_1"} <= columns:
        return list(map(any_sizes, rows))
    if {"eps", "Rebar", "D1_over_D2_used", "x1", "n1_LBM", "n2_LBM"} <= columns:
        return list(map(two_sizes, rows))
    if {"eps", "Rebar", "system", "y_j", "n_j_LBM"} <= columns:
        return row_for_each_size(rows) if rows else []
    raise StudyError(WRONG_CASE, f"{path}:1: unknown columns: expected eps,Re,n or eps,Re,x1,D1,...,n_1,n_1_se,... or a table of "
                                 "tests/data/lbm")


def read_points(paths):
    """The points of files, each once. A folder stands for its tables tab_A_*.csv, or for its rows.csv."""
    files = [file for path in map(Path, paths)
             for file in (sorted(path.glob("tab_A_*.csv")) or sorted(path.glob("rows.csv")) if path.is_dir() else [path])]
    if not files:
        raise StudyError(FILE, f"{', '.join(map(str, paths))}: no tables tab_A_*.csv and no rows.csv there")
    points, seen = [], set()
    for file in files:
        for found in points_of_file(file):
            if np.size(found.net) == 1 or found.key() not in seen:  # the accuracy page counts every row of one size
                points.append(found)
            seen.add(found.key())
    return points
