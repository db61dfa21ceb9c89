#!/usr/bin/python3
"""Whose a directory is: what the user has is left alone, links lead nowhere, and two runs never share one.
Usage: directories_test.py PROGRAM"""
import json
import os
import shutil
import signal
import socket
import subprocess

import program
from program import CASE, DONE, FILE, ROOT, SMALL, WRONG_CASE, Scratch, small_bed, strict_json

MARK = ".polybed"
RUN = ["tfm", CASE, *SMALL, "--until", "0.01 s", "--quiet"]
OWN = {"history.csv": b"mine", "profiles.h5": b"mine", "fields.h5": b"mine", "checkpoint.h5": b"mine", "picture.png": b"mine",
       "fields/notes.txt": b"mine", "fields/000001.h5": b"mine", "run.json": b'{"filetype": "mine"}'}


def content(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file() and p.name != MARK}


class Closed(Scratch):
    def test_a_home_that_may_not_be_entered_stops_no_run(self):
        """That of another user, as sudo -u leaves it."""
        self.folder.chmod(0o777)
        closed = self.folder / "closed"
        closed.mkdir(mode=0 if os.getuid() else 0o700)
        case = self.write("case.toml", small_bed("1 ms"))
        user = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.getuid() == 0 else []
        for variable in ("HOME", "XDG_CACHE_HOME"):
            for words in (["check", case], ["estimate", case], ["tfm", case, "--no-picture", "-o", self.folder / variable]):
                env = {k: v for k, v in program.environment(str(self.folder)).items() if k != "XDG_CACHE_HOME"}
                done = subprocess.run([*user, program.PROGRAM, *map(str, words)], capture_output=True, encoding="utf-8",
                                      env=env | {variable: str(closed)}, cwd=self.folder, timeout=program.LONGEST)
                self.assertEqual(done.returncode, DONE, done.stderr)


class OfTheUser(Scratch):
    def owned(self, name, files=OWN):
        folder = self.folder / name
        for file, text in files.items():
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            (folder / file).write_bytes(text)
        return folder

    def refused(self, folder, *words, **options):
        before = content(folder)
        told = self.ends(WRONG_CASE, *words, **options).stderr
        self.assertEqual(content(folder), before, words)
        self.assertIn(str(folder), told)
        self.assertIn("has not written", told)
        self.assertFalse((folder / MARK).exists())

    def test_every_single_file_is_kept_also_with_force(self):
        dem = self.write("few.toml", small_bed("0.01 s"))
        for name in OWN:
            folder = self.owned(name.replace("/", "-"), {name: OWN[name]})
            self.refused(folder, *RUN, "-o", folder)
            self.refused(folder, *RUN, "-o", folder, "--force")
            self.refused(folder, "dem", dem, "--quiet", "--no-picture", "-o", folder, "--force")

    def test_folders_of_other_commands(self):
        """Each is refused before it computes anything."""
        run, few = self.folder / "run", self.write("few.toml", small_bed("0.01 s"))
        self.ends(DONE, *RUN, "-o", run)
        folder = self.owned("folder")
        sheared = ROOT / "cases/shear-box/case.toml"
        for words in (["plot", run], ["cost", few, "--force"], ["compare", few, "--force"], ["calibrate", sheared],
                      ["inversion", few, "--scan", "tfm", "--from", "10 mm/s", "--to", "90 mm/s"],
                      ["stability", "--only", "I6"], ["stability", "--draw", "0"]):
            self.refused(folder, *words, "-o", folder)
        self.assertFalse((run / "pictures").exists())

    def test_only_files_of_the_program_are_replaced(self):
        """A directory with an older run, of a version without marks, holds what the user has put there since."""
        run = self.folder / "run"
        self.ends(DONE, *RUN, "-o", run)
        (run / MARK).unlink()
        own = {"notes.txt": b"mine", "fields/notes.txt": b"mine", "fields/1.h5": b"mine", "case.toml": b"mine"}
        self.owned("run", own)
        few = self.write("few.toml", small_bed("0.01 s"))
        self.ends(DONE, "dem", few, "--quiet", "--no-picture", "-o", run, "--force")
        self.assertTrue((run / MARK).exists())
        after = content(run)
        self.assertEqual({name: after.get(name) for name in own}, own)
        self.assertEqual(strict_json(after["run.json"].decode())["model"], "dem")
        self.assertNotIn("steps.csv", after, "of the run before")

    def test_a_folder_of_runs_alone_is_taken(self):
        folder = self.folder / "folder"
        self.ends(DONE, *RUN, "-o", folder / "run")
        (folder / "link").symlink_to(folder / "run")
        self.refused(folder, *RUN, "-o", folder)
        (folder / "link").unlink()
        self.ends(DONE, *RUN, "-o", folder)

    def test_an_empty_folder_and_one_allowed_by_the_user_are_taken(self):
        empty, allowed = self.folder / "empty", self.owned("allowed", {"notes.txt": b"mine"})
        empty.mkdir()
        (allowed / MARK).touch()
        for folder in (empty, allowed):
            self.ends(DONE, *RUN, "-o", folder)
        self.assertEqual((allowed / "notes.txt").read_bytes(), b"mine")


