#!/usr/bin/python3
"""Which effects a scene calls for, as a user asks and gets told; and a case that leaves them to the program."""
import re

import program
from program import CASE, DONE, ROOT, WRONG_CASE, Scratch, same_bits, strict_json

# Three seconds of settling take a second; a few hundred particles in water.
BEADS = """title = "beads in water"
[column]
size = ["12 mm", "60 mm"]
cells = [6, 30]
[fluid]
name = "water"
temperature = "20 degC"
[[species]]
name = "beads"
diameter = "1 mm"
density = 2500
[bed]
volume_share = [1]
static_height = "12 mm"
solids_fraction = 0.6
[inlet]
superficial_velocity = "30 mm/s"
[run]
until = "0.05 s"
[output]
every = "0.05 s"
"""
KEYS = {"effect", "model", "on", "number", "value", "threshold", "neglected_bound", "reason"}
CATALOGUE = {"drag", "added_mass", "history", "lift", "magnus", "brownian", "shape", "gas_slip", "fluid_stress", "solids_stress",
             "granular_temperature", "species_exchange", "contact", "rolling", "lubrication", "cohesion", "liquid_bridge", "weight",
             "pressure_gradient", "equation_of_state", "coupling", "walls", "level", "turbulence", "clusters"}


class Table(Scratch):
    def table(self, case, *words):
        answer = strict_json(self.ends(DONE, "effects", case, "--json", *words).stdout)
        return answer, {row["effect"]: row for row in answer["effects"]}

    def test_every_row_of_the_catalogue_has_its_reason(self):
        answer, rows = self.table(CASE)
        self.assertLessEqual(CATALOGUE, set(rows))
        for row in answer["effects"]:
            self.assertLessEqual(KEYS, set(row))
            self.assertTrue(row["reason"], row["effect"])
        open_ones = sum(row["neglected_bound"] for row in answer["effects"] if row["verdict"] == "undecided")
        self.assertLessEqual(answer["neglected_sum"] - open_ones, 0.02)
        text = self.ends(DONE, "effects", CASE, "--details").stdout
        for effect in CATALOGUE:
            self.assertRegex(text, rf"(?m)^[ *~?-] {effect} ")

    def test_one_screen_has_first_what_to_change(self):
        for name in ("matsuura-akehata", "taghipour", "small-binary", "templates/gas-bed", "templates/hopper"):
            case = ROOT / "cases" / name / "case.toml"
            answer, rows = self.table(case)
            lines = self.ends(DONE, "effects", case).stdout.splitlines()
            self.assertLessEqual(len(lines), 40, name)
            self.assertLessEqual(max(map(len, lines)), 100, name)
            added = [row for row in answer["effects"] if row["kind"] == "role" and row["on"] and row["in_case"] == "off"
                     and set(answer["models"]) & set(row["models"].split(", "))]
            first = next(n for n, line in enumerate(lines) if line.startswith("forces left out"))
            for row in added:
                self.assertTrue(any(line.removeprefix("# ").startswith(f'{row["effect"]} = "{row["model"]}"') for line in lines[:first]),
                                f"{name}: {row['effect']}")

    def test_reasons_are_in_plain_words(self):
        for name in ("matsuura-akehata", "templates/gas-bed", "templates/sphere", "thesis-a"):
            answer, _ = self.table(ROOT / "cases" / name / "case.toml", "--set", "chooser.purpose=transient")
            for row in answer["effects"]:
                self.assertNotRegex(row["reason"], r"St\*|C_m|tau_p|Kn\b|[<>=]=? *[\d.]|bulk|freeboard|\(.*, (packed|wall)\)|e[+-]\d\d")

    def test_a_case_for_one_model_is_advised_about_that_model(self):
        for name, model, other in (("hopper", "dem", "solids_stress"), ("gas-bed", "tfm", "contact"), ("sphere", "dem", "solids_stress")):
            case = ROOT / "cases/templates" / name / "case.toml"
            self.assertEqual(self.table(case)[0]["models"], [model])
            text = self.ends(DONE, "effects", case).stdout
            self.assertNotRegex(text, rf"\b{other}\b")
            self.assertRegex(text, rf"as the case is: {model} [^,]*\n")
        self.assertFalse(self.table(ROOT / "cases/templates/hopper/case.toml")[1]["solids_stress"]["on"])
        self.assertEqual(self.table(ROOT / "cases/templates/binary-both-scales/case.toml")[0]["models"], ["tfm", "dem"])

    def test_what_shortens_the_steps_is_told_before_it_is_switched_on_and_after(self):
        case, off = ROOT / "cases/templates/binary-both-scales/case.toml", ["--set", "effects.lubrication=none"]
        steps = [strict_json(self.ends(DONE, "check", case, "--json", *words).stdout)["dem"]["step"]["dt_s"] for words in ([], off)]
        told = re.search(r'lubrication = "wet_restitution" makes polybed dem take ([\d.]+) times as long', self.ends(DONE, "check", case).stdout)[1]
        self.assertEqual(told, f"{steps[1] / steps[0]:.2g}")
        self.assertGreater(float(told), 1.25)
        text = re.sub(r"\s+#?\s*", " ", self.ends(DONE, "effects", case, *off).stdout)
        self.assertIn(f"polybed dem takes {told} times as long with it", text)
        self.assertNotIn("times as long", self.ends(DONE, "check", case, *off).stdout)

    def test_the_two_fluid_model_leaves_out_what_only_particles_have(self):
        case = self.write("hand.toml", BY_HAND)
        for words in ([], ["--set", "effects.magnus=rubinow_keller"]):
            answer, rows = self.table(case, *words)
            of_choice, of_case = answer["neglected_sum_by_model"], answer["neglected_sum_of_case_by_model"]
            self.assertEqual(of_choice["dem"], answer["neglected_sum"])
            self.assertEqual(of_case["dem"], answer["neglected_sum_of_case"])
            # What is on takes nothing from the sum of a model that has no law of it; of a band the top counts.
            bounds = {effect: max(rows[effect]["value"], rows[effect].get("band", [0, 0])[1]) for effect in ("magnus", "cohesion", "brownian")}
            on = sum(bound for effect, bound in bounds.items() if rows[effect]["on"])
            self.assertAlmostEqual(of_choice["tfm"] - of_choice["dem"], on, places=12)
            self.assertAlmostEqual(of_case["tfm"] - of_case["dem"], bounds["magnus"] if words else 0, places=12)
            self.assertGreater(bounds["magnus"], 0)

    def test_the_card_and_the_table_say_the_same(self):
        """Where more is left out than allowed the card names what to do, and the table does not say that all can stay."""
        hand = self.write("hand.toml", BY_HAND)
        off = self.write("off.toml", BEADS + '[effects]\ndrag = "wen_yu"\nfluid_stress = "none"\n')
        for case, words in ((hand, []), (off, []), (hand, ["--set", "effects.fluid_stress=newtonian"]),
                            (hand, ["--set", "dem.hamaker_constant=1e-16"]), (ROOT / "cases/classifier/case.toml", []),
                            (ROOT / "cases/templates/liquid-bed/case.toml", [])):
            text = self.ends(DONE, "effects", case, *words).stdout
            screen = self.ends(DONE, "check", case, *words).stdout
            for _, said in re.findall(r"left out +(tfm|dem): (.*)", screen):
                named = re.findall(r"matters?; (.*)", said)
                self.assertEqual("Nothing to change" in text and bool(named), False, screen)
                for part in named[0].split("; ") if named else []:
                    self.assertIn(part, " ".join(text.split()), text)

    def test_what_is_undecided_is_said_and_counted(self):
        """Above Re_p 1 no more than a range is known of the history force: by its upper end it counts."""
        case = self.write("hand.toml", BY_HAND)
        words = ["--set", "chooser.purpose=transient"]
        answer, rows = self.table(case, *words)
        history = rows["history"]
        self.assertEqual((history["verdict"], history["on"]), ("undecided", None))
        self.assertGreater(history["band"][1], 0.02)
        self.assertEqual(history["neglected_bound"], history["band"][1])
        self.assertGreaterEqual(answer["neglected_sum_by_model"]["dem"], history["band"][1])
        text = self.ends(DONE, "effects", case, *words).stdout
        self.assertRegex(text, r"(?m)^\? history +off +undecided")
        self.assertNotRegex(text, r"off, and not needed:[^:]*history")
        self.assertIn('# history = "basset"', text)

    def test_an_effect_that_the_sum_leaves_open_is_offered(self):
        """Lift alone is within the tolerance, but not with what tfm has no law for."""
        text = self.ends(DONE, "effects", ROOT / "cases/templates/gas-bed/case.toml").stdout
        self.assertIn("tfm: undecided, try with and without: lift", text)
        self.assertTrue(text.startswith("lines for [effects]"), text)
        self.assertRegex(text, r'(?m)^# lift = "saffman_mei" +# undecided: 0 % to 1\.5 % of the weight$')
        self.assertRegex(text, r"(?m)^\? lift +off +undecided")
        self.assertNotRegex(text, r"off, and not needed:[^:]*lift")

    def test_the_drag_law_is_judged(self):
        """By hand: Stokes' law carries the packed bed at 1e-6/18e-3 1500 9.81 0.4 m/s = 327 mm/s, where a bead falls at 150."""
        case = self.write("hand.toml", BY_HAND)
        for law, advised in (("stokes", "richardson_zaki"), ("batchelor", "richardson_zaki"), ("cello", "richardson_zaki"), ("richardson_zaki", "richardson_zaki")):
            words = ["--set", f"effects.drag={law}"]
            row = self.table(case, *words)[1]["drag"]
            self.assertEqual((row["model"], row["in_case"]), (advised, law))
            told = self.ends(DONE, "check", case, *words).stdout
            self.assertEqual("made for one sphere" in told, law == "stokes")
        for name in ("templates/liquid-bed", "classifier", "templates/binary-both-scales", "templates/gas-bed", "templates/sphere"):
            row = self.table(ROOT / "cases" / name / "case.toml")[1]["drag"]
            self.assertEqual(row["model"], row["in_case"], name)

    def test_ranges_widen_and_tolerance_decides(self):
        case = self.write("beads.toml", BEADS)
        narrow, wide = self.table(case)[1], self.table(case, "--set", 'chooser.velocity_range=["0 mm/s", "2 m/s"]')[1]
        self.assertGreater(wide["lift"]["zones"]["freeboard"], narrow["lift"]["zones"]["freeboard"])
        # At the walls Re_p stays below 100, where lift is a number and no band.
        at_walls = ["--set", 'chooser.zones=["wall"]']
        self.assertFalse(self.table(case, *at_walls, "--set", "chooser.tolerance=0.2")[1]["lift"]["on"])
        self.assertTrue(self.table(case, *at_walls, "--set", "chooser.tolerance=1e-4")[1]["lift"]["on"])
        transient = self.table(case, "--set", "chooser.purpose=transient")[1]
        self.assertTrue(transient["added_mass"]["on"])
        self.assertFalse(self.table(case)[1]["added_mass"]["on"])

    def test_zones_can_be_chosen(self):
        rows = self.table(CASE, "--set", 'chooser.zones=["wall"]')[1]
        self.assertEqual(list(rows["lift"]["zones"]), ["wall"])

    def test_a_sphericity_below_one_calls_for_its_factor(self):
        case, below = self.write("shapes.toml", BEADS), ("--set", "species.beads.sphericity=0.8")
        self.assertFalse(self.table(case)[1]["shape"]["on"])
        row = self.table(case, *below)[1]["shape"]
        self.assertEqual((row["on"], row["model"]), (True, "ergun"))
        self.assertIn("beads has a sphericity of 0.8", row["reason"])
        shaped, spheres = (self.ends(DONE, "check", case, *below, "--json", "--set", f"effects.shape={law}").stdout for law in ("auto", "none"))
        self.assertIn("shape = ergun", shaped)
        self.assertRegex(spheres, "off in the case, but needed: .*shape")
        expected = [strict_json(text)["expected"] for text in (shaped, spheres)]
        for of in ("terminal_m_s", "u_mf_m_s"):
            self.assertLess(expected[0][of]["beads"], 0.95 * expected[1][of]["beads"])

    def test_what_is_wrong_is_told(self):
        done = self.ends(WRONG_CASE, "effects", CASE, "--set", 'chooser.velocity_range=["5 mm/s", "1 mm/s"]')
        self.assertIn("chooser.velocity_range", done.stderr)

    def test_roles_that_contradict_each_other_are_told_with_both_lines(self):
        case = self.write("wrong.toml", BEADS + '[effects]\ncontact = "hertz"\ndrag = "cello"\nmagnus = "rubinow_keller"\n')
        line = len(BEADS.splitlines()) + 2
        noted = strict_json(self.ends(DONE, "check", case, "--json").stdout)  # the two-fluid model has neither
        self.assertEqual(noted["refused"]["tfm"], [])
        for told in (self.ends(WRONG_CASE, "dem", case).stderr, "\n".join(noted["refused"]["dem"]), "\n".join(noted["notes"])):
            self.assertIn(f"wrong.toml:{line}:1: polybed dem cannot run it: effects.contact", told)
            self.assertIn(f"wrong.toml:{line + 2}:1: polybed dem cannot run it: effects.magnus", told)


