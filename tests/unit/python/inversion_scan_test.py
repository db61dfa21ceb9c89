#!/usr/bin/python3
"""The search for the inversion velocity on functions whose zero is known, and what is made of it: inversion_scan_test.py PACKAGE_DIRECTORY"""

import math
import sys
import unittest

sys.path.insert(0, sys.argv.pop(1))

from polybed.study import inversion_report as report  # noqa: E402
from polybed.study.inversion import choice_of  # noqa: E402
from polybed.study.inversion_search import WIDTH, Found, Mean, Step, search  # noqa: E402


def answers(g, error):
    """Runs that answer with a function of the velocity, each with the same interval."""
    return lambda velocity, source: Mean(g(velocity), error)


class Choice(unittest.TestCase):
    def test_every_run_has_the_effects_that_were_chosen_for_the_case(self):
        keys = {"effects": {"others": "none", "drag": "cello", "cohesion": "van_der_waals"},
                "dem": {"hamaker_constant": 1e-19, "friction": 0.3}, "chooser": {"chosen": ["cohesion", "lift"]}}
        self.assertEqual(choice_of(keys), ['effects.cohesion="van_der_waals"', 'effects.lift="none"', "dem.hamaker_constant=1e-19"])
        self.assertEqual(choice_of(keys | {"chooser": {"chosen": ["lift"]}}), ['effects.lift="none"'])
        self.assertEqual(choice_of({"effects": {"drag": "cello"}, "dem": {}}), [])


class Search(unittest.TestCase):
    def test_finds_a_known_zero_and_counts_its_runs(self):
        # tanh has its zero at 30 mm/s; what the secant errs by within a bracket of 3 % is far below its width
        found = search(0.02, 0.045, answers(lambda u: 0.4 * math.tanh((0.030 - u) / 0.004), 1e-4))
        self.assertEqual(found.outcome, "bracket")
        self.assertAlmostEqual(found.velocity, 0.030, delta=1e-4)
        self.assertLessEqual(found.width, WIDTH)
        self.assertLess(found.low, 0.030)
        self.assertGreater(found.high, 0.030)
        # 2 ends and, each halving the bracket at every second cut at least, 2 log2(0.77/0.03) = 9.4 more
        self.assertLessEqual(len(found.steps), 12)
        # of the line between the ends: -0.4/0.004 at the zero, less by the curvature of tanh over a bracket of 0.0009
        self.assertAlmostEqual(found.slope, -100, delta=2)
        self.assertGreater(found.error, 0.5e-4 / 100)  # one of two ends counts at least half
        self.assertLess(found.error, 1e-4 / 98)

    def test_each_run_goes_on_from_the_nearer_end(self):
        steps = search(1, 2, answers(lambda u: u * u - 2, 1e-9)).steps
        self.assertGreater(len(steps), 4)  # the secant of a parabola is not its zero, so there are cuts
        self.assertIsNone(steps[0].source)
        self.assertEqual(steps[1].source, 0)
        for n, step in enumerate(steps[2:], start=2):
            nearest = min(abs(before.velocity - step.velocity) for before in steps[:n])
            self.assertEqual(abs(steps[step.source].velocity - step.velocity), nearest, n)

    def test_what_is_not_certain_is_repeated_from_the_other_side(self):
        # at the first secant, 1.5, nothing can be told; half-width 0.1
        found = search(1, 2, answers(lambda u: 1.5 - u, 0.1))
        self.assertEqual(found.outcome, "indistinct")
        self.assertEqual([(step.velocity, step.source) for step in found.steps[2:]], [(1.5, 0), (1.5, 1)])
        self.assertEqual(found.velocity, 1.5)
        self.assertEqual(found.slope, -1)  # from (1, 0.5) to (2, -0.5)
        self.assertAlmostEqual(found.error, 0.1 / math.sqrt(2), delta=1e-15)  # two means of the same interval

    def test_what_depends_on_the_side_is_as_uncertain_as_the_sides_differ(self):
        told = iter([0.5, -0.5, 0.005, -0.205])
        found = search(1, 2, lambda velocity, source: Mean(next(told), 0.01))
        self.assertEqual(found.outcome, "indistinct")
        self.assertAlmostEqual(found.error, 0.105, delta=1e-12)  # (0.005 + 0.205)/2 over a slope of 1

    def test_widens_a_range_that_does_not_enclose_the_zero(self):
        above = search(1, 1.2, answers(lambda u: 1.9 - u, 1e-6))
        self.assertEqual(above.outcome, "bracket")
        self.assertAlmostEqual(above.velocity, 1.9, delta=1e-6)
        self.assertAlmostEqual(search(1, 1.2, answers(lambda u: 0.6 - u, 1e-6)).velocity, 0.6, delta=1e-6)
        # an end in the noise is not taken for one side or the other
        noisy = search(1, 2, answers(lambda u: 2.01 - u, 0.02))
        self.assertAlmostEqual(noisy.velocity, 2.01, delta=0.03)
        self.assertGreater(noisy.high, 2.01)

    def test_says_that_there_is_none(self):
        found = search(1, 2, answers(lambda u: 0.3, 0.01))
        self.assertEqual(found.outcome, "not found")
        self.assertIsNone(found.velocity)
        self.assertEqual(len(found.steps), 8)  # two ends, each widened in turn, six times in all

    def test_does_not_search_where_the_bed_fills_the_column(self):
        found = search(1, 2, lambda velocity, source: Mean(4 - velocity, 0.01, velocity > 2.2))
        self.assertEqual(found.outcome, "filled")
        self.assertEqual([step.velocity for step in found.steps], [1, 2, 2.5])  # one widening fills it
        self.assertIn("where the bed fills the column", report.finding(scan(None, low=1, high=2.5, outcome="filled"), ["fine", "coarse"])[0])


