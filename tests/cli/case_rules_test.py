#!/usr/bin/python3
"""What a case must say, and must not: everything at once, with its reason. Usage: case_rules_test.py PROGRAM"""
import re

import program
from feed_rules import FEEDS, feeds
from joined_rules import AIR, AT_TOP, JOINED, JOINED_IN_FLUID, TILTED, jets
from layer_rules import COUNTED, LAYERS
from port_rules import PORTS, PORTS_FOR_ONE_MODEL
from resolve_rules import RESOLVED
from wall_rules import GRADED, ROUND, ROUND_FOR_ONE_MODEL, ROUND_OF_MODELS, WALLS
from program import DONE, WRONG_CASE, Scratch, run, strict_json

BED = """[column]
size = ["60 mm", "200 mm"]
cells = [6, 20]
[fluid]
name = "water"
temperature = "15 degC"
[[species]]
name = "fine"
diameter = "0.8 mm"
density = 1395
[bed]
volume_share = [1.0]
static_height = "60 mm"
solids_fraction = 0.6
[inlet]
superficial_velocity = "10 mm/s"
[effects]
others = "none"
drag = "cello"
solids_stress = "frictional"
[run]
until = "10 ms"
"""
FLUID, INLET = '[fluid]\nname = "water"\ntemperature = "15 degC"\n', '[inlet]\nsuperficial_velocity = "10 mm/s"\n'
LAWS = {"drag": "cello", "fluid_stress": "newtonian", "gas_slip": "cunningham", "added_mass": "zuber", "lift": "saffman_mei",
        "magnus": "rubinow_keller", "history": "basset", "brownian": "langevin", "lubrication": "film"}
DRY = "fluid.name=none"


def on(role, law=None):
    return f"effects.{role}={law or LAWS[role]}"


SHEARED = "dem.shear_rate=1"
FLOW = ["inlet.superficial_velocity=!", "inlet.flow_rate=1e-5"]
SIZES = 'species=[{name="fine", density=1395, distribution="lognormal", median=1e-8, deviation=1}]'


def pairs(*between):
    return "contact_pair=[" + ", ".join(f"{{between={list(names)}}}".replace("'", '"') for names in between) + "]"


def species(*names):
    return ["species=[" + ", ".join(f'{{name="{name}", diameter=0.8e-3, density=1395}}' for name in names) + "]",
            f"bed.volume_share={[1 / len(names)] * len(names)}"]


