#!/usr/bin/python3
"""What a script meets of the package before any run: the bar of a sweep, errors without a traceback, packages that are missing, where
the program is found. Usage: package_test.py PACKAGE_DIRECTORY"""
import contextlib
import io
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

PACKAGE = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(PACKAGE))

import polybed  # noqa: E402
from polybed import errors, progress, runner  # noqa: E402


def shown_by(work):
    with contextlib.redirect_stderr(io.StringIO()) as shown:
        work()
    return shown.getvalue()


class Bars(unittest.TestCase):
    def test_a_bar_is_drawn_in_its_place_and_wiped(self):
        bar = progress.Bar("film")
        half = "film [" + "#" * 20 + "." * 20 + "] 1/2"
        self.assertEqual(shown_by(lambda: bar.show(1, 2)), "\r" + half)
        self.assertEqual(shown_by(lambda: bar.show(2, 2)), "\rfilm [" + "#" * 40 + "] 2/2\r" + " " * len(half) + "\r")

    def test_runs_side_by_side_count_by_the_time_that_they_have_simulated(self):
        with mock.patch.object(progress, "redrawn", return_value=True):
            bar = progress.BarOfRuns(2)
        one, other = (bar.hearer(n, name) for n, name in enumerate("ab"))
        self.assertIn("[" + "#" * 10 + "." * 30 + "] 0 of 2 done", shown_by(lambda: one("t 0.5/1 s, 2 s left  bed 37 mm\n")))
        self.assertIn("\na: warning: w", "\n" + shown_by(lambda: one("warning: w\n")).replace("\r", "\n"))
        self.assertEqual(shown_by(lambda: other("warning: w\n")), "", "one warning of all runs is shown once")
        self.assertIn("w 2", shown_by(lambda: one("warning: w 2.5e-3\n")))
        self.assertEqual(shown_by(lambda: other("warning: w 3\n")), "", "whatever its numbers are")
        self.assertEqual(shown_by(lambda: other("bed  fluidised\n")), "")
        self.assertIn("[" + "#" * 20 + "." * 20 + "] 0 of 2 done", shown_by(lambda: other("t 0.5/1 s\n")))
        self.assertIn("[" + "#" * 30 + "." * 10 + "] 1 of 2 done", shown_by(lambda: bar.finish(0, "a")))
        told = shown_by(lambda: bar.finish(1, "b"))
        self.assertTrue(told.endswith(" \ra: warning: w; and 1 more\na: warning: w 2.5e-3; and 1 more\n"), "the bar of what is done is wiped")

    def test_a_pipe_has_lines(self):
        with contextlib.redirect_stderr(io.StringIO()):
            bar = progress.BarOfRuns(2)
        one = bar.hearer(0, "a")
        self.assertEqual(shown_by(lambda: [one(f"t {t}/1 s\n") for t in (0, 0.1, 0.5, 0.5, 0.55)]), "runs: 25 % simulated, 0 of 2 done\n")
        self.assertEqual(shown_by(lambda: one("warning: w\n")), "a: warning: w\n")
        self.assertEqual(shown_by(lambda: [bar.finish(n, "a") for n in range(2)]), "1 of 2 runs done: a\n2 of 2 runs done: a\n", "one run alone warned")
        self.assertEqual(shown_by(lambda: progress.BarOfRuns(1, quiet=True).finish(0, "a")), "")


