"""The beds, phases and runs that tfm_peers.py compares, and in what the models of the two programs differ."""

WATER = {"name": "water", "density": 999.1, "viscosity": 1.138e-3}
SPECIES = (("fine", 0.807e-3, 1395.0, 0.569), ("coarse", 2.010e-3, 1170.0, 0.431))
THREE = (("fine", 0.807e-3, 1395.0, 0.4), ("middle", 1.4e-3, 1250.0, 0.3), ("coarse", 2.010e-3, 1170.0, 0.3))


def system_b(fraction, species=SPECIES):
    """Matsuura and Akehata in water at 15 degC, mixed at this solids fraction: 20 x 200 cells of 3 mm, 30 mm/s."""
    solids = [{"name": n, "diameter": d, "density": r, "fraction": x * fraction} for n, d, r, x in species]
    return {"size": (0.06, 0.6), "cells": (20, 200), "fluid": WATER, "velocity": 0.03, "solids": solids,
            "height": 0.066 * 0.62 / fraction, "settled": 0.62}


# 20 x 20 x 100 cells between four walls.
DEEP = system_b(0.2) | {"size": (0.06, 0.3), "cells": (20, 100), "depth": 0.06, "layers": 20}
# OpenFOAM's fluidisedBed: 6000 cells of 5 mm, 0.3 mm particles, bed at rest at 0.55; all at 300 K.
GAS_BED = {"size": (0.15, 1.0), "cells": (30, 200), "fluid": {"name": "air", "density": 1.1588, "viscosity": 1.84e-5},
           "velocity": 0.25, "height": 0.5, "max_packing": 0.62, "restitution": 0.8,
           "solids": [{"name": "particles", "diameter": 3e-4, "density": 2500.0, "fraction": 0.55}]}

LIQUID_DIFFERENCES = """\
Same in both: grid, start, Ergun's drag on each species with the whole voidage, pressure gradient on all phases,
  Newtonian fluid, no slip for it at walls and free slip for the solids, no stress of the solids, no exchange between
  the species, no virtual mass. The program of OpenFOAM has no solids stress for several solids; `own models` of polybed
  are cello's drag, frictional pressure, species exchange, and no viscous stress.
Different: OpenFOAM solves momentum in conservative form with limited second-order convection, unknowns at cell centres,
  first-order steps in time (Euler) of fixed length; polybed velocities on faces, momentum in conservative form too,
  convected with first order, third-order steps with error control. Both: second-order limited fluxes of the solids."""

GAS_DIFFERENCES = """\
Same in both: grid, start, gas of constant density unless said, Ergun below and Wen-Yu above a voidage of 0.8, no slip
  at walls, no virtual mass, no turbulence, constants of the frictional pressure, packing limit 0.62.
Different: OpenFOAM has kinetic theory with a granular temperature balanced in each cell, viscosities, and its
  frictional pressure stops hardening at 0.57; polybed: stress `{stress}`, a bulk viscosity against elastic waves, its
  drag laws joined by an arctangent. OpenFOAM also solves for two energies. Numerics as in the liquid bed, but polybed's
  steps are implicit, of second order."""


def openfoam(program, drag, step, outer, alpha_steps, **more):
    return {"code": "openfoam", "program": program, "drag": drag, "step": step, "outer": outer,
            "alpha_steps": alpha_steps} | more


def openfoam_liquid(step, outer=1, alpha_steps=1):
    return openfoam("reactingMultiphaseEulerFoam", "Ergun", step, outer, alpha_steps)


def openfoam_gas(step, outer=3, alpha_steps=2, gas="constant"):
    return openfoam("twoPhaseEulerFoam", "GidaspowErgunWenYu", step, outer, alpha_steps, gas=gas)


def polybed(rtol, effects, integrator, **tfm):
    return {"code": "polybed", "rtol": rtol, "effects": effects, "integrator": integrator, "tfm": tfm}


SAME = {"drag": "ergun", "fluid_stress": "newtonian"}
OWN = {"drag": "cello", "solids_stress": "frictional", "species_exchange": "syamlal"}
# Both programs on cells of half the size, with the smaller step or tolerance: what the errors are measured from.
FINEST_LIQUID = {"polybed finest": polybed(1e-4, SAME, "auto") | {"refine": 2},
                 "OpenFOAM finest": openfoam_liquid(2.5e-3, 3) | {"refine": 2}}


