#!/usr/bin/python3
"""Two runs that are compared, at rest and so with results by hand: compare_test.py PROGRAM PACKAGE_DIRECTORY"""

import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

os.environ["POLYBED"] = sys.argv.pop(1)  # has the measures of profiles
sys.path.insert(0, sys.argv.pop(1))

from polybed import runner  # noqa: E402
from polybed.errors import ProgramError  # noqa: E402
from polybed.study import cases, scores  # noqa: E402
from polybed.study.scores import add_inversion  # noqa: E402
from stored_run import Written  # noqa: E402

SLABS, SLAB = 50, 2e-3
ROWS = 1001


def at_rest(level, surface, coarse_on_top=True, swing=0.0):
    """A run of 100 s at rest: fine below `level`, coarse from there to `surface`, both at a solids fraction of 0.5; a row of the history
    every 0.1 s, a profile every second. The bed height swings by `swing`, one row up and the next down."""
    low, high = level / 2, (level + surface) / 2
    fine, coarse = (low, high) if coarse_on_top else (high, low)
    constant = {"pressure_drop_Pa": 98, "buoyant_weight_Pa": 100, "centre_fine_m": fine, "centre_coarse_m": coarse, "mixing": 0.25}
    history = {"time_s": 0.1 * np.arange(ROWS), "bed_height_m": surface + swing * (-1.0) ** np.arange(ROWS)}
    z = (np.arange(SLABS) + 0.5) * SLAB
    below, above = np.where(z < level, 0.5, 0), np.where((z > level) & (z < surface), 0.5, 0)
    names = ("phi_fine", "phi_coarse") if coarse_on_top else ("phi_coarse", "phi_fine")
    profiles = {"time_s": np.arange(101.0), "y_m": z} | {name: np.tile(row, (101, 1)) for name, row in zip(names, (below, above))}
    return Written(history | {name: np.full(ROWS, float(value)) for name, value in constant.items()}, profiles)


def compare(tfm, dem):
    with tempfile.TemporaryDirectory() as folder:
        return scores.compare(tfm.into(Path(folder) / "tfm"), dem.into(Path(folder) / "dem"))


