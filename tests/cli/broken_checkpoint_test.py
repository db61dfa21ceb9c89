#!/usr/bin/python3
"""Checkpoints that are whole, by their checksum, but not what a run has left. Usage: broken_checkpoint_test.py PROGRAM"""
import re
import shutil

import h5py
import numpy as np

import program
from program import DONE, FILE, NUMBERS, WRONG_CASE, Scratch, datasets, run_all, small_bed


def shorter(data):
    return data[:-1] if data.ndim else None


def longer(data):
    return np.concatenate([data, data[-1:]]) if data.ndim else np.array([data, data])


def filled(value):
    def change(data):
        if data.dtype.kind not in "fi" or data.dtype.kind == "i" and not abs(value) < 2**63:
            return None
        return np.full_like(data, value)
    return change


# None: the dataset is taken away
CHANGES = {"removed": None, "shorter": shorter, "longer": longer, "nan": filled(np.nan), "-1": filled(-1), "1e300": filled(1e300),
           "1e15": filled(10**15), "empty": lambda data: data[:0] if data.ndim else None}


class Broken(Scratch):
    def broken(self, checkpoint, name, how, path):
        """True if the change can be made: a copy of the checkpoint with one dataset changed."""
        change = CHANGES[how]
        shutil.copy(checkpoint, path)
        program.unseal(path)
        with h5py.File(path, "r+") as file:
            data = file[name][()]
            if isinstance(data, bytes):
                new = {"removed": None, "empty": "", "longer": data.decode() + " x nan"}.get(how, False)
            else:
                new = None if change is None else change(np.asarray(data))
                if new is None and change is not None:
                    return False
            if new is False:
                return False
            del file[name]
            if new is not None:
                file[name] = new
        program.seal(path)
        return True

    def all_broken(self, model, *settings):
        """Resumes from every change of every dataset: each is refused with a message, or, where nothing tells it from a state,
        runs on or stops in order."""
        case = self.write("case.toml", small_bed("2 ms"))
        words = [model, case, *settings, "--quiet", "--no-picture", "--set", "output.history_every=1e-3"]
        first = self.folder / "first"
        self.ends(DONE, *words, "-o", first)
        commands, made = [], []
        for name in datasets(first / "checkpoint.h5"):
            for how in CHANGES:
                directory = self.folder / f"{model}{len(made)}"
                directory.mkdir(exist_ok=True)
                if not self.broken(first / "checkpoint.h5", name, how, directory / "checkpoint.h5"):
                    continue
                for other in first.iterdir():
                    if other.is_file() and not other.name.startswith("checkpoint"):
                        shutil.copy(other, directory)
                made.append((name, how))
                commands.append([*words, "--until", "2.1 ms", "--resume", "-o", directory])
        ends = {}
        for change, done in zip(made, run_all(commands)):
            text = f"{change}: {done.returncode}\n{done.stderr[-400:]}"
            self.assertIn(done.returncode, (DONE, WRONG_CASE, FILE, NUMBERS), text)
            self.assertNotRegex(done.stderr, r"\b(at|stoi|stod|bad_\w+|std::\S+|vector|map|out_of_range|unordered)\b::|_M_range|::at", text)
            if done.returncode in (WRONG_CASE, FILE):
                self.assertEqual(len(re.findall("\n", done.stderr.strip())), 0, text)  # one line
                self.assertIn(str(commands[len(ends)][-1]), done.stderr, text)
            ends[change] = done.returncode
        return ends

    def test_of_the_continuum(self):
        ends = self.all_broken("tfm")
        for name in ("/numbers/time_s", "/numbers/step_s", "/arrays/initial_mass", "/fields/state/phi_fine"):
            for how in ("nan", "1e300", "-1"):
                self.assertEqual(ends[name, how], FILE, (name, how))
        self.assertGreater(sum(code == FILE for code in ends.values()), len(ends) / 2)

    def test_of_particles_in_a_fluid(self):
        ends = self.all_broken("dem", "--set", "bed.start_solids_fraction=0.58")  # so dense that some touch
        for name in ("/arrays/particles", "/arrays/contacts", "/arrays/fluid_loads", "/integers/steps", "/numbers/time"):
            for how in ("removed", "longer"):
                self.assertEqual(ends[name, how], FILE, (name, how))
        self.assertGreater(sum(code == FILE for code in ends.values()), len(ends) / 2)


if __name__ == "__main__":
    program.main()
