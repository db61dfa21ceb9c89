#!/usr/bin/python3
"""The result card on the screen and in run.json, against the files of the run. Usage: card_test.py PROGRAM"""
import re
import shlex

import numpy as np

import program
from program import CASE, DONE, ROOT, SMALL, Scratch, history, small_bed, strict_json

KEYS = {"u_mf_m_s", "u_over_u_mf", "terminal_m_s", "geldart", "state", "layers", "bed_height_m", "dense_height_m", "tops_m",
        "pressure_drop_Pa", "pressure_drop_over_weight", "mixing", "mass_kg", "out_kg", "recovery", "discharge_kg_s", "steady", "limited_by", "left_out", "time_s", "lines"}
HEADINGS = ("bed ", "fluidises at ", "falls at ", "solids ", "mixing ", "steady ", "step ", "left out ", "time ")
SCREEN = 25  # lines
TEMPLATES = ROOT / "cases/templates"
# Silt falls at some 2 mm/s, sand of two size classes at 60 and more.
SILT = """[column]
size = ["20 mm", "300 mm"]
cells = [1, 60]
sides = "periodic"
outlet = "open"
[fluid]
name = "water"
temperature = "20 degC"
[[species]]
name = "silt"
diameter = "60 um"
density = 2000
[[species]]
name = "sand"
density = 2650
distribution = "lognormal"
median = "0.7 mm"
deviation = 0.15
classes = 2
[bed]
volume_share = [0.3, 0.7]
static_height = "60 mm"
solids_fraction = 0.55
[inlet]
superficial_velocity = "12 mm/s"
[effects]
others = "none"
drag = "wen_yu"
partition = "brinkman_oseen"
solids_stress = "frictional"
[run]
until = "20 s"
[output]
history_every = "20 ms"
"""


