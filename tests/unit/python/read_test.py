#!/usr/bin/python3
"""The Python package on runs that the C++ writers have written: read_test.py WRITER PACKAGE_DIRECTORY"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

WRITER, PACKAGE = sys.argv[1], sys.argv[2]
sys.path.insert(0, PACKAGE)

import polybed
from polybed import plot


class WrittenRun(unittest.TestCase):
    dimensions = 2

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.directory = Path(self.scratch.name) / "bed-tfm"
        subprocess.run([WRITER, self.directory, str(self.dimensions)], check=True)
        self.run_read = polybed.read(self.directory)

    def tearDown(self):
        self.scratch.cleanup()


class Read(WrittenRun):
    def test_fields_by_name(self):
        run = self.run_read
        self.assertEqual(list(run.time), [0, 0.25, 0.5, 0.75, 1])
        self.assertEqual(run.phi_fine[-1].shape, (60, 18))
        self.assertEqual(run.u_fluid[0].shape, (60, 18, 2))
        np.testing.assert_array_equal(run.phi_fine[1:3][0], run.phi_fine[1])
        np.testing.assert_array_equal(run.voidage[2], 1 - run.phi_fine[2] - run.phi_coarse[2])
        heights = (run.faces["y"][1:] + run.faces["y"][:-1]) / 2
        np.testing.assert_allclose(run.u_fluid[0][:, 3, 1], heights, rtol=1e-14)  # rounding of the centres
        self.assertEqual(run.species, ["fine", "coarse"])
        with self.assertRaises(AttributeError):
            run.phi_none
        with self.assertRaises(IndexError):
            run.phi_fine[5]

    def test_links_lead_to_the_steps(self):
        with h5py.File(self.directory / "fields.h5", "r") as file:
            self.assertEqual(sorted(file["step"]), [f"{n:06d}" for n in range(1, 6)])
            self.assertEqual(file["step/000002"].attrs["time_s"], 0.25)
            np.testing.assert_array_equal(file["step/000005/phi_fine"][...], self.run_read.phi_fine[-1])

    def test_xdmf_names_existing_data_of_the_stated_shape(self):
        from xml.etree import ElementTree

        items = ElementTree.parse(self.directory / "fields.xdmf").getroot().iter("DataItem")
        seen = 0
        for item in items:
            name, place = item.text.split(":")
            with h5py.File(self.directory / name, "r") as file:
                data = file[place]
                self.assertEqual(list(data.shape), [int(n) for n in item.get("Dimensions").split()])
                self.assertEqual(data.dtype.itemsize, int(item.get("Precision")))
            seen += 1
        self.assertEqual(seen, 5 * (self.run_read.dimensions + 4))

    def test_history_and_profiles(self):
        run = self.run_read
        np.testing.assert_array_equal(run.history["bed_height_m"], 0.08 + 0.02 * run.time)
        self.assertTrue(np.isnan(run.history["interface_m"]).all())
        self.assertEqual(run.profiles["phi_fine"].shape, (5, 60))
        mean = run.phi_fine[-1].mean(axis=1)
        np.testing.assert_allclose(run.profiles["phi_fine"][-1], mean, rtol=1e-13)  # order of summation
        with open(self.directory / "history.csv", "a") as file:
            file.write("1.25,0.1")
        self.assertEqual(len(run.history["time_s"]), 5)

    def test_unknown_version_is_refused(self):
        with h5py.File(self.directory / "fields.h5", "r+") as file:
            file.attrs["version"] = 99
        with self.assertRaises(polybed.FormatError):
            polybed.read(self.directory)


class Picture(WrittenRun):
    def test_is_drawn(self):
        path = plot.picture(self.directory, time=0.5)
        self.assertEqual(path, self.directory / "picture.png")
        self.assertEqual(path.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_an_early_run_without_profiles_and_history_is_drawn(self):
        for name in ("profiles.h5", "history.csv", "run.json"):
            (self.directory / name).unlink()
        self.assertTrue(plot.picture(self.directory).exists())

    def test_a_directory_without_fields_is_an_error(self):
        with tempfile.TemporaryDirectory() as empty:
            self.assertEqual(plot.main([empty]), 4)


class Picture3D(WrittenRun):
    dimensions = 3

    def test_is_drawn(self):
        self.assertEqual(self.run_read.u_fluid[0].shape, (4, 60, 18, 3))
        self.assertTrue(plot.picture(self.directory).exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
