#!/usr/bin/python3
"""The Debian package as cpack makes it, unpacked into a folder and run from there. Usage: package_test.py PROGRAM"""
import ast
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/cli"), str(ROOT / "tests"), str(ROOT / "python")]
import program  # noqa: E402
from polybed.version import __version__  # noqa: E402

CASES = "share/polybed/cases"
LONGEST = 300  # s, of a command here


def done(*words, **options):
    ended = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=LONGEST, **options)
    if ended.returncode != 0:
        raise AssertionError(f"{words}\nended with {ended.returncode}: {ended.stdout[-500:]}{ended.stderr[-2000:]}")
    return ended.stdout


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        folder = pathlib.Path(cls.scratch.name)
        done("cpack", "--config", pathlib.Path(program.PROGRAM).parent / "CPackConfig.cmake", "-B", folder / "made", cwd=folder)
        (cls.file,) = (folder / "made").glob("*.deb")
        done("dpkg-deb", "-x", cls.file, folder / "root")
        cls.usr, cls.work = folder / "root/usr", folder / "work"
        cls.work.mkdir()

    def run_there(self, *words):
        bare = {name: value for name, value in os.environ.items() if name not in ("POLYBED", "PYTHONPATH")}
        return done(*words, cwd=self.work, env=bare | {"PATH": f"{self.usr / 'bin'}:{bare['PATH']}",
                                                       "PYTHONPATH": str(self.usr / "lib/python3/dist-packages")})

    def field(self, name):
        return done("dpkg-deb", "-f", self.file, name).strip()

    def test_the_version_is_that_of_the_one_place(self):
        self.assertEqual(self.field("Version"), __version__)
        self.assertIn(f"polybed {__version__} (", self.run_there("polybed", "--version"))
        self.assertEqual(self.run_there("/usr/bin/python3", "-c", "import polybed; print(polybed.__version__)").strip(), __version__)

    def test_every_import_of_the_package_is_a_dependency(self):
        imported = set()
        for path in (ROOT / "python/polybed").rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text())):
                names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else \
                    [node.module or ""] if isinstance(node, ast.ImportFrom) and node.level == 0 else []
                imported |= {name.split(".")[0] for name in names}
        needed = {f"python3-{name}" for name in imported - sys.stdlib_module_names - {"polybed", "mpl_toolkits"}}
        depends = set(re.findall(r"[\w.+-]+(?= \(|,|$)", self.field("Depends")))
        self.assertGreaterEqual(len(needed), 4)
        self.assertLessEqual(needed | {"openmpi-bin", "libopenmpi3", "python3"}, depends)

    def test_what_it_contains(self):
        page = gzip.decompress((self.usr / "share/man/man1/polybed.1.gz").read_bytes()).decode()
        for command in ("tfm", "dem", "compare", "plot"):
            self.assertIn(f".SS polybed {command}", page)
        for told in ("simulated time", "directory of a run of polybed tfm, finished or not", "what is varied, separated by commas", "CPU seconds of an entry that is not named"):
            self.assertIn(told, " ".join(page.split()))
        completion = self.usr / "share/bash-completion/completions/polybed"
        for words, expected in (("inversion x --scan ''", ["tfm", "dem", "both"]), ("cost x --model ''", ["tfm", "dem"]),
                                ("compare --inv", ["--inversion"]), ("measure --ser", ["--series"])):
            script = f". {completion}; COMP_WORDS=(polybed {words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _polybed; echo ${{COMPREPLY[@]}}"
            self.assertEqual(done("bash", "-c", script).split(), expected)
        documents = self.usr / "share/doc/polybed"
        for name in ("copyright", "CITATION.cff", "html/index.html", "html/searchindex.js", "html/docs/reference/case.html"):
            self.assertTrue((documents / name).stat().st_size > 0, name)
        self.assertTrue((self.usr / "share/zsh/vendor-completions/_polybed").exists())
        self.assertNotIn("__pycache__", done("dpkg-deb", "-c", self.file))

    def test_a_run_with_its_picture(self):
        self.run_there("polybed", "tfm", self.usr / CASES / "small-binary/case.toml", "--until", "20 ms", "-o", "run")
        self.assertTrue((self.work / "run/picture.png").read_bytes().startswith(b"\x89PNG"))

    def test_two_ranks(self):
        self.run_there("polybed", "-n", "2", "tfm", self.usr / CASES / "small-binary/case.toml", "--until", "5 ms", "--no-picture", "-o", "two")
        self.assertIn('"ranks":2,', (self.work / "two/run.json").read_text())

    def test_python_runs_the_program_of_the_package(self):
        script = ("import polybed, polybed.program as p; print(p.program()); "
                  f"print(polybed.inversion('{self.usr / CASES}/small-binary/case.toml')['velocity_m_s'])")
        path, velocity = self.run_there("/usr/bin/python3", "-B", "-c", script).split()
        self.assertEqual(path, str(self.usr / "bin/polybed"))
        self.assertGreater(float(velocity), 0)

    def test_hard_cases_run(self):
        self.run_there("polybed", "stability", "--only", "T1", "-o", "hard")
        self.assertTrue((self.work / "hard/stability.json").exists())


class Wheel(unittest.TestCase):
    def test_pip_installs_the_package_into_an_environment(self):
        """From a copy: pip leaves files beside what it installs."""
        with tempfile.TemporaryDirectory() as scratch:
            sources, folder = pathlib.Path(scratch) / "sources", pathlib.Path(scratch) / "venv"
            sources.mkdir()
            for name in ("pyproject.toml", "setup.cfg", "setup.py", "README.md", "CMakeLists.txt"):
                shutil.copy(ROOT / name, sources)
            shutil.copytree(ROOT / "python", sources / "python", ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
            done("/usr/bin/python3", "-m", "venv", "--system-site-packages", folder)
            # --no-index: what Debian's packages lack is an error, not a download
            done(folder / "bin/pip", "install", "--no-build-isolation", "--no-index", ".", cwd=sources)
            script = (f"import polybed; assert polybed.__file__.startswith('{folder}'), polybed.__file__; print(polybed.__version__); "
                      f"case = '{ROOT}/cases/small-binary/case.toml'; print(polybed.check(case)['expected']['bed_height_m']); "
                      "run = polybed.run(case, 'tfm', {'output.history_every': '2 ms'}, until='10 ms', quiet=True); "
                      "print(run.history['bed_height_m'][-1])")
            bare = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "POLYBED")}
            (sources / "build/polybed").symlink_to(program.PROGRAM)  # the program that is built in the sources is found
            version, expected, height = done(folder / "bin/python", "-c", script, cwd=scratch, env=bare).split()
            self.assertEqual(version, __version__)
            self.assertGreater(float(expected), 0)
            self.assertGreater(float(height), 0)


if __name__ == "__main__":
    program.main()
