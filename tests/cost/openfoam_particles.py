"""Cases of OpenFOAM 1912's DPMFoam, written from a scene of demcfd_bed.py; what it reports.

Constants that no scene holds are the tutorial's: dashpots, solvers, tolerances, schemes, time step.
"""
import re
from pathlib import Path

import numpy as np

import openfoam_cases
import openfoam_run
from openfoam_cases import fixed, text, write, write_field

PROGRAM = "DPMFoam"
STEP = 2e-5  # s, of the fluid; the particles take as many steps in it as a contact wants
PER_CONTACT = 12  # steps that the program takes in the shortest contact
CLOUD = "kinematicCloud"
# What the tutorial calls front and back: symmetric for the gas; a bead is reflected when its centre meets them.
PATCHES = {"inlet": "wall", "outlet": "wall", "sides": "symmetry"}


def dashpot(restitution):
    """alpha of the program's spring-slider-dashpot, F = -alpha sqrt(m* K) delta^(1/4) v, of that restitution.

    c_n = 2 sqrt(5/6) beta sqrt(S_n m*) with S_n = 1.5 K sqrt(delta): alpha = sqrt(5) beta. The tutorial's 0.02: 0.972.
    """
    log = np.log(restitution)
    return float(np.sqrt(5) * -log / np.hypot(np.pi, log))


def write_fields(directory, bed):
    still, phi, sides = (0.0, 0.0, 0.0), {"phi": f"phi.{bed['fluid']}"}, {"sides": {"type": "symmetry"}}
    inlet = {"type": "interstitialInletVelocity", "inletVelocity": f"uniform {text((0.0, bed['velocity'], 0.0))}",
             "alpha": f"alpha.{bed['fluid']}", "value": f"uniform {text(still)}"} | phi
    outlet = {"type": "pressureInletOutletVelocity", "inletValue": f"uniform {text(still)}",
              "value": f"uniform {text(still)}"} | phi
    write_field(directory, f"U.{bed['fluid']}", "0 1 -1 0", still, sides | {
        "inlet": inlet, "outlet": outlet, "walls": {"type": "noSlip"}})
    write_field(directory, "p", "0 2 -2 0", 0.0, sides | {
        "others": {"type": "fixedFluxPressure", "value": "uniform 0"} | phi, "outlet": fixed(0.0) | phi})


def write_fluid(directory, bed):
    name = bed["fluid"]
    write(directory / "constant/transportProperties", {
        "continuousPhase": name, f"rho.{name}": bed["fluid_density"], "transportModel": "Newtonian",
        "nu": bed["fluid_viscosity"] / bed["fluid_density"]})
    write(directory / f"constant/turbulenceProperties.{name}", {"simulationType": "laminar"})
    write(directory / "constant/g", {"dimensions": "[0 1 -2 0 0 0 0]", "value": (0.0, -bed["gravity"], 0.0)},
          "uniformDimensionedVectorField")


def write_numerics(directory, bed):
    name = bed["fluid"]
    write(directory / "system/fvSchemes", {
        "ddtSchemes": {"default": "Euler"}, "gradSchemes": {"default": "Gauss linear"},
        "divSchemes": {"default": "none", f"div(alphaPhi.{name},U.{name})": "Gauss linearUpwindV unlimited",
                       f"div(((alpha.{name}*nuEff.{name})*dev2(T(grad(U.{name})))))": "Gauss linear"},
        "laplacianSchemes": {"default": "Gauss linear corrected"}, "interpolationSchemes": {"default": "linear"},
        "snGradSchemes": {"default": "corrected"}})
    pressure = {"solver": "GAMG", "tolerance": 1e-6, "smoother": "GaussSeidel"}
    velocity = {"solver": "smoothSolver", "smoother": "symGaussSeidel", "tolerance": 1e-5}
    write(directory / "system/fvSolution", {
        "solvers": {"p": pressure | {"relTol": 0.01}, "pFinal": pressure | {"relTol": 0},
                    f"U.{name}": velocity | {"relTol": 0.1}, f"U.{name}Final": velocity | {"relTol": 0}},
        "PIMPLE": {"nOuterCorrectors": 1, "nCorrectors": 2, "momentumPredictor": "yes", "nNonOrthogonalCorrectors": 0,
                   "pRefCell": 0, "pRefValue": 0}})


def contact(material):
    return {"alpha": dashpot(material["restitution"]), "b": 1.5, "mu": material["friction"],
            "cohesionEnergyDensity": 0, "collisionResolutionSteps": PER_CONTACT, "useEquivalentSize": "no"}


def collisions(bed):
    wall = {"youngsModulus": bed["wall"]["youngs_modulus"], "poissonsRatio": bed["wall"]["poisson_ratio"]}
    return {"maxInteractionDistance": bed["diameter"], "writeReferredParticleCloud": "no",
            "pairModel": "pairSpringSliderDashpot", "pairSpringSliderDashpotCoeffs": contact(bed),
            "wallModel": "wallSpringSliderDashpot", "wallSpringSliderDashpotCoeffs": contact(bed["wall"]) | wall,
            "U": f"U.{bed['fluid']}"}


