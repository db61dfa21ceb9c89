#!/usr/bin/python3
"""Plans, means over seeds, fits and judgements of a calibration; no box is run: calibration_test.py PROGRAM PACKAGE_DIRECTORY"""

import json
import math
import os
import signal
import sys
import tempfile
import threading
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import h5py
import numpy as np

os.environ["POLYBED"], PACKAGE = os.path.abspath(sys.argv[1]), sys.argv[2]
sys.path.insert(0, PACKAGE)

from polybed.calibration import fit
from polybed.calibration.boxes import MEANS, SINGLE, Boxes, Plan, Point, read_box
from polybed.calibration.text import bed_rows, box_lines, deviation, deviation_lines, points_between
from polybed.ending import NUMBERS, StudyError
from polybed.errors import ProgramError
from polybed.runner import asked, running
from polybed.solids_table import SolidsTable, checksum, read_table
from polybed.study.stress_uncertainty import moved_table

DRY = {"regime": "dry", "reference": "GD-CS e_eff", "binary": False, "seeds": 2,
       "axes": {"phi": [0.1, 0.2, 0.3, 0.4, 0.45], "stokes": [0], "e": [0.8, 0.9], "mu_p": [0], "x2": [0]}}
FOUR = {"axes": DRY["axes"] | {"phi": [0.1, 0.2, 0.3, 0.4], "e": [0.9]}, "seeds": 1}
TWO = {"axes": DRY["axes"] | {"x2": [0.5]}, "binary": True}


def plan_of(**changed):
    return Plan(DRY | changed)


def box_of(point, **measured):
    """A box of S 0.5 whose ratios are 1 with an error of 0.001."""
    ones = dict.fromkeys(("p_ratio", "mu_ratio", "gamma_ratio", "temperature_ratio"), [1.0, 0.001])
    return {"solids_fraction": point.phi, "stokes": point.stokes, "seed": point.seed, "shear_rate_1_s": 10.0, "diameter_m": 1e-3,
            "theta_m2_s2": [(10.0 * 1e-3 / 0.5)**2, 0.0], "slip_over_sqrt_theta": 0.0} | ones | measured


def synthetic(plan, scatter, p=lambda point: 1.0):
    """Boxes whose pressures scatter about p: the first seed above, the second below, further ones at p."""
    def factor(seed):
        return {1: 1 + scatter, 2: 1 - scatter}.get(seed, 1.0)
    return [box_of(point, p_ratio=[p(point) * factor(point.seed), 0.001]) for point in plan.boxes()]


class Plans(unittest.TestCase):
    def test_every_point_with_its_seeds(self):
        boxes = plan_of().boxes()
        self.assertEqual(len(boxes), 5 * 2 * 2)
        self.assertEqual([box.seed for box in boxes[:2]], [1, 2])
        self.assertEqual((boxes[2].restitution, boxes[4].phi), (0.9, 0.2))
        self.assertEqual(boxes[1], Point("dry", 0.1, 0, 0.8, 0, 0, False, False, 2))

    def test_dry_boxes_of_two_species_are_also_pushed_apart(self):
        boxes = plan_of(binary=True, axes=DRY["axes"] | {"x2": [0.3, 0.5]}).boxes()
        self.assertEqual(len(boxes), 2 * 5 * 2 * 2 * 2)
        self.assertEqual((boxes[39].pushed, boxes[40].pushed, boxes[40].phi), (False, True, boxes[0].phi))
        self.assertEqual(len(plan_of(binary=True, regime="wet").boxes()), 20, "of wet ones none is pushed")


