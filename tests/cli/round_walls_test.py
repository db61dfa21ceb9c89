#!/usr/bin/python3
"""A round silo with a cone inside: it fills, empties, and keeps its beads within. Usage: round_walls_test.py PROGRAM"""
import re

import h5py
import numpy as np

import program
from program import DONE, FILE, WRONG_CASE, Scratch, history, strict_json

BED = """title = "a round hopper"
[column]
shape = "cylinder"
size = ["24 mm", "24 mm", "50 mm"]
cells = [6, 6, 25]
[fluid]
name = "none"
[[species]]
name = "beads"
diameter = "1.5 mm"
density = 2500
[bed]
particles = [400]
solids_fraction = 0.6
start = "mixed"
start_solids_fraction = 0.4
[[wall]]
shape = "cone"
from = ["9 mm", "0 mm"]
to = ["24 mm", "13 mm"]
[effects]
contact = "hertz_mindlin"
others = "none"
[dem]
opening = "9 mm"
friction = 0.2
restitution = 0.7
[run]
until = "0.6 s"
[output]
every = "20 ms"
history_every = "5 ms"
"""
RADIUS = 0.75e-3  # m


class RoundHopper(Scratch):
    def run_of(self, name, *words, text=BED):
        directory = self.folder / name
        return strict_json(self.ends(DONE, "dem", self.write(f"{name}.toml", text), "--quiet", "--json", "-o", directory, *words).stdout), directory

    def test_it_empties_and_keeps_its_beads_within(self):
        record, directory = self.run_of("hopper")
        self.assertEqual(record["particles"], 0)
        self.assertEqual(record["outflow"]["beads"]["particles"], 400)
        self.assertLess(record["energy"]["worst_error"], record["energy"]["limit"])
        seen = 0
        with h5py.File(directory / "particles.h5") as file:
            for step in file["step"].values():
                x, y, z = step["position"][()].reshape(-1, 3).T
                away = np.hypot(x - 0.012, z - 0.012)
                # the profile of the cone rises by 13 mm in 7.5 mm; centres lie a radius inside, less an overlap of 5 %
                cone = (13 * (0.0045 - away) + 7.5 * y) / np.hypot(13, 7.5)
                held = y > RADIUS
                seen += np.count_nonzero(held)
                self.assertGreater(np.min(cone[held], initial=1), 0.9 * RADIUS)
                self.assertLess(np.max(away[held], initial=0), 0.012 - 0.9 * RADIUS)
        self.assertGreater(seen, 400)

    def test_heights_are_those_over_the_circle(self):
        """With the hole shut and no cone: 400 beads of 1.77 mm3 over the circle of 452 mm2."""
        text = BED[:BED.index("[[wall]]")] + BED[BED.index("[effects]"):].replace('opening = "9 mm"\n', "")
        _, directory = self.run_of("silo", "--until", "0.2 s", text=text)
        with h5py.File(directory / "profiles.h5") as file:
            slabs = 1 - file["voidage"][-1]
        self.assertAlmostEqual(np.sum(slabs) * 0.05 / 25, 400 * np.pi / 6 * 1.5e-3**3 / (np.pi / 4 * 0.024**2), delta=1e-9)
        self.assertLess(history(directory)["bed_height_m"][-1], 5e-3)

    def tube_with(self, name, *ports, opening=""):
        """{port: kg of beads that left by it}, of a tube without a cone, by rectangles (at, from, to) in its wall."""
        text = BED[:BED.index("[[wall]]")] + "".join(
            f'[[discharge]]\nat = "{at}"\nfrom = {low}\nto = {high}\nsuperficial_velocity = "10 mm/s"\n' for at, low, high in ports
        ) + BED[BED.index("[effects]"):].replace('opening = "9 mm"\n', opening)
        _, directory = self.run_of(name, "--until", "0.2 s", text=text)
        rows = history(directory)
        return {key[:-9]: rows[key][-1] for key in rows if key.startswith(("discharge", "top")) and key.endswith("_beads_kg")}

    def test_holes_on_opposite_sides_are_two(self):
        """Each takes its beads, and rectangles that share an edge in the drawing of the sides are not one hole."""
        low, high = [0.008, 0.001], [0.016, 0.011]
        facing = self.tube_with("facing", ("left", low, high), ("right", low, high))
        self.assertGreater(min(facing.values()), 0.3 * sum(facing.values()), facing)
        above = self.tube_with("above", ("left", [0.008, 0.011], [0.016, 0.02]), ("right", low, high))
        self.assertGreater(above["discharge2"], 0.5 * facing["discharge2"], (above, facing))

    def test_what_falls_through_the_bottom_left_by_no_port(self):
        ports = [(at, [0.008, 0.03], [0.016, 0.04]) for at in ("left", "right")]
        self.assertEqual(set(self.tube_with("bottom", *ports, opening='opening = "9 mm"\n').values()), {0.0})

    def test_a_feed_enters_within_the_circle(self):
        feed = '[[feed]]\nspecies = "beads"\nat = "top"\nsuperficial_velocity = "20 mm/s"\nvelocity = "0.3 m/s"\n'
        record, _ = self.run_of("fed", "--until", "0.2 s", text=BED.replace("[effects]", feed + "[effects]"))
        # 20 mm/s through 452 mm2 for 0.2 s, of 1.77 mm3 each; some of the last 0.25 ms, 1.3 beads, enter together later
        self.assertAlmostEqual(record["feed"]["beads"]["particles"], 1023, delta=2)
        self.assertEqual(record["feed"]["beads"]["waiting"], 0)

    def test_a_list_beside_the_circle_is_refused_with_its_line(self):
        text = BED.replace('particles = [400]\nsolids_fraction = 0.6\nstart = "mixed"\nstart_solids_fraction = 0.4', 'start = "list:two.csv"')
        self.write("two.csv", "species,x,y,z\nbeads,0.012,0.03,0.012\nbeads,0.002,0.03,0.002\n")
        told = self.ends(WRONG_CASE, "dem", self.write("list.toml", text), "-o", self.folder / "list").stderr
        self.assertIn("two.csv:3", told)
        self.assertIn("the centre lies outside the round column", told)

    def test_a_checkpoint_of_a_box_with_particles_beside_the_circle_is_refused(self):
        text = re.sub(r"\[\[wall\]\].*?(?=\[effects\])", "", BED, flags=re.DOTALL).replace('opening = "9 mm"\n', "")
        text = text.replace('particles = [400]\nsolids_fraction = 0.6\nstart = "mixed"\nstart_solids_fraction = 0.4', 'start = "list:two.csv"')
        self.write("two.csv", "species,x,y,z\nbeads,0.012,0.03,0.012\nbeads,0.002,0.03,0.002\n")
        box = self.write("box.toml", text.replace('shape = "cylinder"\n', ""))
        self.ends(DONE, "dem", box, "--until", "1 ms", "--quiet", "--no-picture", "-o", self.folder / "box")
        text = text.replace("list:two.csv", f"checkpoint:{self.folder}/box/checkpoint.h5")
        told = self.ends(FILE, "dem", self.write("round.toml", text), "--quiet", "-o", self.folder / "round").stderr
        self.assertIn("particle 1 lies outside the round column", told)

    def test_walls_without_thickness_are_for_dry_runs(self):
        wet = BED.replace('name = "none"', 'name = "water"\ntemperature = "20 degC"')
        for model in ("dem", "tfm"):
            told = self.ends(WRONG_CASE, model, self.write("wet.toml", wet), "-o", self.folder / "wet").stderr
        self.assertIn("[[wall]] number 1 is 0 m thick, in the fluid it needs", told)

    def test_the_resolved_case_keeps_its_shapes(self):
        resolved = strict_json(self.ends(DONE, "check", self.write("a.toml", BED), "--json").stdout)["case"]
        self.assertIn('shape = "cylinder"', resolved)
        self.assertIn('shape = "cone"', resolved)


if __name__ == "__main__":
    program.main()
