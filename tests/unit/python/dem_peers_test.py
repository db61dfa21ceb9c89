#!/usr/bin/python3
"""What the comparison of particle programs makes, writes and judges: dem_peers_test.py PROGRAM SCRIPTS; no peer."""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

PROGRAM, SCRIPTS = sys.argv[1:3]
sys.path[:0] = [SCRIPTS]

import dem_bed
import dem_goals
import dem_packing
import dem_peers
import dem_polybed
import dem_process
import granular_script
import lammps_run

SETTINGS = {"steps": 400, "sample": 0, "list": "interval", "ranks": 1}
LOG = """Step v_own v_contacts
       0   7.5e-07   6.4235
     400   1.25e-09  6.31
Loop time of 1.04 on 1 procs for 400 steps with 4000 atoms
Neighbor list builds = 4
Dangerous builds = 0
"""


class DemPeers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.packing = dem_packing.settle(600, 0.64, 7)
        cls.bed = dem_bed.make(cls.packing)

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.directory = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def test_all_pairs_are_found(self):
        x, box = self.packing
        found = {tuple(sorted(pair)) for pair in zip(*dem_packing.within(x, box, 1.1))}
        d = x[:, None] - x[None]
        r = np.linalg.norm(d - box * np.rint(d / box), axis=2)
        i, j = np.nonzero(np.triu(r < 1.1, 1))
        self.assertEqual(found, set(zip(i, j)))
        self.assertEqual(len(found), len(dem_packing.within(x, box, 1.1)[0]))  # none twice
        self.assertAlmostEqual(self.bed["contacts"], (np.triu(r < 1, 1).sum() * 2) / len(x), delta=1e-12)

    def test_force_is_the_slope_of_the_energy(self):
        x, box = self.packing
        x = x + np.random.default_rng(1).normal(0, 0.02, x.shape)
        pairs = dem_packing.within(x, box, 1.2)
        energy = lambda y: 0.5 * np.sum(np.maximum(dem_packing.overlaps(y, box, pairs)[0], 0) ** 2)
        direction, h = np.random.default_rng(2).normal(0, 1, x.shape), 1e-6
        slope = (energy(x + h * direction) - energy(x - h * direction)) / (2 * h)
        # Central difference: second derivatives jump where a contact opens, so of first order in h there.
        self.assertAlmostEqual(-np.vdot(dem_packing.forces(x, box, pairs), direction) / slope, 1, delta=1e-5)

    def test_the_packing_is_dense_and_at_rest(self):
        x, box = self.packing
        self.assertAlmostEqual(600 * math.pi / 6 / box**3, 0.64, delta=1e-12)
        pairs = dem_packing.within(x, box, 1.1)
        # Spheres jam at 0.639 +- 0.001 (O'Hern et al. 2003), so overlaps are tenths of a percent. Six contacts hold a
        # sphere at jamming; some spheres are loose and have none, and pressing adds some.
        self.assertLess(dem_packing.overlaps(x, box, pairs)[0].max(), 0.03)
        self.assertTrue(5.7 < self.bed["contacts"] < 7, self.bed["contacts"])
        force = dem_packing.forces(x, box, pairs)
        self.assertLess(np.sqrt(np.mean(np.sum(force**2, axis=1))), 1e-4)
        again, _ = dem_packing.settle(600, 0.64, 7)
        np.testing.assert_array_equal(again, x)

    def test_copies_make_a_larger_bed_of_the_same_kind(self):
        large = dem_bed.make(self.packing, 2)
        self.assertEqual(large["count"], 8 * 600)
        x, box = large["x"] / dem_bed.DIAMETER, large["box"] / dem_bed.DIAMETER
        pairs = dem_packing.within(x, box, 1.1)
        contacts = 2 * np.sum(dem_packing.overlaps(x, box, pairs)[0] > 1e-9) / len(x)  # rounding opens none that press
        self.assertAlmostEqual(contacts / self.bed["contacts"], 1, delta=1e-3)
        self.assertTrue(((x >= 0) & (x < box)).all())
        self.assertGreater(np.ptp(large["v"].reshape(8, 600, 3)[:, 0, 0]), 0)  # each copy has velocities of its own

    def test_the_drift_passes_half_the_skin_between_two_lists(self):
        way = np.linalg.norm(self.bed["v"].mean(axis=0)) * dem_bed.STEP * dem_bed.LIST_EVERY
        self.assertAlmostEqual(way / (dem_bed.SKIN / 2), 1, delta=1e-12)
        # 600 spheres of 1.3090e-6 kg at 0.1 m/s
        self.assertAlmostEqual(self.bed["drift_J"] / (0.5 * 600 * 1.30899694e-6 * 0.01), 1, delta=1e-8)

    def test_constants_of_a_pair(self):
        """By hand: E* = 1e7/(2 x 0.9375), G = 4e6, G* = G/(2 x 1.75), ln 0.9 = -0.1053605."""
        self.assertAlmostEqual(dem_bed.YOUNG_OF_PAIR / 5.3333333333e6, 1, delta=1e-10)
        self.assertAlmostEqual(dem_bed.SHEAR_OF_PAIR / 1.1428571429e6, 1, delta=1e-10)
        self.assertAlmostEqual(dem_bed.damping_ratio(0.9), 0.0335187, delta=1e-6)

    def test_lammps_has_the_same_dashpots(self):
        overlap = self.bed["overlap_m"]
        radius = math.sqrt(dem_bed.REDUCED_RADIUS * overlap)
        damping = dem_bed.normal_damping(overlap)
        # gran/hertz/history: gamma_n m* a; granular with tsuji: alpha sqrt(k_n m*)
        hertz = lammps_run.hertz_damping(overlap) * dem_bed.REDUCED_MASS * radius
        self.assertAlmostEqual(hertz / damping, 1, delta=1e-12)
        words = lammps_run.pair_commands(self.bed, "same")[1].split()
        alpha, stiffness = lammps_run.tsuji(float(words[5])), 4 / 3 * dem_bed.YOUNG_OF_PAIR * radius
        self.assertAlmostEqual(alpha * math.sqrt(stiffness * dem_bed.REDUCED_MASS) / damping, 1, delta=1e-9)

    def test_a_written_bed_is_read_back(self):
        granular_script.write_data(self.directory / "data", self.bed)
        text = (self.directory / "data").read_text()
        self.assertIn("600 atoms\n", text)
        atoms, velocities = (np.array([line.split() for line in part.strip().splitlines()], float)
                             for part in text.split("Atoms\n")[1].split("Velocities\n"))
        np.testing.assert_array_equal(atoms[:, 4:7], self.bed["x"])
        np.testing.assert_array_equal(velocities[:, 1:], np.hstack([self.bed["v"], self.bed["w"]]))
        dem_polybed.write(self.directory, self.bed, SETTINGS)
        rows = np.genfromtxt(self.directory / "particles.csv", delimiter=",", skip_header=1, usecols=range(1, 10))
        np.testing.assert_array_equal(rows, np.hstack([self.bed["x"], self.bed["v"], self.bed["w"]]))

    @unittest.skipUnless(dem_polybed.knows_particles(PROGRAM), "this program has no particle model")
    def test_polybed_reads_the_case(self):
        dem_polybed.write(self.directory, self.bed, SETTINGS)
        subprocess.run([PROGRAM, "check", self.directory / "case.toml"], check=True, stdout=subprocess.DEVNULL)

    def test_measures_of_a_log(self):
        (self.directory / "log").write_text(LOG)
        found = granular_script.read(self.directory, SETTINGS)
        self.assertEqual(found["rows"][-1], {"step": 400, "kinetic_J": 1.25e-9, "contacts": 6.31})
        self.assertEqual((len(found["rows"]), found["rebuilds"]), (2, 4))
        with self.assertRaises(dem_process.Failed):
            granular_script.read(self.directory, SETTINGS | {"steps": 401})
        (self.directory / "log").write_text(LOG.replace("Dangerous builds = 0", "Dangerous builds = 3"))
        with self.assertRaises(dem_process.Failed):
            granular_script.read(self.directory, SETTINGS)

    def test_measures_of_polybed(self):
        dem_polybed.write(self.directory, self.bed, SETTINGS)
        (self.directory / "run").mkdir()
        work = {"steps": 400, "particle_steps": 240000, "contact_steps": 744000, "rebuilds": 5}
        (self.directory / "run/run.json").write_text(json.dumps({"work": work}))
        own = 2.5e-9
        (self.directory / "run/history.csv").write_text(
            f"time_s,kinetic_J\n0,1\n0.002,{self.bed['drift_J'] + own:.17g}\n")
        found = dem_polybed.read(self.directory, SETTINGS)
        self.assertAlmostEqual(found["rows"][-1]["kinetic_J"] / own, 1, delta=1e-6)
        self.assertAlmostEqual(found["rows"][-1]["contacts"], 6.2, delta=1e-12)  # two spheres share a contact
        with self.assertRaises(dem_process.Failed):
            dem_polybed.read(self.directory, SETTINGS | {"steps": 401})

    def test_cost_is_that_of_the_longer_run_less_the_shorter(self):
        def run(cpu, wall):
            return {"cpu_s": cpu, "wall_s": wall, "memory_B": 1e6, "rebuilds": 1, "rows": [{"contacts": 6.0}]}
        turns = [{"short": run(1, 1), "long": run(cpu, 5)} for cpu in (3, 2.9, 3.2)]
        found = dem_peers.summary(turns, 1000, 500, 1)
        self.assertAlmostEqual(found["rate"], 1000 * 500 / 2)
        self.assertAlmostEqual(found["busy"], 2 / 4)
        self.assertAlmostEqual(found["spread"], 0.3 / 3)
        self.assertEqual(dem_peers.summary(turns[:2], 1000, 500, 1)["spread"], math.inf)  # two runs tell nothing

    def test_goals(self):
        mine = {"rate": 2.6e6, "spread": 0.05}
        peers = {"LIGGGHTS": {"rate": 1e6, "spread": 0.05}, "LAMMPS granular": {"rate": 2.1e6, "spread": 0.05}}
        met = lambda copies: [m for _, m in dem_goals.rate_goals("polybed", mine, peers, copies)]
        self.assertEqual((met(1), met(3)), ([True, False], [True]))  # 1.24 times LAMMPS: 1.3 and 1.2 are asked for
        peers["LIGGGHTS"]["spread"] = 0.11
        self.assertEqual(met(1), [None, False])
        one, two = {"wall_rate": 1.0, "spread": 0.01}, {"wall_rate": 1.9, "spread": 0.01, "busy": 1.0}
        self.assertTrue(dem_goals.speed_up("polybed", one, two, 3)[1])
        self.assertFalse(dem_goals.speed_up("polybed", one, two | {"wall_rate": 1.8}, 3)[1])
        self.assertIsNone(dem_goals.speed_up("polybed", one, two | {"busy": 0.9}, 3)[1])
        self.assertFalse(dem_goals.same_contacts({"a": {"contacts": 6.0}, "b": {"contacts": 6.13}})[1])
        self.assertTrue(dem_goals.same_contacts({"a": {"contacts": 6.0}, "b": {"contacts": 6.11}})[1])
        rows = [{"step": 0, "kinetic_J": 1.0}, {"step": 100, "kinetic_J": 0.5}]
        self.assertTrue(dem_goals.same_energy("a", "b", {"a": rows, "b": rows})[1])
        other = [rows[0], {"step": 100, "kinetic_J": 0.47}]
        self.assertFalse(dem_goals.same_energy("a", "b", {"a": rows, "b": other})[1])

    def test_says_what_is_missing(self):
        run = subprocess.run([sys.executable, Path(SCRIPTS) / "dem_peers.py", sys.executable], capture_output=True,
                             text=True, env=os.environ | {"PATH": str(self.directory)})
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("has no command dem", run.stderr)
        for package in ("lammps", "liggghts"):
            self.assertIn(f"apt-get install --no-install-recommends {package}", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