class Card(Scratch):
    def card(self, directory):
        return strict_json((directory / "run.json").read_text())["card"]

    def test_both_models_end_with_the_same_card(self):
        case = self.write("case.toml", small_bed("20 ms"))
        for model in ("tfm", "dem"):
            run = self.folder / model
            done = self.ends(DONE, model, case, "-o", run, "--no-picture", picture=True)
            card = self.card(run)
            self.assertEqual(set(card), KEYS)
            self.assertEqual(set(card["u_mf_m_s"]), {"fine", "coarse", "mixture"})
            last = [line for line in done.stderr.splitlines() if not line.startswith("to go on ")][-len(HEADINGS):]
            for heading, line in zip(HEADINGS, last):
                self.assertTrue(line.startswith(heading), (heading, last))
            self.assertEqual(card["lines"], last)
            record = strict_json((run / "run.json").read_text())
            self.assertEqual(card["time_s"], {"taken": record["cpu_s"], "predicted": record["prediction"]["cpu_s"]})
            self.assertIsNone(card["discharge_kg_s"])
            self.assertIsNone(card["geldart"])
            self.assertAlmostEqual(card["mass_kg"]["fine"], history(run)["mass_fine_kg"][-1], delta=1e-9)
            self.assertEqual(set(card["tops_m"]), {"fine", "coarse"})
            pressure = card["pressure_drop_Pa"]["value"]
            self.assertRegex(last[0], rf"pressure drop {pressure:.4g}( ± \S+)? Pa, {card['pressure_drop_over_weight']['value']:.4g}( ± \S+)? of the weight$")

    def test_a_bed_as_dense_as_its_fluid_bears_no_share_of_its_weight(self):
        keys = ("fluid.density=1000", "species.0.density=1000", "species.1.density=1000", "tfm.max_packing=0.64", "inlet.superficial_velocity=0",
                "dem.greatest_speed=0.1")
        same = [word for key in keys for word in ("--set", key)]
        case = self.write("case.toml", small_bed("20 ms"))
        for model in ("tfm", "dem"):
            self.ends(DONE, model, case, *same, "-o", self.folder / model, "--quiet", "--no-picture")
            self.assertIsNone(self.card(self.folder / model)["pressure_drop_over_weight"])

    def test_a_bed_that_drifts_comes_with_the_command_that_goes_on(self):
        run = self.folder / "run"
        done = self.ends(DONE, "tfm", CASE, *SMALL, "--set", "output.history_every=1e-3", "--until", "0.1 s", "-o", run, "--no-picture")
        self.assertIs(self.card(run)["steady"], False)
        command = re.search(r"(?m)^to go on +polybed (.*)$", done.stderr)[1]
        again = self.ends(DONE, *shlex.split(command), "--quiet", "--no-picture")
        self.assertEqual(strict_json((run / "run.json").read_text())["time_s"], 0.2, again.stderr)

    def test_a_run_that_never_became_steady_goes_on_from_its_end(self):
        """It ends at 20 times run.until, 0.1 s, while the bed still rises."""
        run = self.folder / "run"
        words = ["tfm", CASE, *SMALL, "--set", "output.history_every=1e-3", "--set", "run.until=0.005", "-o", run, "--no-picture"]
        for more in (["--until", "steady"], ["--resume"], ["--resume", "--until", "0.05 s"]):
            told = self.ends(DONE, *words, *more).stderr
            self.assertRegex(told, r'(?m)^to go on .* --resume .* --until "0.2 s"$', more)
        self.assertEqual(strict_json((run / "run.json").read_text())["time_s"], 0.1)

    def test_a_run_ends_when_its_bed_has_become_steady(self):
        """A row of cells that parts into layers: at 30 s it still drifts, at 95 s no longer."""
        run = self.folder / "run"
        keys = ("column.cells=[1,30]", "inlet.superficial_velocity=5 mm/s", "run.until=5", "output.history_every=0.02", "output.every=5")
        told = self.ends(DONE, "tfm", CASE, *(word for key in keys for word in ("--set", key)), "--until", "steady", "-o", run, "--no-picture").stderr
        self.assertRegex(told, r"(?m)^t [\d.]+ s, until steady  bed [\d.]+ mm  step [\d.e-]+ s, limited by [a-z ]+  "
                         r"pressure drop [\d.]+ of the weight  closest to its limit: [a-z ]+, [\d.]+ %$")
        self.assertNotRegex(told, r"(?m)^t .* left")
        record = strict_json((run / "run.json").read_text())
        self.assertEqual(record["state"], "done")
        self.assertIs(record["card"]["steady"], True)
        self.assertGreater(record["time_s"], 20)
        self.assertLess(record["time_s"], 100, "20 times run.until")

    def test_means_are_those_of_the_history(self):
        """Over its last quarter; with the intervals that studies have from the program."""
        run = self.folder / "run"
        self.ends(DONE, "tfm", CASE, *SMALL, "--until", "1 s", "--set", "output.history_every=5e-3", "-o", run, "--quiet")
        card, rows = self.card(run), history(run)
        first = next(n for n, t in enumerate(rows["time_s"]) if t >= 0.75 - 1e-12)
        self.assertAlmostEqual(card["bed_height_m"]["value"], np.mean(rows["bed_height_m"][first:]), delta=1e-12)
        found = strict_json(self.ends(DONE, "measure", run, "--json", "--begin", 0.75).stdout)["in_window"]
        for name in ("bed_height_m", "pressure_drop_over_weight"):
            mean = found["means"][name]
            self.assertEqual(card[name], {"value": mean["mean"], "interval": mean["interval"]})
        self.assertFalse(card["steady"], "the packed bed rises at the fluid's 30 mm/s")
        self.assertEqual(card["state"], "fluidised")
        self.assertEqual(card["layers"], "mixed")

    def test_velocities_are_those_of_the_closures(self):
        """At the minimum fluidisation velocity the drag of the bed balances its buoyant weight, T(1.49); after Wen and Yu
        without a drag law. By polybed drag, which gives five digits here."""
        answer = strict_json(self.ends(DONE, "check", CASE, "--json").stdout)
        run = self.folder / "run"
        self.ends(DONE, "tfm", CASE, *SMALL, "--until", "10 ms", "-o", run, "--quiet")
        card = self.card(run)
        for name in ("u_mf_m_s", "u_over_u_mf", "terminal_m_s", "geldart"):
            self.assertEqual(answer["expected"][name], card[name], "check says the same before the run")
        rho, mu = answer["fluid_density_kg_m3"], answer["fluid_viscosity_Pa_s"]
        for name, d, density in (("fine", 0.807e-3, 1395), ("coarse", 2.01e-3, 1170)):
            u = card["u_mf_m_s"][name]
            f = float(self.ends(DONE, "drag", "--law", "cello", "--voidage", 0.38, "--re", rho * u * d / mu).stdout)
            self.assertAlmostEqual(18 * mu * u * f / d**2, (density - rho) * 9.81 * 0.38, delta=1e-6 * 9.81 * (density - rho))
            self.assertIn(name, card["terminal_m_s"])
        self.assertAlmostEqual(card["u_over_u_mf"], 0.03 / card["u_mf_m_s"]["mixture"], places=9)

    def test_silt_that_leaves_does_not_count_as_bed(self):
        """Sand settles under silt that rises through a tall column: 12 mm/s lifts the one and hardly expands the other."""
        case, run = self.write("case.toml", SILT), self.folder / "run"
        expected = strict_json(self.ends(DONE, "check", case, "--json").stdout)["expected"]
        self.assertEqual(expected["leaving"], ["silt"])
        done = self.ends(DONE, "tfm", case, "-o", run, "--no-picture")
        card, rows = self.card(run), history(run)
        for column in ("mass_{}_kg", "out_{}_kg"):
            whole, parts = (np.array([rows[column.format(name)] for name in names]).sum(axis=0) for names in (["sand"], ["sand.1", "sand.2"]))
            np.testing.assert_allclose(whole, parts, rtol=1e-14)
        self.assertEqual(set(card["tops_m"]), {"silt", "sand"})
        self.assertAlmostEqual(card["recovery"]["sand"] * rows["mass_sand_kg"][0], card["out_kg"]["sand.1"] + card["out_kg"]["sand.2"], places=14)
        dense, silt, sand = card["dense_height_m"]["value"], card["tops_m"]["silt"]["value"], card["tops_m"]["sand"]["value"]
        self.assertAlmostEqual(dense, sand, delta=0.01)  # two cells
        self.assertAlmostEqual(expected["bed_height_m"], sand, delta=0.01)  # two cells
        self.assertGreater(silt, 0.2)
        self.assertGreater(card["bed_height_m"]["value"], 0.2, "the silt counts")
        self.assertRegex(done.stderr, rf"(?m)^bed +fluidised.* dense bed {1e3 * dense:.4g}.* mm high \(sand up to .* mm, silt up to .* mm\)")
        self.assertRegex(done.stderr, r"(?m)^has left +sand .*, silt .*$")

    def test_silt_that_has_left_says_nothing_about_the_bed(self):
        """After 60 s some 1e-14 g are left, which still move."""
        run = self.folder / "run"
        done = self.ends(DONE, "tfm", self.write("case.toml", SILT), "--until", "60 s", "-o", run, "--no-picture")
        card, rows = self.card(run), history(run)
        self.assertGreater(card["recovery"]["silt"], 0.999)
        self.assertRegex(done.stderr, r"(?m)^solids +silt 0 g, sand [\d.]+ g \(assumed depth ")
        self.assertIs(card["steady"], True)
        self.assertIsNone(card["layers"])
        self.assertIsNotNone(rows["centre_silt_m"][0])
        self.assertIsNone(rows["centre_silt_m"][-1])

    def test_a_hopper_has_a_discharge(self):
        run = self.folder / "hopper"
        self.ends(DONE, "dem", TEMPLATES / "hopper/case.toml", "-o", run, "--quiet", "--set", "bed.particles=[200]", "--until", "0.3 s",
                  "--no-picture")
        card, rows = self.card(run), history(run)
        out, time = np.array(rows["out_glass_kg"]), rows["time_s"]
        first, last = (int(np.argmax(out >= share * out[-1])) for share in (0.1, 0.9))
        self.assertAlmostEqual(card["discharge_kg_s"], (out[last] - out[first]) / (time[last] - time[first]), places=12)
        self.assertEqual(card["out_kg"], {"glass": out[-1]})
        self.assertEqual(card["mass_kg"], {"glass": rows["mass_glass_kg"][-1]})  # at the end, as what has left
        self.assertLess(card["mass_kg"]["glass"], rows["mass_glass_kg"][-10])
        self.assertAlmostEqual(card["recovery"]["glass"], out[-1] / rows["mass_glass_kg"][0], places=12)
        self.assertIsNone(card["u_mf_m_s"])
        self.assertIsNone(card["state"])

    def test_a_blocked_hopper_has_none(self):
        """Rough spheres over a slot of 1.5 diameters: some fall, then an arch."""
        run = self.folder / "blocked"
        words = [f"--set={key}" for key in ("bed.particles=[200]", "dem.opening=6 mm", "dem.friction=0.9", "effects.rolling=epsd",
                                            "dem.rolling_friction=0.3", "dem.rolling_damping=0.3")]
        done = self.ends(DONE, "dem", TEMPLATES / "hopper/case.toml", "-o", run, "--until", "0.4 s", "--no-picture", *words)
        card = self.card(run)
        self.assertGreater(card["out_kg"]["glass"], 0)
        self.assertLess(card["recovery"]["glass"], 0.3)
        self.assertIsNone(card["discharge_kg_s"])
        self.assertRegex(done.stderr, r"(?m)^discharge +none: nothing leaves any more")
        done = self.ends(DONE, "dem", TEMPLATES / "hopper/case.toml", "-o", run, "--until", "1 ms", "--no-picture", "--force", *words)
        self.assertNotIn("nothing leaves any more", done.stderr)  # nothing has left yet

    def test_a_single_sphere_is_no_bed(self):
        run = self.folder / "sphere"
        done = self.ends(DONE, "dem", TEMPLATES / "sphere/case.toml", "-o", run, "--until", "10 ms", "--no-picture")
        card = self.card(run)
        self.assertEqual([card[key] for key in ("bed_height_m", "state", "steady", "mixing")], [None] * 4)
        self.assertNotRegex(done.stderr, r"(?m)^(bed|steady|to go on) ")
        self.assertRegex(done.stderr, r"(?m)^falls at +steel ")

    def test_a_first_bed_of_ones_own_is_steady_at_its_end(self):
        """The template that the guide begins with, as it is: 2 s of computing."""
        run = self.folder / "bed"
        done = self.ends(DONE, "tfm", TEMPLATES / "liquid-bed/case.toml", "-o", run, "--no-picture")
        self.assertIs(self.card(run)["steady"], True)
        self.assertNotIn("to go on", done.stderr)
        self.assertEqual(strict_json((run / "run.json").read_text())["warnings"], [])

    def test_a_hopper_is_told_what_to_expect(self):
        """By hand: 1.03 of 0.6 2500 kg/m3 sqrt(9.81) 0.01 m (20 - 1.4 4 mm)^1.5 is 83.6 g/s; 800 spheres of 4 mm are 67.0 g."""
        case = TEMPLATES / "hopper/case.toml"
        rate = strict_json(self.ends(DONE, "check", case, "--json").stdout)["expected"]["discharge_kg_s"]
        self.assertAlmostEqual(rate, 1.03 * 0.6 * 2500 * 9.81**0.5 * 0.01 * 0.0144**1.5, places=12)
        text = self.ends(DONE, "check", case).stdout
        self.assertRegex(text, r"expect +discharge of about 83\.6 g/s; 67 g would be out after 0\.8 s\n +estimate by Beverloo's law")
        self.assertNotIn("may block", text)
        for width, told in (("16 mm", "4 particle diameters wide: below 5 it may block"), ("5.5 mm", "expect +no discharge: the opening is 1.4 ")):
            self.assertRegex(self.ends(DONE, "check", case, "--set", f"dem.opening={width}").stdout, told)

    def test_a_gas_has_geldart_classes(self):
        """By the lines of his paper: 0.5 mm of 2500 kg/m3 is B, 1.5 mm D, 0.05 mm A."""
        case = TEMPLATES / "gas-bed/case.toml"
        bubbles = {"B": "B bubbles above u_mf: ", "D": "D bubbles above u_mf: ", "A": "A bubbles above u_mb, which exceeds u_mf: ", "C": None}
        for diameter, letter in (("0.5 mm", "B"), ("1.5 mm", "D"), ("0.05 mm", "A"), ("20 um", "C")):
            text = self.ends(DONE, "check", case, "--set", f"species.glass.diameter={diameter}").stdout
            self.assertIn(f"Geldart class {letter}\n", text)
            self.assertEqual(re.findall(r"(?m)^ +(\w bubbles above .*: )", text), [bubbles[letter]] if bubbles[letter] else [])
        self.assertIn("swings about its mean", self.ends(DONE, "explain", "Geldart").stdout)

    def test_what_is_numerics_is_behind_details(self):
        case = self.write("case.toml", small_bed("5 ms"))
        plain, details = (self.ends(DONE, "tfm", case, "-o", self.folder / "run", "--force", *words).stderr for words in ([], ["--details"]))
        for text in ("right-hand sides", "convection of momentum", "calls"):
            self.assertNotIn(text, plain)
            self.assertIn(text, details)
        self.assertIn("time by term: ", plain)
        self.assertNotIn("\033", plain + details, "a colour in a pipe")


