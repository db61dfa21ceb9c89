#!/usr/bin/python3
"""The launcher on a machine that lacks a package: what it asks, installs and shows. Stand-ins take the place of the system's tools.
Usage: launcher_test.py PROGRAM"""
import os
import pty
import re
import shutil
import subprocess

import program
from program import DONE, FILE, ROOT, Scratch, WRONG_CASE

SOURCES = re.findall(r"(?m)^add_subdirectory\((\w+)\)", (ROOT / "CMakeLists.txt").read_text())
FOLDERS = ("cmake", *SOURCES, "python/polybed")
TOOLS = {
    "id": "echo 0",
    "dpkg-query": "echo 'unknown ok not-installed'",
    "apt-get": 'echo "$*" >>"$ROOT/installed"',
    "cmake": """case $1 in --build) ;; *) exit 0 ;; esac
for n in 1 2 3 4 5 6 7 8; do echo "[$n/8] Building"; done
[ -z "${BROKEN:-}" ] || { echo "a.cpp: error: broken"; exit 1; }
printf '#!/bin/sh\\necho "ran $*"\\n' >"$ROOT/build/polybed"
chmod +x "$ROOT/build/polybed" """,
}


class Launcher(Scratch):
    def setUp(self):
        super().setUp()
        for name in FOLDERS:
            (self.folder / name).mkdir(parents=True)
        for name in ("CMakeLists.txt", "python/polybed/version.py"):
            (self.folder / name).touch()
        (self.folder / "cmake/packages.txt").write_text("g++\nopenmpi-bin\n")
        shutil.copy(ROOT / "polybed", self.folder)
        (self.folder / "tools").mkdir()
        for name, body in TOOLS.items():
            tool = self.folder / "tools" / name
            tool.write_text(f"#!/bin/sh\n{body}\n")
            tool.chmod(0o755)
        self.settings = {name: value for name, value in os.environ.items() if name not in ("CI", "POLYBED_YES")}
        self.settings |= {"PATH": f"{self.folder / 'tools'}:/usr/bin:/bin", "ROOT": str(self.folder)}

    def installed(self):
        path = self.folder / "installed"
        return path.read_text() if path.exists() else ""

    def on_terminal(self, answer, **settings):
        """Code, standard output, and what a terminal shows of the launcher when somebody types an answer."""
        ours, its = pty.openpty()
        with subprocess.Popen([self.folder / "polybed", "list"], stdin=its, stdout=subprocess.PIPE, stderr=its, text=True,
                              env=self.settings | settings) as child:
            os.close(its)
            os.write(ours, answer.encode() + b"\n")
            printed, shown = child.stdout.read(), b""
            try:
                while part := os.read(ours, 4096):
                    shown += part
            except OSError:  # so Linux says that the other end is closed
                pass
        os.close(ours)
        return child.returncode, printed, shown.decode()

    def piped(self, **settings):
        done = subprocess.run([self.folder / "polybed", "list"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              env=self.settings | settings, timeout=program.LONGEST)
        return done.returncode, done.stdout, done.stderr

    def test_on_a_terminal_root_is_asked(self):
        code, printed, shown = self.on_terminal("n")
        self.assertEqual((code, printed, self.installed()), (FILE, "", ""))
        self.assertIn("install these Debian packages: g++ openmpi-bin? [Y/n]", shown)
        self.assertIn("apt-get install -y --no-install-recommends g++ openmpi-bin", shown)
        for answer in ("", "y"):
            shutil.rmtree(self.folder / "build", ignore_errors=True)
            code, printed, shown = self.on_terminal(answer)
            self.assertEqual((code, printed), (DONE, "ran list\n"), shown)
            self.assertIn("install -y --no-install-recommends g++ openmpi-bin", self.installed())
            self.assertIn("\rpolybed: building,  50 %", shown)

    def test_nobody_is_asked_without_a_terminal_or_by_wish(self):
        for end in (self.piped, lambda: self.on_terminal("n", CI="true"), lambda: self.on_terminal("n", POLYBED_YES="1")):
            shutil.rmtree(self.folder / "build", ignore_errors=True)
            (self.folder / "installed").unlink(missing_ok=True)
            code, printed, shown = end()
            self.assertEqual((code, printed), (DONE, "ran list\n"), shown)
            self.assertNotIn("[Y/n]", shown)
            self.assertIn("g++", self.installed())

    def test_without_a_terminal_progress_is_a_line_for_ten_percent(self):
        _, _, shown = self.piped()
        self.assertEqual([line for line in shown.splitlines() if "building, " in line],
                         [f"polybed: building, {percent} %" for percent in (10, 20, 30, 50, 60, 70, 80, 100)])
        self.assertIn("[8/8] Building", (self.folder / "build/build.log").read_text())

    def test_a_change_in_any_folder_of_sources_is_built(self):
        self.piped()
        log, stamp = self.folder / "build/build.log", self.folder / "build/built-program"
        for name in SOURCES:
            log.unlink(missing_ok=True)
            for path in self.folder.rglob("*"):
                os.utime(path, (1000, 1000))
            self.piped()
            self.assertFalse(log.exists(), "nothing has changed")
            os.utime(self.folder / name, (2000, 2000))
            self.piped()
            self.assertTrue(log.exists(), name)
            self.assertTrue(stamp.exists())

    def test_a_build_that_fails_is_told(self):
        code, printed, shown = self.piped(BROKEN="1")
        self.assertEqual((code, printed), (FILE, ""))
        self.assertIn("a.cpp: error: broken", shown)
        self.assertIn("the build failed; the whole log is", shown)
        self.assertEqual(self.piped()[:2], (DONE, "ran list\n"))

    def test_a_hard_case_that_there_is_not_is_refused_before_anything_is_built(self):
        (self.folder / "cases/hard").mkdir(parents=True)
        (self.folder / "tests").mkdir()
        shutil.copy(ROOT / "cases/hard/expected.csv", self.folder / "cases/hard")
        for words, code in ((["--only", "T99"], WRONG_CASE), (["--only=I6,T99"], WRONG_CASE), (["--only", "I6,T1"], DONE)):
            done = subprocess.run([self.folder / "polybed", "stability", *words], env=self.settings | {"POLYBED_YES": "1"}, capture_output=True,
                                  text=True, timeout=60)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual("there is no hard case T99" in done.stderr, code == WRONG_CASE)
            self.assertEqual((self.folder / "build").exists(), code == DONE)


if __name__ == "__main__":
    program.main()
