#!/usr/bin/python3
"""polybed dem as its user meets it: files, resumed and stopped runs, refusals, disks. Usage: dem_test.py PROGRAM"""
import os
import re
import resource
import shutil
import signal

import h5py
import numpy as np

import program
from program import DONE, FILE, NUMBERS, WRONG_CASE, Scratch, datasets, falling, history, same_bits, strict_json

# 300 spheres of two sizes that fall in a column with a periodic depth; a step takes about 50 microseconds.
FALL = falling('size = ["12 mm", "30 mm"]\ncells = [6, 30]', [250, 50], 0.4, "0.5 ms")
PAIR = """[column]
size = ["20 mm", "20 mm", "20 mm"]
cells = [4, 4, 4]
gravity = 0
[fluid]
name = "none"
[[species]]
name = "beads"
diameter = "1 mm"
density = 2500
[bed]
start = "list:pair.csv"
[effects]
others = "none"
contact = "hertz_mindlin"
[dem]
greatest_speed = "0.1 m/s"
[run]
until = "20 ms"
"""
RESULTS = ("checkpoint.h5", "particles.h5", "profiles.h5")
COLUMNS = ["time_s", "dt_s", "bed_height_m", "dense_height_m", "pressure_drop_Pa", "buoyant_weight_Pa", "centre_fine_m", "mass_fine_kg",
           "top_fine_m", "centre_coarse_m", "mass_coarse_kg", "top_coarse_m", "interface_m", "kinetic_J", "rotational_J", "elastic_J", "potential_J",
           "dissipated_J", "work_J", "contacts", "max_overlap_m", "max_contact_force_N"]


class Dem(Scratch):
    def setUp(self):
        super().setUp()
        self.case = self.write("case.toml", FALL)

    def dem(self, code, directory, *words, case=None):
        return self.ends(code, "dem", case or self.case, "--quiet", "-o", self.folder / directory, *words)

    def whole_run(self):
        self.dem(DONE, "whole")
        return self.folder / "whole"


