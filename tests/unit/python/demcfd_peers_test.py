#!/usr/bin/python3
"""What the comparison with OpenFOAM's DPMFoam writes, reads and judges: demcfd_peers_test.py PROGRAM SCRIPTS; no peer."""
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

PROGRAM, SCRIPTS = Path(sys.argv[1]).resolve(), sys.argv[2]
sys.path[:0] = [SCRIPTS]

import demcfd_bed
import demcfd_peers
import openfoam_particles

LOG = """
Time = 2e-05
Cloud: kinematicCloud injector: beads
ExecutionTime = 0.5 s  ClockTime = 0 s

Time = 4e-05
    2 move-collide subCycles
ExecutionTime = 0.7 s  ClockTime = 0 s

Time = 6e-05
    3 move-collide subCycles
ExecutionTime = 1.0 s  ClockTime = 1 s
"""


class DemCfdPeers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bed = demcfd_bed.read(PROGRAM)

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.directory = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def test_the_bed_is_that_of_the_tutorial(self):
        bed = self.bed
        self.assertEqual((bed["size"], bed["depth"], bed["cells"], bed["layers"]), ((0.15, 0.45), 0.015, (30, 90), 2))
        self.assertEqual((bed["count"], bed["diameter"], bed["density"], bed["velocity"]), (24750, 2.5e-3, 2526, 1.875))
        self.assertEqual((bed["fluid_density"], bed["fluid_viscosity"]), (1.2, 1.2e-5))  # nu = 1e-5 m2/s
        self.assertEqual((bed["youngs_modulus"], bed["wall"]["youngs_modulus"], bed["wall"]["friction"]), (1e8, 1e8, 0.09))

    def test_lattice(self):
        """The tutorial's list: 5 x 50 x 99 places 3 mm apart, half a spacing from the walls; no two are one."""
        places = demcfd_bed.lattice(self.bed)
        np.testing.assert_allclose(places.min(axis=0), [1.5e-3, 1.5e-3, 1.5e-3], rtol=1e-12)
        np.testing.assert_allclose(places.max(axis=0), [0.1485, 0.2955, 0.0135], rtol=1e-12)
        self.assertEqual(len(np.unique(np.rint(places / 1.5e-3), axis=0)), 24750)

    def test_dashpot(self):
        """Restitution of the tutorial's alpha = 0.02: beta = 0.02/sqrt(5) = 0.0089443, e = exp(-pi beta) = 0.97229."""
        self.assertAlmostEqual(openfoam_particles.dashpot(0.97229), 0.02, delta=1e-5)

    def test_solid_steps(self):
        log = self.directory / "log"
        log.write_text(LOG)
        self.assertEqual(openfoam_particles.solid_steps(log, 0.0, 6e-5), 1 + 2 + 3)
        self.assertEqual(openfoam_particles.solid_steps(log, 2e-5, 6e-5), 2 + 3)

    def test_the_case_holds_every_bead(self):
        openfoam_particles.write_case(self.directory, self.bed | {"places": demcfd_bed.lattice(self.bed)}, 1e-3)
        text = (self.directory / "constant/kinematicCloudPositions").read_text()
        self.assertEqual(text.count("\n(0."), 24750)
        self.assertIn("simpleGrading", (self.directory / "system/blockMeshDict").read_text())
        self.assertIn("(30 90 2)", (self.directory / "system/blockMeshDict").read_text())
        for name in ("p", "U.gas"):
            self.assertIn("symmetry", (self.directory / "0" / name).read_text())

    def test_stored_places_are_read(self):
        folder = self.directory / "lagrangian/kinematicCloud"
        folder.mkdir(parents=True)
        (folder / "positions").write_text("2\n(\n(0.1 0.2 0.003) 17\n(1e-3 2.5e-3 0.01) 4\n)\n")
        np.testing.assert_array_equal(openfoam_particles.read_places(self.directory),
                                      [[0.1, 0.2, 0.003], [1e-3, 2.5e-3, 0.01]])

    def test_measures_of_a_uniform_bed(self):
        """Half the column filled evenly: centre at a quarter; the top within a slab of 5 mm, 66 rows of 3 mm give 198 mm."""
        places = demcfd_bed.lattice(self.bed)
        places = places[places[:, 1] < 0.198]
        found = demcfd_bed.measures(self.bed, places)
        self.assertAlmostEqual(found["centre_m"], 0.099, delta=1e-12)
        self.assertAlmostEqual(found["bed_height_m"], 0.198, delta=5e-3)

    def test_beads_come_to_rest(self):
        bed = self.bed | {"count": 300, "size": (0.03, 0.06), "cells": (6, 12)}
        places = demcfd_bed.packed(bed, PROGRAM, self.directory, 300)
        self.assertEqual(places.shape, (300, 3))
        # all within the box, and denser than they began: 0.45, at a floor of 0.03 x 0.015 m2 a bed of 12.1 mm at 0.45
        self.assertTrue((places.min(axis=0) > 1.2e-3).all())
        self.assertTrue((places.max(axis=0)[[0, 2]] < [0.0288, 0.0138]).all())
        volume = 300 * math.pi / 6 * 2.5e-3**3
        # walls at 6 diameters make it looser than 0.60
        self.assertGreater(volume / (0.03 * 0.015 * 2 * places[:, 1].mean()), 0.5)

    def test_goals(self):
        def run(ns, height=0.156, spread=0.02):
            return {"ns": ns, "cpu_per_s": 1e3 * ns, "spread": spread, "bed_height_m": height}
        met = lambda mine, peer: [m for _, m in demcfd_peers.verdicts({"polybed": mine, "OpenFOAM": peer})]
        self.assertEqual(met(run(1.0), run(50.1)), [True, None, True])
        self.assertEqual(met(run(1.0), run(49.9, 0.158)), [False, None, False])  # heights 1.3 % apart
        self.assertEqual(met(run(1.0, spread=math.inf), run(50.1))[0], None)
        self.assertEqual(demcfd_peers.verdicts({"OpenFOAM": run(1.0)}), [])

    def test_cost_per_particle_step(self):
        runs = [{"cpu_s": cpu, "solid_steps": 400, "fluid_steps": 100} for cpu in (2.0, 2.2, 2.1)]
        found = demcfd_peers.summary(runs, {"count": 1000}, 0.01)
        self.assertAlmostEqual(found["ns"], 2.1e9 / (1000 * 400))
        self.assertAlmostEqual(found["cpu_per_s"], 210)
        self.assertAlmostEqual(found["spread"], 0.2 / 2.1)

    def test_a_run_without_gas_is_told(self):
        (self.directory / "history.csv").write_text("time_s,pressure_drop_Pa\n0,0\n0.001,0\n")
        self.assertTrue(demcfd_peers.dry(self.directory))
        (self.directory / "history.csv").write_text("time_s,pressure_drop_Pa\n0,0\n0.001,1500\n")
        self.assertFalse(demcfd_peers.dry(self.directory))

    def test_says_what_to_install(self):
        run = subprocess.run([sys.executable, Path(SCRIPTS) / "demcfd_peers.py", PROGRAM], capture_output=True, text=True,
                             env=os.environ | {"PATH": str(self.directory)})
        self.assertEqual(run.returncode, 2)
        self.assertIn("apt-get install", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
