#!/usr/bin/python3
"""Entries of measured beds, both sides of a comparison, verdicts and records. Usage: validation_test.py PROGRAM PACKAGE_DIRECTORY"""
import math
import os
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

PROGRAM, PACKAGE = sys.argv[1:3]
sys.path.insert(0, PACKAGE)
os.environ["POLYBED"] = PROGRAM
ROOT = Path(__file__).resolve().parents[3]
sys.dont_write_bytecode = True

from polybed.ending import StudyError  # noqa: E402
from polybed.files import FormatError, read_text  # noqa: E402
from polybed.study.cases import Case  # noqa: E402
from polybed.validation import entries, numbers, report  # noqa: E402
from polybed.validation.numbers import Number, Undecided, of_repeats, verdict  # noqa: E402
from stored_run import Written  # noqa: E402

RAMP = 'inlet = {superficial_velocity = [[0, 0], [10, 0.1]]}\nbed = {solids_fraction = 0.6, static_height = 0.06}\n'


def a_run(card=None, drift=None, **columns):
    """A run with a history, as polybed.read opens one."""
    record = {"case": RAMP, "card": card or {}, **({"drift": drift} if drift else {})}
    return SimpleNamespace(directory=Path("run"), record=record, history={name: np.asarray(values, float) for name, values in columns.items()})


def given(compare, run):
    entry = SimpleNamespace(measured=None, script=None, name="a")
    with mock.patch.object(numbers, "read", lambda _: run), tempfile.TemporaryDirectory() as folder:
        return numbers.run_number(entry, compare, Written(run.history).into(folder).directory)


class Entries(unittest.TestCase):
    def test_every_entry_has_its_case_and_its_measured_numbers(self):
        self.assertTrue({"expansion-in-water", "taghipour", "van-wachem", "vssuq", "verma"} <= set(entries.names()))
        for name in entries.names():
            with self.subTest(name):
                entry = entries.entry_named(name)
                self.assertTrue(entry.source and entry.title)
                self.assertTrue(entry.missing or entry.case.is_file(), entry.case)
                self.assertEqual(bool(entry.compares), not entry.missing)
                self.assertEqual(bool(entry.seconds), not entry.missing)
                for run in entry.runs:
                    for compare in entry.compared(run):
                        found = numbers.measured_number(entry, run, compare)
                        self.assertTrue(math.isfinite(found.value) and found.error > 0, compare)

    def test_each_run_is_one_that_its_models_can_make(self):
        for entry in map(entries.entry_named, entries.names()):
            for run in {run.seeds: run for run in entry.runs}.values():
                refused = Case(entry.case, run.overrides(2)).refused
                self.assertFalse([refused[model] for model in run.models if refused.get(model)], entry.name)

    def test_an_unknown_entry_and_an_unknown_key_are_named(self):
        with self.assertRaisesRegex(StudyError, "no entry 'taghipur'.* taghipour"):
            entries.entry_named("taghipur")
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "validation.toml").write_text('title = "a"\nsource = "b"\nmeasure = "c"\n')
            with self.assertRaisesRegex(FormatError, "unknown key 'measure'"):
                entries.entry_at(folder)

    def test_the_correlation_of_richardson_and_zaki(self):
        """The file's voidages follow from its velocities: u_t and n by hand from its comment; 10 % of the velocity is 0.1 eps/n."""
        rows = entries.rows_of(ROOT / "cases/validation/expansion-in-water/measured.csv")
        for row in rows:
            voidage = (float(row["velocity_mm_s"]) / 146.03) ** (1 / 2.7043)
            self.assertAlmostEqual(float(row["value"]), voidage, delta=1e-4)
            self.assertAlmostEqual(float(row["error"]), 0.1 * voidage / 2.7043, delta=1e-4)

    def test_inputs_of_the_rising_sphere_are_the_measured_means(self):
        folder = ROOT / "cases/validation/vssuq"
        case = tomllib.loads((folder / "case.toml").read_text())

        def mean(name, of):
            return np.mean([float(row["value"]) for row in entries.chosen_rows(folder / "properties.csv", {"property": name, "of": of})])
        intruder, glass = case["species"]
        self.assertAlmostEqual(float(intruder["diameter"].split()[0]), mean("diameter", "large intruder") / 1e3, delta=5e-4)
        # by number a lognormal distribution has the median m exp(-3 s^2), m by volume, and the mean m exp(-2.5 s^2)
        self.assertAlmostEqual(float(glass["median"].split()[0]) * math.exp(-2.5 * glass["deviation"] ** 2), mean("diameter", "glass") / 1e3, delta=5e-4)
        each = [float(row["value"]) for row in entries.chosen_rows(folder / "properties.csv", {"property": "diameter", "of": "glass"})]
        self.assertAlmostEqual(math.sqrt(math.expm1(glass["deviation"] ** 2)), np.std(each, ddof=1) / np.mean(each), delta=1e-4)
        for species, of in ((intruder, "large intruder"), (glass, "glass")):
            self.assertAlmostEqual(species["sphericity"], mean("sphericity", of), delta=5e-4)
        self.assertAlmostEqual(case["dem"]["restitution"], mean("restitution", "glass-glass"), delta=5e-4)
        self.assertAlmostEqual(case["contact_pair"][0]["restitution"], mean("restitution", "glass-intruder"), delta=6e-4)


