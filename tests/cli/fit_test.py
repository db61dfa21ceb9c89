#!/usr/bin/python3
"""polybed fit, the law file that it writes, and --closure-uncertainty of inversion and tfm. Usage: fit_test.py PROGRAM"""
import csv
import json
import os
import sys

import numpy as np

import program
from program import DONE, FILE, ROOT, SMALL, WRONG_CASE, Scratch, strict_json

sys.path.insert(0, str(ROOT / "python"))
from polybed.fit import errors, forms, rows  # noqa: E402
from polybed.fit.fitting import Problem  # noqa: E402
from polybed.study.closure_band import BANDS  # noqa: E402

DATA = ROOT / "tests/data/lbm"
ONE_SIZE = [DATA / f"tab_A_{table}.csv" for table in ("i", "ii", "iii")]
SYSTEM_B = ROOT / "cases/thesis-b/case.toml"
CASE = ROOT / "cases/matsuura-akehata/case.toml"


class Fitted(Scratch):
    def setUp(self):
        super().setUp()
        os.environ["POLYBED"] = program.PROGRAM

    def fit(self, *words, code=DONE, name="fit"):
        self.ends(code, "fit", *words, "-o", self.folder / name, "--quiet", "--no-picture", "--bootstrap", "4")
        return strict_json((self.folder / name / "fit.json").read_text())


