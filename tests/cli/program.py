"""What the tests of the command line share: the program, a small case, and how a test file is run."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHIPPED = ROOT / "cases/matsuura-akehata/case.toml"
PROGRAM = ""
# A fifth of the shipped bed on 6 x 30 cells: all terms on, some ten steps in a tenth of a second.
SMALL = {"column.size": '["20 mm", "120 mm"]', "column.cells": "[6, 30]", "bed.static_height": "40 mm",
         "bed.start_solids_fraction": "0.5", "output.every": "0.05", "output.history_every": "0.02"}


def settings(**changes):
    """--set options of the small case, with changes: tfm_rtol="1e-4" sets tfm.rtol."""
    keys = SMALL | {name.replace("_", ".", 1): value for name, value in changes.items()}
    return [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]


def polybed(*words):
    """Runs the program to its end."""
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120, errors="backslashreplace")


def strict_json(text):
    """The JSON of a text; NaN and infinities, which JSON does not know, are refused."""
    def refuse(constant):
        raise AssertionError(f"{constant} in JSON")

    return json.loads(text, parse_constant=refuse)


class CliTest(unittest.TestCase):
    """A scratch directory for each test, and what most tests ask."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = Path(scratch.name)

    def ends(self, code, done, *texts):
        """The program ended with a code and its messages hold the texts."""
        self.assertEqual(done.returncode, code, f"{done.args}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
        for text in texts:
            self.assertIn(text, done.stdout + done.stderr)
        return done

    def write(self, name, content):
        path = self.scratch / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path


def main():
    """Runs the tests of the file that calls: FILE PROGRAM [TEST]."""
    global PROGRAM
    PROGRAM = sys.argv.pop(1)
    # The test file has imported this module by its name, so the path must be set there, too.
    sys.modules["program"].PROGRAM = PROGRAM
    unittest.main(module="__main__")
