#!/usr/bin/python3
"""Runs that break a conservation law end with code 3, in both models, unless they are permissive. A law is broken here in the
state that a run goes on from: mass or particles are gone from its checkpoint. Usage: conservation_test.py PROGRAM"""
import h5py

import program
from program import CASE, DONE, NUMBERS, SMALL, Scratch, falling, history, strict_json

# 100 spheres fall; a step takes some 20 microseconds.
FALL = falling('size = ["8 mm", "30 mm"]\ncells = [4, 20]', [80, 20], 0.3, "1 ms")

# Spheres in a thin gas, whose pressure and so density falls by 1 % through them.
GAS = """[column]
size = ["6 mm", "20 mm"]
cells = [2, 8]
sides = "periodic"
[fluid]
name = "air"
temperature = "20 degC"
equation_of_state = "ideal_gas"
outlet_pressure = "8 kPa"
[[species]]
name = "glass"
diameter = "0.5 mm"
density = 2500
[bed]
particles = [400]
solids_fraction = 0.6
start = "mixed"
start_solids_fraction = 0.4
[inlet]
superficial_velocity = "0.5 m/s"
[effects]
others = "none"
drag = "gidaspow"
contact = "hertz_mindlin"
[dem]
youngs_modulus = "1 MPa"
[run]
until = "40 ms"
[output]
every = "20 ms"
history_every = "1 ms"
checkpoint_every = "20 ms"
"""


def change(path, work):
    """Works on a checkpoint and seals it again, so that it counts as whole."""
    program.unseal(path)
    with h5py.File(path, "r+") as file:
        work(file)
    program.seal(path)


class Broken(Scratch):
    def stops(self, model, case, words, law, directory):
        """A run that goes on from a broken state ends at its next row of the history, again when it goes on; a permissive one
        comes to its end. What it has said and its record."""
        begin = strict_json((directory / "run.json").read_text())["time_s"]
        for _ in range(2):
            told = self.ends(NUMBERS, model, case, *words, "-o", directory, "--resume").stderr
            record = strict_json((directory / "run.json").read_text())
            self.assertRegex(record["state"], f"^failed: t = .* s: a conservation law is broken: {law}")
            self.assertIn("--resume --permissive", told)
            self.assertIn(record["state"].removeprefix("failed: "), told)
            [broken] = [i for i in record["invariants"] if i["judged"] and i["worst"] > 10 * i["limit"]]
            self.assertFalse(broken["held"])
            with h5py.File(directory / "checkpoint.h5") as file:
                times = [value[()] for name, value in file["numbers"].items() if name in ("time", "time_s")]
                self.assertEqual(times, [record["time_s"]])
            self.assertGreater(record["time_s"], begin)
            self.assertLess(record["time_s"] - begin, 2 * self.every)  # a row, and the step that passed it
            self.assertLess(record["time_s"] - history(directory)["time_s"][-1], self.every)
            begin = record["time_s"]
        self.ends(DONE, model, case, *words, "-o", directory, "--resume", "--permissive")
        record = strict_json((directory / "run.json").read_text())
        self.assertEqual(record["state"], "done")
        self.assertTrue(any("more than tenfold" in line for line in record["warnings"]))

    def test_mass_of_a_species_in_the_continuum(self):
        self.every = 0.01
        small = [*SMALL, "--set", "tfm.integrator=explicit"]  # its steps are shorter than a row of the history
        directory, words = self.folder / "run", [*small, "--until", "0.2 s"]
        self.ends(DONE, "tfm", CASE, *small, "--until", "0.1 s", "-o", directory)

        def leak(file):
            file["arrays/initial_mass"][1] *= 1 + 1e-9
        change(directory / "checkpoint.h5", leak)
        self.stops("tfm", CASE, words, r"mass \(species coarse\) is off by 1e-09", directory)

    def test_number_of_particles(self):
        self.every = 1e-3
        case, directory = self.write("case.toml", FALL), self.folder / "run"
        self.ends(DONE, "dem", case, "--quiet", "--no-picture", "-o", directory, "--until", "5 ms")

        def lose_one(file):
            file["arrays/initial_number"][0] += 1
        change(directory / "checkpoint.h5", lose_one)
        self.stops("dem", case, ["--quiet", "--no-picture"], r"particle count \(species fine\) is off by 1, the limit is 0", directory)

    def test_energy_of_particles_in_steps_that_are_too_long(self):
        """Steps of most of a contact: energy comes from nowhere."""
        case, directory = self.write("case.toml", FALL), self.folder / "run"
        words = ["--quiet", "--no-picture", "--set", "dem.fixed_step=7e-5", "--set", "dem.max_overlap=0.5", "-o", directory]
        told = self.ends(NUMBERS, "dem", case, *words).stderr
        self.assertIn("energy is off by", told)
        self.assertIn("lower dem.fixed_step", told)  # dem.steps_per_contact cannot act beside it
        self.assertLess(strict_json((directory / "run.json").read_text())["time_s"], 0.02)
        self.ends(DONE, "dem", case, *words, "--resume", "--permissive")

    def test_a_gas_between_particles_keeps_its_mass(self):
        """Its account misses by the first order of the fluid's step, 9e-6 here; 2.5e-3 if the step is not a balance of mass."""
        case, directory = self.write("gas.toml", GAS), self.folder / "run"
        self.ends(DONE, "dem", case, "--quiet", "--no-picture", "-o", directory)
        record = strict_json((directory / "run.json").read_text())
        mass = next(i for i in record["invariants"] if i["name"] == "mass of the fluid")
        self.assertTrue(mass["judged"] and mass["held"], mass)
        self.ends(DONE, "dem", case, "--quiet", "--no-picture", "-o", self.folder / "parts", "--until", "20 ms")
        self.ends(DONE, "dem", case, "--quiet", "--no-picture", "-o", self.folder / "parts", "--resume")
        parts = strict_json((self.folder / "parts/run.json").read_text())["invariants"]
        self.assertEqual(mass["worst"], next(i for i in parts if i["name"] == "mass of the fluid")["worst"])


if __name__ == "__main__":
    program.main()
