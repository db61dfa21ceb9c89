#!/usr/bin/python3
"""A run outlives whoever reads what it says; an answer that has not arrived is told. Usage: streams_test.py PROGRAM"""
import os
import shutil
import subprocess
import tempfile

import program
from program import CASE, DONE, FILE, NUMBERS, SMALL, WRONG_CASE, Scratch, same_bits, small_bed, strict_json

RUN = ["tfm", CASE, *SMALL, "--until", "0.02 s"]


def gone():
    """A pipe without a reader."""
    reader, writer = os.pipe()
    os.close(reader)
    return writer


def full():
    return os.open("/dev/full", os.O_WRONLY)


class Streams(Scratch):
    def shell(self, words, redirections):
        """A shell closes a stream, which subprocess cannot."""
        with tempfile.TemporaryDirectory() as scratch:
            return subprocess.run(["sh", "-c", '"$@" ' + redirections, "sh", *program.command(words)], env=program.environment(scratch),
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", timeout=program.LONGEST)

    def whole(self, *words):
        self.ends(DONE, *words, "--quiet", "-o", self.folder / "whole")
        return self.folder / "whole"

    def is_whole(self, directory, whole):
        self.assertEqual(strict_json((directory / "run.json").read_text())["state"], "done")
        for name in ("history.csv", "steps.csv"):
            if (whole / name).exists():
                self.assertEqual((directory / name).read_bytes(), (whole / name).read_bytes(), name)
        for path in whole.glob("*.h5"):
            self.assertEqual(same_bits(path, directory / path.name), [], path.name)

    def test_no_reader_of_messages_ends_a_run(self):
        few = self.write("few.toml", small_bed("0.01 s"))
        for words in (RUN, ["dem", few, "--no-picture"]):
            whole = self.whole(*words)
            for name, made in (("full", full), ("gone", gone)):
                stream = made()
                self.addCleanup(os.close, stream)
                directory = self.folder / f"{words[0]}-{name}"
                done = program.run(*words, "-o", directory, stderr=stream)
                self.assertEqual(done.returncode, DONE, name)
                self.is_whole(directory, whole)
            for streams in ("2>&-", "0<&- 2>&-", "0<&- 1>&- 2>&-"):
                directory = self.folder / f"{words[0]}-{len(streams)}"
                self.assertEqual(self.shell([*words, "-o", directory], streams).returncode, DONE, streams)
                self.is_whole(directory, whole)
            shutil.rmtree(whole)

    def test_errors_keep_their_codes(self):
        for made in (full, gone):
            stream = made()
            self.addCleanup(os.close, stream)
            for code, words in ((WRONG_CASE, ["tfm", CASE, "--set", "no.key=1"]), (FILE, ["tfm", self.folder / "none.toml"]),
                                (WRONG_CASE, ["no-command"])):
                self.assertEqual(program.run(*words, stderr=stream).returncode, code, words)

    def test_an_answer_that_does_not_arrive_is_told(self):
        whole = self.whole(*RUN)
        for number, made in enumerate((full, gone)):
            stream, directory = made(), self.folder / f"run-{number}"
            self.addCleanup(os.close, stream)
            done = self.ends(FILE, *RUN, "--quiet", "--json", "-o", directory, stdout=stream)
            reason = ("No space left on device", "Broken pipe")[number]
            self.assertEqual(done.stderr, f"standard output: cannot be written ({reason})\n")
            self.is_whole(directory, whole)
            for words in (["list"], ["--help"], ["tfm", "--help"], ["schema", "--markdown"], ["check", CASE]):
                self.assertIn("standard output", self.ends(FILE, *words, stdout=stream).stderr, words)
        done = self.shell([*RUN, "--quiet", "--json", "-o", self.folder / "closed"], ">&-")
        self.assertEqual((done.returncode, done.stderr.count("standard output")), (FILE, 1), done.stderr)
        self.is_whole(self.folder / "closed", whole)

    def test_ranks_end_together(self):
        directory = self.folder / "run"
        stream = full()
        self.addCleanup(os.close, stream)
        # mpirun passes output on through a pipe of its own, so the first rank gets the full one by a shell.
        words = ["mpirun", "-q", "-n", "2", "sh", "-c", '"$@" >/dev/full', "sh", *program.command([*RUN, "--quiet", "--json", "-o", directory])]
        done = subprocess.run(words, env=os.environ | program.open_mpi.SETTINGS, stderr=subprocess.PIPE, encoding="utf-8",
                              timeout=program.LONGEST)
        self.assertEqual(done.returncode, FILE, done.stderr)
        self.assertEqual(done.stderr.count("standard output"), 1, done.stderr)


class Record(Scratch):
    """run.json of a start that fails."""

    def setUp(self):
        super().setUp()
        self.few = self.write("few.toml", small_bed("0.01 s"))
        # cells smaller than a particle, whose volume the weights do not spread: the voidage is below 0
        self.fails = ["dem", self.few, "--set", "column.cells=[20,80]", "--set", "dem.kernel=bilinear", "--quiet", "--no-picture"]

    def record(self, directory):
        return strict_json((directory / "run.json").read_text())

    def test_a_start_that_fails_leaves_a_record(self):
        directory = self.folder / "run"
        told = self.ends(NUMBERS, *self.fails, "-o", directory).stderr
        record = self.record(directory)
        self.assertIn("voidage", told)
        self.assertEqual(record["state"], "failed: " + told.rstrip("\n"))
        self.assertEqual((record["filetype"], record["model"], record["time_s"]), ("polybed run", "dem", 0))
        self.assertIn("bilinear", record["case"])
        missing = self.folder / "missing.h5"
        told = self.ends(FILE, "dem", self.few, "--set", f"bed.start=checkpoint:{missing}", "--quiet", "--force", "-o", directory).stderr
        self.assertEqual(self.record(directory)["state"], "failed: " + told.rstrip("\n"))

    def test_a_start_that_fails_leaves_an_earlier_run_alone(self):
        directory = self.folder / "run"
        self.ends(DONE, "dem", self.few, "--quiet", "--no-picture", "-o", directory)
        before = {p: p.read_bytes() for p in directory.rglob("*") if p.is_file() and p.name != ".polybed"}
        self.ends(NUMBERS, *self.fails, "-o", directory, "--force")
        self.ends(WRONG_CASE, *self.fails, "-o", directory, "--resume")
        self.assertEqual({p: p.read_bytes() for p in before}, before)

    def test_a_wrong_case_leaves_none(self):
        directory = self.folder / "run"
        refused = (["dem", self.few, "--set", "effects.contact=linear"], ["dem", self.few, "--set", "effects.contact=none"],
                   ["tfm", self.few, "--set", "effects.solids_stress=none", "--set", "bed.start=settled"])
        for words in refused:
            self.ends(WRONG_CASE, *words, "--quiet", "-o", directory)
            self.assertFalse(directory.exists())
            self.ends(WRONG_CASE, *words, "--quiet", "-o", self.folder / "of/some")
            self.assertFalse((self.folder / "of").exists())


if __name__ == "__main__":
    program.main()