class Compare(unittest.TestCase):
    def warned(self, comparison, text):
        self.assertTrue(any(text in line for line in comparison["warnings"]), comparison["warnings"])

    # Of 26 profiles in the window the first two have 0.13 more fine in the lowest slab: 0.26/26 in the mean. Ten groups of
    # 2 3 2 3 3 2 3 2 3 3 are left out in turn: 0 without the first, 0.26/24 without another of 2, 0.26/23 without one
    # of 3. Their squares about their mean, 0.01003261, are 1.122807e-4, times 9/10; 2.262 of 9 degrees of freedom times
    # its root is 0.0227387. The rows themselves are spread by 0.0346.
    def test_mean_profiles_have_the_interval_of_their_mean_not_the_spread_in_time(self):
        swings = at_rest(0.03, 0.06)
        swings.profiles["phi_fine"][75:77, 0] += 0.13
        c = compare(swings, at_rest(0.03, 0.06))
        means = c["mean_profiles"]
        self.assertEqual(list(means["tfm"]), ["phi_fine", "phi_coarse"])
        self.assertEqual(len(means["y_m"]), SLABS)
        tfm, dem = means["tfm"]["phi_fine"], means["dem"]
        self.assertAlmostEqual(tfm["mean"][0], 0.51, delta=1e-14)
        self.assertAlmostEqual(tfm["error"][0], 0.0227387, delta=1e-7)
        self.assertEqual((tfm["mean"][1], tfm["error"][1]), (0.5, 0))
        self.assertEqual(dem["phi_fine"]["error"][0], 0)
        self.assertEqual(dem["phi_coarse"]["mean"][0], 0)  # coarse on top
        self.assertEqual(dem["phi_coarse"]["mean"][15], 0.5)  # centre at 31 mm

    def test_a_run_with_itself(self):
        run = at_rest(0.03, 0.06)
        c = compare(run, run)
        self.assertEqual(c["window"], {"begin_s": 75, "end_s": 100, "shortened": False, "confidence": 0.95})
        self.assertEqual(c["profiles"]["tfm"], 26)  # 75 to 100 s
        self.assertEqual({measure["difference"] for measure in c["measures"].values()}, {0})
        self.assertEqual(c["scores"].pop("order")["tfm"], {"species": "coarse", "certain": True})
        self.assertEqual({score["value"] for score in c["scores"].values()}, {0})
        self.assertEqual(c["warnings"], [])

    def test_a_higher_bed(self):
        """By hand: fine 0 to 30 mm in both; coarse 30 to 60 mm and 30 to 66 mm."""
        c = compare(at_rest(0.03, 0.066), at_rest(0.03, 0.06))
        for name, difference in (("bed_height_m", 0.006), ("centre_fine_m", 0), ("centre_coarse_m", 0.003)):
            self.assertAlmostEqual(c["measures"][name]["difference"], difference, delta=1e-15)
        self.assertAlmostEqual(c["measures"]["bed_height_m"]["tfm"], 0.066, delta=1e-15)
        self.assertAlmostEqual(c["measures"]["pressure_drop_over_weight"]["dem"], 0.98, delta=1e-15)
        self.assertAlmostEqual(c["scores"]["e_H"]["value"], 0.1, delta=1e-12)
        self.assertIs(c["scores"]["e_H"]["reached"], False)
        self.assertAlmostEqual(c["scores"]["e_b"]["value"], (0.048 - 0.015) / 0.066 - 0.5, delta=1e-12)  # exactly 0
        self.assertIs(c["scores"]["e_b"]["reached"], True)
        self.assertAlmostEqual(c["scores"]["profile_coarse"]["value"], 0.2, delta=1e-12)  # 6 of 30 mm more
        self.assertAlmostEqual(c["scores"]["profile_fine"]["value"], 0, delta=1e-12)
        # The fine species has 5/11 and 1/2 of the volume: they differ over 1/22 of it, but for the slice that both cut.
        self.assertAlmostEqual(c["scores"]["D1"]["value"], 1 / 22, delta=1 / 50)
        self.assertAlmostEqual(c["measures"]["interface_m"]["dem"], 0.03, delta=1e-12)

    def test_size_classes_are_one_species(self):
        run = at_rest(0.03, 0.06)
        for part, name in ((run.history, "centre_{}_m"), (run.profiles, "phi_{}")):
            for size in (1, 2):
                part[name.format(f"fine.{size}")] = part[name.format("fine")] / (2 if "phi" in name else 1)
        del run.profiles["phi_fine"]
        c = compare(run, run)
        self.assertEqual(c["scores"]["order"]["tfm"], {"species": "coarse", "certain": True})
        self.assertAlmostEqual(abs(c["measures"]["centre_difference"]["tfm"]), 0.5, delta=1e-12)
        self.assertAlmostEqual(c["measures"]["interface_m"]["tfm"], 0.03, delta=1e-12)

    def test_an_inverted_bed(self):
        c = compare(at_rest(0.03, 0.06, True), at_rest(0.03, 0.06, False))
        self.assertEqual([c["scores"]["order"][model]["species"] for model in ("tfm", "dem")], ["coarse", "fine"])
        for name, value in (("e_b", 1), ("D1", 1), ("profile_fine", 2)):
            self.assertAlmostEqual(c["scores"][name]["value"], value, delta=1e-12)
        self.assertIs(c["scores"]["D1"]["reached"], False)

    # The fine layer of the DEM is higher by 0.13 in the first two of 26 profiles, so that its volume without a group is V + 0.01 v of a
    # slab's v, or V where the group is the first; the distance of the TFM's mean, 0 there, is 0.01 v over that volume. 15 slabs of 0.5
    # are V = 7.5: the ten values are those of the mean profile's test over V and over 7.51 and 7.5113, and vary by 0.0227387/7.5 less a
    # part in 750.
    def test_the_interval_of_a_distance_is_of_the_reference_too(self):
        swings = at_rest(0.03, 0.06)
        swings.profiles["phi_fine"][75:77, 0] += 0.13
        of_reference = compare(at_rest(0.03, 0.06), swings)["scores"]["profile_fine"]
        self.assertAlmostEqual(of_reference["value"], 0.01 / 7.51, delta=1e-12)
        self.assertAlmostEqual(of_reference["error"], 0.0227387 / 7.5, delta=0.0227387 / 7.5 / 400)
        self.assertLess(of_reference["error"], 0.0227387 / 7.5)
        of_run = compare(swings, at_rest(0.03, 0.06))["scores"]["profile_fine"]
        self.assertAlmostEqual(of_run["value"], 0.01 / 7.5, delta=1e-12)
        self.assertAlmostEqual(of_run["error"], 0.0227387 / 7.5, delta=1e-7)

    # Rows that alternate by +-a about the mean have the variance a^2; batches of 12 rows have no mean but the mean. 251
    # rows in the window, so the last one is left over: a/251.
    def test_fluctuations_are_in_the_interval(self):
        swing = 1e-3
        c = compare(at_rest(0.03, 0.06, swing=swing), at_rest(0.03, 0.06))
        height = c["measures"]["bed_height_m"]
        self.assertAlmostEqual(height["tfm"], 0.06, delta=swing / 200)
        self.assertAlmostEqual(height["tfm_error"], 2.093 * swing / np.sqrt(251), delta=0.05 * swing / np.sqrt(251))
        self.assertEqual(height["dem_error"], 0)
        self.assertEqual(height["difference_error"], height["tfm_error"])
        self.assertAlmostEqual(c["scores"]["e_H"]["error"], height["tfm_error"] / 0.06, delta=1e-12)

    def test_only_the_time_that_both_have_is_compared(self):
        shorter, longer = at_rest(0.03, 0.06), at_rest(0.03, 0.06)
        for name in shorter.history:
            shorter.history[name] = shorter.history[name][:401]  # to 40 s
        longer.history["bed_height_m"][401:] = 0.09
        c = compare(shorter, longer)
        self.assertAlmostEqual(c["window"]["begin_s"], 30, delta=1e-12)
        self.assertAlmostEqual(c["window"]["end_s"], 40, delta=1e-12)
        self.assertAlmostEqual(c["measures"]["bed_height_m"]["dem"], 0.06, delta=1e-15)

    def test_a_bed_that_still_rises_is_told_and_the_window_shortened(self):
        rising = at_rest(0.03, 0.06)
        rising.history["bed_height_m"][:] = 0.05 + 1e-5 * np.arange(ROWS)
        rising.drifts.append("not steady")  # as run.json says
        c = compare(rising, at_rest(0.03, 0.06))
        self.assertTrue(c["window"]["shortened"])
        self.assertAlmostEqual(c["window"]["begin_s"], 87.5, delta=0.1)  # at most half of the window is dropped
        self.warned(c, "tfm: not steady")
        [line] = [line for line in c["warnings"] if "tfm: window too short for bed height: run at least" in line]
        self.assertEqual(float(line.split()[-2]), c["least_time"], "one number for the warning and the command")

    def test_what_a_run_does_not_have_stays_empty(self):
        few = at_rest(0.03, 0.06)
        few.profiles["time_s"] *= 0.5  # none in the window
        few.history["buoyant_weight_Pa"][:] = 0
        c = compare(few, at_rest(0.03, 0.06))
        self.assertIsNone(c["scores"]["D1"]["value"])
        self.assertIsNone(c["scores"]["D1"]["reached"])
        self.assertIsNone(c["measures"]["interface_m"]["tfm"])
        self.assertIsNotNone(c["measures"]["interface_m"]["dem"])
        self.assertIsNone(c["measures"]["pressure_drop_over_weight"]["difference"])
        self.warned(c, "output.every")

    def test_refuses_what_cannot_be_compared(self):
        run = at_rest(0.03, 0.06)

        def refused(part, change, text):
            other = at_rest(0.03, 0.06)
            change(getattr(other, part))
            with self.assertRaisesRegex(ProgramError, text):
                compare(run, other)
        refused("profiles", lambda columns: columns.update(phi_sand=columns.pop("phi_coarse")), "other species")
        refused("profiles", lambda columns: columns.update({name: values[..., :-1] for name, values in columns.items() if name != "time_s"}),
                "other slabs")
        refused("history", lambda columns: columns.update(time_s=columns["time_s"] + 1000), "no time in common")
        refused("history", lambda columns: columns.update({name: values[:0] for name, values in columns.items()}), "without a row")

    def test_near_an_inversion_the_layers_have_more_room(self):
        models = {"tfm": {"velocity_m_s": 0.0309}, "dem": {"velocity_m_s": 0.030}}
        scan = {"models": models, "agreement": {"value": 0.03, "error": 0.01, "goal": 0.05}}
        # 5 % of 30.9 mm/s and of 30.0 mm/s reach from 28.5 to 32.4 mm/s
        for velocity, goal in ((0.0284, 0.05), (0.0286, 0.1), (0.0324, 0.1), (0.0326, 0.05)):
            comparison = compare(at_rest(0.04, 0.08), at_rest(0.04, 0.08))
            add_inversion(comparison, scan, "scan/inversion.json", velocity)
            self.assertEqual(comparison["scores"]["D1"]["goal"], goal, velocity)
            self.assertEqual(comparison["scores"]["u_inv"]["value"], 0.03)
            self.assertIs(comparison["scores"]["u_inv"]["reached"], True)
            self.assertEqual(comparison["inversion_file"], "scan/inversion.json")

    def leaving(self, out, top, fed):
        """At rest, with fine beads of 1 mm, 100 at the start, that are fed and leave steadily: numbers until 100 s, and those over the top."""
        bead = 2500 * np.pi / 6 * 1e-9
        run, through = at_rest(0.03, 0.06), np.linspace(0, 1, ROWS)
        for way, number in {"in": fed, "out": out, "top": top, "discharge1": out - top}.items():
            run.history[f"{way}_fine_kg"] = bead * number * through
        run.history["mass_fine_kg"] = bead * (100 + (fed - out) * through)
        run.case = '[[species]]\nname = "fine"\ndiameter = 0.001\ndensity = 2500.0\n'
        return run

    def recovered(self, c, name, tfm, dem, goal, reached):
        measure, score = c["measures"][name], c["scores"][name]
        for found, value in ((measure["tfm"], tfm), (measure["dem"], dem), (score["value"], tfm - dem), (score["goal"], goal)):
            self.assertAlmostEqual(found, value, delta=1e-6)
        self.assertIs(score["reached"], reached, name)
        return scores.score_line(name, score)

    # Of 100 beads 50 have left by the particles, 15 of them over the top. Wilson's half-width with s = 1.959964^2/100 = 0.0384146 is
    # 1.959964 sqrt(0.25/100 + s/400)/(1 + s) = 0.0961684 at 0.5; at 0.15 it is 1.959964 sqrt(0.1275/100 + s/400)/(1 + s) = 0.0698879, and
    # its middle is off by 0.35 s/(1 + s) = 0.0129477. The two-fluid model: 0.55 and 0.25.
    def test_recoveries_of_a_batch_are_judged_by_the_count_of_particles(self):
        c = compare(self.leaving(55, 25, 0), self.leaving(50, 15, 0))
        self.assertEqual([name for name in c["measures"] if "recovery" in name],
                         ["recovery_fine", "recovery_top_fine", "recovery_discharge1_fine"])  # no coarse bead can leave
        line = self.recovered(c, "recovery_fine", 0.55, 0.5, 0.0961684, True)
        self.assertRegex(line, r"^recovery of fine +0\.05   within the interval: reached$")
        line = self.recovered(c, "recovery_top_fine", 0.25, 0.15, 0.0698879 + 0.0129477, None)
        self.assertRegex(line, r"^recovery of fine by top +0\.1   undecided: no interval of the difference$")
        self.assertIsNone(c["measures"]["recovery_fine"]["tfm_error"])
        self.assertIsNone(c["measures"]["recovery_fine"]["difference_error"])
        none = compare(self.leaving(0, 0, 0), self.leaving(0, 0, 0))
        self.assertFalse([name for name in none["measures"] if "recovery" in name], "nothing leaves")

    # Half of the feed leaves, but a quarter of the 200 supplied until the end. All of the outflow of one run in the window is in
    # its first half.
    def test_recoveries_of_a_feed_are_those_of_the_window(self):
        steady, swings = self.leaving(50, 20, 100), self.leaving(50, 20, 100)
        c = compare(steady, steady)  # of 25 beads in the window: Wilson's half-width with s = 1.959964^2/25 = 0.1536584
        self.recovered(c, "recovery_fine", 0.5, 0.5, 1.959964 * np.sqrt(0.25 / 25 + 0.1536584 / 100) / 1.1536584, True)
        out = np.diff(swings.history["out_fine_kg"], prepend=0)
        out[760:1000] += out[760:1000] * np.where(np.arange(240) % 240 < 120, 1, -1)
        swings.history["out_fine_kg"] = np.cumsum(out)
        c = compare(steady, swings)
        goal = c["scores"]["recovery_fine"]["goal"]
        self.assertTrue(0.2 < goal < 0.5, goal)
        self.recovered(c, "recovery_fine", 0.5, 0.5, goal, True)
        more = compare(self.leaving(7500, 20, 10000), self.leaving(5000, 20, 10000))
        self.assertRegex(scores.score_line("recovery_fine", more["scores"]["recovery_fine"]), "outside the interval: missed$")


