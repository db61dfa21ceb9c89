#!/usr/bin/python3
"""Runs of a compressible fluid: what they write besides, and a fluid alone. Usage: compressible_test.py PROGRAM"""
import h5py
import numpy as np

import program
from program import DONE, WRONG_CASE, Scratch, history, same_bits, strict_json

PIPE = """
[column]
size = ["10 mm", "1 m"]
cells = [1, 20]
sides = "periodic"
[fluid]
name = "air"
temperature = "20 degC"
equation_of_state = "ideal_gas"
outlet_pressure = "2 bar"
[[species]]
name = "glass"
diameter = "1 mm"
density = "2500 kg/m3"
[bed]
volume_share = [1.0]
static_height = 0
solids_fraction = 0.6
[inlet]
superficial_velocity = [[0, 1], ["2 ms", 1], ["2 ms", 2]]
[effects]
others = "none"
drag = "gidaspow"
[run]
until = "20 ms"
[output]
checkpoint_every = "5 ms"
every = "1 ms"
history_every = "0.1 ms"
"""


class Compressible(Scratch):
    def test_a_gas_alone_is_accounted_for(self):
        case, whole, parts = self.write("pipe.toml", PIPE), self.folder / "whole", self.folder / "parts"
        self.ends(DONE, "tfm", case, "-o", whole)
        record = strict_json((whole / "run.json").read_text())
        self.assertIn("mass of the fluid", [i["name"] for i in record["invariants"]])
        self.assertTrue(all(i["held"] for i in record["invariants"]), record["invariants"])
        columns = {name: np.array(values[1:], dtype=float) for name, values in history(whole).items() if "fluid" in name}
        self.assertEqual(list(columns), ["mass_fluid_kg", "fluid_in_kg", "fluid_out_kg"])
        self.assertGreater(columns["fluid_in_kg"][-1], 0)
        with h5py.File(whole / "fields.h5") as fields:
            last = fields["step"][sorted(fields["step"])[-1]]
            pressure, density = last["total_pressure"][()], last["density_fluid"][()]
            # P = rho R T, air of 20 degC, to the digits of R T
            np.testing.assert_allclose(pressure / density, 287.05 * 293.15, rtol=1e-12)
            self.assertLess(abs(pressure[-1, 0] / 2e5 - 1), 0.02)  # sound of rho c 1 m/s: 700 Pa
        self.has_no_nan(whole)
        self.ends(DONE, "tfm", case, "-o", parts, "--until", "10 ms")
        self.ends(DONE, "tfm", case, "-o", parts, "--resume")
        self.assertEqual(same_bits(whole / "checkpoint.h5", parts / "checkpoint.h5"), [])

    def test_check_tells_the_speed_of_sound(self):
        case = self.write("pipe.toml", PIPE)
        self.assertIn("\nsound in the fluid 290.08 m/s", self.ends(DONE, "check", case, "--details").stdout)
        for override, message in (("fluid.outlet_pressure=0", "outlet_pressure = 0 is out of range: at least 1"),
                                  ("fluid.name=water", "water is a liquid")):
            self.assertIn(message, self.ends(WRONG_CASE, "check", case, "--set", override).stderr)


if __name__ == "__main__":
    program.main()
