#!/usr/bin/python3
"""Runs that are killed, meet a full disk or find their files damaged. Usage: bad_luck_test.py PROGRAM"""
import os
import resource
import shutil
import signal
import subprocess

import h5py

import program
from program import CASE, DONE, FILE, SMALL, STOPPED, Scratch, datasets, history, same_bits, strict_json

WORDS = ["tfm", CASE, *SMALL, "--quiet"]


class Killed(Scratch):
    def test_a_killed_run_leaves_whole_files_and_goes_on_to_the_same_bits(self):
        """Its last checkpoint is one that the whole run wrote too, so nothing of the end may differ."""
        whole, killed = self.folder / "whole", self.folder / "killed"
        self.ends(DONE, *WORDS, "--until", "0.6 s", "-o", whole)
        running = self.start(*WORDS, "--until", "0.6 s", "-o", killed)
        steps = killed / "steps.csv"
        program.wait_until(running, lambda: (killed / "checkpoint.previous.h5").exists() and (killed / "fields/000003.h5").exists())
        size = steps.stat().st_size
        program.wait_until(running, lambda: steps.stat().st_size > size)  # between two checkpoints
        running.kill()
        running.communicate(timeout=program.LONGEST)
        self.assertEqual(running.returncode, -signal.SIGKILL)

        for name in ("fields.h5", "profiles.h5", "checkpoint.h5", "checkpoint.previous.h5"):
            self.assertTrue(datasets(killed / name), name)
        times = history(killed)["time_s"]
        self.assertGreater(len(times), 20)
        self.assertEqual(times, sorted(set(times)))
        self.assertTrue(steps.read_text().endswith("\n"))
        self.assertEqual(strict_json((killed / "run.json").read_text())["state"], "running")

        self.ends(DONE, *WORDS, "--until", "0.6 s", "-o", killed, "--resume")
        for name in ("checkpoint.h5", "fields.h5", "profiles.h5"):
            self.assertEqual(same_bits(whole / name, killed / name), [], name)
        for name in ("history.csv", "steps.csv"):
            self.assertEqual((whole / name).read_bytes(), (killed / name).read_bytes(), name)
        self.has_no_nan(killed)

    def test_rows_cut_in_the_middle_are_dropped(self):
        """What a power cut leaves of a file that is appended to."""
        directory = self.folder / "run"
        self.ends(DONE, *WORDS, "--until", "0.2 s", "-o", directory)
        kept = {name: (directory / name).read_bytes() for name in ("history.csv", "steps.csv")}
        for name, content in kept.items():
            (directory / name).write_bytes(content + b"0.1")
        self.ends(DONE, *WORDS, "--until", "0.2 s", "-o", directory, "--resume")
        for name, content in kept.items():
            self.assertEqual((directory / name).read_bytes(), content, name)

    def test_a_run_that_replaces_another_is_not_resumed_from_it(self):
        directory = self.folder / "run"
        self.ends(DONE, *WORDS, "--until", "0.2 s", "-o", directory)
        old = (directory / "run.json").read_bytes()
        running = self.start(*WORDS, "--until", "9 s", "--set", "output.checkpoint_every=9", "-o", directory, "--force")
        program.wait_until(running, lambda: (directory / "run.json").read_bytes() != old)
        running.kill()
        running.communicate(timeout=program.LONGEST)
        done = self.ends(FILE, *WORDS, "--until", "0.3 s", "-o", directory, "--resume")
        self.assertIn("no checkpoint", done.stderr)