class Seeds(unittest.TestCase):
    def test_three_seeds_tell_their_error_by_their_scatter(self):
        """1, 1.1, 1.2: s = 0.1, 1.321 x 0.1/sqrt(3) whatever the boxes say; of 1 and 1.1 1.837 x 0.05 = 0.09, or the boxes'
        0.2/sqrt(2); of one its own."""
        seeds = [(1, 0.2), (1.1, 0.2), (1.2, 0.2)]
        np.testing.assert_allclose(fit.mean_of_seeds(seeds), (1.1, 1.3212774 * 0.1 / math.sqrt(3)), rtol=1e-5)
        self.assertAlmostEqual(fit.mean_of_seeds(seeds[:2])[1], 0.2 / math.sqrt(2), delta=1e-14)
        self.assertAlmostEqual(fit.mean_of_seeds([(1, 0.02), (1.1, 0.02)])[1], 1.8373372 * 0.05, delta=1e-7)
        self.assertEqual(fit.mean_of_seeds(seeds[:1])[1], 0.2)

    def test_seeds_are_added_where_they_scatter(self):
        """s is the scatter, the standard error 1.321 s/sqrt(3): 0.06 gives 4.6 %, 0.07 gives 5.3 % and a seed more at that point alone,
        until there are ten."""
        plan = plan_of(seeds=3)
        boxes = synthetic(plan, 0.06)
        self.assertFalse(fit.add_seeds(plan, fit.fitted(plan, boxes)))
        boxes[9:12] = synthetic(plan, 0.07)[9:12]  # of the fourth point
        scattered = fit.fitted(plan, boxes)
        self.assertAlmostEqual(max(fit.relative_errors(scattered)), 1.3212774 * 0.07 / math.sqrt(3), delta=1e-8)
        with self.assertRaisesRegex(StudyError, "at phi = 0.2 the seeds scatter"):
            fit.require_usable(scattered, [])
        self.assertTrue(fit.add_seeds(plan, scattered))
        self.assertEqual(plan.seeds, [3, 3, 3, 4, 3, 3, 3, 3, 3, 3])
        self.assertEqual((len(plan.boxes()), plan.boxes()[12].seed, plan.boxes()[12].phi), (31, 4, plan.boxes()[11].phi))
        boxes.insert(12, boxes[11])  # a fourth at the mean: s = 0.07 sqrt(2/3), 1.197 s/2
        table = fit.fitted(plan, boxes)
        self.assertAlmostEqual(table.points("p_ratio_se")[3] / table.points("p_ratio")[3], 1.1968814 * 0.07 * math.sqrt(2 / 3) / 2, delta=1e-8)
        self.assertEqual(table.points("p_ratio_n")[3], 4)
        fit.require_usable(table, [])
        plan.seeds[3] = fit.MOST_SEEDS
        self.assertFalse(fit.add_seeds(plan, scattered))
        two, one = plan_of(seeds=2), plan_of(seeds=1)
        self.assertTrue(fit.add_seeds(two, fit.fitted(two, synthetic(two, 0.2))), "the default plan gets more seeds too")
        self.assertEqual(set(two.seeds), {3})
        self.assertFalse(fit.add_seeds(one, fit.fitted(one, synthetic(one, 0.2))), "a single box says nothing of scatter")


