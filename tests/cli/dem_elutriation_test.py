#!/usr/bin/python3
"""polybed dem with column.outlet = "open": a stream carries particles out, and all files count them. Usage: dem_elutriation_test.py PROGRAM"""
import h5py
import numpy as np

import program
from program import DONE, Scratch, history, same_bits, strict_json

# Light fines in rising water, close below the top, and coarse grains that stay.
CASE = """[column]
size = ["12 mm", "12 mm"]
cells = [6, 6]
outlet = "open"
[fluid]
name = "water"
temperature = "20 degC"
[[species]]
name = "fine"
diameter = "0.5 mm"
density = 1200
[[species]]
name = "coarse"
diameter = "1 mm"
density = 4000
[bed]
particles = [200, 30]
solids_fraction = 0.6
start = "mixed"
start_solids_fraction = 0.12
[inlet]
superficial_velocity = "120 mm/s"
[effects]
others = "none"
contact = "hertz_mindlin"
drag = "cello"
[dem]
youngs_modulus = "2 MPa"
greatest_speed = "0.3 m/s"
[run]
until = "60 ms"
[output]
every = "20 ms"
history_every = "10 ms"
checkpoint_every = "20 ms"
"""
NUMBER = {"fine": 200, "coarse": 30}
MASS = {"fine": 1200 * np.pi / 6 * 0.5e-3**3, "coarse": 4000 * np.pi / 6 * 1e-9}


class Elutriation(Scratch):
    def dem(self, directory, *words, code=DONE, text=CASE):
        case = self.write("case.toml", text)
        return self.ends(code, "dem", case, "--quiet", "--json", "-o", self.folder / directory, *words)

    def test_what_is_carried_out_is_counted(self):
        record = strict_json(self.dem("run").stdout)
        rows = history(self.folder / "run")
        for name, number in NUMBER.items():
            out, left = np.array(rows[f"out_{name}"]), np.array(rows[f"mass_{name}_kg"]) / MASS[name]
            self.assertEqual(out[0], 0)
            self.assertTrue((np.diff(out) >= 0).all() and (out == np.round(out)).all())
            np.testing.assert_allclose(out + left, number, rtol=1e-12)  # rounding of sums of one mass
            np.testing.assert_allclose(rows[f"out_{name}_kg"], out * MASS[name], rtol=1e-12)
            # The last checkpoint makes the list anew, after the last row: one or the other has left by then.
            after = record["outflow"][name]["particles"] - out[-1]
            self.assertTrue(0 <= after <= 5, after)
            self.assertAlmostEqual(record["card"]["recovery"][name], out[-1] / number, places=5)
        self.assertEqual(record["particles"] + sum(o["particles"] for o in record["outflow"].values()), sum(NUMBER.values()))
        self.assertGreater(rows["out_fine"][-1], 30)
        self.assertEqual(rows["out_coarse"][-1], 0)
        self.assertLess(record["energy"]["worst_error"], record["energy"]["limit"])
        with h5py.File(self.folder / "run/particles.h5") as file:
            self.assertEqual(file["particles"][()][-1], sum(NUMBER.values()) - rows["out_fine"][-1])
            # wholly outside, and gone when the list is made: within a tenth of a diameter
            self.assertLess(max(file[f"step/{n:06d}/position"][:, 1].max() for n in range(1, 5)), 12.4e-3)
        self.has_no_nan(self.folder / "run")
        picture = self.ends(DONE, "plot", self.folder / "run", "--what", "particles,history")
        self.assertNotIn("Traceback", picture.stderr)

    def test_a_resumed_run_has_the_same_bits(self):
        self.dem("whole")
        self.dem("cut", "--until", "40 ms")
        self.dem("cut", "--resume")
        for name in ("particles.h5", "profiles.h5", "fields.h5"):
            self.assertEqual(same_bits(self.folder / "whole" / name, self.folder / "cut" / name), [])
        self.assertEqual((self.folder / "whole/history.csv").read_text(), (self.folder / "cut/history.csv").read_text())

    def test_both_models_are_compared_by_what_has_left(self):
        case = self.write("case.toml", CASE)
        self.ends(DONE, "tfm", case, "--quiet", "--set", "effects.solids_stress=frictional", "-o", self.folder / "tfm")
        self.dem("dem")
        words = ["compare", case, "--tfm", self.folder / "tfm", "--dem", self.folder / "dem", "-o", self.folder / "both"]
        found = strict_json(self.ends(DONE, *words, "--no-picture", "--json").stdout)
        for model in ("tfm", "dem"):
            card = strict_json((self.folder / model / "run.json").read_text())["card"]
            for name in NUMBER:
                self.assertAlmostEqual(found["measures"][f"recovery_{name}"][model], card["recovery"][name], places=5)
        self.assertRegex(self.ends(DONE, *words).stdout, r"recovery of coarse +0   within the interval: reached")
        self.assertRegex((self.folder / "both/comparison.html").read_text(), r"recovery of coarse: .*?<td>reached</td>")

    def test_under_a_screen_nothing_leaves(self):
        done = self.ends(DONE, "dem", self.write("shut.toml", CASE.replace('outlet = "open"', "")), "--json", "--until", "10 ms", "-o",
                         self.folder / "shut")
        self.assertNotIn("outflow", strict_json(done.stdout))
        self.assertNotIn("have left", done.stderr)
        self.assertFalse([name for name in history(self.folder / "shut") if name.startswith(("out_", "carried"))])
        with h5py.File(self.folder / "shut/checkpoint.h5") as file:
            self.assertNotIn("outflow", file["arrays"])
            self.assertEqual(file["arrays/particles"].size, 230 * 23)


if __name__ == "__main__":
    program.main()
