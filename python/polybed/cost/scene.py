"""The case of a sweep as the program resolves it."""

import resource

from polybed.runner import answer_of, words_of
from polybed.study.cases import Case

LEAST_MODULUS = 5e6  # Pa, core::least_modulus: what contacts have unless the case says otherwise


def children_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Scene(Case):
    """A case with settings of its own, and what `polybed check` says of it."""

    def __init__(self, path, overrides, until=None):
        super().__init__(path, overrides, until)
        before = children_seconds()
        self.needs = answer_of("check", path, *words_of(self.overrides))
        self.seconds = children_seconds() - before  # CPU time of the check, which balances the forces on the bed

    def of(self, path, default=None):
        """The value of a key, "tfm.rtol"; the default if the case has none."""
        table, name = path.split(".")
        return self.keys[table].get(name, default)

    def law(self, role):
        """The law of a role in [effects]; "none" if it is off."""
        return self.of(f"effects.{role}", "none")

    @property
    def cells(self):
        """Numbers of cells along x, y and, in three dimensions, z."""
        return self.of("column.cells")

    @property
    def is_tapered(self):
        """Whether the balance of forces changes with height."""
        return self.of("column.profile") is not None

    @property
    def has_fluid(self):
        return self.of("fluid.name") != "none"

    @property
    def only_for_particles(self):
        """Whether the two-fluid model cannot run it."""
        return "dt_limits" not in self.needs

    @property
    def as_particles(self):
        """Whether the particle model, too, can run it."""
        return "dem" in self.needs

    def carried(self):
        """Height, m, of the uniform bed that the forces balance on, measured on the slabs of the case as in a run; None where the fluid
        carries a lone particle away."""
        return self.needs["dt_limits"]["expanded"]["bed_height_m"]