class Fits(unittest.TestCase):
    def test_a_synthetic_table_is_recovered(self):
        """Two boxes 0.1 % off to both sides: s/sqrt(2) = 0.1 %, Student's factor of one degree of freedom is 1.837."""
        plan = plan_of()
        table = fit.fitted(plan, synthetic(plan, 0.001, lambda point: 1 + point.phi))
        self.assertEqual(table["p_ratio"].shape, (5, 1, 2, 1, 1))
        np.testing.assert_allclose(table["p_ratio"][:, 0, :, 0, 0], np.add(1, [[phi, phi] for phi in DRY["axes"]["phi"]]), rtol=1e-14)
        np.testing.assert_allclose(table["p_ratio_se"] / table["p_ratio"], 1.8373372e-3, rtol=1e-7)
        np.testing.assert_allclose(table["S"], 0.5, rtol=1e-14)
        self.assertTrue((table["p_ratio_n"] == 2).all())
        self.assertEqual((table.attributes["reference"], table.attributes["lambda"]), ("GD-CS e_eff", 0))
        fit.require_usable(table, [])

    def test_a_curve_is_tested_where_a_point_is_left_out(self):
        """1 1 1.2 1 at 0.1 to 0.4: without 0.3 the curve is 1 there, 0.2/1.2 off. Its knots at 0.2 and 0.4 have errors of 0.01 and move it
        by half of that, the point has 0.01: 2 sqrt(1.5e-4) of 1.2 is taken off. Without 0.2 it is 1.1, less off."""
        plan = plan_of(**FOUR)
        boxes = [box_of(point, p_ratio=[1.2 if point.phi == 0.3 else 1.0, 0.01]) for point in plan.boxes()]
        table = fit.fitted(plan, boxes)
        self.assertAlmostEqual(table.attributes["left_out_residual"], 0.2 / 1.2, delta=1e-12)
        self.assertAlmostEqual(table.attributes["fit_residual"], (0.2 - 2 * math.sqrt(1.5e-4)) / 1.2, delta=1e-12)
        with self.assertRaisesRegex(StudyError, "fraction 0.3 is missed: .* has a p that is off by 14.6 % more .* add 0.25 and 0.35 to") as refused:
            fit.require_usable(table, [])
        self.assertEqual(refused.exception.code, NUMBERS)
        for box in boxes:
            box["p_ratio"][1] = 0.08  # two errors of both are then 0.196
        fit.require_usable(fit.fitted(plan, boxes), [])
        plan = plan_of(axes=DRY["axes"] | {"phi": [0.1, 0.2, 0.3]}, seeds=1)
        self.assertEqual(fit.left_out(fit.fitted(plan, synthetic(plan, 0.3))), (0, 0), "three are too few")

    def test_seeds_that_disagree_are_refused(self):
        plan = plan_of()
        fit.require_usable(fit.fitted(plan, synthetic(plan, 0.027)), [])  # 1.837 x 0.027 = 4.96 %
        with self.assertRaisesRegex(StudyError, "standard error of 5.1 %, 5 % are allowed; raise calibrate.seeds to about 3 .2 at this point"):
            fit.require_usable(fit.fitted(plan, synthetic(plan, 0.028)), [])

    def test_inertia_of_a_wet_table(self):
        """p/(mu gamma V) = 2 (1 + 0.3 St) at St 1, 3, 10: lambda 0.3 by least squares, exactly; the ratios are then 2."""
        stokes = [1.0, 3.0, 10.0]
        self.assertAlmostEqual(fit.fitted_inertia(stokes, [[2 * (1 + 0.3 * s) for s in stokes]] * 2), 0.3, delta=1e-12)
        self.assertEqual(fit.fitted_inertia(stokes, [[2 - 0.1 * s for s in stokes]] * 2), 0)
        plan = plan_of(regime="wet", axes=DRY["axes"] | {"stokes": stokes}, seeds=1)
        table = fit.fitted(plan, synthetic(plan, 0, lambda point: 2 * (1 + 0.3 * point.stokes)))
        self.assertAlmostEqual(table.attributes["lambda"], 0.3, delta=1e-12)
        np.testing.assert_allclose(table["p_ratio"], 2, rtol=1e-12)
        np.testing.assert_allclose(table["mu_ratio"][0, :, 0, 0, 0], [1 / (1 + 0.3 * s) for s in stokes], rtol=1e-12)
        one = plan_of(regime="wet", axes=DRY["axes"] | {"stokes": [10]}, seeds=1)
        self.assertEqual(fit.fitted(one, synthetic(one, 0)).attributes["lambda"], 0, "one Stokes number has no slope")

    def test_exchange_and_the_drift_that_all_points_had(self):
        """Two seeds a point: the mean of 0.8 and 0.9 is 0.85. The first point's boxes drift at 0.2 and -0.3, all others at 0.4: up to 0.3
        all points are measured."""
        plan = plan_of(**TWO)
        boxes = [box_of(point, exchange_ratio=[0.8 if point.seed == 1 else 0.9, 0.01], slip_over_sqrt_theta=0.4)
                 for point in plan.boxes()]
        first = len(boxes) // 2
        for point, box in zip(plan.boxes()[:first], boxes):
            box["exchange_ratio"], box["slip_over_sqrt_theta"] = [0.0, 0.0], 0.0
        boxes[first]["slip_over_sqrt_theta"], boxes[first + 1]["slip_over_sqrt_theta"] = 0.2, -0.3
        table = fit.fitted(plan, boxes)
        np.testing.assert_allclose(table["beta_12_ratio"], 0.85, rtol=1e-14)
        self.assertEqual(table["beta_12_drift"], [0.3])
        fit.require_exchange(table)
        table["beta_12_ratio"][1, 0, 1, 0, 0] = -0.1  # species that are sped up by each other
        with self.assertRaisesRegex(StudyError, "at phi = 0.2 beta_12 is -0.1 of its form"):
            fit.require_exchange(table)


