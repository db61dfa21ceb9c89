#!/usr/bin/python3
"""What studies share: means over time, windows, drifts, folders and children. Usage: study_test.py PROGRAM PACKAGE_DIRECTORY"""

import os
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

PROGRAM, PACKAGE = sys.argv[1:3]
sys.path.insert(0, PACKAGE)
os.environ["POLYBED"] = PROGRAM

from polybed import ending  # noqa: E402
from polybed.record import drift_lines  # noqa: E402
from polybed.runner import run_within  # noqa: E402
from polybed.study import output_folder  # noqa: E402
from polybed.study.measured import (Columns, Profile, Window, WindowProfiles, centre_difference, measures_of, ratio, species_of, window_of,  # noqa: E402
                                    within)
from polybed.study.time_mean import (autocorrelation_time, groups_left_out, jackknife_error, rows_to_drop, student_quantile,  # noqa: E402
                                     time_mean)


def autoregressive(rows, rho, random):
    """x_k = rho x_k-1 + noise, of variance 1 and mean 0; its autocorrelation time is (1 + rho) / (1 - rho)."""
    x = random.normal(size=rows)
    x[1:] *= np.sqrt(1 - rho * rho)
    for k in range(1, rows):
        x[k] += rho * x[k - 1]
    return x


class TimeMeans(unittest.TestCase):
    """How often an interval has the truth is K2 of `polybed cost selftest`."""

    def test_autocorrelation_time_of_an_autoregressive_series(self):
        random = np.random.default_rng(2)
        # 2 sigma: tau sqrt(2 (2 x 47 + 1) / n), Sokal 1997
        self.assertAlmostEqual(autocorrelation_time(autoregressive(200000, 0.9, random)), 19, delta=1.2)
        self.assertAlmostEqual(autocorrelation_time(autoregressive(200000, 0.0, random)), 1, delta=0.03)

    def test_by_hand(self):
        """10 batches of two rows of a straight line: means 0.5, 2.5 ... 18.5, their variance 4 x 55/6; its correlation makes it wider."""
        mean = time_mean(np.arange(20))
        self.assertEqual(mean.mean, 9.5)
        self.assertGreaterEqual(mean.error, 2.262 * np.sqrt(4 * 55 / 6 / 10))
        # Rows that alternate: all batches have the mean 0.5, so the variance of the rows decides.
        self.assertAlmostEqual(time_mean(np.arange(20) % 2).error, 2.093 * np.sqrt(5 / 19 / 20), delta=1e-12)

    def test_of_what_does_not_fluctuate_and_of_too_little(self):
        self.assertEqual(time_mean([0.1] * 100)[:2], (0.1, 0))
        self.assertIsNone(time_mean([1.0] * 19).error)
        self.assertIsNone(time_mean([]))
        self.assertIsNone(time_mean([1, np.nan]))

    def test_students_quantile_is_never_too_small(self):
        self.assertEqual([student_quantile(n) for n in (9, 15, 1000)], [2.262, 2.228, 2.093])  # of 15: that of 10; 2.131 in tables
        with self.assertRaises(ValueError):
            student_quantile(2)

    def test_the_rule_drops_a_transient(self):
        x = autoregressive(400, 0.0, np.random.default_rng(3))
        x[:100] += 20 * np.exp(-np.arange(100) / 20)
        # After 60 rows the transient is 1, one standard deviation; after 100 it is over.
        self.assertTrue(50 < rows_to_drop(x) <= 110)
        self.assertEqual(rows_to_drop(np.arange(100)), 50)  # never more than half
        self.assertEqual(rows_to_drop([1, np.nan, 1, 1, 1]), 0)

    def test_the_jackknife_of_a_mean_is_the_variance_of_the_mean(self):
        x = np.array([1, 4, 2, 8, 5, 7])  # the sum of squares about 4.5 is 37.5
        without = [x[kept].mean() for kept in groups_left_out(6)]
        self.assertAlmostEqual(jackknife_error(without), 2.571 * np.sqrt(37.5 / 5 / 6), delta=1e-14)
        self.assertEqual(len(groups_left_out(3)), 0)
        self.assertIsNone(jackknife_error([1, 2, 3]))
        self.assertIsNone(jackknife_error([1, 2, 3, None, 5]))
        groups = groups_left_out(23)  # ten groups of two or three rows, each row in one of them
        self.assertEqual(groups.shape, (10, 23))
        self.assertTrue(((~groups).sum(axis=0) == 1).all())


