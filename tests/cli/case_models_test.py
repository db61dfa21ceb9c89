#!/usr/bin/python3
"""Which model can run a case, where what keeps it from one stands, and what is computed and rarely meant. Usage: case_models_test.py PROGRAM"""
import re

import program
from case_rules_test import BED, CaseTest, jets, without
from program import DONE, WRONG_CASE, run, strict_json

# Dry particles, which the two-fluid model cannot run.
HEAP = """[column]
size = ["24 mm", "40 mm"]
depth = "5 mm"
cells = [6, 10]
[fluid]
name = "none"
[[species]]
name = "a"
diameter = "2 mm"
density = 1400
[bed]
particles = [100]
solids_fraction = 0.35
start = "mixed"
[effects]
contact = "hertz_mindlin"
[run]
until = "1 ms"
[dem]
youngs_modulus = "1 MPa"
"""


class Models(CaseTest):
    def test_rules_of_one_model_do_not_refuse_runs_of_the_other(self):
        """Dry particles looser than the two-fluid model's friction begins; a settled start that only contacts can carry. What keeps the
        two-fluid model from them is told with its place, by check and by tfm."""
        heap = self.write("heap.toml", HEAP)
        settled = self.write("settled.toml", HEAP.replace('name = "none"', 'name = "water"\ntemperature = "20 degC"').replace(
            'start = "mixed"', 'start = "settled"').replace("[effects]", '[effects]\nothers = "none"\ndrag = "cello"')
            + '[inlet]\nsuperficial_velocity = "10 mm/s"\n')
        for case, place in ((heap, r"heap\.toml:6:\d+: fluid.name"), (settled, r"settled\.toml:15:\d+: polybed tfm cannot run it: bed.start")):
            told = strict_json(self.ends(DONE, "check", case, "--json").stdout)
            self.assertEqual(told["refused"]["dem"], [])
            self.assertRegex("\n".join(told["refused"]["tfm"]), place)
            self.assertTrue(set(told["refused"]["tfm"]) <= set(told["notes"]))
            self.assertRegex(self.ends(WRONG_CASE, "tfm", case, "-o", self.folder / "tfm").stderr, place)
            self.ends(DONE, "estimate", case)
            self.ends(DONE, "dem", case, "--quiet", "-o", self.folder / f"{case.stem}-dem")

    def test_a_case_that_neither_model_runs_is_refused_for_each(self):
        both = ["effects.contact=hertz_mindlin", "bed.solids_fraction=0.45", "tfm.frictional_onset=0.5", "bed.static_height=0.0003"]
        lines = self.refused(BED, *both)
        self.assertTrue(any("polybed tfm cannot run it: solids_fraction = 0.45" in line for line in lines), lines)
        self.assertTrue(any("polybed dem cannot run it: the particles have no room" in line for line in lines), lines)
        self.assertEqual(len(lines), 2, lines)

    def test_what_shows_late_has_its_place_and_comes_with_the_rest(self):
        """Entries of arrays by their own lines; effects that need a key; the start of the particles."""
        feed = '[[feed]]\nspecies = "fine"\nsuperficial_velocity = "1 mm/s"\nvelocity = "10 mm/s"\n'
        lines = self.refused(BED + feed + feed + feed.replace("fine", "coarse"))
        for place, told in ((28, "two feeds of fine overlap: [[feed]] number 1 and 2"), (32, 'feed.species = "coarse": no such species')):
            self.assertTrue(any(re.match(rf"/case.toml:{place}:\d+: {re.escape(told)}", line) for line in lines), lines)
        classes = BED.replace('diameter = "0.8 mm"', 'distribution = "lognormal"\nmedian = "0.8 mm"\ndeviation = 0.1')
        lines = self.refused(classes + feed + feed)
        self.assertEqual(len(lines), 3, lines)
        self.assertTrue(all(re.match(r"/case.toml:30:\d+: two feeds of fine\.[123] overlap: \[\[feed\]\] number 1 and 2", line) for line in lines), lines)
        particles = BED.replace("[run]", 'contact = "hertz_mindlin"\nrolling = "cdt"\ncohesion = "jkr"\n[run]').replace("[fluid]", 'depth = "1 mm"\n[fluid]')
        dem = ("dem", "-o", self.folder / "run")
        lines = self.refused(particles, command=dem)
        for place, told in ((23, "dem.rolling_friction"), (24, "dem.cohesion_energy")):
            self.assertTrue(any(re.match(rf"/case.toml:{place}:1: polybed dem cannot run it: {told}", line) for line in lines), lines)
        lines = self.refused(particles.replace('rolling = "cdt"\ncohesion = "jkr"\n', ""), "column.gravity=0", command=dem)
        for told in (r"/case.toml:4:\d+: polybed dem cannot run it: column.depth: 0.001 m is periodic",
                     r"--set column.gravity: polybed dem cannot run it: dem.greatest_speed: "):
            self.assertTrue(any(re.match(told, line) for line in lines), (told, lines))

    def test_a_table_that_is_missing_refuses_the_continuum_alone_and_leaves_no_folder(self):
        case = self.write("case.toml", re.sub(r'solids_stress = "\w+"', r'contact = "hertz_mindlin"\nsolids_stress = "table:a\\u001b.h5"', BED))
        place = r"case\.toml:\d+:\d+: polybed tfm cannot run it: effects\.solids_stress: table:a\\u001b\.h5: no such file"
        self.assertRegex("\n".join(strict_json(self.ends(DONE, "check", case, "--json").stdout)["refused"]["tfm"]), r"table:a.*no such file")
        self.assertRegex(self.ends(WRONG_CASE, "tfm", case, "-o", self.folder / "none").stderr, place)
        self.assertFalse((self.folder / "none").exists())
        self.ends(DONE, "dem", case, "--until", "1e-5 s", "--quiet", "--no-picture", "-o", self.folder / "dem")
        self.assertIn('solids_stress = "table:a\\u001B.h5"', strict_json((self.folder / "dem/run.json").read_text())["case"])

    def test_a_bed_denser_than_its_mixture_rule_is_refused_with_its_place(self):
        two = without('[[species]]\nname = "fine"\ndiameter = "0.8 mm"\ndensity = 1395\n').replace("[bed]", "".join(
            f'[[species]]\nname = "{name}"\ndiameter = "{size} mm"\ndensity = 1395\nmax_packing = 0.57\n' for name, size in (("a", 1), ("b", 1.01)))
            + "[bed]").replace("[1.0]", "[0.5, 0.5]").replace("0.6\n", "0.62\n") + '[tfm]\nmax_packing = "fedors_landel"\n'
        # By hand, after Fedors and Landel: x_1 = 1/2 of the large, P_1/a = 0.57/0.8151 above it: 0.57 + (1 - sqrt(1/1.01))*0.43*0.57*0.8151*0.5/0.57
        place = r'/case.toml:30:\d+: polybed tfm cannot run it: tfm.max_packing = "fedors_landel" \(0.5709 here\): the bed at its start, with a solids'
        self.assertRegex(self.refused(two)[0], place)
        layered = two.replace("[inlet]", 'start = "layered"\n[inlet]')
        self.assertRegex(self.refused(layered)[0], place.replace("30", "31").replace("0.5709", "0.57"))
        self.ends(DONE, "check", self.write("case.toml", two), "--set", "bed.start_solids_fraction=0.57")


