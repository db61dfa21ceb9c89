#!/usr/bin/python3
"""Runs of the continuum model: what they write, how they stop and go on. Usage: run_test.py PROGRAM"""
import csv
import os
import shlex
import shutil

import h5py
import numpy as np

import program
from program import CASE, DONE, FILE, NUMBERS, SMALL, WRONG_CASE, Scratch, history, same_bits, small_bed, strict_json

SPECIES = ("fine", "coarse")


class Run(Scratch):
    def test_a_run_writes_every_file_of_the_contract(self):
        directory = self.folder / "run"
        done = self.ends(DONE, "tfm", CASE, *SMALL, "--until", "0.3 s", "-o", directory, "--json", picture=True)
        for name in ("history.csv", "profiles.h5", "fields.h5", "fields.xdmf", "checkpoint.h5", "run.json", "steps.csv", "picture.png"):
            self.assertGreater((directory / name).stat().st_size, 0, name)
        self.assertEqual([p.name for p in directory.rglob("*.temporary")], [])
        self.check_record(strict_json((directory / "run.json").read_text()))
        self.assertEqual(strict_json(done.stdout)["work"], strict_json((directory / "run.json").read_text())["work"])
        self.check_history(directory)
        self.check_hdf5(directory)
        self.has_no_nan(directory)

    def check_record(self, record):
        for key in ("program", "git_commit", "case", "case_hash", "ranks", "machine", "timers", "guards", "warnings"):
            self.assertIn(key, record)
        self.assertEqual((record["filetype"], record["version"], record["state"]), ("polybed run", 1, "done"))
        self.assertEqual(record["time_s"], 0.3)
        self.assertIn("column.cells=[6,60]", record["overrides"])
        self.assertIn("cells = [6, 60]", record["case"])
        for counter in ("steps", "rhs_evaluations", "linear_iterations"):
            self.assertGreater(record["work"][counter], 10, counter)
        self.assertTrue(all(i["held"] for i in record["invariants"]), record["invariants"])
        self.assertEqual(record["warnings"], ["off in the case, but needed: fluid_stress 16 %; see polybed effects"])
        self.assertNotIn("last_steps", record)  # of a run that has failed

    def check_history(self, directory):
        columns = history(directory)
        expected = ["time_s", "dt_s", "bed_height_m", "dense_height_m", "pressure_drop_Pa", "buoyant_weight_Pa"]
        expected += [f"{q}_{s}_{unit}" for s in SPECIES for q, unit in (("centre", "m"), ("mass", "kg"), ("top", "m"))] + ["interface_m"]
        self.assertEqual(list(columns)[:len(expected)], expected)
        # every 0.01 s from 0 to 0.3 s, both ends
        np.testing.assert_allclose(columns["time_s"], np.arange(31) * 0.01, atol=1e-12)
        self.assertTrue(np.all(np.diff(columns["time_s"]) > 0))
        for s in SPECIES:
            mass = np.array(columns[f"mass_{s}_kg"])
            # the limit of the program's own invariant: 1e-12 of the mass
            self.assertLess(np.ptp(mass), 1e-12 * mass[0])

    def check_hdf5(self, directory):
        with h5py.File(directory / "fields.h5") as fields, h5py.File(directory / "profiles.h5") as profiles:
            for file in (fields, profiles):
                for name in ("filetype", "version", "git_commit"):
                    self.assertIn(name, file.attrs)
            self.assertEqual(sorted(fields["step"]), ["000001", "000002", "000003", "000004"])
            times = [fields["step"][n].attrs["time_s"] for n in sorted(fields["step"])]
            np.testing.assert_allclose(times, [0, 0.1, 0.2, 0.3], atol=1e-12)
            self.assertEqual((len(fields["grid/x"]), len(fields["grid/y"])), (7, 61))
            last = fields["step/000004"]
            solids = sum(last[f"phi_{s}"][()] for s in SPECIES)
            np.testing.assert_allclose(last["voidage"][()] + solids, 1, atol=1e-12)  # rounding of a sum of three
            self.assertEqual(last["pressure"].shape, (60, 6))
            for name in ["u_fluid"] + [f"u_{s}" for s in SPECIES]:
                self.assertEqual(last[name].shape, (60, 6, 2))
            for name in ["voidage", "p"] + [f"{q}_{s}" for q in ("phi", "u") for s in SPECIES]:
                self.assertEqual(profiles[name].shape, (4, 60), name)
            np.testing.assert_allclose(profiles["voidage"][3], last["voidage"][()].mean(axis=1), atol=1e-12)  # a mean

    def test_a_run_that_fails_tells_its_last_steps(self):
        """A monitor that ends the run, at its third look, is as good a failure as any."""
        directory = self.folder / "run"
        done = self.ends(NUMBERS, "tfm", CASE, *SMALL, "--until", "1 s", "-o", directory, "--quiet", "--set", "chooser.monitor=stop", "--set",
                         "chooser.monitor_every=6", "--set", "chooser.monitor_sample=1", "--set", "chooser.tolerance=1e-6")
        with open(directory / "steps.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 10)
        told = strict_json((directory / "run.json").read_text())["last_steps"]
        self.assertEqual([(str(step["time_s"]), step["limited_by"]) for step in told],
                         [(str(float(row["time_s"])), row["limited_by"]) for row in rows[-10:]])
        lines = done.stderr.splitlines()
        for row in rows[-10:]:
            self.assertTrue(any(f"{float(row['time_s']):.6g} " in line and line.endswith(row["limited_by"]) for line in lines), row)

    def test_what_still_drifts_and_how_well_posed_the_bed_was_is_told(self):
        directory = self.folder / "run"
        done = self.ends(DONE, "tfm", CASE, *SMALL, "--until", "1 s", "--details", "-o", directory, "--no-picture", picture=True)
        self.assertFalse((directory / "picture.png").exists())
        self.assertNotIn("picture", done.stderr)
        record, columns = strict_json((directory / "run.json").read_text()), history(directory)
        measures = {m["name"]: m for m in record["drift"]["measures"]}
        self.assertEqual(list(measures), ["bed_height", "centre_fine", "centre_coarse"])
        self.assertAlmostEqual(record["drift"]["window_s"], 0.25, delta=1e-12)
        for name, m in measures.items():
            # the line through all 26 rows of the window in place of the means of its parts: the same within two intervals
            slope = np.polyfit(columns["time_s"][-26:], columns[f"{name}_m"][-26:], 1)[0]
            self.assertLess(abs(m["rate_m_per_s"] - slope), 2 * m["error_m_per_s"], name)
        self.assertFalse(measures["bed_height"]["steady"], "the packed bed rises at the fluid's 30 mm/s")
        line = next(w for w in record["warnings"] if w.startswith("not steady: drift of bed_height"))
        self.assertIn(line + "\n", done.stderr)
        posed = record["well_posedness"]
        self.assertRegex(done.stderr, r"well-posedness: least dp_s/dphi over its critical .* below 1 in .* % of the bed's cells")
        self.assertEqual((posed["least"], len(posed["place_m"])), (0, 2), "lifted, no stress reaches some cells of the bed")
        self.assertGreater(posed["critical_slope_Pa"], 0)
        self.assertTrue(0 < posed["share_below_1"] <= 1)

    def test_the_command_that_goes_on_is_one_for_a_shell(self):
        folder = self.folder / "a bed's"
        folder.mkdir()
        case, directory = folder / "case.toml", folder / "run 1"
        shutil.copy(CASE, case)
        done = self.ends(DONE, "tfm", case, *SMALL, "--until", "1 s", "-o", directory)
        [line] = [line for line in done.stderr.splitlines() if line.startswith("to go on")]
        words = shlex.split(line.removeprefix("to go on"))
        self.assertEqual(words, ["polybed", "tfm", str(case), "-o", str(directory), "--resume", *SMALL, "--until", "2 s"])

    def test_directories(self):
        short = [CASE, *SMALL, "--until", "0.01 s", "--quiet"]
        first = self.folder / "deep/down"
        self.assertEqual(self.ends(DONE, "tfm", *short, "-o", first).stderr, "")
        again = self.ends(WRONG_CASE, "tfm", *short, "-o", first)
        self.assertIn("--resume", again.stderr)
        self.assertIn("--force", again.stderr)
        self.ends(DONE, "tfm", *short, "-o", first, "--force")
        self.assertIn("no checkpoint", self.ends(FILE, "tfm", *short, "-o", self.folder / "new", "--resume").stderr)
        other = self.ends(WRONG_CASE, "tfm", *short, "-o", first, "--resume", "--set", "tfm.rtol=1e-4")
        self.assertIn("another case", other.stderr)
        self.ends(DONE, "tfm", *short, cwd=self.folder)
        self.assertTrue((self.folder / "runs/matsuura-akehata-tfm/run.json").exists())

    def test_a_directory_that_cannot_be_written(self):
        taken = self.write("taken", "a file")
        places = [taken, taken / "below", "/proc/nowhere"]
        if os.geteuid() != 0:  # root may write everywhere
            locked = self.folder / "locked"
            locked.mkdir(mode=0o500)
            places.append(locked)
        for place in places:
            done = self.ends(FILE, "tfm", CASE, *SMALL, "--until", "0.01 s", "--quiet", "-o", place)
            self.assertIn(str(place), done.stderr)


# An imex run in which the jump of the inlet at 0.03 s takes a solids fraction below its limit.
JUMP = """[column]
size = [0.002768, 0.04761]
cells = [1, 36]
depth = 0.01
[fluid]
name = "air"
temperature = 809.96
[[species]]
name = "fine"
diameter = 0.000577433
density = 3100.0
[[species]]
name = "coarse"
distribution = "lognormal"
median = 0.000851
deviation = 0.2594
classes = 1
density = 8000.0
[bed]
volume_share = [0.0, 1.0]
static_height = 0.0201
solids_fraction = 0.6
start = "mixed"
[inlet]
superficial_velocity = [[0.021, 1.91], [0.03, 0.63], [0.03, 0.798157]]
[effects]
drag = "vbk"
fluid_stress = "newtonian"
solids_stress = "none"
species_exchange = "syamlal"
added_mass = "half"
lift = "saffman_mei"
others = "none"
[tfm]
integrator = "imex"
momentum = "conservative_limited"
specularity = 0.490383
wall_friction = 0.1879
[run]
until = 0.03
[output]
every = 0.03
history_every = 0.0003
checkpoint_every = 0.0107196
"""


class Stop(Scratch):
    def test_ctrl_c_leaves_a_run_that_goes_on(self):
        """An interruption puts a checkpoint where none was, and a checkpoint is part of the result: what went before is
        that of a run that was not stopped, and what comes after is the same each time."""
        whole, stopped, twin, before = (self.folder / n for n in ("whole", "stopped", "twin", "before"))
        words = ["tfm", CASE, *SMALL, "--until", "1 s", "--quiet"]
        reached = self.interrupted(stopped, *words, clock="time_s")["time_s"]
        self.assertTrue(0.1 <= reached < 1, reached)
        shutil.copytree(stopped, twin)
        shutil.copytree(stopped, before)
        (before / "checkpoint.previous.h5").rename(before / "checkpoint.h5")  # the last one that the whole run writes too
        for directory in (stopped, twin, before):
            self.ends(DONE, *words, "-o", directory, "--resume")
        self.ends(DONE, *words, "-o", whole)
        for name in ("checkpoint.h5", "fields.h5", "profiles.h5"):
            self.assertEqual(same_bits(stopped / name, twin / name), [], name)
            self.assertEqual(same_bits(whole / name, before / name), [], name)
        self.assertEqual(program.lasting(whole), program.lasting(before))
        one, other = history(stopped), history(whole)
        self.assertEqual(one, history(twin))
        # A stop leaves out outputs of its own step, which may pass several.
        left_out = [n for n, t in enumerate(other["time_s"]) if t not in one["time_s"]]
        self.assertTrue(all(reached - max(other["dt_s"]) < other["time_s"][n] <= reached for n in left_out), left_out)
        other = {name: [x for n, x in enumerate(column) if n not in left_out] for name, column in other.items()}
        self.assertEqual(one["time_s"], other["time_s"])
        before = sum(t <= reached for t in one["time_s"])
        for column in one:
            self.assertEqual(one[column][:before], other[column][:before], column)
        self.assertEqual(strict_json((stopped / "run.json").read_text())["state"], "done")
        self.has_no_nan(stopped)

    def test_a_run_in_two_parts_is_the_run_in_one(self):
        whole, parts = self.folder / "whole", self.folder / "parts"
        words = ["tfm", CASE, *SMALL, "--quiet"]
        self.ends(DONE, *words, "--until", "0.3 s", "-o", whole)
        self.ends(DONE, *words, "--until", "0.1 s", "-o", parts)
        self.ends(DONE, *words, "--until", "0.3 s", "-o", parts, "--resume")
        for name in ("fields.h5", "profiles.h5"):
            self.assertEqual(same_bits(whole / name, parts / name), [], name)
        self.assertEqual(history(whole), history(parts))
        self.assertEqual((whole / "steps.csv").read_text(), (parts / "steps.csv").read_text())
        self.assertEqual(program.lasting(whole), program.lasting(parts))

    def test_a_resumed_run_keeps_what_it_has_met(self):
        """The lowest solids fraction is met in the first part, and what the monitor warns of begins there."""
        case = self.write("jump.toml", JUMP)
        watched = ["--set", "chooser.monitor=warn", "--set", "chooser.tolerance=1e-6", "--set", "chooser.monitor_every=7"]
        for number, words in enumerate(([], watched)):
            whole, parts = self.folder / f"whole{number}", self.folder / f"parts{number}"
            words = ["tfm", case, "--quiet", *words]
            self.ends(DONE, *words, "--until", "0.0302 s", "-o", whole)
            self.ends(DONE, *words, "-o", parts)
            first = program.lasting(parts)
            self.ends(DONE, *words, "--until", "0.0302 s", "-o", parts, "--resume")
            resumed = program.lasting(parts)
            self.assertEqual(resumed["invariants"], first["invariants"])
            [below] = [law for law in resumed["invariants"] if law["name"] == "solids fraction below 0"]
            self.assertGreater(below["worst"], 0)
            self.assertLess(below["time_s"], 0.03, "met in the first part")
            self.assertEqual(resumed, program.lasting(whole))
            for name in ("checkpoint.h5", "fields.h5", "profiles.h5"):
                self.assertEqual(same_bits(whole / name, parts / name), [], name)
        self.assertTrue(resumed["promise"]["observed"][-1]["above_tolerance"], "nothing was watched")

    def test_the_end_does_not_move_checkpoints(self):
        """Without output.checkpoint_every they come every tenth of the run that the case asks for."""
        rows = ["--set", "output.every=1e-3", "--set", "output.history_every=1e-4", "--quiet", "--no-picture"]
        case = self.write("case.toml", small_bed("4 ms"))
        for model in ("tfm", "dem"):
            whole, parts = self.folder / f"{model}-whole", self.folder / f"{model}-parts"
            self.ends(DONE, model, case, *rows, "--until", "7 ms", "-o", whole)
            self.ends(DONE, model, case, *rows, "-o", parts)
            self.ends(DONE, model, case, *rows, "--until", "7 ms", "-o", parts, "--resume")
            for name in ("checkpoint.h5", "profiles.h5"):
                self.assertEqual(same_bits(whole / name, parts / name), [], f"{model} {name}")
            self.assertEqual(history(whole), history(parts))
            self.assertEqual(program.lasting(whole), program.lasting(parts))

    def test_stops_an_ulp_apart_are_one(self):
        """IDA starts no step towards a stop that round-off alone keeps apart from the present."""
        self.assertLess(5 * 0.022, 0.11)
        self.assertGreater(3 * 0.05, 0.15)
        words = ["tfm", CASE, *SMALL, "--quiet", "--set", "tfm.integrator=implicit", "--set", "column.cells=[4,30]"]
        end = self.folder / "end"
        self.ends(DONE, *words, "--until", "0.11 s", "--set", "output.checkpoint_every=0.022", "-o", end)
        self.assertEqual(history(end)["time_s"][-2:], [0.1, 0.11])
        words += ["--set", "inlet.superficial_velocity=[[0,0.02],[0.15,0.03],[0.15,0.02]]"]
        words += ["--set", "output.checkpoint_every=0.05", "--set", "output.every=0.05"]
        whole, parts = self.folder / "whole", self.folder / "parts"
        self.ends(DONE, *words, "--until", "0.2 s", "-o", whole)
        self.ends(DONE, *words, "--until", "0.15 s", "-o", parts)
        self.ends(DONE, *words, "--until", "0.2 s", "-o", parts, "--resume")
        self.assertEqual(same_bits(whole / "fields.h5", parts / "fields.h5"), [])
        self.assertEqual(history(whole), history(parts))
        self.assertEqual(history(whole)["time_s"].count(0.15), 1)


if __name__ == "__main__":
    program.main()