class Numbers(unittest.TestCase):
    def test_repeats_have_students_interval_and_one_run_is_one_more(self):
        entry = entries.entry_named("vssuq")
        measured = numbers.measured_number(entry, entry.runs[0], entry.compares[0])  # of one large sphere at 1.83 m/s
        self.assertAlmostEqual(measured.value, 7.50, delta=0.005)  # the source: 7.50 +- 0.88
        self.assertAlmostEqual(measured.error, 0.88, delta=0.005)
        joint = numbers.joint_interval(measured, Number(0, 0))
        self.assertAlmostEqual(joint, measured.error * math.sqrt(7 + 1), delta=1e-9)
        with self.assertRaises(FormatError):
            of_repeats([1.0, 2.0])

    def test_seeds_draw_inputs_and_their_mean_has_the_interval_of_one_more(self):
        run = entries.Run("a", ("dem",), ["bed.seed={seed}", 'inlet = {u = "{u} m/s"}'], {}, 400, {"u": (2, 0.1)})
        self.assertEqual(run.overrides(7), run.overrides(7))
        drawn = np.array([float(run.overrides(seed)[1].split('"')[1].split()[0]) for seed in range(1, 401)])
        self.assertAlmostEqual(drawn.mean(), 2, delta=0.02)  # four standard errors of 0.1/20
        self.assertAlmostEqual(drawn.std(), 0.1, delta=0.015)  # and of 0.1/sqrt(800)
        with mock.patch.object(numbers, "run_number", lambda entry, compare, value: Number(value)):
            found = numbers.of_seeds(None, {}, [1.0, 2.0, 3.0, 4.0])  # s = 1.2910, Student's 3.1824, sqrt(1 + 1/4)
            self.assertEqual((found.value, found.repeats), (2.5, 4))
            self.assertAlmostEqual(found.error, 4.5934, delta=1e-3)
            with self.assertRaisesRegex(Undecided, "needs four runs, and there are 2") as raised:
                numbers.of_seeds(None, {}, [1.0, 2.0])
        self.assertEqual(raised.exception.number.value, 1.5)
        measured = Number(2.0, 1.0, 9)  # one run is one more repeat, four with an interval of their own are not
        self.assertEqual([numbers.joint_interval(measured, Number(2.5, 0, runs)) for runs in (1, 4)], [math.sqrt(10), 1.0])

    def test_spheres_arrive_in_the_order_in_which_their_tops_pass_the_surface(self):
        of = np.array([False, True, True])
        tops = [(0.01, 0.02), (0.06, 0.03), (0.02, 0.055), (0.02, 0.03)]  # the second emerges last, and both sink again
        steps = [SimpleNamespace(position=np.array([(0, 0, 0), (0, a - 0.005, 0), (0, b - 0.005, 0)]), radius=np.full(3, 0.005), of=lambda _: of)
                 for a, b in tops]
        stored = type("Stored", (list,), {"time": np.arange(4.0)})(steps)
        run = SimpleNamespace(particles=stored, history={"time_s": np.array([0.0, 3.0]), "bed_height_m": np.full(2, 0.05)})
        found = entries.script_of(entries.entry_named("vssuq")).simulated(run, 1.0)
        self.assertEqual([numbers.first_time(time, above >= 0, 0.0).value for time, above in (found["first"], found["second"])], [1.0, 2.0])

    def test_verdicts(self):
        self.assertEqual(verdict(Number(1, 0.3), Number(1.5, 0.4)), ("inside", 0.5, ""))
        self.assertEqual(verdict(Number(1, 0.3), Number(1.51, 0.4))[0], "outside")
        self.assertEqual(verdict(Number(1, 0.3), Number(1))[0], "undecided")
        self.assertEqual(verdict(Number(1), Number(1, 0.1))[2], "no interval of the measurement")

    def test_a_bed_that_drifts_has_no_verdict(self):
        rows = {"time_s": np.linspace(0, 1, 201), "bed_height_m": np.full(201, 0.09)}
        mean = {"how": "mean", "column": "bed_voidage"}
        found = given(mean, a_run({"steady": True}, **rows))
        self.assertAlmostEqual(found.value, 0.6, delta=1e-12)
        tapered = a_run({"steady": True}, **rows)
        tapered.record["case"] += "column = {profile = [[0, 0.1], [1, 0.2]]}\n"
        with self.assertRaisesRegex(FormatError, "bed_voidage is that of a straight column"):
            given(mean, tapered)
        with self.assertRaisesRegex(Undecided, "drift of bed_height") as raised:
            given(mean, a_run({"steady": False}, {"lines": ["drift of bed_height"]}, **rows))
        self.assertAlmostEqual(raised.exception.number.value, 0.6, delta=1e-12)  # shown, and not judged
        with self.assertRaisesRegex(Undecided, "too few rows"):
            given(mean, a_run({"steady": None}, **rows))

    def test_a_deviation_has_an_interval(self):
        found = numbers.of_series("deviation", np.sin(np.linspace(0, 40 * math.pi, 4001)))
        self.assertAlmostEqual(found.value, math.sqrt(0.5), delta=1e-3)
        self.assertLess(found.error, 0.01)

    def test_first_time_counts_from_when_the_gas_is_on(self):
        compare = {"how": "first_time", "column": "centre_a_m", "plus": 0.005, "reaches": "bed_height_m", "since": 1.0}
        time = np.arange(11) * 0.5
        run = a_run(time_s=time, centre_a_m=0.02 * time, bed_height_m=np.full(11, 0.06))
        self.assertEqual(given(compare, run)[:2], (2.0, 0.5))  # 0.055 m at 2.75 s: the row of 3 s, 2 s after the gas
        with self.assertRaisesRegex(Undecided, "not reached within 4 s"):
            given(compare | {"reaches": "top"}, a_run(time_s=time, centre_a_m=0 * time, top=np.full(11, 1.0)))

    def test_the_packed_line_meets_the_weight(self):
        time = np.linspace(0, 10, 101)
        carried = np.minimum(0.01 * time / 0.05, 1)
        run = a_run(time_s=time, pressure_drop_Pa=500 * carried, buoyant_weight_Pa=np.full(101, 500.0))
        found = given({"how": "meets_weight"}, run)
        self.assertAlmostEqual(found.value, 0.05, delta=1e-12)
        self.assertAlmostEqual(found.error, 0, delta=1e-12)
        with self.assertRaises(Undecided):
            given({"how": "meets_weight"}, a_run(time_s=time[:1], pressure_drop_Pa=[0.0], buoyant_weight_Pa=[1.0]))

    def test_bubbles_of_a_plane(self):
        bubbles = entries.script_of(entries.entry_named("verma"))
        field = np.full((6, 10, 6), 0.5)
        field[1:3, 3:6, 1:3] = 0.95  # four cells across
        field[5, :, 5] = 0.95  # one cell: left out
        y = np.arange(10) * 1e-2 + 5e-3
        at = bubbles.plane(field, y, 0.045)
        np.testing.assert_allclose(bubbles.diameters(at, 1e-4), [math.sqrt(16e-4 / math.pi)])
        run = SimpleNamespace(time=np.array([0.0, 1.0]), voidage=[field, field], faces={"x": np.arange(7) * 1e-2,
                              "y": np.arange(11) * 1e-2, "z": np.arange(7) * 1e-2})
        times, values = bubbles.simulated(run, 0.5)["0.05"]
        self.assertEqual((list(times), len(values)), ([1.0], 1))
        self.assertEqual(set(bubbles.simulated(run, 0.5)), {compare["series"] for compare in entries.entry_named("verma").compares})


