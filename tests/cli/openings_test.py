#!/usr/bin/python3
"""A case with classes of sizes, a feed and an open outlet: what a run writes of them. Usage: openings_test.py PROGRAM"""

import numpy as np

import program
from program import DONE, ROOT, Scratch, history, strict_json

CASE = ROOT / "cases/classifier/case.toml"
SMALL = ["--set", "column.cells=[6,24]", "--set", "output.every=0.5", "--set", "output.history_every=0.1",
         "--set", "output.checkpoint_every=0.5", "--quiet"]
NAMES = [f"sand.{n}" for n in (1, 2, 3)]


class Openings(Scratch):
    def test_the_ledger_is_written_and_closes(self):
        for integrator in ("explicit", "imex", "implicit"):
            directory = self.folder / integrator
            self.ends(DONE, "tfm", CASE, *SMALL, "--set", f"tfm.integrator={integrator}", "--until", "1.5 s", "-o", directory)
            record, columns = strict_json((directory / "run.json").read_text()), history(directory)
            self.assertEqual([c["name"] for c in record["size_classes"][0]["classes"]], NAMES)
            self.assertEqual([line["species"] for line in record["ledger"]], NAMES)
            for line in record["ledger"]:
                name, all_there_was = line["species"], line["start_kg"] + line["in_kg"]
                self.assertLess(line["relative_error"], 1e-12)
                self.assertGreater(line["out_kg"], 0)
                masses = [np.array(columns[f"{q}_{name}_kg"]) for q in ("mass", "in", "out")]
                # V1 in every row, rows between steps included: round-off of sums over a few hundred cells
                np.testing.assert_allclose(masses[0] - masses[1] + masses[2], line["start_kg"], atol=1e-12 * all_there_was)
                self.assertTrue(np.all(np.diff(masses[1]) >= 0))
                self.assertEqual((masses[1][-1], masses[2][-1]), (line["in_kg"], line["out_kg"]))

    def test_a_resumed_run_counts_on(self):
        whole, parted = self.folder / "whole", self.folder / "parted"
        self.ends(DONE, "tfm", CASE, *SMALL, "--until", "1 s", "-o", whole)
        self.ends(DONE, "tfm", CASE, *SMALL, "--until", "0.5 s", "-o", parted)
        self.ends(DONE, "tfm", CASE, *SMALL, "--until", "1 s", "-o", parted, "--resume")
        self.assertEqual((whole / "history.csv").read_text(), (parted / "history.csv").read_text())
        one, other = (strict_json((d / "run.json").read_text())["ledger"] for d in (whole, parted))
        self.assertEqual(one, other)

    def test_check_prints_the_classes(self):
        done = self.ends(DONE, "check", CASE, "--details")
        for name in NAMES:
            self.assertIn(f"  {name}: diameter ", done.stdout)
        answer = strict_json(self.ends(DONE, "check", CASE, "--json").stdout)
        shares = [c["share"] for c in answer["size_classes"][0]["classes"]]
        self.assertAlmostEqual(sum(shares), 1, places=14)


if __name__ == "__main__":
    program.main()
