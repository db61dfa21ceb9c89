#!/usr/bin/python3
"""A case for the particle model, as its user meets it. Usage: particle_case_test.py PROGRAM"""
import h5py
import numpy as np

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
        for given in ("fluid.name=none", "column.gravity_direction=[1,0]", "bed.start=random",
                      "dem.shear_rate=1"):
            done = self.ends(WRONG_CASE, "tfm", CASE, "--set", given, "-o", self.folder / "run")
            self.assertIn(given.split("=")[0], done.stderr)

    def test_a_list_that_is_not_there(self):
        case = self.write("case.toml", DRY.replace("beads", "beds"))
        self.assertIn("bed.start", self.ends(WRONG_CASE, "check", case).stderr)

    def test_a_checkpoint_in_place_of_the_list_has_the_bed(self):
        """Nothing of what the list made needless is asked for; the two-fluid model needs it and says whose start it is."""
        self.write("beads.csv", "species,x,y,z\nfine,0.01,0.02,0.001\ncoarse,0.02,0.02,0.001\nfine,0.03,0.02,0.001\n")
        case, first, second = self.write("case.toml", DRY), self.folder / "first", self.folder / "second"
        words = ["--quiet", "--no-picture", "--set", "dem.fixed_step=1e-5", "-o"]
        start = ["--set", f"bed.start=checkpoint:{first / 'checkpoint.h5'}"]
        missing = self.ends(WRONG_CASE, "check", case, *start).stderr
        self.assertIn("bed.volume_share is missing (or give bed.particles, or [[layer]]); the checkpoint that the bed starts from", missing)
        self.ends(DONE, "dem", case, *words, first, "--until", "1 ms")
        self.assertIn("particles = [2, 1]", self.ends(DONE, "check", case, *start, "--resolved").stdout)
        for more in (["--until", "1 ms"], ["--until", "2 ms", "--resume"]):
            self.ends(DONE, "dem", case, *words, second, *start, *more)
        with h5py.File(second / "particles.h5") as file:
            np.testing.assert_array_equal(file["step/000001/species"], [0, 1, 0])
        told = self.ends(WRONG_CASE, "tfm", case, *start, "-o", self.folder / "run").stderr
        self.assertRegex(told, 'bed.start = "checkpoint:.* polybed tfm cannot')


if __name__ == "__main__":
    program.main()