class Files(Dem):
    def test_history_and_particles_hold_what_is_promised(self):
        directory = self.whole_run()
        rows = history(directory)
        for name in COLUMNS:
            self.assertIn(name, rows)
        self.assertEqual(len(rows["time_s"]), 41)  # 0 to 20 ms each 0.5 ms
        # masses by hand: n rho pi/6 D^3; 1e-12 for rounding
        self.assertAlmostEqual(rows["mass_fine_kg"][-1] / (250 * 2500 * np.pi / 6 * 1e-9), 1, delta=1e-12)
        self.assertAlmostEqual(rows["mass_coarse_kg"][-1] / (50 * 2000 * np.pi / 6 * 3.375e-9), 1, delta=1e-12)
        with h5py.File(directory / "particles.h5") as file:
            self.assertEqual(file.attrs["filetype"], b"polybed particles" if isinstance(file.attrs["filetype"], bytes)
                             else "polybed particles")
            np.testing.assert_allclose(file["time_s"][()], [0, 0.005, 0.01, 0.015, 0.02], rtol=1e-12)
            last = file["step/000005"]
            self.assertAlmostEqual(last.attrs["time_s"], 0.02)
            self.assertEqual(list(last["id"]), list(range(300)))
            self.assertEqual(list(last["species"]), [0] * 250 + [1] * 50)
            np.testing.assert_allclose(last["radius"], [5e-4] * 250 + [7.5e-4] * 50, rtol=1e-15)
            for name in ("position", "velocity", "spin"):
                self.assertEqual(last[name].shape, (300, 3))
                self.assertTrue(np.isfinite(last[name][()]).all())
            mass = np.array([2500 * np.pi / 6 * 1e-9] * 250 + [2000 * np.pi / 6 * 3.375e-9] * 50)
            kinetic = 0.5 * (mass * (last["velocity"][()] ** 2).sum(axis=1)).sum()
            # both are of the last step; the history's sum is in units of some 1e-17 of the greatest energy
            self.assertAlmostEqual(rows["kinetic_J"][-1] / kinetic, 1, delta=1e-9)
        for name in ("particles.xdmf", "checkpoint.h5", "profiles.h5", "run.json"):
            self.assertTrue((directory / name).exists(), name)

    def test_the_record_says_step_work_and_energy(self):
        done = self.dem(DONE, "run", "--json")
        record = strict_json(done.stdout)
        self.assertEqual((record["model"], record["state"], record["particles"]), ("dem", "done", 300))
        self.assertEqual(record["work"]["particle_steps"], 300 * record["work"]["steps"])
        limits = record["step"]["limits"]
        self.assertEqual(record["step"]["dt_s"], min(limit["dt_s"] for limit in limits))
        self.assertIn(record["step"]["limited_by"], [limit["name"] for limit in limits])
        self.assertLess(record["energy"]["worst_error"], record["energy"]["limit"])
        self.assertEqual(strict_json((self.folder / "run/run.json").read_text())["state"], "done")

    def test_the_record_says_whether_the_ledger_held(self):
        """A step of some quarter of a contact is too long: energy comes from nowhere, and the record says so."""
        self.dem(DONE, "held", "--until", "10 ms")
        self.dem(DONE, "broken", "--until", "20 ms", "--permissive", "--set", "dem.fixed_step=4e-5", "--set", "dem.max_overlap=0.3")
        for name in ("held", "broken"):
            record = strict_json((self.folder / name / "run.json").read_text())
            energy, count = record["invariants"]
            self.assertEqual((count["name"], count["worst"], count["limit"]), ("particle count", 0, 0))
            self.assertEqual((energy["name"], energy["limit"]), ("energy", 1e-3))
            self.assertEqual(energy["worst"], record["energy"]["worst_error"])
            self.assertEqual(energy["held"], name == "held")
            self.assertEqual(energy["worst"] <= 1e-3, name == "held")
            self.assertEqual(any(w.startswith("energy exceeded its limit") for w in record["warnings"]), name == "broken")
            self.assertTrue(0 < energy["time_s"] <= record["time_s"])
        self.dem(DONE, "none", "--until", "1 ms", "--set", "dem.ledger=false")
        none = strict_json((self.folder / "none/run.json").read_text())
        self.assertEqual([i["name"] for i in none["invariants"]], ["particle count"])

    def test_without_the_ledger_its_columns_are_absent(self):
        self.dem(DONE, "run", "--set", "dem.ledger=false", "--until", "1 ms")
        rows = history(self.folder / "run")
        self.assertEqual([n for n in COLUMNS if n not in rows], ["dissipated_J", "work_J"])


    def test_its_pictures_show_what_it_has(self):
        """Without the ledger there are energies still, and without a fluid there is no pressure drop."""
        self.ends(DONE, "dem", self.case, "--quiet", "-o", self.folder / "run", "--set", "dem.ledger=false", "--until", "5 ms", picture=True)
        self.assertTrue((self.folder / "run/picture.png").exists())
        done = self.ends(DONE, "plot", self.folder / "run", "--what", "overview,particles,profiles,history", "--format", "svg",
                         "--out", self.folder / "drawn")
        self.assertEqual(len(done.stdout.split()), 4)
        text = (self.folder / "drawn/history.svg").read_text()  # matplotlib writes each text as a comment beside its glyphs
        self.assertIn("energy of the", text)
        self.assertNotIn("pressure drop", text)
        self.assertNotIn("does not close", text)