class Auto(Scratch):
    def test_the_resolved_case_of_an_auto_run_gives_the_same_bits(self):
        for model, files in (("tfm", ["fields.h5", "profiles.h5"]), ("dem", ["particles.h5", "fields.h5"])):
            case = self.write("auto.toml", 'effects = "auto"\n' + BEADS)
            first, second = self.folder / f"{model}-auto", self.folder / f"{model}-resolved"
            self.ends(DONE, model, case, "-o", first, "--quiet", "--no-picture")
            record = strict_json((first / "run.json").read_text())
            resolved = self.write(f"{model}.toml", record["case"])
            self.assertNotIn('"auto"', record["case"].split("[effects]")[1].split("[")[0])
            self.assertIn('drag = "richardson_zaki"', record["case"])
            self.ends(DONE, model, resolved, "-o", second, "--quiet", "--no-picture")
            for name in files:
                self.assertEqual(same_bits(first / name, second / name), [], name)
            self.assertEqual(record["case"], strict_json((second / "run.json").read_text())["case"])

    def test_one_role_can_be_left_to_it(self):
        case = self.write("one.toml", BEADS + '[effects]\nothers = "none"\n'
                          'drag = "ergun"\nlubrication = "auto"\ncontact = "hertz_mindlin"\n')
        shown = self.ends(DONE, "check", case, "--resolved").stdout
        self.assertIn('lubrication = "wet_restitution"', shown)
        self.assertIn('drag = "ergun"', shown)
        self.assertIn('chosen = ["lubrication"]', shown)

    def test_roles_left_out_are_chosen_told_and_recorded_unless_the_case_says_none(self):
        case = self.write("bare.toml", BEADS + '[effects]\ndrag = "cello"\nfluid_stress = "none"\n')
        told = self.ends(DONE, "tfm", case, "-o", self.folder / "bare", "--no-picture").stderr
        self.assertRegex(told, "effects that the case does not name: .*solids_stress = .* off, chosen by polybed effects")
        self.assertEqual(told.count("off in the case, but needed: fluid_stress"), 2)  # at start and end
        record = strict_json((self.folder / "bare/run.json").read_text())
        self.assertIn('solids_stress = "', record["case"])
        self.assertNotIn('fluid_stress = "', record["case"])
        self.assertEqual(record["neglected"]["called_for"], ["fluid_stress"])
        chosen = re.search(r"chosen = \[(.*)\]", record["case"])[1]
        self.assertIn("solids_stress", chosen)
        self.assertNotIn("drag", chosen)
        self.assertIn("but needed: fluid_stress", self.ends(DONE, "check", case).stdout)
        alone = self.write("alone.toml", BEADS + '[effects]\nothers = "none"\ndrag = "cello"\nfluid_stress = "newtonian"\n')
        told = self.ends(DONE, "tfm", alone, "-o", self.folder / "alone", "--no-picture").stderr
        self.assertNotIn("does not name", told)
        self.assertIn("but needed: solids_stress", told)

    def test_the_time_of_an_auto_run_is_told(self):
        told = strict_json(self.ends(DONE, "estimate", self.write("auto.toml", 'effects = "auto"\n' + BEADS), "--json").stdout)
        self.assertEqual(told["model"], "tfm")

    def test_without_a_fluid_what_needs_one_is_off_and_surfaces_adhere_as_weighed(self):
        """By hand: rough surfaces pull with A R/(12 z^2) of their asperities, across nothing with A = 1e-19 J."""
        dry = re.sub(r"(?s)\[fluid\].*?\[\[", '[fluid]\nname = "none"\n[[', BEADS).replace(
            '[inlet]\nsuperficial_velocity = "30 mm/s"\n', "").replace('"1 mm"', '"20 um"').replace(
            'volume_share = [1]\nstatic_height = "12 mm"', 'particles = [10000]').replace("[6, 30]", '[6, 30]\ndepth = "60 um"')
        case = self.write("dry.toml", 'effects = "auto"\n' + dry)
        resolved = strict_json(self.ends(DONE, "check", case, "--json").stdout)["case"]
        self.assertIn('cohesion = "van_der_waals"', resolved)
        self.assertIn("hamaker_constant = 1e-19", resolved)
        self.assertNotIn("drag", resolved.split("[effects]")[1].split("[")[0])
        rows = {row["effect"]: row for row in strict_json(self.ends(
            DONE, "effects", case, "--json", "--set", "dem.surface_tension=0.07").stdout)["effects"]}
        self.assertIsNotNone(rows["liquid_bridge"]["value"])
        self.assertTrue(rows["liquid_bridge"]["reason"])