class Texts(unittest.TestCase):
    def test_tables_fit_on_a_screen_whatever_varies(self):
        full = {"pressure_Pa": [3.243e-5, 6e-7], "viscosity_Pa_s": [0.003243, 6e-5], "density_kg_m3": 2500.0, "balance": 0.99923,
                "mu_ratio": [1.2345, 0.01], "exchange_ratio": [1.299, 0.05], "slip_over_sqrt_theta": 0.153, "binary": True}
        boxes = [box_of(Point("dry", 0.1 * n, 0.5 * n, 0.9 + 0.01 * n, 0.1 * n, 0.25 * n), restitution=0.9 + 0.01 * n, friction=0.1 * n,
                        share=0.25 * n, pushed=pushed, **full) for n in (1, 2, 3) for pushed in (False, True)]
        lines = box_lines(boxes).splitlines()
        self.assertLessEqual(max(map(len, lines)), 100)
        self.assertEqual(lines[0].split()[:6], ["phi", "St", "e", "mu_p", "x2", "seed"])
        self.assertEqual(lines[1].split()[:6], ["0.1", "0.5", "0.91", "0.1", "0.25", "1"])
        self.assertEqual(sum("1.23" in line for line in lines), 3, "pushed boxes are in the table of two species alone")
        self.assertEqual(sum("1.299±0.05" in line for line in lines), 3)
        self.assertIn("work of the shear over dissipation 0.99923 to 0.99923", "\n".join(lines))

    def test_what_all_boxes_share_is_said_once(self):
        boxes = [box_of(Point("dry", phi, 0, 0.9, 0, 0, False, False, 1), restitution=0.9, friction=0, share=0, pushed=False, binary=False,
                        balance=1.0, density_kg_m3=1.0, pressure_Pa=[1, 0.1], viscosity_Pa_s=[1, 0.1]) for phi in (0.3, 0.45)]
        lines = box_lines(boxes).splitlines()
        self.assertEqual(lines[0], "in all boxes St 0, e 0.9, mu_p 0, x2 0")
        self.assertEqual(lines[1].split()[:3], ["phi", "seed", "theta/(g"])


