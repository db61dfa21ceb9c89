#!/usr/bin/python3
"""polybed compare on several ranks: both models one after the other, and one answer. Usage: compare_ranks_test.py PROGRAM"""
import os
import pathlib
import subprocess
import sys

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "cli")]
import open_mpi  # noqa: E402
import program  # noqa: E402
from program import DONE, FILE, Scratch, main, strict_json  # noqa: E402

from compare_test import BED  # noqa: E402

CLOSE = 1e-3  # relative: ten times tfm.rtol, which is that of the TFM's steps and of its pressure


class CompareOnRanks(Scratch):
    def setUp(self):
        super().setUp()
        self.case = self.write("case.toml", BED)

    def on(self, ranks, *words, code=DONE, start=("mpirun", "-q", "-n")):
        settings = os.environ | open_mpi.SETTINGS | open_mpi.MORE_THAN_CORES
        begin = [*start, str(ranks), *([] if program.PROGRAM in start else [program.PROGRAM])]
        done = subprocess.run([*begin, "compare", self.case, "--json", "--no-picture",
                               "--quiet", "--until", "4 ms", "-o", self.folder / f"on-{ranks}", *words], env=settings,
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stderr[-1500:])
        return done

    def test_two_say_the_same_as_one(self):
        one, two = (strict_json(self.on(ranks).stdout) for ranks in (1, 2))
        for model in ("tfm", "dem"):
            self.assertEqual(two["models"][model]["ranks"], 2)
            for name in ("bed_height_m", "centre_fine_m", "centre_coarse_m"):
                value = one["measures"][name][model]
                self.assertAlmostEqual(two["measures"][name][model], value, delta=CLOSE * value)
        self.assertEqual(one["window"]["end_s"], two["window"]["end_s"])

    def test_the_program_starts_its_runs_on_ranks(self):
        found = strict_json(self.on(3, "--until", "1 ms", start=(program.PROGRAM, "-n")).stdout)
        self.assertEqual([found["models"][model]["ranks"] for model in ("tfm", "dem")], [3, 3])

    def test_what_the_first_rank_alone_reads_ends_all(self):
        told = self.on(2, "--dem", self.folder / "nowhere", code=FILE).stderr
        self.assertEqual(told.count("nowhere: no run"), 1)


if __name__ == "__main__":
    main()
