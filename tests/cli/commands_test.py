#!/usr/bin/python3
"""The commands that answer without a run, and the codes they end with. Usage: commands_test.py PROGRAM"""
import csv
import io
import math
import re
import resource

import program
from program import CASE, DONE, FILE, WRONG_CASE, Scratch, run, run_all, strict_json


class Codes(Scratch):
    def test_help_and_version_are_done(self):
        for done in run_all([["--help"], ["--version"], ["tfm", "--help"]]):
            self.assertEqual(done.returncode, DONE)
            self.assertIn("polybed", done.stdout)

    def test_wrong_commands_and_options(self):
        wrong = [[], ["tmf", CASE], ["tfm"], ["check"], ["check", CASE, "--jsn"], ["drag", "--voidage", "half"], ["drag"],
                 ["drag", "--guard", "maybe", "--voidage", "1", "--re", "1"], ["explain"], ["explain", "tfm.rtoll"],
                 ["inversion", CASE, "--method", "guess"], ["check", CASE, "--set", "no sign"]]
        for words, done in zip(wrong, run_all(wrong)):
            self.assertEqual(done.returncode, WRONG_CASE, words)
            self.assertTrue(done.stderr.strip(), f"{words} says nothing")
            self.assertEqual(done.stdout, "", words)

    def test_what_cannot_be_read(self):
        missing = self.folder / "no.toml"
        for words in (["check", missing], ["check", self.folder], ["tfm", missing], ["drag", "--csv", missing],
                      ["drag", "--csv", self.folder], ["plot", self.folder]):
            done = self.ends(FILE, *words)
            self.assertIn(str(words[-1]), done.stderr)

    def test_a_full_standard_output_is_told(self):
        for words in (["list"], ["check", CASE, "--json"], ["schema", "--markdown"]):
            with open("/dev/full", "w") as full:
                done = self.ends(FILE, *words, stdout=full)
            self.assertIn("No space left", done.stderr)

    def test_a_case_beyond_the_memory_is_a_wrong_case(self):
        done = self.ends(WRONG_CASE, "check", CASE, "--set", "column.cells=[100000,100000]")
        self.assertIn("at most 2147483647 can be numbered", done.stderr)
        particles = ["--set", "bed.start=random"]  # which no continuum starts from
        for words in (["check"], ["tfm"], ["dem"], ["check", *particles], ["dem", *particles]):
            # 1e9 cells of 1 to 2 kB: more than the machines that run this have
            done = self.ends(WRONG_CASE, words[0], CASE, *words[1:], "--set", "column.cells=[10000,100000]")
            self.assertRegex(done.stderr, r"column.cells = \[10000, 100000\]: the run would need about [\d.e+]+ GB of memory; "
                                          r".* leaves [\d.]+ GB")
        self.assertFalse((self.folder / "runs").exists())

    def test_a_case_beyond_a_limit_on_the_memory_is_a_wrong_case(self):
        if "sanitizers" in run("--version").stdout:
            self.skipTest("the address sanitizer reserves terabytes of addresses: it cannot run under a limit on them")
        limit = 600 * 2**20  # bytes; the shipped case gets by with a third of it
        narrow = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))}
        self.ends(DONE, "check", CASE, **narrow)
        for command in ("check", "tfm", "dem"):  # 16e6 cells of 1 to 2 kB
            done = self.ends(WRONG_CASE, command, CASE, "--set", "column.cells=[4000,4000]", **narrow)
            self.assertRegex(done.stderr, r"about [\d.]+ GB of memory; the limit of this process \(ulimit -v\) leaves 0\.\d+ GB")


