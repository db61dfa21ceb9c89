#!/usr/bin/python3
"""Ctrl-C before the first step, while particles are placed or a bed settles, and between the outputs of one step.
Usage: early_stop_test.py PROGRAM"""
import pathlib
import signal
import time

import program
from program import DONE, LONGEST, STOPPED, Scratch, history, small_bed, wait_until

BED = """[column]
size = ["30 mm", "60 mm"]
cells = [10, 20]
depth = "10 mm"
sides = "periodic"
[fluid]
name = "none"
[[species]]
name = "beads"
diameter = "0.8 mm"
density = 2500
[bed]
%s
[effects]
others = "none"
contact = "hertz_mindlin"
[run]
until = "1 s"
"""
# Random places of 0.655 of the volume: 5000 rounds of pushing apart do not find room for all.
PLACING = 'particles = [44000]\nstart = "random"\nsolids_fraction = 0.7'
SETTLING = 'particles = [12000]\nstart = "settled"\nsolids_fraction = 0.6\nstart_solids_fraction = 0.3'


def cpu_seconds(process):
    """CPU time that a process has used by now."""
    ticks = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(ticks[11]) + int(ticks[12])) / 100


class EarlyStop(Scratch):
    def stopped(self, bed, ready, doing):
        running = self.start("dem", self.write("case.toml", BED % bed), "--no-picture", "-o", self.folder / "run")
        wait_until(running, lambda: ready(running))
        before = cpu_seconds(running)
        running.send_signal(signal.SIGINT)
        told = running.communicate(timeout=LONGEST)
        self.assertEqual(running.returncode, STOPPED, told)
        self.assertIn(f"stopped by the user while {doing}", told[1])
        self.assertFalse((self.folder / "run/history.csv").exists(), "a step was done")
        return before

    def test_while_particles_are_placed(self):
        self.stopped(PLACING, lambda running: cpu_seconds(running) > 1, "particles were placed")

    def test_while_a_bed_settles(self):
        def settles(running):
            time.sleep(0.1)
            return cpu_seconds(running) > 3  # placing takes less: the bed is loose
        self.stopped(SETTLING, settles, "the bed settled")
        few = self.write("few.toml", BED % 'particles = [9]\nstart = "random"\nsolids_fraction = 0.6')
        self.ends(DONE, "dem", few, "--until", "0.1 ms", "--no-picture", "-o", self.folder / "run")  # nothing was there to lose

    def test_between_the_outputs_of_a_step(self):
        """Millions of rows in a step of the continuum would take many minutes; particles write one a step."""
        words = ["tfm", self.write("case.toml", small_bed("0.1 s")), "--set", "tfm.fixed_step=1 ms", "--quiet", "--no-picture", "-o",
                 self.folder / "run"]
        running = self.start(*words, "--until", "10 us", "--set", "output.history_every=2e-12")
        rows = self.folder / "run/history.csv"
        wait_until(running, lambda: rows.exists() and rows.stat().st_size > 20000)
        running.send_signal(signal.SIGTERM)
        told = running.communicate(timeout=LONGEST)[1]
        self.assertEqual(running.returncode, STOPPED, told)
        last = history(self.folder / "run")["time_s"][-1]
        self.assertRegex(told, "^stopped by the user; a checkpoint of t = .* has been written, without the outputs from .* s on\n$")
        self.assertAlmostEqual(float(told.split(" s on")[0].split()[-1]), last, delta=4e-12)
        self.ends(DONE, *words, "--set", "output.history_every=1e-3", "--until", "2 ms", "--resume")


if __name__ == "__main__":
    program.main()
