#!/usr/bin/python3
"""What polybed check expects of layers, weirs and hoppers. Usage: expected_test.py PROGRAM"""
import re

import numpy as np

import program
from program import DONE, FILTER, ROOT, WRONG_CASE, Scratch, strict_json

TEMPLATES = ROOT / "cases/templates"

ROUND = """[column]
shape = "cylinder"
size = ["60 mm", "60 mm", "150 mm"]
cells = [10, 10, 50]
[fluid]
name = "none"
[[species]]
name = "small"
diameter = "2.5 mm"
density = 1200
[bed]
particles = [500]
solids_fraction = 0.6
start = "settled"
start_solids_fraction = 0.4
[[wall]]
shape = "cone"
from = ["24 mm", "0 mm"]
to = ["60 mm", "50 mm"]
[effects]
contact = "hertz_mindlin"
others = "none"
[dem]
opening = "24 mm"
[run]
until = "0.1 s"
"""

# A tube of ion exchange resin with some of its fragments, which lift before it does.
RESIN = """[column]
size = ["300 mm", "1.6 m"]
cells = [1, 80]
sides = "periodic"
outlet = "open"
[fluid]
name = "water"
temperature = "20 degC"
[[species]]
name = "resin"
diameter = "0.6 mm"
density = 1250
[[species]]
name = "fragments"
diameter = "0.2 mm"
density = 1250
[bed]
volume_share = [0.95, 0.05]
static_height = "800 mm"
solids_fraction = 0.6
[inlet]
superficial_velocity = "3.9 mm/s"
[effects]
drag = "richardson_zaki"
partition = "brinkman_oseen"
solids_stress = "frictional"
others = "none"
[run]
until = "60 s"
"""
ALONE = RESIN.replace(RESIN[RESIN.index("[[species]]"):RESIN.index("[[species]]\nname = \"fragments")], "").replace("[0.95, 0.05]", "[1]").replace(
    'partition = "brinkman_oseen"\n', "")