# What the keys require of each other, in words of --set as the rest below.
KEYS = {
    "column.size has {} numbers: two (width, height) or three (width, depth, height)": ["column.size=[0.06]"],
    "column.cells has {} numbers, column.size {}": ["column.cells=[6]"],
    "column.gravity_direction has {} numbers, column.size {}": ["column.gravity_direction=[0, 0, -1]"],
    "column.gravity_direction has no direction: all its numbers are 0": ["column.gravity_direction=[0, 0]"],
    "column.depth is the depth of a two-dimensional column; column.size has three numbers": [
        "column.size=[0.06,0.06,0.2]", "column.cells=[6,6,20]", "column.depth=0.01"],
    "column.cells: {} cells; at most {} can be numbered, however large the memory": ["column.cells=[1000000, 1000000]"],
    "species.diameter: {} m is more than the {} of the column, {} m": ["column.size=[0.0007, 0.2]"],
    "column.gravity_direction other than down and a compressible fluid contradict each other: its density at rest falls with height; use "
    'fluid.equation_of_state = "incompressible"': [*AIR, TILTED],
    "column.gravity_direction other than down needs a fluid whose flow is given at both ends, since the pressure at an outlet is that of a "
    'level surface: use inlet.at = "top", or column.closed = true without inlet.superficial_velocity and [[jet]]': [TILTED],
    **{f'column.ends = "periodic" and {what} contradict each other': [JOINED, setting] for what, setting in (("[[feed]]", feeds("")),
        ("column.closed = true", "column.closed=true"), ("column.grading", GRADED), *((f'column.outlet = "{a}"', f"column.outlet={a}") for a in ("open", "lid")))},
    'dem.shear_rate = {} 1/s needs column.sides = "periodic"': [SHEARED],
    'dem.shear_rate = {} 1/s needs column.ends = "periodic"': [SHEARED],
    **JOINED_IN_FLUID,
    "dem.shear_rate = {} 1/s needs column.gravity = 0, it is {} m/s2": [SHEARED],
    "jet.from and jet.to have {} and {} numbers: {} here": [jets(([0.01, 0], [0.02]))],
    "a jet from {} to {} m {}": [jets(([0.01], [0.07]))],
    "two jets overlap: [[jet]] number {} and {}": [jets(([0.01], [0.03]), ([0.02], [0.04]))],
    **WALLS,
    'dem.opening = {} m: a fluid enters there, and particles leave through the top alone (column.outlet = "open"); set fluid.name = "none"': [
        "dem.opening=0.01"],
    'dem.opening = {} m: column.ends = "periodic" leaves no bottom to open': ["dem.opening=0.01", JOINED],
    "dem.opening = {} m: it must be narrower than the bottom, which is {} m {}": ["dem.opening=0.06"],
    "dem.opening = {} m: the largest particle, of {} m, must fit through": ["dem.opening=0.0007"],
    "{} would have a diameter of {} m: fewer species.classes, or a smaller species.deviation": [SIZES],
    "[[species]]: {} species, at most 15": species(*(f"s{n}" for n in range(16))),
    'species.name = "{}" stands twice, or is "wall" or "fluid"': species("fine", "fine"),
    'species.name = "{}" names columns and datasets: not empty, without , / < > & " \\ and line ends': species("a/b"),
    "inversion.measured: one value, or two, the least and the greatest": ["inversion.measured=[0.03, 0.02]"],
    "inversion.simulated: one value, or two, the least and the greatest": ["inversion.simulated=[0.02, 0.03, 0.04]"],
    "contact_pair.between takes two names": [pairs(["fine"])],
    "contact_pair.between: no species '{}'": [pairs(["fine", "fluid"])],
    "contact_pair.between: a wall touches no wall; name a species": [pairs(["wall", "wall"])],
    "two [[contact_pair]] of {} and {}: write one": [pairs(["fine", "wall"], ["wall", "fine"])],
    "bed.particles counts spheres of one size: with a species.distribution give bed.volume_share and bed.static_height": [
        SIZES.replace("1e-8", "1e-3"), *COUNTED, "bed.particles=[10]"],
    "bed.particles has {} numbers, there are {} species": [*COUNTED, "bed.particles=[10, 10]"],
    "bed.particles: no particles at all": [*COUNTED, "bed.particles=[0]"],
    "bed.volume_share has {} numbers, there are {} species": ["bed.volume_share=[0.5, 0.5]"],
    "bed.volume_share sums to {}, not to 1": ["bed.volume_share=[0.9]"],
    "bed.start_solids_fraction = {} is denser than the settled bed, {}": ["bed.start_solids_fraction=0.7"],
    "the bed at its start is {} m high, the column {} m: enlarge column.size": ["bed.static_height=0.3"],
    **LAYERS,
    **FEEDS,
    **PORTS,
    'bed.start = "{}": no such file in the working directory or beside the case file': [*COUNTED, "bed.start=list:none.csv"],
    'inlet.at = "top" and column.outlet = "open" contradict each other: what spreads the fluid holds the solids back': [
        AT_TOP[1], "column.outlet=open"],
    'inlet.at = "top" and a compressible fluid contradict each other: its pressure is given at the top': [AT_TOP[1], *AIR],
    **{f'{what} cannot act: fluid.name = "none"': [DRY, setting] for what, setting in (
        ("inlet.superficial_velocity", "inlet.superficial_velocity=0.1"), ("[[jet]]", jets(([0.01], [0.02]))), AT_TOP, ("column.grading", GRADED),
        ('column.outlet = "lid", which stops the fluid alone,', "column.outlet=lid"), ("fluid.temperature", "fluid.temperature=300"), ("fluid.density", "fluid.density=1"),
        ("fluid.viscosity", "fluid.viscosity=1"), ("fluid.equation_of_state", "fluid.equation_of_state=tait"), ("species.sphericity", "species.fine.sphericity=0.9"))},
    **{f"{what} cannot act: column.closed = true": ["column.closed=true", setting] for what, setting in (
        ("inlet.superficial_velocity", "inlet.superficial_velocity=0.1"), ("[[jet]]", jets(([0.01], [0.02]))), AT_TOP, ("[[feed]]", feeds("")),
        ('column.outlet = "open"', "column.outlet=open"), ('column.outlet = "lid"', "column.outlet=lid"))},
    **{f"{what} cannot act in a sheared box: its fluid moves with its flow": [SHEARED, setting] for what, setting in (
        ("inlet.superficial_velocity", "inlet.superficial_velocity=0.1"), ("[[jet]]", jets(([0.01], [0.02]))), AT_TOP,
        ("dem.held = true", "dem.held=true"), ("fluid.equation_of_state", "fluid.equation_of_state=tait"))},
    **{f'bed.{key} cannot act: bed.start = "{{}}"': ["bed.start=list:none.csv", f"bed.{key}={value}"] for key, value in (
        ("start_solids_fraction", 0.2), ("volume_share", [1.0]), ("static_height", 0.06), ("particles", [10]))},
    **{f"output.{key} = {{}} s: {{}} times until run.until = {{}} s; at most {{}}: take a longer one": [f"output.{key}=1e-12"]
       for key in ("every", "history_every", "checkpoint_every")},
    "inlet.superficial_velocity is missing (or give inlet.flow_rate, or set column.closed = true)": ["inlet.superficial_velocity=!"],
    "inlet.flow_rate and inlet.superficial_velocity both say how much flows in: give one of them": ["inlet={flow_rate=1e-5, superficial_velocity=0.01}"],
    "inlet.flow_rate in two dimensions needs column.depth: without it there is no area that it flows through": FLOW,
    "inlet.flow_rate makes {} m/s over the column's cross-section; at most 1000 m/s": [*FLOW, "column.depth=0.01", "inlet.flow_rate=10"],
    'fluid.equation_of_state = "ideal_gas": water is a liquid; "tait" is the law of a compressible liquid': [
        "fluid.equation_of_state=ideal_gas"],
    'fluid.equation_of_state = "tait": air is a gas; "ideal_gas" is its law': ["fluid.name=air", "fluid.equation_of_state=tait"],
    'dem.held = true is a fixed bed for a fluid to flow through: fluid.name is "none"': [DRY, "dem.held=true"],
    **{f"chooser.{key}: two values, the least and the greatest": [f"chooser.{key}=[{least}, {least / 2}]"] for key, least in (
        ("velocity_range", 0.1), ("temperature_range", 300))},
    'dem.kernel_width cannot act: dem.kernel = "bilinear" has the width of the cells; use "diffusion" or "auto"': [
        "dem.kernel=bilinear", "dem.kernel_width=0.01"],
    "tfm.fixed_step works with explicit and imex steps only": ["tfm.integrator=implicit", "tfm.fixed_step=1e-4"],
    "tfm.rtol = {} with the implicit integrator: {}": ["tfm.integrator=implicit", "tfm.rtol=0.01"],
    **{f"calibrate.{key} must rise": [f"calibrate.{key}=[0.3, 0.2]"] for key in ("solids_fraction", "stokes", "restitution", "friction", "share")},
    "calibrate.solids_fraction: a table needs two of them or more": ["calibrate.solids_fraction=[0.3]"],
    "calibrate.share is of two species, the case has {}": ["calibrate.share=[0.3]"],
    "calibrate.share: both species have to be there, above 0 and below 1": ["calibrate.share=[0, 0.5]"],
    'calibrate.share cannot act: the fluidised boxes of calibrate.regime = "bed" have one size': [
        "calibrate.share=[0.3]", "calibrate.regime=bed"],
    **RESOLVED,
    'calibrate.regime = "{}" needs a fluid: fluid.name is "none"': [DRY, "calibrate.regime=wet"],
}