class WrongCase(Scratch):
    def test_all_problems_at_once_with_their_places(self):
        text = CASE.read_text()
        for old, new in (("diameter = \"0.807 mm\"", "diametr = \"0.807 mm\""), ('sides = "wall"', 'sides = "wal"'),
                         ('drag             = "cello"', 'drag = "celo"'), ("rtol       = 1e-3", "rtol = 7"),
                         ('static_height   = "66 mm"', 'static_height = "66 s"'), ("[18, 198]", "[18.5, 198]")):
            self.assertEqual(text.count(old), 1, old)
            text = text.replace(old, new)
        path = self.write("wrong.toml", text)
        done = self.ends(WRONG_CASE, "check", path)
        self.assertEqual(done.stdout, "")
        for key, message in (("diametr =", "unknown key 'diametr' in [[species]]; did you mean 'diameter'?"),
                             ('"wal"', 'allowed are wall | periodic; did you mean "wall"?'),
                             ('"celo"', 'did you mean "cello"?'), ("7", "tfm.rtol = 7 is out of range: at least 1e-12, at most 0.1"),
                             ('"66 s"', "expected a value in m, this one is in s"), ("18.5", "expected a whole number")):
            line = 1 + next(n for n, row in enumerate(text.split("\n")) if key in row and "title" not in row and
                            (key != "7" or row.startswith("rtol")))
            column = 1 + text.split("\n")[line - 1].index(key)
            told = [row for row in done.stderr.split("\n") if row.startswith(f"{path}:{line}:{column}: ")]
            self.assertEqual(len(told), 1, f"{key} at {line}:{column} in\n{done.stderr}")
            self.assertIn(message, told[0])

    def test_a_law_of_another_program_a_bare_key_and_a_decimal_comma_get_a_hint(self):
        for setting, hint in (("effects.drag=syamlal_obrien", "in a gas bed gidaspow is nearest"),
                              ("drag=cello", "did you mean 'effects.drag'?"), ("until=1", "did you mean 'run.until'?"),
                              ("species.fine.diameter=0,8 mm", 'did you mean "0.8 mm"?')):
            self.assertIn(hint, self.ends(WRONG_CASE, "check", CASE, "--set", setting).stderr)

    def test_a_missing_key_and_a_wrong_override_are_told_together(self):
        path = self.write("short.toml", CASE.read_text().replace('until = "20 s"', ""))
        done = self.ends(WRONG_CASE, "check", path, "--set", "tfm.rtol=2", "--set", "species.big.diameter=1")
        for part in ("run.until is missing", "--set tfm.rtol: tfm.rtol = 2 is out of range", "no 'big' in [[species]]"):
            self.assertIn(part, done.stderr)

    def test_names_that_would_break_files(self):
        names = ["a/b", "a,b", "", "fluid", "wall", "coarse", "a\\\"b", "a\\nb", "<a>"]
        for name, done in zip(names, run_all(["check", CASE, "--set", f'species.fine.name="{n}"'] for n in names)):
            self.assertEqual(done.returncode, WRONG_CASE, name)
            self.assertIn("species.name", done.stderr)


class Check(Scratch):
    def test_overrides_are_in_the_resolved_case(self):
        text = strict_json(self.ends(DONE, "check", CASE, "--json", "--set", "inlet.superficial_velocity=37 mm/s", "--set",
                                     "species.fine.diameter=1 mm", "--set", "tfm.rtol=2e-4").stdout)["case"]
        self.assertIn("superficial_velocity = [[0.0, 0.037]]", text)
        self.assertIn("rtol = 0.0002\n", text)
        diameters = [float(d) for d in re.findall(r"diameter = (\S+)", text)]
        self.assertAlmostEqual(diameters[0], 1e-3, delta=1e-18)  # the unit's factor is rounded once
        self.assertAlmostEqual(diameters[1], 2.01e-3, delta=1e-18)

    def test_the_resolved_case_is_a_case_and_resolves_to_itself(self):
        first = strict_json(run("check", CASE, "--json").stdout)
        second = strict_json(self.ends(DONE, "check", self.write("again.toml", first["case"]), "--json").stdout)
        self.assertEqual(second["case"], first["case"])
        self.assertEqual(second["hash"], first["hash"])
        self.assertGreater(first["unknowns"], 18 * 198 * 6)  # a fraction and two velocities per species in every cell

    def test_the_fluid_is_water(self):
        answer = strict_json(run("check", CASE, "--json").stdout)
        # water at 15 degC: 999.10 kg/m3 and 1.138 mPa s in the tables of IAPWS; 1 % allows for the fit in use
        self.assertAlmostEqual(answer["fluid_density_kg_m3"], 999.10, delta=10)
        self.assertAlmostEqual(answer["fluid_viscosity_Pa_s"], 1.138e-3, delta=1.2e-5)


class Keys(Scratch):
    def test_schema_explain_and_list_agree(self):
        schema, explain, listed = (strict_json(d.stdout) for d in run_all(
            [["schema", "--json"], ["explain", "tfm.rtol", "--json"], ["list", "--json"]]))
        keys = {k["key"]: k for k in schema["keys"]}
        self.assertEqual(keys["tfm.rtol"], explain)
        for key in ("key", "kind", "unit", "range", "required", "default", "help"):
            self.assertIn(key, explain)
        roles = {r["role"]: [law["law"] for law in r["laws"]] for r in listed["roles"]}
        self.assertIn("cello", roles["drag"])
        markdown, plain, words, effects = (d.stdout for d in run_all(
            [["schema", "--markdown"], ["schema"], ["explain", "species.diameter"], ["list"]]))
        for key in keys:
            self.assertIn(key, plain)
            self.assertIn(f"- `{key.split('.')[-1]}` (", markdown)
        for role, laws in roles.items():
            self.assertTrue(all(name in effects and f"`{name}`" in markdown for name in [role, *laws]))
        self.assertIn("range: at least 1e-08, at most 1 m", words)

    def test_every_law_of_the_contract_is_there(self):
        laws = """stokes turton_levenspiel schiller_naumann dallavalle carman_kozeny ergun fand wen_yu di_felice batchelor
            richardson_zaki gidaspow hkl vbk vbk_theory vbk_corrected cello yin_sundaresan patwardhan_tien syamlal""".split()
        for law, done in zip(laws, run_all(["drag", "--law", law, "--voidage", "0.5", "--re", "10", "--json"] for law in laws)):
            self.assertEqual(done.returncode, DONE, law)
            answer = strict_json(done.stdout)
            self.assertEqual(answer["law"], law)
            self.assertGreater(answer["f"], 0.9, "the drag of a bed is not below that of a lone sphere")


