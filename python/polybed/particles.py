"""The particles of a run over its stored steps."""

import numpy as np

from polybed.errors import NoFieldError, NoStepError, UnknownNameError
from polybed.files import fits, open_hdf5, rising, whole

EMPTIED = 0.05  # of the particles that were there: fewer make no picture


def nearest(times, time):
    """Number of the stored time nearest to a time; None without any."""
    return int(np.argmin(np.abs(times - time))) if len(times) else None


def step_shown(count):
    """Number of the step in a picture, by the counts of particles: the last, or of a hopper that ran empty the last with half of them."""
    return int(np.flatnonzero(2 * count >= count.max())[-1]) if count[-1] < EMPTIED * count.max() else len(count) - 1


class ParticleStep:
    """The particles at one stored time, in the order of their ids: step.id, .species (a number), .radius, .position,
    .velocity, .spin; each is read when it is asked for first."""

    VECTORS = ("position", "velocity", "spin")
    NAMES = ("id", "species", "radius", *VECTORS)

    def __init__(self, particles, number):
        self.time, self.count = particles.time[number], particles.count[number]
        self._particles, self._file = particles, particles.folder.file("particles", f"{number + 1:06d}.h5")

    def __getattr__(self, name):
        if name not in self.NAMES:
            raise NoFieldError(f"particles have no '{name}'; they have {', '.join(self.NAMES)}")
        with open_hdf5(self._file, "polybed particles step") as file:
            values = fits(file["step"][name][...], (self.count, *([3] if name in self.VECTORS else [])), name)
            self._check(name, values)
        self.__dict__[name] = values
        return values

    def _check(self, name, values):
        """Raises ValueError for numbers that no particle has: with some of them drawing does not end."""
        if not np.isfinite(values).all():
            raise ValueError(f"{name} holds numbers that are not finite")
        if name in ("radius", "position") and np.any(np.abs(values) > 1e3 * self._particles.size.max()):
            raise ValueError(f"{name} is beyond a thousand times the column")
        if name == "species" and not np.isin(whole(values, name), np.arange(len(self._particles.species))).all():
            raise ValueError(f"species are numbered beyond the {len(self._particles.species)} that particles.h5 names")

    def __dir__(self):
        return [*super().__dir__(), *self.NAMES]

    def __repr__(self):
        return f"{self.count} particles at {self.time:g} s: {', '.join(self.NAMES)}, of(species)"

    def __len__(self):
        return int(self.count)

    def of(self, name):
        """Which particles are of a species, as a mask."""
        names = self._particles.species
        if name not in names:
            raise UnknownNameError(f"there is no species {name}; there are {', '.join(names)}")
        return self.species == names.index(name)


class Particles:
    """The particles of a run over all stored steps: particles[-1] is the last one. Empty if none are stored."""

    def __init__(self, folder):
        self.folder = folder
        self.time, self.count = np.empty(0), np.empty(0, dtype=int)  # of each step: s, and how many there are
        self.species = []  # names
        self.size, self.periodic = np.zeros(3), np.zeros(3, dtype=bool)  # of the column along x, y, z, m
        path = folder.file("particles.h5")
        if not path.exists():
            return
        with open_hdf5(path, "polybed particles") as file:
            self.time = rising(file["time_s"][:], "time_s")
            self.count = fits(whole(file["particles"][:], "particles"), self.time.shape, "particles")
            self.species = list(file.attrs["species_names"])
            self.size = fits(file["column/size"][:], (3,), "column/size")
            self.periodic = fits(file["column/periodic"][:], (3,), "column/periodic").astype(bool)

    def __len__(self):
        return len(self.time)

    def __repr__(self):
        return f"Particles at {len(self)} stored times; [-1] are the last ones"

    def __getitem__(self, step):
        if isinstance(step, slice):
            return [self[n] for n in range(*step.indices(len(self)))]
        if not -len(self) <= step < len(self):
            raise NoStepError(f"{self.folder.path} has {len(self)} steps of particles, none numbered {step}")
        return ParticleStep(self, step % len(self))

    def step_at(self, time):
        """Number of the stored step nearest to a time."""
        if len(self) == 0:
            raise NoStepError(f"{self.folder.path} has no stored particles yet")
        return nearest(self.time, time)
