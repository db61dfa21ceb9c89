"""Cases for OpenFOAM 1912 written from a description of the bed: dictionaries, mesh and initial fields.

A bed is a dict of SI values: size (width, height), cells (nx, ny), fluid {name, density, viscosity}, velocity
(superficial), height of the bed at the start, solids [{name, diameter, density, fraction at the start}]; settled, the
solids fraction when packed, if it is not that of the start; a gas bed also max_packing and restitution. The liquid bed
is for reactingMultiphaseEulerFoam (any number of solids, but that program has no solids stress), the gas bed for
twoPhaseEulerFoam (one species, kinetic theory). y is up, the column one cell deep, unless the bed has depth, layers of
cells along it between walls, or patches {name: OpenFOAM's type} of its own.

Settings: program, until, step, every (s, between stored fields), drag (OpenFOAM's name), outer (iterations of a time
step), alpha_steps (parts of a time step in which the fractions move), and for the gas bed gas (constant | perfect).
"""
import functools
from pathlib import Path

import numpy as np

PRESSURE, TEMPERATURE, MOLAR_MASS = 1e5, 300.0, 0.0289
PATCHES = ("inlet", "outlet", "walls")


def text(value, indent=0):
    """OpenFOAM's dictionary syntax of nested dicts, lists and words."""
    pad = "    " * indent
    if isinstance(value, dict):
        lines = (f"{pad}{key}\n{pad}{{\n{text(item, indent + 1)}{pad}}}\n" if isinstance(item, dict)
                 else f"{pad}{key} {text(item)};\n" for key, item in value.items())
        return "".join(lines)
    if isinstance(value, (list, tuple)):
        return "(" + " ".join(text(item) for item in value) + ")"
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def write(path, content, kind="dictionary"):
    path.parent.mkdir(parents=True, exist_ok=True)
    head = {"FoamFile": {"version": "2.0", "format": "ascii", "class": kind, "object": path.name}}
    path.write_text(text(head) + (content if isinstance(content, str) else text(content)))


def write_field(directory, name, dimensions, internal, boundary, layers=1, **more):
    """internal: a number, a vector, or one of them per cell (y by x), alike in all layers; boundary: {patch: {...}}."""
    vector = isinstance(internal, tuple) or (isinstance(internal, np.ndarray) and internal.ndim == 3)
    kind, item = ("volVectorField", "vector") if vector else ("volScalarField", "scalar")
    if isinstance(internal, np.ndarray):
        values = layers * [text(v) for v in (internal.reshape(-1, 3) if vector else internal.ravel()).tolist()]
        internal = f"nonuniform List<{item}>\n{len(values)}\n(\n" + "\n".join(values) + "\n)"
    else:
        internal = f"uniform {text(internal)}"
    patches = {patch: boundary.get(patch, boundary.get("others")) for patch in PATCHES}
    patches["sides"] = boundary.get("sides", patches["walls"] if layers > 1 else {"type": "empty"})
    head = {"dimensions": f"[{dimensions} 0 0 0]", "internalField": internal}
    write(directory / "0" / name, head | more | {"boundaryField": patches}, kind)


def fixed(value):
    return {"type": "fixedValue", "value": f"uniform {text(value)}"}


def write_mesh(directory, bed):
    (width, height), (nx, ny) = bed["size"], bed["cells"]
    depth, layers = bed.get("depth", width / nx), bed.get("layers", 1)
    around = ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height))
    corners = [(x, y, z) for z in (0.0, depth) for x, y in around]
    faces = {"inlet": [(0, 1, 5, 4)], "outlet": [(3, 7, 6, 2)], "walls": [(0, 4, 7, 3), (1, 2, 6, 5)],
             "sides": [(0, 3, 2, 1), (4, 5, 6, 7)]}
    kinds = {"walls": "wall", "sides": "wall" if layers > 1 else "empty"} | bed.get("patches", {})
    boundary = " ".join(f"{patch} {{ type {kinds.get(patch, 'patch')}; faces {text(f)}; }}"
                        for patch, f in faces.items())
    block = f"(hex {text(tuple(range(8)))} {text((nx, ny, layers))} simpleGrading (1 1 1))"
    write(directory / "system/blockMeshDict", {"scale": 1, "vertices": corners, "blocks": block, "edges": [],
                                               "boundary": f"({boundary})", "mergePatchPairs": []})


