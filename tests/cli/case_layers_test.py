#!/usr/bin/python3
"""A bed in layers, side by side too, in both models. Usage: case_layers_test.py PROGRAM"""
import math

import program
from program import DONE, WRONG_CASE, Scratch, history, small_bed, strict_json

AMOUNT = 'volume_share = [0.8, 0.2]\nstatic_height = "12 mm"\n'
# Over 10 mm x 5 mm: 6 mm of coarse beads, on the left half of them 4 mm of fine ones.
LAYERS = """[[layer]]
species = "coarse"
height = "6 mm"
[[layer]]
species = "fine"
height = "4 mm"
solids_fraction = 0.55
from = [0]
to = ["5 mm"]
"""
VOLUME = {"coarse": 6e-3 * 0.6 * 10e-3 * 5e-3, "fine": 4e-3 * 0.55 * 5e-3 * 5e-3}
DENSITY, DIAMETER = {"coarse": 1170, "fine": 1395}, {"coarse": 2e-3, "fine": 0.8e-3}


def in_layers(until):
    text = small_bed(until)
    assert AMOUNT in text
    return text.replace(AMOUNT, "").replace('sides = "periodic"', 'sides = "periodic"\ndepth = "5 mm"') + LAYERS


class Layers(Scratch):
    def test_both_models_start_with_the_mass_of_the_layers(self):
        case = self.write("case.toml", in_layers("1 ms"))
        for model in ("tfm", "dem"):
            self.ends(DONE, model, case, "--quiet", "-o", self.folder / model)
            columns = history(self.folder / model)
            for name, volume in VOLUME.items():
                sphere = math.pi / 6 * DIAMETER[name]**3
                volume = volume if model == "tfm" else round(volume / sphere) * sphere
                mass = volume * DENSITY[name]
                self.assertAlmostEqual(columns[f"mass_{name}_kg"][0], mass, delta=1e-9 * mass)  # digits of the table

    def test_the_rest_of_the_program_reads_a_bed(self):
        case = self.write("case.toml", in_layers("1 ms"))
        answer = strict_json(self.ends(DONE, "check", case, "--json").stdout)
        self.assertEqual(answer["refused"], {"tfm": [], "dem": []})
        self.assertAlmostEqual(answer["static_height_m"], sum(VOLUME.values()) / (10e-3 * 5e-3 * 0.6), places=15)
        resolved = self.ends(DONE, "check", case, "--resolved").stdout
        again = self.ends(DONE, "check", self.write("again.toml", resolved), "--resolved").stdout
        self.assertEqual(again, resolved)
        for command in ("effects", "estimate"):
            self.ends(DONE, command, case)

    def test_a_layer_and_a_bed_can_settle_to_a_half(self):
        """The frictional pressure then begins at 0.9 of the loosest; a given onset is refused for both."""
        layered = self.write("half.toml", in_layers("1 ms").replace("solids_fraction = 0.55", "solids_fraction = 0.5"))
        bed = self.write("bed.toml", small_bed("1 ms").replace("solids_fraction = 0.6", "solids_fraction = 0.5"))
        for case in (layered, bed):
            self.assertIn("frictional_onset = 0.45\n", strict_json(self.ends(DONE, "check", case, "--json").stdout)["case"])
            refused = self.ends(WRONG_CASE, "tfm", case, "--set", "tfm.frictional_onset=0.5").stderr
            self.assertIn("solids_fraction = 0.5 of the settled bed, or of a layer, must lie above tfm.frictional_onset = 0.5", refused)

    def test_a_run_starts_from_a_checkpoint_of_the_same_bed(self):
        case = self.write("case.toml", in_layers("1 ms"))
        for model in ("tfm", "dem"):
            one, other = self.folder / model, self.folder / f"{model}-on"
            self.ends(DONE, model, case, "--quiet", "-o", one)
            self.ends(DONE, model, case, "--quiet", "-o", other, "--set", f'bed.start="checkpoint:{one / "checkpoint.h5"}"')
            for name in VOLUME:
                before, after = (history(d)[f"mass_{name}_kg"] for d in (one, other))
                self.assertAlmostEqual(after[0], before[-1], delta=1e-9 * before[-1])


if __name__ == "__main__":
    program.main()
