#!/usr/bin/python3
"""Every command in a ```sh block of the README, the docs and the cases runs and ends with 0; so does every ```python block.

A block marked ```sh no-run is not run: installation, the tests themselves, what needs a display. Runs are shortened: a
`polybed tfm` line gets `--until 0.06s` in place of its own end, a `polybed dem` or `polybed compare` line 0.2 ms, and replaces an earlier run of the same page;
a sweep of `polybed cost` has runs of 2 ms; a scan for the inversion velocity is by the two-fluid model, of runs of 0.8 s; a fit
draws its rows anew once.
Each page has a folder of its own, so that it must stand alone; what only answers on a shipped case is run once for all pages, and so is a
run of a shipped case, of which the next page that asks for it in the same words gets a copy, with the pictures drawn of it.
Usage: docs_commands.py PROGRAM PAGE ...    no page: README.md and what is to be said of all pages together
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

from sources import ROOT, report, tracked

sys.path.insert(0, str(ROOT / "tests"))
import open_mpi  # noqa: E402

PYTHON = "/usr/bin/python3"
MOST_NOT_RUN = 6
SHORT = ["--until", "0.06 s", "--quiet", "--no-picture"]
SHORT_SCAN = ["--until", "0.8 s", "--set", 'output.history_every="2 ms"', *SHORT[2:]]
ALONE = {"tfm", "dem", "compare", "check", "inversion"}  # commands that start no ranks of their own
ANSWERS = {"check", "drag", "effects", "estimate", "explain", "inversion", "list", "schema"}
SHORT_DEM = ["--until", "0.2 ms", *SHORT[2:]]  # its steps are microseconds
SHORT_COST = ["--until", "2 ms"]  # a sweep runs the case a dozen times
SHORT_FIT = ["--bootstrap", "1"]


def blocks(text):
    """(mark, commands) of each block; a line that ends in a backslash goes on; a python block is one command."""
    for language, mark, body in re.findall(r"^```(sh|python)( no-run)?\n(.*?)^```", text, re.M | re.S):
        if language == "python":
            yield mark.strip(), [shlex.join([PYTHON, "-c", body])]
            continue
        body = body.replace("\\\n", " ")
        yield mark.strip(), [line.strip() for line in body.split("\n") if line.strip() and not line.startswith("#")]


def shortened(command, program):
    words = shlex.split(command, comments=True)
    words[0] = program if words[0] in ("./polybed", "polybed") else words[0]
    ranks = words[1:3] if words[0] == program and words[1] == "-n" else []
    del words[1:1 + len(ranks)]
    if len(words) > 1 and words[1] in ("tfm", "dem", "compare"):
        if "--until" in words:
            at = words.index("--until")
            del words[at:at + 2]
        words += (SHORT if words[1] == "tfm" else SHORT_DEM) + ([] if {"--resume", "--force"} & set(words) else ["--force"])
    if words[:2] == [program, "cost"] and "--until" in words:
        at = words.index("--until")
        words[at:at + 2] = SHORT_COST
    if words[:2] == [program, "fit"] and "--bootstrap" in words:
        at = words.index("--bootstrap")
        words[at:at + 2] = SHORT_FIT
    if "--scan" in words:
        words[words.index("--scan") + 1] = "tfm"
        words += SHORT_SCAN
    return words[:1] + ranks + words[1:]


def answered(words, before):
    """Whether the same command has answered before; it has read only what is shipped, and written nothing."""
    if len(words) < 2 or words[1] not in ANSWERS or {"-o", "--scan"} & set(words) or \
            any("/" in word and not word.startswith("cases/") for word in words[2:]):
        return False
    known = tuple(words) in before
    before.add(tuple(words))
    return known


def runs_of(words):
    """The folder that a run of a shipped case writes, or that of a run in its usual place that is drawn; None for any other command."""
    del words[1:3 if words[1:2] == ["-n"] else 1]
    if len(words) < 3 or "-o" in words:
        return None
    model, case = words[1:3]
    if model in ("tfm", "dem") and re.fullmatch(r"cases/[\w-]+/case\.toml", case):
        return f"runs/{case.split('/')[1]}-{model}"
    return case if words[1] == "plot" and len(words) == 3 and case.startswith("runs/") else None


class Runs:
    """Runs that an earlier page has made, by the folder that they write and the commands that wrote it."""

    def __init__(self, folder):
        self.folder, self.kept, self.done = folder, {}, {}

    def begin_page(self):
        self.done = {}  # commands that have written into a folder of this page

    def before(self, words, scratch):
        """Whether the same was run for an earlier page: its folder is put in place."""
        place = runs_of(list(words))
        if place is None:
            return False
        key = self.done.get(place, ()) + (tuple(words),)
        if key not in self.kept:
            return False
        shutil.rmtree(os.path.join(scratch, place), ignore_errors=True)
        shutil.copytree(self.kept[key], os.path.join(scratch, place))
        self.done[place] = key
        return True

    def keep(self, words, scratch):
        """After a command that ended well."""
        place = runs_of(list(words))
        if place is None or not os.path.isdir(os.path.join(scratch, place)):
            return
        key = self.done[place] = self.done.get(place, ()) + (tuple(words),)
        self.kept[key] = os.path.join(self.folder, str(len(self.kept)))
        shutil.copytree(os.path.join(scratch, place), self.kept[key])


def run(command, program, scratch):
    environment = os.environ | open_mpi.SETTINGS | open_mpi.MORE_THAN_CORES
    environment |= {"PYTHONPATH": str(ROOT / "python"), "POLYBED": os.path.abspath(program)}
    words = shortened(command, program)
    if words[0] == program and words[1] in ALONE:
        environment |= open_mpi.ONE_PROCESS
    done = subprocess.run(words, cwd=scratch, env=environment, capture_output=True, text=True,
                          timeout=300)
    return [] if done.returncode == 0 else [f"{command}\n  ended with {done.returncode}: {done.stderr[-500:]}"]


def self_test():
    assert list(blocks("```sh\na b\n```\n```sh no-run\nc\n```\n")) == [("", ["a b"]), ("no-run", ["c"])]
    assert list(blocks("```python\nprint(1)\n```\n")) == [("", [f"{PYTHON} -c 'print(1)\n'"])]
    assert shortened("./polybed tfm x --until '20 s'", "p") == ["p", "tfm", "x", *SHORT, "--force"]
    assert shortened("./polybed dem x --until '20 s'", "p") == ["p", "dem", "x", *SHORT_DEM, "--force"]
    assert shortened("./polybed -n 2 check x", "p") == ["p", "-n", "2", "check", "x"]
    assert shortened("./polybed compare x", "p") == ["p", "compare", "x", *SHORT_DEM, "--force"]
    assert shortened("./polybed inversion x --scan both", "p") == ["p", "inversion", "x", "--scan", "tfm", *SHORT_SCAN]
    assert shortened("./polybed cost x --until '1 s' --json", "p") == ["p", "cost", "x", *SHORT_COST, "--json"]
    assert "--force" not in shortened("./polybed tfm x --resume", "p")
    before = set()
    assert [answered(["p", *words.split()], before) for words in ("check cases/a", "check cases/b", "check my-bed/a", "check cases/a",
                                                                  "check my-bed/a")] == [False, False, False, True, False]
    assert run("false", "p", ".")
    assert runs_of(["p", "-n", "2", "tfm", "cases/a/case.toml", *SHORT]) == "runs/a-tfm"
    assert runs_of(["p", "plot", "runs/a-tfm"]) == "runs/a-tfm"
    assert [runs_of(["p", *words.split()]) for words in ("dem cases/a/case.toml -o b", "tfm my-bed/case.toml", "plot a --what fields",
                                                         "check cases/a/case.toml")] == 4 * [None]
    with tempfile.TemporaryDirectory() as folder:
        runs, words = Runs(os.path.join(folder, "kept")), [["p", "tfm", "cases/a/case.toml"], ["p", "plot", "runs/a-tfm"]]
        written = os.path.join(folder, "runs/a-tfm")
        os.makedirs(written)
        for again in (False, True):
            runs.begin_page()
            for n, asked in enumerate(words):
                assert runs.before(asked, folder) == again
                if not again:
                    open(os.path.join(written, str(n)), "w").close()
                    runs.keep(asked, folder)
                assert sorted(os.listdir(written)) == ["0", "1"][:n + 1]
        runs.begin_page()
        assert not runs.before(words[1], folder), "nothing to draw on this page"


if __name__ == "__main__":
    self_test()
    problems, ran, before = [], 0, set()
    program, pages = sys.argv[1], [ROOT / page for page in sys.argv[2:] or ["README.md"]]
    kept = tempfile.TemporaryDirectory()
    runs = Runs(kept.name)
    for path in pages:
        runs.begin_page()
        with tempfile.TemporaryDirectory() as scratch:
            for name in ("cases", "docs", "python"):
                os.symlink(ROOT / name, os.path.join(scratch, name))
            os.makedirs(os.path.join(scratch, "tests"))
            os.symlink(ROOT / "tests/data", os.path.join(scratch, "tests/data"))
            for command in [c for mark, commands in blocks(path.read_text()) if not mark for c in commands]:
                ran += 1
                words = shortened(command, program)
                if answered(words, before) or runs.before(words, scratch):
                    continue
                wrong = run(command, program, scratch)
                problems += [f"{path.relative_to(ROOT)}: {p}" for p in wrong]
                if not wrong:
                    runs.keep(words, scratch)
    left = sum(len(commands) for path in tracked(".md") for mark, commands in blocks(path.read_text()) if mark)
    if left > MOST_NOT_RUN:
        problems.append(f"{left} commands are marked no-run, at most {MOST_NOT_RUN}")
    print(f"{ran} commands run, {left} marked no-run in all pages")
    sys.exit(report(problems, "documented commands"))