# What one model has no equations for, which check notes of a case that the other runs.
NO_FLUID = [DRY, "fluid.temperature=!", "inlet.superficial_velocity=!", "effects.drag=none"]
TFM_CANNOT = ": polybed dem can run it, polybed tfm cannot"
TABLE = program.ROOT / "cases/small-binary/table.h5"
CONTACT = "effects.contact: particles need a law of contact: hertz_mindlin, hertz or linear"
ONE_MODEL = {
    **ROUND_FOR_ONE_MODEL,
    **PORTS_FOR_ONE_MODEL,
    "column.gravity_direction other than down in a round column" + TFM_CANNOT: [
        *NO_FLUID, "column.gravity_direction=[1, 0, -1]", "bed.static_height=0.002", *ROUND],
    CONTACT: ["effects.contact=none"],  # a case that is not meant for particles has no note of it
    'fluid.name = "none"' + TFM_CANNOT: NO_FLUID,
    "dem.shear_rate other than 0" + TFM_CANNOT: [*NO_FLUID, JOINED, "column.sides=periodic", "column.gravity=0", SHEARED],
    'bed.start = "{}"' + TFM_CANNOT: ["bed.start=random"],
    'column.gravity_direction other than down without column.closed = true or inlet.at = "top"' + TFM_CANNOT: [*NO_FLUID, TILTED],
    'column.gravity_direction other than down with column.sides = "periodic"' + TFM_CANNOT: [*NO_FLUID, TILTED, "column.sides=periodic"],
    'column.gravity_direction other than down with bed.start = "settled"' + TFM_CANNOT: [*NO_FLUID, TILTED, "bed.start=settled"],
    'column.outlet = "open" in a compressible fluid: polybed tfm can run it, polybed dem cannot: the mass of the fluid that takes the place '
    'of a particle as it leaves would be missing; use fluid.equation_of_state = "incompressible"': [*AIR, "column.outlet=open"],
    "[[feed]] in a compressible fluid: polybed tfm can run it, polybed dem cannot: the mass of the fluid that a particle displaces as it "
    'enters would be lost; use fluid.equation_of_state = "incompressible"': [*AIR, feeds("")],
}