def write_control(directory, settings):
    """Fixed steps, as in the tutorials of both programs."""
    write(directory / "system/controlDict", {
        "application": settings["program"], "startFrom": "startTime", "startTime": 0, "stopAt": "endTime",
        "endTime": settings["until"], "deltaT": settings["step"], "adjustTimeStep": "no", "writeControl": "runTime",
        "writeInterval": settings["every"], "writeFormat": "ascii", "writePrecision": 10, "writeCompression": "off",
        "timePrecision": 8, "runTimeModifiable": "no"})


def write_numerics(directory, bed, settings):
    """Schemes and solvers of OpenFOAM's own tutorials of these programs; the number of iterations from the settings."""
    names = [s["name"] for s in bed["solids"]] + [bed["fluid"]["name"]]
    vectors, scalars = "Gauss limitedLinearV 1", "Gauss limitedLinear 1"
    stress = {f"div((((alpha.{n}*thermo:rho.{n})*nuEff.{n})*dev2(T(grad(U.{n})))))": "Gauss linear" for n in names} | {
        f"div((((thermo:rho.{n}*nut.{n})*dev2(T(grad(U.{n}))))+(((thermo:rho.{n}*lambda.{n})*div(phi.{n}))*I)))":
        "Gauss linear" for n in names}
    write(directory / "system/fvSchemes", {
        "ddtSchemes": {"default": "Euler"}, "gradSchemes": {"default": "Gauss linear"},
        "divSchemes": {"default": "none", r'"div\(phir?,alpha.*\)"': "Gauss vanLeer",
                       r'"div\(alphaRhoPhi.*,U.*\)"': vectors, r'"div\(phi.*,U.*\)"': vectors,
                       r'"div\(alphaRhoPhi.*,(h|e|K).*\)"': scalars, r'"div\(alphaPhi.*,p\)"': scalars} | stress,
        "laplacianSchemes": {"default": "Gauss linear uncorrected", "bounded": "Gauss linear uncorrected"},
        "interpolationSchemes": {"default": "linear"},
        "snGradSchemes": {"default": "uncorrected", "bounded": "uncorrected"}})
    smooth = {"solver": "smoothSolver", "smoother": "symGaussSeidel", "relTol": 0, "minIter": 1}
    pressure = {"solver": "GAMG", "smoother": "DIC", "tolerance": 1e-8, "relTol": 0}
    write(directory / "system/fvSolution", {
        "solvers": {'"alpha.*"': {"nAlphaCorr": 1, "nAlphaSubCycles": settings["alpha_steps"], "smoothLimiter": 0.1,
                                  "implicitPhasePressure": "yes"} | smooth | {"tolerance": 1e-9},
                    "p_rgh": pressure, "p_rghFinal": pressure, '"U.*"': smooth | {"tolerance": 1e-5},
                    '"(h|e|Theta).*"': smooth | {"tolerance": 1e-6}},
        "PIMPLE": {"nOuterCorrectors": settings["outer"], "nCorrectors": 1, "nNonOrthogonalCorrectors": 0},
        "relaxationFactors": {"equations": {'".*"': 1}}})


def thermophysics(density, viscosity, perfect_gas=False):
    """Constant density, or a perfect gas with the molar mass of air; no heat flows, as all temperatures are equal."""
    state = {} if perfect_gas else {"equationOfState": {"rho": density}}
    return {"thermoType": {"type": "heRhoThermo", "mixture": "pureMixture", "transport": "const", "thermo": "hConst",
                           "equationOfState": "perfectGas" if perfect_gas else "rhoConst", "specie": "specie",
                           "energy": "sensibleInternalEnergy"},
            "mixture": {"specie": {"molWeight": 1000 * MOLAR_MASS}} | state |
            {"thermodynamics": {"Cp": 1000.0, "Hf": 0}, "transport": {"mu": viscosity, "Pr": 1}}}


