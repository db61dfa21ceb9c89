#!/usr/bin/python3
"""Every command's answer, its JSON and its exit code. Usage: commands_test.py PROGRAM"""
import csv
import io

from program import SHIPPED, CliTest, main, polybed, settings, strict_json


class Help(CliTest):
    def test_wrong_commands_end_with_2(self):
        self.ends(0, polybed("--help"))
        self.ends(0, polybed("--version"), "polybed 0.")
        for words in ([], ["fly"], ["tfm"], ["tfm", SHIPPED, "--unknown"], ["drag", "--guard", "maybe"]):
            self.ends(2, polybed(*words))


class Check(CliTest):
    def test_prints_the_resolved_case_which_reads_back(self):
        first = self.ends(0, polybed("check", SHIPPED, "--set", "inlet.superficial_velocity=37 mm/s"), "0.037")
        again = self.write("again.toml", first.stdout)
        self.assertEqual(self.ends(0, polybed("check", again)).stdout.split("# hash")[0].count("0.037"), 1)

    def test_json(self):
        answer = strict_json(self.ends(0, polybed("check", SHIPPED, "--json")).stdout)
        self.assertGreater(answer["memory_MB"], 1)
        # (0.569 1395 + 0.431 1170 - rho_f) 9.81 0.62 0.066 with rho_f = 999.10: 119.995 Pa by hand.
        self.assertAlmostEqual(answer["buoyant_weight_Pa"], 119.995, delta=0.02)

    def test_everything_wrong_is_told_at_once(self):
        text = SHIPPED.read_text().replace("diameter =", "diametre =", 1).replace("[18, 198]", "[0, 198]")
        path = self.write("wrong.toml", text)
        done = self.ends(2, polybed("check", path, "--set", "tfm.rtol=7"), f"{path}:15:1: unknown key 'diametre'",
                         "did you mean 'diameter'?", f"{path}:6:10: column.cells = 0 is out of range: at least 1",
                         "--set tfm.rtol: tfm.rtol = 7 is out of range")
        self.assertEqual(done.stdout, "")

    def test_files_that_cannot_be_read_end_with_4(self):
        self.ends(4, polybed("check", self.scratch / "none.toml"), "none.toml: cannot be read (No such file")
        self.ends(4, polybed("tfm", self.scratch), "is a folder")


class Keys(CliTest):
    def test_schema_explain_list(self):
        self.ends(0, polybed("schema"), "superficial_velocity")
        keys = strict_json(self.ends(0, polybed("schema", "--json")).stdout)
        self.assertTrue(keys)
        self.ends(0, polybed("explain", "tfm.rtol"), "default")
        self.ends(2, polybed("explain", "tfm.rtoll"), "did you mean 'tfm.rtol'?")
        strict_json(self.ends(0, polybed("explain", "tfm.rtol", "--json")).stdout)
        self.ends(0, polybed("list"), "cello", "frictional", "syamlal")
        strict_json(self.ends(0, polybed("list", "--json")).stdout)


class Drag(CliTest):
    def test_at_a_point(self):
        # T(4.1) at eps 0.5, Re 0: K0 = 0.2, (1 + 25.6 + 28.6)/(0.25 (1 + 9.9)) = 20.2569.
        self.assertAlmostEqual(float(polybed("drag", "--voidage", 0.5, "--re", 0).stdout), 55.2 / (0.25 * 10.9), places=9)
        answer = strict_json(polybed("drag", "--voidage", 0.5, "--re", 0, "--json").stdout)
        self.assertAlmostEqual(answer["n"], answer["f"] / 0.5, places=9)

    def test_beyond_its_range_says_so(self):
        self.ends(0, polybed("drag", "--voidage", 0.5, "--re", 5000), "outside the range of cello")
        self.ends(2, polybed("drag", "--law", "celo", "--voidage", 0.5, "--re", 1), "did you mean 'cello'?")
        self.ends(2, polybed("drag", "--voidage", 1.5, "--re", 1), "outside (0, 1]")
        self.ends(2, polybed("drag", "--voidage", "nan", "--re", 1), "outside (0, 1]")

    def test_for_every_row(self):
        path = self.write("points.csv", "# two sizes\neps,Re,x1,D1,x2,D2\n0.5,10,0.5,1,0.5,2\n0.9,100,0.2,1,0.8,3\n")
        rows = list(csv.DictReader(io.StringIO(self.ends(0, polybed("drag", "--csv", path)).stdout)))
        self.assertEqual(len(rows), 2)
        for row in rows:  # sum rule T(3.45): sum x_j f_j / y_j^2 = f_mean, to the digits printed
            x, d = [float(row["x1"]), float(row["x2"])], [float(row["D1"]), float(row["D2"])]
            mean = 1 / sum(a / b for a, b in zip(x, d))
            total = sum(a * float(row[f"f_{j}"]) * (mean / b) ** 2 for j, (a, b) in enumerate(zip(x, d), 1))
            self.assertAlmostEqual(total / float(row["f_mean"]), 1, places=10)

    def test_a_bad_row_is_named(self):
        path = self.write("bad.csv", "eps,Re\n0.5,1\n0.5,hello\n")
        self.ends(2, polybed("drag", "--csv", path), f"{path}:3", "hello")
        self.ends(4, polybed("drag", "--csv", self.scratch / "none.csv"), "none.csv")


class Inversion(CliTest):
    def test_by_force_balance(self):
        answer = strict_json(self.ends(0, polybed("inversion", SHIPPED, "--json")).stdout)
        self.assertEqual((answer["law"], answer["method"]), ("cello", "force_balance"))
        self.assertAlmostEqual(answer["velocity_m_s"], 34.27e-3, delta=0.01e-3)  # the spec: 34.3 mm/s
        self.assertEqual(answer["roots"][0]["velocity_m_s"], answer["velocity_m_s"])

    def test_options(self):
        at_20 = strict_json(polybed("inversion", SHIPPED, "--temperature", "20 degC", "--json").stdout)
        self.assertAlmostEqual(at_20["velocity_m_s"], 35.88e-3, delta=0.02e-3)  # the thesis: 35.9 mm/s
        self.ends(0, polybed("inversion", SHIPPED, "--law", "vbk_theory"))
        self.ends(0, polybed("inversion", SHIPPED, "--method", "bulk_density"))
        self.ends(2, polybed("inversion", SHIPPED, "--method", "magic"), "magic")
        self.ends(2, polybed("inversion", SHIPPED, "--temperature", "20 parsec"))


class Tfm(CliTest):
    def test_json_is_the_record_and_nothing_else(self):
        done = polybed("tfm", SHIPPED, *settings(), "--until", "0.05 s", "-o", self.scratch / "run", "--json")
        record = strict_json(self.ends(0, done).stdout)
        self.assertEqual(record["state"], "done")
        stored = strict_json((self.scratch / "run/run.json").read_text())
        self.assertEqual(record["work"], stored["work"])
        self.assertEqual(record.keys(), stored.keys())

    def test_quiet_is_quiet_and_a_run_is_not_overwritten(self):
        words = ["tfm", SHIPPED, *settings(), "--until", "0.02 s", "-o", self.scratch / "run"]
        done = self.ends(0, polybed(*words, "--quiet"))
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        self.ends(2, polybed(*words), "--resume goes on with it, --force replaces it")
        self.ends(0, polybed(*words, "--force"))


if __name__ == "__main__":
    main()
