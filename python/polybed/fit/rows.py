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

from polybed.files import read_text
from polybed.ending import FILE, WRONG_CASE, StudyError

SHARES = "inferred_xj_sarkar.csv"


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

    def key(self):
        """Equal for repeated points."""
        return (self.voidage, self.reynolds, *self.share, *self.diameter / self.diameter[0], *self.net)


class Lines:
    """The lines of a table, each a dictionary, with their numbers in the file."""

    def __init__(self, path):
        self.path = path
        numbered = [(n, line) for n, line in enumerate(read_text(path).split("\n"), 1) if line.strip() and not line.startswith("#")]
        if not numbered:
            raise StudyError(WRONG_CASE, f"{path}: no header and no rows")
        try:
            self.columns, *cells = csv.reader(line for _, line in numbered)
        except csv.Error as error:
            raise StudyError(WRONG_CASE, f"{path}: no table: {error}") from error
        self.rows = []
        for (number, _), row in zip(numbered[1:], cells):
            if len(row) != len(self.columns):
                raise StudyError(WRONG_CASE, f"{path}:{number}: {len(row)} cells, the header has {len(self.columns)}")
            self.rows.append((number, dict(zip(self.columns, row))))

    def has(self, *columns):
        return set(columns) <= set(self.columns)

    def where(self, number):
        return f"{self.path}:{number}"

    def number(self, row, column, missing=None):
        """A cell as a number. missing: the value of an empty cell or a missing column; None refuses it"""
        line, cells = row
        text = cells.get(column, "")
        if text == "" and missing is not None:
            return missing
        try:
            value = float(text)
        except ValueError:
            value = np.nan
        if not np.isfinite(value):
            place = self.columns.index(column) + 1 if column in self.columns else 0
            raise StudyError(WRONG_CASE, f"{self.where(line)}: {column} (cell {place}) = '{text}' is no number")
        return value


def point(lines, row, reynolds, share, diameter, net, error=None):
    line = row[0]
    share, diameter, net = (np.array(values, float) for values in (share, diameter, net))
    error = np.full(len(net), np.nan) if error is None else np.array(error, float)
    voidage, where = lines.number(row, "eps"), lines.where(line)
    refuse = [(not 0 < voidage <= 1, f"eps = {voidage:g} is outside (0, 1]"),
              (not reynolds >= 0, f"Reynolds number {reynolds:g} is below 0"),
              (not (share >= 0).all() or abs(share.sum() - 1) > 0.02, f"shares {share} are below 0 or do not sum to 1"),
              (not (diameter > 0).all(), f"diameters {diameter} are not above 0"),
              (np.isnan(net).all() or (net <= 0).any(), f"net forces {net} are not above 0")]
    for wrong, what in refuse:
        if wrong:
            raise StudyError(WRONG_CASE, f"{where}: {what}")
    return Point(Path(lines.path).name, where, voidage, reynolds, share / share.sum(), diameter, net, error)


def one_size(lines, column):
    points = []
    for row in lines.rows:
        given = lines.number(row, column)
        net = given if column == "n" else given / lines.number(row, "eps")
        error = lines.number(row, "n_se", np.nan) if column == "n" else np.nan
        points.append(point(lines, row, lines.number(row, "Re"), [1], [1], [net], [error]))
    return points


def any_sizes(lines):
    """The points in rows of `polybed resolve`. A size without share has an empty cell, or share 0, and no force."""
    most = sum(f"D{j}" in lines.columns for j in range(1, 100))
    points = []
    for row in lines.rows:
        found = [j for j in range(1, most + 1) if lines.number(row, f"x{j}", 0.0) > 0]
        values = {name: [lines.number(row, name.format(j), missing) for j in found]
                  for name, missing in (("x{}", None), ("D{}", None), ("n_{}", np.nan), ("n_{}_se", np.nan))}
        points.append(point(lines, row, lines.number(row, "Re"), *values.values()))
    return points


def two_sizes(lines):
    points = []
    for row in lines.rows:
        first = lines.number(row, "x1")
        points.append(point(lines, row, lines.number(row, "Rebar"), [first, 1 - first], [lines.number(row, "D1_over_D2_used"), 1],
                            [lines.number(row, f"n{j}_LBM", np.nan) for j in (1, 2)]))
    return points


def inferred_shares(path):
    """The shares by system and y_j."""
    beside = Path(path).parent / SHARES
    if not beside.is_file():
        raise StudyError(FILE, f"{path} has no shares x_j, and {beside} is missing")
    lines = Lines(beside)
    return {(row[1]["system"], lines.number(row, "y_j")): lines.number(row, "x_j") for row in lines.rows}


def row_for_each_size(lines):
    """Joins the rows of one system, voidage and Reynolds number to a point."""
    shares = {} if lines.has("x_j") else inferred_shares(lines.path)
    groups = {}
    for row in lines.rows:
        groups.setdefault((row[1]["system"], lines.number(row, "eps"), lines.number(row, "Rebar")), []).append(row)
    points = []
    for (system, _, reynolds), rows in groups.items():
        y = [lines.number(row, "y_j") for row in rows]
        x = [lines.number(row, "x_j") if not shares else shares.get((system, size), np.nan) for row, size in zip(rows, y)]
        x = np.array(x) / np.sum(x) if abs(np.sum(x) - 1) < 0.1 else x  # some classes are not printed
        points.append(point(lines, rows[0], reynolds, x, y, [lines.number(row, "n_j_LBM", np.nan) for row in rows]))
    return points


def points_of_file(path):
    lines = Lines(path)
    for column in ("f_LBM", "f_TL", "n", "f"):
        if lines.has("eps", "Re", column) and not lines.has("D1"):
            return one_size(lines, column)
    if lines.has("eps", "Re", "x1", "D1", "n_1"):
        return any_sizes(lines)
    if lines.has("eps", "Rebar", "D1_over_D2_used", "x1", "n1_LBM", "n2_LBM"):
        return two_sizes(lines)
    if lines.has("eps", "Rebar", "system", "y_j", "n_j_LBM"):
        return row_for_each_size(lines)
    raise StudyError(WRONG_CASE, f"{path}:1: unknown columns: expected eps,Re,n or eps,Re,x1,D1,...,n_1,n_1_se,... or a table of "
                                 "tests/data/lbm")


def read_points(paths):
    """The points of files, each once. A folder stands for its tables tab_A_*.csv."""
    files = [file for path in paths for file in (sorted(Path(path).glob("tab_A_*.csv")) if Path(path).is_dir() else [Path(path)])]
    if not files:
        raise StudyError(FILE, f"{', '.join(map(str, paths))}: no tables tab_A_*.csv there")
    points, seen = [], set()
    for file in files:
        for found in points_of_file(file):
            if np.size(found.net) == 1 or found.key() not in seen:  # the accuracy page counts every row of one size
                points.append(found)
            seen.add(found.key())
    return points