class Warnings(CaseTest):
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

    def test_grids_and_flows_beyond_the_equations_are_warned_of(self):
        """By check and in the run. A gas of 1.2 kg/m3 carries sound at sqrt(1.4 x 101325/1.2) = 344 m/s, by hand."""
        few = r"the settled bed of 60 mm is {} rows of cells high, {} mm each: heights are off by up to a row"
        fine = r"cells of 0.2 mm are 0.25 of the largest diameters wide"
        dense = r"bed.solids_fraction = 0.7: spheres of these sizes pack at random to 0.64 at most, .* is 9 % higher"
        gas = ["fluid.name=gas", "fluid.density=1.2", "fluid.viscosity=1.8e-5"]
        for told, settings in ((few.format(r"0\.3", "200"), ["column.cells=[1, 1]"]), (few.format(r"0\.9", r"66\.7"), ["column.cells=[1, 3]"]),
                               (few.format("3", "20"), ["column.cells=[6, 10]"]), (fine, ["column.cells=[300, 20]"]),
                               (dense, ["bed.solids_fraction=0.7"]), ("reaches 1 times the speed of sound, 344 m/s", [
                                   *gas, "inlet.superficial_velocity=1", jets(([0.01], [0.02])).replace("=0.1}", "=350}")])):
            self.assertRegex("\n".join(self.notes(*settings)), told)
        for quiet in ([], ["column.cells=[60, 60]"], ["bed.solids_fraction=0.64"], [*gas, "inlet.superficial_velocity=1"]):
            self.assertNotRegex("\n".join(self.notes(*quiet)), "rows of cells|largest diameters wide|pack at random|speed of sound")
        done = run("tfm", self.write("case.toml", BED), "--set", "column.cells=[1, 3]", "--set", "run.until=1e-4", "-o", self.folder / "run")
        self.assertRegex(done.stderr, "warning: column.cells: " + few.format(r"0\.9", r"66\.7"))
        self.assertRegex("\n".join(strict_json((self.folder / "run/run.json").read_text())["warnings"]), few.format(r"0\.9", r"66\.7"))

    def test_notes_on_the_grid_can_be_followed(self):
        """Particles of 0.8 mm. Of a bed of 10 mm a tenth is below 1.5 diameters, which is then the advice; one of 4 mm has no good grid."""
        low, thin = 'bed.static_height="10 mm"', 'bed.static_height="4 mm"'
        self.assertRegex("\n".join(self.notes(low, "column.cells=[6, 20]")), r"the pressure drop by up to 60 %; take rows of 1\.2 mm")
        self.assertNotRegex("\n".join(self.notes(low, "column.cells=[50, 166]")), "column.cells")
        for cells, told in (("[6, 20]", "no grid suits a bed of 5 of the largest diameters: use polybed dem"),
                            ("[6, 400]", "is 5 of the largest diameters high: no grid has both rows of some diameters and 4 rows in the bed")):
            notes = [note for note in self.notes(thin, f"column.cells={cells}") if "column.cells" in note]
            self.assertRegex("\n".join(notes), told)
            self.assertEqual(len(notes), 1, notes)

    def test_a_bed_that_hangs_is_warned_of(self):
        """Beads of 700 kg/m3 in water that flows down: what would spread it evenly is named, and then nothing is left to say."""
        told = "\n".join(self.notes("species.fine.density=700", "inlet.superficial_velocity=-0.01"))
        self.assertRegex(told, "leaves at the bottom and enters at the top, and the bed hangs from the top")
        self.assertRegex(told, 'a channel forms .*: use inlet.at = "top"')
        self.assertNotIn("channel", "\n".join(self.notes("species.fine.density=700", "inlet.superficial_velocity=-0.01", "inlet.at=top")))
        self.assertNotIn("pressed down", told)
        def card_of(until):
            done = self.ends(DONE, "tfm", self.write("case.toml", BED), *(word for setting in (
                "species.fine.density=700", "inlet.superficial_velocity=-0.01", "column.cells=[1, 20]", f"run.until={until}") for word in
                ("--set", setting)), "-o", self.folder / "hangs", "--force", "--no-picture")
            return strict_json((self.folder / "hangs/run.json").read_text())["card"], done.stderr
        # At first the stream presses the bed onto the bottom; beads rise from its surface one by one.
        card, told = card_of(1)
        self.assertEqual(card["state"], "packed")
        self.assertNotIn("hanging", told)
        card, told = card_of(40)
        self.assertEqual(card["state"], "fluidised")
        self.assertIsNone(card["bed_height_m"])
        self.assertRegex(told, "bed +fluidised, hanging from the top, pressure drop")

    def test_a_checkpoint_that_is_not_there_is_warned_of(self):
        self.assertRegex("\n".join(self.notes("bed.start=checkpoint:none.h5")), 'bed.start = "checkpoint:none.h5": no such file yet')

    def test_what_is_rarely_meant_is_warned_of(self):
        self.assertEqual([n for n in self.notes() if "negative" in n or "floats" in n], [])
        self.assertRegex("\n".join(self.notes("inlet.superficial_velocity=-0.01")),
                         "inlet.superficial_velocity = -0.01 m/s is negative: fluid leaves at the bottom")
        floats = 'species "fine" (900 kg/m3) is lighter than the fluid'
        self.assertIn(floats, "\n".join(self.notes("species.fine.density=900")))
        self.assertNotIn(floats, "\n".join(self.notes("species.fine.density=900", "inlet.superficial_velocity=0")))
        overflow = 'discharge=[{{at="right", from=[0.1], to=[0.12], pressure={}}}]'  # 1395 kg/m3 over 0.2 m weigh 2737 Pa
        self.assertRegex("\n".join(self.notes(overflow.format(1e5))),
                         r"discharge.pressure = 100000 Pa of \[\[discharge\]\] number 1 exceeds 2.74e\+03 Pa, .* in with up to 14.1 m/s")
        self.assertNotIn("exceeds", "\n".join(self.notes(overflow.format(2700))))
        done = run("tfm", self.write("case.toml", BED), "--set", "species.fine.density=900", "--set", "run.until=1e-4", "-o",
                   self.folder / "run")
        self.assertIn("warning: " + floats, done.stderr)
        record = strict_json((self.folder / "run/run.json").read_text())
        self.assertIn(floats, "\n".join(record["warnings"]))


if __name__ == "__main__":
    program.main()
