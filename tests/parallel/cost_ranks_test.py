#!/usr/bin/python3
"""Counters of one and two ranks, and a sweep against a run that is given.
Usage: cost_ranks_test.py PROGRAM"""
import os
import pathlib
import subprocess
import sys

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "cli")]
import open_mpi  # noqa: E402
import program  # noqa: E402
from program import DONE, FILE, Scratch, strict_json  # noqa: E402

BED = program.small_bed("0.02 s")
QUIET = ["--no-picture", "--quiet", "--budget", "300s", "--json"]


class OnRanks(Scratch):
    def started(self, *words):
        """Without the settings for single processes of `program`; ranks that wait leave the core to the others."""
        settings = os.environ | open_mpi.SETTINGS | open_mpi.MORE_THAN_CORES | {"OMPI_MCA_orte_tmpdir_base": str(self.folder)}
        done = subprocess.run([*map(str, words)], capture_output=True, text=True, timeout=400, env=settings)
        self.assertEqual(done.returncode, DONE, done.stderr[-400:])
        return done.stdout


class Counters(OnRanks):
    def work(self, model, ranks, name):
        case, run = self.write("case.toml", BED), self.folder / name
        start = ["mpirun", "-q", "--oversubscribe", "-n", ranks] if ranks > 1 else []
        self.started(*start, program.PROGRAM, model, case, "--until", "2 ms", "--quiet", "--no-picture", "-o", run)
        return strict_json((run / "run.json").read_text())["work"]

    def test_are_those_of_the_run_whatever_the_time_and_the_ranks(self):
        """K8 of the specification of cost."""
        for model in ("tfm", "dem"):
            first = self.work(model, 1, f"{model}-first")
            self.assertEqual(first, self.work(model, 1, f"{model}-again"))
            halves = self.work(model, 2, f"{model}-halves")
            self.assertEqual(first["steps"], halves["steps"])
            if model == "dem":
                self.assertGreater(first["particle_steps"], 1000)
                self.assertEqual(first["particle_steps"], halves["particle_steps"])


class Sweeps(OnRanks):
    def sweep(self, name, *words):
        case = self.write("case.toml", BED)
        return strict_json(self.started(program.PROGRAM, "cost", case, *words, *QUIET, "-o", self.folder / name))

    def test_against_a_run_that_is_given(self):
        """The reference is a row of the sweep itself, run by hand: its error is none, that of the others is."""
        case, given = self.write("case.toml", BED), self.folder / "given"
        stored = {"output.every": 0.02 / 40, "output.history_every": 0.02 / 800, "output.checkpoint_every": 0.02, "tfm.rtol": 1e-5}
        words = [word for key, value in stored.items() for word in ("--set", f"{key}={value:.17g}")]
        self.ends(DONE, "tfm", case, "--quiet", "--no-picture", "-o", given, *words)
        sweep = self.sweep("sweep", "--axes", "rtol", "--reference", given)
        self.assertEqual((sweep["reference"]["kind"], sweep["reference"]["note"]), ("directory", str(given)))
        errors = {run["settings"]["rtol"]: run["qoi"]["bed_height"]["error"] for run in sweep["runs"]
                  if run["kind"] == "candidate" and "bed_height" in run.get("qoi", {})}
        self.assertEqual(errors["1e-05"], 0)
        self.assertGreater(errors["0.001"], 0)
        done = program.run("cost", case, "--axes", "rtol", "--reference", self.folder / "nowhere", *QUIET, "-o", self.folder / "none")
        self.assertEqual(done.returncode, FILE)
        self.assertIn("nowhere", done.stderr)


if __name__ == "__main__":
    program.main()
