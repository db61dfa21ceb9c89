#!/usr/bin/python3
"""What cases/drafting-kissing-tumbling/events.py finds in made motions: spheres_events_test.py FOLDER_OF_THE_CASE"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

FOLDER = Path(sys.argv[1])
sys.path[:0] = [str(FOLDER)]
sys.dont_write_bytecode = True

import events

DIAMETER = 0.015


def motion(closing, parting):
    """Two spheres 30 mm apart in line: the gap closes at 50 mm/s after `closing`, they part sideways at 20 mm/s."""
    time = np.linspace(0, 2, 201)
    position = np.zeros((201, 2, 3))
    position[:, :, 1] = 1.0  # over the floor
    position[:, 1, 1] += np.maximum(0.030 - 0.05 * np.maximum(0, time - closing), DIAMETER)
    position[:, 1, 0] = 1.5e-4 + 0.02 * np.maximum(0, time - parting)
    return time, position


class Events(unittest.TestCase):
    def test_times(self):
        """By hand: the gap of 15 mm is below 0.9 of itself after 30 ms and closed after 300 ms, within 1e-3 diameters
        0.3 ms before; 7.5 mm aside 367.5 ms after the parting begins; stored each 10 ms."""
        found = events.events(*motion(0.1, 0.5), DIAMETER)
        self.assertAlmostEqual(found["drafting"], 0.14, delta=0.011)
        self.assertAlmostEqual(found["kissing"], 0.40, delta=0.011)
        self.assertAlmostEqual(found["tumbling"], 0.87, delta=0.011)

    def test_what_is_missing(self):
        time, position = motion(0.1, 3.0)
        self.assertIsNone(events.events(time, position, DIAMETER)["tumbling"])
        self.assertIsNone(events.events(time, position * [1, 1.5, 1], DIAMETER)["kissing"])

    def test_what_happens_on_the_floor_does_not_count(self):
        time, position = motion(0.1, 0.5)
        position[:, :, 1] -= np.where(time > 0.2, 0.99, 0)[:, None]  # the lower one at 10 mm, a diameter is 15 mm
        found = events.events(time, position, DIAMETER)
        self.assertAlmostEqual(found["drafting"], 0.14, delta=0.011)
        self.assertEqual((found["kissing"], found["tumbling"]), (None, None))

    def ends(self, time, position):
        with tempfile.TemporaryDirectory() as folder:
            with h5py.File(Path(folder) / "particles.h5", "w") as file:
                file["time_s"] = time
                for n, place in enumerate(position):
                    file[f"step/{n + 1:06d}/position"] = place
                    file[f"step/{n + 1:06d}/radius"] = [DIAMETER / 2] * 2
            return subprocess.run([FOLDER / "events.py", folder], stdout=subprocess.DEVNULL).returncode

    def test_the_order_counts(self):
        self.assertEqual(self.ends(*motion(0.1, 0.5)), 0)
        self.assertEqual(self.ends(*motion(0.1, 3.0)), 1)  # they never part
        time, position = motion(1.0, 0.0)
        position[:, 1, 0] = np.minimum(position[:, 1, 0], 0.008)  # aside at 8 mm, then down to 12 mm: they touch at last
        position[time > 1.5, 1, 1] = 1.012
        self.assertNotIn(None, events.events(time, position, DIAMETER).values())
        self.assertEqual(self.ends(time, position), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