class Cases(unittest.TestCase):
    def test_keys_that_differ(self):
        first = ('title = "a"\n\n[column]\ncells = [3, 18]\n\n[[species]]\nname = "fine"\ndensity = 1.0\n\n[[species]]\nname = "coarse"\n'
                 'density = 2.0\n\n[effects]\ndrag = "cello"\nsolids_stress = "none"\n\n[run]\nuntil = 1.0\n\n[tfm]\nrtol = 0.1\n')
        second = ('title = "b"\n\n[column]\ncells = [6, 18]\ndepth = 0.1\n\n[[species]]\nname = "fine"\ndensity = 1.0\n\n[[species]]\n'
                  'name = "coarse"\ndensity = 3.0\n\n[effects]\ncontact = "linear"\ndrag = "fand"\n\n[run]\nuntil = 2.0\n\n[tfm]\nrtol'
                  ' = 0.2\n\n[dem]\nfriction = 0.1\n\n[output]\nevery = 1.0\n')
        self.assertEqual(cases.differences(first, second, {"drag"}),
                         [("column.cells", "[3, 18]", "[6, 18]"), ("column.depth", "-", "0.1"), ("effects.drag", '"cello"', '"fand"'),
                          ("species.coarse.density", "2.0", "3.0")])
        self.assertEqual(cases.differences(first, first, {"drag"}), [])

    def test_roles_of_either_model(self):
        both = cases.roles_in_both_models()
        self.assertIn("drag", both)
        self.assertFalse({"solids_stress", "contact"} & both)

    def test_the_hash_is_that_of_the_program(self):
        self.assertEqual(cases.hash_of(b""), "cbf29ce484222325")  # of FNV-1a itself
        self.assertEqual(cases.hash_of(b"a"), "af63dc4c8601ec8c")


