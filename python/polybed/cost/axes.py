"""The case of a sweep, and what a sweep varies: axes, their levels, and the settings that a level stands for."""

import resource
from dataclasses import dataclass, field, replace
from functools import partial

from polybed.ending import WRONG_CASE, StudyError
from polybed.runner import answer_of, words_of
from polybed.study.cases import Case

NUMERICS, MODEL = "numerics", "model"
DRAG_LAWS = ("cello", "vbk_theory", "gidaspow", "di_felice")
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
        self.cells = self.of("column.cells")  # numbers along x, y and, in three dimensions, z
        self.is_tapered = self.of("column.profile") is not None  # the balance of forces changes with height
        self.has_fluid = self.of("fluid.name") != "none"
        self.only_for_particles = "dt_limits" not in self.needs  # the two-fluid model cannot run it
        self.as_particles = "dem" in self.needs  # the particle model, too, can run it

    def of(self, path, default=None):
        """The value of a key, "tfm.rtol"; the default if the case has none."""
        table, name = path.split(".")
        return self.keys[table].get(name, default)

    def law(self, role):
        """The law of a role in [effects]; "none" if it is off."""
        return self.of(f"effects.{role}", "none")


@dataclass
class Level:
    label: str  # "1e-3", "18x128"
    value: float = 0  # in the direction of the axis; 0: it has none
    overrides: list = field(default_factory=list)  # "key=value" each
    model: str = ""  # tfm | dem | force_balance; empty: the model of the sweep


@dataclass
class Axis:
    name: str
    kind: str
    levels: list  # from cheap to dear where that is known
    given: int = 0  # the level of the case as it is
    beyond: list = field(default_factory=list)  # dearer ones, for the reference


def setting(key, value):
    """ "key=value", a number with all its digits."""
    return f"{key}={value:.17g}"


def number_level(key, value):
    return Level(f"{value:.3g}", value, [setting(key, value)])


def numbers(scene, _, name, key, values, falling, beyond, default=None):
    """An axis of these values of a key and that of the case among them. falling: the less the dearer; beyond: dearer values"""
    given = scene.of(key, default)
    levels = [number_level(key, value) for value in values]
    same = [n for n, value in enumerate(values) if abs(value - given) <= 1e-9 * abs(given)]
    behind = [n for n, value in enumerate(values) if (value < given if falling else value > given)]
    place = (same or behind or [len(values)])[0]
    if not same:
        levels.insert(place, number_level(key, given))
    return Axis(name, NUMERICS, levels, place, [number_level(key, value) for value in beyond])


def grid_level(scene, coarser):
    """The case on cells divided by a factor (2: twice as coarse); no direction has fewer than one."""
    cells = [max(1, int(n / coarser + 0.5)) if n > 1 else n for n in scene.cells]
    overrides = [] if coarser == 1 else [f"column.cells=[{','.join(map(str, cells))}]"]
    return Level("x".join(map(str, cells)), coarser, overrides)


def grid_axis(scene, _):
    factors = [2, 1, 0.5, *([0.25] if scene.cells[0] == 1 else [])]
    return Axis("grid", NUMERICS, [grid_level(scene, f) for f in factors], 1, [grid_level(scene, factors[-1] / f) for f in (2, 4)])


def scheme_axis(scene, _):
    integrator, flux = scene.of("tfm.integrator"), scene.of("tfm.flux")
    limited = flux == "limited"
    levels = [] if integrator == "auto" and limited else [Level(f"{integrator} {flux}")]
    for other in ("auto", "explicit", "imex", "implicit"):
        if other != integrator or not limited:
            levels.append(Level(other, 0, [f"tfm.integrator={other}", "tfm.flux=limited"]))
        elif not levels:
            levels.append(Level(other))
    return Axis("scheme", NUMERICS, levels + ([Level("upwind", 0, ["tfm.flux=upwind"])] if limited else []))


