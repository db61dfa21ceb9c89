#!/usr/bin/python3
"""What a case must say, and must not: everything at once, with its reason. Usage: case_rules_test.py PROGRAM"""
import re

import program
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
drag = "cello"
solids_stress = "frictional"
[run]
until = "10 ms"
"""
FLUID = '[fluid]\nname = "water"\ntemperature = "15 degC"\n'
INLET = '[inlet]\nsuperficial_velocity = "10 mm/s"\n'


LAWS = {"drag": "cello", "fluid_stress": "newtonian", "gas_slip": "cunningham", "added_mass": "zuber", "lift": "saffman_mei",
        "magnus": "rubinow_keller", "history": "basset", "brownian": "langevin", "lubrication": "film"}
DRY = "fluid.name=none"


def on(role, law=None):
    return f"effects.{role}={law or LAWS[role]}"


# For each rule that the program lists what breaks it, in words of --set. {} stands for a word of the scene.
BROKEN = {
    **{f'effects.{role} = "{{}}" cannot act: fluid.name = "none"': [DRY, on(role)] for role in LAWS},
    **{f"effects.{role} cannot act in a sheared box: its fluid moves with its flow": ["dem.shear_rate=1", on(role)]
       for role in ("fluid_stress", "added_mass", "lift", "magnus", "history")},
    "effects.gas_slip: a fluid of {} kg/m3 is a liquid, which does not slip: leave it out": [on("gas_slip")],
    'effects.partition = "{}" cannot act: fluid.name = "none"': [DRY, on("partition", "cello")],
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
    'effects.cohesion = "{}" cannot be with effects.contact = "linear": '
    "it stands in place of Hertz' force, which linear springs have not": ["effects.cohesion=jkr", "effects.contact=linear"],
    'effects.contact = "linear" cannot be with effects.cohesion = "{}"': ["effects.cohesion=jkr", "effects.contact=linear"],
    "dem.held = true without drag: nothing resists the flow through the bed; name a law in effects.drag": [
        "dem.held=true", "effects.drag=none"],
    'tfm.solids_wall = "johnson_jackson" acts through a viscosity of the solids: effects.solids_viscosity, or '
    'effects.solids_stress = "kinetic"': ["tfm.solids_wall=johnson_jackson"],
    'tfm.max_packing = "fedors_landel" is for two species; yu_standish is for any number': ["tfm.max_packing=fedors_landel"],
    "tfm.max_packing = {} must lie above tfm.frictional_onset = {}": ["tfm.max_packing=0.4"],
    'bed.solids_fraction = {} must lie above tfm.frictional_onset = {} for tfm.max_packing = "auto"': ["bed.solids_fraction=0.45"],
    "tfm.max_packing = {}: the bed at its start, with a solids fraction of {}, lies more than {} above; lower bed.start_solids_fraction": [
        "bed.solids_fraction=0.68", "tfm.max_packing=0.64"],
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


class Rules(Scratch):
    def refused(self, text, *settings):
        """The lines of what is wrong, without the name of the file."""
        words = [word for setting in settings for word in ("--set", setting)]
        told = self.ends(WRONG_CASE, "check", self.write("case.toml", text), *words).stderr
        return [line.replace(str(self.folder), "") for line in told.splitlines()]

    def notes(self, *settings):
        words = [word for setting in settings for word in ("--set", setting)]
        return strict_json(self.ends(DONE, "check", self.write("case.toml", BED), "--json", *words).stdout)["notes"]

    def broken_case(self, settings):
        """The bed with these settings, "!" taking a key away, and each line of what is wrong with it."""
        text = BED
        for key in (setting.split("=")[0].split(".")[1] for setting in settings if setting.endswith("=!")):
            text = re.sub(rf"(?m)^{key} = .*\n", "", text)
        return self.refused(text, *(setting for setting in settings if not setting.endswith("=!")))

    def test_every_rule_is_broken_by_a_case_of_its_own(self):
        rules = strict_json(self.ends(DONE, "list", "--json").stdout)["rules"]
        self.assertEqual({rule["message"] for rule in rules}, set(BROKEN))
        for rule in rules:
            message, keys = rule["message"], rule["keys"]
            expected = re.escape(message).replace(re.escape("{}"), ".+") if message != "{}" else "temperature of water"
            lines = self.broken_case(BROKEN[message])
            self.assertTrue(any(re.search(rf"^(.*: )?{expected}$" if message != "{}" else expected, line) for line in lines), (message, lines))
            self.assertTrue(keys, message)
        sound = self.ends(DONE, "check", self.write("case.toml", BED)).stderr
        self.assertEqual(sound, "")

    def test_all_that_effects_lack_without_a_fluid_is_reported_at_once(self):
        lines = self.refused(BED, DRY, *(on(role) for role in LAWS))
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
        lines = [re.match(r"/case.toml:(\d+):", line) for line in self.refused(text)]
        self.assertEqual([int(m.group(1)) for m in lines], [20, 21])

    def test_a_missing_fluid_asks_for_nothing_else(self):
        self.assertEqual(self.refused(without(FLUID, INLET)), ["/case.toml: [fluid] is missing"])
        self.assertEqual([line.split(":")[1] for line in self.refused(without(FLUID))], [" [fluid] is missing"])

    def test_a_fluid_of_given_properties_needs_no_name(self):
        given = BED.replace(FLUID, "[fluid]\ndensity = 1000\nviscosity = 1e-3\n")
        resolved = self.ends(DONE, "check", self.write("case.toml", given)).stdout
        again = "".join(line + "\n" for line in resolved.splitlines() if not line.startswith("#"))
        self.ends(DONE, "check", self.write("again.toml", again))
        for part in ("density = 1000\n", "viscosity = 1e-3\n"):
            lines = self.refused(given.replace(part, ""))
            self.assertEqual(len(lines), 1, lines)
            self.assertIn("fluid.name is missing", lines[0])

    def test_a_column_without_solids_is_run(self):
        for packing in ("auto", "yu_standish"):
            self.ends(DONE, "tfm", self.write("case.toml", BED), "--set", "bed.static_height=0", "--set",
                      f"tfm.max_packing={packing}", "-o", self.folder / packing, "--quiet")

    def test_a_particle_wider_than_the_column(self):
        for size, side in (('["0.7 mm", "200 mm"]', "width"), ('["60 mm", "0.7 mm", "200 mm"]', "depth"), ('["60 mm", "0.7 mm"]', "height")):
            cells = "[6, 4, 20]" if side == "depth" else "[6, 20]"
            lines = self.refused(BED, f"column.size={size}", f"column.cells={cells}")
            self.assertTrue(any(f"0.0008 m is more than the {side} of the column" in line for line in lines), lines)
        self.assertIn("depth of the column", self.refused(BED, 'column.depth="0.7 mm"')[0])

    def test_a_bed_denser_than_spheres_pack(self):
        self.assertIn("spheres of these sizes fill at most 0.74 of the volume", self.refused(BED, "bed.solids_fraction=0.85")[0])
        self.assertIn("the bed at its start, with a solids fraction of 0.68, lies more than",
                      self.refused(BED, "bed.solids_fraction=0.68", "tfm.max_packing=0.64")[0])
        self.notes("bed.solids_fraction=0.7")  # a mixture that was measured so dense is taken
        # 0.974 of 60 x 200 x 1.76 mm: 2.057e-5 m3 of spheres of 2.681e-10 m3
        random = BED.replace('volume_share = [1.0]\nstatic_height = "60 mm"\n', 'particles = [76730]\nstart = "random"\n')
        self.assertRegex("\n".join(self.refused(random)), "fill 0.974 of the column, spheres of these sizes fill at most 0.74")

    def test_what_is_rarely_meant_is_warned_of(self):
        self.assertEqual([n for n in self.notes() if "negative" in n or "floats" in n], [])
        self.assertRegex("\n".join(self.notes("inlet.superficial_velocity=-0.01")),
                         "inlet.superficial_velocity = -0.01 m/s is negative: fluid leaves at the bottom")
        floats = 'species "fine" (900 kg/m3) is lighter than the fluid'
        self.assertIn(floats, "\n".join(self.notes("species.fine.density=900")))
        self.assertNotIn(floats, "\n".join(self.notes("species.fine.density=900", "inlet.superficial_velocity=0")))
        done = run("tfm", self.write("case.toml", BED), "--set", "species.fine.density=900", "--set", "run.until=1e-4", "-o",
                   self.folder / "run")
        self.assertIn("warning: " + floats, done.stderr)
        record = strict_json((self.folder / "run/run.json").read_text())
        self.assertIn(floats, "\n".join(record["warnings"]))


if __name__ == "__main__":
    program.main()
