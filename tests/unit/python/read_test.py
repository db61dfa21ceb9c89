#!/usr/bin/python3
"""The Python package on runs that the C++ writers have written: read_test.py WRITER PACKAGE_DIRECTORY"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

import h5py
import numpy as np

WRITER, PACKAGE = sys.argv[1], sys.argv[2]
sys.path.insert(0, PACKAGE)

import polybed  # noqa: E402
from polybed import errors  # noqa: E402


def described(directory, xdmf):
    """How many data an XDMF file names; fails unless each is there with the shape and the type that it states."""
    count = 0
    for item in ElementTree.parse(directory / xdmf).getroot().iter("DataItem"):
        name, place = item.text.split(":")
        with h5py.File(directory / name, "r") as file:
            data = file[place]
            assert list(data.shape) == [int(n) for n in item.get("Dimensions").split()], item.text
            assert data.dtype.itemsize == int(item.get("Precision")), item.text
            assert data.dtype.kind == {"Float": "f", "Int": "i"}[item.get("NumberType")], item.text
        count += 1
    return count


class WrittenRun(unittest.TestCase):
    kind = 2  # dimensions of fields, or what else write_sample_run writes

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.directory = Path(self.scratch.name) / "bed-tfm"
        subprocess.run([WRITER, self.directory, str(self.kind)], check=True)
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
        for ask in (lambda: run.phi_fine[5], lambda: run.fields_at(-6, ["voidage"])):
            with self.assertRaisesRegex(errors.NoStepError, "has 5 stored steps, from 0 on, none numbered"):
                ask()
        np.testing.assert_array_equal(run.fields_at(-1, ["voidage"])["voidage"], run.voidage[4])

    def test_links_lead_to_the_steps(self):
        with h5py.File(self.directory / "fields.h5", "r") as file:
            self.assertEqual(sorted(file["step"]), [f"{n:06d}" for n in range(1, 6)])
            self.assertEqual(file["step/000002"].attrs["time_s"], 0.25)
            np.testing.assert_array_equal(file["step/000005/phi_fine"][...], self.run_read.phi_fine[-1])

    def test_xdmf_names_existing_data_of_the_stated_shape(self):
        self.assertEqual(described(self.directory, "fields.xdmf"), 5 * (self.run_read.dimensions + 4))

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
        kept = (self.directory / "history.csv").read_text().rpartition("\n")[0] + "\n"
        cells = kept.split("\n")[-2].split(",")
        for damaged in ("inf", "nan", "1e999", "0.1x", "0"):  # the last: an earlier time
            (self.directory / "history.csv").write_text(kept + ",".join([damaged, *cells[1:]]) + "\n")
            with self.assertRaisesRegex(polybed.FormatError, "history.csv is damaged"):
                print(run.history)

    def test_unknown_version_is_refused(self):
        with h5py.File(self.directory / "fields.h5", "r+") as file:
            file.attrs["version"] = 99
        with self.assertRaises(polybed.FormatError):
            polybed.read(self.directory)


class ReadParticles(WrittenRun):
    kind = "particles"

    def test_particles_by_name(self):
        particles = self.run_read.particles
        self.assertEqual(list(particles.time), [0, 0.25, 0.5, 0.75, 1])
        self.assertEqual(list(particles.count), [300, 299, 298, 297, 296])
        self.assertEqual(particles.species, ["fine", "coarse"])
        self.assertEqual(list(particles.size), [0.06, 0.2, 0.008])
        self.assertEqual(list(particles.periodic), [False, False, True])
        step = particles[-1]
        self.assertEqual((step.time, len(step)), (1, 296))
        self.assertEqual(list(step.id), list(range(4, 300)))
        self.assertEqual(step.id.dtype, np.int64)
        self.assertEqual(step.position.shape, (296, 3))
        np.testing.assert_array_equal(step.radius[step.of("coarse")], 0.002)
        np.testing.assert_array_equal(step.velocity, np.tile([0, 0.02, 0], (296, 1)))
        np.testing.assert_array_equal(step.spin[:, 2], step.id)
        # the lowest row, at 2 mm, has risen by 20 mm/s for 1 s
        self.assertAlmostEqual(step.position[:, 1].min(), 0.022, places=15)
        self.assertEqual([particles.step_at(t) for t in (0, 0.3, 9)], [0, 1, 4])

    def test_nothing_is_read_before_it_is_asked_for(self):
        step = self.run_read.particles[2]
        step.radius
        (self.directory / "particles/000003.h5").unlink()
        self.assertEqual(len(step.radius), 298)
        with self.assertRaises(OSError):
            step.position

    def test_what_is_not_there_is_told(self):
        particles = self.run_read.particles
        for step in (5, -6):
            with self.assertRaisesRegex(IndexError, "5 steps of particles"):
                particles[step]
        with self.assertRaisesRegex(AttributeError, "position"):
            particles[0].colour
        with self.assertRaisesRegex(KeyError, "coarse"):
            particles[0].of("medium")

    def test_the_run_without_fields(self):
        run = self.run_read
        self.assertEqual((len(run.time), run.fields, run.dimensions), (0, [], 0))
        self.assertEqual(run.species, ["fine", "coarse"])
        self.assertEqual(run.size, (0.06, 0.2))
        volume = run.profiles["phi_coarse"][0].sum() * 0.06 * 0.008 * 0.2 / 60
        radius = run.particles[0].radius[run.particles[0].of("coarse")]
        self.assertAlmostEqual(volume / (4 / 3 * np.pi * radius**3).sum(), 1, delta=1e-13)  # rounding of 60 slabs

    def test_unknown_versions_are_refused(self):
        with h5py.File(self.directory / "particles/000002.h5", "r+") as file:
            file.attrs["version"] = 99
        with self.assertRaises(polybed.FormatError):
            self.run_read.particles[1].radius
        with h5py.File(self.directory / "particles.h5", "r+") as file:
            file.attrs["filetype"] = "polybed fields"
        with self.assertRaises(polybed.FormatError):
            polybed.read(self.directory)

    def test_links_lead_to_the_steps(self):
        with h5py.File(self.directory / "particles.h5", "r") as file:
            self.assertEqual(sorted(file["step"]), [f"{n:06d}" for n in range(1, 6)])
            self.assertEqual(file["step/000002"].attrs["time_s"], 0.25)
            self.assertEqual(list(file["step/000002"].attrs["species_names"]), ["fine", "coarse"])
            np.testing.assert_array_equal(file["step/000005/position"][...], self.run_read.particles[-1].position)

    def test_xdmf_names_existing_data_of_the_stated_shape(self):
        self.assertEqual(described(self.directory, "particles.xdmf"), 5 * 7)


class ReadBoth(WrittenRun):
    kind = "coupled"

    def test_fields_and_particles(self):
        run = self.run_read
        self.assertEqual((len(run.time), len(run.particles)), (5, 5))
        self.assertEqual(run.species, ["fine", "coarse"])
        self.assertEqual(run.phi_fine[0].shape, (60, 18))

    def test_what_is_stored_later_is_seen(self):
        later = self.directory.with_name("later")
        self.directory.rename(later)
        self.directory.mkdir()
        run = polybed.read(self.directory)
        self.assertEqual((run.names("fields"), run.species, run.size, len(run.time), len(run.particles)), ([], [], (0, 0), 0, 0))
        later.rename(self.directory)
        self.assertEqual((len(run.time), len(run.particles), run.species, run.size), (5, 5, ["fine", "coarse"], (0.06, 0.2)))
        self.assertIn("phi_fine", run.names("fields"))


class ReadThreeDimensions(WrittenRun):
    kind = 3

    def test_fields_have_a_depth(self):
        self.assertEqual(self.run_read.u_fluid[0].shape, (4, 60, 18, 3))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
