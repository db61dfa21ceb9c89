#!/usr/bin/python3
"""A hopper with inclined sides: it empties, where a flat bottom keeps a heap on either side. Usage: inner_walls_test.py PROGRAM"""
import re
from pathlib import Path

import h5py
import numpy as np

import program
from program import DONE, WRONG_CASE, Scratch, strict_json

BED = """title = "a hopper"
[column]
size = ["30 mm", "60 mm"]
cells = [6, 12]
[fluid]
name = "none"
[[species]]
name = "beads"
diameter = "1.5 mm"
density = 2500
[bed]
particles = [300]
solids_fraction = 0.6
start = "mixed"
[effects]
contact = "hertz_mindlin"
others = "none"
[dem]
opening = "9 mm"
friction = 0.2
restitution = 0.7
[run]
until = "0.5 s"
[output]
every = "50 ms"
history_every = "5 ms"
"""
# Sides of 60 degrees to the rim of the opening; friction 0.2 holds nothing beyond 11 degrees.
SIDES = """[[wall]]
from = ["0 mm", "18.2 mm"]
to = ["10.5 mm", "0 mm"]
[[wall]]
from = ["30 mm", "18.2 mm"]
to = ["19.5 mm", "0 mm"]
"""


class Hopper(Scratch):
    def run_of(self, name, text, *words):
        case = self.write(f"{name}.toml", text)
        directory = self.folder / name
        return strict_json(self.ends(DONE, "dem", case, "--quiet", "--json", "-o", directory, *words).stdout), directory

    def test_inclined_sides_empty_it(self):
        flat, _ = self.run_of("flat", BED)
        steep, directory = self.run_of("steep", BED + SIDES)
        self.assertGreater(flat["particles"], 15)  # what rests beside the opening
        self.assertEqual(steep["particles"], 0)
        self.assertEqual(steep["outflow"]["beads"]["particles"], 300)
        for record in (flat, steep):
            self.assertLess(record["energy"]["worst_error"], record["energy"]["limit"])
        # on the way no centre passes a side: all are at least their radius, less the greatest overlap of 5 %, above it
        with h5py.File(directory / "particles.h5") as file:
            seen = 0
            for step in file["step"].values():
                x, y, _ = step["position"][()].reshape(-1, 3).T
                x = np.minimum(x, 0.03 - x)  # both sides as the left one, whose plane is 18.2 x + 10.5 y = 10.5 18.2 mm2
                distance = (18.2 * x + 10.5 * y - 10.5 * 18.2e-3) / np.hypot(18.2, 10.5)
                held = y > 0.75e-3
                seen += np.count_nonzero(held)
                self.assertGreater(np.min(distance[held], initial=1), 0.675e-3)
        self.assertGreater(seen, 300)

    def test_walls_that_continue_each_other_push_once(self):
        whole = '[[wall]]\nfrom = ["2 mm", "10 mm"]\nto = ["28 mm", "10 mm"]\n'
        halves = '[[wall]]\nfrom = ["2 mm", "10 mm"]\nto = ["15 mm", "10 mm"]\n[[wall]]\nfrom = ["28 mm", "10 mm"]\nto = ["15 mm", "10 mm"]\n'
        self.write("one.csv", "x,y,z,species\n0.015,0.012,0.001,beads\n")
        bed = BED.replace("particles = [300]\nsolids_fraction = 0.6\nstart = \"mixed\"", 'start = "list:one.csv"')
        places = []
        for name, walls in (("whole", whole), ("halves", halves)):
            _, directory = self.run_of(name, bed + walls, "--until", "0.1 s")
            with h5py.File(directory / "particles.h5") as file:
                places.append([step["position"][()] for step in file["step"].values()])
        self.assertGreater(np.min(places[0][-1].reshape(-1, 3)[:, 1]), 0.0105)  # it lies on the wall
        self.assertTrue(np.array_equal(*places))

    def test_a_wall_without_thickness_needs_a_dry_column(self):
        wet = BED.replace('name = "none"', 'name = "water"\ntemperature = "20 degC"') + SIDES
        told = self.ends(WRONG_CASE, "dem", self.write("wet.toml", wet), "-o", self.folder / "wet").stderr
        self.assertIn("[[wall]] number 1 is 0 m thick, in the fluid it needs 0.00683 m or more", told)

    def test_the_expected_bed_stands_between_them(self):
        """A rod of 7.5 mm within a settled bed of 40 mm lifts its top by the rod's area over the width. The mass is that of the cross-section, so the
        pressure drop exceeds the weight by as much as the height of a bed that hardly expands."""
        bank = Path(__file__).resolve().parents[2] / "cases/tube-bank/case.toml"
        rod = 'wall=[{from=[0.0125, 0.02], shape="rod", thickness=0.0075}]'
        told = self.ends(DONE, "check", bank, "--set", rod)
        expected = strict_json(self.ends(DONE, "check", bank, "--json", "--set", rod).stdout)["expected"]
        self.assertIn("(settled 41 mm, 40 mm without the walls inside, column", told.stdout)
        lifted = np.pi / 4 * 0.0075**2 / 0.05
        self.assertAlmostEqual(expected["settled_height_m"], 0.04 + lifted, delta=2e-3 * lifted)  # the curvature within parts of cells
        self.assertGreater(expected["bed_height_m"], expected["settled_height_m"])
        weight, drop = (float(found) for found in re.search(r"weight +([\d.]+) Pa .* between the walls ([\d.]+) Pa", told.stdout).groups())
        self.assertGreater(drop / weight, 1)
        self.assertLess(drop / weight, 1 + 2 * lifted / 0.04)

    def test_a_hollow_is_refused(self):
        bank = Path(__file__).resolve().parents[2] / "cases/tube-bank/case.toml"
        sides = ([0.01, 0.01], [0.04, 0.01], [0.04, 0.04], [0.01, 0.04], [0.01, 0.01])
        walls = "wall=[" + ", ".join(f"{{from={a}, to={b}, thickness=0.004}}" for a, b in zip(sides, sides[1:])) + "]"
        for command in ("check", "tfm", "dem"):
            words = [] if command == "check" else ["-o", self.folder / command]
            self.assertRegex(self.ends(WRONG_CASE, command, bank, "--set", walls, *words).stderr, r"(?m)^.*case\.toml: .*encloses a hollow")

    def test_the_resolved_case_keeps_them(self):
        resolved = strict_json(self.ends(DONE, "check", self.write("a.toml", BED + SIDES), "--json").stdout)["case"]
        self.assertEqual(resolved.count("[[wall]]"), 2)


if __name__ == "__main__":
    program.main()