class Drag(Scratch):
    def table(self, text, *words):
        done = self.ends(DONE, "drag", "--csv", self.write("points.csv", text), *words)
        return list(csv.DictReader(io.StringIO(done.stdout)))

    def test_a_law_answers_within_the_range_of_its_source(self):
        """Stokes has one sphere, Batchelor a dilute suspension, both creeping flow; the band of a packed bed starts with neither."""
        for law, voidage, re_, inside in (("stokes", 1, 0, True), ("stokes", 0.4, 0, False), ("stokes", 1, 0.2, False),
                                          ("batchelor", 0.97, 0, True), ("batchelor", 0.97, 1e5, False), ("batchelor", 0.4, 0, False)):
            told = self.ends(DONE, "drag", "--law", law, "--voidage", str(voidage), "--re", str(re_)).stderr
            self.assertEqual("range: within" in told, inside, (law, voidage, re_))
        self.assertNotIn("stokes", self.ends(DONE, "drag", "--law", "ergun", "--voidage", "0.4", "--re", "0").stderr)

    def test_a_point_and_a_row_agree(self):
        point = float(self.ends(DONE, "drag", "--law", "ergun", "--voidage", "0.5", "--re", "20").stdout)
        # Ergun in this form by hand: 150 (1 - eps)/(18 eps^2) + 1.75 Re/(18 eps^2) = 16.6667 + 7.7778
        self.assertAlmostEqual(point, 16.666666666666668 + 35 / 4.5, delta=1e-12 * point)
        row, = self.table("eps,Re\n0.5,20\n", "--law", "ergun")
        self.assertEqual((float(row["f"]), float(row["n"])), (point, point / 0.5))

    def test_mixtures_have_a_column_per_species_and_keep_the_sum_rule(self):
        row, = self.table("eps,Re,x1,D1,x2,D2,x3,D3\n0.6,30,0.5,1e-3,0.3,2e-3,0.2,3e-3\n")
        names = ["f_mean", "n_mean"] + [f"{q}_{j}" for j in (1, 2, 3) for q in ("f", "n", "alpha", "Omega")]
        self.assertEqual(list(row)[8:], names)
        values = {name: float(value) for name, value in row.items()}
        self.assertTrue(all(map(math.isfinite, values.values())))
        x, d = ([values[f"{q}{j}"] for j in (1, 2, 3)] for q in "xD")
        mean = 1 / sum(a / b for a, b in zip(x, d))
        total = sum(x[j] * values[f"f_{j + 1}"] * (mean / d[j]) ** 2 for j in range(3))
        # T(3.45): the drag of the species adds up to that of the bed; the rest is rounding
        self.assertAlmostEqual(total, values["f_mean"], delta=1e-12 * values["f_mean"])

    def test_a_partition_adds_the_deviation_from_its_mean_law(self):
        text = "eps,Re,x1,D1,x2,D2\n0.6,30,0.5,1e-3,0.5,2e-3\n"
        mean = float(self.ends(DONE, "drag", "--law", "wen_yu", "--voidage", "0.6", "--re", "30").stdout)
        for partition, keeps in (("cello", True), ("vbk_theory", True), ("brinkman_oseen", False)):
            row, = self.table(text, "--law", "wen_yu", "--partition", partition)
            values = {name: float(value) for name, value in row.items()}
            total = sum(0.5 * values[f"f_{j}"] * (4e-3 / 3 / d) ** 2 for j, d in ((1, 1e-3), (2, 2e-3)))
            self.assertAlmostEqual(values["deviation"], total / mean - 1, delta=1e-12)
            self.assertEqual(abs(values["deviation"]) < 1e-12, keeps, partition)
        for words in (["--law", "yin_sundaresan", "--partition", "cello"], ["--law", "wen_yu", "--partition", "syamlal"]):
            self.assertIn("see polybed list", self.ends(WRONG_CASE, "drag", *words, "--voidage", "0.6", "--re", "30").stderr)

    def test_a_table_as_json_has_the_numbers_of_the_csv(self):
        for text in ("eps,Re\n0.5,20\n0.6,3\n", "eps,Re,x1,D1,x2,D2\n0.6,30,0.5,1e-3,0.5,2e-3\n"):
            rows = [{name: float(value) for name, value in row.items()} for row in self.table(text, "--law", "vbk")]
            path = self.write("points.csv", text)
            answer = strict_json(self.ends(DONE, "drag", "--law", "vbk", "--csv", path, "--json").stdout)
            self.assertEqual(answer, {"law": "vbk", "rows": rows})

    def test_a_bad_row_is_told_with_its_line(self):
        bad = {"0.5,x": "'x' is no number", "0.5": "1 cells, the header has 2", "1.5,1": "voidage 1.5 is outside",
               "nan,1": "is no number", "0.5,-1": "Reynolds number -1 is outside", "0.5,": "'' is no number",
               "0.5,1e308": "too large"}
        for n, (row, message) in enumerate(bad.items()):
            path = self.write(f"bad{n}.csv", f"eps,Re\n# a comment\n0.5,1\n{row}\n")
            self.assertIn(f"{path}:4: ", self.ends(WRONG_CASE, "drag", "--csv", path).stderr)
            self.assertIn(message, run("drag", "--csv", path).stderr)
            self.assertEqual(self.ends(WRONG_CASE, "drag", "--csv", path, "--json").stdout, "")
        path = self.write("refused.csv", "eps,Re,x1,D1\n0.5,3,1,1\n")
        self.assertIn(f"{path}:2: fand", self.ends(WRONG_CASE, "drag", "--law", "fand", "--guard", "off", "--csv", path).stderr)
        for text in ("", "\n\n", "a,b\n", "eps,Re,x1\n1,2,3\n"):
            self.ends(WRONG_CASE, "drag", "--csv", self.write("no.csv", text))

    def test_what_overflows_is_refused_and_never_printed(self):
        far = [["--voidage", v, "--re", r, *j] for v in ("1e-300", "0.5") for r in ("1e308", "1e300", "0") for j in ([], ["--json"])]
        for words, done in zip(far, run_all(["drag", *w] for w in far)):
            self.assertEqual(done.returncode, DONE if words[3] == "0" else WRONG_CASE, words)
            self.assertNotRegex(done.stdout, r"\b(nan|inf)")
            self.assertEqual(done.stdout == "", done.returncode == WRONG_CASE)


