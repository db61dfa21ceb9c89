#!/usr/bin/python3
"""The texts for people: templates, explanations, the table of effects, drag. Usage: words_test.py PROGRAM"""
import os
import pty
import re
import subprocess
import tomllib
import unittest.mock

import program
from program import CASE, DONE, ROOT, WRONG_CASE, Scratch, run_all, small_bed, strict_json

TEMPLATES = ["binary-both-scales", "classifier", "elutriator", "filter-backwash", "gas-bed", "hopper", "liquid-bed", "round-hopper",
             "round-liquid-bed", "sphere", "spouted-bed", "tapered-bed"]
BOTH = {"binary-both-scales", "elutriator"}  # run by either model as they are
WIDTH = 100  # columns


class Templates(Scratch):
    def test_each_is_short_commented_and_a_case(self):
        for name in TEMPLATES:
            done = self.ends(DONE, "new", self.folder / name, "--from", name)
            case = self.folder / name / "case.toml"
            self.assertIn(f"polybed check {case}", done.stdout)
            lines = case.read_text().splitlines()
            self.assertLessEqual(len(lines), 48, name)
            self.assertGreater(sum(" # " in line for line in lines), 8, f"{name} explains too little")
            models = re.findall(r"polybed (tfm|dem) ", done.stdout.split("next:")[1])
            self.assertEqual(models, re.findall(r"polybed (\w+)", lines[1]))
            self.assertEqual(len(models) == 2, name in BOTH, name)
            words = ["--set", "bed.start=mixed"] if "hopper" in name else []  # settling takes seconds
            for model in models:
                end = "10 ms" if model == "tfm" else "1 ms"
                self.ends(DONE, model, case, "--until", end, "--quiet", "--no-picture", "-o", self.folder / "runs" / name / model, *words,
                          picture=True)

    def test_the_list_names_all_with_what_they_show(self):
        listed = strict_json(self.ends(DONE, "list", "cases", "--json").stdout)["cases"]
        names = [case["name"] for case in listed if case["template"]]
        self.assertEqual(names, TEMPLATES)
        self.assertEqual(sorted(case["name"] for case in listed),
                         sorted(p.parent.name for folder in ("", "templates/") for p in ROOT.glob(f"cases/{folder}*/case.toml")))
        text = self.ends(DONE, "list", "cases").stdout
        self.assertLessEqual(max(map(len, text.splitlines())), WIDTH)
        text = re.sub(r"\s+", " ", text)  # long titles go on in the next line
        for case in listed:
            self.assertTrue(case["title"] and case["takes"], case)
            self.assertIn(case["title"], text)
            self.assertIn(case["takes"], text)

    def test_laws_are_in_plain_words(self):
        text, details = (self.ends(DONE, "list", *words).stdout for words in ([], ["--details"]))
        self.assertLessEqual(max(map(len, text.splitlines())), 100)
        self.assertEqual(text.count("differs from the pressure drop"), 1)
        text, details = (re.sub(r"\s+", " ", each) for each in (text, details))  # long ones go on in the next line
        for roles in strict_json(self.ends(DONE, "list", "--json").stdout)["roles"]:
            for law in roles["laws"]:
                self.assertIn(f"{law['law']}{'*' if law['note'] else ''} {law['help']}", text)
                self.assertIn(law["source"], details)
        for symbol in ("slot ", "Cello 2009", "eq.", "Omega"):
            self.assertNotIn(symbol, text)
            self.assertIn(symbol, details)
        self.assertIn("Cello 2009, eq. 3.24", self.ends(DONE, "explain", "ergun").stdout)

    def test_printed_commands_begin_with_what_was_typed(self):
        """What the launcher hands over, as a word for a shell; else the first word of the command line."""
        with unittest.mock.patch.dict(os.environ, POLYBED_TYPED="./my polybed"):
            self.assertIn("  './my polybed' check", self.ends(DONE, "new", self.folder / "a", "--from", "sphere").stdout)
        plain = {name: value for name, value in os.environ.items() if name != "POLYBED_TYPED"}
        done = subprocess.run([program.PROGRAM, "new", self.folder / "b", "--from", "sphere"], env=plain, capture_output=True, text=True, check=True)
        self.assertIn(f"  {program.PROGRAM} check", done.stdout)

    def test_refusals(self):
        self.assertIn("did you mean 'hopper'", self.ends(WRONG_CASE, "new", self.folder / "a", "--from", "hoper").stderr)
        self.ends(DONE, "new", self.folder / "a", "--from", "hopper")
        self.assertIn("exists already", self.ends(WRONG_CASE, "new", self.folder / "a", "--from", "sphere").stderr)
        self.assertIn("--from", self.ends(WRONG_CASE, "new", self.folder / "b").stderr)


