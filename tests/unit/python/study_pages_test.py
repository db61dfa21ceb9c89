#!/usr/bin/python3
"""The pages of a sweep of costs and of a scan for the inversion velocity: study_pages_test.py PACKAGE_DIRECTORY"""

import json
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, sys.argv[1])

from report_pages import EVIL, Page

from polybed.plot import study_drawn

TITLE = f"title = {json.dumps(EVIL)}"


def run(status, error, seconds, note=""):
    return {"kind": "candidate", "settings": {"rtol": "0.001", "grid": "1x15"}, "note": note, "status": status, "s_per_sim_s": seconds,
            "qoi": {"bed_height": {"error": error, "error_ci": 0.001}}}


SWEEP = {"filetype": "polybed cost", "version": 1, "case": TITLE, "case_path": f"cases/{EVIL}/case.toml", "overrides": [f"title={EVIL}"],
         "model": "tfm", "clock": "work", "target": 0.01, "budget_s": 40, "outcome": "done", "reason": "",
         "reference": {"kind": "finer", "floor": {}}, "qoi": [{"id": "bed_height", "definition": "height", "shown": True}],
         "runs": [run("pareto", 0.004, 0.02), run("dominated", 0.01, 0.04, EVIL), run("not run", 0, 0)],
         "recommend": [{"target": 0.01, "qoi": "bed_height", "run": 0, "overrides": ["tfm.rtol=0.001"], "error": 0.004, "ci": 0.001,
                        "s_per_sim_s": 0.02, "confirmed": True}], "pareto": [0],
         "attribution": [{"row": "space", "value": 0.003, "note": ""}, {"row": "statistics", "value": None, "note": "steady"}], "inputs": [],
         "warnings": [EVIL]}
SCAN = {"filetype": "polybed inversion", "version": 1, "case": f"cases/{EVIL}.toml", "overrides": [], "scan": "tfm", "from_m_s": 0.02,
        "to_m_s": 0.04, "until_s": 8.0, "ranks": 1, "directory": "runs/scan", "species": ["fine<b>", "coarse"],
        "force_balance": {"velocity_m_s": 0.036},
        "models": {"tfm": {"velocity_m_s": 0.031, "error_m_s": 0.001, "low_m_s": 0.03, "high_m_s": 0.032, "outcome": "bracket", "cpu_s": 12.0,
                           "runs": [{"velocity_m_s": 0.03, "centre_difference": -0.1, "error": 0.01, "directory": f"runs/{EVIL}"},
                                    {"velocity_m_s": 0.032, "centre_difference": 0.1, "error": 0.01, "directory": "runs/other"}]}}}


class Pages(unittest.TestCase):
    def written(self, name, content):
        with tempfile.TemporaryDirectory() as scratch:
            (Path(scratch) / name).write_text(json.dumps(content))
            page = Page(study_drawn(Path(scratch) / name)[-1].read_text())
        self.assertEqual(page.loaded, [])
        self.assertFalse(any("onerror" in attributes for _, attributes in page.elements))
        self.assertIn(EVIL, "".join(page.text))
        return "".join(page.text)

    def test_cost(self):
        shown = self.written("cost.json", SWEEP)
        for words in ("What to use", "error of at most 1 %", "relative tolerance (tfm.rtol) 0.001, cells 1x15", "error 0.4 \u00b1 0.1 %", "20 ms of computing",
                      "--set tfm.rtol=0.001", "another is cheaper and as accurate", "fluctuations of the bed\u2013steady"):
            self.assertIn(words, shown)
        self.assertGreater(shown.find("Warnings"), shown.find("What the error is made of"))

    def test_cost_without_a_recommendation(self):
        refused = SWEEP | {"recommend": [], "outcome": "refused", "reason": "no trustworthy reference", "reference": {"kind": "", "floor": {}}}
        self.assertIn("No recommendation: no trustworthy reference.", self.written("cost.json", refused))

    def test_scan(self):
        shown = self.written("inversion.json", SCAN)
        for words in ("31 \u00b1 1 mm/s", "30 mm/s to 32 mm/s", "the range is narrow enough", "force balance, without a run36 mm/s",
                      "-0.1 \u00b1 0.01", "--from '0.02 m/s'", "fine<b> and coarse change places"):
            self.assertIn(words, shown)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