# For each rule that the program lists what breaks it, in words of --set. {} stands for a word of the scene.
BROKEN = {
    **KEYS,
    **ROUND_OF_MODELS,
    **{f'effects.{role} = "{{}}" cannot act: fluid.name = "none"': [DRY, on(role)] for role in LAWS},
    **{f"effects.{role} cannot act in a sheared box: its fluid moves with its flow": ["dem.shear_rate=1", on(role)]
       for role in ("fluid_stress", "added_mass", "lift", "magnus", "history")},
    "effects.gas_slip: a fluid of {} kg/m3 is a liquid, which does not slip: leave it out": [on("gas_slip")],
    'effects.partition = "{}" cannot act: fluid.name = "none"': [DRY, on("partition", "cello")],
    'effects.shape = "{}" cannot act: fluid.name = "none"': [DRY, on("shape", "ganser")],
    'effects.shape = "{}" changes nothing: every species is a sphere; give species.sphericity below 1, or leave out effects.shape': [
        on("shape", "ganser")],
    'effects.shape = "{}" is a factor on the drag: give effects.drag': [
        on("shape", "ganser"), "species.fine.sphericity=0.9", "effects.drag=none"],
    'effects.partition = "{}" shares a drag law of one size: give effects.drag, e.g. "wen_yu"': [
        on("partition", "cello"), "effects.drag=none"],
    'effects.partition = "{}" cannot share drag = "{}", which is a law of mixtures itself: give a law of one size, e.g. "wen_yu" or "vbk"': [
        on("partition", "cello"), "effects.drag=syamlal"],
    'effects.granular_temperature = "algebraic" needs a restitution below 1: species {}': [
        "effects.solids_stress=kinetic", "dem.restitution=1"],
    'effects.granular_temperature = "{}" acts only with solids_stress = "kinetic" or a dry table': [
        "effects.solids_stress=none", "effects.granular_temperature=algebraic"],
    'effects.granular_temperature = "{}" cannot be with effects.solids_stress = "frictional": '
    "fluctuations act through the kinetic stress alone": ["effects.granular_temperature=algebraic"],
    'effects.solids_stress = "frictional" cannot be with effects.granular_temperature = "{}"': ["effects.granular_temperature=algebraic"],
    'effects.solids_viscosity = "{}" needs a solids_stress: its pressure': ["effects.solids_stress=none", "effects.solids_viscosity=mu_i"],
    'effects.magnus = "{}" cannot be with effects.contact = "hertz": a force of rotation, and nothing rotates without friction': [
        on("magnus"), "effects.contact=hertz"],
    'effects.contact = "hertz" cannot be with effects.magnus = "{}"': [on("magnus"), "effects.contact=hertz"],
    'effects.history = "{}" is a force on particles that accelerate, and dem.held holds them: leave one out': [
        on("history"), "dem.held=true"],
    'fluid.temperature: effects.brownian = "{}" needs it, as in "20 degC"': [
        on("brownian"), "fluid.name=oil", "fluid.density=900", "fluid.viscosity=0.1", "fluid.temperature=!"],
    'effects.brownian = "{}" moves particles against their drag: name a law of effects.drag, and leave out dem.held': [
        on("brownian"), "effects.drag=none"],
    'dem.normal_stiffness: effects.contact = "linear" needs it, as in "1000 N/m"': ["effects.contact=linear"],
    **{f'dem.tangential = "{law}" needs the radius of a contact, which effects.contact = "linear" has not: use hertz_mindlin, or '
       'dem.tangential = "linear"': ["effects.contact=linear", "dem.normal_stiffness=1000", f"dem.tangential={law}"]
       for law in ("mindlin", "mindlin_deresiewicz")},
    'dem.tangential = "linear" is a share of dem.normal_stiffness: it goes with effects.contact = "linear"': [
        "effects.contact=hertz_mindlin", "dem.tangential=linear"],
    'dem.rolling_friction: effects.rolling = "{}" needs it, above 0': ["effects.rolling=epsd", "effects.contact=hertz_mindlin"],
    'dem.rolling_damping: effects.rolling = "cdt" has no spring to damp; use epsd': [
        "effects.rolling=cdt", "effects.contact=hertz_mindlin", "dem.rolling_friction=0.1", "dem.rolling_damping=0.1"],
    'effects.rolling = "{}" cannot be with effects.contact = "hertz": a resistance to rotation, and nothing rotates without friction': [
        "effects.rolling=epsd", "effects.contact=hertz", "dem.rolling_friction=0.1"],
    'effects.contact = "hertz" cannot be with effects.rolling = "{}"': [
        "effects.rolling=epsd", "effects.contact=hertz", "dem.rolling_friction=0.1"],
    **{f'dem.cohesion_energy: effects.cohesion = "{law}" needs it, as in "50 mJ/m2"': [f"effects.cohesion={law}"] for law in ("dmt", "jkr")},
    'dem.hamaker_constant: effects.cohesion = "van_der_waals" needs it, as in 1e-19': ["effects.cohesion=van_der_waals"],
    "effects.liquid_bridge: a fluid of {} kg/m3 is a liquid, in which particles have no liquid bridges: leave it out": [
        "effects.liquid_bridge=willett", "dem.surface_tension=0.07", "dem.liquid_fraction=0.01"],
    'dem.surface_tension: effects.liquid_bridge = "{}" needs it, as in "72 mN/m"': ["effects.liquid_bridge=willett", "dem.liquid_fraction=0.01"],
    'dem.liquid_fraction: effects.liquid_bridge = "{}" needs it, above 0, as in 0.01': ["effects.liquid_bridge=willett", "dem.surface_tension=0.07"],
    'effects.cohesion = "{}" cannot be with effects.contact = "linear": '
    "it stands in place of Hertz' force, which linear springs have not": ["effects.cohesion=jkr", "effects.contact=linear"],
    'effects.contact = "linear" cannot be with effects.cohesion = "{}"': ["effects.cohesion=jkr", "effects.contact=linear"],
    "dem.held = true without drag: nothing resists the flow through the bed; name a law in effects.drag": [
        "dem.held=true", "effects.drag=none"],
    'tfm.solids_wall = "johnson_jackson" acts through a viscosity of the solids: effects.solids_viscosity, or '
    'effects.solids_stress = "kinetic"': ["tfm.solids_wall=johnson_jackson"],
    'tfm.form = "B" is for incompressible fluids: the pressure that follows a gas would not hold up the solids': [
        "tfm.form=B", "fluid.equation_of_state=tait"],
    'tfm.max_packing = "fedors_landel" is for two species; yu_standish is for any number': ["tfm.max_packing=fedors_landel"],
    "tfm.max_packing = {} must lie above tfm.frictional_onset = {}": ["tfm.max_packing=0.4"],
    'solids_fraction = {} of the settled bed, or of a layer, must lie above tfm.frictional_onset = {} for tfm.max_packing = "auto"; lower the onset': ["bed.solids_fraction=0.45", "tfm.frictional_onset=0.5"],
    "tfm.max_packing = {}: the bed at its start, with a solids fraction of {}, lies more than {} above; lower bed.start_solids_fraction": [
        "bed.solids_fraction=0.68", "tfm.max_packing=0.64"],
    'tfm.max_packing = "auto": the bed is too light to be held at bed.solids_fraction; give a number, e.g. 0.64': [
        "species.fine.density=999.2"],
    'bed.start = "settled" needs effects.solids_stress: nothing else carries a bed of this model': [
        "bed.start=settled", "effects.solids_stress=none"],
    'bed.start = "settled" needs solids heavier than the fluid': ["bed.start=settled", "species.fine.density=900"],
    'tfm.integrator = "imex" takes the drag implicitly: it needs {}': ["tfm.integrator=imex", "effects.drag=none"],
    "effects.solids_stress: {}": ["effects.solids_stress=table:TABLE", "effects.granular_temperature=algebraic"],
    "effects.species_exchange: {}": ["effects.species_exchange=table:TABLE"],
    "the particles have no room at their start: {}": ["bed.static_height=0.0003"],
    "column.depth: {}": ["column.depth=0.0015"],
    "column.size: {}": ["column.size=[0.0015, 0.2]", "column.cells=[1, 20]", "column.sides=periodic"],
    "dem.greatest_speed: without gravity, shear or particles that move nothing tells how fast they will be; give the greatest speed "
    "expected, which sets the time step": ["column.gravity=0"],
    'bed.start = "settled": without column.gravity nothing settles; use "random" or "mixed"': ["bed.start=settled", "column.gravity=0"],
    'bed.start = "settled": along joined faces particles fall for ever; use "random" or "mixed", or walls across the direction of '
    "column.gravity": [*NO_FLUID, JOINED, "bed.start=settled"],
    'dem.fluid_ranks = "shared" does not go with a kernel of diffusion, which needs the whole column: use "each", or cells of at least 1.5 '
    'diameters with dem.kernel = "bilinear"': ["dem.fluid_ranks=shared", "dem.kernel=diffusion"],
    "chooser.temperature_range: {}": ['chooser.temperature_range=["15 degC", "900 degC"]'],
    "chooser.temperature_range cannot act: fluid.density and fluid.viscosity are given as numbers": [
        'chooser.temperature_range=["15 degC", "20 degC"]', "fluid.density=1000", "fluid.viscosity=1e-3"],
    "{}": ["fluid.temperature=900"],  # what is wrong with the fluid
    "bed.solids_fraction = {}: spheres of these sizes fill at most {} of the volume, and about 0.6 when they settle": [
        "bed.solids_fraction=0.85"],
    'bed.start = "random": the particles would fill {} of the column, spheres of these sizes fill at most {}: enlarge column.size, '
    "or take fewer": ["bed.start=random", "bed.volume_share=!", "bed.static_height=!", "bed.particles=[76730]"],
}


