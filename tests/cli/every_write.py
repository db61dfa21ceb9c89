#!/usr/bin/python3
"""Every call by which a short run changes files is made to fail, one run each: the run ends well or with code 4, what it
says of itself is true, and it goes on from its last checkpoint. Usage: every_write.py PROGRAM LIBRARY"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import program
from program import DONE, FILE, Scratch, same_bits, small_bed, strict_json

LIBRARY = os.path.abspath(sys.argv.pop(2))
EVERY = ["--set", "output.every=0.0005", "--set", "output.history_every=0.0005", "--set", "output.checkpoint_every=0.0005"]
RECORDED = "run.json"


class EveryWrite(Scratch):
    def setUp(self):
        super().setUp()
        self.case = self.write("case.toml", small_bed("0.001 s"))  # three outputs, two checkpoints, and steps between them

    def words(self, model, directory):
        return [model, self.case, *EVERY, "--quiet", "--no-picture", "-o", directory]

    def under(self, directory, number, *words, on=False, ranks=1):
        """A run whose call of this number fails, and with `on` all behind it."""
        log = directory.with_suffix(".log")
        settings = {"LD_PRELOAD": LIBRARY, "FAIL_UNDER": str(directory), "FAIL_AT": str(number), "FAIL_LOG": str(log)}
        settings |= {"FAIL_ON": "1"} if on else {}
        with tempfile.TemporaryDirectory() as scratch:
            env = (os.environ | program.open_mpi.SETTINGS if ranks > 1 else program.environment(scratch)) | settings
            start = ["mpirun", "-q", "-n", str(ranks)] if ranks > 1 else []
            done = subprocess.run([*start, program.PROGRAM, *map(str, words)], env=env, capture_output=True, encoding="utf-8",
                                  timeout=program.LONGEST)
        calls = [line.split(" ", 2) for line in log.read_text().splitlines()] if log.exists() else []
        return done, calls

    def judge(self, model, whole, number, on):
        """Returns how a run ended whose call of this number failed."""
        directory = self.folder / f"{model}-{number}{'-on' if on else ''}"
        done, calls = self.under(directory, number, *self.words(model, directory), on=on)
        # A run that a slow machine makes note its progress more often has a call more than others.
        failed = calls[number - 1][1:] if number <= len(calls) else "not reached"
        what = f"{model}, call {number}: {failed}, code {done.returncode}: {done.stderr}"
        record = directory / RECORDED
        state = strict_json(record.read_text())["state"] if record.exists() else "none"
        if done.returncode == DONE:
            self.assertEqual(state, "done", what)
            self.same(whole, directory, what)
        else:
            self.assertEqual(done.returncode, FILE, what)
            self.assertRegex(done.stderr, rf"^cannot (write|remove|make the directory) {directory}.*: (Input/output error|No space left on device)\n$", what)
            self.assertEqual(done.stderr.count("\n"), 1, what)
            begun = any(name == "rename" and path.endswith(RECORDED) for _, name, path in calls[:number - 1])
            allowed = ["none", "running"] if on else ["failed"] if begun else ["failed", "none"]
            self.assertIn(state.split(":")[0], allowed, what)
            self.goes_on(model, whole, directory, what)
        shutil.rmtree(directory, ignore_errors=True)
        return done.returncode, state.split(":")[0]

    def goes_on(self, model, whole, directory, what):
        """To what the run without a failure has written: from a checkpoint, or where none was written yet, anew."""
        again = ["--resume"] if any(directory.glob("checkpoint*.h5")) else ["--force"]
        self.ends(DONE, *self.words(model, directory), *again)
        self.same(whole, directory, what)

    def same(self, whole, directory, what):
        for name in ("history.csv", "steps.csv"):
            if (whole / name).exists():
                self.assertEqual((directory / name).read_bytes(), (whole / name).read_bytes(), what)
        for path in whole.glob("*.h5"):
            self.assertEqual(same_bits(path, directory / path.name), [], f"{path.name}: {what}")

    def whole(self, model):
        directory = self.folder / f"{model}-whole"
        done, calls = self.under(directory, 0, *self.words(model, directory))
        self.assertEqual(done.returncode, DONE, done.stderr)
        return directory, calls

    def try_all(self, model, numbers, calls, whole, on=False):
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            ends = list(pool.map(lambda number: self.judge(model, whole, number, on), numbers))
        tried = Counter(calls[number - 1][1] for number in numbers)
        print(f"{model}{' and all behind it' if on else ''}: {len(numbers)} of {len(calls)} calls, {dict(tried)}; "
              f"ends {dict(Counter(ends))}", flush=True)

    @staticmethod
    def sites(calls):
        """The last call of each kind on each file, the steps of a series being one file."""
        return sorted({(name, re.sub(r"\d{6}", "N", path)): int(number) for number, name, path in calls}.values())

    def test_rows_reach_the_disk_before_a_checkpoint_that_is_later(self):
        for model in ("tfm", "dem"):
            directory, calls = self.whole(model)
            calls = [(name, path.removeprefix(f"{directory}/")) for _, name, path in calls]
            placed = [n for n, call in enumerate(calls) if call == ("rename", "checkpoint.h5")]
            self.assertGreater(len(placed), 1)
            for n in placed:
                before = [name for name, path in calls[:n] if path == "history.csv" and name in ("write", "fsync")]
                self.assertEqual(before[-1], "fsync", model)

    def test_continuum(self):
        whole, calls = self.whole("tfm")
        self.try_all("tfm", range(1, len(calls) + 1), calls, whole)
        self.try_all("tfm", range(1, len(calls) + 1, 9), calls, whole, on=True)

    def test_particles(self):
        whole, calls = self.whole("dem")
        self.try_all("dem", self.sites(calls), calls, whole)


if __name__ == "__main__":
    program.main()