def scan(velocity, error=0.0, low=0.0, high=0.0, model="tfm", outcome="bracket"):
    return report.ScanOfModel(model, Found(outcome, [], low, high, velocity, error, -1.0), [])


class Report(unittest.TestCase):
    def test_the_band_of_a_table_has_all_three_answers_or_none(self):
        whole = scan(0.030)
        self.assertIsNone(report.stress_band(whole))  # not asked for
        whole.moved = [scan(0.031), scan(0.0305)]
        self.assertEqual(report.stress_band(whole), (0.030, 0.031))
        self.assertEqual(whole.plain()["stress_uncertainty"]["high_m_s"], 0.031)
        whole.moved[1].found.velocity = None
        self.assertIsNone(report.stress_band(whole))
        self.assertIsNone(whole.plain()["stress_uncertainty"]["high_m_s"])

    def test_the_models_agree_within_five_percent_or_their_brackets(self):
        close = report.agreement_of([scan(34.4e-3, 0.3e-3, 34e-3, 35e-3), scan(32e-3, 0, 31.7e-3, 32.3e-3, "dem")])
        self.assertAlmostEqual(close["value"], 0.075, delta=1e-12)  # 34.4/32 - 1
        self.assertAlmostEqual(close["error"], 1.075 * 0.3 / 34.4, delta=1e-12)
        self.assertEqual((close["goal"], close["reached"]), (0.05, False))  # brackets of 2.9 and 1.9 %
        one = scan(1, 0, 0.95, 1.05)
        wide = report.agreement_of([one, scan(1.05, 0, 1, 1.1, "dem")])
        self.assertAlmostEqual(wide["goal"], 0.5 * (0.1 + 0.1 / 1.05), delta=1e-12)
        self.assertTrue(wide["reached"])
        # a wide bracket that ended in the noise leaves no more room than its interval
        noisy = scan(1.05, 0.03, 0.5, 1.5, "dem", "indistinct")
        self.assertAlmostEqual(report.agreement_of([one, noisy])["goal"], 0.5 * (0.1 + 0.06 / 1.05), delta=1e-12)
        self.assertIsNone(report.agreement_of([one]))
        self.assertIsNone(report.agreement_of([one, scan(None, model="dem")]))

    def test_the_mixed_interval_is_where_the_interface_is_at_the_beds_height(self):
        # interface over height by velocity; at 34 two runs, of which one is not mixed
        runs = [(25, 0.45), (28, 0.99), (31, 1.0), (34, 1.0), (34, 0.9), (36, None)]
        found = scan(30.0, 0.1, 28, 31)
        found.found.steps = [Step(u, None, Mean(0, 1)) for u, _ in runs]
        found.runs = [{"interface_over_height": interface, "warnings": []} for _, interface in runs]
        self.assertEqual(report.mixed_interval(found), {"least_m_s": 28, "greatest_m_s": 31, "below_m_s": 25, "above_m_s": 34})
        self.assertIn("from 2.8e+04 (not at 2.5e+04) to 3.1e+04 (not at 3.4e+04) mm/s", report.findings([found], None))
        found.runs = [{"interface_over_height": 0.97, "warnings": []} for _ in runs]
        self.assertIsNone(report.mixed_interval(found))

    def test_runs_that_drift_at_the_bracket_leave_it_undecided(self):
        both = [scan(30.0, 0.1, 28, 31), scan(30.1, 0.1, 28, 31, "dem")]
        for one in both:
            one.found.steps = [Step(u, None, Mean(0, 1)) for u in (25, 28, 31)]
            one.runs = [{"interface_over_height": 1.0, "warnings": drifts} for drifts in (["not steady"], [], [])]
        self.assertNotIn("undecided", report.findings(both, None))
        self.assertTrue(report.agreement_of(both)["reached"])
        both[1].runs[2]["warnings"].append("not steady: drift of bed_height")
        self.assertIn("dem: undecided: 1 of 2 runs in the bracket still drift", report.findings(both, None))
        self.assertIn("undecided, runs still drift", report.findings(both, None))
        self.assertIsNone(report.agreement_of(both)["reached"])

    def test_runs_contradict_an_interval_of_the_force_balance(self):
        found = scan(30.0, 0.1, 28, 31)
        found.found.steps = [Step(u, None, Mean(0, 1)) for u in (25, 28, 31)]
        found.runs = [{"interface_over_height": interface, "warnings": []} for interface in (0.4, 0.5, 1.0)]
        others = {"mixed_interval_m_s": [27, 32], "equal_bulk_density_m_s": 27, "measured_m_s": None, "simulated_m_s": None}
        told = report.findings([found], None, others, ["fine", "coarse"])
        self.assertIn("tfm: contradicts it: not mixed at 2.8e+04 mm/s\n", told)
        on_top = ("fine", "coarse") if found.found.slope > 0 else ("coarse", "fine")
        self.assertIn("; {} on top below it, {} above\n".format(*on_top), told)
        reverse = report.findings([], None, others | {"mixed_interval_m_s": None, "equal_bulk_density_m_s": 0.035})
        self.assertIn("no mixed interval by force balance: equal bulk densities lie above it, at: 35 mm/s", reverse)

    def test_what_others_found_stands_beside(self):
        told = report.findings([], None, {"mixed_interval_m_s": [0.0282, 0.0343], "measured_m_s": [0.03], "simulated_m_s": None})
        for line in ("mixed by force balance: 28.2 to 34.3 mm/s", "measured: 30 mm/s"):
            self.assertIn(line, told)
        self.assertNotIn("simulated", told)


if __name__ == "__main__":
    unittest.main()
