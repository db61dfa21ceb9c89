#!/usr/bin/python3
"""What polybed check expects of layers, weirs and hoppers. Usage: expected_test.py PROGRAM"""
import re

import program
from program import DONE, FILTER, WRONG_CASE, Scratch, strict_json

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
        self.assertNotRegex(text, r"(?m)^steady ")
        text = self.ends(DONE, "check", case, *low, "--set", "column.outlet=screen").stdout
        self.assertNotIn("solids leave", text)
        self.assertRegex(text, r"(?m)^steady ")

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


if __name__ == "__main__":
    program.main()