class GoOn(Dem):
    def test_resumed_is_the_same_to_the_bit(self):
        whole = self.whole_run()
        self.dem(DONE, "parts", "--until", "10 ms")
        self.dem(DONE, "parts", "--resume")
        for name in RESULTS:
            self.assertEqual(same_bits(whole / name, self.folder / "parts" / name), [], name)
        self.assertEqual((whole / "history.csv").read_bytes(), (self.folder / "parts/history.csv").read_bytes())
        self.assertEqual(program.lasting(whole), program.lasting(self.folder / "parts"))

    def test_twice_is_the_same_to_the_bit(self):
        whole = self.whole_run()
        self.dem(DONE, "again")
        for name in RESULTS:
            self.assertEqual(same_bits(whole / name, self.folder / "again" / name), [], name)

    def test_ctrl_c_leaves_a_run_that_goes_on(self):
        directory = self.folder / "run"
        record = self.interrupted(directory, "dem", self.case, "--quiet", "--until", "5 s", clock="time")
        until = record["time_s"] + 1e-3
        twin = self.folder / "twin"
        shutil.copytree(directory, twin)
        for run in (directory, twin):
            self.dem(DONE, run, "--resume", "--until", f"{until}")
        for name in RESULTS:
            self.assertEqual(same_bits(directory / name, twin / name), [], name)
        self.assertAlmostEqual(history(directory)["time_s"][-1], until)

    def test_a_killed_run_goes_on(self):
        whole, killed = self.whole_run(), self.folder / "killed"
        running = self.start("dem", self.case, "--quiet", "--until", "5 s", "-o", killed)
        program.wait_until(running, lambda: (killed / "checkpoint.previous.h5").exists())
        running.kill()
        running.communicate(timeout=program.LONGEST)
        self.assertEqual(running.returncode, -signal.SIGKILL)
        self.assertEqual(strict_json((killed / "run.json").read_text())["state"], "running")
        with h5py.File(killed / "checkpoint.h5") as checkpoint:
            reached = checkpoint["numbers/time"][()]
        self.dem(DONE, killed, "--resume", "--until", f"{reached + 1e-3}")
        rows, before = history(killed), history(whole)
        self.assertEqual(rows["time_s"], sorted(set(rows["time_s"])))
        for column in before:  # of the time that both have computed without a stop
            count = min(len(before["time_s"]), sum(t <= reached for t in rows["time_s"]))
            self.assertEqual(rows[column][:count], before[column][:count], column)

    def test_a_run_in_the_way_is_refused(self):
        whole = self.whole_run()
        kept = (whole / "history.csv").read_bytes()
        told = self.dem(WRONG_CASE, whole).stderr
        self.assertIn("contains a run already", told)
        self.assertEqual((whole / "history.csv").read_bytes(), kept)
        self.dem(DONE, whole, "--force", "--until", "1 ms")

    def test_another_case_or_no_checkpoint_is_not_resumed(self):
        whole = self.whole_run()
        self.assertIn("another case", self.dem(WRONG_CASE, whole, "--resume", "--set", "dem.friction=0.2").stderr)
        self.assertIn("no checkpoint", self.dem(FILE, "nowhere", "--resume").stderr)


class Refused(Dem):
    def test_a_depth_that_shows_a_particle_twice(self):
        """Two of the largest particles: 3 mm, by hand."""
        told = self.dem(WRONG_CASE, "run", "--set", "column.depth=\"2.9 mm\"").stderr
        self.assertIn("column.depth", told)
        self.assertIn("at least 0.003 m", told)
        self.assertFalse((self.folder / "run/run.json").exists())
        self.dem(DONE, "run", "--set", "column.depth=\"3 mm\"", "--until", "1 ms")

    def test_particles_that_do_not_fit(self):
        told = self.dem(WRONG_CASE, "run", "--set", "bed.particles=[2000,50]").stderr
        self.assertIn("column.size", told)

    def test_no_law_of_contact(self):
        case = self.write("bare.toml", FALL.replace('contact = "hertz_mindlin"', ""))
        for words in (["dem", case, "-o", self.folder / "run"], ["check", case]):
            self.assertIn("effects.contact", self.ends(WRONG_CASE, *words).stderr)