def without(*parts):
    text = BED
    for part in parts:
        assert part in text, part
        text = text.replace(part, "")
    return text


class CaseTest(Scratch):
    def refused(self, text, *settings, command=("check",)):
        """The lines of what is wrong, without the name of the file."""
        words = [word for setting in settings for word in ("--set", setting)]
        told = self.ends(WRONG_CASE, *command, self.write("case.toml", text), *words).stderr
        return [line.replace(str(self.folder), "") for line in told.splitlines()]

    def notes(self, *settings):
        words = [word for setting in settings for word in ("--set", setting)]
        return strict_json(self.ends(DONE, "check", self.write("case.toml", BED), "--json", *words).stdout)["notes"]

    def with_settings(self, settings):
        """The bed and these settings, "!" taking a key away."""
        text = BED
        for key in (setting.split("=")[0].split(".")[1] for setting in settings if setting.endswith("=!")):
            text = re.sub(rf"(?m)^{key} = .*\n", "", text)
        return text, [setting for setting in settings if not setting.endswith("=!")]

    def broken_case(self, settings, model):
        """Each line of what is wrong with the bed and these settings, for one model or both."""
        text, settings = self.with_settings([setting.replace("TABLE", str(TABLE)) for setting in settings])
        if model == "dem" and not any(setting.startswith("effects.contact") for setting in settings):
            settings.append("effects.contact=hertz_mindlin")
        command = ("check",) if model == "tfm, dem" else (model, "-o", self.folder / "run")
        return self.refused(text, *settings, command=command)


