#!/usr/bin/python3
"""What `polybed cost` computes from what it has measured, by hand values. Usage: cost_test.py PROGRAM PACKAGE_DIRECTORY"""

import json
import os
import sys
import tempfile
import unittest
from argparse import ArgumentTypeError
from math import e, inf
from types import SimpleNamespace

import numpy as np
from scipy.integrate import solve_ivp

PROGRAM, PACKAGE = sys.argv[1:3]
sys.path.insert(0, PACKAGE)
os.environ["POLYBED"] = PROGRAM

from polybed.cost import command  # noqa: E402
from polybed.cost.axes import axes_of, grid_level, level_axis, numbers  # noqa: E402
from polybed.cost.front import line_error, of_input  # noqa: E402
from polybed.cost.judge import carries, fit_power_law, pareto_front, refine  # noqa: E402
from polybed.cost.report import advice, shares_json  # noqa: E402
from polybed.cost.sweep import CANDIDATE, REFERENCE, Priced, Row, RunQuantities, Share, Sweep, quantities_of_run  # noqa: E402
from polybed.cost.sweeper import is_chaotic  # noqa: E402
from polybed.cost.runner import RunOrder, RunOutcome, counters_of, weighed  # noqa: E402
from polybed.ending import StudyError  # noqa: E402
from polybed.runner import call  # noqa: E402
from polybed.study.measured import TimeMean  # noqa: E402
from stored_run import Written  # noqa: E402


def lorenz(_, y):
    return 10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - 8 / 3 * y[2]


def damped(_, y):
    return y[1], -y[0] - 0.2 * y[1], 0.0


class Oracles(unittest.TestCase):
    """Problems with known answers that `polybed-hard` computes with the means, integrators and measures of the program."""

    @classmethod
    def setUpClass(cls):
        cls.computed = json.loads(call("stability", "--oracles"))

    def test_the_interval_of_a_mean_contains_the_true_mean(self):
        self.assertAlmostEqual(self.computed["coverage"], 0.95, delta=0.02)

    def test_the_error_of_both_integrators_falls_at_their_order(self):
        for name, order in (("explicit", 3), ("implicit", 2)):
            law = fit_power_law(*zip(*((run["steps"], run["error"]) for run in self.computed["settling"][name])))
            self.assertAlmostEqual(-law.exponent, order, delta=0.2, msg=name)

    def test_cells_and_counted_particles_measure_the_same(self):
        """Slabs of 2 mm: lengths agree within one, shares within a slice of 50. The denser lower layer ends at 60 mm, the bed at 160 mm."""
        measures = self.computed["measures"]
        self.assertAlmostEqual(measures["bed_height"][0], 0.16, delta=1e-3)
        for name, within in (("bed_height", 2e-3), ("centre_b", 2e-3), ("interface", 2e-3), ("mixing", 0.02)):
            self.assertAlmostEqual(*measures[name], delta=within, msg=name)
        self.assertLess(self.computed["composition"], 0.02)


class Laws(unittest.TestCase):
    def test_a_power_law_is_found_from_its_points(self):
        law = fit_power_law([1, 2, 4, -1], [3, 12, 48, 7])  # 3 x^2; what has no logarithm does not count
        for found, wanted in ((law.factor, 3), (law.exponent, 2), (law.scatter, 0)):
            self.assertAlmostEqual(found, wanted, delta=1e-10)
        self.assertIsNone(fit_power_law([2, 2], [1, 3]))
        self.assertIsNone(fit_power_law([1, 2], [1, inf]))
        # ln y = 0, 1, 0 at ln x = 0, 1, 2: slope 0, mean 1/3, residuals -1/3, 2/3, -1/3 with mean square 6/27.
        self.assertAlmostEqual(fit_power_law([1, e, e * e], [1, e, 1]).scatter, (6 / 27) ** 0.5, delta=1e-12)

    def test_the_front_is_what_nothing_beats(self):
        points = [Priced(*pair) for pair in ((1, 1), (0.5, 2), (0.7, 3), (0.5, 2), (0.1, 10), (2, 0.5))]
        self.assertEqual(pareto_front(points), [5, 0, 1, 4])


