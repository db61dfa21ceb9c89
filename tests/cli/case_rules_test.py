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
        self.assertRegex(self.refused(random)[0], "fill 0.974 of the column, spheres of these sizes fill at most 0.74")

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
