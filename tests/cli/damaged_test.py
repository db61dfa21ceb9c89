#!/usr/bin/python3
"""Run directories with a damaged file: drawing and reading tell it in one line, which names the file, and never by a traceback.
Usage: damaged_test.py PROGRAM"""
import contextlib
import io
import json
import os
import pathlib
import random
import shutil
import sys
import tempfile

import h5py
import numpy as np

import program
from program import DONE, FILE, ROOT, Scratch

sys.path.insert(0, str(ROOT / "python"))
import polybed  # noqa: E402
from polybed import plot  # noqa: E402
from polybed.drawing import stress_table, style  # noqa: E402

style.STYLE |= {"figure.dpi": 20, "savefig.dpi": 20}  # for speed

# Entries of run.json and of comparison.json that are drawn; the others are the program's.
READ = {"filetype", "version", "model", "state", "case_hash", "invariants", "models", "scores", "window"}
TOLD = (polybed.FormatError, OSError)


def noise(count):
    return random.Random(18).randbytes(count)


def whole_file_damages(path):
    """(name, what does it) for any file."""
    def middle(path):
        content = path.read_bytes()
        quarter = len(content) // 4
        path.write_bytes(content[:quarter] + noise(2 * quarter) + content[3 * quarter:])

    def folder(path):
        path.unlink()
        path.mkdir()

    def pipe(path):
        path.unlink()
        os.mkfifo(path)
    return [("empty", lambda path: path.write_bytes(b"")), ("half", lambda path: os.truncate(path, path.stat().st_size // 2)),
            ("noise", lambda path: path.write_bytes(noise(path.stat().st_size))), ("noise in the middle", middle),
            ("text", lambda path: path.write_text("a,b\n1,2\n")), ("removed", pathlib.Path.unlink), ("a folder", folder), ("a pipe", pipe)]


def hdf5_damages(path):
    """Each attribute gone, each dataset but what only ParaView reads gone or in another shape or type; of every third, numbers that are
    none or too large."""
    names = []
    with h5py.File(path) as file:
        for place in file.attrs:
            def without(path, place=place):
                with h5py.File(path, "r+") as file:
                    del file.attrs[place]
            yield f"without {place}", without
        file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and not name.startswith("paraview/") else None)
    for number, name in enumerate(names):
        changes = [("gone", lambda old: None), ("flat", lambda old: old.ravel()[:-1]), ("higher", lambda old: old[..., None]),
                   ("text", lambda old: "text")]
        if number % 3 == 0 or "radius" in name or "position" in name:  # most of these are drawn, which takes a second
            changes += [("no numbers", lambda old: np.full_like(old, np.nan, dtype=float)),
                        ("huge", lambda old: np.full_like(old, 1e300, dtype=float))]
        for title, change in changes:
            def changed(path, name=name, change=change):
                with h5py.File(path, "r+") as file:
                    new = change(file[name][...])
                    del file[name]
                    if new is not None:
                        file[name] = new
            yield f"{name} {title}", changed


def json_damages(path):
    """Each entry gone or of another type, and of lists the first entry too."""
    found = json.loads(path.read_text())

    def write(value):
        return lambda path: path.write_text(json.dumps(value))
    yield "a list", write([1, 2])
    yield "nested", lambda path: path.write_text("[" * 100_000)
    for key in found.keys() & READ:
        yield f"without {key}", write({name: value for name, value in found.items() if name != key})
        for other in (None, "text", [None]):
            yield f"{key} = {other}", write(found | {key: other})
    for name in ("name", "worst", "limit") if "invariants" in found else ():
        yield f"{name} of an invariant", write(found | {"invariants": [found["invariants"][0] | {name: None}]})


def history_damages(path):
    """Rows and columns that do not fit."""
    lines = path.read_text().splitlines()
    for name, rows in (("no rows", lines[:1]), ("one row", lines[:2]), ("no header", lines[1:]), ("a word", [*lines, lines[-1] + "x"]),
                       ("a short row", [*lines, "1,2"]), ("an empty row", [lines[0], "", *lines[1:]]),
                       ("empty entries", [*lines, "," * lines[0].count(",")]), ("no number", [*lines, lines[-1].replace("0", "nan")]),
                       ("huge", [*lines, ",".join(["1e300"] * (lines[0].count(",") + 1))]),
                       ("one column", [line.split(",")[0] for line in lines])):
        yield name, lambda path, rows=rows: path.write_text("\n".join(rows) + "\n")
    for number, column in enumerate(lines[0].split(",")[:3]):
        rows = [",".join(entry for n, entry in enumerate(line.split(",")) if n != number) for line in lines]
        yield f"without {column}", lambda path, rows=rows: path.write_text("\n".join(rows) + "\n")


def damages(path):
    yield from whole_file_damages(path)
    if path.suffix == ".h5" and "checkpoint" not in path.name:
        yield from hdf5_damages(path)
    if path.suffix == ".json":
        yield from json_damages(path)
    if path.name == "history.csv":
        yield from history_damages(path)


def read_all(directory):
    """Whatever a run holds."""
    run = polybed.read(directory)
    run.record, run.history, run.profiles, run.species, run.size, run.names()
    for name in run.fields:
        run.field(name)[:]
    for n in range(len(run.particles)):
        [getattr(run.particles[n], name) for name in polybed.particles.ParticleStep.NAMES]


class DamagedRuns(Scratch):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.place = pathlib.Path(kept.name)
        case = cls.place / "case.toml"
        case.write_text(program.small_bed("4 ms") + '[output]\nevery = "2 ms"\n')
        for model in ("tfm", "dem"):
            done = program.run(model, case, "--quiet", "--no-picture", "-o", cls.place / model)
            assert done.returncode == DONE, done.stderr
        done = program.run("compare", case, "--tfm", cls.place / "tfm", "--dem", cls.place / "dem", "-o", cls.place / "both", "--no-picture",
                           "--quiet")
        assert done.returncode == DONE, done.stderr

    def told_in_a_line(self, told, directory, damage):
        self.assertRegex(str(told), rf"^[^\n]*{directory}[^\n]+$", damage)

    def draws(self, main, words, directory, damage):
        """A module draws, or says in a line which file is damaged."""
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as said:
            code = main(words)
        if code != DONE:
            self.assertEqual(code, FILE, damage)
            self.told_in_a_line(said.getvalue().removesuffix("\n"), directory, damage)

    def each_damage(self, directory, names, check):
        """Calls check(damaged copy, name of the damage) for each damage of each file. The whole run is read."""
        if (directory / "run.json").exists():
            read_all(directory)
        for name in names:
            for damage, apply in damages(directory / name):
                copy = self.folder / "run"
                shutil.copytree(directory, copy, copy_function=os.link)
                (copy / name).unlink()
                shutil.copy(directory / name, copy / name)
                apply(copy / name)
                with self.subTest(file=name, damage=damage):
                    check(copy, f"{name}: {damage}")
                shutil.rmtree(copy)

    def read_or_drawn(self, kinds):
        """What reading does not notice is drawn."""
        def check(directory, damage):
            try:
                read_all(directory)
            except TOLD as error:
                self.told_in_a_line(error, directory, damage)
            else:
                there = [kind for kind in kinds if kind in plot.kinds_of(polybed.read(directory))]
                self.draws(plot.main, [str(directory), "--what", ",".join(there)], directory, damage)
        return check

    def test_runs_of_the_continuum(self):
        for names, kinds in ((["run.json", "history.csv"], ["overview", "history"]), (["profiles.h5"], ["overview", "profiles"]),
                             (["fields.h5", "fields/000001.h5", "fields/000003.h5"], ["overview", "fields"])):
            self.each_damage(self.place / "tfm", names, self.read_or_drawn(kinds))

    def test_runs_of_particles(self):
        for names, kinds in ((["history.csv"], ["overview", "history"]),
                             (["particles.h5", "particles/000001.h5", "particles/000003.h5"], ["overview", "particles"])):
            self.each_damage(self.place / "dem", names, self.read_or_drawn(kinds))

    def test_comparisons(self):
        def check(directory, damage):
            self.draws(plot.main, [str(directory)], directory, damage)
        self.each_damage(self.place / "both", ["comparison.json"], check)

    def test_what_other_commands_write(self):
        for name, kind in (("cost.json", "cost"), ("inversion.json", "inversion"), ("stability.json", "stability"), ("table.h5", "solids table")):
            path, module = self.folder / name, stress_table if name == "table.h5" else plot
            for content in ("", "{", "[]", "noise", json.dumps({"filetype": f"polybed {kind}", "version": 1}),
                            json.dumps({"filetype": f"polybed {kind}", "version": 2})):
                path.write_text(content)
                with self.subTest(file=name, damage=content):
                    self.draws(module.main, [str(path if module is stress_table else self.folder)], path, content)
                    self.assertEqual(list(self.folder.iterdir()), [path])
            path.unlink()
        with h5py.File(self.folder / "table.h5", "w") as file:
            file.attrs.update({"filetype": "polybed solids table", "version": 1})
        self.draws(stress_table.main, [str(self.folder / "table.h5")], self.folder / "table.h5", "no data")

    def test_the_command(self):
        """The same through the program, of which the reading is what is tested above."""
        copy = self.folder / "run"
        for name, content in (("history.csv", b""), ("run.json", b"{"), ("fields.h5", b"no HDF5"), ("fields/000001.h5", b"")):
            shutil.copytree(self.place / "tfm", copy)
            (copy / name).write_bytes(content)
            told = self.ends(FILE, "plot", copy).stderr
            self.assertRegex(told, rf"^{copy / name} is damaged: [^\n]+; make it again with polybed, or restore it from a copy\n$")
            shutil.rmtree(copy)


if __name__ == "__main__":
    program.main()