def liquid_runs(steps, iterated_steps):
    """Runs by name; iterated: three outer iterations in a time step, as in OpenFOAM's tutorial of a bubble column."""
    runs = {"polybed": polybed(1e-3, SAME, "auto"), "polybed, rtol 1e-5": polybed(1e-5, SAME, "auto"),
            "polybed, own models": polybed(1e-3, OWN, "auto")}
    runs |= {f"OpenFOAM, {1000 * step:g} ms": openfoam_liquid(step) for step in steps}
    return runs | {f"OpenFOAM, {1000 * step:g} ms, 3 outer": openfoam_liquid(step, 3) for step in iterated_steps}


def gas_runs(stress):
    effects = {"drag": "gidaspow", "fluid_stress": "newtonian", "solids_stress": stress}
    effects |= {"granular_temperature": "algebraic"} if stress == "kinetic" else {}
    tfm = {"solids_wall": '"no_slip"', "max_packing": 0.62, "frictional_pressure": 0.05, "frictional_onset": 0.5}
    runs = {"polybed": polybed(1e-3, effects, "auto", **tfm),
            "polybed, rtol 2e-3": polybed(2e-3, effects, "auto", **tfm),
            "polybed, rtol 1e-4": polybed(1e-4, effects, "auto", **tfm),
            "OpenFOAM, 0.2 ms": openfoam_gas(2e-4), "OpenFOAM, 0.1 ms": openfoam_gas(1e-4),
            "OpenFOAM, 0.5 ms": openfoam_gas(5e-4), "OpenFOAM, 1 ms": openfoam_gas(1e-3),
            "OpenFOAM, 0.2 ms, perfect gas": openfoam_gas(2e-4, gas="perfect")}
    finest = {"polybed finest": polybed(1e-4, effects, "auto", **tfm) | {"refine": 2},
              "OpenFOAM finest": openfoam_gas(1e-4) | {"refine": 2}}
    return runs, finest


def phases(stress):
    """Name, bed, interval whose cost counts, times at which measures are compared, runs, finer runs for reference."""
    gas, finest_gas = gas_runs(stress)
    # That tutorial moves the fractions in two parts of a step; version 1912 then moves them anew in each iteration.
    packed = liquid_runs((5e-3, 2.5e-3, 1e-3), (5e-3, 2.5e-3))
    packed["OpenFOAM, 5 ms, 3 outer, 2 alpha"] = openfoam_liquid(5e-3, 3, 2)
    return [
        {"name": "liquid packed", "bed": system_b(0.62), "begin": 0.0, "end": 1.0, "at": (0.5, 1.0), "every": 0.5,
         "runs": packed, "finest": FINEST_LIQUID, "goal": 20.0, "plug": True, "differences": LIQUID_DIFFERENCES},
        {"name": "liquid expanded", "bed": system_b(0.2), "begin": 5.0, "end": 10.0, "at": (2.5, 5.0), "every": 2.5,
         "runs": liquid_runs((1e-2, 5e-3), (1e-2,)), "finest": {}, "goal": 20.0, "rate_goal": 0.4,
         "differences": LIQUID_DIFFERENCES},
        {"name": "liquid in 3-D", "bed": DEEP, "begin": 1.0, "end": 2.0, "at": (1.0, 2.0), "every": 1.0,
         "runs": liquid_runs((5e-3,), ()), "finest": {}, "goal": 12.0, "differences": LIQUID_DIFFERENCES},
        {"name": "three species", "bed": system_b(0.2, THREE), "begin": 5.0, "end": 10.0, "at": (5.0, 10.0),
         "every": 5.0, "runs": liquid_runs((5e-3,), ()), "finest": {}, "goal": 15.0,
         "differences": LIQUID_DIFFERENCES},
        {"name": "gas", "bed": GAS_BED, "begin": 0.0, "end": 0.1, "at": (0.05, 0.1), "every": 0.05, "runs": gas,
         "finest": finest_gas, "goal": 5.0, "differences": GAS_DIFFERENCES.format(stress=stress)},
        {"name": "gas developed", "bed": GAS_BED, "begin": 1.0, "end": 1.5, "at": (0.5, 1.0, 1.5), "every": 0.5,
         "runs": {name: gas[name] for name in ("polybed, rtol 2e-3", "polybed", "polybed, rtol 1e-4", "OpenFOAM, 1 ms",
                                               "OpenFOAM, 0.5 ms")},
         "finest": {}, "goal": 4.0, "differences": GAS_DIFFERENCES.format(stress=stress)}]