def start_fractions(bed, solid):
    """phi_j of one species in every cell, y by x: its fraction below the height, shared by the cell that it cuts."""
    (nx, ny), top = bed["cells"], bed["height"] / bed["size"][1] * bed["cells"][1]
    return np.repeat(np.clip(top - np.arange(ny), 0, 1)[:, None], nx, axis=1) * solid["fraction"]


def write_start(directory, bed, solids_wall):
    """Bed at rest, the volume flux of the inlet everywhere; at walls no slip for the fluid, solids_wall for solids."""
    fluid, still = bed["fluid"]["name"], (0.0, 0.0, 0.0)
    field = functools.partial(write_field, directory, layers=bed.get("layers", 1))
    up, free = (0.0, float(bed["velocity"]), 0.0), {"others": {"type": "zeroGradient"}}
    fractions = {s["name"]: start_fractions(bed, s) for s in bed["solids"]}
    fractions[fluid] = 1 - sum(fractions.values())
    for name, values in fractions.items():
        field(f"alpha.{name}", "0 0 0 0", values, free)
        inlet = {"inlet": fixed(TEMPERATURE)} if name == fluid else {}
        field(f"T.{name}", "0 0 0 1", TEMPERATURE, free | inlet)
    for solid in bed["solids"]:
        field(f"U.{solid['name']}", "0 1 -1 0", still,
              {"others": fixed(still), "walls": {"type": solids_wall}})
    inside = bed["velocity"] / fractions[fluid][..., None] * np.array([0.0, 1.0, 0.0])
    field(f"U.{fluid}", "0 1 -1 0", inside, {
        "inlet": {"type": "interstitialInletVelocity", "inletVelocity": f"uniform {text(up)}",
                  "alpha": f"alpha.{fluid}", "value": f"uniform {text(tuple(inside[0, 0].tolist()))}"},
        "outlet": {"type": "pressureInletOutletVelocity", "phi": f"phi.{fluid}", "value": f"uniform {text(up)}"},
        "walls": {"type": "noSlip"}})
    value = {"value": f"uniform {PRESSURE:g}"}
    field("p", "1 -1 -2 0", PRESSURE, {"others": {"type": "calculated"} | value})
    field("p_rgh", "1 -1 -2 0", PRESSURE, {
        "others": {"type": "fixedFluxPressure"} | value,
        "outlet": {"type": "prghPressure", "p": f"uniform {PRESSURE:g}"} | value})


def write_common(directory, bed, settings, solids_wall):
    write_mesh(directory, bed)
    write_control(directory, settings)
    write_numerics(directory, bed, settings)
    write_start(directory, bed, solids_wall)
    write(directory / "constant/g", {"dimensions": "[0 1 -2 0 0 0 0]", "value": (0.0, -9.81, 0.0)},
          "uniformDimensionedVectorField")


def pairs(entries):
    """OpenFOAM's list of models of pairs of phases: {pair: {...}}."""
    return "(" + " ".join(f"({pair}) {{ {text(model)} }}" for pair, model in entries.items()) + ")"


def drag_of(bed, law):
    fluid = bed["fluid"]["name"]
    model = {"type": law, "residualRe": 1e-3, "swarmCorrection": {"type": "none"}}
    return pairs({f"{s['name']} in {fluid}": model for s in bed["solids"]})