class Refinement(unittest.TestCase):
    def test_by_numbers_known_to_all_digits(self):
        found = refine(0.961780, 0.968540, 0.970500)
        self.assertAlmostEqual(found.order, 1.786170, delta=5e-7)
        self.assertAlmostEqual(found.limit, 0.9713003, delta=5e-8)
        self.assertAlmostEqual(100 * found.band / 0.970500, 0.103083, delta=5e-7)  # the grid convergence index, %

    def test_order_and_limit_of_a_power(self):
        """Exact powers: f = 1 + h^p at h = 1, 1/3, 1/9 has the limit 1 whatever the safety."""
        for p in (1.0, 2.0):
            found = refine(2, 1 + 3**-p, 1 + 9**-p, 3, 2)
            self.assertAlmostEqual(found.order, p, delta=1e-12)
            self.assertAlmostEqual(found.limit, 1, delta=1e-12)

    def test_an_order_that_is_not_the_schemes_is_trusted_less(self):
        """f = 1 + h^3 under a scheme of order 1: order 3 is beyond 1.5, so F_s = 3 with p = 1: the band is 3 (1/8 - 1/64)."""
        found = refine(2, 1 + 1 / 8, 1 + 1 / 64, 2, 1)
        self.assertAlmostEqual(found.order, 3, delta=1e-12)
        self.assertEqual(found.safety, 3)
        self.assertAlmostEqual(found.band, 3 * (1 / 8 - 1 / 64), delta=1e-12)
        self.assertIn("not that of the scheme", found.note)
        wide = refine(2, 1 + 3**-5, 1 + 9**-5, 3, 2)  # 3/(3^2 - 1) of the last difference would be less than that itself
        self.assertAlmostEqual(wide.band, 3**-5 - 9**-5, delta=1e-12)
        slow = refine(1 + 1, 1 + 0.9, 1 + 0.82, 2, 2)  # p = ln(0.1/0.08)/ln 2
        self.assertAlmostEqual(slow.order, 0.3219, delta=1e-4)
        self.assertEqual(slow.safety, 3)

    def test_a_scattered_sequence_has_no_order(self):
        """K12: a sequence that swings, or that parts; three times half of its range is told in its place."""
        found = refine(1.0, 1.2, 1.1)
        self.assertIsNone(found.order)
        self.assertAlmostEqual(found.band, 0.3, delta=1e-12)
        self.assertIn("asymptotic range", found.note)
        self.assertIsNone(refine(1.0, 1.1, 1.3).order)
        self.assertEqual(refine(1.0, 1.0, 1.0).band, 0)
        with self.assertRaises(ValueError):
            refine(1, 2, 3, 1.2)


def row_of(height, order=RunOrder("tfm"), kind=CANDIDATE, centre=None):
    return Row(order, kind, outcome=RunOutcome("done"), measured=RunQuantities({"bed_height": TimeMean(height)}, centre=centre))


class Parts(unittest.TestCase):
    def test_time_is_measured_against_its_own_tightest_run_whatever_the_reference(self):
        """Heights of 61 and 61.1 mm by two tolerances on the coarsest grid, beside a force balance of 63 mm and a tight run of 61.2 mm there."""
        line, tight = [row_of(0.061), row_of(0.0611)], RunOrder("tfm", ("tfm.rtol=1e-07",))
        axis = numbers(SimpleNamespace(of=lambda *_: 1e-3), "tfm", "rtol", "tfm.rtol", [1e-2, 1e-3], True, [])
        sweep = Sweep(SimpleNamespace(quantities=["bed_height"]), [axis])
        sweep.rows = [row_of(0.063, RunOrder("force_balance"), REFERENCE), *line]
        sweeper = SimpleNamespace(sweep=sweep, row_on_line=lambda _, level: line[level], tight=lambda: tight)
        self.assertAlmostEqual(line_error(sweeper, "rtol", 0), 1e-4, delta=1e-12)  # m; the finest of the line
        sweep.rows.append(row_of(0.0612, tight, REFERENCE))
        self.assertAlmostEqual(line_error(sweeper, "rtol", 0), 2e-4, delta=1e-12)

    def test_a_datum_moves_a_height_by_the_centre_of_the_solids(self):
        """Of 31.0 mm 0.7 % more, where the height on slabs shows 0.33 %."""
        given = row_of(0.0610, centre=0.0310)
        share = of_input(row_of(0.0612, centre=1.007 * 0.0310), given, "bed_height", 0.0033)
        self.assertAlmostEqual(share.value, 0.007, delta=1e-12)
        self.assertIn("centre of the solids", share.note)
        self.assertEqual(of_input(row_of(0.0612), given, "bed_height", 0.0033).value, 0.0033, "no profile")
        self.assertEqual(of_input(row_of(0.0612, centre=0.04), given, "mixing", 0.0033).value, 0.0033)


class Regime(unittest.TestCase):
    def test_what_stands_still_is_steady(self):
        self.assertFalse(is_chaotic([1.0] * 9, [1.0 + 1e-15] * 9))

    def test_a_chaotic_system_is_told_from_one_that_is_not(self):
        """By the first component at every 0.01 up to 50, with the start pushed by 1e-10."""
        for rate, chaotic in ((lorenz, True), (damped, False)):
            courses = [solve_ivp(rate, (0, 50), (1 + push, 1.0, 1.0), t_eval=np.arange(1, 5001) / 100, rtol=1e-8).y[0] for push in (0, 1e-10)]
            self.assertEqual(is_chaotic(*courses), chaotic)


