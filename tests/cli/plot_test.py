#!/usr/bin/python3
"""polybed plot: what it draws, from what, and what it says when it cannot. Usage: plot_test.py PROGRAM"""
import os
import pty
import shutil
import subprocess

import program
from program import CASE, DONE, FILE, SMALL, WRONG_CASE, Scratch, run, strict_json

PNG = b"\x89PNG\r\n\x1a\n"


class Plot(Scratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shared = program.tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.shared.cleanup)
        cls.place = program.pathlib.Path(cls.shared.name)
        # in the default place, so that the case's name finds it
        done = run("tfm", CASE, *SMALL, "--until", "0.3 s", "--quiet", cwd=cls.place)
        assert done.returncode == DONE, done.stderr
        cls.directory = cls.place / "runs/matsuura-akehata-tfm"

    def plot(self, code, *words, **options):
        return self.ends(code, "plot", *words, **options)

    def test_everything_by_default(self):
        done = self.plot(DONE, self.directory, "--out", self.folder, "--json")
        paths = strict_json(done.stdout)["pictures"]
        film = "animation.mp4" if shutil.which("ffmpeg") else "animation.gif"
        self.assertEqual(paths, [f"{self.folder}/{n}" for n in ("overview.png", "fields.png", "profiles.png", "history.png", film)])
        self.assertEqual(sorted(os.listdir(self.folder)), sorted([".polybed", *(os.path.basename(p) for p in paths)]))
        self.assertEqual(done.stderr, "", "no bar in a pipe")
        for path in paths[:4]:
            self.assertEqual(program.pathlib.Path(path).read_bytes()[:8], PNG)

    def test_one_picture_at_a_time_of_a_case(self):
        done = self.plot(DONE, CASE.parent, "--what", "fields,history", "--time", "100 ms", "--format", "svg", cwd=self.place)
        self.assertEqual(done.stdout.split(), [f"runs/matsuura-akehata-tfm/pictures/{n}.svg" for n in ("fields", "history")])
        text = (self.directory / "pictures/fields.svg").read_text()
        self.assertIn("t = 0.1 s", text)  # matplotlib writes each text as a comment beside its glyphs

    def test_a_gif_where_there_is_no_ffmpeg(self):
        path = self.folder / "bin"
        path.mkdir()
        environment = dict(program.environment(str(self.folder)), PATH=str(path))
        done = subprocess.run([program.PROGRAM, "plot", self.directory, "--what", "animation", "--out", self.folder / "drawn"],
                              env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertEqual((self.folder / "drawn/animation.gif").read_bytes()[:6], b"GIF89a")

    def test_a_bar_on_a_terminal(self):
        leader, follower = pty.openpty()
        done = run("plot", self.directory, "--what", "animation", "--out", self.folder, stderr=follower)
        self.assertEqual(done.returncode, DONE)
        os.close(follower)
        shown = os.read(leader, 10000).decode()
        os.close(leader)
        self.assertIn("animation [#", shown)
        self.assertIn("4/4", shown)

    def test_an_unfinished_run_is_drawn(self):
        unfinished = self.folder / "unfinished"
        shutil.copytree(self.directory, unfinished)
        record = (unfinished / "run.json").read_text()
        (unfinished / "run.json").write_text(record.replace('"state":"done"', '"state":"running"'))
        (unfinished / "profiles.h5").rename(unfinished / "elsewhere.h5")
        self.plot(DONE, unfinished, "--what", "overview,fields,history")
        self.assertIn("no stored profiles yet", self.plot(FILE, unfinished, "--what", "profiles").stderr)

    def test_what_is_no_run(self):
        for words, message in ((["nowhere"], "no such run directory or case"), ([self.folder], "not a run directory"),
                               ([CASE], "no run of it in runs/matsuura-akehata-tfm"), ([__file__], "neither a run directory")):
            self.assertIn(message, self.plot(FILE, *words, cwd=self.folder).stderr)

    def test_wrong_words(self):
        for words, message in ((["--what", "feilds"], "feilds"), (["--time", "5 m"], "expected a time"), (["--time", "x"], "expected a time"),
                               (["--time", "9"], "not covered: fields are stored from 0 to 0.3 s"), (["--format", "bmp"], "bmp"),
                               (["--rate", "0"], "--rate")):
            done = self.plot(WRONG_CASE, self.directory, *words)
            self.assertIn(message, done.stderr, words)
            self.assertNotIn("Traceback", done.stderr)

    def test_a_damaged_file_is_told(self):
        damaged = self.folder / "damaged"
        shutil.copytree(self.directory, damaged)
        (damaged / "fields.h5").write_bytes(b"no HDF5")
        done = self.plot(FILE, damaged)
        self.assertIn("damaged/fields.h5", done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_a_missing_package_is_told_with_the_line_that_installs_it(self):
        """A module of that name beside an installed package stands for a machine without it."""
        installed = self.folder / "bin/polybed"
        installed.parent.mkdir()
        shutil.copy(program.PROGRAM, installed)
        python = self.folder / "share/polybed/python"
        shutil.copytree(program.ROOT / "python/polybed", python / "polybed")
        environment = program.environment(str(self.folder))
        for package in ("matplotlib", "h5py", "numpy"):
            stand_in = python / f"{package}.py"
            stand_in.write_text(f"raise ModuleNotFoundError('No module named {package}', name='{package}')")
            done = subprocess.run([installed, "plot", self.directory], env=environment, capture_output=True, text=True)
            stand_in.unlink()
            self.assertEqual(done.returncode, FILE, done.stderr)
            self.assertIn(f"{package} is missing", done.stderr)
            self.assertIn(f"python3-{package}", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_no_python_at_all(self):
        """One that does not start, as a library of its own is broken, stands for it: there is nothing to plot with, but a run is
        complete without its picture."""
        self.write("libexpat.so.1", "no library")
        environment = dict(program.environment(str(self.folder)), LD_LIBRARY_PATH=str(self.folder))
        run_words = ["tfm", CASE, *SMALL, "--until", "0.01 s", "-o", self.folder / "run"]
        for words, code in ((["plot", self.directory], FILE), (run_words, DONE)):
            done = subprocess.run(list(map(str, [program.PROGRAM, *words])), env=environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn("no picture: ", done.stderr)
        self.assertNotIn("picture.png", done.stderr)


if __name__ == "__main__":
    program.main()