def write_cloud(directory, bed):
    """Drag after Ergun below and Wen and Yu above a voidage of 0.8, gravity, contacts; nothing else acts."""
    name, walls = bed["fluid"], {"type": "rebound", "e": bed["wall"]["restitution"], "mu": bed["wall"]["friction"]}
    patches = " ".join(f"{p} {{ {text(walls)} }}" for p in (*openfoam_cases.PATCHES, "sides"))
    injection = {"type": "manualInjection", "massTotal": 0, "parcelBasisType": "fixed", "nParticle": 1, "SOI": 0,
                 "positionsFile": f'"{CLOUD}Positions"', "U0": (0.0, 0.0, 0.0), "sizeDistribution": {
                     "type": "fixedValue", "fixedValueDistribution": {"value": bed["diameter"]}}}
    models = dict.fromkeys(("dispersionModel", "heatTransferModel", "surfaceFilmModel", "stochasticCollisionModel"),
                           "none")
    write(directory / f"constant/{CLOUD}Properties", {
        "solution": {"active": "true", "coupled": "true", "transient": "yes", "cellValueSourceCorrection": "off",
                     "interpolationSchemes": {f"rho.{name}": "cell", f"U.{name}": "cellPoint", f"mu.{name}": "cell"},
                     "integrationSchemes": {"U": "Euler"}, "sourceTerms": {"schemes": {"U": "semiImplicit 1"}}},
        "constantProperties": {"parcelTypeId": 1, "rhoMin": 1e-15, "minParcelMass": 1e-15, "rho0": bed["density"],
                               "youngsModulus": bed["youngs_modulus"], "poissonsRatio": bed["poisson_ratio"],
                               "constantVolume": "false", "alphaMax": 0.99},
        "subModels": {"particleForces": {"ErgunWenYuDrag": {"alphac": f"alpha.{name}"}, "gravity": ""},
                      "injectionModels": {"beads": injection}, "patchInteractionModel": "localInteraction",
                      "localInteractionCoeffs": {"patches": f"({patches})"}, "collisionModel": "pairCollision",
                      "pairCollisionCoeffs": collisions(bed), "radiation": "off"} | models, "cloudFunctions": {}})
    rows = "\n".join(text(tuple(place)) for place in bed["places"].tolist())
    write(directory / f"constant/{CLOUD}Positions", f"(\n{rows}\n)\n", "vectorField")


def write_case(directory, bed, until):
    directory = Path(directory)
    openfoam_cases.write_mesh(directory, bed | {"patches": PATCHES})
    openfoam_cases.write_control(directory, {"program": PROGRAM, "until": until, "step": STEP, "every": until})
    for part in (write_numerics, write_fluid, write_fields, write_cloud):
        part(directory, bed)


def solid_steps(log, begin, end):
    """Steps that the particles took between two simulated times, some in each step of the fluid."""
    total = 0
    for step in Path(log).read_text(errors="replace").split("\nTime = ")[1:]:
        parts = re.search(r"^ +(\d+) move-collide subCycles", step, re.MULTILINE)  # it says nothing of a single one
        inside = begin + 1e-9 < float(step.split(None, 1)[0]) < end + 1e-9
        total += inside * (int(parts.group(1)) if parts else 1)
    return total


def read_places(folder):
    found = re.findall(r"^\((\S+) (\S+) (\S+)\) -?\d+$", (folder / f"lagrangian/{CLOUD}/positions").read_text(),
                       re.MULTILINE)
    return np.array(found, dtype=float)


def solve(directory, bed, begin, end, limit):
    """CPU seconds from `begin` to `end`, as the program counts them in its log, its steps, and the bed at the end."""
    directory = Path(directory)
    write_case(directory, bed, end)
    openfoam_run.solve(PROGRAM, directory, limit)
    clock = openfoam_run.read_log(directory / "log", {})["clock"]
    _, last = openfoam_run.times(directory)[-1]
    (nx, ny), layers = bed["cells"], bed["layers"]
    kinematic = openfoam_run.read_scalar(last / "p", (nx, ny), layers).mean(axis=1)
    places = read_places(last)
    if len(places) != len(bed["places"]):
        raise openfoam_run.Failed(f"{len(places)} of {len(bed['places'])} particles are left")
    return {"cpu_s": openfoam_run.cpu_between(clock, begin, end), "places": places,
            "fluid_steps": sum(begin + 1e-9 < t for t, _ in clock),
            "solid_steps": solid_steps(directory / "log", begin, end),
            "pressure_drop_Pa": openfoam_run.pressure_drop(kinematic) * bed["fluid_density"]}
