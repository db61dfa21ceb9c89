#!/usr/bin/python3
"""Results in Python with names and units, and commands as functions. Usage: python_results_test.py PROGRAM"""
import contextlib
import fcntl
import io
import json
import os
import re
import sys
from unittest import mock

import h5py
import numpy as np

import program
from program import ROOT, WRONG_CASE, Scratch, strict_json

sys.path.insert(0, str(ROOT / "python"))
import polybed  # noqa: E402
import polybed.cost.report  # noqa: E402, F401  the functions keep their names
import polybed.fit.errors  # noqa: E402, F401
import polybed.program as of_program  # noqa: E402

CASE = ROOT / "cases/small-binary/case.toml"
SHORT = {"output.every": "1 ms", "output.history_every": "0.1 ms"}
UNTIL = "10 ms"


class Results(Scratch):
    @classmethod
    def setUpClass(cls):
        os.environ["POLYBED"] = program.PROGRAM

    def run_short(self):
        return polybed.run(CASE, "tfm", SHORT, self.folder / "run", UNTIL, quiet=True)

    def test_the_history_is_a_frame(self):
        run = self.run_short()
        with self.assertRaisesRegex(polybed.plot.StudyError, "there is no picture 'histroy'; there are overview, .*history"):
            run.plot("histroy")
        frame = run.frame()
        self.assertEqual((frame.index.name, len(frame)), ("time_s", 101))
        for name in frame:
            np.testing.assert_array_equal(frame[name], run.history[name])
        self.assertEqual([frame.attrs["units"][name] for name in ("bed_height_m", "pressure_drop_Pa", "mixing")], ["m", "Pa", "1"])

    def test_a_grid_of_runs_is_a_table_of_keys_and_cards(self):
        grid = {"inlet.superficial_velocity": ["30 mm/s", "20 mm/s"], "species.fine.diameter": ["0.8 mm", "0.9 mm"]}
        runs = polybed.sweep(CASE, grid, overrides=SHORT, output=self.folder / "grid", until=UNTIL, quiet=True, at_once=2)
        table = polybed.table([runs[0], *(run.directory for run in runs[1:])])
        self.assertEqual(list(table.index), [str(run.directory) for run in runs])
        self.assertEqual(list(table.columns[:2]), ["species.fine.diameter", "inlet.superficial_velocity"])
        np.testing.assert_allclose(table[list(grid)], [[u, d] for u in (0.03, 0.02) for d in (8e-4, 9e-4)], rtol=1e-12)
        self.assertRegex(str(runs[0].directory), r"/superficial_velocity_30_mm_s__diameter_0\.8_mm-\w{10}$")
        self.assertEqual(list(table.columns[-3:]), [name for name in table if table[name].isna().all()][-3:], "what is empty comes last")
        self.assertTrue(table.equals(polybed.table(runs).loc[table.index]))
        self.assertEqual(set(polybed.table(self.folder / "grid").index), set(table.index), "a folder stands for the runs in it")
        with self.assertRaisesRegex(FileNotFoundError, "grid is no run directory; it contains some"):
            polybed.read(self.folder / "grid")
        self.assertEqual(len(polybed.table(runs[0])), 1)
        for run, row in zip(runs, table.itertuples()):
            self.assertEqual((row.run_state, row.state), ("done", run.card["state"]))
            self.assertEqual(row.bed_height_m, run.card["bed_height_m"]["value"])
        self.assertRegex(runs[0]._repr_html_(), rf"Run in {runs[0].directory} by tfm.*<td>bed</td><td>{runs[0].card['state']}, mixed, .* mm high")

    def test_a_table_says_which_runs_stopped_or_lack_a_record(self):
        folder = self.run_short().directory
        record = folder / "run.json"
        record.write_text(json.dumps(strict_json(record.read_text()) | {"state": "running"}))
        for lock, state in ((fcntl.LOCK_EX, "running"), (fcntl.LOCK_UN, "stopped")):
            with open(folder / ".polybed") as mark:
                fcntl.flock(mark, lock)
                self.assertEqual(list(polybed.table(folder)["run_state"]), [state])
        record.unlink()
        with self.assertRaisesRegex(FileNotFoundError, "run has no run.json"):
            polybed.table(folder)

    def test_a_table_of_both_models_names_them(self):
        both = [polybed.run(CASE, model, SHORT, self.folder / model, "2 ms", quiet=True) for model in ("tfm", "dem")]
        self.assertEqual(list(polybed.table(both)["model"]), ["tfm", "dem"])
        self.assertNotIn("model", polybed.table(both[:1]))

    def test_a_species_with_size_classes_has_their_sum(self):
        """In fields and profiles, and for ParaView: to the rounding of single precision."""
        sizes = '[[species]]\nname = "sand"\ndensity = 1395\ndistribution = "lognormal"\nmedian = "1 mm"\ndeviation = 0.2\nclasses = 2\n'
        case = self.write("case.toml", program.small_bed("2 ms").replace(program.TWO_SIZES, sizes).replace("[0.8, 0.2]", "[1]"))
        for model in of_program.MODELS:
            run = polybed.run(case, model, output=self.folder / model, quiet=True)
            self.assertEqual(run.species, ["sand.1", "sand.2"])
            for source in ("fields", "profiles"):
                whole, first, second = (run.quantity(name, source).values for name in ("phi_sand", "phi_sand.1", "phi_sand.2"))
                np.testing.assert_array_equal(whole, first + second)
                self.assertGreater(whole.max(), 0.3, "the start has 0.4")
            np.testing.assert_array_equal(run.dataset().phi_sand, run.phi_sand[:])
            items = re.findall(r'Name="phi_sand".*\n +<DataItem.*Precision="4".*>fields/(.*):(/paraview/phi_sand)<', (run.directory / "fields.xdmf").read_text())
            self.assertEqual(len(items), len(run.time))
            for step, (name, place) in enumerate(items):
                with h5py.File(run.directory / "fields" / name) as file:
                    np.testing.assert_allclose(file[place], run.phi_sand[step], rtol=np.finfo(np.float32).eps)

    def test_a_wrong_name_is_answered_with_the_right_one(self):
        run = self.run_short()
        for place, kind in ((run.history, "history"), (run.card, "card")):
            with self.assertRaisesRegex(KeyError, f"the {kind} of {run.directory} has no bed_height; did you mean bed_height_m"):
                place["bed_height"]

    def test_a_run_goes_on_from_its_checkpoint_if_asked_to(self):
        """The second run is twice as long; without `resume` the folder would be replaced and the history begin anew."""
        folder, keys = self.folder / "run", SHORT | {"output.checkpoint_every": "1 ms"}
        polybed.run(CASE, "tfm", keys, folder, "4 ms", quiet=True)
        before = (folder / "history.csv").read_text()
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            run = polybed.run(CASE, "tfm", keys, folder, "8 ms", resume=True)
        self.assertRegex(shown.getvalue(), r"(?m)^t 0\.00[4-8]/0\.008 s")
        self.assertNotRegex(shown.getvalue(), r"(?m)^t 0\.00[0-3]")
        self.assertTrue((folder / "history.csv").read_text().startswith(before))
        self.assertAlmostEqual(run.history["time_s"][-1], 8e-3)
        swept = polybed.sweep(CASE, "tfm.rtol", [1e-3], overrides=keys, output=self.folder / "new", until="2 ms", quiet=True, resume=True)
        self.assertEqual(swept[0].record["state"], "done", "without a checkpoint a run begins")

    def begins(self, folder, overrides, until="8 ms"):
        """The run that `resume` makes in a folder, and the first time of which it shows progress; None if it opened the run that was there."""
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            run = polybed.run(CASE, "tfm", overrides, folder, until, resume=True)
        times = re.findall(r"(?m)^t ([\d.e-]+)/", shown.getvalue())
        self.assertEqual((run.record["state"], run.history["time_s"][0]), ("done", 0))
        self.assertAlmostEqual(run.history["time_s"][-1], run.record["time_s"])
        self.assertEqual("opened as it is" in shown.getvalue(), run.record["time_s"] > float(until.split()[0]) / 1e3 + 1e-9)
        return run, float(times[0]) if times else None

    def test_resume_loses_no_run(self):
        """What is in the folder reaches 4 ms; from its checkpoint a run shows no earlier time."""
        keys, folder = SHORT | {"output.checkpoint_every": "1 ms"}, self.folder / "run"
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            before = polybed.run(CASE, "tfm", keys, folder, "4 ms", resume=True)
        self.assertIn("run has no run to continue: it begins at 0 s\n", shown.getvalue())
        files = program.lasting(folder)
        for model, overrides, wrong in (("dem", {}, "contains a run by tfm"), ("tfm", {"inlet.superficial_velocity": 0.03}, "of another case"),
                                        ("tfm", {"tfm.rtol": 2e-3}, "the checkpoint is of another case")):
            with self.assertRaisesRegex((polybed.ProgramError, ValueError), wrong):
                polybed.run(CASE, model, keys | overrides, folder, "8 ms", resume=True)
        for until in ("4 ms", "2 ms"):
            self.assertEqual(self.begins(folder, keys, until)[1], None)
        self.assertEqual(program.lasting(folder), files)
        for overrides, until in (({}, "6 ms"), ({"output.every": "2 ms"}, "8 ms")):
            self.assertGreaterEqual(self.begins(folder, keys | overrides, until)[1], 4e-3)
        self.assertEqual(before.record["time_s"], polybed.read(folder).record["time_s"], "the same run, continued")

    def test_a_killed_or_damaged_run_goes_on_and_a_failed_one_does_not(self):
        folder, keys = self.folder / "run", SHORT | {"output.checkpoint_every": "1 ms"}
        for state, goes_on in (("running", True), ("stopped by the user", True), ("failed: the pressure", False), (None, True)):
            with self.subTest(state):
                polybed.run(CASE, "tfm", keys, folder, "4 ms", quiet=True)
                record = strict_json((folder / "run.json").read_text())
                (folder / "run.json").write_text(json.dumps(record | {"state": state}))
                self.assertEqual(self.begins(folder, keys)[1] >= 4e-3, goes_on)

    def test_a_run_until_steady_is_not_that_of_a_time(self):
        """Whether it ended there, or goes on, by the record of a run."""
        folder, text = self.folder / "run", polybed.run(CASE, "tfm", SHORT, self.folder / "run", "4 ms", quiet=True).record["case"]
        record = strict_json((folder / "run.json").read_text())
        for time, steady, plain, to_steady in ((4e-3, False, True, False), (4e-3, True, True, True), (3e-3, True, False, True),
                                               (3e-3, None, True, True), (9e-3, True, False, True), (8e-2, False, False, True)):
            with self.subTest(time=time, steady=steady):
                (folder / "run.json").write_text(json.dumps(record | {"time_s": time, "card": record["card"] | {"steady": steady}}))
                self.assertEqual((of_program.finished(folder, "tfm", text), of_program.finished(folder, "tfm", text, True)), (plain, to_steady))
                self.assertEqual(of_program.later(folder, "tfm", text), time if time > 4e-3 else None)

    def test_a_sweep_says_which_effects_differ_between_its_runs(self):
        cases = [f'[effects]\ndrag = "ergun"\n{lift}[chooser]\nchosen = ["lift", "drag"]\n' for lift in ("", 'lift = "saffman_mei"\n')]
        told = of_program.differing_effects(cases)
        self.assertIn("lift: none in 1, saffman_mei in 1", told)
        self.assertTrue(told.endswith("overrides={'effects.lift': 'saffman_mei'}"), told)
        self.assertEqual(of_program.differing_effects(cases[:1] * 2), "")
        self.assertEqual(of_program.differing_effects(text.replace("chosen", "named") for text in cases), "")

    def test_a_sweep_begins_failed_runs_anew(self):
        """From the checkpoint of its failure a run would fail at once, without a row at the start."""
        def swept(resume):
            return polybed.sweep(CASE, "tfm.fixed_step", [0.2], overrides={"tfm.integrator": "explicit"}, output=self.folder, until="2 s",
                                 quiet=True, resume=resume, keep_failed=True)[0]
        with mock.patch.object(of_program, "call", wraps=of_program.call) as called:
            failed = swept(False)
            again = swept(True)
        self.assertEqual([options[-2] for options, _ in called.call_args_list if options[0] == "tfm"], ["--force", "--force"])
        self.assertEqual((again.directory, again.record["state"]), (failed.directory, failed.record["state"]))
        self.assertRegex(again.record["state"], "^failed")

    def test_a_run_that_fails_ends_a_sweep_unless_it_is_kept(self):
        grid, fixed = {"tfm.fixed_step": [0.2, 5e-4]}, {"tfm.integrator": "explicit"}
        with self.assertRaisesRegex(polybed.ProgramError, "cannot go on"):
            polybed.sweep(CASE, grid, overrides=fixed, output=self.folder / "s", until="0.2 s", quiet=True)
        failed, done = polybed.sweep(CASE, grid, overrides=fixed, output=self.folder / "s", until="0.2 s", quiet=True, keep_failed=True)
        self.assertRegex(failed.record["state"], "^failed: .* cannot go on")
        self.assertEqual(list(polybed.table([failed, done])["run_state"])[1], "done")
        with self.assertRaises(polybed.ProgramError):  # a wrong case is no run
            polybed.sweep(CASE, {"tfm.rtol": [-1]}, output=self.folder / "s", quiet=True, keep_failed=True)

    def test_a_check_is_what_the_program_says(self):
        found = polybed.check(CASE, {"inlet.superficial_velocity": "20 mm/s"})
        answer = strict_json(self.ends(program.DONE, "check", CASE, "--set", "inlet.superficial_velocity=20 mm/s", "--json").stdout)
        self.assertEqual(answer.pop("lines")[0], found.lines[0])
        self.assertEqual(found, answer | {key: found[key] for key in ("memory_MB", "memory", "time", "dem")})  # of this machine at this moment
        self.assertEqual(found["refused"], {"tfm": [], "dem": []})
        self.assertEqual(found["expected"]["state"], "fluidised")
        self.assertEqual(set(found["expected"]["u_mf_m_s"]), {"fine", "coarse", "mixture"})
        self.assertEqual((list(found)[:3], list(found["expected"])[:2]), (["expected", "notes", "refused"], ["state", "bed_height_m"]))
        told = self.ends(program.DONE, "check", CASE, "--set", "inlet.superficial_velocity=20 mm/s").stdout
        self.assertIn("\nexpect        fluidised, about ", repr(found))
        self.assertEqual(repr(found).splitlines()[:4], told.splitlines()[:4])
        self.assertIn("refused: ", repr(polybed.check(CASE, {"effects.contact": "none"})))

    def test_a_table_of_checks_is_a_curve_of_the_laws(self):
        key, values = "inlet.superficial_velocity", [0.02, 0.03]
        checks = [polybed.check(CASE, {key: value}) for value in values]
        table = polybed.table(checks)
        self.assertEqual((list(table[key]), list(table.index)), (values, ["check"] * 2))
        self.assertEqual(list(table["bed_height_m"]), [one["expected"]["bed_height_m"] for one in checks])
        self.assertEqual(list(polybed.table([self.run_short(), checks[0]])["model"]), ["tfm", "check"])

    def test_fields_and_profiles_are_datasets_with_units(self):
        run = self.run_short()
        fields, profiles = run.dataset(), run.dataset("profiles")
        self.assertEqual((fields.phi_fine.dims, fields.u_fluid.dims), (("time", "y", "x"), ("time", "y", "x", "component")))
        self.assertEqual((fields.phi_fine.units, fields.u_fluid.units, fields.time.units, fields.y.units), ("1", "m/s", "s", "m"))
        np.testing.assert_array_equal(fields.time, run.time)
        np.testing.assert_allclose(fields.y, 0.0093 * (np.arange(30) + 0.5), rtol=1e-12)  # 30 cells of 0.279 m
        self.assertEqual(profiles.voidage.dims, ("time", "y"))
        np.testing.assert_array_equal(profiles.voidage, run.profiles["voidage"])
        with self.assertRaisesRegex(KeyError, "has no heat; it has fields, profiles"):
            run.dataset("heat")

    def test_every_way_to_index_gives_the_numbers_of_the_run(self):
        run = self.run_short()
        velocity, whole = run.dataset().u_fluid, run.u_fluid[:]
        for key in ((), (-1,), (slice(2, 9, 3),), (slice(None), 4), (3, slice(None), 1, 0), ([5, 2],), (slice(1, 3), [7, 1]), (2, [4, 4], 0),
                    ([1, 3], slice(5), [0, 1], 1), (slice(8, 2, -2), slice(None, None, -1))):
            expected = whole
            for axis in reversed(range(len(key))):  # one axis after the other: xarray indexes so
                expected = expected[(slice(None),) * axis + (key[axis],)]
            np.testing.assert_array_equal(velocity[key], expected, err_msg=str(key))

    def test_nothing_is_read_before_it_is_asked_for(self):
        run = self.run_short()
        fields = run.dataset()
        (run.directory / "fields/000005.h5").unlink()
        kept = fields.voidage.isel(time=[0, 10]).values
        self.assertEqual(kept.shape, (2, 30, 2))
        with self.assertRaises(FileNotFoundError):
            fields.voidage.isel(time=4).values  # noqa: B018

    def test_measures_are_those_of_the_command(self):
        run = self.run_short()
        self.assertEqual(repr(run), f"Run in {run.directory} by tfm, 0.01 s, done")
        told = strict_json(program.run("measure", run.directory, "--json").stdout)
        self.assertEqual((polybed.measure(run), polybed.measure(run.directory)), (told, told))
        with self.assertRaisesRegex(FileNotFoundError, "no-such-run: no such run directory"):
            polybed.measure(self.folder / "no-such-run")

    def test_a_sweep_over_an_array_says_how_far_it_is(self):
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            runs = polybed.sweep(CASE, "inlet.superficial_velocity", np.array([0.02, 0.03]), overrides=SHORT, output=self.folder, until="2 ms")
        self.assertEqual([run.record["state"] for run in runs], ["done", "done"])
        self.assertIn("1 of 2 runs done: superficial_velocity 0.02\n", shown.getvalue())
        self.assertIn("2 of 2 runs done: superficial_velocity 0.03\n", shown.getvalue())

    def test_a_cost_is_what_the_command_writes(self):
        found = polybed.cost(CASE, "tfm", ("rtol",), budget="120s", output=self.folder / "cost", until="30 ms", quiet=True)
        self.assertEqual(found, strict_json((self.folder / "cost/cost.json").read_text()))
        self.assertEqual(found["filetype"], "polybed cost")
        with self.assertRaisesRegex(polybed.ProgramError, "nonsense") as caught:
            polybed.cost(CASE, axes=("nonsense",), output=self.folder / "other", until="30 ms", quiet=True)
        self.assertEqual(caught.exception.code, WRONG_CASE)

    def test_a_fit_is_what_the_command_writes(self):
        rows, law = ROOT / "tests/data/lbm/tab_A_v.csv", self.folder / "fit"
        found = polybed.fit(rows, output=law, bootstrap=0, quiet=True)
        self.assertEqual(found, strict_json((law / "fit.json").read_text()))
        self.assertEqual((found["form"], found["law"]), ("brinkman_oseen", str(law / "law.json")))
        self.assertEqual(polybed.fit([rows], output=law, bootstrap=0, quiet=True)["created"], found["created"], "it is opened")
        with self.assertRaisesRegex(polybed.ProgramError, "force=True replaces it") as caught:
            polybed.fit([rows], output=law, quiet=True)
        self.assertEqual(caught.exception.code, WRONG_CASE)
        self.assertEqual(polybed.fit([rows], "cello", law, 0, force=True, quiet=True)["form"], "cello")

    def test_shipped_cases_are_found_by_name(self):
        self.assertEqual(polybed.case("small-binary"), CASE)
        self.assertEqual(polybed.case("liquid-bed"), ROOT / "cases/templates/liquid-bed/case.toml")
        with self.assertRaisesRegex(KeyError, "^.*cases has no none; it has .*small-binary"):
            polybed.case("none")
        own = {"species": [{"name": "grit", "diameter": "2 mm", "density": 2650}]}
        self.assertEqual(set(polybed.check(polybed.case("liquid-bed"), own)["expected"]["u_mf_m_s"]), {"grit", "mixture"})

    def test_a_scan_is_an_inversion_by_runs(self):
        found = polybed.inversion(CASE, "tfm", {"output.history_every": "2 ms"}, self.folder / "scan", "0.8 s", quiet=True)
        self.assertEqual(found, strict_json((self.folder / "scan/inversion.json").read_text()))
        self.assertEqual(list(found["models"]), ["tfm"])


if __name__ == "__main__":
    program.main()
