#!/usr/bin/python3
"""What a run with a monitor says of the forces that it does without."""
import shlex

import program
from effects_test import BEADS, BY_HAND
from program import DONE, NUMBERS, WRONG_CASE, Scratch, datasets, same_bits, strict_json


class Promise(Scratch):
    def test_a_monitor_of_all_cells_holds_what_was_left_out_against_the_promise(self):
        case = self.write("hand.toml", BY_HAND)
        all_cells = ["--set", "chooser.monitor=warn", "--set", "chooser.monitor_sample=1", "--set", "chooser.monitor_every=5"]

        def promise(name, *words):
            self.ends(DONE, "tfm", case, "-o", self.folder / name, "--quiet", "--no-picture", "--until", "0.1 s", *all_cells, *words)
            record = strict_json((self.folder / name / "run.json").read_text())
            return record["promise"], next(line for line in record["card"]["lines"] if line.startswith("left out"))
        # Of the same flow twice: a fifth of the weight is not left out, two hundredths are. The monitor sees forces on particles;
        # the stress of the fluid, which the case has off, counts by its bound.
        kept, line = promise("kept", "--set", "chooser.tolerance=0.2", "--set", "effects.fluid_stress=newtonian")
        self.assertTrue(kept["kept"])
        self.assertRegex(line, r"; in the run lift, magnus, cohesion of [\d.]+ %, with the rest [\d.]+ %: does not matter$")
        broken, line = promise("broken")
        self.assertFalse(broken["kept"])
        self.assertRegex(line, r" with the rest \d+ %: matters$")
        for row in kept["observed"]:
            self.assertLessEqual(row["greatest"], row["bound"], row["effect"])
            self.assertGreater(row["encounters"], 50)

    def test_an_auto_run_of_particles_keeps_its_promise(self):
        case, run = self.write("auto.toml", 'effects = "auto"\n' + BEADS), self.folder / "run"
        self.ends(DONE, "dem", case, "-o", run, "--quiet", "--no-picture")
        promise = strict_json((run / "run.json").read_text())["promise"]
        self.assertTrue(promise["kept"])
        self.assertGreater(promise["observed"][-1]["encounters"], 0)

    def ramp(self, name, monitor, *more):
        """The bed is weighed packed, where nothing shears; the inlet then lifts it."""
        words = ["--set", 'chooser.zones=["packed"]', "--set", f"chooser.monitor={monitor}", "--set",
                 "chooser.monitor_every=20", "--set", "chooser.monitor_sample=4", "--set", "chooser.tolerance=0.01",
                 "--set", 'inlet.superficial_velocity=[["0 s", "1 mm/s"], ["0.05 s", "80 mm/s"]]']
        case, run = self.write("ramp.toml", BY_HAND), self.folder / name
        code = NUMBERS if monitor == "stop" else DONE
        return self.ends(code, "dem", case, "-o", run, "--no-picture", *words, *more), strict_json((run / "run.json").read_text()), run

    def test_the_monitor_warns_stops_and_is_absent_when_off(self):
        warned, record, run = self.ramp("warn", "warn")
        lines = [line for line in warned.stderr.splitlines() if "neglected (bound" in line and not line.startswith("warning: ")]
        self.assertTrue(any(line.startswith("magnus") for line in lines), warned.stderr)
        self.assertEqual(len(lines), len({line.split()[0] for line in lines}))  # each once
        self.assertEqual([w for w in record["warnings"] if "neglected" in w], lines)
        self.assertFalse(record["promise"]["kept"])
        stopped, stopped_record, _ = self.ramp("stop", "stop")
        self.assertIn("chooser.monitor", stopped.stderr)
        self.assertLess(stopped_record["time_s"], 0.05)
        _, off_record, off = self.ramp("off", "off")
        self.assertNotIn("promise", off_record)
        self.assertNotIn("monitor", off_record["timers"])
        self.assertIn("monitor", record["timers"])
        self.assertEqual(same_bits(run / "particles.h5", off / "particles.h5"), [])

    def test_a_run_that_has_stopped_goes_on_with_the_effect(self):
        stopped, record, run = self.ramp("stop", "stop", "--set", 'output.every="0.01 s"')
        command = next(line for line in stopped.stderr.splitlines() if "--resume" in line).split("effect: polybed ")[1]
        given = shlex.split(command)
        settings = [value for word, value in zip(given, given[1:]) if word == "--set"]
        self.assertIn("effects.magnus=rubinow_keller", settings)
        words = [word for setting in settings for word in ("--set", setting)]
        case = self.folder / "ramp.toml"
        self.assertTrue(command.startswith(f"dem {case} -o {run} --resume"), command)
        # The same monitor stops it again if more is left out; here one effect is to be seen at work.
        self.ends(WRONG_CASE, "dem", case, "-o", run, "--resume", *words, "--set", "effects.cohesion=dmt", "--set", "dem.cohesion_energy=1e-6")
        until = f"{record['time_s'] + 0.002:.4f} s"
        added = ["dem", case, "-o", run, "--resume", *words, "--until", until, "--no-picture", "--quiet"]
        done = program.run(*added)
        self.assertIn(done.returncode, (DONE, NUMBERS), done.stderr)
        after = strict_json((run / "run.json").read_text())
        self.assertGreater(after["time_s"], record["time_s"])
        self.assertIn("magnus = ", after["case"].split("[effects]")[1])
        self.assertNotIn("magnus", {row["effect"] for row in after["promise"]["observed"]})

    def test_an_effect_without_strength_is_as_one_that_is_off(self):
        case = self.write("hand.toml", BY_HAND)
        runs = {"off": [], "weak": ["--set", "effects.cohesion=van_der_waals", "--set", "dem.hamaker_constant=1e-90"],
                "history": ["--set", "effects.history=basset"]}
        names = {}
        for name, words in runs.items():
            self.ends(DONE, "dem", case, "-o", self.folder / name, "--quiet", "--no-picture", "--until", "0.01 s",
                      "--set", "column.depth=0.0025", *words)
            names[name] = set(datasets(self.folder / name / "checkpoint.h5"))
        self.assertEqual(same_bits(self.folder / "off/particles.h5", self.folder / "weak/particles.h5"), [])
        # What an effect keeps is in the checkpoint of a run that has it, and of no other.
        self.assertEqual(names["off"], names["weak"])
        self.assertGreater(names["history"], names["off"])


if __name__ == "__main__":
    program.main()