class Bed(unittest.TestCase):
    def test_both_ways_their_errors_and_their_difference(self):
        """Two points of two seeds: p 1.00 and 1.02, s/sqrt(2) = 0.01, times 1.837; errors of the boxes 0.002/sqrt 2."""
        boxes = []
        for n in range(4):
            p = (1.0 if n < 2 else 3.0) + 0.02 * (n % 2)
            boxes.append({"bed_phi": 0.28 if n < 2 else 0.46, "p_bed": [p, 0.002], "p_bed_by_balance": [1.03 * p, 0.002],
                          "theta_m2_s2": [2e-6, 0.0], "velocity_m_s": 0.02 if n < 2 else 0.01})
        table = fit.bed_table([2, 2], boxes, 4e-6)
        self.assertAlmostEqual(table["p_bed"][0], 1.01, delta=1e-14)
        self.assertAlmostEqual(table["p_bed_se"][0], 0.018373372, delta=1e-9)
        self.assertAlmostEqual(table["p_bed_by_balance"][0] / table["p_bed"][0] - 1, 0.03, delta=1e-14)
        self.assertAlmostEqual(table["theta_bed"][1], 0.5, delta=1e-14)
        self.assertEqual((table["velocity"][1], table["p_bed_n"]), (0.01, [2, 2]))
        fit.require_usable_bed(table)
        self.assertIn("+3.0 %", bed_rows(table))
        table["p_bed_by_balance"][1] *= 1.1
        with self.assertRaisesRegex(StudyError, "at phi = 0.460 .* 13 % apart, 5 % are allowed"):
            fit.require_usable_bed(table)
        table["p_bed"][1] = table["p_bed_by_balance"][1] = 0.9
        with self.assertRaisesRegex(StudyError, "p_bed falls between phi = 0.280 and 0.460"):
            fit.require_usable_bed(table)


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def judged(self, table):
        table.attributes |= {"filetype": "polybed solids table", "version": 1, "git_commit": "", "created": "", "case_hash": "",
                             "size_ratio": 1.0}
        table.write(self.folder / "table.h5")
        return asked("table", table=self.folder / "table.h5")


class Files(Scratch):
    def test_a_box_is_read_back_and_no_other(self):
        path = self.folder / "box.json"
        box = dict.fromkeys(SINGLE, 0.999) | dict.fromkeys(MEANS, [1 / 3, 0.01]) | {"hash": "0123"}
        path.write_text(json.dumps(box))
        self.assertEqual(read_box(path, "0123"), box)
        self.assertIsNone(read_box(path, "4567"), "of another box")
        self.assertIsNone(read_box(self.folder / "none.json", "0123"))
        for wrong in (path.read_text()[:100], "[]", "nul", json.dumps(box | {"p_ratio": [1.0]}), json.dumps(box | {"balance": None})):
            path.write_text(wrong)
            self.assertIsNone(read_box(path, "0123"), wrong)

    def six_boxes(self, script):
        """Boxes with a program that does this for each line that it is asked."""
        program = self.folder / "polybed"
        program.write_text(f"#!/bin/sh\nwhile read line; do {script}; done\n")
        program.chmod(0o755)
        self.enterContext(mock.patch.dict(os.environ, POLYBED=str(program)))
        door = SimpleNamespace(ask=lambda *_, **__: [[str(n), 1.0] for n in range(6)])
        options = SimpleNamespace(output=self.folder, jobs=3, case="case.toml", set=[], quiet=True)
        return Boxes(door, options, [Point("dry", 0.1, 0, 0.9, 0, 0, seed=n) for n in range(6)])

    def test_jobs_run_side_by_side_and_those_that_fail_are_named(self):
        boxes = self.six_boxes('case "$line" in *\'"seed": \'[135]*) exit 3;; *files*) echo null; echo "[]";; *) echo {};; esac')
        self.assertEqual(sorted(boxes.run_as_processes()), [1, 3, 5])
        self.assertEqual(boxes.done, [True, False] * 3)

    def test_jobs_are_ended_when_they_are_stopped(self):
        threading.Timer(0.5, signal.pthread_kill, [threading.main_thread().ident, signal.SIGINT]).start()
        with self.assertRaises(KeyboardInterrupt):
            self.six_boxes("exec sleep 600").run_as_processes()
        self.assertEqual([child.args for child in running if child.poll() is None], [])

    def test_a_pressure_that_falls_is_refused_and_its_place_named(self):
        plan = plan_of()
        shape = self.judged(fit.fitted(plan, synthetic(plan, 0)))
        self.assertEqual((shape["falls"], len(shape["a"])), ([], 10))
        self.assertTrue(0.1 < shape["falls_in_shear_up_to"] < 0.2, shape)  # a dilute gas grows hotter as it thins
        table = fit.fitted(plan, synthetic(plan, 0, lambda point: 0.3 if (point.phi, point.restitution) == (0.3, 0.8) else 1.0))
        falls = self.judged(table)["falls"]
        self.assertEqual(len(falls), 1)
        self.assertIn("e = 0.8", falls[0])
        with self.assertRaisesRegex(StudyError, "falls with the solids fraction.*phi = 0.2"):
            fit.require_usable(table, falls)

    def test_a_table_that_no_run_reads_is_not_written(self):
        plan = plan_of()
        with self.assertRaises(ProgramError) as refused:
            self.judged(fit.fitted(plan, synthetic(plan, 0, lambda point: -1.0)))
        self.assertEqual(refused.exception.code, 4)


