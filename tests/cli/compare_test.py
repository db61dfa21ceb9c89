#!/usr/bin/python3
"""polybed compare as its user meets it: both models run or given, the table, the file, refusals. Usage: compare_test.py PROGRAM"""
import html
import json
import pathlib
import re
import shlex
import shutil
import signal
import sys
import tempfile

import h5py
import numpy as np

import program
from program import DONE, FILE, ROOT, STOPPED, WRONG_CASE, Scratch, history, rising, strict_json

sys.path.insert(0, str(ROOT / "python"))
import polybed  # noqa: E402
from polybed import plot  # noqa: E402
from polybed.drawing import comparison as page  # noqa: E402

# 157 spheres of two sizes in rising water: both models take well below a second.
BED = rising('size = ["5 mm", "30 mm"]\ncells = [2, 12]', [150, 7], 0.4, 'solids_stress = "frictional"\n', """[run]
until = "20 ms"
[output]
every = "0.5 ms"
history_every = "0.1 ms"
""")
QUIET = ["--quiet", "--no-picture"]
MEASURES = {"bed_height_m", "pressure_drop_Pa", "pressure_drop_over_weight", "centre_fine_m", "centre_coarse_m",
            "centre_difference", "mixing", "interface_m"}


class Comparison(Scratch):
    """Both models have been run once, into a folder that each test has a copy of."""

    @classmethod
    def setUpClass(cls):
        cls.run_once = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.run_once.cleanup)
        folder = pathlib.Path(cls.run_once.name)
        (folder / "case.toml").write_text(BED)
        cls.first = program.run("compare", folder / "case.toml", *QUIET, "--json", "-o", folder / "both")

    def setUp(self):
        super().setUp()
        shutil.copytree(self.run_once.name, self.folder, dirs_exist_ok=True)
        self.case = self.folder / "case.toml"
        self.assertEqual(self.first.returncode, DONE, self.first.stderr)
        self.found = strict_json(self.first.stdout)

    def compare(self, code, *words):
        return self.ends(code, "compare", self.case, *QUIET, "-o", self.folder / "new", *words)

    def given(self, *words, code=DONE):
        return self.ends(code, "compare", self.case, "--tfm", self.folder / "both/tfm", "--dem", self.folder / "both/dem",
                         "-o", self.folder / "again", "--no-picture", *words)

    def test_runs_both_and_says_the_same_of_them_afterwards(self):
        found = self.found
        self.assertEqual(found, strict_json((self.folder / "both/comparison.json").read_text()))
        for model in ("tfm", "dem"):
            record = strict_json((self.folder / "both" / model / "run.json").read_text())
            for time in ("cpu_s", "wall_s"):
                self.assertEqual(found["models"][model][time], record[time])
                self.assertGreater(record[time], 0)
            self.assertEqual(found["models"][model]["state"], "done")
            for counter, value in found["models"][model]["work"].items():
                self.assertEqual(value, record["work"][counter])
        again = strict_json(self.given("--json").stdout)
        for part in ("measures", "scores", "window", "warnings"):
            self.assertEqual(found[part], again[part])

    def test_means_are_those_of_the_histories(self):
        found = self.found
        self.assertEqual(set(found["measures"]), MEASURES)
        begin, end = found["window"]["begin_s"], found["window"]["end_s"]
        self.assertGreaterEqual(begin, 0.015 - 1e-9)
        self.assertAlmostEqual(end, 0.02, delta=1e-9)
        for model in ("tfm", "dem"):
            rows = {name: np.array(values, float) for name, values in history(self.folder / "both" / model).items()}
            at = (rows["time_s"] > begin - 1e-9) & (rows["time_s"] < end + 1e-9)
            for name in ("bed_height_m", "pressure_drop_Pa", "centre_fine_m", "centre_coarse_m", "mixing"):
                # a sum of some 50 rows in another order
                np.testing.assert_allclose(found["measures"][name][model], rows[name][at].mean(), rtol=1e-12)
            b = (rows["centre_coarse_m"] - rows["centre_fine_m"]) / rows["bed_height_m"]
            np.testing.assert_allclose(found["measures"]["centre_difference"][model], b[at].mean(), rtol=1e-10)
        height = found["measures"]["bed_height_m"]
        self.assertAlmostEqual(found["scores"]["e_H"]["value"], height["tfm"] / height["dem"] - 1, delta=1e-12)
        self.assertGreater(height["tfm_error"], 0)

    def test_profile_distances_are_those_of_the_mean_profiles(self):
        found = self.found
        begin, end = found["window"]["begin_s"], found["window"]["end_s"]
        for species in ("fine", "coarse"):
            mean = {}
            for model in ("tfm", "dem"):
                with h5py.File(self.folder / "both" / model / "profiles.h5") as file:
                    at = (file["time_s"][:] > begin - 1e-9) & (file["time_s"][:] < end + 1e-9)
                    mean[model] = file[f"phi_{species}"][:][at].mean(axis=0)
                    self.assertEqual(found["models"][model]["profiles_in_window"], at.sum())
            distance = np.abs(mean["tfm"] - mean["dem"]).sum() / mean["dem"].sum()
            np.testing.assert_allclose(found["scores"][f"profile_{species}"]["value"], distance, rtol=1e-10)

    def test_mean_profiles_are_drawn_with_the_interval_of_the_mean(self):
        found = self.found
        begin, end = found["window"]["begin_s"], found["window"]["end_s"]
        means, runs = found["mean_profiles"], {m: polybed.read(found["models"][m]["directory"]) for m in ("tfm", "dem")}
        for model, run in runs.items():
            profiles = run.profiles
            np.testing.assert_array_equal(means["y_m"], profiles["y_m"])
            at = (profiles["time_s"] > begin - 1e-9) & (profiles["time_s"] < end + 1e-9)
            groups = at.sum()  # up to ten a profile is a group of its own, so that it is the plain standard error
            student = {4: 3.182, 5: 2.776, 6: 2.571, 7: 2.447, 8: 2.365, 9: 2.306, 10: 2.262}[groups]
            for species in ("fine", "coarse"):
                rows = profiles[f"phi_{species}"][at]
                of = means[model][f"phi_{species}"]
                # sums in another order
                np.testing.assert_allclose(of["mean"], rows.mean(axis=0), rtol=1e-12, atol=1e-15)
                np.testing.assert_allclose(of["error"], student * rows.std(axis=0, ddof=1) / np.sqrt(groups), rtol=1e-9, atol=1e-15)
        figure = page.draw_profiles(runs, means)
        for axes, species in zip(figure.axes, ("fine", "coarse"), strict=True):
            for line, band, (model, name) in zip(axes.lines, axes.collections, page.NAMES.items(), strict=True):
                of = {what: np.array(values) for what, values in means[model][f"phi_{species}"].items()}
                np.testing.assert_array_equal(line.get_xdata(), of["mean"])
                edges = band.get_paths()[0].vertices[:, 0]
                self.assertAlmostEqual(edges.max(), (of["mean"] + of["error"]).max(), delta=1e-12)
                self.assertAlmostEqual(edges.min(), (of["mean"] - of["error"]).min(), delta=1e-12)
                self.assertEqual((line.get_label(), band.get_label()), (name, f"{name}: 95 % interval of the mean"))
        alone = {m: {s: of | {"error": [None] * len(of["mean"])} for s, of in means[m].items()} for m in runs} | {"y_m": means["y_m"]}
        self.assertEqual({line.get_label() for line in page.draw_profiles(runs, alone).axes[0].lines},
                         {f"{name}, too few profiles for a band" for name in page.NAMES.values()})

    def test_the_interface_is_drawn_in_time(self):
        runs = {m: polybed.read(self.folder / "both" / m) for m in ("tfm", "dem")}
        lines = {line.get_label(): line for line in page.draw_history(runs, self.found["window"]).axes[0].lines}
        for model, run in runs.items():
            line = lines[f"interface, {page.NAMES[model]}"]
            np.testing.assert_allclose(line.get_ydata(), run.history["interface_m"] * page.length_unit(runs["tfm"])[0])

    def test_the_table_for_people(self):
        told = self.given().stdout
        for line in ("bed height [(]mm[)] .* ± ", "on top", "e_H .*goal 0.05", "by the clock ", "particle steps", "centre of ",
                     "comparison.json$"):
            self.assertRegex(told, f"(?m){line}")
        self.assertNotRegex(told, r"\w_(m|Pa)\b")  # a name of a column
        self.assertIn("warning: tfm: not steady", told)  # after 20 ms no bed is

    def test_runs_of_different_cases_are_refused_with_the_keys(self):
        self.ends(DONE, "dem", self.case, *QUIET, "-o", self.folder / "both/dem", "--force", "--set",
                  "inlet.superficial_velocity=0.021", "--set", "bed.seed=2", "--set", "dem.friction=0.2")
        told = self.given(code=WRONG_CASE).stderr
        self.assertIn("inlet.superficial_velocity: [[0.0, 0.02]] and [[0.0, 0.021]]", told)
        self.assertIn("bed.seed: 1 and 2", told)
        self.assertNotIn("friction", told)
        self.assertFalse((self.folder / "again").exists())
        # one that is given is looked at before the other is run
        told = self.compare(WRONG_CASE, "--dem", self.folder / "both/dem").stderr
        self.assertIn("bed.seed: 1 and 2", told)
        self.assertFalse((self.folder / "new").exists())

    def test_runs_of_another_case_than_the_one_named_are_refused(self):
        told = self.given("--set", "bed.seed=3", code=WRONG_CASE).stderr
        self.assertIn("bed.seed: 3 and 1", told)

    def test_what_is_no_run_of_the_model_is_refused(self):
        dem = self.folder / "both/dem"
        told = self.ends(FILE, "compare", self.case, "--tfm", dem, "--dem", dem, "-o", self.folder / "again").stderr
        self.assertIn("a run of dem, not of tfm", told)
        (dem / "run.json").write_text('{"filetype": "polybed run", ')
        self.assertIn("run.json is damaged", self.given(code=FILE).stderr)
        (dem / "run.json").unlink()
        self.assertIn("no run", self.given(code=FILE).stderr)

    def test_an_unfinished_run_is_compared_as_far_as_it_goes(self):
        path = self.folder / "both/dem/run.json"
        path.write_text(path.read_text().replace('"state":"done"', '"state":"stopped by the user"'))
        rows = (self.folder / "both/dem/history.csv").read_text().splitlines(True)
        (self.folder / "both/dem/history.csv").write_text("".join(rows[:102]))  # to 10 ms
        found = strict_json(self.given("--json").stdout)
        self.assertAlmostEqual(found["window"]["end_s"], 0.01, delta=1e-9)
        self.assertIn("dem: the run is not done (stopped by the user)", found["warnings"])

    def test_what_one_model_cannot_run_is_told_before_the_other_begins(self):
        told = self.compare(WRONG_CASE, "--set", "column.outlet=open", "--set", "fluid.equation_of_state=tait").stderr
        self.assertIn("column.outlet", told)
        self.assertFalse((self.folder / "new").exists())

    def test_the_page_stands_alone_and_says_how_to_make_it_again(self):
        self.ends(DONE, "compare", self.case, "--tfm", self.folder / "both/tfm", "--dem", self.folder / "both/dem", "-o",
                  self.folder / "page")
        text = (self.folder / "page/comparison.html").read_text()
        (self.folder / "page/comparison.html").unlink()
        self.assertIn("comparison.html", self.ends(DONE, "plot", self.folder / "page").stdout)
        self.assertEqual((self.folder / "page/comparison.html").read_text(), text)
        self.assertEqual(text.count('src="data:image/png;base64,'), 5)  # three instants, profiles, history
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:)[^"]*"', text), [])
        self.assertGreater(text.find(">Warnings<"), text.find(">Pictures<"), "warnings come after the results")
        found = strict_json((self.folder / "page/comparison.json").read_text())
        self.numbers_stand_on(text, found)
        for line in found["warnings"]:
            self.assertIn(html.escape(line), text)
        tfm, dem, last = [shlex.split(html.unescape(line)) for line in re.search("<pre>(.*)</pre>", text, re.S)[1].splitlines()]
        self.assertEqual((tfm[:3], dem[:3]), (["polybed", "tfm", str(self.case)], ["polybed", "dem", str(self.case)]))
        # all three where they were made: the same runs again, to the bit
        made = {model: (self.folder / "both" / model / "run.json").stat().st_mtime_ns for model in ("tfm", "dem")}
        self.ends(DONE, *tfm[1:], "--quiet")
        self.ends(DONE, *dem[1:], *QUIET)
        for model, time in made.items():
            self.assertGreater((self.folder / "both" / model / "run.json").stat().st_mtime_ns, time)
        again = self.ends(DONE, *last[1:], "--json", "--no-picture").stdout
        self.assertEqual(strict_json(again)["measures"], found["measures"])
        # a run on several ranks is made again on as many
        record = strict_json((self.folder / "both/tfm/run.json").read_text())
        lines = page.commands(found, {"tfm": record | {"ranks": 3}, "dem": record}).splitlines()
        self.assertTrue(lines[0].startswith(f"mpirun -n 3 polybed tfm {self.case} "), lines[0])

    def numbers_stand_on(self, text, found):
        """Every mean of both models and every score of comparison.json, and beside the folder of each run its commit."""
        for name, measure in found["measures"].items():
            self.assertIn("".join(f"<td>{cell}</td>" for cell in page.measure_row(name, measure)), text)
        self.assertIn(f"<td>bed height (mm)</td><td>{1e3 * found['measures']['bed_height_m']['tfm']:.4g} ± ", text)
        self.assertIn(f"<td>{1e3 * found['measures']['bed_height_m']['dem']:.4g} ± ", text)
        for name, score in found["scores"].items():
            if name != "order":
                self.assertIn(f"<td>{page.score_words(name)}</td><td>{page.with_error(score['value'], score['error'])}</td>", text)
                self.assertNotEqual(page.score_words(name), name, "a score is explained")
        self.assertRegex(text, f"<td>{page.SCORES['e_H']}</td><td>{found['scores']['e_H']['value']:.4g} ")
        self.assertIn(f"On top: two-fluid: {found['scores']['order']['tfm']['species']}", text)
        self.assertRegex(text, r"On top[^\n]*?heights of the centres in history\.csv of both runs")
        for model in ("tfm", "dem"):
            record = strict_json((self.folder / "both" / model / "run.json").read_text())
            folder = self.folder / "both" / model
            for where in (f"<code>{folder}</code>", f"<code>{folder}/run.json</code>"):
                self.assertIn(f"{where} (commit {record['git_commit']})", text)

    def test_a_scan_of_the_case_gives_a_score_and_one_of_another_is_refused(self):
        scan = {"outcome": "bracket", "velocity_m_s": 0.021, "error_m_s": 1e-4, "low_m_s": 0.0207, "high_m_s": 0.0213,
                "slope_s_m": -10, "cpu_s": 1, "runs": []}
        made = self.ends(DONE, "inversion", self.case, "--scan", "tfm", "--from", "19 mm/s", "--to", "21 mm/s", "--set",
                         "output.history_every=1e-5", "--until", "2 ms", "-o", self.folder / "scan", *QUIET, "--json").stdout
        found = strict_json(made) | {"models": {"tfm": scan, "dem": scan | {"velocity_m_s": 0.02}},
                                     "agreement": {"value": 0.05, "error": 0.01, "goal": 0.05, "reached": True}}
        path = self.folder / "scan/inversion.json"
        path.write_text(json.dumps(found))
        told = strict_json(self.given("--inversion", path.parent, "--json").stdout)
        self.assertEqual(told["scores"]["u_inv"], {"value": 0.05, "error": 0.01, "goal": 0.05, "reached": True})
        self.assertEqual(told["scores"]["D1"]["goal"], 0.1)  # 20 mm/s is within 5 % of it
        self.assertEqual(told["inversion_file"], str(path))
        self.assertNotIn("u_inv", self.found["scores"])
        self.the_page_tells_where_the_velocity_is_from(found, path, strict_json(made))
        path.write_text(json.dumps(found | {"case_hash": "0"}))
        self.assertIn("another case", self.given("--inversion", path.parent, code=WRONG_CASE).stderr)
        self.assertIn("no scan", self.given("--inversion", self.folder, code=FILE).stderr)

    def the_page_tells_where_the_velocity_is_from(self, found, path, made):
        runs = made["models"]["tfm"]["runs"]
        found["models"]["tfm"]["runs"] = runs
        path.write_text(json.dumps(found))
        self.ends(DONE, "compare", self.case, "--tfm", self.folder / "both/tfm", "--dem", self.folder / "both/dem", "-o",
                  self.folder / "scanned", "--inversion", path.parent)
        text = (self.folder / "scanned/comparison.html").read_text()
        self.assertIn(f"<td>{page.SCORES['u_inv']}</td><td>0.05 ± 0.01</td>", text)
        self.assertIn("<td>two-fluid</td><td>21 ± 0.1 mm/s</td><td>20.7 mm/s to 21.3 mm/s</td><td>the range is narrow enough</td>", text)
        self.assertIn(f"<code>{path}</code> (commit {found['git_commit']})", text)
        for run in runs:
            self.assertIn(f"<code>{run['directory']}</code> (commit {run['git_commit']})", text)
            self.assertEqual(run["git_commit"], strict_json((pathlib.Path(run["directory"]) / "run.json").read_text())["git_commit"])
        lines = [shlex.split(html.unescape(line)) for line in re.search("<pre>(.*)</pre>", text, re.S)[1].splitlines()]
        self.assertEqual(lines[2], ["polybed", "inversion", str(self.case), "--set", "output.history_every=1e-5", "--scan", "tfm",
                                    "--from", "0.019 m/s", "--to", "0.021 m/s", "--until", "0.002 s", "-o", str(path.parent)])
        self.assertEqual(lines[3][:2], ["polybed", "compare"])
        # the line finds every run finished, and what it writes is what was written
        told = self.ends(DONE, *lines[2][1:], "--no-picture").stdout
        self.assertEqual(told.count("finished before"), len(runs))
        self.assertEqual(strict_json(path.read_text()), made)
        # a scan of before its request was kept has no line, and the page says so
        old = {name: value for name, value in found.items() if name not in ("scan", "from_m_s", "to_m_s", "until_s", "ranks")}
        path.write_text(json.dumps(old))
        [written] = plot.study_drawn(self.folder / "scanned/comparison.json")
        text = written.read_text()
        self.assertNotIn("polybed inversion", text)
        self.assertIn("does not hold what its scan was asked for", text)

    def test_stopped_it_stops_its_run_which_can_be_gone_on_with(self):
        run = self.folder / "new/tfm"
        for signal_number in (signal.SIGINT, signal.SIGTERM):
            running = self.start("compare", self.case, *QUIET, "-o", run.parent, "--until", "20 s", "--resume")
            program.wait_until(running, lambda: (run / "run.json").exists() and '"running"' in (run / "run.json").read_text())
            running.send_signal(signal_number)
            told = running.communicate(timeout=program.LONGEST)
            self.assertEqual(running.returncode, STOPPED, told)
            self.assertEqual(strict_json((run / "run.json").read_text())["state"], "stopped by the user")
            self.assertTrue((run / "checkpoint.h5").exists())
            self.assertFalse((run.parent / "dem").exists())

    def test_resumed_it_goes_on_with_what_is_there(self):
        first = strict_json(self.compare(DONE, "--json", "--until", "2 ms").stdout)
        self.assertAlmostEqual(first["window"]["end_s"], 0.002, delta=1e-9)
        self.assertIn("--resume", self.compare(WRONG_CASE).stderr)  # a run is there already
        shutil.rmtree(self.folder / "new/dem")  # as if stopped before it began
        second = strict_json(self.compare(DONE, "--json", "--resume", "--until", "4 ms").stdout)
        self.assertAlmostEqual(second["window"]["end_s"], 0.004, delta=1e-9)

    def test_beds_that_drift_come_with_the_command_that_goes_on(self):
        told = self.compare(DONE, "--until", "20 ms", "--set", "tfm.rtol=1e-3").stdout
        self.assertIn("not steady", told)
        words = shlex.split(re.search(r"(?m)^to go on: polybed (.*)$", told)[1])
        least = [float(found) for found in re.findall(r"run at least ([\d.e-]+) s", told)]
        again = self.ends(DONE, *words, *QUIET, "--json").stdout
        self.assertAlmostEqual(strict_json(again)["window"]["end_s"], max([0.04, *least]), delta=1e-9)
        self.assertNotIn("to go on", self.given().stdout, "given runs are not this command's")


if __name__ == "__main__":
    program.main()
