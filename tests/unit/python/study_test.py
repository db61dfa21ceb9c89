#!/usr/bin/python3
"""What studies share: means that the program takes, drifts, folders and children. Usage: study_test.py PROGRAM PACKAGE_DIRECTORY"""

import os
import signal
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
from polybed.quantities import Named  # noqa: E402
from polybed.folder import drift_lines  # noqa: E402
from polybed.runner import asked, run_within  # noqa: E402
from polybed.study.output import subfolder, taken, writes  # noqa: E402
from polybed.study.measured import Window, means_of, species_of, statistics_of, within  # noqa: E402
from stored_run import Written  # noqa: E402


class Means(unittest.TestCase):
    TIME = np.linspace(0, 100, 401)

    def written(self, **columns):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return Written({"time_s": self.TIME, "bed_height_m": 0.1 + 0 * self.TIME} | columns).into(folder.name)

    def test_of_a_run(self):
        """A straight line from 0 to 100 over the window's rows: the rule drops at most half of them; another window is as it is asked for."""
        run = self.written(bed_height_m=1e-3 * self.TIME)
        window, [found], distances = means_of(run.directory)
        self.assertTrue(window.shortened)
        self.assertAlmostEqual(window.begin, 87.5, delta=0.3)
        self.assertEqual(distances, {})
        window, [found], _ = means_of(run.directory, begin=50)
        self.assertEqual(window, (50, 100, False))
        self.assertEqual((found.rows, found.step, found.profiles), (201, 0.25, 0))
        self.assertAlmostEqual(found.means["bed_height_m"].mean, 0.075, delta=1e-15)

    def test_of_too_little(self):
        self.TIME = self.TIME[:1]
        with self.assertRaisesRegex(ending.FAULTS, "too short"):
            means_of(self.written().directory)

    def test_of_numbers(self):
        """Of 1 4 2 8 5 7 the squares about 4.5 add up to 37.5. Sums 6 over 12, and of three of four pairs 5 4 4 5 over 9 each: 5/9, 4/9
        vary by 1/18 about 1/2, times 3/4 of four squares."""
        found = statistics_of([[1, 4, 2, 8, 5, 7], [1, np.nan], []], [([1, 2, 2, 1], [3, 3, 3, 3])])
        first, *rest = found["series"]
        self.assertEqual(rest, [None, None])
        self.assertEqual((first["mean"], first["interval"]), (4.5, None))
        self.assertAlmostEqual(first["interval_of_repeats"], 2.571 * np.sqrt(37.5 / 5 / 6), delta=1e-14)
        self.assertAlmostEqual(first["deviation"], 2.5, delta=1e-15)
        [ratio] = found["ratios"]
        self.assertEqual(ratio["value"], 0.5)
        self.assertAlmostEqual(ratio["interval"], 3.182 * np.sqrt(3 / 4 * 4) / 18, delta=1e-14)

    def test_columns(self):
        history = Named("history.csv", {"time_s": self.TIME, "centre_a_m": self.TIME, "centre_b_m": self.TIME})
        self.assertEqual(species_of(history), ["a", "b"])
        for end in (100, np.inf):
            self.assertEqual(within(self.TIME, self.TIME, Window(75, end))[0], 75)
        self.assertEqual(len(within(np.empty(0), np.empty(0), Window(75, 100))), 0)
        with self.assertRaisesRegex(ending.FAULTS, "history.csv .* mixing"):
            history["mixing"]


class Drifts(unittest.TestCase):
    def test_what_the_program_finds_not_steady_is_told(self):
        self.assertEqual(drift_lines({"drift": {"lines": ["not steady"]}}), ["not steady"])
        self.assertEqual(drift_lines({}), [])
        with self.assertRaisesRegex(ending.FAULTS, "run.json is damaged"):
            drift_lines({"drift": {"lines": 1}})


class Folders(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "folder"

    def refused(self, code):
        """What the program says of it: tests/cli/directories_test.py."""
        with self.assertRaises(ending.StudyError) as caught, taken(self.folder):
            pass
        self.assertEqual((caught.exception.code, str(caught.exception)), (code, ""))

    def test_one_process_at_a_time(self):
        with taken(self.folder):
            self.assertRegex((self.folder / ".polybed").read_text(), "process [0-9]+ on")
            self.assertTrue(writes(self.folder))
            self.refused(ending.FILE)
        self.assertFalse(self.folder.exists(), "nothing was written")
        with taken(self.folder):
            pass

    def test_what_is_not_polybeds_is_kept(self):
        self.folder.mkdir()
        (self.folder / "notes.txt").write_text("mine")
        self.refused(ending.WRONG_CASE)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["notes.txt"])

    def test_no_link_is_followed(self):
        asked("mark", folder=self.folder)
        (self.folder / "runs").symlink_to("..")
        with self.assertRaisesRegex(ending.StudyError, "it is a link"):
            subfolder(self.folder, "runs")

    def test_a_child_is_ended_when_its_time_is_over(self):
        output = Path(str(self.folder) + ".txt")
        self.assertEqual(run_within(60, ["--version"], output)[:2], (0, False))
        self.assertIn("polybed", output.read_text())
        self.assertEqual(run_within(60, ["nonsense"], output).code, ending.WRONG_CASE)
        sleeping = self.folder.parent / "sleeping"
        sleeping.write_text("#!/bin/sh\nexec sleep 60\n")
        sleeping.chmod(0o755)
        begin, os.environ["POLYBED"] = time.monotonic(), str(sleeping)
        try:
            end = run_within(0.2, [], output)
        finally:
            os.environ["POLYBED"] = PROGRAM
        self.assertEqual(end[:2], (128 + signal.SIGKILL, True))
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