def box_at(phi, stokes, **measured):
    return box_of(Point("wet", phi, stokes, 0.9, 0.3, 0), **measured)


class Checks(Scratch):
    """Solids fractions 0.3 and 0.5, Stokes numbers 1 and 100, lambda 0.05. Half-way between two knots a monotone cubic with flat ends is
    at their mean: p 0.9 +- 0.09, mu 0.5 +- 0.02."""

    def table(self, regime="wet", stokes=(1, 100), p=((0.8, 0.8), (1.0, 1.0)), p_error=0.09, mu=((0.6, 0.6), (0.4, 0.4)), mu_error=0.02,
              inertia=0.05):
        table = SolidsTable({"phi": [0.3, 0.5], "stokes": list(stokes), "e": [0.9], "mu_p": [0.3], "x2": [0]},
                            {"regime": regime, "reference": "viscous", "lambda": inertia, "fit_residual": 0.0, "left_out_residual": 0.0})
        ones = np.ones((2, len(stokes)))
        for name, values, error in (("p_ratio", p, p_error), ("mu_ratio", mu, mu_error), ("gamma_ratio", ones, 0), ("T_ratio_12", ones, 0)):
            values = np.array(values, float)[:, :len(stokes)]
            table.put(name, values)
            table.put(f"{name}_se", np.full_like(values, error))
            table.put(f"{name}_n", np.full_like(values, 3))
        table.put("S", ones)
        return table

    def deviation(self, table, box):
        self.judged(table)
        point = Point(table.attributes["regime"], box["solids_fraction"], box["stokes"], 0.9, 0.3, 0)
        [ratios] = asked("ratios", table=self.folder / "table.h5", points=[point._asdict()])
        return deviation(box, ratios, table.attributes["lambda"])

    def test_a_box_over_the_table_less_one_with_the_errors_of_both(self):
        """At St 10 the table says (1 + 0.05 10) 0.9 = 1.35 for p and 0.75 for mu. A box of 1.62 +- 0.162 is 20 % above, with
        0.162/1.35 = 12 % of its own and 0.09/0.9 = 10 % of the table; one of 0.6 +- 0.0225 is 20 % below, with 3 and 4 %."""
        found = self.deviation(self.table(), box_at(0.4, 10, p_ratio=[1.62, 0.162], mu_ratio=[0.6, 0.0225]))
        np.testing.assert_allclose(found, [(0.2, math.hypot(0.12, 0.1)), (-0.2, 0.05)], atol=1e-12)
        lines = deviation_lines([Point("wet", 0.4, 10, 0.9, 0.3, 0)], [found])
        self.assertIn("+20.0 % +- 15.6 (1.3 se)", lines)
        self.assertIn("-20.0 % +- 5.0 (4.0 se)", lines)

    def test_between_stokes_numbers_the_table_is_taken_in_the_logarithm(self):
        """At 10, half-way from 1 to 100, 0.9 and 1.1 give 1."""
        table = self.table(p=((0.9, 1.1), (0.9, 1.1)))
        self.assertAlmostEqual(self.deviation(table, box_at(0.35, 10, p_ratio=[1.5, 0.0]))[0][0], 0, delta=1e-12)
        found = self.deviation(table, box_at(0.35, 1, p_ratio=[1.5, 0.0]))[0][0]
        self.assertAlmostEqual(found, 1.5 / (1.05 * 0.9) - 1, delta=1e-12)

    def test_a_dry_box_is_compared_with_the_ratio_itself(self):
        """A dry table has Stokes number 0 alone and no lambda."""
        table = self.table("dry", (0,), p_error=0.045, mu=((1.0,), (1.0,)), mu_error=0, inertia=0.0)
        found = self.deviation(table, box_at(0.4, 0, p_ratio=[0.81, 0.0], mu_ratio=[1.02, 0.01]))
        np.testing.assert_allclose(found, [(-0.1, 0.05), (0.02, 0.01)], atol=1e-12)

    def test_the_curve_of_the_fit_is_that_of_a_run(self):
        plan = plan_of(**FOUR)
        values = {0.1: 1.0, 0.2: 1.1, 0.3: 1.3, 0.4: 1.2}
        table = fit.fitted(plan, synthetic(plan, 0, lambda point: values[point.phi]))
        self.judged(table)
        phi = np.linspace(0.1, 0.4, 13)
        read = asked("ratios", table=self.folder / "table.h5", points=[Point("dry", one, 0, 0.9, 0, 0)._asdict() for one in phi])
        np.testing.assert_allclose([row[0] for row in read], fit.curve(list(values), list(values.values()))(phi), rtol=1e-13)

    def test_points_are_those_between_the_knots(self):
        table = self.table()
        table.arrays |= {"phi": [0.1, 0.2, 0.3, 0.4, 0.5, 0.55], "stokes": [1, 10, 40], "e": [0.8, 0.9], "mu_p": [0.1, 0.3],
                         "x2": [0.25, 0.75]}
        points = points_between(table, True)
        np.testing.assert_allclose([point.phi for point in points], [0.15, 0.35, 0.525], rtol=1e-15)
        for point in points:
            self.assertAlmostEqual(point.stokes, 20, delta=1e-12)  # between 10 and 40, in the logarithm
            self.assertEqual(point[3:8] + (point.regime,), (0.8, 0.1, 0.25, True, False, "wet"))
            self.assertGreater(point.seed, fit.MOST_SEEDS, "one that no plan has")
        table.arrays |= {"phi": [0.3, 0.5], "stokes": [10]}
        [one] = points_between(table, True)  # of one distance, its middle alone
        self.assertEqual((one.phi, one.stokes), (0.4, 10))

    def test_a_written_table_has_its_checksum(self):
        self.judged(self.table())
        with h5py.File(self.folder / "table.h5", "r+") as file:
            file["p_ratio"][0] = 0.81
        with self.assertRaises(ProgramError) as refused:
            asked("table", table=self.folder / "table.h5")
        self.assertEqual(refused.exception.code, 4)

    def test_a_table_is_moved_by_its_errors(self):
        self.judged(self.table())
        given, path = self.folder / "table.h5", self.folder / "moved.h5"
        self.assertEqual(moved_table(given, -1, path), f'effects.solids_stress="table:{path}"')
        one, other = read_table(given), read_table(path)
        for name in one.names():
            error = one[f"{name}_se"] if name in ("p_ratio", "mu_ratio") else 0
            np.testing.assert_array_equal(other[name], one[name] - error)
        # so far that its pressure falls: a hundredth of it is left at the last solids fraction
        with h5py.File(given, "r+") as file:
            file["p_ratio_se"][-1] = 0.99
            file.attrs["crc32"] = checksum({name: data[...] for name, data in file.items()})
        with self.assertRaises(StudyError) as refused:
            moved_table(given, -1, self.folder / "fallen.h5")
        self.assertIn("moved by -1 standard errors: its pressure falls at phi", str(refused.exception))
        self.assertFalse(list(self.folder.glob("fallen*")))

    def test_a_table_of_a_bed_without_errors_is_not_moved(self):
        SolidsTable({"phi": [0.3, 0.5], "p_bed": [1.0, 2.0]}, {"filetype": "polybed solids table", "version": 1, "regime": "bed"}).write(
            self.folder / "bed.h5")
        with self.assertRaises(StudyError) as refused:
            moved_table(self.folder / "bed.h5", 1, self.folder / "moved.h5")
        self.assertIn("p_bed_se", str(refused.exception))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
