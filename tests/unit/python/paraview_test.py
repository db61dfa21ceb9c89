#!/usr/bin/python3
"""What ParaView's own reader finds in the files that the C++ writers have written: paraview_test.py WRITER

Where pvpython is not installed (it is optional), says so and ends with 77, which CTest counts as skipped."""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

NOT_INSTALLED = 77
TIMES = [0, 0.25, 0.5, 0.75, 1]


def look(path):
    """Runs inside ParaView: prints the times, and of each the numbers, the bounds and the ranges of the arrays."""
    from paraview.simple import Xdmf3ReaderS

    reader = Xdmf3ReaderS(FileName=[path])
    reader.UpdatePipelineInformation()
    steps = []
    for time in reader.TimestepValues:
        reader.UpdatePipeline(time)
        data = reader.GetDataInformation()
        arrays = {}
        for kind in (reader.PointData, reader.CellData):
            for name in kind.keys():
                array = kind.GetArray(name)
                arrays[name] = [array.GetRange(n) for n in range(array.GetNumberOfComponents())]
        steps.append({"time": time, "points": data.GetNumberOfPoints(), "cells": data.GetNumberOfCells(),
                      "bounds": data.GetBounds(), "arrays": arrays})
    print("found " + json.dumps(steps))


class ParaView(unittest.TestCase):
    def found(self, kind, name):
        with tempfile.TemporaryDirectory() as scratch:
            directory = Path(scratch) / "run"
            subprocess.run([WRITER, directory, kind], check=True)
            seen = subprocess.run(["pvpython", __file__, "--look", directory / name], capture_output=True, text=True)
        self.assertEqual(seen.returncode, 0, seen.stderr)
        lines = [line for line in seen.stdout.split("\n") if line.startswith("found ")]
        self.assertEqual(len(lines), 1, seen.stdout + seen.stderr)
        return json.loads(lines[0][len("found ") :])

    def test_particles(self):
        """300 particles at first, one fewer at each time; where they are, see write_sample_run.cpp."""
        steps = self.found("particles", "particles.xdmf")
        self.assertEqual([step["time"] for step in steps], TIMES)
        for n, step in enumerate(steps):
            self.assertEqual((step["points"], step["cells"]), (300 - n, 300 - n))  # a cell is a point that is shown
            for seen, stored in zip(step["bounds"], (0.002, 0.058, 0.002 + 0.005 * n, 0.078 + 0.005 * n, 0.002, 0.006)):
                self.assertAlmostEqual(seen, stored, places=12)
            self.assertEqual(step["arrays"], {"id": [[n, 299]], "species": [[0, 1]], "radius": [[0.001, 0.002]],
                                              "velocity": [[0, 0], [0.02, 0.02], [0, 0]],
                                              "spin": [[0, 0], [0, 0], [n, 299]]})

    def test_fields(self):
        for kind, cells, components in (("2", 18 * 60, 3), ("3", 18 * 60 * 4, 3)):
            steps = self.found(kind, "fields.xdmf")
            self.assertEqual([step["time"] for step in steps], TIMES)
            for step in steps:
                self.assertEqual(step["cells"], cells)
                self.assertEqual(sorted(step["arrays"]), ["phi_coarse", "phi_fine", "u_fluid", "voidage"])
                self.assertEqual(len(step["arrays"]["u_fluid"]), components)
                self.assertLessEqual(step["arrays"]["phi_fine"][0][1], 0.30)
                self.assertGreater(step["arrays"]["phi_fine"][0][1], 0.29)


if __name__ == "__main__":
    if sys.argv[1] == "--look":
        look(sys.argv[2])
        sys.exit(0)
    if shutil.which("pvpython") is None:
        print("pvpython is not installed: what ParaView reads is not checked (apt-get install paraview python3-paraview)")
        sys.exit(NOT_INSTALLED)
    WRITER = sys.argv[1]
    unittest.main(argv=sys.argv[:1], verbosity=2)
