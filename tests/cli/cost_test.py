#!/usr/bin/python3
"""polybed estimate and polybed cost as their user meets them. Usage: cost_test.py PROGRAM"""
import json
import pathlib
import re
import signal
import tempfile
import time

import program
from program import DONE, NUMBERS, WRONG_CASE, Scratch, strict_json

BED = program.small_bed("0.1 s")  # a tenth of a second of computing
CLAY = """column = { size = [0.02, 0.2], cells = [1, 10], sides = "periodic", closed = true }
fluid = { name = "water", temperature = "20 degC" }
bed = { volume_share = [1], static_height = "10 mm", solids_fraction = 0.55, start_solids_fraction = 0.03, perturbation = 0 }
run = { until = "1 h" }
effects = { others = "none", drag = "wen_yu", solids_stress = "frictional" }
tfm = { rtol = 1e-6 }
[[species]]
name = "clay"
diameter = "2 um"
density = 2650
"""
SWEEP = ["--axes", "rtol,scheme", "--no-picture", "--quiet", "--budget", "500s"]
ROWS = ["time integration", "space", "solver and coupling tolerance", "statistics", "closure spread", "level"]


def without_times(sweep):
    """A sweep as it has to be every time."""
    for run in sweep["runs"]:
        for name in ("cpu_s", "wall_s"):
            del run[name]
    return sweep


class Estimate(Scratch):
    def test_tells_time_memory_disk_and_three_ways(self):
        case = self.write("case.toml", BED)
        for model in ("tfm", "dem"):
            told = strict_json(self.ends(DONE, "estimate", case, "--model", model, "--json").stdout)
            self.assertEqual(told["model"], model)
            time_of = told["cpu_s"]
            self.assertLess(0, time_of["least"])
            self.assertLess(time_of["least"], time_of["expected"])
            self.assertLess(time_of["expected"], time_of["most"])
            self.assertGreater(told["memory_MB"], 10)
            self.assertGreater(told["disk_MB"], 0.01)
            self.assertGreaterEqual(len(told["ways"]), 2)
            self.assertTrue({way["evidence"] for way in told["ways"]} <= {"measured", "extrapolated", "literature"})
        tapered, across = program.ROOT / "cases/templates/tapered-bed/case.toml", ("--set", 'column.shape="cylinder"', "--set",
                                                                                   "column.size=[0.06,0.06,0.4]", "--set", "column.cells=[12,12,80]")
        self.assertNotIn("column.cells = [1", self.ends(DONE, "estimate", tapered).stdout)  # which `check` refuses
        self.assertIn('column.shape = "axisymmetric"', self.ends(DONE, "estimate", tapered, *across).stdout)
        self.assertIn("a probe of", self.ends(DONE, "estimate", case, "--probe", "50 ms").stdout)
        self.ends(WRONG_CASE, "estimate", case, "--probe", "5 m")
        self.ends(WRONG_CASE, "estimate")

    def test_steps_and_their_length_are_those_of_the_run(self):
        """Their product is the time simulated; 5 % for a length of two digits."""
        case = self.write("case.toml", BED)
        for words in ((), ("--set", "tfm.integrator=implicit")):
            text = self.ends(DONE, "estimate", case, *words, "--set", "run.until=30").stdout
            number, step = re.search(r"steps +([\d.e+-]+) of ([\d.e+-]+) s", text).groups()
            self.assertAlmostEqual(float(number) * float(step), 30, delta=0.05 * 30)

    def test_steps_of_a_bed_that_settles_slowly(self):
        """A lone particle falls a cell in 1.5 h, freely in 57 ms: by the latter an hour would take 1.3 million steps. A tight tolerance, since
        the steps of a loose one are as few as the checkpoints."""
        case = self.write("clay.toml", CLAY)
        expected = strict_json(self.ends(DONE, "estimate", case, "--json").stdout)["steps"]
        run = strict_json(self.ends(DONE, "tfm", case, "--json", "--quiet", "--no-picture", "-o", self.folder / "clay").stdout)
        self.assertLess(expected, 2 * run["work"]["steps"])
        self.assertGreater(expected, run["work"]["steps"] / 2)

    def test_a_run_is_predicted_by_its_own_first_steps(self):
        """Some seconds of computing: what check and estimate say, and what the run says once it has timed its steps, are one forecast."""
        case = self.write("case.toml", BED)
        longer = ["--set", "run.until=4"]
        told = strict_json(self.ends(DONE, "estimate", case, *longer, "--json").stdout)["cpu_s"]["expected"]
        run = strict_json(self.ends(DONE, "tfm", case, *longer, "--json", "--quiet", "--no-picture", "-o", self.folder / "long").stdout)
        predicted = run["prediction"]["cpu_s"]
        # Each by a quarter of a second of steps on a machine that others use, too.
        self.assertLess(max(predicted, told) / min(predicted, told), 3)

    def test_a_run_tells_what_was_predicted(self):
        case = self.write("case.toml", BED)
        record = strict_json(self.ends(DONE, "tfm", case, "--until", "10 ms", "--json", "-o", self.folder / "run").stdout)
        told = record["prediction"]
        self.assertEqual(told["actual_s"], record["cpu_s"])
        self.assertEqual(told["within"], told["least_s"] <= told["actual_s"] <= told["most_s"])


