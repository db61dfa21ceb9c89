#!/usr/bin/python3
"""polybed inversion as its user meets it: the scan by runs, its table, file and picture, what is reused and what is refused.
Usage: inversion_test.py PROGRAM"""
import json
import re

import program
from program import DONE, FILTER, ROOT, WRONG_CASE, Scratch, history, strict_json

CASE = ROOT / "cases/small-binary/case.toml"
# On a coarse grid and for 0.8 s: enough to tell who is on top, not a result.
SHORT = ["--set", "column.cells=[2,30]", "--set", "output.history_every=\"2 ms\"", "--set", "output.checkpoint_every=1", "--until",
         "0.8 s", "--no-picture"]


class Scan(Scratch):
    def scan(self, code, *words, model="tfm", begin="30 mm/s"):
        return self.ends(code, "inversion", CASE, "--scan", model, *SHORT, "--from", begin, "--to", "40 mm/s", "-o",
                         self.folder / "scan", *words)

    def runs(self):
        return {path.name: (path / "run.json").stat().st_mtime_ns for path in (self.folder / "scan/tfm").iterdir()}

    def test_a_scan_its_file_what_is_reused_and_what_was_killed(self):
        told = self.scan(DONE).stdout
        found = strict_json((self.folder / "scan/inversion.json").read_text())
        scan = found["models"]["tfm"]
        self.assertEqual([found[name] for name in ("scan", "from_m_s", "to_m_s", "until_s", "ranks")], ["tfm", 0.03, 0.04, 0.8, 1])
        lines = re.findall(r"(?m)^tfm +[0-9.]+ .*$", told)
        self.assertIn("interface_over_height", scan["runs"][0])
        self.assertEqual(found["beside"]["mixed_interval_m_s"][1], found["force_balance"]["velocity_m_s"])
        for line in ("tfm: mixed (interface at the bed's height, x* = 5 %) ", "mixed by force balance: "):
            self.assertIn(line, told)
        self.assertEqual(len(lines), len(scan["runs"]))
        first, second = scan["runs"][:2]
        self.assertEqual((first["velocity_m_s"], first["from"], second["velocity_m_s"], second["from"]), (0.03, None, 0.04, 0))
        for run in scan["runs"]:
            self.means_are_those_of_its_history(run)
            record = strict_json((self.folder / "scan" / run["directory"] / "run.json").read_text())
            self.assertEqual(run["git_commit"], record["git_commit"])
            if run["from"] is not None:
                source = scan["runs"][run["from"]]
                self.assertIn(f"checkpoint:{source['directory']}/checkpoint.h5", record["case"])
                ramp = json.loads(re.search(r"superficial_velocity = (\[\[.*\]\])", record["case"])[1])
                self.assertEqual([ramp[0], ramp[1][1]], [[0, source["velocity_m_s"]], run["velocity_m_s"]])
        before = self.runs()
        self.assertEqual(len(before), len(scan["runs"]))
        again = self.scan(DONE, "--json").stdout
        self.assertEqual(self.runs(), before)  # nothing was run again
        self.assertEqual(strict_json(again), found)
        self.assertEqual(self.scan(DONE).stdout.count("finished before"), len(lines))
        self.what_was_killed_is_gone_on_with(found)

    def means_are_those_of_its_history(self, run):
        rows = history(self.folder / "scan" / run["directory"])
        at = [n for n, t in enumerate(rows["time_s"]) if run["begin_s"] - 1e-9 <= t <= run["end_s"] + 1e-9]
        self.assertGreaterEqual(run["begin_s"], 0.6 - 1e-9)  # the last quarter, or what is left of it
        mean = sum((rows["centre_coarse_m"][n] - rows["centre_fine_m"][n]) / rows["bed_height_m"][n] for n in at) / len(at)
        self.assertAlmostEqual(run["centre_difference"], mean, delta=1e-12)
        self.assertAlmostEqual(run["bed_height_m"], sum(rows["bed_height_m"][n] for n in at) / len(at), delta=1e-12)

    def what_was_killed_is_gone_on_with(self, whole):
        last = self.folder / "scan" / whole["models"]["tfm"]["runs"][-1]["directory"]
        record = last / "run.json"
        record.write_text(record.read_text().replace('"state":"done"', '"state":"running"'))
        (last / "checkpoint.h5").unlink()
        (last / "checkpoint.previous.h5").unlink(missing_ok=True)
        again = strict_json(self.scan(DONE, "--json").stdout)
        for model in (whole, again):
            for run in model["models"]["tfm"]["runs"]:
                del run["cpu_s"]
            del model["models"]["tfm"]["cpu_s"]
        self.assertEqual(again, whole)  # the same bits

    def test_the_band_of_a_stress_table(self):
        table = ROOT / "cases/solids-stress-b/table.h5"  # of another liquid: what it says of this bed is not looked at
        words = ["--stress-uncertainty", "--set", 'calibrate.regime="wet"', "--set", f'effects.solids_stress="table:{table}"']
        told = self.scan(DONE, *words).stdout
        scan = strict_json((self.folder / "scan/inversion.json").read_text())["models"]["tfm"]
        band = scan["stress_uncertainty"]
        found = [which["velocity_m_s"] for which in (scan, band["minus"], band["plus"])]
        if None in found:  # 0.8 s may be too short for one of them
            self.assertEqual((band["low_m_s"], band["high_m_s"]), (None, None))
            self.assertIn("no band of the table", told)
        else:
            self.assertEqual((band["low_m_s"], band["high_m_s"]), (min(found), max(found)))
            self.assertIn("within one standard error of the table", told)
        for name in ("minus", "plus"):
            case = strict_json((self.folder / "scan" / band[name]["runs"][0]["directory"] / "run.json").read_text())["case"]
            self.assertIn(f"table-tfm-{name}.h5", case)
        again = self.scan(DONE, *words).stdout
        self.assertEqual(again.count("finished before"), sum(len(s["runs"]) for s in (scan, band["minus"], band["plus"])))
        self.assertIn("table", self.scan(WRONG_CASE, "--stress-uncertainty").stderr)
        self.assertIn("two-fluid", self.scan(WRONG_CASE, *words, model="dem").stderr)

    def test_the_picture(self):
        words = [word for word in SHORT if word != "--no-picture"]
        self.ends(DONE, "inversion", CASE, "--scan", "tfm", *words, "--from", "30 mm/s", "-o", self.folder / "scan")
        self.assertTrue((self.folder / "scan/inversion.png").read_bytes().startswith(b"\x89PNG"))
        found = strict_json((self.folder / "scan/inversion.json").read_text())
        self.assertEqual(found["to_m_s"], 1.25 * found["force_balance"]["velocity_m_s"])  # no --to was given

    def test_refusals(self):
        self.assertIn("--from", self.scan(WRONG_CASE, begin="3 mm").stderr)
        self.assertIn("below", self.scan(WRONG_CASE, begin="50 mm/s").stderr)
        compressible = ["--set", "column.outlet=open", "--set", "fluid.equation_of_state=tait"]
        self.assertIn("column.outlet", self.scan(WRONG_CASE, *compressible, model="both").stderr)
        self.assertIn("history_every", self.scan(WRONG_CASE, "--set", "output.history_every=0.1").stderr)
        self.ends(WRONG_CASE, "inversion", ROOT / "cases/van-wachem/case.toml", "--scan", "tfm")
        self.assertIn("--from and --to", self.ends(
            WRONG_CASE, "inversion", CASE, "--scan", "tfm", "--set", "species.coarse.density=2500").stderr)


