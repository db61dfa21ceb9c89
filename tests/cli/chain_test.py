#!/usr/bin/python3
"""The chain of the drag: resolved flow, a law fitted to its rows, the bed that the law gives and its band. Usage: chain_test.py PROGRAM"""
import csv
import json
import os

import program
from program import DONE, ROOT, Scratch, main, strict_json

SYSTEM_B = ROOT / "cases/matsuura-akehata/case.toml"
#: As coarse as resolve allows: that the parts fit together is tested, not the numbers.
TINY = ("resolve.voidage=[0.7,0.85]", "resolve.reynolds=[0,10]", "resolve.spheres=22", "resolve.packings=1", "resolve.grids=1",
        "resolve.cells_per_diameter=6")


class Chain(Scratch):
    def test_from_resolved_flow_to_the_inversion_point(self):
        os.environ["POLYBED"] = program.PROGRAM
        made, fitted = self.folder / "drag", self.folder / "fit"
        sets = [word for key in TINY for word in ("--set", key)]
        self.ends(DONE, "resolve", SYSTEM_B, "-o", made, "--quiet", *sets)
        self.assertEqual(len(list(csv.DictReader((made / "rows.csv").read_text().splitlines()))), 4)
        published = ROOT / "tests/data/lbm/tab_A_v.csv"
        self.ends(DONE, "fit", made / "rows.csv", published, "-o", fitted, "--bootstrap", "0", "--quiet", "--no-picture")
        record = strict_json((fitted / "fit.json").read_text())
        self.assertEqual(record["errors"]["rows.csv"]["fitted"]["points"], 8)
        law = f"file:{fitted / 'law.json'}"
        bands = json.loads((fitted / "law.json").read_text())["partition_bands"]
        for partition in ("none", "brinkman_oseen"):
            found = strict_json(self.ends(DONE, "inversion", SYSTEM_B, "--law", law, "--partition", partition, "--closure-uncertainty",
                                          "--json", "-o", self.folder / partition).stdout)
            low, high = found["closure_band_m_s"]
            self.assertTrue(low < found["velocity_m_s"] < high)
            self.assertTrue(0.01 < found["velocity_m_s"] < 0.06, found["velocity_m_s"])  # 36 mm/s was measured
            band = record["band"] if partition == "none" else bands[partition]
            self.assertEqual(found["closure_uncertainty"]["band"]["common"], band["common"])


if __name__ == "__main__":
    main()
