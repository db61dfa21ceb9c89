#!/usr/bin/python3
"""polybed dem with an opening in the bottom: what has left is counted in all files. Usage: dem_opening_test.py PROGRAM"""
import h5py
import numpy as np

import program
from program import DONE, WRONG_CASE, Scratch, history, same_bits, strict_json

# Two sizes over a slot that all of them fall through within 0.15 s, but for those beside it.
FALL = """[column]
size = ["12 mm", "30 mm"]
cells = [6, 30]
[fluid]
name = "none"
[[species]]
name = "fine"
diameter = "0.7 mm"
density = 2500
[[species]]
name = "coarse"
diameter = "1 mm"
density = 2000
[bed]
particles = [150, 100]
solids_fraction = 0.6
start = "mixed"
start_solids_fraction = 0.4
[effects]
others = "none"
contact = "hertz_mindlin"
[dem]
opening = "5 mm"
[run]
until = "60 ms"
[output]
every = "15 ms"
history_every = "5 ms"
checkpoint_every = "15 ms"
"""
# One sphere over the middle.
ALONE = """species,x,y,z
coarse,0.006,0.001,0.001
"""


class Opening(Scratch):
    def dem(self, directory, *words, code=DONE):
        case = self.write("case.toml", FALL)
        return self.ends(code, "dem", case, "--quiet", "--json", "-o", self.folder / directory, *words)

    def test_what_has_left_is_counted_and_what_is_left_is_stored(self):
        record = strict_json(self.dem("run").stdout)
        rows = history(self.folder / "run")
        each = {"fine": (150, 2500 * np.pi / 6 * 0.7e-3**3), "coarse": (100, 2000 * np.pi / 6 * 1e-9)}
        for name, (number, mass) in each.items():
            out, left = np.array(rows[f"out_{name}"]), np.array(rows[f"mass_{name}_kg"]) / mass
            self.assertEqual(out[0], 0)
            self.assertGreater(out[-1], 20)
            self.assertTrue((np.diff(out) >= 0).all() and (out == np.round(out)).all())
            # of the masses only rounding: they are sums of one mass
            np.testing.assert_allclose(out + left, number, rtol=1e-12)
            np.testing.assert_allclose(rows[f"out_{name}_kg"], out * mass, rtol=1e-12)
            self.assertEqual(record["outflow"][name]["particles"], out[-1])
            self.assertEqual(record["outflow"][name]["mass_kg"], rows[f"out_{name}_kg"][-1])
        self.assertEqual(record["particles"] + sum(o["particles"] for o in record["outflow"].values()), 250)
        self.assertLess(record["energy"]["worst_error"], record["energy"]["limit"])
        self.assertEqual(record["energy"]["carried_out_J"], rows["carried_out_J"][-1])
        with h5py.File(self.folder / "run/particles.h5") as file:
            counts = file["particles"][()]
            self.assertEqual((counts[0], counts[-1]), (250, record["particles"]))
            for n, count in enumerate(counts):
                step = file[f"step/{n + 1:06d}"]
                self.assertEqual(step["position"].shape, (count, 3))
                self.assertTrue((np.diff(step["id"][()]) > 0).all())
                # gone when the list is made after a fall of a diameter: it is made within a tenth of one
                self.assertGreater(step["position"][:, 1].min(), -1.2e-3)
        picture = self.ends(DONE, "plot", self.folder / "run", "--what", "particles,history")
        self.assertNotIn("Traceback", picture.stderr)

    def test_a_resumed_run_has_the_same_bits(self):
        self.dem("whole")
        self.dem("cut", "--until", "30 ms")
        self.dem("cut", "--resume")
        for name in ("particles.h5", "profiles.h5"):
            self.assertEqual(same_bits(self.folder / "whole" / name, self.folder / "cut" / name), [])
        self.assertEqual((self.folder / "whole/history.csv").read_text(), (self.folder / "cut/history.csv").read_text())

    def test_an_empty_box_is_written_and_drawn(self):
        self.write("alone.csv", ALONE)
        case = self.write("alone.toml", "\n".join(
            line for line in FALL.replace('start = "mixed"', 'start = "list:alone.csv"').splitlines()
            if not line.startswith(("particles =", "start_solids"))))
        run = self.folder / "alone"
        record = strict_json(self.ends(DONE, "dem", case, "--quiet", "--json", "-o", run).stdout)
        self.assertEqual((record["particles"], record["outflow"]["coarse"]["particles"]), (0, 1))
        rows = history(run)
        self.assertEqual(rows["mass_coarse_kg"][-1], 0)
        with h5py.File(run / "particles.h5") as file:
            self.assertEqual(list(file["particles"][()]), [1, 1, 0])  # 2 mm down after 20.2 ms; then nothing is left to run
        self.assertEqual((record["state"], record["time_s"]), ("done", rows["time_s"][-1]))
        odd = self.folder / "odd"
        self.ends(DONE, "dem", case, "--quiet", "-o", odd, "--set", "output.history_every='7 ms'")
        self.assertEqual([history(odd)[name][-1] for name in ("time_s", "mass_coarse_kg")], [record["time_s"], 0])
        ended = f"ended after {record['time_s']:.4g} s: all particles have left"
        self.assertIn(ended, record["warnings"])
        self.ends(DONE, "plot", run, "--what", "particles,history")
        rows = (run / "history.csv").read_text()
        again = self.ends(DONE, "dem", case, "--json", "--resume", "--until", "70 ms", "-o", run)
        self.assertIn(ended, again.stderr)
        self.assertNotIn("to go on", again.stderr)
        self.assertEqual((strict_json(again.stdout)["time_s"], (run / "history.csv").read_text()), (record["time_s"], rows))

    def test_without_an_opening_there_is_nothing_of_it(self):
        self.assertIn("outflow", strict_json(self.dem("open", "--until", "1 ms").stdout))
        case = self.write("shut.toml", FALL.replace('opening = "5 mm"', ""))
        done = self.ends(DONE, "dem", case, "--json", "-o", self.folder / "none", "--until", "1 ms")
        self.assertNotIn("outflow", strict_json(done.stdout))
        self.assertNotIn("has left", done.stderr)
        self.assertFalse([name for name in history(self.folder / "none") if name.startswith(("out_", "carried"))])

    def test_too_wide_an_opening_is_refused(self):
        done = self.dem("wide", "--set", "dem.opening=0.012", code=WRONG_CASE)
        self.assertIn("dem.opening = 0.012 m: it must be narrower than the bottom", done.stderr)


if __name__ == "__main__":
    program.main()