class Stops(Dem):
    """Runs whose numbers fail: they say where and with which particle, and leave numbers only."""

    def stops(self, rows, *words):
        self.write("pair.csv", "species,x,y,z,vx\n" + rows)
        told = self.dem(NUMBERS, "run", *words, case=self.write("pair.toml", PAIR)).stderr
        run = self.folder / "run"
        self.assertTrue(strict_json((run / "run.json").read_text())["state"].startswith("failed: "))
        self.assertIn(str(run), told)
        self.has_no_nan(run, RESULTS)
        with h5py.File(run / "checkpoint.h5") as file:
            ids = file["arrays/particles"][()].reshape(rows.count("\n"), -1)[:, 0]
            self.assertEqual(list(ids), list(range(len(ids))))
        with h5py.File(run / "particles.h5") as file:  # the last state is always there
            self.assertEqual(len(file[f"step/{len(file['time_s']):06d}/id"]), rows.count("\n"))
        return told

    def test_particles_that_overlap_at_the_start(self):
        told = self.stops("beads,0.005,0.01,0.01,0\nbeads,0.010,0.01,0.01,0\nbeads,0.0107,0.01,0.01,0\n")
        self.assertRegex(told, "particle 1 and particle 2 overlap")

    def test_particles_with_one_centre(self):
        """They have no direction to part in: 0/0."""
        told = self.stops("beads,0.005,0.01,0.01,0\nbeads,0.010,0.01,0.01,0\nbeads,0.010,0.01,0.01,0\n")
        self.assertRegex(told, "particle 1 and particle 2 overlap")

    def test_particles_that_meet_too_fast(self):
        told = self.stops("beads,0.008,0.01,0.01,2\nbeads,0.010,0.01,0.01,0\n")
        self.assertRegex(told, "particle 0 and particle 1 overlap")
        self.assertIn("dem.youngs_modulus", told)

    def test_a_particle_much_faster_than_the_case_says(self):
        """5 m/s, where 0.1 m/s was expected: energies are counted in whole units for 25 times that."""
        told = self.stops("beads,0.008,0.01,0.01,5\nbeads,0.010,0.01,0.01,0\n")
        self.assertIn("a particle moves at 5 m/s, where 0.1 m/s at most were expected", told)
        self.assertIn("dem.greatest_speed", told)

    def test_a_particle_that_would_jump_over_a_wall(self):
        """100 m/s at a wall, where 1 m/s was expected."""
        told = self.stops("beads,0.005,0.01,0.01,0\nbeads,0.015,0.01,0.01,100\n", "--set", "dem.greatest_speed=1")
        self.assertRegex(told, "particle 1 moves by more than a tenth of its diameter .*dem.greatest_speed")


