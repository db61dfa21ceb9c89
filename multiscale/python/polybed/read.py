"""A run directory as an object: fields, particles, profiles and history by name, as numpy arrays.

    import polybed
    run = polybed.read("runs/bed-tfm")
    run.phi_fine[-1]                  # last stored field, [y][x]
    run.time, run.history["bed_height_m"], run.profiles["voidage"]
    height = run.quantity("bed_height")    # numbers with their unit and times: height.values, .unit, .time
    mean, deviation = height.last()        # over the last quarter
    last = run.particles[-1]          # of a run of particles
    last.position[last.of("fine")]    # [particle][x, y, z]

Nothing is read before it is asked for, and a run that is still going on can be read: each file is whole.
"""

import json
from pathlib import Path

import h5py
import numpy as np

from polybed import quantities

VERSIONS = {
    "polybed fields": 1,
    "polybed fields step": 1,
    "polybed particles": 1,
    "polybed particles step": 1,
    "polybed profiles": 1,
    "polybed solids table": 1,
    "polybed run": 1,
    "polybed comparison": 1,
    "polybed inversion": 1,
    "polybed cost": 1,
    "polybed stability": 1,
}


class FormatError(Exception):
    """A file is of a kind or a version that this package does not know."""


def check_kind(attributes, filetype, path):
    """Raises FormatError unless a file is what it should be."""
    found = (attributes.get("filetype"), attributes.get("version"))
    if found[0] != filetype or found[1] != VERSIONS[filetype]:
        raise FormatError(
            f"{path} is '{found[0]}' version {found[1]}; this package reads '{filetype}' version {VERSIONS[filetype]}"
        )


def read_json(path, filetype):
    """What a JSON file holds, if it is what it should be."""
    found = json.loads(path.read_text())
    check_kind(found, filetype, path)
    return found


def open_hdf5(path):
    """An HDF5 file to read; one that cannot be read is told by its name."""
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise OSError(f"{path} is damaged or cannot be read: {error}") from None


def nearest(times, time):
    """Number of the stored time nearest to a time; None without any."""
    return int(np.argmin(np.abs(times - time))) if len(times) else None


class Series:
    """One field over all stored steps: series[-1] is the last array, series[2:5] a list made one array."""

    def __init__(self, run, name):
        self._run, self._name = run, name

    def __len__(self):
        return len(self._run.time)

    def __getitem__(self, step):
        if isinstance(step, slice):
            return np.array([self[n] for n in range(*step.indices(len(self)))])
        count = len(self)
        if not -count <= step < count:
            raise IndexError(f"{self._name} has {count} steps, none numbered {step}")
        return self._run._field(step % count, self._name)

    def __iter__(self):
        return (self[n] for n in range(len(self)))


class ParticleStep:
    """The particles at one stored time, in the order of their ids: step.id, .species (a number), .radius, .position,
    .velocity, .spin; each is read when it is asked for first."""

    NAMES = ("id", "species", "radius", "position", "velocity", "spin")

    def __init__(self, path, time, count, species):
        self.time, self.count = time, count
        self._path, self._species = path, species

    def __getattr__(self, name):
        if name not in self.NAMES:
            raise AttributeError(f"particles have no '{name}'; they have {', '.join(self.NAMES)}")
        with open_hdf5(self._path) as file:
            check_kind(file.attrs, "polybed particles step", self._path)
            self.__dict__[name] = file["step"][name][...]
        return self.__dict__[name]

    def __len__(self):
        return self.count

    def of(self, name):
        """Which particles are of a species, as a mask."""
        if name not in self._species:
            raise KeyError(f"there is no species {name}; there are {', '.join(self._species)}")
        return self.species == self._species.index(name)


class Particles:
    """The particles of a run over all stored steps: particles[-1] is the last one. Empty if none are stored."""

    def __init__(self, directory):
        self._directory = Path(directory)
        self.time, self.count = np.empty(0), np.empty(0, dtype=int)  # of each step: s, and how many there are
        self.species = []  # names
        self.size, self.periodic = np.zeros(3), np.zeros(3, dtype=bool)  # of the column along x, y, z, m
        path = self._directory / "particles.h5"
        if not path.exists():
            return
        with open_hdf5(path) as file:
            check_kind(file.attrs, "polybed particles", path)
            self.time, self.count = file["time_s"][:], file["particles"][:].astype(int)
            self.species = list(file.attrs["species_names"])
            self.size, self.periodic = file["column/size"][:], file["column/periodic"][:].astype(bool)

    def __len__(self):
        return len(self.time)

    def __getitem__(self, step):
        if not -len(self) <= step < len(self):
            raise IndexError(f"{self._directory} has {len(self)} steps of particles, none numbered {step}")
        step %= len(self)
        path = self._directory / "particles" / f"{step + 1:06d}.h5"
        return ParticleStep(path, self.time[step], self.count[step], self.species)

    def step_at(self, time):
        """Number of the stored step nearest to a time."""
        if len(self) == 0:
            raise IndexError(f"{self._directory} has no stored particles yet")
        return nearest(self.time, time)


