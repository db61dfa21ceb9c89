#!/usr/bin/python3
"""The page of a run whose species have size classes or leave the column: report_classes_test.py WRITER PACKAGE_DIRECTORY"""

import sys
import types
import unittest

import h5py
import numpy as np

from report_pages import data_of
from report_test import SampleRun, unpacked  # which adds the package to the path

import polybed
from polybed.drawing import curves
from polybed.report import beds, series


def renamed(text):
    return text.replace("fine", "sand.1").replace("coarse", "sand.2")


class SizeClasses(SampleRun):
    """The sample run with its two species renamed to two size classes of one, for which the page shows their sums."""

    def setUp(self):
        super().setUp()
        for path in self.directory.rglob("*.h5"):
            with h5py.File(path, "r+") as file:
                group = file.get("step", file)
                for name in [name for name in group if name.endswith(("_fine", "_coarse"))]:
                    group.move(name, renamed(name))
        path = self.directory / "history.csv"
        head, _, rows = path.read_text().partition("\n")
        path.write_text(f"{renamed(head)}\n{rows}")
        self.sample = polybed.read(self.directory)

    def test_maps(self):
        self.assertEqual(self.sample.kinds, {"sand": ["sand.1", "sand.2"]})
        maps = data_of(self.page())["maps"]
        self.assertEqual([(m["label"], m["kind"]) for m in maps["maps"]], [("sand", "solids"), ("fluid", "voidage"), ("fluid", "velocity")])
        self.assertIn("size classes", maps["note"])
        levels = unpacked(maps["maps"][0]["levels"], np.uint8).reshape(5, maps["ny"], maps["nx"])
        high = maps["maps"][0]["high"]
        exact = (self.sample.field("phi_sand.1")[:] + self.sample.field("phi_sand.2")[:])[:, : maps["ny"]]
        # the scale is that of the later half: what is denser at the start has its upper end
        np.testing.assert_allclose(levels / (series.EMPTY - 1) * high, np.minimum(exact, high), atol=0.501 * high / (series.EMPTY - 1))

    def test_profiles(self):
        fractions = data_of(self.page())["profiles"]["charts"][0]
        self.assertEqual([line["label"] for line in fractions["lines"]], ["sand", "voidage"])
        sand, voidage = (unpacked(line["y"], np.uint8).view("<u2") for line in fractions["lines"])
        np.testing.assert_allclose(sand / 65534 + voidage / 65534, 1, atol=2 / 65534)

    def test_velocities_are_means_weighted_with_the_fractions(self):
        # 0.1 at 3 m/s and 0.3 at 1 m/s: (0.3 + 0.3)/0.4 = 1.5 m/s; nothing: 0
        np.testing.assert_allclose(curves.mean_over([np.array([3.0, 3]), np.array([1.0, 1])], [np.array([0.1, 0]), np.array([0.3, 0])]), [1.5, 0])


class KindsOfParticles(SampleRun):
    kind = "particles"

    def test_size_classes_share_a_colour_and_a_name(self):
        with h5py.File(self.directory / "particles.h5", "r+") as file:
            file.attrs["species_names"] = [renamed(name) for name in file.attrs["species_names"]]
        found = data_of(self.page())["particles"]
        self.assertEqual((found["names"], len(found["colours"])), (["sand"], 1))
        self.assertEqual(set(unpacked(found["species"], np.uint8)), {0})
        np.testing.assert_array_equal(beds.kind_numbers(["sand.1", "sand.2", "fines", "silt.1", "silt.2"]), [0, 0, 1, 2, 2])


class Outflow(unittest.TestCase):
    """A bed of 2 kg that loses 0.1 kg/s, of which as much is fed: after 10 s, 1 kg of 3 kg has left."""

    def setUp(self):
        t = np.linspace(0, 10, 101)
        self.history = {"time_s": t, "mass_fine_kg": np.full(101, 2.0), "in_fine_kg": 0.1 * t, "out_fine_kg": 0.1 * t}

    def test_recovery_and_rate(self):
        self.assertAlmostEqual(curves.recovery(self.history, ["fine"])["fine"][-1], 1 / 3)
        time_of, rate = curves.discharge_rate(self.history, ["fine"])
        np.testing.assert_allclose(rate, 0.1)
        self.assertAlmostEqual(time_of[0], 10 / curves.PARTS / 2)

    def test_nothing_leaves(self):
        self.history["out_fine_kg"] *= 0
        self.assertEqual(curves.mass_out(self.history, ["fine"]), {})
        self.assertEqual(len(curves.discharge_rate(self.history, ["fine"])[0]), 0)

    def test_panels(self):
        run = types.SimpleNamespace(history=self.history, species=["fine"], kinds={"fine": ["fine"]})
        self.assertEqual([panel.label for panel in curves.outflow(run)], ["left the column (kg)", "recovery", "discharge rate (g/s)"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