class Windows(unittest.TestCase):
    TIME = np.linspace(0, 100, 401)

    def history(self, height):
        return Columns("history.csv", {"time_s": self.TIME, "bed_height_m": height, "centre_a_m": 0.2 * height, "centre_b_m": 0.7 * height})

    def test_the_last_quarter_of_what_both_have(self):
        steady = self.history(0.1 + 0 * self.TIME)
        self.assertEqual(window_of(steady), (75, 100, False))
        short = Columns("history.csv", {name: column[:161] for name, column in steady.items()})  # to 40 s
        self.assertEqual(window_of(steady, short), (30, 40, False))
        with self.assertRaises(ending.FAULTS):
            window_of(steady, Columns("history.csv", {name: column[:1] for name, column in steady.items()}))
        with self.assertRaises(ending.FAULTS):
            window_of(Columns("history.csv", {"time_s": np.empty(0)}))

    def test_a_bed_that_still_rises_has_a_shorter_one(self):
        window = window_of(self.history(0.1 + 1e-3 * self.TIME))
        self.assertTrue(window.shortened)
        self.assertAlmostEqual(window.begin, 87.5, delta=0.3)  # at most half of the window is dropped

    def test_columns(self):
        history = self.history(0.1 + 0 * self.TIME)
        self.assertEqual(species_of(history), ["a", "b"])
        np.testing.assert_allclose(centre_difference(history, ["a", "b"]), 0.5)
        self.assertEqual(len(centre_difference(history, ["a"])), 0)
        np.testing.assert_equal(ratio(np.array([1.0, 2.0, 3.0]), np.array([2.0, 0.0, -1.0])), [0.5, np.nan, np.nan])
        for end in (100, np.inf):
            self.assertEqual(within(self.TIME, self.TIME, Window(75, end))[0], 75)
        self.assertEqual(len(within(np.empty(0), np.empty(0), Window(75, 100))), 0)
        with self.assertRaisesRegex(ending.FAULTS, "history.csv .* mixing"):
            history["mixing"]

    def test_profiles_in_the_window(self):
        """The first of 24 profiles in the window has 0.24 more: 0.01 in the mean."""
        stored = np.full((96, 3), 0.2)
        stored[72, 0] += 0.24
        profiles = Columns("profiles.h5", {"time_s": np.arange(96.0), "y_m": np.array([0.5, 1.5, 2.5]), "phi_a": stored})
        found = WindowProfiles(profiles, ["a"], Window(72, 95))
        self.assertEqual((found.count(), found.slab), (24, 1))
        np.testing.assert_allclose(found.mean().fraction, [[0.21, 0.2, 0.2]])
        means = found.time_means()[0]
        self.assertAlmostEqual(means[0].mean, 0.21)
        self.assertAlmostEqual(means[0].error, jackknife_error([0.2 + (0.24 / kept.sum() if kept[0] else 0) for kept in groups_left_out(24)]))
        self.assertLess(means[1].error, 1e-15)
        self.assertEqual(WindowProfiles(profiles, ["a"], Window(200, 300)).time_means(), [[]])

    def test_measures_are_those_of_the_program(self):
        profile = Profile(1e-3, np.array([[0.5] * 20 + [0.0] * 20]))
        found = measures_of([profile, profile], ["a"], on=(2e-3, 20), reference=profile)
        np.testing.assert_allclose(found["measures"]["centre_a"]["values"], [0.01, 0.01])
        self.assertEqual(found["distances"]["profile"], [0, 0])
        self.assertEqual(Profile.of(found["profiles"][0]).fraction.shape, (1, 20))