# What the bed of beads has by hand; the spin of particles and the lift are left out.
BY_HAND = BEADS + """[effects]
others = "none"
drag = "cello"
solids_stress = "frictional"
contact = "hertz_mindlin"
"""


class Neglected(Scratch):
    """A shipped case that names all of its roles and nothing of the chooser, by both models."""
    SHIPPED = program.ROOT / "cases/small-binary/case.toml"
    END = {"tfm": "20 ms", "dem": "1 ms"}

    def record(self, model, name, *words):
        done = self.ends(DONE, model, self.SHIPPED, "-o", self.folder / name, "--no-picture", "--until", self.END[model], *words)
        return strict_json((self.folder / name / "run.json").read_text()), done.stderr

    def test_every_run_tells_what_it_leaves_out_and_its_bound(self):
        weighed = strict_json(self.ends(DONE, "effects", self.SHIPPED, "--json").stdout)
        values = {row["effect"]: row["value"] for row in weighed["effects"]}
        for model, named in (("tfm", "two-fluid model"), ("dem", "particle model")):
            record, told = self.record(model, model, "--details")
            self.assertNotIn("promise", record)  # nothing is watched
            neglected = record["neglected"]
            rows = {row["effect"]: row for row in neglected["rows"]}
            self.assertEqual(rows["cohesion"]["bound"], values["cohesion"])
            self.assertGreater(rows["cohesion"]["bound"], 0)
            self.assertAlmostEqual(neglected["sum"], sum(row["bound"] or 0 for row in rows.values() if row["summed"]), places=12)
            self.assertEqual(neglected["sum"], weighed["neglected_sum_of_case_by_model"][model])
            self.assertEqual(neglected["promise"], 0.02)
            lines = told.splitlines()
            first = next(n for n, line in enumerate(lines) if line.startswith(f"left out of the {named}"))
            self.assertIn(f"forces of {neglected['sum']:.2g} of the weight (promise 0.02: more than promised)", lines[first])

    def test_an_effect_that_is_on_is_left_out_by_the_model_without_it_alone(self):
        """The fluid's own viscosity, which both models have, and the pull of surfaces, which only particles have."""
        on = ["--set", "effects.fluid_stress=newtonian", "--set", "effects.cohesion=van_der_waals", "--set", "dem.hamaker_constant=1e-20"]
        for model in ("tfm", "dem"):
            off_rows, on_rows = ({row["effect"]: row for row in self.record(model, model + name, "--quiet", *words)[0]["neglected"]["rows"]}
                                 for name, words in (("off", ["--set", "effects.fluid_stress=none"]), ("on", on)))
            self.assertEqual(off_rows["fluid_stress"]["why"], "off in the case")
            self.assertGreater(off_rows["fluid_stress"]["bound"], 0)
            self.assertNotIn("fluid_stress", on_rows)
            self.assertIn("cohesion", off_rows)
            self.assertEqual("cohesion" in on_rows, model == "tfm")

    def test_quiet_runs_print_nothing_of_it(self):
        self.assertNotIn("left out", self.record("tfm", "quiet", "--quiet")[1])


if __name__ == "__main__":
    program.main()