class Explain(Scratch):
    def explained(self, words):
        for word, done in zip(words, run_all([["explain", word] for word in words])):
            self.assertEqual(done.returncode, DONE, f"{word}: {done.stderr}")
            self.assertIn(word.split(".")[-1], done.stdout)

    def test_every_role_law_and_key(self):
        listed = strict_json(self.ends(DONE, "list", "--json").stdout)["roles"]
        keys = [key["key"] for key in strict_json(self.ends(DONE, "schema", "--json").stdout)["keys"]]
        words = {role["role"] for role in listed} | {f"effects.{role['role']}" for role in listed}
        words |= {law["law"] for role in listed for law in role["laws"] if "FILE" not in law["law"]}
        words |= {row["effect"] for row in strict_json(self.ends(DONE, "effects", CASE, "--json").stdout)["effects"]}
        self.explained(sorted(words | {keys[n].split(".")[-1] for n in range(0, len(keys), 7)}))

    def test_laws_to_take_come_first_with_the_bed_that_they_are_for(self):
        laws = {role["role"]: [law["law"] for law in role["laws"]] for role in strict_json(self.ends(DONE, "list", "--json").stdout)["roles"]}
        for role in ("drag", "partition", "solids_stress"):
            text = self.ends(DONE, "explain", role).stdout
            advice = strict_json(self.ends(DONE, "explain", role, "--json").stdout)["advice"]
            self.assertLessEqual(max(map(len, text.splitlines())), WIDTH)
            named = re.findall(r"(?m)^    (\S+) ", text.split("laws, or")[1])
            self.assertEqual(named[:len(advice)], [one["law"] for one in advice])
            self.assertEqual(sorted(named), sorted(laws[role]))
            for one in advice:
                self.assertRegex(text, rf"(?m)^    {one['law']} +{re.escape(one['bed'])}$")
        self.assertEqual(strict_json(self.ends(DONE, "explain", "contact", "--json").stdout)["advice"], [])

    def test_every_word_that_runs_and_studies_print(self):
        case = self.write("case.toml", small_bed("10 ms"))
        words = {"0", "2", "3", "4", "5", "130"} | set(re.findall(r'"(pareto|dominated|hollow|model|predicted)"', "".join(
            p.read_text() for p in (ROOT / "python/polybed/cost").glob("*.py"))))
        for model in ("tfm", "dem"):
            run = self.folder / model
            self.ends(DONE, model, case, "--quiet", "--no-picture", "-o", run, picture=True)
            record = strict_json((run / "run.json").read_text())
            words |= {record["state"], *(w["name"] for w in record["invariants"])}
            words |= {record["card"][key] for key in ("state", "layers") if record["card"][key]}
            words |= {limit["name"].split(" of ")[0] for limit in record.get("step", {}).get("limits", [])}
        for row in (self.folder / "tfm/steps.csv").read_text().splitlines()[1:]:
            words.add(re.split(r" at \(|: ", row.split(",", 3)[3].strip('"'))[0])
        self.assertIn("mass", words)
        self.explained(sorted(words))

    def test_every_heading_of_a_card(self):
        sources = "".join(p.read_text() for folder in ("app", "multiscale/card") for p in sorted((ROOT / folder).glob("*.cpp")))
        headings = set(re.findall(r'card_line\("([^"]+)"', sources)) | set(re.findall(r'pair\{"(\w+ at)"', sources))
        self.assertLess({"bed", "rises at", "solids", "to go on"}, headings)
        self.explained(sorted(headings | {"u_mf", "u", "mixture", "settled", "dense bed", "undecided", "u_over_u_mf", "u_mf_m_s", "terminal_m_s",
                                            "left_out", "partly_fluidised", "interval", "run_state", "lifted out", "in layers"}))

    def test_words_as_a_card_has_them(self):
        for pair in (("carried out", "carried_out"), ("geldart", "Geldart class")):
            self.assertEqual(*(self.ends(DONE, "explain", word).stdout for word in pair))
        self.explained(["recovery"])
        for column, help in (("discharge2_m3_s", "leaves there a second"), ("top_beads_kg", "has left there since"), ("centre_beads_m", "centre")):
            self.assertIn(help, self.ends(DONE, "explain", column).stdout, "a column that the case names")

    def test_what_is_unknown(self):
        self.assertIn("did you mean 'cello'?", self.ends(WRONG_CASE, "explain", "celo").stderr)
        self.assertIn("did you mean 'tfm'?", self.ends(WRONG_CASE, "tmf", CASE).stderr)
        for words in (["run", CASE], [CASE]):
            self.assertIn("polybed tfm CASE runs a case as a continuum", self.ends(WRONG_CASE, *words).stderr)
        self.assertIn("did you mean 'check'?", self.ends(WRONG_CASE, "-n", "2", "chek", CASE).stderr)

    def test_ranks_behind_the_command(self):
        for words in (["tfm", "-n", "3", CASE], ["tfm", "-n3", CASE], ["compare", CASE, "-n", "3"]):
            self.assertEqual(self.ends(WRONG_CASE, *words).stderr, f"-n stands before the command: polybed -n 3 {words[0]} ...\n")