class Runs(unittest.TestCase):
    LAUNCHER = {"OMPI_COMM_WORLD_SIZE": "3", "OMPI_MCA_ess_base_vpid": "0", "OMPI_MCA_orte_launch": "1", "PMIX_RANK": "0", "PMI_SIZE": "3"}

    def test_a_run_starts_as_if_there_were_no_launcher(self):
        users = {"OMPI_MCA_btl": "self,tcp", "OMPI_ALLOW_RUN_AS_ROOT": "0", "HOME": "there"}
        with mock.patch.dict(os.environ, self.LAUNCHER | users | {"POLYBED_RANKS": "3"}, clear=True):
            found = runner.environment()
        self.assertEqual({name: found[name] for name in users}, users)
        self.assertFalse(found.keys() & self.LAUNCHER.keys())
        self.assertNotIn("POLYBED_RANKS", found)

    def test_as_many_ranks_as_the_study_was_started_with(self):
        for variables, count in (({}, 1), ({"POLYBED_RANKS": "2"}, 2), (self.LAUNCHER, 3), ({"PMI_SIZE": "4"}, 4)):
            with mock.patch.dict(os.environ, variables, clear=True):
                self.assertEqual(runner.ranks(), count)


class Report(unittest.TestCase):
    def test_the_file_has_its_form(self):
        record = {"work": {"steps": 3, "named": "x"}, "cpu_s": 1.5, "time_s": 100, "ranks": 1, "state": "done", "case_hash": "1",
                  "git_commit": "2"}
        case = type("Case", (), {"git_commit": "3", "path": "case.toml", "overrides": ["bed.seed=2"]})
        found = compare(at_rest(0.03, 0.066), at_rest(0.03, 0.06))
        plain = scores.plain(found, case, "out", {"tfm": ("here", record), "dem": ("there", record)})
        self.assertIs(plain["scores"]["e_H"]["reached"], False)
        self.assertEqual(plain["scores"]["order"], {"tfm": {"species": "coarse", "certain": True},
                                                    "dem": {"species": "coarse", "certain": True}, "same": True})
        self.assertEqual(plain["models"]["dem"]["work"], {"steps": 3})
        self.assertEqual(plain["models"]["dem"]["cpu_s"], 1.5)
        self.assertIsNone(plain["models"]["dem"]["wall_s"])  # of a record of before it was kept
        self.assertEqual(plain["overrides"], ["bed.seed=2"])
        self.assertNotIn("inversion_file", plain)
        self.assertIn("goal 0.05: missed", scores.table(plain))


if __name__ == "__main__":
    unittest.main()