class Errors(unittest.TestCase):
    def fails(self, script, **more):
        done = subprocess.run(["/usr/bin/python3", "-c", script], env=os.environ | {"PYTHONPATH": str(PACKAGE)} | more, text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        return done.stderr

    def test_an_error_of_the_package_is_shown_without_a_traceback(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "run.json").write_text("{")
            script = Path(folder) / "script.py"
            script.write_text(f"import polybed\npolybed.read({folder!r})\n")
            done = subprocess.run(["/usr/bin/python3", script], env=os.environ | {"PYTHONPATH": str(PACKAGE)}, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            first, second = done.stderr.splitlines()
            self.assertRegex(first, f"^polybed.DamagedError: {folder}/run.json is damaged: .*; make it again")
            self.assertEqual(second, f"  {script}:2: polybed.read({folder!r})")

    def test_so_is_a_wrong_argument_of_the_user(self):
        for wrong in ("run('x.toml', 'tmf')", "read('/')", "sweep('x.toml', 'tfm.rtol', [1e-3], at_once=0)", "check('x.toml', 'tfm.rtol')",
                      "run('x.toml', ranks='2')", "run('x.toml', {'tfm.rtol': 1})", "sweep('x.toml', {'tfm.rtol': [1]}, [2])", "sweep('x.toml', {})",
                      "table('/proc/none')", "read_table('/none.h5')", "measure('/none')"):
            self.assertRegex(self.fails(f"import polybed; polybed.{wrong}"), r"^polybed\.(Argument|Missing)Error: [^\n]*\n$")

    def test_so_is_an_interrupt_within_the_package(self):
        script = "import polybed.program as program; program.settings = lambda *_: (_ for _ in ()).throw(KeyboardInterrupt); program.check('x')"
        done = subprocess.run(["/usr/bin/python3", "-c", script], env=os.environ | {"PYTHONPATH": str(PACKAGE)}, text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (-2, "polybed: stopped by the user; resume=True continues\n"))

    def test_other_errors_are_shown_as_ever(self):
        self.assertIn("Traceback", self.fails("import polybed; polybed.read(1 / 0)"))
        self.assertIn("mine", self.fails("import sys; sys.excepthook = lambda *_: sys.stderr.write('mine'); import polybed; "
                                         "raise polybed.ProgramError([], 2, 'said')"))

    def test_a_notebook_shows_the_same_line(self):
        self.assertEqual(polybed.ProgramError(["polybed"], 2, "said\n", "polybed.run('a')")._render_traceback_(),
                         ["polybed.ProgramError: polybed.run('a') ended with 2: said"])
        self.assertTrue(issubclass(errors.NoProgramError, (errors.PlainError, OSError)))

    def test_pandas_and_xarray_are_needed_by_what_returns_them_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("pandas", "xarray"):
                (Path(folder) / f"{name}.py").write_text(f"raise ModuleNotFoundError('none', name='{name}')")
            (Path(folder) / "run").mkdir()
            paths = {"PYTHONPATH": f"{folder}:{PACKAGE}"}
            for ask, name in (("frame()", "pandas"), ("dataset()", "xarray")):
                said = self.fails(f"import polybed; run = polybed.read('{folder}/run'); run._repr_html_(); run.{ask}", **paths)
                self.assertRegex(said.splitlines()[-1], f"^ImportError: Python's package {name} is missing for /usr/bin/python3.*: apt-get install "
                                                        f"python3-{name}, .* pip install {name}$")
            self.assertIn("package pandas is missing", self.fails("import polybed; polybed.table([])", **paths))


class Program(unittest.TestCase):
    """A package copied to where pip puts it finds, in this order, $POLYBED, the program installed beside it, that of the sources that it was
    installed from, and that on the path."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name).resolve()
        site = self.folder / "env/lib/python3/site-packages"
        site.mkdir(parents=True)
        self.own = runner.OWN
        runner.OWN = site / "polybed/runner.py"
        runner.OWN.parent.mkdir()
        self.addCleanup(setattr, runner, "OWN", self.own)
        kept = dict(os.environ)
        self.addCleanup(lambda: (os.environ.clear(), os.environ.update(kept)))
        os.environ.pop("POLYBED", None)
        os.environ["PATH"] = str(self.folder / "path")

    def program_at(self, *parts):
        path = self.folder.joinpath(*parts)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/bin/sh\n")
        path.chmod(0o755)
        return str(path)

    def test_the_order(self):
        with self.assertRaisesRegex(FileNotFoundError, "^there is no program polybed: build it by ./polybed .*env/bin/polybed, and not on the path"):
            runner.program()
        sources = self.folder / "sources"
        (runner.OWN.parent / "sources.txt").write_text(str(sources))
        for place in ("path/polybed", "sources/build/polybed", "env/bin/polybed"):
            found = self.program_at(place)
            sources.mkdir(exist_ok=True)
            (sources / "CMakeLists.txt").touch()
            self.assertEqual(runner.program(), found)
        os.environ["POLYBED"] = self.program_at("mine")
        self.assertEqual(runner.program(), os.environ["POLYBED"])

    def test_sources_that_are_gone_are_passed_over(self):
        (runner.OWN.parent / "sources.txt").write_text(str(self.folder / "gone"))
        self.assertIsNone(runner.sources())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
