#!/usr/bin/python3
"""Case files as nobody means them: none of them crashes the program or passes a nan. Usage: wrong_cases_test.py PROGRAM"""
import random
import re

import program
from program import CASE, DONE, FILE, WRONG_CASE, Scratch, run_all

SEED, MUTANTS = 20240607, 200
# On a coarse grid: check takes steps to tell how long a run takes, a quarter of a second on the grid of the case.
TEXT = re.sub(rb"(?m)^cells = .*$", b"cells = [6, 60]", CASE.read_bytes())
assert b"[6, 60]" in TEXT
NUMBERS = [b"nan", b"inf", b"-inf", b"0", b"-1", b"1e308", b"-1e308", b"1e-308", b"1e30", b"1e-30", b"9223372036854775807",
           b"99999999999999999999", b'""', b'"1e400 mm"', b"[]", b"true", b"0.999999", b"3"]
NUMBER = re.compile(rb"\d+(?:\.\d+)?(?:e-?\d+)?")


def flipped(text, dice):
    changed = bytearray(text)
    for _ in range(dice.randrange(1, 4)):
        changed[dice.randrange(len(changed))] = dice.randrange(256)
    return bytes(changed)


def without_a_line(text, dice):
    lines = text.splitlines(True)
    del lines[dice.randrange(len(lines))]
    return b"".join(lines)


def with_a_line_twice(text, dice):
    lines = text.splitlines(True)
    lines.insert(dice.randrange(len(lines)), dice.choice(lines))
    return b"".join(lines)


def with_another_number(text, dice):
    number = dice.choice(list(NUMBER.finditer(text)))
    if dice.random() < 0.5:
        other = dice.choice(NUMBERS)
    else:
        other = b"%.3g" % (float(number.group()) * 10 ** dice.uniform(-3, 3))
    return text[:number.start()] + other + text[number.end():]


def cut_short(text, dice):
    return text[:dice.randrange(1, len(text))]


CHANGES = [flipped, without_a_line, with_a_line_twice, with_another_number, with_another_number, cut_short]


class WrongCases(Scratch):
    def check_all(self, contents, codes):
        """Runs check on every content, as bytes: what a program prints about garbage may hold some of it."""
        paths = [self.write(f"{n}.toml", content) for n, content in enumerate(contents)]
        answers = run_all((["check", path] for path in paths), encoding=None)
        for content, done in zip(contents, answers):
            shown = content[-2000:]
            self.assertIn(done.returncode, codes, (done.stderr[-500:], shown))
            self.assertNotRegex(done.stdout, rb"\b(nan|inf)\b", shown)
            self.assertEqual(done.returncode == DONE, done.stderr == b"", (done.stderr[-500:], shown))
            self.assertEqual(done.returncode == DONE, done.stdout != b"", shown)
        return answers

    def test_two_hundred_mutants_of_the_shipped_case(self):
        dice = random.Random(SEED)
        mutants = []
        for _ in range(MUTANTS):
            text = dice.choice(CHANGES)(TEXT, dice)
            if dice.random() < 0.3 and len(text) > 300:  # the numbers begin there
                text = dice.choice(CHANGES)(text, dice)
            mutants.append(text)
        answers = self.check_all(mutants, (DONE, WRONG_CASE, FILE))
        refused = sum(done.returncode != DONE for done in answers)
        self.assertGreater(refused, MUTANTS // 4, "the changes hardly change anything")
        self.assertLess(refused, MUTANTS, "the changes leave nothing to resolve")

    def test_garbage(self):
        dice = random.Random(SEED)
        contents = [b"", b"\n", b"\0", b"\xff\xfe", dice.randbytes(100), dice.randbytes(100000), b"[" * 100000, b"a." * 5000,
                    b"title = \"\xc3\x28\"\n" + TEXT, b"\xef\xbb\xbf", b"[[species]]\n" * 2000,
                    b"title = \"" + b"x" * 2000000, bytes(11000000)]
        self.check_all(contents, (WRONG_CASE, FILE))

    def test_a_byte_order_mark_and_dos_line_ends_are_read(self):
        text = TEXT
        answers = self.check_all([text, b"\xef\xbb\xbf" + text, text.replace(b"\n", b"\r\n")], (DONE,))
        # all but the times, which are measured, and commands, which name the file
        cases = {b"\n".join(r for r in done.stdout.split(b"\n") if b"of computing" not in r and not r.startswith(b"more:")) for done in answers}
        self.assertEqual(len(cases), 1)
        self.assertIn(b"falls at", cases.pop())

    def test_every_key_refuses_what_is_no_value(self):
        """Each number of the case in turn becomes what is none."""
        text = re.sub(rb"#.*", b"", TEXT)
        text = text[text.index(b"[column]"):]
        odd = (b"nan", b"1e309", b'"nan m"', b'""', b"-inf")
        contents = [text[:m.start()] + odd[n % len(odd)] + text[m.end():]
                    for n, m in enumerate(re.finditer(rb'"[^"\n]*\d[^"\n]*"|\b\d[\d.e-]*', text))]
        self.assertGreater(len(contents), 15)
        self.check_all(contents, (WRONG_CASE,))

    def test_odd_overrides(self):
        odd = ["=", "=1", "tfm=1", "tfm.rtol", "tfm.rtol=", "tfm.rtol=nan", "tfm.rtol=inf", "tfm..rtol=1", ".=1", "title.x=1",
               "species=1", "species.5.diameter=1", "species.=1", "bed.volume_share=[nan,1]", "column.cells=[0,0]",
               "column.cells=[-1,5]", "effects=1", "effects.drag=1", "inlet.superficial_velocity=[]", "run.until=-1",
               "inlet.superficial_velocity=[[1,1],[0,1]]", "tfm.rtol=1\nx=2", "tfm.rtol=[[[[", "tfm.rtol=1e-3\nx=2"]
        for given, done in zip(odd, run_all(["check", CASE, "--set", o] for o in odd)):
            self.assertEqual(done.returncode, WRONG_CASE, (given, done.stderr))
            self.assertIn("--set", done.stderr, given)


if __name__ == "__main__":
    program.main()