def write_liquid_bed(directory, bed, settings):
    """Several solids in a liquid for reactingMultiphaseEulerFoam; no solids stress, no heat, no virtual mass."""
    directory, fluid = Path(directory), bed["fluid"]
    write_common(directory, bed, settings, "slip")
    phases = {s["name"]: s for s in bed["solids"]} | {fluid["name"]: fluid | {"diameter": 1e-3}}
    for name, phase in phases.items():
        write(directory / f"constant/thermophysicalProperties.{name}", thermophysics(
            phase["density"], phase.get("viscosity", 0.0)))
        write(directory / f"constant/turbulenceProperties.{name}", {"simulationType": "laminar"})
    models = {name: {"type": "pureIsothermalPhaseModel", "diameterModel": "constant",
                     "constantCoeffs": {"d": phase["diameter"]}, "residualAlpha": 1e-6}
              for name, phase in phases.items()}
    absent = ("surfaceTension", "interfaceCompression", "aspectRatio", "virtualMass", "heatTransfer", "phaseTransfer",
              "lift", "wallLubrication", "turbulentDispersion")
    write(directory / "constant/phaseProperties", {"type": "basicMultiphaseSystem", "phases": list(phases)} | models | {
        "blending": {"default": {"type": "none", "continuousPhase": fluid["name"]}},
        "drag": drag_of(bed, settings["drag"])} | dict.fromkeys(absent, "()") | {"pMin": 1000.0})


def kinetic_theory(bed):
    """Constants of the tutorial; the granular temperature from a balance in each cell (`equilibrium`)."""
    return {"simulationType": "RAS", "RAS": {"RASModel": "kineticTheory", "turbulence": "on", "printCoeffs": "off",
            "kineticTheoryCoeffs": {
                "equilibrium": "on", "e": bed["restitution"], "alphaMax": bed["max_packing"], "alphaMinFriction": 0.5,
                "residualAlpha": 1e-4, "viscosityModel": "Gidaspow", "conductivityModel": "Gidaspow",
                "granularPressureModel": "Lun", "radialModel": "SinclairJackson",
                "frictionalStressModel": "JohnsonJackson",
                "JohnsonJacksonCoeffs": {"Fr": 0.05, "eta": 2, "p": 5, "phi": 28.5, "alphaDeltaMin": 0.05}}}}


def write_gas_bed(directory, bed, settings):
    """Bed of one species in a gas for twoPhaseEulerFoam with kinetic theory; laminar gas, no virtual mass."""
    directory, fluid, (solid,) = Path(directory), bed["fluid"], bed["solids"]
    write_common(directory, bed, settings, "noSlip")
    write(directory / f"constant/thermophysicalProperties.{fluid['name']}", thermophysics(
        fluid["density"], fluid["viscosity"], settings["gas"] == "perfect"))
    write(directory / f"constant/thermophysicalProperties.{solid['name']}", thermophysics(solid["density"], 0.0))
    write(directory / f"constant/turbulenceProperties.{fluid['name']}", {"simulationType": "laminar"})
    write(directory / f"constant/turbulenceProperties.{solid['name']}", kinetic_theory(bed))
    plain = {"others": {"type": "calculated", "value": "uniform 0"}}
    write_field(directory, f"nut.{solid['name']}", "0 2 -1 0", 0.0, plain)
    write_field(directory, f"alphat.{solid['name']}", "1 -1 -1 0", 0.0, plain)
    write_field(directory, f"Theta.{solid['name']}", "0 2 -2 0", 0.0,
                {"others": {"type": "zeroGradient"}, "inlet": fixed(1e-4)}, referenceLevel=1e-4)
    phase = {"diameterModel": "constant"}
    write(directory / "constant/phaseProperties", {
        "phases": [solid["name"], fluid["name"]],
        solid["name"]: phase | {"constantCoeffs": {"d": solid["diameter"]}, "alphaMax": bed["max_packing"],
                                "residualAlpha": 1e-6},
        fluid["name"]: phase | {"constantCoeffs": {"d": 1.0}, "residualAlpha": 0},
        "blending": {"default": {"type": "none", "continuousPhase": fluid["name"]}},
        "sigma": f"(({solid['name']} and {fluid['name']}) 0)", "aspectRatio": "()",
        "drag": drag_of(bed, settings["drag"]), "virtualMass": "()",
        "heatTransfer": pairs({f"{solid['name']} in {fluid['name']}":
                               {"type": "RanzMarshall", "residualAlpha": 1e-3}}),
        "lift": "()", "wallLubrication": "()", "turbulentDispersion": "()", "pMin": 10000.0})


def write_case(directory, bed, settings):
    (write_gas_bed if settings["program"] == "twoPhaseEulerFoam" else write_liquid_bed)(directory, bed, settings)
