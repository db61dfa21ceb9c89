#!/usr/bin/python3
"""A case for the particle model, as its user meets it. Usage: particle_case_test.py PROGRAM"""
import program
from program import CASE, DONE, WRONG_CASE, TWO_SIZES, Scratch, strict_json

DRY = """[column]
size = [0.06, 0.6]
cells = [12, 120]
gravity_direction = [1, -2]
[fluid]
name = "none"
""" + TWO_SIZES + """[bed]
start = "list:beads.csv"
[run]
until = 1
[effects]
others = "none"
contact = "hertz_mindlin"
"""


class ParticleCase(Scratch):
    def setUp(self):
        super().setUp()
        self.write("beads.csv", "species,x,y,z\nfine,0.01,0.02,0.001\n")

    def test_is_checked_without_being_built(self):
        case = self.write("case.toml", DRY)
        text, details = (self.ends(DONE, "check", case, word).stdout for word in ("--resolved", "--details"))
        self.assertIn(f'start = "list:{case.parent / "beads.csv"}"', text)
        for key in ("fluid.name", "column.gravity_direction", "bed.start"):
            self.assertRegex(details, f"{key}.* polybed tfm cannot")
        answer = strict_json(self.ends(DONE, "check", case, "--json").stdout)
        self.assertEqual(len(answer["notes"]), 3)

    def test_is_refused_by_the_two_fluid_model(self):
        case = self.write("case.toml", DRY)
        done = self.ends(WRONG_CASE, "tfm", case, "-o", self.folder / "run")
        for key in ("fluid.name", "column.gravity_direction", "bed.start"):
            self.assertRegex(done.stderr, f"{key}.* polybed tfm cannot")
        self.ends(WRONG_CASE, "inversion", case)

    def test_every_key_is_refused_alone(self):
        for given in ("fluid.name=none", "column.ends=periodic", "column.gravity_direction=[1,0]", "bed.start=random",
                      "dem.shear_rate=1"):
            done = self.ends(WRONG_CASE, "tfm", CASE, "--set", given, "-o", self.folder / "run")
            self.assertIn(given.split("=")[0], done.stderr)

    def test_a_list_that_is_not_there(self):
        case = self.write("case.toml", DRY.replace("beads", "beds"))
        self.assertIn("bed.start", self.ends(WRONG_CASE, "check", case).stderr)


if __name__ == "__main__":
    program.main()