class Check(Dem):
    SOFT = ["--set", "dem.youngs_modulus=50000"]

    def soft_notes(self, *words):
        answer = strict_json(self.ends(DONE, "check", self.case, "--json", *words).stdout)
        return answer, [note for note in answer["notes"] if "too soft" in note]

    def test_contacts_that_are_too_soft_are_told_with_what_would_do(self):
        (note,) = self.soft_notes(*self.SOFT)[1]
        advised = re.search(r'use dem.youngs_modulus = ("[^"]+")', note)[1]
        self.assertEqual(self.soft_notes("--set", f"dem.youngs_modulus={advised}")[1], [])
        told = self.ends(DONE, "dem", self.case, "-o", self.folder / "soft", *self.SOFT, "--until", "1 ms").stderr
        self.assertIn(note, told)

    def test_a_case_without_a_modulus_gets_one_that_is_stiff_enough(self):
        """Loose spheres fall 60 mm: at the 5 MPa of slow ones they overlap by more than the 5 % allowed."""
        case = self.write("far.toml", FALL.replace('start = "mixed"', 'start = "random"').replace(
            "start_solids_fraction = 0.4\n", "").replace('"30 mm"', '"60 mm"').replace("20 ms", "120 ms"))
        self.dem(NUMBERS, "five", "--set", "dem.youngs_modulus=1e6", case=case)
        record = strict_json(self.dem(DONE, "chosen", "--json", case=case).stdout)
        self.assertGreater(float(re.search(r"youngs_modulus = ([\d.e+]+)", record["case"])[1]), 5e6)
        met = max(history(self.folder / "chosen")["max_overlap_m"])
        self.assertLess(met, record["overlap"]["expected_m"])
        self.assertLess(record["work"]["greatest_speed_m_s"], 1.25 * record["step"]["greatest_speed_expected_m_s"])

    def test_particles_memory_step_and_time(self):
        text = self.ends(DONE, "check", self.case, "--details").stdout
        for line in (r"300 particles: 250 fine, 50 coarse", r"memory about \d+ MB", r"time step [\d.e-]+ s, limited by ",
                     r"0.02 s takes about .* of computing, .* to .*: [\d.e+]+ steps, [\d.e+]+ particle-steps"):
            self.assertRegex(text, line)

    def test_what_it_says_is_what_the_run_does(self):
        need = strict_json(self.ends(DONE, "check", self.case, "--json").stdout)
        record = strict_json(self.dem(DONE, "run", "--json").stdout)
        self.assertEqual(need["particles"], {"fine": 250, "coarse": 50})
        self.assertEqual(need["step"], record["step"])
        # the run ends at the step nearest to its end
        self.assertAlmostEqual(need["time"]["steps"], record["work"]["steps"], delta=1)
        self.assertEqual(need["integrator"], record["integrator"])

    def test_memory_is_that_of_a_run(self):
        """Of two numbers of particles, dense, on one rank; 30 % for how contacts vary with the packing."""
        if "sanitizers" in program.run("--version").stdout:
            self.skipTest("the address sanitizer keeps memory that was given back")
        for share in (1, 40):
            words = ["--set", f"bed.particles=[{250 * share},{50 * share}]", "--set", f"column.size=[{0.012 * share},0.03]",
                     "--set", f"column.cells=[{6 * share},30]", "--set", "bed.start_solids_fraction=0.55", "--set", "run.until=1e-3"]
            need = strict_json(self.ends(DONE, "check", self.case, "--json", *words).stdout)
            held = 1e-6 * program.peak_memory("dem", self.case, "--quiet", "--no-picture", *words, "-o", self.folder / f"memory{share}")
            self.assertAlmostEqual(need["memory_MB"], held, delta=0.3 * held)


class FullDisk(Dem):
    """As in bad_luck_test.py: a limit on the size of files stands for the disk. Of these particles history.csv has 340 bytes
    a row, profiles.h5 34 kB, a step of particles 46 kB, checkpoint.h5 more than that."""

    def test_each_file_in_turn(self):
        def every(**periods):
            return [word for name, period in periods.items() for word in ("--set", f"output.{name}={period}")]
        for first, most_bytes, words in (("history.csv", 20000, every(every=9, history_every=1e-4, checkpoint_every=9)),
                                         ("checkpoint.h5", 20000, every(every=9, history_every=9)),
                                         ("particles/", 40000, every(history_every=9, checkpoint_every=9))):
            with self.subTest(first):
                directory = self.folder / first.strip("/")
                running = self.start("dem", self.case, "--quiet", "--until", "9 s", "-o", directory, *words)
                program.wait_until(running, lambda: (directory / "particles/000001.h5").exists())
                resource.prlimit(running.pid, resource.RLIMIT_FSIZE, (most_bytes, most_bytes))
                told = running.communicate(timeout=program.LONGEST)[1]
                self.assertEqual(running.returncode, FILE, told)
                self.assertRegex(told, f"cannot write {directory}/{first}.*: File too large")
                self.assertEqual([p.name for p in directory.rglob("*.temporary")], [])
                strict_json((directory / "run.json").read_text())
                self.assertTrue(datasets(directory / "particles.h5"))

    def test_no_room_for_a_run(self):
        directory = self.folder / "run"
        done = self.ends(FILE, "dem", self.case, "--quiet", "-o", directory,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0)))
        self.assertIn(f"cannot write {directory}/.polybed: File too large", done.stderr)

    def test_a_checkpoint_cut_short_gives_way_to_the_one_before(self):
        whole = self.whole_run()
        run = self.folder / "run"
        shutil.copytree(whole, run)
        os.truncate(run / "checkpoint.h5", 1000)
        self.assertIn("going on from it", self.dem(DONE, run, "--resume").stderr)
        for name in RESULTS:
            self.assertEqual(same_bits(whole / name, run / name), [], name)


if __name__ == "__main__":
    program.main()