class Run:
    """A run directory. Fields are attributes (run.voidage, run.u_fluid, run.phi_<name>) or run.field(name)."""

    def __init__(self, directory):
        self.directory = Path(directory)
        if not self.directory.is_dir():
            raise FileNotFoundError(f"{directory} is no run directory")
        self.time = np.empty(0)
        self.faces = {}
        path = self.directory / "fields.h5"
        if path.exists():
            with open_hdf5(path) as file:
                check_kind(file.attrs, "polybed fields", path)
                self.time = file["time_s"][:]
                self.faces = {axis: file["grid"][axis][:] for axis in "xyz"}
        self.fields = self._field_names()
        self.particles = Particles(self.directory)

    def _step_path(self, step):
        return self.directory / "fields" / f"{step + 1:06d}.h5"

    def _field_names(self):
        if len(self.time) == 0:
            return []
        with open_hdf5(self._step_path(0)) as file:
            check_kind(file.attrs, "polybed fields step", self._step_path(0))
            return sorted(file["step"])

    def _field(self, step, name):
        with open_hdf5(self._step_path(step)) as file:
            return file["step"][name][...]

    def field(self, name):
        """A field over time, as a sequence of arrays [y][x] or [z][y][x], a vector with its components behind."""
        if name not in self.fields:
            raise KeyError(f"{name} is not stored in {self.directory}; there are {', '.join(self.fields)}")
        return Series(self, name)

    def __getattr__(self, name):
        if not name.startswith("_") and name in self.__dict__.get("fields", ()):
            return Series(self, name)
        raise AttributeError(f"a run has no '{name}'; its fields are {self.__dict__.get('fields', [])}")

    def __dir__(self):
        return [*super().__dir__(), *self.fields]

    @property
    def dimensions(self):
        """2 or 3."""
        return self.field(self.fields[0])[0].ndim if self.fields and len(self.time) else 0

    @property
    def size(self):
        """Width and height of the column, m; of a run without anything stored yet, zeros."""
        if self.faces:
            return self.faces["x"][-1], self.faces["y"][-1]
        return tuple(self.particles.size[:2])

    @property
    def record(self):
        """run.json as a dictionary; empty if there is none yet."""
        path = self.directory / "run.json"
        if not path.exists():
            return {}
        return read_json(path, "polybed run")

    @property
    def species(self):
        """Names of the species, in the order of the case, which the columns of the history keep."""
        stored = [name[len("phi_") :] for name in self.fields if name.startswith("phi_")] or self.particles.species
        columns = [column[len("centre_") : -len("_m")] for column in self.history if column.startswith("centre_")]
        return [name for name in columns if name in stored] + [name for name in stored if name not in columns]

    @property
    def history(self):
        """history.csv: a dictionary of columns; entries without value are NaN; a row being written is left out."""
        path = self.directory / "history.csv"
        if not path.exists():
            return {}
        lines = path.read_text().split("\n")[:-1]
        names = lines[0].split(",")
        rows = [[float(entry) if entry else np.nan for entry in line.split(",")] for line in lines[1:]]
        table = np.array(rows, dtype=float).reshape(len(rows), len(names))
        return {name: table[:, n] for n, name in enumerate(names)}

    @property
    def profiles(self):
        """profiles.h5: a dictionary of time_s [time], y_m [y] and profiles [time][y]."""
        path = self.directory / "profiles.h5"
        if not path.exists():
            return {}
        with open_hdf5(path) as file:
            check_kind(file.attrs, "polybed profiles", path)
            return {name: data[...] for name, data in file.items()}

    def quantity(self, name, source=None):
        """What is called so in the history, the profiles or the fields, with its unit; see polybed.quantities.find."""
        return quantities.find(self, name, source)

    def names(self):
        """What quantity() knows."""
        return quantities.names(self)

    def plot(self, what=None, **options):
        """Draws the run, or one kind of picture of it, and returns the paths; see polybed.plot.pictures."""
        from polybed import plot
        return plot.pictures(self.directory, (what,) if isinstance(what, str) else what, **options)

    def step_at(self, time):
        """Number of the stored step nearest to a time."""
        if len(self.time) == 0:
            raise IndexError(f"{self.directory} has no stored fields yet")
        return nearest(self.time, time)


def read(directory):
    """Opens a run directory, of a finished or a running run."""
    return Run(directory)
