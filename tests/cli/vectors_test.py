#!/usr/bin/python3
"""Both models have the same bits at every width of vectors that this processor has."""
import json
import os
import subprocess
import tempfile
import unittest

import program
from program import DONE, WRONG_CASE, Scratch

WIDTHS = ("sse2", "avx2", "avx512")
CROWD = """[column]
size = [0.01, 0.01, 0.01]
cells = [4, 4, 4]
[fluid]
name = "none"
[[species]]
name = "fine"
diameter = "0.8 mm"
density = 2500
[[species]]
name = "coarse"
diameter = "1 mm"
density = 2500
[bed]
particles = [200, 300]
start = "random"
solids_fraction = 0.55
[effects]
others = "none"
contact = "hertz_mindlin"
rolling = "epsd"
[dem]
start_speed = "0.3 m/s"
greatest_speed = "2 m/s"
youngs_modulus = 5e7
rolling_friction = 0.1
[run]
until = "1 ms"
[output]
every = "1 ms"
history_every = "0.1 ms"
checkpoint_every = "1 ms"
"""


def forced(width, *words):
    with tempfile.TemporaryDirectory() as scratch:
        return subprocess.run(program.command(words), env=program.environment(scratch) | {"POLYBED_VECTORS": width},
                              capture_output=True, encoding="utf-8", timeout=program.LONGEST)


class Vectors(Scratch):
    def runs(self, model, case):
        """The run directory of each width at hand."""
        path, found, skipped = self.write(f"{model}.toml", case), {}, []
        for width in WIDTHS:
            folder = self.folder / f"{model}-{width}"
            done = forced(width, model, path, "--quiet", "-o", folder)
            if done.returncode == WRONG_CASE and "this processor has" in done.stderr:
                skipped.append(width)
                continue
            self.assertEqual(done.returncode, DONE, done.stderr)
            self.assertEqual(json.loads((folder / "run.json").read_text())["machine"]["vectors"], width)
            found[width] = folder
        if skipped:
            print(f"skipped, as this processor does not have them: {', '.join(skipped)}")
        self.assertIn("sse2", found)
        return found

    def same(self, found):
        first = found["sse2"]
        for width, folder in found.items():
            self.assertEqual(program.same_bits(first / "checkpoint.h5", folder / "checkpoint.h5"), [], width)
            self.assertEqual((first / "history.csv").read_text(), (folder / "history.csv").read_text(), width)

    def test_particles(self):
        found = self.runs("dem", CROWD)
        contacts = {json.loads((f / "run.json").read_text())["work"]["contact_steps"] for f in found.values()}
        self.assertGreater(min(contacts), 1000)  # so that the loops had something to do
        self.same(found)

    def test_continuum(self):
        self.same(self.runs("tfm", program.small_bed("0.1 s")))

    def test_collisions_of_the_continuum(self):
        case = program.small_bed("0.05 s")
        for old, new in (('"frictional"', '"kinetic"\ngranular_temperature = "transported"\nspecies_exchange = "syamlal"\n'
                          'fluid_stress = "newtonian"'), ("[run]", '[tfm]\nmomentum = "conservative_limited"\n[run]')):
            self.assertIn(old, case)
            case = case.replace(old, new)
        self.same(self.runs("tfm", case))

    def test_unknown_width(self):
        done = forced("mmx", "list")
        self.assertEqual(done.returncode, WRONG_CASE)
        self.assertRegex(done.stderr, "POLYBED_VECTORS is 'mmx': this processor has sse2")


if __name__ == "__main__":
    program.main()
