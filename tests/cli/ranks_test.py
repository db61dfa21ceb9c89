#!/usr/bin/python3
"""The program on ranks, without a network, and its launcher on another user's tree. Usage: ranks_test.py PROGRAM"""
import os
import pathlib
import shlex
import shutil
import signal
import subprocess
import tempfile
import time

import h5py

import program
from program import DONE, LONGEST, ROOT, STOPPED, WRONG_CASE, Scratch, small_bed, strict_json

MPI = 5


def bare(*words, path="/usr/bin:/bin", **more):
    """The program without any setting of Open MPI."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMI", "PATH"))}
    with tempfile.TemporaryDirectory() as scratch:
        return subprocess.run([program.PROGRAM, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
                              timeout=LONGEST, env=kept | {"PATH": path, "TMPDIR": scratch} | more)


class Ranks(Scratch):
    def test_the_program_starts_its_ranks(self):
        case = self.write("case.toml", small_bed("2 ms"))
        for ranks in (1, 3):
            directory = self.folder / f"on{ranks}"
            done = bare("-n", ranks, "tfm", case, "--quiet", "--no-picture", "-o", directory)
            self.assertEqual(done.returncode, DONE, done.stderr)
            self.assertEqual(strict_json((directory / "run.json").read_text())["ranks"], ranks)
        wrong = bare("-n", 2, "tfm", case, "--set", "run.until=-1", "-o", self.folder / "wrong")
        self.assertEqual(wrong.returncode, WRONG_CASE, wrong.stderr)
        self.assertEqual(wrong.stderr.count("is out of range"), 1, wrong.stderr)  # by the first rank alone

    def test_the_command_that_goes_on_has_the_ranks(self):
        case = self.write("case.toml", small_bed("20 ms"))
        done = bare("-n", 2, "tfm", case, "--set", "output.history_every=1e-4", "--no-picture", "-o", self.folder / "run")
        [line] = [line for line in done.stderr.splitlines() if line.startswith("to go on")]
        self.assertRegex(line, rf"^to go on +{program.PROGRAM} -n 2 tfm {case} ")
        again = bare(*shlex.split(line)[4:], "--quiet", "--no-picture")
        self.assertEqual(again.returncode, DONE, again.stderr)
        record = strict_json((self.folder / "run/run.json").read_text())
        self.assertEqual((record["ranks"], record["time_s"]), (2, 0.04))

    def interrupted(self, number, meanwhile=lambda mpirun: None):
        """Code, record and messages of a run on two ranks that gets a signal once it has a checkpoint."""
        case, directory = self.write("case.toml", small_bed("60 s")), self.folder / "run"
        running = subprocess.Popen([program.PROGRAM, "-n", "2", "dem", case, "--quiet", "--no-picture", "-o", directory, "--set",
                                    "output.checkpoint_every=1e-3"], stderr=subprocess.PIPE, encoding="utf-8")
        self.addCleanup(running.kill)
        program.wait_until(running, (directory / "checkpoint.h5").exists)
        running.send_signal(number)
        meanwhile(running)
        told = running.communicate(timeout=LONGEST)[1]
        self.assertEqual(running.returncode, STOPPED, told)
        record = strict_json((directory / "run.json").read_text())
        self.assertEqual(record["state"], "stopped by the user")
        with h5py.File(directory / "checkpoint.h5") as checkpoint:
            self.assertEqual(checkpoint["numbers/time"][()], record["time_s"])
        self.assertIn("a checkpoint has been written", told)

    def test_ranks_that_are_interrupted_end_in_order(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1, signal.SIGHUP):
            self.interrupted(number)
            shutil.rmtree(self.folder / "run")

    def test_a_rank_in_a_long_step_is_waited_for(self):
        """mpirun kills ranks a second after a signal of its own."""
        def children(process):
            path = pathlib.Path(f"/proc/{process}/task/{process}/children")
            return [int(child) for child in path.read_text().split()]

        def long_step(running):
            [mpirun] = children(running.pid)
            rank = children(mpirun)[1]
            os.kill(rank, signal.SIGSTOP)
            time.sleep(2.5)
            os.kill(rank, signal.SIGCONT)
        self.interrupted(signal.SIGINT, long_step)

    def test_a_second_signal_ends_ranks_at_once(self):
        case, directory = self.write("case.toml", small_bed("60 s")), self.folder / "run"
        running = subprocess.Popen([program.PROGRAM, "-n", "2", "dem", case, "--quiet", "--no-picture", "-o", directory],
                                   stderr=subprocess.PIPE)
        self.addCleanup(running.kill)
        program.wait_until(running, (directory / "run.json").exists)
        [mpirun] = [int(child) for child in pathlib.Path(f"/proc/{running.pid}/task/{running.pid}/children").read_text().split()]
        os.kill(mpirun, signal.SIGSTOP)  # so that nothing ends before the second one
        for _ in range(2):
            running.send_signal(signal.SIGINT)
            time.sleep(0.2)
        os.kill(mpirun, signal.SIGCONT)
        running.communicate(timeout=10)
        self.assertEqual(running.returncode, STOPPED)

    def test_no_colours_go_into_a_pipe(self):
        """mpirun gives a rank a terminal of its own for its answer."""
        case = self.write("case.toml", small_bed("1 ms"))
        for words in (["check", case], ["list", "cases"], ["tfm", case, "--no-picture", "-o", self.folder / "run"]):
            done = bare("-n", 2, *words, TERM="xterm")
            self.assertEqual(done.returncode, DONE, done.stderr)
            self.assertNotIn("\033", done.stdout + done.stderr, words)

    def test_a_number_of_ranks_that_is_none_is_refused(self):
        for words in (["-n"], ["-n", "0", "list"], ["-n", "two", "list"], ["-n", "2"]):
            self.assertEqual(bare(*words).returncode, WRONG_CASE, words)

    def test_ranks_do_not_start_ranks(self):
        for words in (["list"], ["compare", "case.toml"]):
            done = bare("-n", 2, *words, OMPI_COMM_WORLD_SIZE="2")
            self.assertEqual(done.returncode, MPI, done.stderr)
            self.assertIn("leave out -n", done.stderr)

    def test_mpirun_of_the_working_directory_is_not_started(self):
        trap = self.write("mpirun", "#!/bin/sh\ntouch sprung\n")
        trap.chmod(0o755)
        here = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, here)
        bare("-n", 2, "list", path=f".:{self.folder.name}:/usr/bin:/bin")
        self.assertFalse((self.folder / "sprung").exists())

    def test_one_rank_needs_no_other_program(self):
        """Open MPI starts a daemon, and looks for ssh for it, unless it is told that nobody else is there."""
        case = self.write("case.toml", small_bed("1 ms"))
        for words in (["list"], ["check", case], ["effects", case], ["tfm", case, "--no-picture", "-o", self.folder / "tfm"],
                      ["dem", case, "--no-picture", "-o", self.folder / "dem"]):
            done = bare(*words, path="/nowhere")
            self.assertEqual(done.returncode, DONE, (words, done.stderr[-500:]))

    def test_ranks_that_outnumber_the_cores_yield(self):
        """Two ranks on one core that spin while they wait need a time slice for each message: minutes in place of seconds."""
        case = self.write("case.toml", small_bed("1 ms"))
        before = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {min(before)})
        self.addCleanup(os.sched_setaffinity, 0, before)
        done = bare("-n", 2, "tfm", case, "--quiet", "--no-picture", "-o", self.folder / "run")
        self.assertEqual(done.returncode, DONE, done.stderr)


class Launcher(Scratch):
    """A built tree that belongs to somebody else, with a stand-in for the program."""

    def tree(self):
        root = self.folder / "tree"
        for name in ("cmake", "closures", "core", "fluid", "tfm", "dem", "multiscale", "app", "build"):
            (root / name).mkdir(parents=True)
        (root / "CMakeLists.txt").touch()
        shutil.copy(ROOT / "polybed", root)
        packages = root / "cmake/packages.txt"
        packages.write_text("g++\n")
        shutil.copy(packages, root / "build/packages.ok")
        built = root / "build/polybed"
        built.write_text('#!/bin/sh\necho "ran $*"\n')
        built.chmod(0o755)
        (root / "build/built-program").touch()
        later = (root / "build/built-program").stat().st_mtime + 10
        os.utime(root / "build/built-program", (later, later))
        (root / "build").chmod(0o555)
        self.addCleanup((root / "build").chmod, 0o755)
        self.folder.chmod(0o755)
        return root

    def as_stranger(self, *words):
        user = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.getuid() == 0 else []
        return subprocess.run([*user, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", cwd="/",
                              timeout=LONGEST)

    def test_a_built_tree_runs_for_who_cannot_write_it(self):
        root = self.tree()
        done = self.as_stranger(root / "polybed", "list")
        self.assertEqual((done.returncode, done.stdout), (0, "ran list\n"), done.stderr)

    def test_a_tree_that_must_be_built_says_that_it_cannot(self):
        root = self.tree()
        later = (root / "build/built-program").stat().st_mtime + 10
        os.utime(root / "CMakeLists.txt", (later, later))
        done = self.as_stranger(root / "polybed", "list")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("cannot be written", done.stderr)


if __name__ == "__main__":
    program.main()
