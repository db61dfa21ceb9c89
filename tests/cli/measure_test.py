"""polybed measure as studies use it: of a run of either model, and of series. Usage: measure_test.py PROGRAM"""
import json
import re

import h5py
import numpy as np

import program
from program import DONE, FILE, WRONG_CASE, Scratch, history, small_bed, strict_json


class OfRun(Scratch):
    def test_a_run_of_either_model_measures_what_its_history_says(self):
        self.write("case.toml", small_bed("4 ms") + '[output]\nevery = "2 ms"\nhistory_every = "2 ms"\n')
        for model in ("tfm", "dem"):
            run = self.folder / model
            self.ends(DONE, model, self.folder / "case.toml", "-o", run, "--quiet")
            found, rows = strict_json(self.ends(DONE, "measure", run, "--json").stdout), history(run)
            with h5py.File(run / "profiles.h5") as file:
                self.assertEqual(found["time_s"], list(file["time_s"]))
            self.assertEqual(found["time_s"], list(rows["time_s"]))
            names = {"bed_height": "bed_height_m", "interface": "interface_m", "mixing": "mixing"}
            if model == "tfm":  # heights of particles are not those of their profile, and the drop of neither model is
                names |= {"centre_fine": "centre_fine_m", "centre_coarse": "centre_coarse_m"}
            for measure, column in names.items():
                values = found["measures"][measure]["values"]
                np.testing.assert_array_equal(np.array(values, float), rows[column], f"{model} {measure}")
            self.assertEqual({m["unit"] for m in found["measures"].values()}, {"m", "1", "Pa"})
            table = self.ends(DONE, "measure", run, "--csv").stdout.splitlines()
            self.assertIn("centre_fine_m", table[0])
            self.assertEqual([float(row.split(",")[0]) for row in table[1:]], found["time_s"])
            for words in ([], ["--details"]):
                screen = self.ends(DONE, "measure", run, *words).stdout.splitlines()
                self.assertLessEqual(max(map(len, screen)), 100)
                self.assertRegex("\n".join(screen), r"\bmm\b")

            listed = strict_json(self.ends(DONE, "measure", "--list", "--json").stdout)
            columns = {line["column"] for section in ("bed", model) for line in listed[section]}
            self.assertLessEqual({c.replace("fine", "<name>").replace("coarse", "<name>") for c in rows}, columns)

    def test_the_screen_has_means_over_the_last_quarter_as_the_card_has_them(self):
        run = self.folder / "run"
        self.ends(DONE, "tfm", program.CASE, *program.SMALL, "--until", "0.4 s", "--set",
                  "output.history_every=5e-3", "-o", run, "--quiet", "--no-picture")
        card = strict_json((run / "run.json").read_text())["card"]["bed_height_m"]
        lines = self.ends(DONE, "measure", run).stdout.splitlines()
        self.assertIn("mean, 0.3 to 0.4 s", lines[0])
        mean, interval, last, unit = re.match(r"bed height +([\d.]+) ± ([\d.]+) +([\d.]+)  (\w+)$", lines[1]).groups()
        self.assertEqual((mean, unit), (f"{1e3 * card['value']:.4g}", "mm"))
        self.assertEqual(float(interval), float(f"{1e3 * card['interval']:.1g}"))
        self.assertEqual(last, f"{1e3 * history(run)['bed_height_m'][-1]:.4g}")
        self.assertLessEqual(len(lines), 25)
        self.assertIn("all 5 stored times: --details", lines[-1])
        self.assertRegex(self.ends(DONE, "measure", run, "--details").stdout, r"(?m)^ *100 (.*\n) *200 (.*\n) *300 (.*\n) *400 ")

    def test_means_over_a_window(self):
        self.write("case.toml", small_bed("4 ms") + '[output]\nevery = "1 ms"\nhistory_every = "0.1 ms"\n')
        for model in ("tfm", "dem"):
            self.ends(DONE, model, self.folder / "case.toml", "-o", self.folder / model, "--quiet", "--no-picture")
        runs = [self.folder / "tfm", "--beside", self.folder / "dem"]
        chosen = strict_json(self.ends(DONE, "measure", *runs, "--json").stdout)
        self.assertEqual(chosen["window"]["end_s"], 4e-3)
        self.assertLessEqual({"composition", "profile", "profile_fine", "profile_coarse"}, chosen["distances"].keys())
        found = strict_json(self.ends(DONE, "measure", *runs, "--json", "--begin", 1e-3, "--end", 3e-3, "--slabs", 8).stdout)
        self.assertEqual(found["window"], {"begin_s": 1e-3, "end_s": 3e-3, "shortened": False})
        for name, model in (("in_window", "tfm"), ("beside", "dem")):
            part, rows = found[name], history(self.folder / model)
            inside = [n for n, t in enumerate(rows["time_s"]) if 1e-3 - 1e-9 < t < 3e-3 + 1e-9]
            self.assertEqual((part["rows"], part["profiles"], len(part["mean_profile"]["y_m"])), (len(inside), 3, 8))
            drop = part["means"]["pressure_drop_Pa"]
            self.assertAlmostEqual(drop["mean"], np.mean([rows["pressure_drop_Pa"][n] for n in inside]), delta=1e-9)
            self.assertGreaterEqual(drop["correlation_rows"], 1)
            self.assertEqual(part["mean_profile"]["fraction"]["fine"]["interval"], [None] * 8, "three profiles")

    def test_each_run_is_measured_to_its_own_end(self):
        self.write("case.toml", small_bed("4 ms") + '[output]\nevery = "1 ms"\nhistory_every = "0.1 ms"\n')
        short, long = self.folder / "short", self.folder / "long"
        for run, until in ((short, "2 ms"), (long, "4 ms")):
            self.ends(DONE, "tfm", self.folder / "case.toml", "-o", run, "--until", until, "--quiet", "--no-picture")
        for one, other, ends in ((short, long, (2e-3, 4e-3)), (long, short, (4e-3, 2e-3))):
            found = strict_json(self.ends(DONE, "measure", one, "--beside", other, "--json", "--begin", 1e-3).stdout)
            self.assertEqual((found["window"]["end_s"], found["beside"]["end_s"]), ends)
        for words in ((short, "--begin", 2e-3), (long, "--beside", short, "--begin", 3e-3)):
            self.assertIn(f"the run in {short} ends at 0.002 s", self.ends(WRONG_CASE, "measure", *words, "--json").stderr)
        self.assertIn("--end 0.001 is not after", self.ends(WRONG_CASE, "measure", long, "--json", "--begin", 2e-3, "--end", 1e-3).stderr)
        (short / "history.csv").unlink()
        for words in ((short, "--begin", 0), (long, "--beside", short)):
            self.assertIn(f"{short}: no history.csv", self.ends(FILE, "measure", *words, "--json").stderr)

    def test_options_of_means_are_for_the_json_of_a_run(self):
        for words in (["--begin", 1], ["--json", "--end", 1], ["--json", "--slabs", 0]):
            self.ends(WRONG_CASE, "measure", self.folder, *words)
        self.ends(WRONG_CASE, "measure", "--series", "-")

    def test_the_python_package_has_the_table_as_it_is(self):
        """If not: polybed measure --list --json | python3 -m json.tool --indent 1 > python/polybed/measures.json"""
        table = strict_json((program.ROOT / "python/polybed/measures.json").read_text())
        self.assertEqual(table, strict_json(self.ends(DONE, "measure", "--list", "--json").stdout))

    def test_what_is_no_run_is_named(self):
        for words in (["measure", self.folder], ["measure", "--series", self.folder / "none.json", "--json"]):
            self.assertIn(str(self.folder), self.ends(FILE, *words).stderr)
        self.assertIn("no such run directory", self.ends(FILE, "measure", self.folder / "none").stderr)
        self.ends(WRONG_CASE, "measure")
        self.ends(WRONG_CASE, "measure", self.folder, "--series", "-", "--json")
        self.ends(WRONG_CASE, "measure", self.folder, "--markdown")

    def test_a_ratio_to_zero_is_null(self):
        for below, value in (([0, 0], None), ([1, 3], 0.5), ([0, 4], 0.5)):
            asked = self.write("series.json", json.dumps({"ratios": [{"above": [1, 1], "below": below}]}))
            found = strict_json(self.ends(DONE, "measure", "--series", asked, "--json").stdout)
            self.assertEqual(found["ratios"][0]["value"], value)

    def test_series_are_refused_by_name(self):
        for text in ('{"series": [1]}', '{"series": [["a"]]}', '{"ratios": [{"above": [1, 2], "below": [1]}]}'):
            self.write("series.json", text)
            self.assertIn("series.json", self.ends(FILE, "measure", "--series", self.folder / "series.json", "--json").stderr)


if __name__ == "__main__":
    program.main()
