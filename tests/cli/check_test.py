#!/usr/bin/python3
"""What `polybed check` says a case will need, against runs of it. Usage: check_test.py PROGRAM"""
import re
import shlex
import tomllib

import program
from program import CASE, DONE, ROOT, SMALL, Scratch, peak_memory, run, small_bed, strict_json


def answer(*words):
    return strict_json(run("check", CASE, "--json", *words).stdout)


def setting(**values):
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


class Needs(Scratch):
    def test_the_text_tells_memory_scales_and_time(self):
        text = self.ends(DONE, "check", CASE, "--details").stdout
        for line in (r"3564 cells, 29160 unknowns; integrator imex", r"memory about \d+ MB: state [\d.]+, fields [\d.]+",
                     r"  at rest  \(solids fraction 0.62\): convection [\d.]+ s, drag [\d.e-]+ s, acoustics [\d.e-]+ s, "
                     r"bulk viscosity [\d.e-]+ s, expected step [\d.e-]+ s", r"  expanded \(solids fraction 0\.\d+\): ",
                     r"20 s takes about .* of computing, .* to .*: [\d.e+]+ steps of [\d.e-]+ s"):
            self.assertRegex(text, line)

    def test_the_velocities_of_an_expansion_give_these_heights(self):
        """Between the velocities of two laws, the one expects a bed higher than said, the other a lower one."""
        found = answer()["expected"]
        self.assertEqual([one["share"] for one in found["expansion"]], [0.1, 0.3, 0.5])
        for one in found["expansion"]:
            height = (1 + one["share"]) * found["settled_height_m"]
            for velocity, bound in ((one["least_m_s"], max), (one["most_m_s"], min)):
                by_law = answer(*setting(inlet__superficial_velocity=velocity))["expected"]["by_laws_of_beds"]
                self.assertAlmostEqual(bound(law["bed_height_m"] for law in by_law.values()), height, delta=1e-4 * height)
        self.assertRegex(self.ends(DONE, "check", CASE).stdout, r"(?m)^expands by    10 % at [\d.]+ to [\d.]+ mm/s, 30 % at .*, 50 % at .* mm/s by laws of such beds$")

    def test_layers_settle_to_the_sum_of_their_heights(self):
        """Of 20 mm at 0.62 and 40 mm at 0.31, which at 0.62 were 40 mm together."""
        text = "".join(line for line in CASE.read_text().splitlines(keepends=True)
                       if not line.startswith(("volume_share", "static_height", "start ")))
        layers = ["[[layer]]\nspecies = 'fine'\nheight = '20 mm'\n", "[[layer]]\nspecies = 'coarse'\nheight = '40 mm'\nsolids_fraction = 0.31\n"]
        case = self.write("layers.toml", text + "".join(layers))
        self.assertAlmostEqual(strict_json(self.ends(DONE, "check", case, "--json").stdout)["expected"]["settled_height_m"], 0.06)
        self.assertIn("(settled 60 mm, column", self.ends(DONE, "check", case).stdout)

    def test_a_bubbling_bed_of_rings_is_noted(self):
        case = program.ROOT / "cases/templates/gas-bed/case.toml"
        round_column = setting(column__shape='"axisymmetric"', column__size='["75 mm", "500 mm"]', column__cells="[7, 50]")
        self.assertIn("a bubble in the gas is a ring about the axis", self.ends(DONE, "check", case, *round_column).stdout)
        self.assertNotIn("ring about", self.ends(DONE, "check", case).stdout)

    def test_graded_cells_across_are_told(self):
        """60 mm in eight cells of ratio 1.2: 60/(2 (1 + 1.2 + 1.44 + 1.728)) = 5.5887 mm at the walls, 1.728 times as much in the middle."""
        text = self.ends(DONE, "check", CASE, *setting(column__cells="[8, 198]", column__grading_across=1.2)).stdout
        self.assertIn("cells 5.589 mm wide at the walls, each 1.2 times its neighbour, 9.657 mm in the middle", text)

    def test_scales_follow_the_case(self):
        plain, fine, viscous = answer(), answer(*setting(column__cells="[36,396]")), answer(
            *setting(effects__fluid_stress="newtonian"))
        rest, finer = plain["dt_limits"]["at_rest"], fine["dt_limits"]["at_rest"]
        for name in ("convection_s", "acoustics_s", "bulk viscosity_s"):  # all go with the size of a cell
            self.assertAlmostEqual(rest[name] / finer[name], 2, delta=1e-9)  # rounding
        self.assertAlmostEqual(rest["drag_s"] / finer["drag_s"], 1, delta=1e-9)
        self.assertNotIn("viscosity_s", rest)
        self.assertIn("viscosity_s", viscous["dt_limits"]["at_rest"])
        # 3.1313 mm is the smaller side of a cell: h/(U/eps) = 3.1313e-3 * 0.38/0.03 by hand; nothing falls faster
        self.assertAlmostEqual(rest["convection_s"], 3.1313e-3 * 0.38 / 0.03, delta=1e-5)

    def test_a_uniform_bed_has_the_height_that_a_run_measures(self):
        """A sharp top fills a slab by f: the half of the fraction below is passed (f - 1/2)/f of a slab above its centre, or for f below a half
        (1/2 - f)/(1 - f) below it."""
        for cells in (99, 160):
            found = answer(*setting(column__cells=f"[18,{cells}]"))
            keys, expanded = tomllib.loads(found["case"]), found["dt_limits"]["expanded"]
            slab, solids = keys["column"]["size"][1] / cells, keys["bed"]["static_height"] * keys["bed"]["solids_fraction"]
            whole, f = divmod(solids / expanded["solids_fraction"] / slab, 1)
            passed = whole + 0.5 + ((f - 0.5) / f if f > 0.5 else (f - 0.5) / (1 - f))
            self.assertAlmostEqual(expanded["bed_height_m"], passed * slab, delta=1e-9)

    def test_the_flow_of_jets_is_told_apart(self):
        """Half of the bottom has a jet of 40 mm/s and the rest the inlet's 30: 35 mm/s in the mean."""
        jet = '\n[[jet]]\nfrom = [0.0]\nto = [%s]\nsuperficial_velocity = 0.04\n'
        width = tomllib.loads(answer()["case"])["column"]["size"][0]
        case = self.write("jet.toml", CASE.read_text() + jet % (width / 2))
        told = self.ends(DONE, "check", case).stdout
        self.assertRegex(told, r"u = 35 mm/s is [\d.]+ times that with the jets averaged over the bottom; the inlet alone, 30 mm/s, is [\d.]+ times that")
        self.assertIn("as if the jets flowed evenly through the whole bottom", told)
        self.assertNotIn("jets", self.ends(DONE, "check", CASE).stdout)

    def test_a_start_that_a_run_would_refuse_is_refused(self):
        """Sixteen beads of 2.2 mm as random as they are given do not fit into 15 mm; and between joined ends one falls for ever."""
        beads = ('[column]\nsize = [0.01492, 0.01498]\ncells = [1, 1]\n{}[fluid]\nname = "none"\n[[species]]\nname = "a"\n'
                 'diameter = 0.00225\ndensity = 2692\n[bed]\nparticles = [{}]\nsolids_fraction = 0.547\n{}[run]\nuntil = 0.001\n')
        for ends, number, start, told in (("", 16, "", "the particles do not fit"),
                                          ('ends = "periodic"\n', 1, 'start = "settled"\n', "along joined faces particles fall for ever")):
            case = self.write("beads.toml", beads.format(ends, number, start))
            for command in ("check", "dem"):
                self.assertIn(told, self.ends(program.WRONG_CASE, command, case).stderr, command)

    def test_what_carries_a_species_away_is_named(self):
        """The fine fall at 47, the coarse at 67 mm/s: 1 m/s is above both, 1 mm/s
        above none."""
        jet = '\n[[jet]]\nfrom = [0.02]\nto = [0.04]\nsuperficial_velocity = %s\n'

        def notes(*words, jets=()):
            path = self.write("case.toml", CASE.read_text() + "".join(jet % j for j in jets))
            return [n for n in strict_json(self.ends(DONE, "check", path, "--json", *words).stdout)["notes"] if "carried" in n]
        self.assertEqual(notes(), [])
        self.assertEqual(notes(jets=["0.001"]), [])
        for species, note in zip(("fine", "coarse"), notes(jets=["1.0"])):
            self.assertRegex(note, f"^jet 1's 1 m/s is above the terminal velocity of {species}, .* as the jet keeps together")
        self.assertEqual(len(notes(jets=["1.0"])), 2)
        both = notes(*setting(inlet__superficial_velocity="1.0"), jets=["1.0"])
        self.assertEqual([n.split("'")[0] for n in both], ["the inlet", "jet 1"] * 2)

    def test_its_commands_run_as_they_are_printed(self):
        case = self.write("my case.toml", small_bed("20 ms"))
        shown = self.ends(DONE, "check", case, "--set", 'species.fine.diameter="0.9 mm"').stdout
        commands = [shlex.split(command) for command in re.search(r"(?m)^more: .*keys\); (.*)$", shown)[1].split("; ")]
        self.assertEqual([words[:2] for words in commands], [["polybed", "effects"], ["polybed", "estimate"]])
        self.assertIn('species.fine.diameter="0.9 mm"', commands[0])
        for words in commands:
            self.ends(DONE, *words[1:])

    def test_a_mixture_without_a_partition_is_told_which_to_take(self):
        sizes, told = "0.8 mm", 'note: drag = "richardson_zaki" acts on each species by itself: .*not exact'
        for other, ends in (("0.5 mm", '; take partition = "brinkman_oseen"'), (sizes, "")):
            species = ", ".join(f'{{name="{name}", diameter="{size}", density={density}}}' for name, size, density in (("a", sizes, 2650), ("b", other, 4000)))
            shown = self.ends(DONE, "check", ROOT / "cases/templates/liquid-bed/case.toml", "--set", f"species=[{species}]", "--set",
                              "bed.volume_share=[0.7, 0.3]").stdout
            self.assertRegex(shown, f"(?m)^{told}{ends}$")

    def test_memory_is_that_of_a_run(self):
        """On three sizes with either integrator: 10 % was seen; twice that for what other versions of the libraries take."""
        if "sanitizers" in run("--version").stdout:
            self.skipTest("the address sanitizer keeps memory that was given back")
        for integrator, scale in (("explicit", 1), ("explicit", 2), ("explicit", 4), ("implicit", 1), ("implicit", 2),
                                  ("implicit", 3)):
            with self.subTest(integrator=integrator, scale=scale):
                words = setting(column__cells=f"[{20 * scale},{100 * scale}]",
                                column__size=f"[{0.04 * scale},{0.2 * scale}]", tfm__integrator=integrator, run__until=0.001)
                need = answer(*words)
                parts = need["memory"]
                self.assertAlmostEqual(sum(parts.values()), need["memory_MB"], delta=1e-9 * need["memory_MB"])
                held = 1e-6 * peak_memory("tfm", CASE, *words, "--quiet", "-o", self.folder / f"{integrator}{scale}")
                self.assertAlmostEqual(need["memory_MB"], held, delta=0.2 * held)

    def test_the_screen_has_the_time_of_the_estimate(self):
        case = program.ROOT / "cases/templates/hopper/case.toml"
        told = [re.search("about (.*?) of computing", self.ends(DONE, command, case).stdout)[1] for command in ("check", "estimate")]
        self.assertEqual(*told)

    def test_time_is_of_the_order_of_that_of_a_run(self):
        """A loose test: the machine is shared. A factor of 10 is asked for."""
        for name, words in (("explicit", [*SMALL, *setting(run__until=1)]),
                            ("implicit", [*SMALL, *setting(run__until=1, tfm__integrator="implicit")])):
            with self.subTest(name):
                time = answer(*words)["time"]
                self.assertTrue(time["least_s"] < time["expected_s"] < time["most_s"], time)
                done = self.ends(DONE, "tfm", CASE, *words, "--quiet", "--json", "-o", self.folder / name)
                record = strict_json(done.stdout)
                for told, measured in ((time["expected_s"], record["cpu_s"]), (time["steps"], record["work"]["steps"])):
                    self.assertLess(told / 10, measured)
                    self.assertGreater(told * 10, measured)

    def test_a_large_case_is_answered_from_a_narrow_part_of_it(self):
        large = answer(*setting(column__cells="[180,1980]"))  # a hundred times the shipped one
        self.assertEqual(large["cells"], 100 * answer()["cells"])
        if "sanitizers" in run("--version").stdout:
            return  # the address sanitizer keeps memory that was given back
        # 356400 cells of some 2 kB; between 1 and 4 kB
        self.assertGreater(large["memory_MB"], 356)
        self.assertLess(large["memory_MB"], 1426)


if __name__ == "__main__":
    program.main()
