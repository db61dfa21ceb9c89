#!/usr/bin/python3
"""The golden table of scenes by the command: `polybed effects CASE --json` of case files that say what the table says of them.

Numbers as printed in the specification, two digits: within 5 %. effects_golden_test.cpp asks the same of the functions behind it.
"""
import program
from program import DONE, Scratch, strict_json

# Diameter mm, density, fluid's density, kg/m3, its viscosity, Pa s, velocity, mm/s, voidage, width, mm; then least St* of an impact (0: the
# table has none of that species), added mass, history, lift, Magnus, fluid stress, van der Waals, shear rate x tau_p. None: a band.
SCENES = {
    "A1": (0.645, 3950, 1070, 0.14, 1.8, 0.76, 38.1, 0.0011, 0.21, 0.0040, 0.0039, 2.1e-5, 0.081, 1.3e-4, 1.0e-4),
    "A2": (1.079, 2910, 1070, 0.14, 1.8, 0.76, 38.1, 0, 0.26, 0.0038, 0.0036, 3.3e-5, 0.14, 4.4e-5, 2.1e-4),
    "B1": (0.807, 1395, 999.19, 1.14e-3, 30, 0.87, 60, 1.0, 0.34, 0.090, 0.017, 0.0086, 0.087, 4.9e-4, 0.062),
    "B2": (2.010, 1170, 999.19, 1.14e-3, 30, 0.87, 60, 0, 0.38, 0.084, 0.014, 0.020, 0.18, 7.3e-5, 0.23),
    "C1": (0.214, 2450, 996.59, 0.85e-3, 12.5, 0.84, 16.8, 0.25, 0.24, 0.043, 0.029, 0.0016, 0.083, 0.0071, 0.020),
    "C2": (0.776, 1500, 996.59, 0.85e-3, 12.5, 0.84, 16.8, 0, 0.34, 0.034, 0.012, 0.0045, 0.28, 4.3e-4, 0.14),
    "S": (9.5, 7780, 1000, 1e-3, 500, 0.999, 40, 870, 0.061, 0.011, None, None, 4.0, 1.7e-8, 0),
    "G": (0.5, 2500, 1.2, 1.8e-5, 600, 0.45, 100, 2100, 0.0011, 0.015, 0.0028, 0.0029, 0.016, 0.0032, 33),
    "F": (0.06, 1500, 1.2, 1.8e-5, 10, 0.45, 100, 2.5, 0.0019, 5.6e-4, 0.0022, 2.5e-5, 0.018, 3.1, 0.050),
    "K": (0.01, 2500, 1.2, 1.8e-5, 5, 0.5, 100, 0.31, 9.6e-4, 6.1e-4, 0.0058, 1.8e-5, 0.021, 410, 0.0076),
    "L": (3, 300, 1000, 1e-3, 50, 0.9, 200, 3.0, 0.69, 0.014, None, None, 0.073, 5.4e-6, 0.044),
}
NUMBERS = ["lubrication", "added_mass", "history", "lift", "magnus", "fluid_stress", "cohesion", "solids_stress"]
ASKED = ["added_mass", "history", "lift", "magnus", "brownian", "gas_slip", "fluid_stress", "lubrication", "cohesion"]
# Species, purpose, and what is on beside drag and contact, with the stress of the solids. "frictional" stands where the table says
# "stress table" and the case has none.
CHOICES = [
    (["A1", "A2"], "steady", "fluid_stress lubrication frictional"),
    (["B1", "B2"], "steady", "magnus fluid_stress lubrication frictional"),
    (["C1", "C2"], "steady", "lift fluid_stress lubrication frictional"),
    (["S"], "transient", "added_mass fluid_stress lubrication frictional"),
    (["G"], "steady", "fluid_stress kinetic"),
    (["F"], "steady", "fluid_stress lubrication cohesion frictional"),
    (["K"], "steady", "gas_slip fluid_stress lubrication cohesion frictional"),
    (["L"], "steady", "added_mass fluid_stress lubrication frictional"),
]


def case_of(names, purpose):
    """A case file of the species of a scene: heavy ones in an upward stream, light ones in a downward one."""
    _, density, fluid, viscosity, velocity, voidage, width, *_ = SCENES[names[0]]
    species = "".join(f'[[species]]\nname = "{name}"\ndiameter = "{SCENES[name][0]} mm"\ndensity = {SCENES[name][1]}\n' for name in names)
    return f"""title = "{' and '.join(names)}"
[column]
size = ["{width} mm", "1 m"]
cells = [1, 50]
sides = "wall"
[fluid]
name = "fluid"
density = {fluid}
viscosity = {viscosity}
{species}[bed]
volume_share = {[1 / len(names)] * len(names)}
static_height = "100 mm"
solids_fraction = 0.6
[inlet]
superficial_velocity = "{velocity if density > fluid else -velocity} mm/s"
[effects]
drag = "cello"
[chooser]
purpose = "{purpose}"
zones = ["wall"]
voidage = {voidage}
[run]
until = 1
[output]
every = 1
"""


class Golden(Scratch):
    def rows(self, names, purpose):
        answer = strict_json(self.ends(DONE, "effects", self.write("scene.toml", case_of(names, purpose)), "--json").stdout)
        return answer, {row["effect"]: row for row in answer["effects"]}

    def test_numbers(self):
        for name, scene in SCENES.items():
            _, rows = self.rows([name], "transient")
            for effect, expected in zip(NUMBERS, scene[7:]):
                with self.subTest(scene=name, effect=effect):
                    if expected:
                        self.assertAlmostEqual(rows[effect]["value"] / expected, 1, delta=0.05)

    def test_choices(self):
        for names, purpose, expected in CHOICES:
            _, rows = self.rows(names, purpose)
            on = [effect for effect in ASKED if rows[effect]["on"]] + [rows["solids_stress"]["model"]]
            with self.subTest(scene=names):
                self.assertEqual(" ".join(on), expected)

    def test_species_share_the_drag_that_the_stress_is_held_against(self):
        """0.28 of the coarse of C alone is 0.197 among as many fine."""
        self.assertAlmostEqual(self.rows(["C2"], "steady")[1]["fluid_stress"]["value"] / 0.28, 1, delta=0.05)
        self.assertAlmostEqual(self.rows(["C1", "C2"], "steady")[1]["fluid_stress"]["value"] / 0.197, 1, delta=0.05)


if __name__ == "__main__":
    program.main()
