#!/usr/bin/python3
"""polybed dem with [[feed]]: what has entered is counted in all files. Usage: dem_feed_test.py PROGRAM"""
import numpy as np

import program
from dem_opening_test import FALL
from program import DONE, WRONG_CASE, Scratch, history, same_bits, strict_json

# The slot of dem_opening_test, of a given depth, with a feed over it from 20 ms on.
FEED = """[[feed]]
species = "fine"
at = "top"
superficial_velocity = [[0, 0], ["20 ms", 0], ["20 ms", "40 mm/s"]]
velocity = "0.3 m/s"
from = ["2 mm"]
to = ["10 mm"]
"""
FED = FALL.replace("[fluid]", 'depth = "3 mm"\n[fluid]').replace("[effects]", FEED + "[effects]")
# Water that rises through beads that more of them fall into.
WET = FED.replace('name = "none"', 'name = "water"\ntemperature = "20 degC"').replace('opening = "5 mm"', "").replace(
    "[effects]", '[inlet]\nsuperficial_velocity = "10 mm/s"\n[effects]\ndrag = "cello"').replace("cells = [6, 30]", "cells = [6, 15]")
MASS = 2500 * np.pi / 6 * 0.7e-3**3


def called_for(time):
    """Particles of 0.18 mm3 in 40 mm/s over 24 mm2 since 20 ms."""
    return np.floor(0.04 * 24e-6 * np.maximum(0, np.asarray(time) - 0.02) / (np.pi / 6 * 0.7e-3**3) + 1e-6)


class Feed(Scratch):
    def dem(self, directory, *words, code=DONE, text=FED):
        case = self.write("case.toml", text)
        return self.ends(code, "dem", case, "--quiet", "--json", "-o", self.folder / directory, *words)

    def counts(self, run, record):
        """That the files agree on what has entered; its number."""
        rows = history(run)
        entered = np.array(rows["in_fine"])
        np.testing.assert_allclose(rows["in_fine_kg"], entered * MASS, rtol=1e-12)
        self.assertFalse(np.any(rows["in_coarse"]))
        self.assertEqual(record["feed"]["fine"]["particles"], entered[-1])
        self.assertEqual(record["feed"]["fine"]["waiting"], 0)
        self.assertEqual(record["energy"]["carried_in_J"], rows["carried_in_J"][-1])
        self.assertLess(record["energy"]["worst_error"], record["energy"]["limit"])
        self.assertFalse([line for line in record["warnings"] if "[[feed]]" in line])
        out = np.array(rows["out_fine"]) if "out_fine" in rows else 0
        np.testing.assert_allclose(np.array(rows["mass_fine_kg"]) / MASS + out - entered, 150, rtol=1e-12)
        return np.array(rows["time_s"]), entered

    def test_what_has_entered_is_counted(self):
        record = strict_json(self.dem("run").stdout)
        time, entered = self.counts(self.folder / "run", record)
        # those called for within the time in which a particle moves by half the skin may still be outside
        late = 0.5 * 0.07e-3 / 0.3 + 1e-5
        self.assertTrue((entered <= called_for(time)).all() and (entered >= called_for(time - late)).all(), entered)
        self.assertGreater(entered[-1], 200)
        out = history(self.folder / "run")["out_fine_kg"][-1]
        self.assertAlmostEqual(record["card"]["recovery"]["fine"], out / (MASS * (150 + entered[-1])), places=5)
        picture = self.ends(DONE, "plot", self.folder / "run", "--what", "particles,history")
        self.assertNotIn("Traceback", picture.stderr)

    def test_check_counts_what_will_be_fed(self):
        case = self.write("case.toml", FED)
        need = strict_json(self.ends(DONE, "check", case, "--json").stdout)
        self.assertEqual(need["fed"], {"fine": int(called_for(0.06)), "coarse": 0})
        self.assertIn(f"{int(called_for(0.06))} more are fed", self.ends(DONE, "check", case, "--details").stdout)

    def test_check_counts_what_is_fed_where_only_a_side_lets_out(self):
        for case, kept in ((program.ROOT / "cases/weir/case.toml", 0.5), (program.ROOT / "cases/fed-hopper/case.toml", 0)):
            need = strict_json(self.ends(DONE, "check", case, "--json").stdout)
            need = need.get("dem", need)
            count = sum(need["particles"].values()) + kept * sum(need["fed"].values())
            self.assertAlmostEqual(need["time"]["particle_steps"] / (need["time"]["steps"] * count), 1, places=9)

    def test_in_a_fluid(self):
        record = strict_json(self.dem("wet", text=WET).stdout)
        _, entered = self.counts(self.folder / "wet", record)
        self.assertGreater(entered[-1], 200)

    def test_a_resumed_run_has_the_same_bits(self):
        for name, text in (("dry", FED), ("wet", WET)):
            self.dem(f"{name}-whole", text=text)
            self.dem(f"{name}-cut", "--until", "30 ms", text=text)
            self.dem(f"{name}-cut", "--resume", text=text)
            whole, cut = self.folder / f"{name}-whole", self.folder / f"{name}-cut"
            for file in ("particles.h5", "profiles.h5"):
                self.assertEqual(same_bits(whole / file, cut / file), [])
            self.assertEqual((whole / "history.csv").read_text(), (cut / "history.csv").read_text())

    def test_particles_without_room_are_reported(self):
        text = FED.replace('opening = "5 mm"', "").replace('"30 mm"', '"10 mm"').replace("cells = [6, 30]", "cells = [6, 10]")
        done = self.ends(DONE, "dem", self.write("full.toml", text), "--json", "--until", "0.25 s", "-o", self.folder / "full")
        record = strict_json(done.stdout)
        self.assertGreater(record["feed"]["fine"]["waiting"], 0)
        self.assertTrue([line for line in record["warnings"] if "have found no room where they enter" in line], record["warnings"])

    def test_without_feeds_there_is_nothing_of_them(self):
        text = FED[:FED.index("[[feed]]")] + FED[FED.index("[effects]"):]
        done = self.ends(DONE, "dem", self.write("none.toml", text), "--json", "-o", self.folder / "none", "--until", "1 ms")
        self.assertNotIn("feed", strict_json(done.stdout))
        self.assertNotIn("have entered", done.stderr)
        self.assertFalse([name for name in history(self.folder / "none") if name.startswith(("in_", "carried_in"))])

    def test_a_stream_without_room_is_refused(self):
        done = self.dem("dense", "--set", "feed=[{species=\"fine\", superficial_velocity=0.1, velocity=0.2}]", code=WRONG_CASE)
        self.assertIn("[[feed]] of fine: particles that fill 0.5 of the volume in which they enter", done.stderr)


if __name__ == "__main__":
    program.main()
