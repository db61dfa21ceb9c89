"""Least squares of relative errors for the constants of a form, with constraints, also with rows left out or drawn anew.

Constants stay above 0, as logarithms of their ratio to the published ones. The limits and the sum rule are identities of both forms.
That f is above 0, and does not fall with Re or with the solids, is asked for on a grid of voidages and Reynolds numbers; that every
row lies where the law answers by its form, of each row.
"""

import numpy as np
from scipy.optimize import least_squares

from polybed.fit import forms

SCATTER = 0.03  # of packings at one voidage and Reynolds number: rows with a much smaller standard error count alike
PRIOR = 1e-2  # how firmly constants that rows hardly determine stay at the published ones: a factor e counts as one error of 1 %
WIDEST = np.log(30)  # furthest from the published constants
PENALTY = 10.0
GRID = [a.ravel() for a in np.meshgrid(np.linspace(0.35, 1, 27), np.concatenate([[0], np.geomspace(0.01, 1050, 40)]), indexing="ij")]
GRID_SHAPE = (27, 41)


class Problem:
    """Points, a form, and the constants that the rows can determine."""

    def __init__(self, form, published, points):
        self.form, self.published, self.points = form, published, points
        self.sizes = forms.Sizes.of(points)
        self.data = np.concatenate([p.net for p in points])
        error = np.nan_to_num(np.concatenate([p.error for p in points]) / self.data)
        self.weight = 1 / np.sqrt(1 + (error / SCATTER) ** 2)
        self.known = np.isfinite(self.data)
        self.grid = forms.Sizes.of_one_size(*GRID)
        self.free = self.determined()

    def determined(self):
        """Names of the constants that change the force on some row."""
        mixed = any(len(p.share) > 1 for p in self.points)
        names = [name for name in self.published if name != forms.ONE_SCALE.get(self.form)
                 and (mixed or name not in forms.ONLY_OF_MIXTURES[self.form])]
        at = self.relative(self.published)
        return [name for name in names
                if np.nanmax(np.abs(self.relative(self.published | {name: 1.01 * self.published[name]}) - at)) > 1e-6]

    def constants(self, parameters):
        return self.published | {name: self.published[name] * np.exp(p) for name, p in zip(self.free, parameters)}

    def relative(self, constants):
        """Relative errors of all sizes of all points; NaN where there are no data."""
        with np.errstate(all="ignore"):
            return forms.net(self.form, constants, self.sizes) / self.data - 1

    def violations(self, constants):
        """How far the constraints are broken, an entry each, 0 where they are kept."""
        with np.errstate(all="ignore"):
            f = forms.FORMS[self.form](constants, self.grid)[0].reshape(GRID_SHAPE)
            level = np.log(np.maximum(np.nan_to_num(f, nan=1e-3), 1e-3))
            broken = [np.minimum(np.diff(level, axis=1), 0).ravel(), np.maximum(np.diff(level, axis=0), 0).ravel(),
                      np.minimum(level, 0).ravel()]
            if self.form == "cello":
                reach = forms.cello_most_reynolds(constants, self.sizes.voidage)
                inside = (self.sizes.voidage >= 0.35) & (self.sizes.reynolds <= forms.cello_most_reynolds(self.published,
                                                                                                        self.sizes.voidage))
                broken.append(np.where(inside, np.minimum(np.log(reach / np.maximum(self.sizes.reynolds, 1e-9)), 0), 0))
        return np.concatenate(broken)

    def residuals(self, parameters, counts=None):
        """What is made small. counts: how often each point counts"""
        constants = self.constants(parameters)
        times = 1 if counts is None else np.sqrt(counts[self.sizes.group])
        errors = (self.relative(constants) * self.weight * times)[self.known]
        return np.concatenate([np.clip(np.nan_to_num(errors, nan=1e3), -1e3, 1e3), PENALTY * self.violations(constants),
                               PRIOR * np.asarray(parameters)])

    def fit(self, begin=None, counts=None):
        """Parameters at the least sum of squares."""
        start = np.zeros(len(self.free)) if begin is None else begin
        found = least_squares(self.residuals, start, bounds=(-WIDEST, WIDEST), args=(counts,), x_scale="jac", xtol=1e-9, ftol=1e-9,
                              max_nfev=60)
        return found.x

    def left_out_by_row(self, parameters):
        """Relative errors of each point by a fit without it, from the influence of its residuals on the fit: exact to first order."""
        step = 1e-6
        base = self.relative(self.constants(parameters))
        columns = [(self.relative(self.constants(parameters + step * unit)) - base) / step for unit in np.eye(len(parameters))]
        slope = np.where(self.known, np.array(columns), 0).T * self.weight[:, None]
        normal = slope.T @ slope + PRIOR**2 * np.eye(len(parameters))
        influence = np.linalg.pinv(normal, rcond=1e-12, hermitian=True)
        out = base.copy()
        for g in range(len(self.points)):
            of = (self.sizes.group == g) & self.known
            hat = slope[of] @ influence @ slope[of].T
            out[of] = np.linalg.solve(np.eye(of.sum()) - hat, base[of] * self.weight[of]) / self.weight[of]
        return out

    def left_out_by_voidage(self, parameters, folds=6):
        """Relative errors of each point by a fit without it and all others near its voidage, in folds of neighbours."""
        voidages = np.unique([p.voidage for p in self.points])
        if len(voidages) < 3:
            return None
        out = np.full(len(self.data), np.nan)
        for part in np.array_split(voidages, min(folds, len(voidages))):
            left = np.isin([p.voidage for p in self.points], part)
            constants = self.constants(self.fit(parameters, (~left).astype(float)))
            of = left[self.sizes.group]
            out[of] = self.relative(constants)[of]
        return out

    def bootstrap(self, parameters, draws, seed):
        """Parameters of fits to points drawn anew, with replacement, from each file: [draw][parameter]."""
        dice = np.random.default_rng(seed)
        sources = np.array([p.source for p in self.points])
        found = []
        for _ in range(draws):
            counts = np.zeros(len(self.points))
            for source in np.unique(sources):
                of = np.flatnonzero(sources == source)
                np.add.at(counts, dice.choice(of, len(of)), 1.0)
            found.append(self.fit(parameters, counts))
        return np.array(found)
