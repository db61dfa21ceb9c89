#!/usr/bin/python3
"""The program among a stranger's files: modules, programs, libraries and settings in the working directory and in the run
directory. Usage: isolation_test.py PROGRAM"""
import os
import re
import subprocess

import program
from program import DONE, ROOT, Scratch

MODULES = ("numpy", "h5py", "json", "argparse", "pathlib", "matplotlib", "PIL", "polybed", "runpy", "sitecustomize", "usercustomize",
           "evil")
PROGRAMS = ("python3", "mpirun", "orted", "ssh", "rsh", "ffmpeg", "fc-list", "latex", "convert", "polybed", "git", "ps", "sh")
CASE = program.small_bed("4 ms")
RANKS = program.open_mpi.SETTINGS | program.open_mpi.MORE_THAN_CORES


def libraries():
    """Names of the shared libraries that the program and the interpreter load."""
    told = "".join(subprocess.run(["ldd", path], capture_output=True, text=True, check=True).stdout
                   for path in (program.PROGRAM, "/usr/bin/python3"))
    return set(re.findall(r"^\s*(\S+\.so\S*) => /", told, re.MULTILINE))


class AmongStrangersFiles(Scratch):
    def setUp(self):
        super().setUp()
        self.marker = self.folder / "ran"
        self.place = self.folder / "place"
        self.place.mkdir()
        self.case = self.write("case.toml", CASE)
        self.plant(self.place)

    def plant(self, folder):
        """Files of which each says when it runs, and libraries with which nothing would start."""
        for name in MODULES:
            (folder / f"{name}.py").write_text(f"with open({str(self.marker)!r}, 'a') as f: f.write('module {name}\\n')\n")
        for name in PROGRAMS:
            (folder / name).write_text(f"#!/bin/sh\necho program {name} >>{self.marker}\nexit 1\n")
            (folder / name).chmod(0o755)
        found = libraries()
        self.assertIn("libz.so.1", found)
        for name in found:
            (folder / name).write_text("no library")
        (folder / "matplotlibrc").write_text(f"animation.ffmpeg_path: {folder}/ffmpeg\nbackend: module://evil\n"
                                             "figure.facecolor: red\ntext.usetex: True\n")

    def environment(self):
        """That of a careless user: the working directory is searched first, by each spelling."""
        return os.environ | RANKS | {"PATH": ":.:" + os.environ["PATH"], "PYTHONPATH": ":.", "MPLBACKEND": "module://evil"}

    def runs_ours_alone(self, *words, place=None, **more):
        """A command that ends well, and nothing of what was planted has run; what it said."""
        done = subprocess.run(list(map(str, words)), cwd=place or self.place, env=self.environment() | more, capture_output=True,
                              text=True, timeout=2 * program.LONGEST)
        self.assertEqual(self.marker.read_text() if self.marker.exists() else "", "", words)
        self.assertEqual(done.returncode, DONE, f"{words}\n{done.stdout}\n{done.stderr}")
        return done.stdout + done.stderr

    def test_a_calibration(self):
        few = ("particles=100", "strain=1", "discard_strain=0.5", "doublings=0", "seeds=1", "solids_fraction=[0.3,0.45]")
        words = [word for setting in few for word in ("--set", f"calibrate.{setting}")]
        for ranks in ([], ["-n", "2"]):
            said = self.runs_ours_alone(program.PROGRAM, *ranks, "calibrate", ROOT / "cases/shear-box/case.toml", *words, "-o",
                                        self.folder / f"boxes{len(ranks)}")
            self.assertIn("table.h5", said)

    def test_a_run_and_its_pictures(self):
        self.assertIn("picture.png", self.runs_ours_alone(program.PROGRAM, "tfm", self.case, "-o", "run"))
        run = self.place / "run"
        self.plant(run)
        (self.folder / "clean").mkdir()
        for place in (self.place, run):
            self.runs_ours_alone(program.PROGRAM, "plot", run, place=place)
        drawn = {path.name: path.read_bytes() for path in (run / "pictures").iterdir()}
        stills = [name for name in drawn if not name.startswith("animation")]
        self.assertEqual(len(stills), 4)
        self.runs_ours_alone(program.PROGRAM, "plot", run, "--what", ",".join(name.removesuffix(".png") for name in stills),
                             place=self.folder / "clean")
        for name in stills:
            self.assertEqual((run / "pictures" / name).read_bytes(), drawn[name], f"{name} took settings of the working directory")

    def test_ranks_and_other_pictures(self):
        self.runs_ours_alone(program.PROGRAM, "stability", "--only", "P1", "-o", "matrix")
        self.assertTrue((self.place / "matrix/stability.png").exists())
        self.runs_ours_alone(program.PROGRAM, "compare", self.case, "-o", "both")
        self.assertTrue((self.place / "both/comparison.html").exists())

    def test_runs_from_python(self):
        script = (f"import sys; sys.path.insert(0, {str(ROOT / 'python')!r})\nimport polybed\n"
                  f"polybed.run({str(self.case)!r}, ranks=2)")
        self.runs_ours_alone("/usr/bin/python3", "-I", "-c", script, POLYBED=program.PROGRAM)


if __name__ == "__main__":
    program.main()
