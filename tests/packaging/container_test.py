#!/usr/bin/python3
"""The container, built and run by the two commands of docs/guide/install.md, in a folder that does not belong to root. On demand:
it compiles the program. Docker, or podman where Docker is not installed.
Usage: container_test.py [OPTION OF BUILD ...]    such as --network=host where containers have no network of their own
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from polybed.version import __version__  # noqa: E402

USER = os.getuid() or 12345
BUILD, RUN = (shlex.split(line)[1:] for line in re.findall("`(docker [^`]*)`", (ROOT / "docs/guide/install.md").read_text()))
TOOL = shutil.which("docker") or shutil.which("podman") or sys.exit("neither docker nor podman is installed")


class Container(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([TOOL, *BUILD[:-1], *OPTIONS, BUILD[-1]], cwd=ROOT, check=True)
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        os.chown(cls.folder, USER, -1)

    def run_there(self, *words, options=()):
        """What a command of polybed prints; what it prints on stderr must be meant for the user."""
        front = [word.replace("$PWD", str(self.folder)) for word in RUN[:RUN.index("tfm")]]
        ended = subprocess.run([TOOL, front[0], *options, *front[1:], *words], capture_output=True, text=True, timeout=300)
        self.assertEqual(ended.returncode, 0, f"{words}: {ended.stdout[-500:]}{ended.stderr[-2000:]}")
        self.assertNotIn("atplotlib", ended.stderr)
        return ended.stdout

    def test_the_version_is_that_of_the_sources(self):
        self.assertIn(f"polybed {__version__} (", self.run_there("--version"))

    def test_from_a_template_to_pictures(self):
        for case, options in ("bed", ()), ("own", ("--user", f"{USER}:{USER}")):
            there = lambda *words: self.run_there(*words, options=options)  # noqa: E731
            there("new", case, "--from", "binary-both-scales")
            self.assertIn("fluidises at", there("check", f"{case}/case.toml"))
            there("tfm", f"{case}/case.toml", "--until", "20 ms")
            there("dem", f"{case}/case.toml", "--until", "1 ms")
            there("-n", "2", "tfm", f"{case}/case.toml", "--until", "1 ms", "--no-picture", "-o", f"{case}/two")
            there("plot", f"runs/{case}-tfm")
            self.assertIn('"ranks":2,', (self.folder / case / "two/run.json").read_text())
            for picture in ("tfm/picture.png", "dem/picture.png", "tfm/pictures/overview.png"):
                self.assertTrue((self.folder / f"runs/{case}-{picture}").read_bytes().startswith(b"\x89PNG"), picture)
        self.assertEqual({path.lstat().st_uid for path in self.folder.rglob("*")}, {USER})


if __name__ == "__main__":
    OPTIONS = sys.argv[1:]
    unittest.main(argv=sys.argv[:1], verbosity=2)
