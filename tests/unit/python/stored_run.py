"""Runs of known columns and profiles, stored as the program stores them, for it to measure."""
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np
from polybed.quantities import Named


class Written:
    """What a run stores: columns of its history and datasets of its profiles, by name."""

    def __init__(self, history, profiles=None, drifts=()):
        self.history, self.profiles, self.drifts, self.case = history, profiles, list(drifts), ""

    def into(self, directory):
        """Writes history.csv and profiles.h5, and returns the run as studies open it."""
        directory = Path(directory)
        directory.mkdir(exist_ok=True)
        table = np.column_stack(list(self.history.values()))
        np.savetxt(directory / "history.csv", table, "%.17g", ",", header=",".join(self.history), comments="")
        with h5py.File(directory / "profiles.h5", "w") as file:
            file.attrs.update(filetype="polybed profiles", version=1, git_commit="0")
            for name, values in (self.profiles or {"time_s": np.empty(0), "y_m": [0.5], "phi_a": np.empty((0, 1))}).items():
                file[name] = values
        return SimpleNamespace(directory=directory, history=Named("history.csv", self.history),
                               record={"drift": {"lines": self.drifts}, "case": self.case})