class Removed(Scratch):
    """What somebody does to history.csv while it is being written costs no row, whether the run ends or is stopped."""

    def test_rows_are_put_back(self):
        whole = self.folder / "whole"
        self.ends(DONE, *WORDS, "--until", "1 s", "-o", whole)
        rows = (whole / "history.csv").read_text()
        for name, deed in (("removed", os.remove), ("moved", lambda path: path.rename(path.with_suffix(".old"))),
                           ("replaced", lambda path: (os.remove(path), path.write_text("mine\n")))):
            for stop in (False, True):
                with self.subTest(name, stop=stop):
                    directory = self.folder / f"{name}{stop}"
                    told = self.meddled_with(directory, deed, stop)
                    self.assertIn("history.csv was removed or replaced", told)
                    kept = (directory / "history.csv").read_text()
                    self.assertEqual(kept, rows[:len(kept)] if stop else rows)
                    self.assertGreaterEqual(history(directory)["time_s"][-1], 0.1)

    def meddled_with(self, directory, deed, stop):
        """Returns what a run said whose history.csv somebody has got at, which then ends or is stopped."""
        running = self.start(*WORDS, "--until", "1 s", "-o", directory)
        program.wait_until(running, (directory / "checkpoint.h5").exists)
        running.send_signal(signal.SIGSTOP)
        deed(directory / "history.csv")
        if stop:
            running.send_signal(signal.SIGINT)
        running.send_signal(signal.SIGCONT)
        told = running.communicate(timeout=program.LONGEST)[1]
        self.assertEqual(running.returncode, STOPPED if stop else DONE, told)
        return told

    def test_rows_that_are_cut_off_are_told(self):
        told = self.meddled_with(self.folder / "cut", lambda path: os.truncate(path, path.stat().st_size // 2), False)
        self.assertEqual(told.count("history.csv was truncated while the run writes it: lines are lost"), 1, told)


class Damaged(Scratch):
    def setUp(self):
        super().setUp()
        self.directory = self.folder / "run"
        self.last = self.directory / "checkpoint.h5"
        self.previous = self.directory / "checkpoint.previous.h5"
        self.ends(DONE, *WORDS, "--until", "0.3 s", "-o", self.directory)
        self.whole = self.folder / "whole"
        shutil.copytree(self.directory, self.whole)

    def resume(self, code):
        return self.ends(code, *WORDS, "--until", "0.3 s", "-o", self.directory, "--resume").stderr

    def cut(self, path):
        os.truncate(path, path.stat().st_size // 2)

    def test_a_checkpoint_cut_short_gives_way_to_the_one_before(self):
        for damage in (self.cut, os.remove, lambda path: path.write_bytes(b"")):
            damage(self.last)
            told = self.resume(DONE)
            self.assertIn(str(self.last), told)
            self.assertIn("going on from it", told)
            for name in ("checkpoint.h5", "fields.h5", "profiles.h5"):
                self.assertEqual(same_bits(self.whole / name, self.directory / name), [], name)
            shutil.copy(self.whole / self.previous.name, self.previous)

    def test_two_damaged_checkpoints_end_the_run_with_advice(self):
        self.cut(self.last)
        self.cut(self.previous)
        told = self.resume(FILE)
        self.assertIn(f"{self.last} is cut short or damaged", told)
        self.assertIn("--force", told)
        self.ends(DONE, *WORDS, "--until", "0.01 s", "-o", self.directory, "--force")

    def test_damaged_results_are_told_by_name(self):
        for name in ("fields.h5", "profiles.h5"):
            path = self.directory / name
            content = path.read_bytes()
            for damaged in (content[:len(content) // 2], b"", b"no HDF5"):
                path.write_bytes(damaged)
                self.assertIn(str(path), self.resume(FILE))
            path.write_bytes(content)
        (self.directory / "history.csv").write_text("a,b\n1,2\n")
        self.assertIn("history.csv has other columns", self.resume(FILE))


class FullDisk(Scratch):
    """A limit on the size of files, set once the run is under way, stands for the disk: writes beyond it fail in the same
    way, without a file system of one's own, which takes rights that a container may not give."""

    def fill(self, directory, most_bytes, words):
        running = self.start(*WORDS, *words, "--until", "30 s", "-o", directory)
        program.wait_until(running, lambda: (directory / "checkpoint.h5").exists())
        steps = directory / "steps.csv"
        size = steps.stat().st_size
        program.wait_until(running, lambda: steps.stat().st_size > size)  # all that goes with the checkpoint is written
        resource.prlimit(running.pid, resource.RLIMIT_FSIZE, (most_bytes, most_bytes))
        told = running.communicate(timeout=program.LONGEST)[1]
        self.assertEqual(running.returncode, FILE, told)
        self.assertRegex(told, f"cannot write {directory}/.*: File too large")
        self.assertEqual([p.name for p in directory.rglob("*.temporary")], [])
        for name in ("fields.h5", "profiles.h5", "checkpoint.h5"):
            self.assertTrue(datasets(directory / name), name)
        state = strict_json((directory / "run.json").read_text())["state"]
        self.assertEqual(state, "failed: " + told.rstrip("\n") if most_bytes else "running", "the record fits, or not")
        with h5py.File(directory / "checkpoint.h5") as checkpoint:
            self.assertGreaterEqual(checkpoint["numbers/time_s"][()], 0.1)
        return told

    def goes_on(self, directory, words):
        with h5py.File(directory / "checkpoint.h5") as checkpoint:
            until = checkpoint["numbers/time_s"][()] + 0.05
        self.ends(DONE, *WORDS, *words, "--until", f"{until} s", "-o", directory, "--resume")
        self.assertEqual(history(directory)["time_s"][-1], until)

    def test_each_file_in_turn(self):
        """Limits and intervals such that another file each time is the first that does not fit. On this grid history.csv has
        170 bytes a row, profiles.h5 28 kB, checkpoint.h5 46 kB, and a step of the fields more than that."""
        def every(**periods):
            return [word for name, period in periods.items() for word in ("--set", f"output.{name}={period}")]
        for first, most_bytes, words in (("steps.csv", 0, every(every=9, history_every=9, checkpoint_every=0.5)),
                                         ("history.csv", 100000, every(history_every=1e-4)),
                                         ("profiles.h5", 20000, every(every=0.5, history_every=0.5, checkpoint_every=0.5)),
                                         ("checkpoint.h5", 40000, every(every=9)), ("fields/", 50000, [])):
            with self.subTest(first):
                directory = self.folder / first
                told = self.fill(directory, most_bytes, words)
                self.assertIn(f"{directory}/{first}", told)
                self.goes_on(directory, words)

    def on_a_disk_of(self, kilobytes):
        """What a run said that filled a disk of its own, which takes the rights to mount one, and its record, if there is one."""
        place, kept = self.folder / "disk", self.folder / "kept.json"
        place.mkdir(exist_ok=True)
        kept.unlink(missing_ok=True)
        script = ('mount -t tmpfs -o size=$1k none "$2" || exit 99; kept=$3; place=$2; shift 3; "$@"; code=$?; '
                  '[ ! -e "$place/run/run.json" ] || cp "$place/run/run.json" "$kept"; exit $code')
        words = ["unshare", "-m" if os.getuid() == 0 else "-rm", "sh", "-c", script, "sh", kilobytes, place, kept,
                 *program.command([*WORDS, "--until", "30 s", "-o", place / "run"])]
        done = subprocess.run(list(map(str, words)), env=program.environment(str(self.folder)), capture_output=True, encoding="utf-8",
                              timeout=program.LONGEST)
        if done.returncode == 99 or done.stderr.startswith("unshare:"):
            self.skipTest(done.stderr)
        self.assertEqual(done.returncode, FILE, done.stderr)
        self.assertRegex(done.stderr, "^cannot write .*: No space left on device\n")
        return done.stderr.rstrip("\n"), strict_json(kept.read_text())["state"] if kept.exists() else None

    def test_the_record_says_so(self):
        """A disk of some hundred kilobytes that the run itself fills."""
        for size in (300, 390, 500, 610, 730, 860):
            told, state = self.on_a_disk_of(size)
            self.assertEqual(state, f"failed: {told}", size)

    def test_a_run_that_has_no_room_from_the_start_does_not_seem_to_run(self):
        """Disks on which the record of the run's beginning just fits, page by page."""
        states = []
        for size in range(32, 80, 4):
            told, state = self.on_a_disk_of(size)
            self.assertIn(state, (None, f"failed: {told}"), size)
            states.append(state)
        self.assertGreater(len(set(states)), 1)

    def test_no_room_for_a_run(self):
        """The disk is full before the first file is complete. What is left does not keep the same run from beginning."""
        directory = self.folder / "run"
        words = [*WORDS, "--until", "0.1 s", "-o", directory]
        done = self.ends(FILE, *words, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0)))
        self.assertRegex(done.stderr, f"^cannot write {directory}/.polybed: File too large")
        self.ends(DONE, *words)


if __name__ == "__main__":
    program.main()