def stiffness_axis(scene, _):
    """Softer contacts last four times as long with a modulus divided by 4^(5/2), Hertz."""
    modulus = scene.of("dem.youngs_modulus", LEAST_MODULUS)
    soft, given = (number_level("dem.youngs_modulus", modulus / factor) for factor in (32, 1))
    own = [(f"species.{species['name']}", species) for species in scene.keys["species"]]
    own += [(f"contact_pair.{n}", pair) for n, pair in enumerate(scene.keys.get("contact_pair", []))]
    soft.overrides += [setting(f"{name}.youngs_modulus", table["youngs_modulus"] / 32) for name, table in own if "youngs_modulus" in table]
    return Axis("stiffness", MODEL, [soft, replace(given, overrides=[])], 1)


def laws_axis(name, role, given, others):
    return Axis(name, MODEL, [Level(given), *(Level(law, 0, [f"effects.{role}={law}"]) for law in others if law != given)])


def drag_axis(scene, _):
    given = scene.law("drag")
    axis = laws_axis("drag", "drag", given, () if given == "none" else DRAG_LAWS)
    if scene.law("partition") != "none":  # these laws share the drag themselves
        for level in axis.levels[1:]:
            level.overrides.append("effects.partition=none")
    return axis


def stress_axis(scene, _):
    """The pressure and the stress of the solids."""
    given, laws = scene.law("solids_stress"), ("kinetic", "frictional")
    return laws_axis("effects", "solids_stress", given, laws if given in laws else ())


def level_axis(scene, model):
    flat = len(scene.cells) == 2
    levels = [Level("dem" if model == "dem" else "tfm 2-D" if flat else "tfm 3-D")]
    if scene.law("drag") != "none" and not scene.only_for_particles and not scene.is_tapered and scene.needs["static_height_m"] > 0:
        levels.append(Level("force balance", model="force_balance"))
    if model == "tfm" and flat and scene.cells[0] > 1 and not scene.is_tapered:
        levels.append(Level("tfm 1-D", 0, [f"column.cells=[1,{scene.cells[1]}]"]))
    if model == "tfm" and scene.law("contact") != "none" and scene.as_particles:
        levels.append(Level("dem", model="dem"))
    if model == "dem" and scene.law("solids_stress") != "none":
        levels.append(Level("tfm", model="tfm"))
    return Axis("level", MODEL, levels)


rtol_axis = partial(numbers, name="rtol", key="tfm.rtol", values=[1e-2, 1e-3, 1e-4, 1e-5], falling=True, beyond=[1e-6, 1e-7])
steps_axis = partial(numbers, name="steps", key="dem.steps_per_contact", values=[10, 20, 50, 100], falling=False, beyond=[200, 400])
coupling_axis = partial(numbers, name="coupling", key="dem.fluid_every", values=[50, 16, 5], falling=True, beyond=[2, 1], default=16)

# name: (models that it acts in, what makes it), in the order of a sweep.
MAKERS = {"rtol": (("tfm",), rtol_axis), "grid": (("tfm",), grid_axis), "scheme": (("tfm",), scheme_axis), "steps": (("dem",), steps_axis),
          "coupling": (("dem",), coupling_axis), "stiffness": (("dem",), stiffness_axis), "drag": (("tfm", "dem"), drag_axis),
          "effects": (("tfm",), stress_axis), "level": (("tfm", "dem"), level_axis)}


def acting_axes(scene, model):
    """Names of the axes that act in this case by a model."""
    return [name for name, (models, _) in MAKERS.items() if model in models and (scene.has_fluid or name != "coupling")]


def axes_of(scene, model, names):
    """The axes of these names, or all, in the order of a sweep. Raises StudyError for one that is unknown or does not act in the case."""
    acting = acting_axes(scene, model)
    for name in names:
        if name not in acting:
            raise StudyError(WRONG_CASE, f"--axes {name}: " + (f"does not act in this case by {model}" if name in MAKERS else
                                                               f"there are {', '.join(MAKERS)}"))
    return [MAKERS[name][1](scene, model) for name in acting if name in (names or acting)]