class Work(unittest.TestCase):
    def test_is_weighed_in_seconds(self):
        """1000 right-hand sides of 100 unknowns at 23 ns and 500 iterations at 8 ns: 2.3 ms and 0.4 ms."""
        work = {"steps": 7, "rejected_steps": 0, "rhs_evaluations": 1000, "pressure_solves": 3, "linear_iterations": 500}
        record = {"model": "tfm", "unknowns": 100, "work": work}
        self.assertAlmostEqual(weighed(counters_of(record, 0)), 2.7e-3, delta=1e-15)
        work["pressure_solves"] = 0  # Jacobian products at 90 ns
        self.assertAlmostEqual(weighed(counters_of(record, 0)), 2.3e-3 + 4.5e-3, delta=1e-15)

    def test_of_particles(self):
        """ns: 100 x 15, 50 x 4, 20 x 25, 10 x 7; in a fluid 100 x 38, 2 x 2e5, 2 x 30 x 300, 8 x 12 x 60 besides."""
        work = {"steps": 1, "particle_steps": 100, "pair_checks": 50, "contact_steps": 20, "candidates": 10}
        record = {"model": "dem", "particles": 30, "work": work}
        self.assertAlmostEqual(weighed(counters_of(record, 12)), 2270e-9, delta=1e-20)
        record["fluid"] = {"steps": 2, "iterations": 8}
        self.assertAlmostEqual(weighed(counters_of(record, 12)), (2270 + 3800 + 400000 + 18000 + 5760) * 1e-9, delta=1e-18)


class Judgement(unittest.TestCase):
    def test_a_reference_carries_what_lies_above_ten_times_its_disagreement(self):
        """Two references 0.1 % apart have a floor of 1 %: good for a target of 1 %, or for an error above it; not for less."""
        self.assertTrue(carries(0.001, [0.002], 0.01))
        self.assertTrue(carries(0.002, [0.03], 0.01))
        self.assertFalse(carries(0.002, [0.019, 0.001], 0.01))
        self.assertFalse(carries(0.002, [], 0.01))

    def advised(self, *attribution):
        return advice({"outcome": "done", "recommend": [], "target": 0.01, "qoi": [], "attribution": shares_json(attribution)})

    def test_advice_names_the_largest_row_to_improve_where_all_were_measured(self):
        lines = self.advised(Share("time integration", 1e-6, "rtol"), Share("space", 0.02, "grid"))
        self.assertIn("The largest part of the error: size of the cells (2 %): that is what to improve.", lines)
        self.assertIn("At least ten times smaller, so it may be loosened to save time: time integration.", lines)
        self.assertNotIn("Not measured", "".join(lines))

    def test_advice_speaks_only_of_what_was_measured(self):
        lines = self.advised(Share("time integration", 1.2e-6, "rtol"), Share("space", None, "not run", ["grid"]),
                             Share("statistics", None, "steady"), Share("level", None, "not run", ["level"]))
        self.assertIn("The largest part of the error of those measured: time integration (0.00012 %).", lines)
        self.assertIn("Not measured, and not part of these errors: size of the cells; choice of the model: force balance, 1-D, 2-D, particles. "
                      "To measure them: --axes grid,level.", lines)
        self.assertNotIn("to improve", "".join(lines))

    def test_advice_names_the_missing_axes_where_nothing_has_an_error(self):
        lines = self.advised(Share("time integration", 0.0, "rtol"), Share("space", None, "not run", ["grid"]))
        self.assertNotIn("largest", "".join(lines))
        self.assertIn("To measure them: --axes grid.", "".join(lines))


