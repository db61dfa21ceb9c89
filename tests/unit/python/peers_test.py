#!/usr/bin/python3
"""What the comparison with OpenFOAM reads and measures: peers_test.py PROGRAM SCRIPTS PACKAGE_DIRECTORY; no OpenFOAM needed."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

PROGRAM, SCRIPTS, PACKAGE = sys.argv[1:4]
sys.path[:0] = [SCRIPTS, PACKAGE]

import openfoam_cases
import openfoam_run
import peer_beds
import polybed
import polybed_case
import tfm_peers

LOG = """
Time = 0.1
fine fraction, min, max = 0.5 0 0.6
fine fraction, min, max = 0.25 0 0.6
Phase-sum volume fraction, min, max = 1.25 1 2
Phase-sum volume fraction, min, max = 1.00000006 1 1.1
ExecutionTime = 2.5 s  ClockTime = 3 s

Time = 0.2
fine fraction, min, max = 0.24 0 0.6
ExecutionTime = 4.0 s  ClockTime = 6 s
"""


class Peers(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.directory = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def test_measures_are_those_of_polybed(self):
        """The measures computed here from polybed's own profiles are those in its history."""
        bed = peer_beds.system_b(0.4)
        settings = peer_beds.polybed(1e-3, peer_beds.SAME, "explicit") | {"until": 0.1, "every": 0.1}
        result = polybed_case.solve(PROGRAM, self.directory / "case", bed, settings, 0.0, 100)
        profiles = polybed.read(self.directory / "case/run").profiles
        height = bed["size"][1] / bed["cells"][1]
        for time in (0, -1):
            phi, row = {n: profiles[f"phi_{n}"][time] for n in ("fine", "coarse")}, result["rows"][time]
            # The same sums in another order: rounding of 200 terms.
            self.assertAlmostEqual(openfoam_run.bed_height(sum(phi.values()), height) / row["bed_height_m"], 1, delta=1e-12)
            for name, values in phi.items():
                centre = np.dot(profiles["y_m"], values) / values.sum()
                self.assertAlmostEqual(centre / row[f"centre_{name}_m"], 1, delta=1e-12)
        # Of the buoyant weight, 120 Pa: at time zero no pressure has been solved for, so the end alone tells.
        # The history weighs the lowest half cell by its solids, here the pressure is continued linearly over it.
        drop, last = openfoam_run.pressure_drop(profiles["p"][-1]), result["rows"][-1]
        self.assertAlmostEqual(drop / last["pressure_drop_Pa"], 1, delta=0.5 * height / last["bed_height_m"])

    def test_a_written_field_is_read_back(self):
        values = np.arange(6.0).reshape(3, 2) / 7
        openfoam_cases.write_field(self.directory, "a", "0 0 0 0", values, {"others": {"type": "zeroGradient"}})
        openfoam_cases.write_field(self.directory, "b", "0 0 0 0", 0.25, {"others": {"type": "zeroGradient"}})
        read = openfoam_run.read_scalar(self.directory / "0/a", (2, 3))
        np.testing.assert_allclose(read, values, rtol=1e-11)  # twelve digits are written
        np.testing.assert_array_equal(openfoam_run.read_scalar(self.directory / "0/b", (2, 3)), np.full((3, 2), 0.25))
        with self.assertRaises(openfoam_run.Failed):
            openfoam_run.read_scalar(self.directory / "0/a", (3, 3))

    def test_start_cuts_the_cell_at_the_top(self):
        bed = {"cells": (2, 4), "size": (1.0, 2.0), "height": 1.25}
        phi = openfoam_cases.start_fractions(bed, {"fraction": 0.6})
        np.testing.assert_allclose(phi[:, 0], [0.6, 0.6, 0.3, 0], atol=1e-15)

    def test_log(self):
        (self.directory / "log").write_text(LOG)
        log = openfoam_run.read_log(self.directory / "log", {"fine": 0.25})
        self.assertEqual(log["steps"], 2)
        self.assertAlmostEqual(log["volume_change"]["fine"], 0.04)  # only the last value of a step counts
        self.assertAlmostEqual(log["phase_sum_error"], 6e-8)
        self.assertAlmostEqual(openfoam_run.cpu_between(log["clock"], 0.1, 0.2), 1.5)

    def test_a_bed_faster_than_its_liquid_is_wrong(self):
        phase = {"plug": True, "bed": {"velocity": 0.03}}
        rows = [{"time_s": 0.0, "bed_height_m": 0.066}, {"time_s": 0.5, "bed_height_m": 0.0804}]
        self.assertIsNone(tfm_peers.too_fast(phase, {"failed": None, "measures": rows}))
        rows[1]["bed_height_m"] = 0.109
        self.assertIn("2.9 times", tfm_peers.too_fast(phase, {"failed": None, "measures": rows}))

    def test_says_what_to_install(self):
        run = subprocess.run([sys.executable, Path(SCRIPTS) / "tfm_peers.py", PROGRAM], capture_output=True, text=True,
                             env=os.environ | {"PATH": str(self.directory)})
        self.assertEqual(run.returncode, 2)
        self.assertIn("apt-get install", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