class Inversion(Scratch):
    def test_the_answer_and_its_keys(self):
        base = ["inversion", CASE, "--json"]
        plain, law, warm, method, none = (strict_json(d.stdout) for d in run_all(
            [base, [*base, "--law", "vbk"], [*base, "--temperature", "25 degC"], [*base, "--method", "bulk_density"],
             [*base, "--set", "species.fine.density=1000"]]))
        for answer in (plain, law, warm, method, none):
            for key in ("law", "velocity_m_s", "voidage", "roots", "method"):
                self.assertIn(key, answer)
        self.assertEqual((plain["law"], plain["method"]), ("cello", "force_balance"))
        self.assertEqual((law["law"], method["method"]), ("vbk", "bulk_density"))
        # README: by the force balance this bed inverts at 34 mm/s, rounded to 1
        self.assertAlmostEqual(plain["velocity_m_s"], 0.034, delta=0.0005)
        self.assertEqual(len({a["velocity_m_s"] for a in (plain, law, warm, method)}), 4, "an option changed nothing")
        self.assertIsNone(none["velocity_m_s"], "lighter and smaller particles cannot invert")
        self.assertEqual(none["roots"], [])

    def test_refusals(self):
        for words in (["--law", "celo"], ["--temperature", "90 degC"], ["--temperature", "nan"], ["--set", "effects.drag=none"]):
            self.ends(WRONG_CASE, "inversion", CASE, *words)

    def test_a_temperature_acts_or_is_refused(self):
        """Warmer water carries less: B and C invert at higher velocities, by 1 % a kelvin or more. The liquid of A is given by its numbers."""
        cases = program.ROOT / "cases"
        for name, warmer in (("thesis-b", "20 degC"), ("thesis-c", "32 degC")):
            base = ["inversion", cases / name / "case.toml", "--json"]
            cold, warm = (strict_json(self.ends(DONE, *base, *more).stdout)["velocity_m_s"] for more in ([], ["--temperature", warmer]))
            self.assertGreater(warm, 1.03 * cold)
        told = self.ends(WRONG_CASE, "inversion", cases / "thesis-a/case.toml", "--temperature", "20 degC").stderr
        self.assertRegex(told, r"case\.toml:\d+:\d+: --temperature cannot act: fluid.density and fluid.viscosity are given")


if __name__ == "__main__":
    program.main()