class Fit(Fitted):
    def test_the_form_of_the_thesis_on_its_own_rows(self):
        found = self.fit(*ONE_SIZE, "--form", "cello")
        every = found["errors"]["all"]
        self.assertEqual(every["published"]["points"], 191)
        self.assertAlmostEqual(every["published"]["mean"], 2.57, delta=0.005)  # docs/record/accuracy.md
        self.assertLessEqual(every["fitted"]["mean"], 2.57)
        self.assertLess(every["fitted"]["rms"], every["published"]["rms"])
        self.assertGreater(every["voidage_left_out"]["mean"], every["fitted"]["mean"])
        self.assertLess(found["constraints"]["greatest_violation"], 0.01)
        self.assertNotIn("crossing", found["free"])  # of mixtures, which these rows have not
        self.assertEqual(found["constants"]["crossing"], found["published"]["crossing"])
        for name, (low, high) in found["interval"].items():
            self.assertLess(low, high, name)
        page = (self.folder / "fit/accuracy.md").read_text()
        self.assertIn(f"{every['fitted']['mean']:.2f} / {every['fitted']['rms']:.2f}", page)
        table = list(csv.DictReader((self.folder / "fit/errors.csv").read_text().splitlines()))
        mean = np.mean([abs(float(row["fitted"])) for row in table])
        self.assertAlmostEqual(100 * mean, every["fitted"]["mean"], delta=1e-3)  # six digits a row

    def test_constants_come_back_from_rows_of_the_law_itself(self):
        """Rows of brinkman_oseen with two constants changed: the fit finds them."""
        points = rows.read_points([DATA / f"tab_A_{table}.csv" for table in ("i", "ii", "iv", "v")])
        published = json.loads(self.ends(DONE, "list", "--json").stdout)["drag_forms"]["brinkman_oseen"]
        true = published | {"forchheimer": 0.06, "screening": 2.0}
        law = {"filetype": "polybed drag law", "version": 1, "form": "brinkman_oseen", "constants": true}
        (self.folder / "true.json").write_text(json.dumps(law))
        nets = errors.net_by_program(points, f"file:{self.folder / 'true.json'}")
        with open(self.folder / "rows.csv", "w", encoding="utf-8") as file:
            file.write("eps,Re,x1,D1,x2,D2,n_1,n_1_se,n_2,n_2_se\n")
            for p, net in zip(points, nets):
                cells = [p.voidage, p.reynolds]
                for j in range(2):
                    cells += [p.share[j], p.diameter[j]] if j < len(net) else ["", ""]
                for j in range(2):
                    cells += [repr(float(net[j])), 0.01 * net[j]] if j < len(net) else ["", ""]
                file.write(",".join(map(str, cells)) + "\n")
        found = self.fit(self.folder / "rows.csv", "--form", "brinkman_oseen")
        for name, value in true.items():
            self.assertAlmostEqual(found["constants"][name] / value, 1, delta=0.05, msg=name)  # what the weak prior leaves
        self.assertLess(found["errors"]["all"]["fitted"]["greatest"], 0.2)

    def test_rows_that_no_constant_changes_are_told(self):
        """Of one size at Re 0 brinkman_oseen is theory without a constant: n = 2 f0/eps is missed by half whatever is fitted."""
        (self.folder / "rows.csv").write_text("eps,Re,n\n0.5,0,40\n0.6,0,24\n0.7,0,14\n0.8,0,8\n0.6,20,14\n0.6,50,18\n0.7,20,9\n0.7,50,12\n")
        told = self.ends(DONE, "fit", self.folder / "rows.csv", "-o", self.folder / "fit", "--quiet", "--no-picture", "--bootstrap", "2").stderr
        self.assertIn("% in the mean: the form brinkman_oseen does not follow these rows", told)
        self.assertIn("4 of 8 forces at Re 0 are the same with any constants of brinkman_oseen", told)
        clean = self.ends(DONE, "fit", *ONE_SIZE, "-o", self.folder / "good", "--quiet", "--no-picture", "--bootstrap", "2").stderr
        self.assertNotIn("warning", clean)

    def test_the_range_of_the_rows_is_the_range_of_the_law(self):
        (self.folder / "rows.csv").write_text("eps,Re,n\n0.6,0,24\n0.7,0,14\n0.8,0,8\n0.6,2,25\n0.6,5,26\n0.7,2,14.5\n0.7,5,15\n0.8,5,9\n")
        self.ends(DONE, "fit", self.folder, "-o", self.folder / "fit", "--quiet", "--no-picture", "--bootstrap", "0")  # its rows.csv
        path = self.folder / "fit/law.json"
        content = strict_json(path.read_text())
        self.assertEqual(content["range"], {"voidage": [0.6, 0.8], "reynolds": [0, 5]})
        law = f"file:{path}"

        def point(re):
            return self.ends(DONE, "drag", "--law", law, "--voidage", "0.8", "--re", re).stderr
        self.assertIn("range: within the rows of the fit, voidage 0.6 to 0.8, Re 0 to 5\n", point("5"))
        self.assertIn("range: outside the rows of the fit, voidage 0.6 to 0.8, Re 0 to 5\n", point("500"))
        self.assertIn("outside the range of the law, voidage 0.6 to 0.8, Re 0 to 5: voidage ", self.ends(DONE, "inversion", SYSTEM_B, "--law", law).stdout)
        self.assertIs(strict_json(self.ends(DONE, "inversion", SYSTEM_B, "--law", law, "--json").stdout)["outside_range"], True)
        words = ["tfm", CASE, *SMALL, "--until", "0.01 s", "--set", f'effects.drag="{law}"', "-o", self.folder / "run"]
        self.assertRegex(self.ends(DONE, *words).stderr, r"warning: effects.drag = .* was fitted to voidage 0.6 to 0.8, Re 0 to 5, and the case has ")
        [used] = [use for use in strict_json((self.folder / "run/run.json").read_text())["guards"] if use["closure"].startswith("drag ")]
        self.assertGreater(used["outside_range"], 0)
        del content["range"]  # as in older files
        path.write_text(json.dumps(content))
        self.assertIn("range: unknown", point("5"))
        self.assertIn("range unknown", self.ends(DONE, "check", CASE, "--set", f'effects.drag="{law}"').stdout)
        self.assertIn("range unknown", self.ends(DONE, "inversion", SYSTEM_B, "--law", law).stdout)
        self.assertIsNone(strict_json(self.ends(DONE, "inversion", SYSTEM_B, "--law", law, "--json").stdout)["outside_range"])
        self.assertIs(strict_json(self.ends(DONE, "inversion", SYSTEM_B, "--json").stdout)["outside_range"], False)

    def test_the_package_and_the_program_have_one_formula(self):
        points = rows.read_points([DATA])
        for form, published in json.loads(self.ends(DONE, "list", "--json").stdout)["drag_forms"].items():
            inside = [p for p in points if form != "cello" or p.reynolds <= forms.cello_most_reynolds(published, p.voidage)]
            by_form = forms.net(form, published, forms.Sizes.of(inside))
            by_program = np.concatenate(errors.net_by_program(inside, form))
            self.assertLess(np.abs(by_form / by_program - 1).max(), 1e-12, form)  # roundings of some forty operations

    def test_a_row_left_out_is_as_a_fit_without_it(self):
        points = rows.read_points([DATA / "tab_A_v.csv"])
        published = json.loads(self.ends(DONE, "list", "--json").stdout)["drag_forms"]["brinkman_oseen"]
        problem = Problem("brinkman_oseen", published, points)
        best = problem.fit()
        by_influence = problem.left_out_by_row(best)
        for g in (0, len(points) // 2):
            counts = np.ones(len(points))
            counts[g] = 0
            of = problem.sizes.group == g
            refitted = problem.relative(problem.constants(problem.fit(best, counts)))[of]
            whole = problem.relative(problem.constants(best))[of]
            # To first order: a tenth of the change, and what the fit stops at.
            np.testing.assert_allclose(by_influence[of] - whole, refitted - whole, atol=2e-4 + 0.1 * np.abs(refitted - whole).max())

    def test_tables_of_mixtures(self):
        self.assertEqual({len(p.net) for p in rows.read_points([DATA / "tab_B_iii.csv"])}, {4})
        self.assertEqual({len(p.net) for p in rows.read_points([DATA / "tab_B_i.csv"])}, {10})
        self.assertEqual(len(rows.read_points([DATA / "tab_A_iv.csv"])), 119 - 2)  # two rows are printed twice

    def test_refusals(self):
        bad = self.folder / "bad.csv"
        for text, what in (("eps,Re,n\n0.5,1,2\n0.5,one,2\n", "bad.csv:3: Re (cell 2) = 'one' is no number"),
                           ("eps,Re,n\n1.5,1,2\n", "bad.csv:2: eps = 1.5"), ("a,b\n1,2\n", "bad.csv:1: unknown columns"),
                           ("eps,Re,x1,D1,u_1,u_1_se\n0.5,1,1,1,2,1\n", "bad.csv:1: rows of free spheres have a slip u_j"),
                           ("eps,Re,n\n0.5,1\n", "bad.csv:2: 2 cells"), ("# nothing\n", "no header"),
                           ("eps,Re,n\n0.5,1,-3\n", "not above 0"), ("eps,Re,n\n0.5,1,3\n", "cannot determine")):
            bad.write_text(text)
            self.assertIn(what, self.ends(WRONG_CASE, "fit", bad, "-o", self.folder / "out", "--quiet").stderr)
            if "u_1" in text:
                self.assertIn("rows of free spheres", self.ends(WRONG_CASE, "drag", "--csv", bad).stderr)
        self.ends(FILE, "fit", self.folder / "none.csv", "-o", self.folder / "out")
        self.fit(DATA / "tab_A_v.csv")
        again = self.ends(WRONG_CASE, "fit", DATA / "tab_A_v.csv", "-o", self.folder / "fit", "--quiet")
        self.assertIn("--force", again.stderr)
        self.ends(WRONG_CASE, "fit", DATA / "tab_A_v.csv", "--form", "ergun")


class LawFile(Fitted):
    def law(self, **members):
        path = self.folder / "law.json"
        path.write_text(json.dumps({"filetype": "polybed drag law", "version": 1} | members))
        return path

    def test_a_run_records_it(self):
        path = self.law(law="cello", common=1.1)
        words = ["tfm", CASE, *SMALL, "--until", "0.02 s", "--quiet", "--set", f'effects.drag="file:{path}"', "-o", self.folder / "run"]
        self.ends(DONE, *words)
        record = strict_json((self.folder / "run/run.json").read_text())["drag_law"]
        self.assertEqual((record["law"], record["common"], record["tilt"]), ("cello", 1.1, 0))
        self.assertEqual(len(record["hash"]), 16)
        before = strict_json((self.folder / "run/run.json").read_text())["case_hash"]
        self.law(law="cello", common=1.2)  # the case still names the same file
        self.assertIn("case", self.ends(WRONG_CASE, *words, "--resume").stderr)
        self.ends(DONE, *words, "--force")
        self.assertNotEqual(strict_json((self.folder / "run/run.json").read_text())["case_hash"], before)
        self.law(law="cello", common=20)
        self.assertIn("law.json:1:", self.ends(WRONG_CASE, *words, "--force").stderr)
        path.unlink()
        self.ends(FILE, *words, "--force")

    def test_a_case_finds_it_in_its_own_folder(self):
        """Also from elsewhere, and before one of that name where the program runs."""
        (self.folder / "own").mkdir()
        path = self.law(law="cello", common=1.2).rename(self.folder / "own/law.json")
        self.law(law="cello", common=1.3)
        case = self.write("own/case.toml", CASE.read_text().replace('"cello"', '"file:law.json"', 1))
        by_path = self.ends(DONE, "check", case, "--json", "--set", f'effects.drag="file:{path}"').stdout
        beside, elsewhere = (self.ends(DONE, "check", case, "--json", *words, cwd=self.folder).stdout
                             for words in ([], ["--set", 'effects.drag="file:law.json"']))
        u_mf = [strict_json(text)["expected"]["u_mf_m_s"]["mixture"] for text in (by_path, beside, elsewhere)]
        self.assertEqual(u_mf[0], u_mf[1])
        self.assertLess(u_mf[2], u_mf[1], "of the command line: where the program runs")

    def test_a_law_leaves_the_partition_of_the_case_and_says_so(self):
        shared = ["--set", "effects.drag=wen_yu", "--set", "effects.partition=brinkman_oseen", "--law", "ergun"]
        self.assertIn('partition = "brinkman_oseen" of the case', self.ends(DONE, "inversion", SYSTEM_B, *shared).stderr)
        self.assertEqual(self.ends(DONE, "inversion", SYSTEM_B, *shared, "--partition", "none").stderr, "")

    def test_it_acts_as_the_law_that_it_names(self):
        path = self.law(law="cello")
        plain = self.ends(DONE, "inversion", SYSTEM_B, "--json").stdout
        moved = self.ends(DONE, "inversion", SYSTEM_B, "--law", f"file:{path}", "--json").stdout
        self.assertEqual(strict_json(plain)["roots"], strict_json(moved)["roots"])


class ClosureUncertainty(Fitted):
    def test_of_the_inversion_point(self):
        plain = strict_json(self.ends(DONE, "inversion", SYSTEM_B, "--json").stdout)
        out = self.folder / "band"
        found = strict_json(self.ends(DONE, "inversion", SYSTEM_B, "--closure-uncertainty", "--json", "-o", out).stdout)
        self.assertEqual(found["roots"], plain["roots"])
        low, high = found["closure_band_m_s"]
        self.assertLess(low, plain["velocity_m_s"])
        self.assertLess(plain["velocity_m_s"], high)
        record = strict_json((out / "closure_uncertainty.json").read_text())
        self.assertEqual(record, found["closure_uncertainty"])
        self.assertTrue((out / "closure_uncertainty.png").read_bytes().startswith(b"\x89PNG"))
        band = json.loads(BANDS.read_text())["bands"]["cello"]["none"]
        self.assertEqual(record["band"]["common"], band["common"])
        voidage = record["voidage"]["by"]
        # The common factor cancels in the ratio of the net forces, which alone decides the voidage.
        self.assertAlmostEqual(voidage["common"]["minus"], voidage["common"]["plus"], delta=2e-3)
        self.assertGreater(abs(voidage["ratio"]["plus"] - voidage["ratio"]["minus"]), 0.05)
        # More drag: less velocity carries the bed.
        self.assertLess(record["velocity_m_s"]["by"]["common"]["plus"], record["velocity_m_s"]["by"]["common"]["minus"])
        check = record["velocity_m_s"]["all_plus"]
        self.assertAlmostEqual(check["linear"], check["found"], delta=0.15 * check["found"])  # bands of 8 and 5 %: curvature
        self.assertIn("within its band", self.ends(DONE, "inversion", SYSTEM_B, "--closure-uncertainty").stdout)

    def test_a_ratio_is_moved_by_its_band(self):
        found = strict_json(self.ends(DONE, "inversion", SYSTEM_B, "--closure-uncertainty", "--json").stdout)
        record = found["closure_uncertainty"]
        path = self.folder / "moved.json"
        path.write_text(json.dumps({"filetype": "polybed drag law", "version": 1, "law": "cello",
                                    "tilt": record["moved_to"]["ratio"]["tilt"]}))
        points = self.folder / "point.csv"
        # System B at its root: diameters and shares of the case, Re of water at its temperature does not matter to 1e-3.
        points.write_text(f"eps,Re,x1,D1,x2,D2\n{found['voidage']},45,0.569,0.807,0.431,2.01\n")
        ratios = []
        for law in ("cello", f"file:{path}"):
            row = strict_json(self.ends(DONE, "drag", "--law", law, "--csv", points, "--json").stdout)["rows"][0]
            ratios.append(row["n_1"] / row["n_2"])
        self.assertAlmostEqual(ratios[1] / ratios[0] - 1, record["band"]["ratio"], delta=0.2 * record["band"]["ratio"])

    def test_of_a_run(self):
        out = self.folder / "run"
        self.ends(DONE, "tfm", CASE, *SMALL, "--until", "0.3 s", "--quiet", "--closure-uncertainty", "-o", out)
        record = strict_json((out / "closure_uncertainty.json").read_text())
        height = record["bed_height_m"]
        self.assertLess(height["low"], height["value"])
        self.assertGreater(height["high"], height["value"])
        by = height["by"]
        down = sum((height["value"] - min(height["value"], *pair.values())) ** 2 for pair in by.values()) ** 0.5
        self.assertAlmostEqual(height["low"], height["value"] - down, delta=1e-15)
        for name in ("common-minus", "ratio-plus", "all-plus"):
            law = strict_json((out / name / "run.json").read_text())["drag_law"]
            self.assertEqual(law["law"], "cello")
        self.assertAlmostEqual(strict_json((out / "common-plus/run.json").read_text())["drag_law"]["common"],
                               1 + record["band"]["common"], delta=1e-12)

    def test_refusals(self):
        both = self.ends(WRONG_CASE, "tfm", CASE, "--closure-uncertainty", "--stress-uncertainty", "-o", self.folder / "run")
        self.assertIn("one of them at a time", both.stderr)
        for words, what in ((["--law", "stokes"], "take a law within"), (["--scan", "tfm"], "leave out --scan"),
                            (["--stress-uncertainty"], "one of them at a time"),
                            (["--method", "all"], "one method")):
            self.assertIn(what, self.ends(WRONG_CASE, "inversion", SYSTEM_B, *words, "--closure-uncertainty").stderr)
        path = self.folder / "law.json"
        form, constants = next(iter(json.loads(self.ends(DONE, "list", "--json").stdout)["drag_forms"].items()))
        path.write_text(json.dumps({"filetype": "polybed drag law", "version": 1, "form": form, "constants": constants}))
        self.assertIn("has no band", self.ends(FILE, "inversion", SYSTEM_B, "--law", f"file:{path}", "--closure-uncertainty").stderr)

    def test_bands_are_those_of_the_rows(self):
        bands = json.loads(BANDS.read_text())["bands"]
        points = rows.read_points([DATA, DATA / "tab_B_iii.csv"])
        for law, partition in (("cello", "none"), ("brinkman_oseen", "none"), ("wen_yu", "brinkman_oseen"), ("vbk", "vbk_theory")):
            found = errors.band_of(points, errors.net_by_program(points, law, partition))
            for name, value in found.items():
                self.assertAlmostEqual(bands[law][partition][name], value, delta=1e-5, msg=f"{law} {name}")
        listed = json.loads(self.ends(DONE, "list", "--json").stdout)["roles"]
        laws = {law["law"] for role in listed if role["role"] == "drag" for law in role["laws"]} - {"file:FILE"}
        self.assertEqual(set(bands), laws)


if __name__ == "__main__":
    program.main()
