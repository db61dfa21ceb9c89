#!/usr/bin/python3
"""A run that is stopped, killed, out of disk or fed garbage loses nothing and says what to do. Usage: FILE PROGRAM"""
import random
import resource
import signal
import subprocess
import time

import h5py
import numpy as np
import program
from program import SHIPPED, CliTest, main, polybed, settings, strict_json

LONG = "3 s"  # some seconds of computing: time enough to be interrupted


def state_of(directory):
    with h5py.File(directory / "checkpoint.h5") as file:
        return file["arrays/state"][:], file["numbers/time_s"][()]


def is_finite(directory):
    """No NaN reaches a file: every number of every HDF5 file and of the history."""
    for path in [*directory.glob("*.h5"), *directory.glob("fields/*.h5")]:
        with h5py.File(path) as file:
            file.visititems(lambda name, item: finite_item(path, name, item))
    rows = (directory / "history.csv").read_text().split("\n")
    assert rows[-1] == "", "the last line is whole"
    times = [float(row.split(",")[0]) for row in rows[1:-1]]
    assert times == sorted(set(times)), "time rises strictly"
    assert not {"nan", "inf", "-nan"} & {word for row in rows[1:] for word in row.split(",")}


def finite_item(path, name, item):
    if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
        assert np.isfinite(item[()]).all(), f"{path}: {name}"


def start(test, run):
    """A long run, once it has written two checkpoints."""
    command = [program.PROGRAM, "tfm", SHIPPED, *settings(output_checkpoint_every="0.05"), "--until", LONG, "-o", run]
    process = subprocess.Popen([str(w) for w in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGXFSZ, signal.SIG_IGN))
    test.addCleanup(process.stderr.close)
    deadline = time.monotonic() + 60
    while not (run / "checkpoint.previous.h5").exists():
        test.assertLess(time.monotonic(), deadline, "no checkpoint within a minute")
        test.assertIsNone(process.poll(), "the run ended before it could be interrupted")
        time.sleep(0.01)
    return process


def resume(run, until):
    return polybed("tfm", SHIPPED, *settings(output_checkpoint_every="0.05"), "--until", until, "-o", run, "--resume", "--quiet")


class Interrupted(CliTest):
    def test_ctrl_c_writes_a_checkpoint(self):
        run = self.scratch / "run"
        process = start(self, run)
        process.send_signal(signal.SIGINT)
        _, messages = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, messages)
        self.assertEqual(strict_json((run / "run.json").read_text())["state"], "stopped by the user")
        _, stopped = state_of(run)
        self.assertGreater(stopped, 0)
        self.ends(0, resume(run, f"{stopped + 0.1} s"))
        self.assertAlmostEqual(state_of(run)[1], stopped + 0.1, places=12)
        is_finite(run)

    def test_a_killed_run_goes_on_to_the_same_bits(self):
        """Kill -9, then --resume: the state at 0.5 s is that of a run that was left alone."""
        killed, alone = self.scratch / "killed", self.scratch / "alone"
        process = start(self, killed)
        process.kill()
        process.communicate()
        is_finite(killed)
        self.ends(0, resume(killed, "0.5 s"))
        self.ends(0, polybed("tfm", SHIPPED, *settings(output_checkpoint_every="0.05"), "--until", "0.5 s", "-o", alone))
        np.testing.assert_array_equal(state_of(killed)[0], state_of(alone)[0])
        self.assertEqual((killed / "history.csv").read_text(), (alone / "history.csv").read_text())
        is_finite(killed)


class Damaged(CliTest):
    def setUp(self):
        super().setUp()
        self.run_directory = self.scratch / "run"
        self.words = ["tfm", SHIPPED, *settings(output_checkpoint_every="0.05"), "-o", self.run_directory, "--quiet"]
        self.ends(0, polybed(*self.words, "--until", "0.2 s"))

    def cut(self, name):
        path = self.run_directory / name
        path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])

    def test_a_checkpoint_cut_short_gives_way_to_the_one_before(self):
        self.cut("checkpoint.h5")
        self.ends(0, polybed(*self.words, "--until", "0.3 s", "--resume"), "checkpoint.previous.h5, is whole: going on from it")
        self.assertAlmostEqual(state_of(self.run_directory)[1], 0.3, places=12)

    def test_without_a_whole_checkpoint_the_message_says_so(self):
        self.cut("checkpoint.h5")
        self.cut("checkpoint.previous.h5")
        self.ends(4, polybed(*self.words, "--until", "0.3 s", "--resume"), "checkpoint.h5")
        for path in self.run_directory.glob("checkpoint*"):
            path.unlink()
        self.ends(4, polybed(*self.words, "--until", "0.3 s", "--resume"), "no checkpoint to resume from")

    def test_a_checkpoint_of_another_case_is_refused(self):
        self.ends(2, polybed(*self.words, "--until", "0.3 s", "--resume", "--set", "species.fine.density=1400"), "another case")


class FullDisk(CliTest):
    def test_says_which_file_and_keeps_what_was_written(self):
        run = self.scratch / "run"
        process = start(self, run)
        # From now on no file of the program may grow beyond half of a checkpoint, as if the disk were full there.
        few = (run / "checkpoint.h5").stat().st_size // 2
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (few, few))
        _, messages = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, messages)
        self.assertIn(f"cannot write {run}", messages)
        self.assertIn("File too large", messages)
        is_finite(run)
        _, stored = state_of(run)
        self.assertGreater(stored, 0)
        self.ends(0, resume(run, f"{stored + 0.1} s"))

    def test_a_directory_that_cannot_be_made(self):
        blocked = self.write("file", "")
        self.ends(4, polybed("tfm", SHIPPED, *settings(), "--until", "0.02 s", "-o", blocked / "run"), "file/run")


class Garbage(CliTest):
    def test_files_that_are_no_case(self):
        for name, content in (("empty.toml", b""), ("binary.toml", bytes(range(256)) * 20), ("latin.toml", b'title = "\xe9"'),
                              ("deep.toml", b"a = " + b"[" * 5000), ("long.toml", b"title = " + b"x" * 200_000)):
            done = polybed("check", self.write(name, content))
            self.assertIn(done.returncode, (2, 4), f"{name}: {done.stderr[-500:]}")
            self.assertIn(name, done.stderr)

    def test_mutated_cases_never_crash(self):
        """Forty changed copies of the shipped case: 0, 2 or 4 and no NaN, never a signal. (10 000 in unit/core.)"""
        rng = random.Random(3)
        original = SHIPPED.read_text()
        numbers = ["nan", "-1", "1e308", "0", "inf", "1e-320", "99999999999999999999", "[]", "true"]
        for n in range(40):
            lines = original.split("\n")
            at = rng.randrange(len(lines))
            changed = lines[at]
            if "=" in lines[at] and n % 2:
                lines[at] = lines[at].split("=")[0] + "= " + rng.choice(numbers)
            elif n % 3:
                del lines[at]
            else:
                lines.insert(rng.randrange(len(lines)), lines[at])
            done = polybed("check", self.write("mutated.toml", "\n".join(lines)))
            self.assertIn(done.returncode, (0, 2, 4), f"{done.stderr[-300:]}\n{changed}")
            self.assertNotIn("nan", done.stdout)


if __name__ == "__main__":
    main()