class Expected(Scratch):
    def expected(self, text, *words):
        return strict_json(self.ends(DONE, "check", self.write("bed.toml", text), "--json", *words).stdout)["expected"]

    def test_layers_add_up(self):
        """Each layer by itself is a bed of one species, which the same formula gives; the heights of the layers and their drops add up."""
        one = re.sub(r'\[\[layer\]\]\nspecies = "sand".*\n.*\n', "", FILTER), re.sub(r'\[\[layer\]\]\nspecies = "anth(.*\n){3}', "", FILTER)
        for velocity, number in (("40 m/h", "bed_height_m"), ("10 m/h", "packed_pressure_drop_Pa")):
            words = "--set", f"inlet.superficial_velocity={velocity}"
            parts = [self.expected(text, *words)[number] for text in one]
            both = self.expected(FILTER, *words)
            self.assertAlmostEqual(both[number], sum(parts), delta=1e-9 * sum(parts))
        both = self.expected(FILTER)
        self.assertLess(both["bed_height_mixed_m"], both["bed_height_m"])
        text = self.ends(DONE, "check", self.write("bed.toml", FILTER)).stdout
        self.assertRegex(text, r"expect +fluidised, about \d+ mm high by wen_yu in layers \(settled 550 mm, column 1050 mm; \d+ mm if mixed\)")
        low, high = (float(x) for x in re.search(r"\n +(\d+) to (\d+) mm by laws of such beds", text).groups())
        self.assertTrue(low <= round(1e3 * both["bed_height_m"]) <= high)
        for step in both["expansion"]:  # the greatest velocity is that of a law whose bed is then so high
            there = self.expected(FILTER, "--set", f"inlet.superficial_velocity={step['least_m_s']}")
            heights = [law["bed_height_m"] for law in there["by_laws_of_beds"].values()]
            self.assertAlmostEqual(max(heights), (1 + step["share"]) * 0.55, delta=1e-4)
        self.assertIn("; layers still packed: 1", self.ends(DONE, "check", self.write("bed.toml", FILTER), "--set",
                                                            "inlet.superficial_velocity=20 m/h").stdout)
        upside_down = FILTER.replace("2650", "1449").replace("1450", "2650").replace("1449", "1450")
        self.assertIn("an upper layer becomes denser", self.ends(DONE, "check", self.write("bed.toml", upside_down)).stdout)

    def test_a_bed_as_high_as_its_weir_flows_over_it(self):
        case, low = self.write("bed.toml", FILTER), ("--set", 'column.size=["50 mm", "600 mm"]', "--set", "column.cells=[1,60]")
        text = self.ends(DONE, "check", case, *low).stdout
        self.assertIn("up to the top of the column by wen_yu, over which solids leave", text)
        self.assertRegex(text, r"(?m)^steady +no time foreseen: solids leave over the top; ")
        text = self.ends(DONE, "check", case, *low, "--set", "column.outlet=screen").stdout
        self.assertNotIn("solids leave", text)
        self.assertRegex(text, r"(?m)^steady ")

    def test_a_mixed_bed_whose_species_part(self):
        """Each species above the other is a bed of its own: the sum of two cases of one species."""
        slow = "--set", "inlet.superficial_velocity=2 mm/s"
        both = self.expected(RESIN, *slow)
        resin = RESIN.replace(RESIN[RESIN.index("[[species]]\nname = \"fragments"):RESIN.index("[bed]")], "").replace("[0.95, 0.05]", "[1]").replace(
            'partition = "brinkman_oseen"\n', "")
        parts = [self.expected(text, *slow, "--set", f"bed.static_height={height}")["bed_height_m"] for text, height in ((resin, 0.76), (ALONE, 0.04))]
        self.assertAlmostEqual(both["bed_height_parted_m"], sum(parts), delta=1e-9)
        self.assertFalse(both["reaches_top"])
        case = self.write("bed.toml", RESIN)
        self.assertRegex(self.ends(DONE, "check", case, *slow).stdout, rf"\n +about {1e3 * sum(parts):.0f} mm high if the species part into layers\n")
        fast = self.ends(DONE, "check", case).stdout
        self.assertRegex(fast, r"expect +fluidised, about \d+ mm high by richardson_zaki \(settled 800 mm, column 1600 mm\)\n")
        self.assertRegex(fast, r"\n +up to the top of the column if the species part into layers, over which then leave: fragments\n")
        self.assertNotIn("then leave", self.ends(DONE, "check", case, "--set", "column.outlet=screen").stdout)
        alike = self.ends(DONE, "check", case, "--set", "species.fragments.diameter=0.59 mm").stdout
        self.assertNotIn("part into layers", alike)
        self.assertIsNone(self.expected(ALONE, *slow)["bed_height_parted_m"])

    def test_a_law_without_a_balance_is_named(self):
        """Between the velocity that carries a lone particle by the law and the one at which it falls by the correlation."""
        case = self.write("bed.toml", ALONE.replace("3.9 mm/s", "4.77 mm/s"))
        found = strict_json(self.ends(DONE, "check", case, "--json").stdout)["expected"]
        self.assertGreater(found["terminal_m_s"]["fragments"], 0.00477)
        self.assertEqual((found["state"], found["bed_height_m"], found["reaches_top"]), ("fluidised", None, None))
        text = self.ends(DONE, "check", case).stdout
        self.assertRegex(text, r"(?m)^expect +fluidised; richardson_zaki has no balance at 4.77 mm/s: by it the fluid carries the solids up$")
        self.assertRegex(text, r"(?m)^steady +no time foreseen: by its drag law the fluid carries all solids to the top; ")

    def test_a_discharge_below_the_top_of_the_bed(self):
        side = RESIN.replace('"periodic"', '"wall"') + '[[discharge]]\nat = "right"\nfrom = ["1 m"]\nto = ["1.02 m"]\npressure = 0\n'
        case = self.write("bed.toml", side)
        text = self.ends(DONE, "check", case).stdout
        self.assertRegex(text, r"\n +the bed reaches discharge 1 at 1000 mm: solids leave there\n")
        self.assertRegex(text, r"(?m)^steady +no time foreseen: solids leave through a discharge; ")
        self.assertNotIn("discharge", self.ends(DONE, "check", case, "--set", "inlet.superficial_velocity=1 mm/s").stdout)
        upside_down = self.write("down.toml", side.replace('"1.02 m"', '"0.98 m"'))
        self.assertIn('a discharge from 1 to 0.98 m ends before it starts: "from" must be below "to"', self.ends(WRONG_CASE, "check", upside_down).stderr)

    def test_where_the_law_of_the_case_expands_the_bed(self):
        """At the velocities that the card gives by the law of the case its own height is 1.1, 1.3 and 1.5 times the settled one."""
        slow = ALONE.replace('"800 mm"', '"400 mm"')
        line = re.search(r"(?m)^expands by.* by laws of such beds; (.*) by richardson_zaki$", self.ends(DONE, "check", self.write("bed.toml", slow)).stdout)[1]
        for velocity, share in zip(line.split(", "), (0.1, 0.3, 0.5), strict=True):
            height = self.expected(slow, "--set", f"inlet.superficial_velocity={velocity}")["bed_height_m"]
            self.assertAlmostEqual(height / 0.4, 1 + share, delta=0.01)  # three digits of the velocity

    def test_a_bed_that_reaches_the_top_says_so(self):
        low = "--set", 'column.size=["300 mm", "0.9 m"]', "--set", "column.cells=[1,45]"
        found = self.expected(RESIN, *low)
        self.assertTrue(found["bed_height_m"] > 0.9 and found["reaches_top"] is True, found)

    def test_a_depth_that_the_case_does_not_give_is_named(self):
        """Twice the largest diameter and its skins, in which the masses are."""
        case = self.write("bed.toml", RESIN)
        mass, depth = re.search(r"(?m)^solids +resin ([\d.]+) g, fragments .* \(assumed depth ([\d.]+) mm\)$", self.ends(DONE, "check", case).stdout).groups()
        self.assertAlmostEqual(float(mass), 0.95 * 1250 * 0.3 * 0.8 * 0.6 * float(depth), delta=0.01 * float(mass))
        self.assertNotIn("assumed depth", self.ends(DONE, "check", case, "--set", "column.depth=2 mm").stdout)

    def test_a_flow_rate_in_a_wrong_unit_is_not_missing(self):
        text = FILTER.replace('superficial_velocity = "40 m/h"', 'flow_rate = "3 m"').replace('sides = "periodic"', 'sides = "periodic"\ndepth = "50 mm"')
        told = self.ends(WRONG_CASE, "check", self.write("bed.toml", text)).stderr
        self.assertIn("inlet.flow_rate = ", told)
        self.assertNotIn("missing", told)
        self.ends(DONE, "check", self.write("bed.toml", text.replace('"3 m"', '"2.4 m3/d"')))

    def test_a_cone_above_the_opening_has_an_estimate(self):
        """By hand: 0.583 of 0.6 1200 kg/m3 sqrt(9.81) (24 - 1.4 2.5 mm)^2.5 is 79.1 g/s."""
        case = self.write("cone.toml", ROUND)
        text = self.ends(DONE, "check", case).stdout
        self.assertRegex(text, r"expect +discharge of about 79\.1 g/s; .*\n +estimate by .* for a flat bottom; a steep cone discharges more")
        self.assertRegex(self.ends(DONE, "check", case, "--set", "dem.opening=12 mm").stdout, "4.8 particle diameters wide: below 5 it may block")
        other = self.write("other.toml", ROUND.replace('from = ["24 mm", "0 mm"]', 'from = ["60 mm", "0 mm"]').replace('"60 mm", "50', '"24 mm", "50'))
        self.assertRegex(self.ends(DONE, "check", other).stdout, "expect +discharge not estimated: ")


