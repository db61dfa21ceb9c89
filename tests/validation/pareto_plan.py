"""What pareto_b.py runs: one bed of system B, from the force balance to particles, each setting changed alone or with a second one."""
from dataclasses import dataclass, field

TABLE = "cases/solids-stress-b/table.h5"
VELOCITY = 25e-3  # m/s, of the bed heights: nine mm/s below the inversion by force balance
# m/s, of runs from the mixed bed for who is on top, and their time, s: after 40 s layers still change places. A scan goes on from
# layers, and widens its range until the bed fills the column, where a second costs ten times as much.
TURNING, TURNING_TIME = (30e-3, 34e-3, 38e-3), 100.0

# The strip of system B of docs/record/thesis-systems.md with half of its particles: five of eighteen columns of cells, walls, 33 mm high when
# packed, so that particles take 10 s of computing for a second and a bed comes to rest in half the time. Cells are square.
BED = {"column.size": [16.667e-3, 0.48], "column.cells": [5, 144], "column.depth": 4.422e-3, "bed.particles": [3116, 153],
       "dem.skin": 2e-4, "dem.youngs_modulus": 1e5, "dem.fixed_step": 4.5e-5, "dem.fluid_every": 10, "dem.ledger": False,
       "dem.max_overlap": 0.1}
FINE, COARSE = 0.807e-3, 2.010e-3  # m, of cases/quarter-b
COMMON = (12.0, 16.0)  # s, in which all runs at VELOCITY are compared: the last quarter of the particles' time
STATIC_HEIGHT = 33.0e-3  # m, of that bed when it is packed to 0.62
LAWS = ["cello", "vbk_theory", "yin_sundaresan", "patwardhan_tien", "gidaspow", "di_felice"]

BALANCE, FLAT, GRID, SCHEME, LAW, STRESS, BOTH, PARTICLES = (
    "force balance", "two-fluid, 1-D", "two-fluid, grid", "two-fluid, time and scheme", "two-fluid, drag law",
    "two-fluid, stress", "two-fluid, two changes", "particles")


@dataclass
class Row:
    """One setting: what it changes of BED, how long it is run, and at which velocities its inversion is sought."""
    name: str
    level: str
    model: str  # balance | tfm | dem
    settings: dict = field(default_factory=dict)
    until: float = 40.0  # s
    velocities: tuple = ()  # m/s, at which it is looked for who is on top


def grid(columns, rows, level=GRID, turns=True):
    return Row(f"{columns}x{rows}", level, "tfm", {"column.cells": [columns, rows]}, velocities=TURNING if turns else ())


def tfm(name, level, turns=False, **settings):
    changed = {key.replace("__", "."): value for key, value in settings.items()}
    return Row(name, level, "tfm", changed, velocities=TURNING if turns else ())


def balances():
    return [Row(law, BALANCE, "balance", {"effects.drag": law}) for law in LAWS]


def continua():
    fine = {"column__cells": [10, 288]}
    coarse = {"column__cells": [3, 86]}
    limited = {"tfm__momentum": "conservative_limited"}
    # By the shear of so narrow a strip the coarse would count as dry, gamma tau_p = 1.5; in the bed of the table 0.23.
    table = {"effects__solids_stress": f"table:{TABLE}", "calibrate__regime": "wet"}
    return [
        *(grid(1, n, FLAT, n == 144) for n in (72, 144, 288, 576)),
        grid(2, 58), grid(3, 86), grid(5, 144), grid(7, 202, turns=False), grid(10, 288, turns=False),
        tfm("rtol 1e-2", SCHEME, True, tfm__rtol=1e-2),
        tfm("rtol 1e-4", SCHEME, tfm__rtol=1e-4),
        tfm("rtol 1e-5", SCHEME, tfm__rtol=1e-5),
        tfm("implicit", SCHEME, tfm__integrator="implicit"),
        tfm("implicit, rtol 1e-4", SCHEME, tfm__integrator="implicit", tfm__rtol=1e-4),
        tfm("flux upwind", SCHEME, True, tfm__flux="upwind"),
        tfm("momentum conservative_limited", SCHEME, True, **limited),
        *(tfm(law, LAW, law in LAWS[1:3], effects__drag=law) for law in LAWS[1:]),
        tfm("wet table", STRESS, True, **table),
        tfm("kinetic stress", STRESS, effects__solids_stress="kinetic"),
        tfm("species exchange", STRESS, effects__species_exchange="syamlal"),
        tfm("wet table, species exchange", STRESS, effects__species_exchange="syamlal", **table),
        tfm("fluid stress", STRESS, effects__fluid_stress="newtonian"),
        tfm("2x58, rtol 1e-2", BOTH, column__cells=[2, 58], tfm__rtol=1e-2),
        tfm("3x86, explicit", BOTH, **coarse, tfm__integrator="explicit"),
        tfm("3x86, flux upwind", BOTH, **coarse, tfm__flux="upwind"),
        tfm("3x86, conservative_limited", BOTH, **coarse, **limited),
        tfm("10x288, conservative_limited", BOTH, **fine, **limited),
        tfm("10x288, wet table", BOTH, **fine, **table),
    ]


def particles():
    soft = {"dem.youngs_modulus": 3e4, "dem.fixed_step": 7.2e-5, "dem.fluid_every": 12}
    return [Row("E 0.03 MPa", PARTICLES, "dem", soft, 16.0), Row("E 0.1 MPa", PARTICLES, "dem", {}, 16.0)]


def plan():
    """All of it: 36 runs at VELOCITY, of which one is refused, 30 at other velocities, six answers without a run."""
    return balances() + continua() + particles()


def short_plan():
    """A few runs of no meaning, seconds in all, one of each kind."""
    few = {"bed.particles": [311, 15]}
    return [balances()[0],
            Row("1x72", FLAT, "tfm", {"column.cells": [1, 72]}, 0.4),
            Row("2x58", GRID, "tfm", {"column.cells": [2, 58]}, 0.4, (30e-3, 42e-3)),
            Row("5x144", GRID, "tfm", {}, 0.4),
            Row("few", PARTICLES, "dem", few, 0.02)]
