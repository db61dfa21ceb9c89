#!/usr/bin/python3
"""The Python package as a user's script meets it: runs, sweeps, comparisons, scans and calibrations, the gallery, and the package as
it is installed. Usage: python_test.py PROGRAM"""
import contextlib
import io
import os
import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy as np

import program
from program import ROOT, WRONG_CASE, Scratch, strict_json

sys.path.insert(0, str(ROOT / "python"))
import polybed  # noqa: E402
import polybed.program as package  # noqa: E402

CASE = ROOT / "cases/small-binary/case.toml"
GALLERY = ROOT / "python/gallery"
SHORT = {"output.every": "1 ms", "output.history_every": "0.1 ms"}
UNTIL = "10 ms"


class Package(Scratch):
    def setUp(self):
        super().setUp()
        os.environ["POLYBED"] = program.PROGRAM

    def run_short(self, model="tfm", name="run"):
        return polybed.run(CASE, model, SHORT, self.folder / name, UNTIL)

    def test_a_run_is_what_the_command_makes(self):
        run = self.run_short()
        words = ["--set", "output.every=1 ms", "--set", "output.history_every=0.1 ms"]
        program.run("tfm", CASE, *[word.replace("=", '="', 1) + '"' if "=" in word else word for word in words], "--until", UNTIL,
                    "--quiet", "-o", self.folder / "other")
        self.assertEqual(program.same_bits(run.directory / "checkpoint.h5", self.folder / "other/checkpoint.h5"), [])
        self.assertEqual(run.record["overrides"], polybed.read(self.folder / "other").record["overrides"])

    def test_numbers_come_with_their_unit(self):
        run = self.run_short()
        height = run.quantity("bed_height")
        np.testing.assert_array_equal(height, run.history["bed_height_m"])
        self.assertEqual((height.unit, run.quantity("bed_height_m").unit, len(height.time)), ("m", "m", 101))
        self.assertEqual((run.quantity("pressure_drop").unit, run.quantity("mixing").unit), ("Pa", "1"))
        phi, field = run.quantity("phi_fine", "profiles"), run.quantity("phi_fine", "fields")
        self.assertEqual((phi.values.shape, phi.unit, field.values.shape), ((11, 30), "1", (11, 30, 2)))
        self.assertEqual((run.quantity("u_coarse").unit, run.quantity("p").unit), ("m/s", "Pa"))
        with self.assertRaisesRegex(KeyError, "has no bed_heigth; did you mean bed_height_m"):
            run.quantity("bed_heigth")
        self.assertEqual(run.card, run.record["card"])
        with self.assertRaisesRegex(KeyError, "has no heat; it has .*bed_height_m"):
            run.quantity("heat")
        self.assertTrue(set(run.names()) > {"bed_height_m", "phi_fine", "u_fluid"})
        self.assertEqual(run.names("fields"), run.fields)
        self.assertRegex(repr(run.names()), "^history   bed_height_m, (.*)\nprofiles  p, phi_coarse, .*\nfields    .*, voidage$")
        self.assertRegex(repr(height), r"^Quantity of shape \(101,\) in m, 0\.\d+ to 0\.\d+ at 0 to 0\.01 s$")
        np.testing.assert_array_equal(1 - height / 2, 1 - run.history["bed_height_m"] / 2)
        for name, near in (("bed_height", "bed_height_m"), ("voidag", "voidage")):
            with self.assertRaisesRegex(AttributeError, rf"no field '{name}', only .*voidage; try run.quantity\('{near}'\)"):
                getattr(run, name)
        with self.assertRaisesRegex(KeyError, "has no bed_height in fields; it is in history$"):
            run.quantity("bed_height", "fields")

    def test_a_finished_run_is_opened_and_another_case_run_anew(self):
        record = self.run_short().directory / "run.json"
        made = record.stat().st_mtime_ns
        self.run_short()
        self.assertEqual(record.stat().st_mtime_ns, made)
        run = polybed.run(CASE, "tfm", SHORT | {"inlet.superficial_velocity": 0.03}, self.folder / "run", UNTIL)
        self.assertGreater(record.stat().st_mtime_ns, made)
        self.assertIn("[[0.0, 0.03]]", run.record["case"])

    def test_runs_of_other_overrides_have_folders_of_their_own(self):
        with contextlib.chdir(self.folder):
            one = polybed.run(CASE, "tfm", SHORT, until=UNTIL)
            before = one.history["bed_height_m"]
            other = polybed.run(CASE, "tfm", SHORT | {"inlet.superficial_velocity": 0.03}, until=UNTIL)
            self.assertNotEqual(one.directory, other.directory)
            np.testing.assert_array_equal(one.history["bed_height_m"], before)
            for run in (one, other):
                self.assertEqual(str(run.directory), f"runs/small-binary-tfm-{run.record['case_hash'][:10]}")
            swept = [polybed.sweep(CASE, "tfm.rtol", [1e-4], overrides=SHORT | {"inlet.superficial_velocity": u}, until=UNTIL)[0].directory
                     for u in (0.02, 0.03)]
            self.assertNotEqual(*swept)

    def test_a_run_whose_folder_holds_another_is_no_longer_read(self):
        one = self.run_short()
        step = one.particles
        polybed.run(CASE, "tfm", SHORT | {"inlet.superficial_velocity": 0.03}, self.folder / "run", UNTIL)
        for read in (lambda: one.history, lambda: one.profiles, lambda: one.voidage[0], lambda: one.record,
                     lambda: one.quantity("bed_height"), lambda: one.plot("history")):
            with self.assertRaisesRegex(polybed.ReplacedError, "now holds another.*polybed.read"):
                read()
        self.assertEqual(len(step), 0)
        self.assertEqual(len(polybed.read(self.folder / "run").history["time_s"]), 101)

    def test_overrides_may_be_dictionaries_and_of_numpy(self):
        table = [[0.0, 0.02], [1.0, 0.03]]
        plain = {"tfm.rtol": 1e-4, "column.cells": [2, 30], "inlet.superficial_velocity": table, "species.fine.diameter": "1 mm"}
        rich = {"tfm": {"rtol": np.float64(1e-4)}, "column": {"cells": np.array([2, 30])},
                "inlet.superficial_velocity": np.array(table), "species": {"fine": {"diameter": "1 mm"}}}
        def resolved(keys, until):
            return package.resolved(CASE, package.settings(keys, until))
        self.assertEqual(resolved(rich, np.float64(2)), resolved(plain, 2))
        self.assertNotEqual(resolved(plain, 2), resolved({}, 2))
        jet = {"from": [0.001], "to": [0.002], "superficial_velocity": np.int64(1)}
        self.assertEqual(package.settings({"jet": (jet,)}),
                         ["--set", 'jet=[{"from" = [0.001], "to" = [0.002], "superficial_velocity" = 1}]'])
        with self.assertRaisesRegex(TypeError, "tfm.rtol: a value of type NoneType"):
            polybed.run(CASE, overrides={"tfm": {"rtol": None}})

    def test_a_wrong_model_is_named_with_the_choices(self):
        for ask in (lambda: polybed.run(CASE, "TFM"), lambda: polybed.sweep(CASE, "tfm.rtol", [1e-4], "lbm")):
            with self.assertRaisesRegex(ValueError, "there is no model '(TFM|lbm)'; there are tfm, dem"):
                ask()

    def test_progress_is_shown_while_it_is_made(self):
        """A program that waits until its first line has been shown: it would fail if its lines came at its end."""
        seen = self.folder / "seen"
        script = self.write("program", f"#!/bin/sh\necho t 0.1 >&2\nfor n in $(seq 200); do [ -e {seen} ] && exit 0; sleep 0.1; done\nexit 1\n")
        script.chmod(0o755)

        class Shown(io.StringIO):
            def write(self, text):
                seen.touch()
                return super().write(text)
        os.environ["POLYBED"] = str(script)
        with contextlib.redirect_stderr(Shown()) as shown:
            package.call("tfm", tell=package.teller(False, "fine"))
        self.assertEqual(shown.getvalue(), "fine: t 0.1\n")
        script.write_text("#!/bin/sh\nprintf 't 1\\ncard\\nwarning: w\\n' >&2\n")
        for name, lines in (("a", "a: t 1\na: warning: w\n"), ("", "t 1\ncard\nwarning: w\n")):
            with contextlib.redirect_stderr(io.StringIO()) as shown:
                package.call("tfm", tell=package.teller(False, name))
            self.assertEqual(shown.getvalue(), lines, "of a run among others the card is left out")
        script.write_text("#!/bin/sh\nprintf 'remark\\nwrong:\\n  this\\n' >&2\nexit 2\n")
        with contextlib.redirect_stderr(io.StringIO()) as shown, self.assertRaisesRegex(polybed.ProgramError, "wrong:\n  this$"):
            package.call("tfm", tell=package.teller(False))
        self.assertEqual(shown.getvalue(), "remark\n", "the error is raised, not shown")
        os.environ["POLYBED"] = program.PROGRAM
        for quiet in (False, True):
            with contextlib.redirect_stderr(io.StringIO()) as shown:
                polybed.run(CASE, "tfm", SHORT, self.folder / str(quiet), UNTIL, quiet=quiet)
            (self.assertEqual if quiet else self.assertRegex)(shown.getvalue(), "" if quiet else "t 0.01.?.?/0.01 s")

    def test_a_missing_package_is_named_in_one_line(self):
        (self.folder / "h5py.py").write_text("raise ModuleNotFoundError('No module named h5py', name='h5py')")
        settings = os.environ | {"PYTHONPATH": f"{self.folder}:{ROOT / 'python'}"}
        done = subprocess.run(["/usr/bin/python3", "-c", "import polybed"], env=settings, capture_output=True, text=True)
        self.assertRegex(done.stderr.splitlines()[-1], "^ImportError: .*h5py is missing for /usr/bin/python3: apt-get install .*python3-h5py")
        self.assertNotIn("During handling", done.stderr)

    def test_a_comparison_of_given_and_of_made_runs(self):
        found = polybed.compare(CASE, tfm=self.run_short(), overrides=SHORT, until=UNTIL, output=self.folder / "both")
        self.assertEqual(found["models"]["tfm"]["directory"], str(self.folder / "run"))
        self.assertEqual(found["models"]["dem"]["directory"], str(self.folder / "both/dem"))
        self.assertIn("e_H", found["scores"])

    def test_an_inversion_point_without_a_run(self):
        found = polybed.inversion(CASE)
        told = strict_json(program.run("inversion", CASE, "--json").stdout)
        self.assertEqual(found, told)

    def test_a_calibration_returns_its_table(self):
        few = {"calibrate.particles": 100, "calibrate.strain": 1, "calibrate.discard_strain": 0.5, "calibrate.doublings": 0,
               "calibrate.seeds": 1, "calibrate.solids_fraction": [0.3, 0.45]}
        table = polybed.calibrate(ROOT / "cases/shear-box/case.toml", few, self.folder / "boxes", jobs=2)
        np.testing.assert_array_equal(table["phi"], [0.3, 0.45])
        with h5py.File(self.folder / "boxes/table.h5") as file:
            self.assertEqual(table.names(), sorted(file))
            for name in file:
                np.testing.assert_array_equal(table[name], file[name][...])
        self.assertEqual(table["p_ratio"].shape, (2, 1, 1, 1, 1))
        self.assertEqual((table.unit("p_ratio"), table.unit("phi"), table.attributes["regime"]), ("1", "1", "dry"))
        with self.assertRaisesRegex(KeyError, "has no heat; it has .*p_ratio"):
            table.unit("heat")
        boxes = {path: path.stat().st_mtime_ns for path in (self.folder / "boxes/boxes").iterdir()}
        polybed.calibrate(ROOT / "cases/shear-box/case.toml", few, self.folder / "boxes")
        self.assertEqual({path: path.stat().st_mtime_ns for path in boxes}, boxes)  # nothing was run again
        with self.assertRaisesRegex(polybed.ProgramError, "(?s)ended with 2.*must rise"):
            polybed.calibrate(ROOT / "cases/shear-box/case.toml", {"calibrate.solids_fraction": [0.45, 0.3]}, self.folder / "none")

    def test_the_units_of_a_table_of_fluidised_boxes(self):
        with h5py.File(self.folder / "table.h5", "w") as file:
            file.attrs.update({"filetype": "polybed solids table", "version": 1, "regime": "bed"})
            for name in ("phi", "p_bed", "p_bed_se", "p_bed_n", "p_bed_by_balance_se", "theta_bed", "velocity"):
                file[name] = [0.1, 0.2]
        table = polybed.read_table(self.folder / "table.h5")
        self.assertEqual([table.unit(name) for name in ("phi", "p_bed_n", "velocity", "theta_bed")],
                         ["1", "1", "m/s", "(rho_p - rho_f) g D/rho_p"])
        self.assertEqual({table.unit(name) for name in ("p_bed", "p_bed_se", "p_bed_by_balance_se")}, {"(rho_p - rho_f) g D"})
        self.assertIn("<td>velocity</td><td>m/s</td><td>2</td><td>0.1</td><td>0.2</td>", table._repr_html_())
        with h5py.File(self.folder / "table.h5", "r+") as file:
            file.attrs["version"] = 2
        with self.assertRaisesRegex(polybed.FormatError, "version 2"):
            polybed.read_table(self.folder / "table.h5")

    def test_what_the_program_refuses_is_raised_with_its_words(self):
        with self.assertRaisesRegex(polybed.ProgramError, r"(?s)^polybed\.run\(.*case\.toml.\) ended with 2.*bed.start") as caught:
            polybed.run(CASE, overrides={"bed.start": "upside down"}, output=self.folder / "none")
        self.assertEqual(caught.exception.code, WRONG_CASE)
        for keys, said in (({"tfm.rtl": 1}, "tfm.rtl: unknown key"), ({"tfm.rtol": "1 m"}, "tfm.rtol = '1 m': ")):
            with self.assertRaisesRegex(polybed.ProgramError, f"ended with 2: overrides: {said}"):
                polybed.check(CASE, keys)
        with self.assertRaisesRegex(polybed.ProgramError, "'fast': expected a number"):
            polybed.sweep(CASE, "inlet.superficial_velocity", [0.02, "fast"], output=self.folder / "none")
        self.assertFalse((self.folder / "none").exists(), "nothing has run")
        with self.assertRaisesRegex(ValueError, "a sweep needs values for tfm.rtol"):
            polybed.sweep(CASE, "tfm.rtol")
        with self.assertRaisesRegex(ValueError, "has all its values there"):
            polybed.sweep(CASE, {"tfm.rtol": [1e-3]}, [1e-4])
        with self.assertRaisesRegex(ValueError, "a sweep needs values for a key"):
            polybed.sweep(CASE, {})
        with self.assertRaisesRegex(ValueError, "'20 mm/s'} and .*0.02} are the same case"):
            polybed.sweep(CASE, "inlet.superficial_velocity", ["20 mm/s", 0.02], output=self.folder / "none")
        self.assertFalse((self.folder / "none").exists(), "nothing has run")
        for ask, counts in ((polybed.run, ({"ranks": wrong} for wrong in (0, -1, "2", 1.5))), (polybed.sweep, [{"at_once": 0}])):
            for count in counts:
                with self.assertRaisesRegex(ValueError, "= .*: a whole number from 1 on"):
                    ask(CASE, **({"key": "tfm.rtol", "values": [1e-3]} if ask is polybed.sweep else {}), **count)
        with self.assertRaisesRegex(ValueError, "keys of the case are overrides="):
            polybed.run(CASE, {"tfm.rtol": 1e-3})
        with self.assertRaisesRegex(polybed.ProgramError, r'polybed.case\("liquid-bed"\)'):
            polybed.check("liquid-bed")

    def test_a_comparison_that_a_model_refuses_makes_no_run(self):
        with self.assertRaisesRegex(polybed.ProgramError, "ended with 2: .*law of contact"):
            polybed.compare(CASE, overrides={"effects.contact": "none"}, output=self.folder / "both")
        with self.assertRaisesRegex(FileNotFoundError, "none: no such run directory"):
            polybed.compare(CASE, dem=self.folder / "none", output=self.folder / "both")
        self.assertFalse((self.folder / "both").exists())