class Screen(Scratch):
    def test_a_layer_of_one_cell_counts_in_the_pressure_drop_and_in_the_layering(self):
        """Sand of 1.4 % of the volume, in one cell under resin: it is not mixed, its layer ends in that cell, and the drop is the weight."""
        text = small_bed("4 s")
        keys = ('column.size=["6 mm", "300 mm"]', "column.depth=6 mm", "column.cells=[1,60]", "species.fine.density=2600",
                "species.fine.diameter=0.5 mm", "species.coarse.density=1250", "species.coarse.diameter=0.7 mm", "bed.volume_share=[0.014,0.986]",
                "bed.static_height=150 mm", "bed.solids_fraction=0.6", "bed.start=layered", "inlet.superficial_velocity=5 mm/s",
                "effects.drag=richardson_zaki")
        run = self.folder / "run"
        self.ends(DONE, "tfm", self.write("case.toml", text), *(word for key in keys for word in ("--set", key)), "-o", run, "--quiet", "--no-picture")
        card, rows = strict_json((run / "run.json").read_text())["card"], history(run)
        self.assertAlmostEqual(card["pressure_drop_over_weight"]["value"], 1, delta=0.003)  # 0.984 from the pressures alone
        self.assertLess(card["mixing"], 0.1)
        self.assertLess(rows["interface_m"][-1], 0.01)

    def test_what_is_lighter_than_its_fluid_rises(self):
        """By hand: 2.01 mm, 60 kg/m3 lighter than water, and the same heavier, move at one speed, with Schiller and Naumann's drag."""
        speeds = [re.search(rf"{word} at +fine .*coarse (.*) m*m/s", self.ends(DONE, "check", CASE, "--set", f"fluid.density={density}", "--set",
                  "fluid.viscosity=1e-3", "--set", f"species.coarse.density={1000 + sign * 60}", "--set", f"species.fine.density={1000 + sign * 50}").stdout)
                  for word, sign, density in (("falls", 1, 1000), ("rises", -1, 1000))]
        self.assertEqual(*(speed[1] for speed in speeds))

    def test_check_is_one_screen(self):
        cases = sorted(ROOT.glob("cases/*/case.toml")) + sorted(TEMPLATES.glob("*/case.toml"))
        self.assertGreater(len(cases), 20)
        for case, done in zip(cases, program.run_all([["check", case] for case in cases])):
            self.assertEqual(done.returncode, DONE, f"{case}\n{done.stderr}")
            lines = done.stdout.splitlines()
            self.assertLessEqual(len(lines), SCREEN, case)
            self.assertIn(re.search('title *= "(.*)"', case.read_text())[1], lines[0])

    def test_it_says_what_to_expect(self):
        text = self.ends(DONE, "check", CASE).stdout
        for line in (r"expect +fluidised, about 346 mm high by cello", r"\n +\d+ to \d+ mm by laws of such beds: wen_yu, di_felice, richardson_zaki\n",
                     r"fluidises at +fine .* coarse .* mixture .* by cello; u = 30 mm/s is 21 times that",
                     r"note: drag: cello is made for held spheres: .*; take wen_yu with partition = \"brinkman_oseen\"",
                     r"falls at +fine 46.5 mm/s, coarse 66.6 mm/s", r"left out +tfm: forces of .* % of the weight"):
            self.assertRegex(text, line)
        many = self.ends(DONE, "check", ROOT / "cases/filter-backwash/case.toml").stdout
        for heading in ("fluidises at", "falls at"):
            least, greatest = re.search(rf"{heading} +fines ([\d.]+ \S+) to \S+ ([\d.]+ \S+?)[,\n]", many).groups()
            self.assertLess(*(float(value.split()[0]) * {"µm/s": 1e-6, "mm/s": 1e-3}[value.split()[1]] for value in (least, greatest)))
        expected = strict_json(self.ends(DONE, "check", CASE, "--json").stdout)["expected"]
        self.assertEqual((expected["state"], round(1e3 * expected["bed_height_m"]), expected["discharge_kg_s"]), ("fluidised", 346, None))
        for velocity, state in (("1 mm/s", "packed"), ("1 m/s", "carried up")):
            told = self.ends(DONE, "check", CASE, "--set", f"inlet.superficial_velocity={velocity}").stdout
            self.assertRegex(told, f"expect +{state}")

    def test_flows_masses_packings_and_shapes(self):
        """By hand: 407 l/h over a circle of 60 mm are 40 mm/s; 0.1 m of beads at 0.6 weigh pi 0.03^2 0.1 0.6 2500 = 0.4241 kg."""
        case = TEMPLATES / "round-liquid-bed/case.toml"
        text = self.ends(DONE, "check", case).stdout
        self.assertRegex(text, r"(?m)^fluidises at +[\d.]+ mm/s \([\d.]+ l/h\) by richardson_zaki; u = 40 mm/s \(407 l/h\) is ")
        self.assertRegex(text, r"(?m)^expands by +10 % at [\d.]+ to [\d.]+ mm/s \([\d.]+ to [\d.]+ l/h\)")
        self.assertRegex(text, r"(?m)^solids +beads 424 g$")
        self.assertRegex(text, r"(?m)^ +[\d.]+ mm/s \([\d.]+ l/h\) if settled to 0.575 of solids, [\d.]+ mm/s .* if settled to 0.625 of solids$")
        self.assertNotIn("shape = ", text)
        found = strict_json(self.ends(DONE, "check", case, "--json").stdout)["expected"]
        loose, dense = found["u_mf_by_packing"]
        self.assertGreater(loose["u_mf_m_s"], found["u_mf_m_s"]["mixture"])
        self.assertGreater(found["u_mf_m_s"]["mixture"], dense["u_mf_m_s"])
        dense_case = strict_json(self.ends(DONE, "check", case, "--json", "--set", "bed.solids_fraction=0.625").stdout)["expected"]
        self.assertAlmostEqual(dense_case["u_mf_m_s"]["mixture"], dense["u_mf_m_s"], delta=1e-9)
        sand = ["--set", "species.beads.sphericity=0.85", "--set", "effects.shape=ganser"]
        other = strict_json(self.ends(DONE, "check", case, "--json", *sand, "--set", "effects.shape=haider_levenspiel").stdout)["expected"]
        shaped = strict_json(self.ends(DONE, "check", case, "--json", *sand).stdout)["expected"]["by_shapes"]["haider_levenspiel"]
        self.assertEqual(shaped, {"u_mf_m_s": other["u_mf_m_s"]["mixture"], "bed_height_m": other["bed_height_m"]})
        self.assertRegex(self.ends(DONE, "check", case, *sand).stdout, r'(?m)^ +fluidises at .* high by shape = "haider_levenspiel"$')
        wide = self.ends(DONE, "check", CASE).stdout
        self.assertRegex(wide, r"(?m)^ +between [\d.]+ mm/s \(fine alone\) and [\d.]+ mm/s \(coarse alone\); ")

    def test_a_large_bed_has_no_powers_of_ten(self):
        large = ["--set", 'column.size=["150 mm", "2.4 m"]', "--set", 'bed.static_height="1.2 m"', "--set", 'inlet.flow_rate="6500 l/h"']
        shown = self.ends(DONE, "check", TEMPLATES / "round-liquid-bed/case.toml", *large).stdout
        self.assertNotRegex(shown, r"\de\+\d")
        self.assertRegex(shown, r"(?m)^ +\d{4} to \d{4} mm by laws of such beds: ")
        self.assertRegex(shown, r"(?m)^fluidises at .* \(\d{4} l/h\) is .* that$")
        self.assertRegex(shown, r"(?m)^weight +1\d{4} Pa ")
        self.assertRegex(shown, r"(?m)^steady +after \d+ s at least")

    def test_the_validity_is_that_of_the_recorded_comparisons(self):
        rows = [row for block in strict_json((ROOT / "cases/validation/recorded.json").read_text())["blocks"] for row in block["rows"]]
        worst = {}
        for row in rows:
            if row["entry"] == "expansion-in-water" and row["model"] == "tfm":
                law = row["run"].rpartition("-")[0]
                worst[law] = max(worst.get(law, 0), row["result"][0] - row["measured"][0])
        over = {(row["entry"], row["quantity"]): row["result"][0] / row["measured"][0] - 1 for row in rows if row["result"]}
        inversion = next(row for row in rows if row["entry"] == "matsuura-akehata")
        middle, half = (1e3 * value for value in inversion["result"])
        self.assertEqual(f"{worst['wen_yu']:.2f}", f"{worst['cello']:.2f}")
        sentences = {TEMPLATES / "liquid-bed/case.toml": f"voidage at most {worst['di_felice']:.2f} too high by di_felice, {worst['cello']:.2f} by wen_yu and cello",
                     CASE: f"mixed from {middle - half:.3g} to {middle + half:.3g} mm/s by cello, {1e3 * inversion['measured'][0]:.3g} measured",
                     TEMPLATES / "gas-bed/case.toml": f"the height of one comes out {-100 * over['van-wachem', 'bed height']:.0f} % low, "
                                                      f"u_mf of the other {100 * over['taghipour', 'u_mf']:.0f} % high"}
        for case, sentence in sentences.items():
            self.assertRegex(self.ends(DONE, "check", case).stdout, rf"(?m)^validity +.*{sentence}; polybed validate --list$")


if __name__ == "__main__":
    program.main()
