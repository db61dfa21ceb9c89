#!/usr/bin/python3
"""The notebooks run in their short form, from first cell to last, and are kept without outputs. Usage: notebooks_test.py PROGRAM"""
import json
import os
import subprocess

import program
from program import ROOT, Scratch

NOTEBOOKS = sorted((ROOT / "python/notebooks").glob("*.ipynb"))


class Notebooks(Scratch):
    def test_each_runs_and_shows_a_picture(self):
        self.assertEqual([path.stem for path in NOTEBOOKS], ["expansion_curve", "hopper", "inversion"])
        settings = os.environ | {"POLYBED": program.PROGRAM, "PYTHONPATH": str(ROOT / "python"), "POLYBED_SHORT": "1",
                                 "JUPYTER_PLATFORM_DIRS": "0", "HOME": str(self.folder)}
        for path in NOTEBOOKS:
            with self.subTest(path.stem):
                book = json.loads(path.read_text())
                self.assertEqual([cell["outputs"] for cell in book["cells"] if cell["cell_type"] == "code" and cell["outputs"]], [])
                (self.folder / path.name).write_text(path.read_text())  # its working directory is its own
                done = subprocess.run(["/usr/bin/python3", "-m", "nbconvert", "--execute", "--to", "notebook", "--output", f"{path.stem}-run",
                                       path.name], cwd=self.folder, env=settings, capture_output=True, text=True, timeout=program.LONGEST * 5)
                self.assertEqual(done.returncode, 0, done.stderr[-2000:])
                cells = json.loads((self.folder / f"{path.stem}-run.ipynb").read_text())["cells"]
                outputs = [output for cell in cells for output in cell.get("outputs", [])]
                self.assertTrue(any("image/png" in output.get("data", {}) for output in outputs))
                self.assertEqual([output for output in outputs if output["output_type"] == "error"], [])


if __name__ == "__main__":
    program.main()
