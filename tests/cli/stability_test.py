#!/usr/bin/python3
"""polybed stability as its user meets it: codes, what differs from the table, drawn scenes. Usage: stability_test.py
PROGRAM"""
import json
import shutil

import program
from program import DONE, FILE, NUMBERS, ROOT, WRONG_CASE, Scratch, run


class Stability(Scratch):
    def results(self, *words):
        """Of drawn scenes, without the time that they took."""
        self.ends(DONE, "stability", *words, "-o", self.folder / "drawn")
        found = json.loads((self.folder / "drawn/fuzz.json").read_text())["results"]
        for one in found:
            one.pop("cpu_s")
        return found

    def test_a_cell_as_expected_ends_well_and_leaves_its_files(self):
        self.ends(DONE, "stability", "--only", "I6", "-o", self.folder / "out")
        rows = (self.folder / "out/outcomes.csv").read_text().splitlines()
        self.assertEqual(rows, ["case,treatment,outcome,broken", "I6,input,PASS,"])
        self.assertTrue(json.loads((self.folder / "out/stability.json").read_text())["cells"][0]["as_expected"])

    def test_a_cell_that_differs_ends_with_code_3(self):
        """The program beside a table that expects something else; it takes the one that was installed with it."""
        for kept in ("bin", "share/polybed/cases/hard"):
            (self.folder / kept).mkdir(parents=True)
        copy = shutil.copy(program.PROGRAM, self.folder / "bin/polybed")
        shutil.copy(f"{program.PROGRAM}-hard", self.folder / "bin/polybed-hard")
        table = (ROOT / "cases/hard/expected.csv").read_text()
        self.assertIn("I6,input,PASS,\n", table)
        (self.folder / "share/polybed/cases/hard/expected.csv").write_text(
            table.replace("I6,input,PASS,\n", "I6,input,FAIL,V3 finite\n"))
        own, program.PROGRAM = program.PROGRAM, copy
        try:
            ended = run("stability", "--only", "I6", "-o", self.folder / "out")
        finally:
            program.PROGRAM = own
        self.assertEqual(ended.returncode, NUMBERS, ended.stderr)
        self.assertIn("I6", ended.stderr)

    def test_what_there_is_not_is_refused(self):
        for words, told in ((["--naive", "no_such"], "no_such"), (["--only", "T99"], "T99"),
                            (["--only", "D1", "--schemes", "explicit/limited"], "no cell")):
            self.assertIn(told, self.ends(WRONG_CASE, "stability", *words, "-o", self.folder / "out").stderr)

    def test_its_options_are_those_of_the_program_of_hard_cases(self):
        self.assertIn("--fuzz", self.ends(DONE, "stability", "--help").stdout)

    def test_without_the_program_of_hard_cases_it_says_what_to_build(self):
        copy = shutil.copy(program.PROGRAM, self.folder / "polybed")
        own, program.PROGRAM = program.PROGRAM, copy
        try:
            ended = run("stability", "--only", "I6")
        finally:
            program.PROGRAM = own
        self.assertEqual(ended.returncode, FILE, ended.stderr)
        self.assertIn("polybed-hard", ended.stderr)

    def test_drawn_scenes_are_the_same_twice(self):
        words = "--fuzz", "2", "--seed", "1", "--cpu", "600"  # about 1 s each: none is cut where the machine is busy
        first = self.results(*words)
        self.assertEqual([(one["draw"], one["reported"]) for one in first], [(0, "ends: 1. "), (1, "ends: 1. ")])
        self.assertEqual(first, self.results(*words))


if __name__ == "__main__":
    program.main()