class Axes(unittest.TestCase):
    def test_the_value_of_the_case_is_among_the_levels(self):
        def axis_of(given, *words):
            return numbers(SimpleNamespace(of=lambda key, default: given), "tfm", *words)

        axis = axis_of(3e-3, "rtol", "tfm.rtol", [1e-2, 1e-3, 1e-4], True, [1e-6])
        self.assertEqual([level.label for level in axis.levels], ["0.01", "0.003", "0.001", "0.0001"])
        self.assertEqual((axis.given, axis.beyond[0].overrides), (1, ["tfm.rtol=9.9999999999999995e-07"]))
        self.assertEqual(axis_of(1e-5, "rtol", "tfm.rtol", [1e-2, 1e-3], True, []).given, 2)
        self.assertEqual(axis_of(20, "steps", "dem.steps_per_contact", [10, 20], False, []).given, 1)

    def test_grids_have_whole_cells(self):
        """Half of 99 is 50, as C++ rounds; one cell stays one."""
        scene = SimpleNamespace(cells=[1, 99])
        self.assertEqual(grid_level(scene, 2).overrides, ["column.cells=[1,50]"])
        self.assertEqual((grid_level(scene, 1).label, grid_level(scene, 1).overrides), ("1x99", []))

    def test_a_column_that_tapers_has_no_uniform_bed(self):
        scene = SimpleNamespace(cells=[10, 80], law=lambda role: {"drag": "cello"}.get(role, "none"), only_for_particles=False,
                                needs={"static_height_m": 0.1}, is_tapered=False)
        self.assertEqual([level.label for level in level_axis(scene, "tfm").levels], ["tfm 2-D", "force balance", "tfm 1-D"])
        scene.is_tapered = True
        self.assertEqual([level.label for level in level_axis(scene, "tfm").levels], ["tfm 2-D"])

    def test_names(self):
        scene = SimpleNamespace(has_fluid=False)
        for names, text in ((["nonsense"], "there are rtol, grid"), (["coupling"], "does not act in this case by dem")):
            with self.assertRaisesRegex(StudyError, text):
                axes_of(scene, "dem", names)


class Quantities(unittest.TestCase):
    def run_of(self, cells, heights):
        """A bed of one species, uniform up to a height that differs from profile to profile."""
        rows, time = 40, np.linspace(0, 10, 401)
        y = (np.arange(cells) + 0.5) * 0.2 / cells
        phi = [np.where(y < height, 0.5, 0.0) for height in heights]
        history = {"time_s": time, "bed_height_m": np.full(401, heights[-1]), "centre_a_m": np.full(401, heights[-1] / 2),
                   "pressure_drop_Pa": np.full(401, 90.0), "buoyant_weight_Pa": np.full(401, 100.0)}
        profiles = {"time_s": np.linspace(0, 10, rows + 1), "y_m": y, "phi_a": np.array([phi[n % len(phi)] for n in range(rows + 1)])}
        return Written(history, profiles)

    def quantities_of(self, run, slabs):
        with tempfile.TemporaryDirectory() as folder:
            return quantities_of_run(run.into(folder), 7.5, slabs)

    def test_lengths_are_those_on_the_slabs_of_the_case(self):
        """The history has what the run's own slabs say; a coarser grid changes it by what its profiles change by."""
        same = self.quantities_of(self.run_of(40, [0.1]), 40)
        self.assertEqual(same.values["bed_height"].mean, 0.1)
        self.assertEqual(same.values["pressure_drop"].mean, 0.9)
        self.assertAlmostEqual(same.centre, 0.05, delta=1e-12)
        coarse = self.quantities_of(self.run_of(20, [0.1]), 40)
        # Of 20 slabs of 10 mm the half of 0.5 is passed midway between the centres at 95 and 105 mm, of 40 between 97.5 and 102.5 mm.
        self.assertAlmostEqual(coarse.values["bed_height"].mean, 0.1, delta=1e-12)
        off = self.quantities_of(self.run_of(20, [0.11]), 10)
        # Of 10 slabs of 20 mm the sixth has 0.25. Between z_0.80 = 88 mm and z_0.95 = 109 mm the mean is (12 x 0.25 + 9 x 0.0625)/(12 x
        # 0.5 + 9 x 0.25); its half is passed above the centre at 110 mm, where the run's own slabs have the height.
        half = 0.5 * 3.5625 / 8.25
        self.assertAlmostEqual(off.values["bed_height"].mean, 0.11 + 0.02 * (0.25 - half) / 0.25, delta=1e-12)


    def test_means_are_those_of_the_last_quarter(self):
        """Of a height that is 0.1 m up to three quarters of the run and 0.12 m from there on, in rows and in profiles."""
        run = self.run_of(40, [0.1])
        late = run.history["time_s"] > 7.4
        run.history["bed_height_m"] = np.where(late, 0.12, 0.1)
        run.profiles["phi_a"][run.profiles["time_s"] > 7.4] = np.where(run.profiles["y_m"] < 0.12, 0.4, 0.0)
        found = self.quantities_of(run, 40)
        self.assertEqual(found.values["bed_height"].mean, 0.12)


class Words(unittest.TestCase):
    def test_targets_and_budgets(self):
        self.assertEqual([command.target_of(text) for text in ("1%", "0.02", "2e-3", "5 %")], [0.01, 0.02, 2e-3, 0.05])
        self.assertEqual([command.budget_of(text) for text in ("20min", "3", "500ms", "1.5 h")], [1200, 3, 0.5, 5400])
        for read, texts in ((command.target_of, ("", "0%", "-1%", "1 m", "nan")), (command.budget_of, ("", "0s", "-3", "5 m", "inf", "1%"))):
            for text in texts:
                with self.assertRaises(ArgumentTypeError, msg=text):
                    read(text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