class Cost(Scratch):
    """One sweep, done once, that each test has at hand."""

    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.kept.cleanup)
        folder = pathlib.Path(cls.kept.name)
        cls.case, cls.sweep_folder = folder / "case.toml", folder / "sweep"
        cls.case.write_text(BED)
        cls.done = program.run("cost", cls.case, *SWEEP, "-o", cls.sweep_folder, "--json", timeout=500)

    def sweep(self):
        self.assertEqual(self.done.returncode, DONE, self.done.stderr[-500:])
        return strict_json(self.done.stdout)

    def test_a_sweep_ranks_and_recommends(self):
        sweep = self.sweep()
        self.assertEqual((sweep["filetype"], sweep["version"], sweep["outcome"]), ("polybed cost", 1, "done"))
        self.assertEqual(strict_json((self.sweep_folder / "cost.json").read_text()), sweep)
        self.assertEqual([share["row"] for share in sweep["attribution"]], ROWS)
        statuses = {run["status"] for run in sweep["runs"]}
        self.assertLessEqual(statuses, {"pareto", "dominated", "hollow", "model", "predicted", "failed", "refused", "not run"})
        front = [sweep["runs"][n] for n in sweep["pareto"]]
        costs = sorted((run["s_per_sim_s"], run["qoi"]["bed_height"]["error"]) for run in front)
        self.assertEqual(costs, sorted(costs, key=lambda pair: -pair[1]), "dearer is more accurate on the front")
        advised = sweep["recommend"][0]
        chosen = sweep["runs"][advised["run"]]
        self.assertLessEqual(chosen["qoi"]["bed_height"]["error"], sweep["target"])
        for run in sweep["runs"]:  # nothing that reaches the target is cheaper
            if run["kind"] == "candidate" and run["status"] in ("pareto", "dominated", "hollow"):
                if run["qoi"]["bed_height"]["error"] + run["qoi"]["bed_height"]["error_ci"] <= sweep["target"]:
                    self.assertGreaterEqual(run["s_per_sim_s"], chosen["s_per_sim_s"])
        apart = [run["qoi"][name]["error"] for run in front for name in ("composition", "profile")]
        self.assertTrue(all(0 <= one < 0.5 for one in apart) and max(apart) > 0, apart)
        text = (self.sweep_folder / "cost.md").read_text()
        self.assertIn("For an error of at most 1 % in bed_height use", text)
        self.assertIn("To measure them: --axes grid,drag,effects,level.", text)
        self.assertNotIn("that is what to improve", text)

    def test_the_recommendation_is_confirmed(self):
        self.sweep()
        told = self.ends(DONE, "cost", "check", self.sweep_folder).stdout
        self.assertEqual(told.count(": holds"), 2, told)
        self.assertTrue(strict_json((self.sweep_folder / "cost.json").read_text())["recommend"][0]["confirmed"])
        for number, claim in (("error", 1.0), ("s_per_sim_s", 1e3)):  # what is claimed wrongly is told
            wrong = self.folder / number
            wrong.mkdir()
            sweep = strict_json((self.sweep_folder / "cost.json").read_text())
            sweep["recommend"][0][number] = claim
            (wrong / "cost.json").write_text(json.dumps(sweep))
            self.assertEqual(self.ends(NUMBERS, "cost", "check", wrong).stdout.count(": does not hold"), 1)
        changed = self.folder / "changed"
        changed.mkdir()
        sweep["case_path"] = str(self.write("changed.toml", BED.replace("20 mm/s", "21 mm/s")))
        (changed / "cost.json").write_text(json.dumps(sweep))
        self.assertIn("was changed since it was swept", self.ends(WRONG_CASE, "cost", "check", changed).stderr)

    def test_a_killed_sweep_goes_on_to_the_same(self):
        first, folder = self.sweep(), self.folder / "killed"
        running = self.start("cost", self.case, *SWEEP, "-o", folder)
        program.wait_until(running, lambda: len(list(folder.glob("runs/*/end.json"))) >= 3)
        running.send_signal(signal.SIGKILL)
        running.communicate()
        again = self.ends(DONE, "cost", self.case, *SWEEP, "-o", folder, "--resume", "--json", timeout=500)
        first["recommend"][0]["confirmed"] = False
        self.assertEqual(without_times(strict_json(again.stdout)), without_times(first))

    def test_a_budget_is_kept(self):
        begin = time.monotonic()
        small = program.run("cost", self.case, *SWEEP[:-1], "3s", "-o", self.folder / "short", "--json")
        took = time.monotonic() - begin
        sweep = strict_json(small.stdout)
        self.assertLessEqual(sum(sum(run["wall_s"]) for run in sweep["runs"]), 1.1 * 3)
        self.assertLess(took, 1.1 * 3 + 5)  # the command's own start and files, on a busy machine
        if small.returncode == DONE:
            self.assertIn("not run", {run["status"] for run in sweep["runs"]})
        else:
            self.assertEqual((small.returncode, sweep["outcome"]), (NUMBERS, "refused"))

    def test_what_cannot_be_known_is_refused(self):
        told = self.ends(NUMBERS, "cost", self.case, "--axes", "rtol", *SWEEP[2:], "--reference", "exact", "-o", self.folder / "exact",
                         "--json", timeout=500).stdout
        sweep = strict_json(told)
        self.assertEqual((sweep["outcome"], sweep["recommend"]), ("refused", []))
        self.assertIn("no exact value", sweep["reason"])
        self.assertIn("rtol", self.ends(WRONG_CASE, "cost", self.case, "--axes", "nonsense").stderr)
        self.assertIn("nonsense", self.ends(WRONG_CASE, "cost", self.case, "--qoi", "nonsense", "-o", self.folder / "q").stderr)
        self.assertIn("no uncertainty", self.ends(WRONG_CASE, "cost", self.case, "--qoi", "profile", "-o", self.folder / "q").stderr)
        self.assertIn("--resume", self.ends(WRONG_CASE, "cost", self.case, *SWEEP, "-o", self.sweep_folder).stderr)


if __name__ == "__main__":
    program.main()