class WithoutARun(Scratch):
    SYSTEM_B = ROOT / "cases/thesis-b/case.toml"

    def test_the_point_over_the_share_of_the_second_species(self):
        """Of system B at its own share, 0.431: between the rows 0.40 and 0.45."""
        rows = strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, "--composition", "--json").stdout)["composition"]
        self.assertEqual([row["share"] for row in rows], [n / 20 for n in range(1, 20)])
        by_share = {row["share"]: row for row in rows}
        own = strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, "--json").stdout)
        low, high = sorted(by_share[share]["velocity_m_s"] for share in (0.4, 0.45))
        self.assertLess(low, own["velocity_m_s"])
        self.assertLess(own["velocity_m_s"], high)
        # equal pure bulk densities do not depend on the shares
        self.assertEqual(len({round(bound, 12) for row in rows if row["mixed_interval_m_s"] for bound in row["mixed_interval_m_s"]
                              if abs(bound - own["mixed_interval_m_s"][0]) < 1e-9}), 1)
        self.assertIn("--composition", self.ends(WRONG_CASE, "inversion", self.SYSTEM_B, "--composition", "--method", "all").stderr)

    def test_the_mixed_interval_and_what_others_found(self):
        found = strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, "--json").stdout)
        low, high = found["mixed_interval_m_s"]
        self.assertEqual(high, found["velocity_m_s"])
        self.assertEqual(low, strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, "--method", "bulk_density",
                                                    "--json").stdout)["velocity_m_s"])
        self.assertAlmostEqual(1e3 * low, 28.2, delta=0.05)  # as printed
        self.assertEqual((found["measured_m_s"], found["simulated_m_s"]), ([0.03], [0.025, 0.035]))
        text = self.ends(DONE, "inversion", self.SYSTEM_B).stdout
        self.assertEqual(found["on_top"], {"below": "coarse", "above": "fine"})  # the coarse particles are the lighter ones
        self.assertIn("at lower velocities coarse is on top, at higher ones fine", text)
        sand = ["--set", "species.coarse.sphericity=0.9", "--set"]
        ganser, other = (strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, *sand, f"effects.shape={shape}", "--json").stdout)
                         for shape in ("ganser", "haider_levenspiel"))
        self.assertEqual(ganser["by_shapes"]["haider_levenspiel"], other["velocity_m_s"])
        self.assertNotEqual(ganser["velocity_m_s"], other["velocity_m_s"])
        # Denser coarse particles turn the two criteria around: between them neither says mixed.
        turned = ["--set", "species.coarse.density=1200"]
        self.assertIsNone(strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, *turned, "--json").stdout)["mixed_interval_m_s"])
        self.assertIn("no mixed interval", self.ends(DONE, "inversion", self.SYSTEM_B, *turned).stdout)
        for line in ("28.22 to 34.27 mm/s", "measured: 30.00 mm/s", "simulated by others: 25.00 to 35.00 mm/s"):
            self.assertIn(line, text)
        self.assertIn("inversion.measured", self.ends(WRONG_CASE, "inversion", self.SYSTEM_B, "--set",
                                                      "inversion.measured=[0.03, 0.02]").stderr)

    def test_a_case_in_litres_per_hour_is_answered_so(self):
        """By hand: 34.27 mm/s through 60 mm times 4.06 mm are 30.1 l/h."""
        text = re.sub(r"superficial_velocity *= .*", 'flow_rate = "26 l/h"', self.SYSTEM_B.read_text())
        self.assertIn("inversion at 34.27 mm/s (30.1 l/h), ", self.ends(DONE, "inversion", self.write("case.toml", text)).stdout)

    def test_all_methods_are_what_each_says_alone(self):
        rows = strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, "--method", "all", "--json").stdout)["methods"]
        laws = [law["law"] for role in strict_json(self.ends(DONE, "list", "--json").stdout)["roles"] if role["role"] == "drag"
                for law in role["laws"] if law["law"] != "file:FILE"]  # of the menu
        self.assertEqual([row["law"] for row in rows if row["method"] == "force_balance" and row["partition"] is None], laws)
        pairs = [(row["law"], row["partition"]) for row in rows if row["partition"] is not None]
        self.assertEqual(len(set(pairs)), len(pairs))
        self.assertEqual(len(pairs), 16 * 5 - 5)  # each law of one size with each partition, but the five that have a name
        self.assertEqual([row["method"] for row in rows if row["law"] is None], ["expansion", "density_maximum"])
        for method, law in (("force_balance", "vbk_theory"), ("bulk_density", "di_felice"), ("density_maximum", None)):
            alone = strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, "--method", method, "--json",
                                          *(["--law", law] if law else [])).stdout)
            [row] = [row for row in rows if row["method"] == method and row["law"] == law and row["partition"] is None]
            self.assertEqual(row["roots"], alone["roots"])
        # 37.3730 mm/s of tests/data/lbm/systems_ABC_macro.csv, for shares of 0.431 where these are of whole particles
        [theory] = [row for row in rows if row["law"] == "vbk_theory" and row["partition"] is None and row["method"] == "force_balance"]
        self.assertAlmostEqual(theory["roots"][-1]["velocity_m_s"], 37.373e-3, delta=0.01 * 37.373e-3)
        table = self.ends(DONE, "inversion", self.SYSTEM_B, "--method", "all", "--details").stdout
        self.assertGreaterEqual(len(table.splitlines()), len(rows))
        velocities = [float(line.split()[-2]) for line in table.splitlines() if re.match(". bulk_density .*[0-9]$", line)]
        self.assertEqual(velocities, sorted(velocities))
        self.assertEqual(len(re.findall(r"(?m)^\* force_balance ", table)), 1, "the law of the case")
        self.assertRegex(table, r"(?m)^. force_balance +vbk_theory +\(mixtures\) +37\.\d\d +0\.\d{4}$")

    def test_all_methods_fit_on_a_screen_with_the_best_first(self):
        every = strict_json(self.ends(DONE, "inversion", self.SYSTEM_B, "--method", "all", "--json").stdout)["methods"]
        for words, marked in (([], "cello"), (["--law", "wen_yu", "--partition", "brinkman_oseen"], "wen_yu x brinkman_oseen"),
                              (["--law", "gidaspow"], "gidaspow")):
            lines = self.ends(DONE, "inversion", self.SYSTEM_B, "--method", "all", *words).stdout.splitlines()
            self.assertLessEqual(len(lines), 25)
            self.assertLessEqual(max(map(len, lines)), 100)
            self.assertEqual([re.match(r"\* (.+?)  ", line)[1] for line in lines if line.startswith("* ")], [marked])
            self.assertIn("--details", lines[-1])
            self.assertIn("wen_yu x brinkman_oseen", lines[2])
            for line in lines:
                if found := re.match(r"[ *] (\w+) x (\w+) +([\d.]+) ", line):
                    [row] = [row for row in every if (row["law"], row["partition"]) == found.groups()[:2]]
                    self.assertAlmostEqual(float(found[3]), 1e3 * row["roots"][-1]["velocity_m_s"], delta=5.1e-3)  # as printed

    def test_layers_that_never_change_places_say_which_is_below(self):
        """A filter of sand under anthracite: stokes, batchelor, carman_kozeny and syamlal find points far outside their ranges."""
        case = self.write("case.toml", FILTER)
        told = self.ends(DONE, "inversion", case, "--method", "all").stdout
        self.assertRegex(told, r"(?m)^no law or pair within its range finds a point\nby .*: sand is below at all velocities, anthracite on top$")
        self.assertRegex(told, r"(?m)^outside their range at their point, not counted: [1-9]\d* laws and pairs$")
        self.assertIn("sand is below at all velocities", self.ends(DONE, "inversion", case).stdout)

    def test_a_mean_law_with_a_partition(self):
        # mm/s and voidage of an evaluation apart from this program, as printed: a unit of the last digit, for rounding and for B's shares of
        # whole particles.
        for name, velocity, voidage, digit in (("thesis-a", 1.84, 0.783, 0.01), ("thesis-b", 27.4, 0.827, 0.1), ("thesis-c", 14.6, 0.804, 0.1)):
            words = ["inversion", ROOT / "cases" / name / "case.toml", "--law", "wen_yu", "--partition", "brinkman_oseen"]
            found = strict_json(self.ends(DONE, *words, "--json").stdout)
            self.assertEqual((found["law"], found["partition"]), ("wen_yu", "brinkman_oseen"))
            self.assertAlmostEqual(1e3 * found["velocity_m_s"], velocity, delta=digit)
            self.assertAlmostEqual(found["voidage"], voidage, delta=6e-4)
            told = self.ends(DONE, *words).stdout
            self.assertIn("wen_yu x brinkman_oseen", told)
            self.assertRegex(told, r"drag of all species together: \+\d+\.\d\d % of the mean law")
        self.assertNotIn("together", self.ends(DONE, *words[:-1], "vbk_theory").stdout)
        self.assertIn("law of mixtures", self.ends(WRONG_CASE, "inversion", self.SYSTEM_B, "--law", "vbk_theory", "--partition", "cello").stderr)

    def test_law_and_temperature_reach_a_scan(self):
        found = strict_json(self.ends(
            DONE, "inversion", CASE, "--scan", "tfm", *SHORT, "--from", "33 mm/s", "--to", "45 mm/s", "--law", "vbk_theory", "--json",
            "-o", self.folder / "scan").stdout)
        self.assertIn('drag = "vbk_theory"',
                      strict_json((self.folder / "scan" / found["models"]["tfm"]["runs"][0]["directory"] / "run.json").read_text())["case"])


class WithoutPoint(Scratch):
    def test_sizes_and_densities_that_never_change_places_are_told(self):
        for density, word in (("2500", "as dense"), ("2600", "denser")):
            told = self.ends(DONE, "inversion", CASE, "--set", "species.fine.density=2500", "--set", f"species.coarse.density={density}").stdout
            self.assertRegex(told, rf"^no inversion point .*\n.*coarse is larger and {word}, so fine is on top at every velocity\n$")
        self.assertNotIn("no inversion point", self.ends(DONE, "inversion", CASE).stdout)


if __name__ == "__main__":
    program.main()