class Rules(CaseTest):
    def test_every_rule_is_broken_by_a_case_of_its_own(self):
        rules = strict_json(self.ends(DONE, "list", "--json").stdout)["rules"]
        self.assertEqual({rule["message"] for rule in rules}, set(BROKEN) | set(ONE_MODEL))
        for rule in rules:
            message, keys = rule["message"], rule["keys"]
            if message in ONE_MODEL:
                continue
            expected = re.escape(message).replace(re.escape("{}"), ".+") if message != "{}" else "temperature of water"
            lines = self.broken_case(BROKEN[message], rule["models"])
            self.assertTrue(any(re.search(rf"^(.*: )?{expected}$" if message != "{}" else expected, line) for line in lines), (message, lines))
            self.assertTrue(keys, message)
        sound = self.ends(DONE, "check", self.write("case.toml", BED)).stderr
        self.assertEqual(sound, "")

    def test_each_entry_that_breaks_a_rule_is_reported(self):
        lines = self.refused(BED, jets(([0.01], [0.07]), ([0.02], [0.08])))
        for ends in ("0.01 to 0.07", "0.02 to 0.08"):
            self.assertTrue(any(f"a jet from {ends} m does not lie on the bottom" in line for line in lines), lines)

    def test_what_one_model_asks_is_noted_of_a_case_for_the_other(self):
        for message, settings in ONE_MODEL.items():
            text, settings = self.with_settings(["effects.contact=hertz_mindlin", *settings])
            words = [word for setting in settings for word in ("--set", setting)]
            told = strict_json(self.ends(DONE, "check", self.write("case.toml", text), "--json", *words).stdout)
            expected = re.escape(message).replace(re.escape("{}"), ".+")
            said = told["notes"] if message != CONTACT else told["refused"]["dem"]
            self.assertTrue(any(re.search(expected + "$", note) for note in said), (message, told))

    def test_all_that_effects_lack_without_a_fluid_is_reported_at_once(self):
        lines = self.refused(BED, DRY, "effects.contact=hertz_mindlin", *(on(role) for role in LAWS))
        for role in LAWS:
            self.assertTrue(any(f"effects.{role} = " in line and "cannot act: fluid.name" in line for line in lines), (role, lines))
        self.notes("dem.held=true", "effects.drag=cello")  # is taken

    def test_a_monitor_that_switches_effects_on_is_refused_with_what_to_do(self):
        self.assertIn("--resume --set effects.ROLE=LAW", self.refused(BED, "chooser.monitor=enable")[0])

    def test_what_effects_need_is_reported_with_all_other_errors(self):
        lines = self.refused(BED.replace('"0.8 mm"', '"0.8 mn"').replace("[1.0]", "[0.9]") + """[dem]
skin = "1 s"
[output]
evry = 1
""", "effects.rolling=cdt", "effects.contact=linear", "effects.granular_temperature=transported", "tfm.rtol=7")
        for what in ("'0.8 mn'", "dem.skin = '1 s'", "unknown key 'evry'", "tfm.rtol = 7", "dem.rolling_friction: effects.rolling",
                     "dem.normal_stiffness: effects.contact", "granular_temperature = \"transported\" cannot be with",
                     "volume_share sums to 0.9"):
            self.assertTrue(any(what in line for line in lines), (what, lines))
        self.assertEqual(len(lines), 9, lines)  # the conflict has a line for each role; nothing follows from the others

    def test_relations_of_sound_keys_are_reported_with_wrong_keys(self):
        lines = self.refused(BED, "bed.volume_share=[0.5]", "tfm.rtol=7", "fluid.temperature=900")
        for what in ("volume_share sums to 0.5", "tfm.rtol = 7", "fluid.temperature: temperature of water"):
            self.assertTrue(any(what in line for line in lines), (what, lines))
        self.assertEqual(len(lines), 3, lines)

    def test_a_wrong_number_of_an_effect_is_reported_once(self):
        self.assertEqual(len(self.refused(BED, "effects.rolling=cdt", "effects.contact=hertz_mindlin", "dem.rolling_friction=-1")), 1)
        self.assertEqual(len(self.refused(BED, "effects.solids_stress=frictionl", "effects.solids_viscosity=schaeffer")), 1)

    def test_a_conflict_of_roles_has_its_lines(self):
        text = BED.replace("[run]", 'magnus = "rubinow_keller"\ncontact = "hertz"\n[run]')
        lines = [re.match(r"/case.toml:(\d+):", line) for line in self.refused(text, command=("dem", "-o", self.folder / "run"))]
        self.assertEqual([int(m.group(1)) for m in lines], [21, 22])

    def test_a_missing_fluid_asks_for_nothing_else(self):
        self.assertEqual(self.refused(without(FLUID, INLET)), ["/case.toml: [fluid] is missing"])
        self.assertEqual([line.split(":")[1] for line in self.refused(without(FLUID))], [" [fluid] is missing"])

    def test_a_fluid_of_given_properties_needs_no_name(self):
        given = BED.replace(FLUID, "[fluid]\ndensity = 1000\nviscosity = 1e-3\n")
        resolved = self.ends(DONE, "check", self.write("case.toml", given), "--resolved").stdout
        self.ends(DONE, "check", self.write("again.toml", resolved))
        for part in ("density = 1000\n", "viscosity = 1e-3\n"):
            lines = self.refused(given.replace(part, ""))
            self.assertEqual(len(lines), 1, lines)
            self.assertIn("fluid.name is missing", lines[0])

    def test_a_column_without_solids_is_run(self):
        for packing in ("auto", "yu_standish"):
            self.ends(DONE, "tfm", self.write("case.toml", BED), "--set", "bed.static_height=0", "--set",
                      f"tfm.max_packing={packing}", "-o", self.folder / packing, "--quiet")


if __name__ == "__main__":
    program.main()