class Links(Scratch):
    def setUp(self):
        super().setUp()
        self.victim = self.write("victim", "precious")
        self.elsewhere = self.folder / "elsewhere"
        self.elsewhere.mkdir()
        self.run = self.folder / "run"
        self.ends(DONE, *RUN, "-o", self.run)

    def test_no_file_is_written_through_a_link(self):
        names = [p.name for p in self.run.iterdir() if p.is_file() and p.name != MARK]
        linked = [n for name in names for n in (name, name + ".temporary")]
        linked += [n + ".temporary" for n in ("checkpoint.h5.new", "checkpoint.previous.h5")] + ["checkpoint.h5.new"]
        for hard in (False, True):
            for name in linked:
                if name == "run.json":  # the record that says whose the directory is
                    continue
                (self.run / name).unlink(missing_ok=True)
                (os.link if hard else os.symlink)(self.victim, self.run / name)
            self.ends(DONE, *RUN, "-o", self.run, "--force")
            self.assertEqual(self.victim.read_text(), "precious")
            self.assertFalse([n for n in linked if (self.run / n).is_symlink()])

    def test_no_folder_is_entered_through_a_link(self):
        (self.elsewhere / "000001.h5").write_text("precious")
        shutil.rmtree(self.run / "fields")
        (self.run / "fields").symlink_to(self.elsewhere)
        told = self.ends(FILE, *RUN, "-o", self.run, "--force").stderr
        self.assertIn(f"{self.run}/fields: it is a link", told)
        self.assertEqual(content(self.elsewhere), {"000001.h5": b"precious"})
        (self.run / "pictures").symlink_to(self.elsewhere)
        self.ends(FILE, "plot", self.run)
        self.assertEqual(content(self.elsewhere), {"000001.h5": b"precious"})

    def test_a_mark_that_is_another_file_is_refused(self):
        for link in (os.symlink, os.link):
            (self.run / MARK).unlink()
            link(self.victim, self.run / MARK)
            self.assertIn(MARK, self.ends(FILE, *RUN, "-o", self.run, "--force").stderr)
            self.assertEqual(self.victim.read_text(), "precious")

    def test_pictures_replace_links(self):
        for name in ("picture.png", "picture.png.temporary"):
            (self.run / name).unlink(missing_ok=True)
            (self.run / name).symlink_to(self.victim)
        self.ends(DONE, "tfm", CASE, *SMALL, "--until", "0.01 s", "--quiet", "-o", self.run, "--force", picture=True)
        self.assertTrue((self.run / "picture.png").read_bytes().startswith(b"\x89PNG"))
        self.assertEqual(self.victim.read_text(), "precious")

    def test_ranks_write_through_no_link(self):
        words = ["mpirun", "-q", "-n", "2", program.PROGRAM, *map(str, RUN), "--no-picture", "-o", str(self.run)]
        for name in ("checkpoint.h5.new.temporary", "fields/000001.h5.temporary"):
            (self.run / name).symlink_to(self.victim)
        done = subprocess.run([*words, "--force"], env=os.environ | program.open_mpi.SETTINGS, capture_output=True, text=True,
                              timeout=program.LONGEST)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertEqual(self.victim.read_text(), "precious")


class Lock(Scratch):
    LONG = ["tfm", CASE, *SMALL, "--until", "90 s", "--quiet"]

    def running(self, directory, *words):
        process = self.start(*self.LONG, "-o", directory, *words)
        program.wait_until(process, lambda: (directory / "checkpoint.h5").exists())
        return process

    def kill(self, process):
        process.send_signal(signal.SIGKILL)
        process.communicate(timeout=program.LONGEST)

    def test_a_second_run_is_told_who_writes_and_a_killed_one_leaves_no_lock(self):
        directory = self.folder / "run"
        first = self.running(directory)
        for words in ([], ["--force"], ["--resume"]):
            told = self.ends(FILE, *RUN, "-o", directory, *words).stderr
            self.assertIn(f"{directory}: process {first.pid} on {socket.gethostname()} writes into it", told)
        self.assertIsNone(first.poll())
        self.kill(first)
        resumed = self.start(*self.LONG, "-o", directory, "--resume")
        program.wait_until(resumed, lambda: f"process {resumed.pid} " in (directory / MARK).read_text())
        told = self.ends(FILE, *RUN, "-o", directory, "--resume").stderr
        self.assertIn(f"process {resumed.pid} ", told)
        self.kill(resumed)
        self.ends(DONE, *RUN, "-o", directory, "--force")

    def test_ranks_end_together(self):
        directory = self.folder / "run"
        first = self.running(directory)
        done = program.run_on_ranks(2, *RUN, "-o", directory)
        self.kill(first)
        self.assertEqual(done.returncode, FILE, done.stderr)
        self.assertEqual(done.stderr.count(f"process {first.pid} "), 1, done.stderr)

    def test_a_running_run_can_be_drawn(self):
        directory = self.folder / "run"
        first = self.running(directory)
        done = self.ends(DONE, "plot", directory, "--what", "history", "-o", directory / "drawn", "--json")
        self.kill(first)
        self.assertEqual(len(json.loads(done.stdout)["pictures"]), 1)

    def test_folders_of_sweeps(self):
        few, directory = self.write("few.toml", small_bed("90 s")), self.folder / "sweep"
        for words in (["cost", few, "--axes", "rtol"], ["compare", few]):
            first = self.start(*words, "--quiet", "-o", directory / words[0])
            program.wait_until(first, lambda: (directory / words[0] / MARK).exists() and
                               "process" in (directory / words[0] / MARK).read_text())
            told = self.ends(FILE, *words, "--quiet", "-o", directory / words[0]).stderr
            first.send_signal(signal.SIGKILL)
            first.communicate(timeout=program.LONGEST)
            self.assertRegex(told, "process [0-9]+ on .* writes into it")


if __name__ == "__main__":
    program.main()