class Records(unittest.TestCase):
    ROW = {"entry": "a", "run": "r", "model": "tfm", "quantity": "height", "unit": "m", "measured": [0.1, 0.01], "result": [0.105, 1e-19],
           "joint": 0.01, "verdict": "inside", "reason": "", "cpu_s": 2.0}

    def block(self, **changed):
        return {"entry": "a", "model": "tfm", "date": "2026-01-02", "git_commit": "0123456789abcdef", "command": "polybed validate a",
                "cpu_s": 2.0, "rows": [self.ROW | changed]}

    def test_results_are_kept_apart_and_renewed(self):
        with tempfile.TemporaryDirectory() as folder:
            document = Path(folder) / "page.md"
            document.write_text(f"before\n{report.BEGIN}\nold\n{report.END}\nafter\n")
            report.write_recorded(Path(folder), document, [self.block()])
            report.write_recorded(Path(folder), document, [self.block(verdict="outside"), self.block() | {"entry": "b"}])
            blocks = report.read_recorded(Path(folder))
            self.assertEqual([(block["entry"], block["rows"][0]["verdict"]) for block in blocks], [("a", "outside"), ("b", "inside")])
            some = [self.block() | {"entry": "b", "runs": [name]} for name in ("one", "two", "one")]
            self.assertEqual([block.get("runs") for block in report.merged(blocks[:1], some)], [None, ["one"], ["two"]])
            self.assertEqual(report.merged(some, blocks), blocks)
            text = document.read_text()
        self.assertTrue(text.startswith("before\n") and text.endswith("\nafter\n"))
        self.assertNotIn("old", text)
        self.assertIn("| a | r | tfm | height, m | 0.1 ± 0.01 | 0.105 ± 0 | outside |", text)
        self.assertIn("- `polybed validate a`, 2026-01-02, commit 012345678, ", text)
        with self.assertRaisesRegex(FormatError, "lacks the marks"):
            report.with_section("no marks", [])

    def test_the_page_of_the_record_shows_what_is_recorded(self):
        text = read_text(ROOT / "docs/record/validation.md")
        self.assertEqual(report.with_section(text, report.read_recorded(entries.folder())), text)

    def test_measured_numbers_have_not_moved_since_they_were_recorded(self):
        for block in report.read_recorded(entries.folder()):
            entry = entries.entry_named(block["entry"])
            runs, compares = ({of.name: of for of in entry.runs}, {compare["quantity"]: compare for compare in entry.compares})
            for row in block["rows"]:
                found = numbers.measured_number(entry, runs[row["run"]], compares[row["quantity"]])
                np.testing.assert_allclose(row["measured"], found[:2], rtol=1e-9, err_msg=f"{row['entry']} {row['quantity']}")

    def test_the_page_escapes_what_a_file_says(self):
        entry = SimpleNamespace(name="a", title="<b>", source="<i>", note="", missing="")
        self.assertNotIn("<i>", report.html_page([self.ROW | {"run": "<script>"}], [entry], "polybed validate", "0"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