class Drifts(unittest.TestCase):
    def test_what_the_program_finds_not_steady_is_told(self):
        still, rising = ({"name": name, "rate_m_per_s": 1e-4, "error_m_per_s": 1e-6, "steady": steady} for name, steady in
                         (("bed_height", True), ("centre_a", False)))
        self.assertEqual(drift_lines({"drift": {"window_s": 10, "measures": [still, rising]}}),
                         ["not steady: drift of centre_a 0.1 ± 0.001 mm/s over the last 10 s"])
        self.assertEqual(drift_lines({}), [])
        with self.assertRaisesRegex(ending.FAULTS, "run.json is damaged"):
            drift_lines({"drift": {"measures": [rising]}})


class Folders(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "folder"

    def refused(self, code, text):
        with self.assertRaisesRegex(ending.StudyError, text) as caught, output_folder.taken(self.folder):
            pass
        self.assertEqual(caught.exception.code, code)

    def test_one_process_at_a_time(self):
        with output_folder.taken(self.folder):
            self.assertIn(f"process {os.getpid()} on", (self.folder / ".polybed").read_text())
            self.refused(ending.FILE, f"process {os.getpid()} on .* writes into it")
        with output_folder.taken(self.folder):
            pass

    def test_what_is_not_polybeds_is_kept(self):
        self.folder.mkdir()
        (self.folder / "notes.txt").write_text("mine")
        self.refused(ending.WRONG_CASE, "notes.txt for one")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["notes.txt"])
        (self.folder / "cost.json").write_text('{"filetype": "polybed cost"}')  # of a version without marks
        with output_folder.taken(self.folder):
            self.assertEqual((self.folder / "notes.txt").read_text(), "mine")

    def test_no_link_is_followed(self):
        self.folder.mkdir()
        (self.folder / ".polybed").symlink_to("elsewhere")
        self.refused(ending.WRONG_CASE, "has not written")
        self.assertFalse((self.folder / "elsewhere").exists())
        (self.folder / ".polybed").unlink()
        output_folder.mark_folder(self.folder)
        os.link(self.folder / ".polybed", self.folder / "second-name")
        self.refused(ending.FILE, "no plain file")
        (self.folder / "runs").symlink_to("..")
        with self.assertRaisesRegex(ending.StudyError, "it is a link"):
            output_folder.subfolder(self.folder, "runs")

    def test_a_child_is_ended_when_its_time_is_over(self):
        output = Path(str(self.folder) + ".txt")
        self.assertEqual(run_within(60, ["--version"], 1, output)[:2], (0, False))
        self.assertIn("polybed", output.read_text())
        self.assertEqual(run_within(60, ["nonsense"], 1, output).code, ending.WRONG_CASE)
        sleeping = self.folder.parent / "sleeping"
        sleeping.write_text("#!/bin/sh\nexec sleep 60\n")
        sleeping.chmod(0o755)
        begin, os.environ["POLYBED"] = time.monotonic(), str(sleeping)
        try:
            end = run_within(0.2, [], 1, output)
        finally:
            os.environ["POLYBED"] = PROGRAM
        self.assertEqual(end[:2], (128 + 15, True))
        self.assertLess(time.monotonic() - begin, 5)


class Endings(unittest.TestCase):
    def test_exit_codes(self):
        def ends(error):
            def work():
                raise error
            return ending.guarded(work)
        self.assertEqual(ending.guarded(lambda: 3), 3)
        self.assertEqual(ends(ending.StudyError(ending.NUMBERS, "text")), 3)
        self.assertEqual(ends(FileNotFoundError(2, "none", "path")), 4)
        self.assertEqual(ends(KeyboardInterrupt()), 130)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