class Effects(Scratch):
    def test_it_fits_and_its_lines_are_a_case(self):
        for case in (CASE, ROOT / "cases/taghipour/case.toml", ROOT / "cases/thesis-a/case.toml"):
            for words in ([], ["--details"]):
                text = self.ends(DONE, "effects", case, *words).stdout
                for line in text.splitlines():
                    self.assertLessEqual(len(line), WIDTH, line)
        text = self.ends(DONE, "effects", CASE).stdout
        switched = tomllib.loads(text.split("\n\n")[1])  # below the heading
        self.assertTrue(switched)
        for role in switched:
            self.assertRegex(text, rf"(?m)^\* {role} ")
        marked = set(re.findall(r"(?m)^\* (\w+) +off ", text))
        self.assertEqual(marked, set(switched))
        words = [w for role, law in switched.items() for w in ("--set", f"effects.{role}={law}")]
        again = self.ends(DONE, "effects", CASE, *words).stdout
        self.assertNotRegex(again, r"(?m)^\* \w+ +off ", "what it advises is not enough")


class Numbers(Scratch):
    def test_units_of_people(self):
        given = {"µm": '"807 µm"', "micro": '"807 μm"', "mm": '"0.807 mm"'}
        answers = {name: strict_json(self.ends(DONE, "check", CASE, "--json", "--set", f"species.fine.diameter={text}").stdout)["hash"]
                   for name, text in given.items()}
        self.assertEqual(len(set(answers.values())), 1, answers)
        for text in ("15 °C", "59 degF", "59 °F", "288.15 K"):
            case = strict_json(self.ends(DONE, "check", CASE, "--json", "--set", f"fluid.temperature={text}").stdout)["case"]
            self.assertAlmostEqual(float(re.search(r"temperature = ([\d.]+)", case)[1]), 288.15, delta=1e-12 * 288)
        units = strict_json(self.ends(DONE, "schema", "--json").stdout)["units"]
        reference = (ROOT / "docs/reference/case.md").read_text()
        for unit in units:
            self.assertIn(f"`{unit}`", reference)

    def test_drag_says_what_its_number_is(self):
        done = self.ends(DONE, "drag", "--law", "ergun", "--voidage", "0.5", "--re", "20")
        float(done.stdout)
        for part in ("f = 24.444", "Stokes", "unit 1", "law ergun", "range: within", "band: "):
            self.assertIn(part, done.stderr)
        low, high = map(float, re.search(r"band: ([\d.]+) .* to ([\d.]+) ", done.stderr).groups())
        self.assertTrue(low <= 24.445 and high >= 24.444)
        # By hand: in creeping flow Ganser's factor is (1 + 2 psi^-1/2)/3, that of Haider and Levenspiel is 1, and Ergun's 1/psi^2.
        point = ["drag", "--law", "stokes", "--voidage", "1", "--re", "1e-12", "--sphericity", "0.81", "--shape", "ganser"]
        found = strict_json(self.ends(DONE, *point, "--json").stdout)
        self.assertAlmostEqual(found["f"], (1 + 2 / 0.9) / 3, delta=1e-6)
        self.assertAlmostEqual(found["f_by_shape"]["haider_levenspiel"], 1, delta=1e-5)
        self.assertIn("sphericity 0.81, shape ganser; by ergun f = 1.5242; by haider_levenspiel f = 1", self.ends(DONE, *point).stderr)

    def test_sources_name_the_papers(self):
        listed = self.ends(DONE, "drag", "--list").stdout
        by_list = strict_json(self.ends(DONE, "drag", "--list", "--json").stdout)
        for law in (law for laws in by_list.values() for law in laws):
            self.assertIn(f"{law['name']:20} {law['help']}\n  {'':20} {law['source']}\n", listed)
        self.assertEqual({name: len(laws) > 2 for name, laws in by_list.items()}, {"laws": True, "partitions": True, "shapes": True})
        for source in ("Ergun 1952; Cello 2009, eq. 3.24", "Wen and Yu 1966; ", "Di Felice 1994; ", "Ganser 1993"):
            self.assertIn(source, listed)
        year = r"(1[89]|20)\d\d"
        own = {"brinkman_oseen", "algebraic", "film", "file:FILE", "table:FILE"}  # documented here, or what a file contains
        for roles in strict_json(self.ends(DONE, "list", "--json").stdout)["roles"]:
            for law in roles["laws"]:
                if law["law"] not in own:
                    self.assertRegex(re.sub(r"Cello 2009, eqs?. (1\.|4\.)", "thesis", law["source"]).replace("Cello 2009", ""), f"{year}|thesis", law)

    def test_colours_only_where_the_terminal_has_them(self):
        def on_terminal(**settings):
            ours, theirs = pty.openpty()
            subprocess.run([program.PROGRAM, "check", str(CASE)], stdout=theirs, env=program.environment(str(self.folder)) | settings)
            os.close(theirs)
            text = b""
            try:
                while part := os.read(ours, 65536):
                    text += part
            except OSError:  # the end of what a closed terminal has
                pass
            os.close(ours)
            return text
        self.assertIn(b"\033[1m", on_terminal(TERM="xterm"))
        self.assertNotIn(b"\033", on_terminal(TERM="xterm", NO_COLOR="1"))
        self.assertNotIn(b"\033", on_terminal(TERM="dumb"))


if __name__ == "__main__":
    program.main()