class Steady(Scratch):
    def test_it_says_when_a_bed_can_be_steady(self):
        """The top of a packed bed rises at u - u_mf: from 100 mm at 40 mm/s less the velocity that the card names."""
        case = TEMPLATES / "liquid-bed/case.toml"
        expected = strict_json(self.ends(DONE, "check", case, "--json").stdout)["expected"]
        self.assertEqual(expected["law"], "richardson_zaki")
        heights = [law["bed_height_m"] for law in expected["by_laws_of_beds"].values()]
        self.assertTrue(min(heights) <= expected["bed_height_m"] <= max(heights), heights)
        self.assertAlmostEqual(expected["rising_time_s"], (expected["bed_height_m"] - 0.1) / (0.04 - expected["u_mf_m_s"]["mixture"]), places=12)
        fines = strict_json(self.ends(DONE, "check", ROOT / "cases/filter-backwash/case.toml", "--json").stdout)["expected"]
        self.assertEqual(fines["leaving"], ["fines"])
        # layers: of these the sand lifts first, between the velocities of its two sizes
        lifting = 0.012 - (fines["bed_height_m"] - fines["settled_height_m"]) / fines["rising_time_s"]
        self.assertTrue(fines["u_mf_m_s"]["sand.1"] < lifting < fines["u_mf_m_s"]["sand.2"], lifting)
        told = [self.ends(DONE, "check", case, "--until", until).stdout for until in ("30 s", "1 s")]
        self.assertRegex(told[0], r"(?m)^steady +after [\d.]+ s at least: the top rises no faster than u - u_mf$")
        self.assertRegex(told[1], r"(?m)^steady +after .*; the run ends at 1 s, too early: see --until steady$")

    def test_it_says_when_a_bed_in_a_taper_can_be_steady(self):
        """The tube widens from 30 to 60 mm over 200 mm: u = u_0/(1 + h/200 mm)^2, and dh/(u - u_mf) summed from 100 mm to the top of the bed.
        The card sums slices of 2 mm of one width: within 2e-4. The expanded bed weighs on wider levels: its drop is less than the settled weight."""
        case = TEMPLATES / "tapered-bed/case.toml"
        found = strict_json(self.ends(DONE, "check", case, "--json").stdout)
        expected, text = found["expected"], "\n".join(found["lines"])
        fluidises, top = expected["u_mf_m_s"]["mixture"], expected["bed_height_m"]
        height = np.linspace(0.1, top, 2001)
        height = (height[1:] + height[:-1]) / 2
        inlet = expected["u_over_u_mf"] * fluidises
        time = np.mean(1 / (inlet / (1 + height / 0.2) ** 2 - fluidises)) * (top - 0.1)
        self.assertAlmostEqual(expected["rising_time_s"] / time, 1, delta=2e-4)
        self.assertRegex(text, r"(?m)^steady +after [\d.]+ s at least: if each level were even, the top rises no faster than u - u_mf$")
        self.assertRegex(text, "(?m)^validity +no measured bed of this kind; ")
        self.assertIn("wider above, the bed is denser there, turns over and stays lower", text)
        settled, expanded = re.search(r"(?m)^weight +([\d.]+) Pa in the fluid, settled; pressure drop between that and ([\d.]+) Pa, if expanded evenly$", text).groups()
        self.assertLess(float(expanded), 0.98 * float(settled))

    def test_a_bed_that_starts_loose_rises_from_there(self):
        """From 120 mm, at u less the velocity that carries solids of 0.5, which is u_mf of a bed that settles to 0.5."""
        case = TEMPLATES / "liquid-bed/case.toml"
        loose = strict_json(self.ends(DONE, "check", case, "--json", "--set", "bed.start_solids_fraction=0.5").stdout)
        carried = strict_json(self.ends(DONE, "check", case, "--json", "--set", "bed.solids_fraction=0.5").stdout)["expected"]["u_mf_m_s"]["mixture"]
        expected = loose["expected"]
        self.assertAlmostEqual(expected["rising_time_s"], (expected["bed_height_m"] - 0.12) / (0.04 - carried), places=9)
        self.assertIn("u less the velocity that carries the bed at its start", "\n".join(loose["lines"]))

    def test_it_says_where_it_foresees_no_time(self):
        for name, keys, text in (("gas-bed", [], "no time foreseen: the height swings as bubbles form and burst; --until steady ends a run once its card says steady"),
                                 ("spouted-bed", [], "no time foreseen: a jet moves only the solids on its path; --until steady .*"),
                                 ("liquid-bed", ["inlet.superficial_velocity=0.3"], "no time foreseen: the fluid carries all solids to the top; .*"),
                                 ("liquid-bed", ["inlet.superficial_velocity=0.005", "dem.held=true"], "from the start: the particles are held"),
                                 ("liquid-bed", ["inlet.superficial_velocity=0.005"], "from the start: the bed stays packed"),
                                 ("liquid-bed", ['inlet.superficial_velocity=[["0 s", "0 mm/s"], ["28 s", "40 mm/s"]]'],
                                  "after 28 s at least: the inlet changes until then; the run ends at 30 s, too early: .*")):
            shown = self.ends(DONE, "check", TEMPLATES / name / "case.toml", *(word for key in keys for word in ("--set", key))).stdout
            self.assertRegex(shown, rf"(?m)^steady +{text}$")
        elutriator = self.ends(DONE, "check", ROOT / "cases/elutriator/case.toml").stdout
        self.assertRegex(elutriator, "(?m)^steady +no time foreseen: the solids that are lifted leave first; ")

    def test_a_spouted_bed_is_partly_fluidised_before_and_after_its_run(self):
        """Its inlet alone is below u_mf, its jet above."""
        case = TEMPLATES / "spouted-bed/case.toml"
        checked = strict_json(self.ends(DONE, "check", case, "--json").stdout)
        self.assertEqual(checked["expected"]["state"], "partly_fluidised")
        self.assertRegex("\n".join(checked["lines"]), r"(?m)^expect +partly fluidised, ")
        self.assertNotRegex("\n".join(checked["lines"]), r"(?<!over )[1-9]\d\d %")  # of the weight
        self.ends(DONE, "tfm", case, "--quiet", "--no-picture", "-o", self.folder / "spout")
        self.assertEqual(strict_json((self.folder / "spout/run.json").read_text())["card"]["state"], "partly_fluidised")


if __name__ == "__main__":
    program.main()