class Gallery(Scratch):
    def test_every_script_makes_its_picture(self):
        settings = dict(os.environ, POLYBED=program.PROGRAM, PYTHONPATH=str(ROOT / "python"))
        own = shutil.copytree(GALLERY, self.folder / "own")  # a user changes a copy
        scripts = sorted(path for path in own.glob("*.py") if path.name != "common.py")
        self.assertEqual(len(scripts), 3)
        running = [subprocess.Popen(["/usr/bin/python3", script, "--short", "-o", self.folder], env=settings, text=True,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE) for script in scripts]
        for script, process in zip(scripts, running):
            told, complaint = process.communicate(timeout=program.LONGEST * 4)
            self.assertEqual(process.returncode, 0, f"{script}\n{complaint}")
            drawn = [pathlib.Path(line) for line in told.splitlines() if line.endswith(".png")]
            self.assertEqual(len(drawn), 1, told)
            self.assertTrue(drawn[0].read_bytes().startswith(b"\x89PNG"), drawn)


class Installed(Scratch):
    def test_package_and_program_find_each_other(self):
        build = pathlib.Path(program.PROGRAM).parent
        done = subprocess.run(["cmake", "--install", build, "--prefix", self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        python = self.folder / "share/polybed/python"
        settings = {name: value for name, value in os.environ.items() if name != "POLYBED"} | {"PYTHONPATH": str(python)}
        script = ("import polybed, polybed.program as p; print(polybed.__file__); print(p.program()); "
                  f"print(polybed.inversion('{self.folder}/share/polybed/cases/small-binary/case.toml')['velocity_m_s'])")
        told = subprocess.run(["/usr/bin/python3", "-c", script], env=settings, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(told.returncode, 0, told.stderr)
        package, command, velocity = told.stdout.split()
        self.assertEqual((package, command), (str(python / "polybed/__init__.py"), str(self.folder / "bin/polybed")))
        self.assertGreater(float(velocity), 0)
        # and the installed program draws with the installed package, not with that of the sources
        (python / "polybed/plot.py").write_text("def main():\n    print('drawn by what is installed')\n")
        case = self.folder / "share/polybed/cases/small-binary/case.toml"
        bare = {name: value for name, value in settings.items() if name != "PYTHONPATH"}
        ran = subprocess.run([self.folder / "bin/polybed", "tfm", case, "--until", "1 ms", "-o", self.folder / "run"],
                             env=bare, check=True, capture_output=True, text=True)
        self.assertIn("drawn by what is installed", ran.stderr)


if __name__ == "__main__":
    program.main()
