#!/usr/bin/python3
"""Files that never end, nest without end, are long, hold numbers that cannot be, lead to other files, or would act on a terminal.
Usage: hostile_files_test.py PROGRAM"""
import json
import os
import pathlib
import resource
import shutil
import sys

import h5py
import numpy as np

import program
from program import CASE, DONE, FILE, ROOT, WRONG_CASE, Scratch, run, run_all, small_bed, strict_json

sys.path.insert(0, str(ROOT / "python"))
import polybed  # noqa: E402
import polybed.solids_table  # noqa: E402

TABLE_CASE = ROOT / "cases/small-binary/case.toml"
WET = ["--set", "calibrate.regime=wet"]  # which the table is of
TABLE = ROOT / "cases/small-binary/table.h5"


class Endless(Scratch):
    """A pipe without a writer and a device without an end, in the place of each file that a user names."""

    def test_only_regular_files_are_read(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        case = self.write("case.toml", small_bed("1 ms"))
        folder = self.folder / "run"
        folder.mkdir()
        os.mkfifo(folder / "run.json")
        commands = [["compare", case, "--tfm", folder, "--dem", folder]]
        for file in (pipe, "/dev/zero"):
            commands += [["check", file], ["tfm", file], ["drag", "--csv", file],
                         ["check", case, "--set", f"effects.solids_stress=table:{file}"],
                         ["dem", case, "--set", f"bed.start=checkpoint:{file}", "-o", self.folder / f"started{len(commands)}"],
                         ["dem", self.listed(file), "-o", self.folder / f"listed{len(commands)}"]]
        for words, done in zip(commands, run_all(commands)):
            self.assertEqual(done.returncode, FILE, (words, done.stderr[-300:]))
            self.assertRegex(done.stderr, "no regular file, but a pipe or a device", words)

    def test_nothing_waits_for_a_pipe_in_a_run_directory(self):
        """A folder got from somebody: its files are read by commands and by a run that goes on."""
        case, folder = self.write("case.toml", small_bed("2 ms")), self.folder / "run"
        more = ["--set", "output.checkpoint_every=1e-3"]
        self.ends(DONE, "tfm", case, *more, "-o", folder)
        pages = [["report", folder], ["plot", folder]]
        resumed = [["tfm", case, *more, "-o", folder, "--resume", "--until", "3 ms"]]
        for name, commands in (("steps.csv", [pages[0], *resumed]), ("history.csv", [*pages, ["measure", folder], *resumed]),
                               ("profiles.h5", [*pages, ["measure", folder], *resumed]), ("fields.h5", [*pages, *resumed]),
                               ("run.json", pages)):
            path, kept = folder / name, self.folder / "kept"
            os.rename(path, kept)
            os.mkfifo(path)
            for words in commands:
                self.assertRegex(self.ends(FILE, *words).stderr, rf"cannot read \S*{name}: it is no regular file", words)
            os.unlink(path)
            os.rename(kept, path)
        os.unlink(folder / ".polybed")
        os.mkfifo(folder / ".polybed")
        self.ends(DONE, "watch", folder)
        pipe = self.folder / "rows"
        os.mkfifo(pipe)
        self.assertIn("no regular file", self.ends(FILE, "fit", pipe, "-o", self.folder / "fit").stderr)

    def listed(self, file):
        bed = 'volume_share = [0.8, 0.2]\nstatic_height = "12 mm"\n'
        text = small_bed("1 ms").replace(bed, f'start = "list:{file}"\n').replace("start_solids_fraction = 0.4\n", "")
        return self.write(f"list-{pathlib.Path(file).name}.toml", text)

    def test_a_file_longer_than_any_case_is_not_read(self):
        long = self.folder / "long.toml"
        with open(long, "wb") as file:
            file.truncate(10**12)  # without a block on the disk
        self.assertIn("too long", self.ends(FILE, "check", long).stderr)
        done = self.ends(FILE, "check", CASE, "--set", f"effects.solids_stress=table:{long}")
        self.assertIn("too long", done.stderr)


class OtherLayouts(Scratch):
    """Datasets that a run cannot add rows to, as other programs write them: the file is named, and stays as it is."""

    LAYOUTS = {
        "contiguous": lambda group, name, data: group.create_dataset(name, data=data),
        "of a length": lambda group, name, data: group.create_dataset(name, data=data, chunks=True),
        "of integers": lambda group, name, data: group.create_dataset(name, data=data, dtype="i8", maxshape=(None, *data.shape[1:])),
        "of text": lambda group, name, data: group.create_dataset(name, data=np.full(data.shape, b"x"), maxshape=(None, *data.shape[1:])),
        "one number": lambda group, name, data: group.create_dataset(name, data=data.flat[0]),
        "short": lambda group, name, data: group.create_dataset(name, data=data[:1], maxshape=(None, *data.shape[1:])),
        "deeper": lambda group, name, data: group.create_dataset(name, data=data[..., None], maxshape=(None, *data.shape[1:], 1)),
        "narrow": lambda group, name, data: group.create_dataset(name, data=data[..., :-1], maxshape=(None, *data[..., :-1].shape[1:])),
    }

    def test_rows_are_not_added(self):
        case, folder = self.write("case.toml", small_bed("2 ms")), self.folder / "run"
        more = ["--set", "output.checkpoint_every=1e-3", "--set", "output.every=1e-3", "-o", folder]
        self.ends(DONE, "tfm", case, *more)
        kept = {name: (folder / name).read_bytes() for name in ("profiles.h5", "fields.h5")}
        for file, place in (("profiles.h5", "voidage"), ("profiles.h5", "time_s"), ("fields.h5", "time_s")):
            for layout, make in self.LAYOUTS.items():
                if place == "time_s" and layout in ("one number", "short", "narrow", "of integers"):
                    continue  # there are fewer times then, which is another file
                with self.subTest(file=file, place=place, layout=layout):
                    for name, content in kept.items():
                        (folder / name).write_bytes(content)
                    with h5py.File(folder / file, "r+") as content:
                        data = content[place][...]
                        del content[place]
                        make(content, place, data)
                    there = (folder / file).read_bytes()
                    told = self.ends(FILE, "tfm", case, *more, "--resume", "--until", "3 ms").stderr
                    self.assertRegex(told, rf"{place} (cannot be continued: polybed writes|of )")  # text is not read at all
                    self.assertIn(str(folder / file), told)
                    self.assertEqual((folder / file).read_bytes(), there)


SECRET = "password-is-hunter2-and-more-text-follows-here-abcdefghij"


def external(group, name, victim):
    """The numbers of a dataset in a file of the user."""
    shape = group[name].shape
    make_external(group, name, victim, h5py.h5s.create_simple(shape) if shape else h5py.h5s.create(h5py.h5s.SCALAR))


def growing(group, name, victim):
    """The same without rows yet, which whoever goes on appends."""
    columns = group[name].shape[1:]
    make_external(group, name, victim, h5py.h5s.create_simple((0, *columns), (h5py.h5s.UNLIMITED, *columns)))


def make_external(group, name, victim, space):
    del group[name]
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_external(str(victim).encode(), 0, h5py.h5f.UNLIMITED)
    h5py.h5d.create(group.id, name.encode(), h5py.h5t.IEEE_F64LE, space, properties)


def virtual(group, name, victim):
    shape = group[name].shape
    del group[name]
    layout = h5py.VirtualLayout(shape, "f8")
    layout[...] = h5py.VirtualSource(f"{victim}.h5", "data", shape)
    group.create_virtual_dataset(name, layout)


def soft(group, name, _):
    group.move(name, f"{name}_elsewhere")
    group[name] = h5py.SoftLink(f"{group.name}/{name}_elsewhere")


def outward(group, name, victim):
    del group[name]
    group[name] = h5py.ExternalLink(f"{victim}.h5", "data")


class Elsewhere(Scratch):
    """Files of HDF5 whose numbers are in other files: HDF5 would read them, and change them, on its own."""

    def setUp(self):
        super().setUp()
        self.case, self.made = self.write("case.toml", small_bed("2 ms")), self.folder / "made"
        self.more = ["--set", "output.checkpoint_every=1e-3", "--set", "output.every=1e-3"]
        self.ends(DONE, "tfm", self.case, *self.more, "-o", self.made)
        self.victim = self.write("victim", SECRET)
        with h5py.File(f"{self.victim}.h5", "w") as file:
            file["data"] = np.arange(100.0)
            file.create_group("step")["000009"] = 1.0
        self.kept = {path: path.read_bytes() for path in (self.victim, pathlib.Path(f"{self.victim}.h5"))}

    def copy(self, file, place, change):
        folder = self.folder / "run"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.made, folder)
        group, _, name = place.rpartition("/")
        if file == "checkpoint.h5":
            program.unseal(folder / file)
        with h5py.File(folder / file, "r+") as content:
            change(content[group or "/"], name, self.victim)
        if file == "checkpoint.h5":
            program.seal(folder / file)
            (folder / "checkpoint.previous.h5").unlink()
        return folder

    def refused(self, file, place, change, *words):
        told = self.ends(FILE, *words)
        self.assertRegex(told.stderr, rf"{file}\b.*(is a link to another place|are in another file)", (place, change.__name__, words))
        for path, content in self.kept.items():
            self.assertEqual(path.read_bytes(), content)

    def test_a_run_that_goes_on_leaves_other_files_alone(self):
        with h5py.File(self.made / "checkpoint.h5") as file:
            group = next(name for name in file["fields"])
            field = f"fields/{group}/{next(iter(file['fields'][group]))}"
        for file, place in (("profiles.h5", "voidage"), ("profiles.h5", "time_s"), ("fields.h5", "time_s"), ("fields.h5", "grid/x"),
                            ("checkpoint.h5", field), ("checkpoint.h5", "numbers/time_s")):
            for change in (external, growing, virtual, soft, outward):
                if change is growing and place == "grid/x" or change in (growing, virtual) and place.startswith("numbers"):
                    continue  # they have no rows
                folder = self.copy(file, place, change)
                self.refused(file, place, change, "tfm", self.case, *self.more, "-o", folder, "--resume", "--until", "3 ms")

    def test_a_group_elsewhere_is_not_entered(self):
        def other_file(group, name, victim):
            del group[name]
            group[name] = h5py.ExternalLink(f"{victim}.h5", "/step")
        for change in (soft, other_file):
            folder = self.copy("fields.h5", "step", change)
            self.refused("fields.h5", "step", change, "tfm", self.case, *self.more, "-o", folder, "--resume", "--until", "3 ms")

    def test_other_files_are_not_shown(self):
        for file, place, commands in (("profiles.h5", "p", ("report", "plot", "measure")), ("fields.h5", "time_s", ("report", "plot")),
                                      ("fields/000001.h5", "step/voidage", ("report",))):
            for change in (external, virtual, soft, outward):
                folder = self.copy(file, place, change)
                for command in commands:
                    self.refused(file, place, change, command, folder)
                self.assertFalse((folder / "report.html").exists())

    def test_tables_and_checkpoints_that_a_case_names(self):
        for n, change in enumerate((external, virtual, soft, outward)):
            path = self.folder / f"table{n}.h5"
            shutil.copy(TABLE, path)
            with h5py.File(path, "r+") as file:
                change(file, "p_ratio", self.victim)
            self.refused(path.name, "p_ratio", change, "check", TABLE_CASE, *WET, "--set", f"effects.solids_stress=table:{path}")
            with self.assertRaises(polybed.solids_table.DamagedError):
                polybed.solids_table.read_table(path)


class OnTerminals(Scratch):
    """No character of a file acts on a terminal: ESC and BEL, those of C1, and marks that turn the direction of writing."""

    EVIL = "\x1b]0;owned\x07\x1b[2J\x9b31m\u202egnp"

    def harmless(self, words, **options):
        done = run(*words, **options)
        for text in (done.stdout, done.stderr):
            self.assertNotRegex(text, "[\0-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", words)
        return done.stdout + done.stderr

    def test_titles_names_and_keys_are_shown_by_their_escapes(self):
        escapes = self.EVIL.translate({ord(c): f"\\u{ord(c):04x}" for c in "\x1b\x07\x9b\u202e"})
        case = self.write("case.toml", f'title = "{escapes}"\n' + small_bed("1 ms"))
        folder = self.folder / "run"
        for words in (["check", case], ["check", case, "--json"], ["check", case, "--resolved"], ["tfm", case, "-o", folder],
                      ["effects", case]):
            told = self.harmless(words)
            if words[0] in ("check", "tfm"):
                self.assertIn("u001b]0;owned", told.lower(), words)
        title = strict_json(self.ends(DONE, "check", case, "--json").stdout)["case"]
        self.assertIn("owned", title)
        for text in (f'"{escapes}" = 1\n', f'[fluid]\n"{escapes}" = 1\n', f'[effects]\ndrag = "{escapes}"\n'):
            self.assertIn("\\u001b", self.harmless(["check", self.write("wrong.toml", text)]).lower())
        for text in (f"a = '{self.EVIL}'\n", f'[bed]\nstart = "list:{escapes}"\n'):
            self.harmless(["check", self.write("wrong.toml", text)])
        rows = self.write("rows.csv", f"eps,Re\n0.5,{self.EVIL}\n")
        self.assertIn("\\u001b", self.harmless(["drag", "--csv", rows]))
        rows = self.write("rows.csv", f"eps,Re,n\n0.5,1,{self.EVIL}\n")
        self.assertIn("\\u001b", self.harmless(["fit", rows, "-o", self.folder / "fit"]))
        law = self.write("law.json", json.dumps({"filetype": "polybed drag law", "version": 1, "law": self.EVIL}))
        self.assertIn("\\u001b", self.harmless(["drag", "--law", f"file:{law}", "--voidage", "0.5", "--re", "1"]))
        record = strict_json((folder / "run.json").read_text())
        (folder / "run.json").write_text(json.dumps(record | {"filetype": self.EVIL}))
        for command in ("report", "plot", "watch"):
            self.assertIn("\\u001b", self.harmless([command, folder]))
        with self.assertRaisesRegex(polybed.FormatError, r"\\u001b"):
            polybed.read(folder)
        (folder / "run.json").write_text(json.dumps(record | {"state": self.EVIL}))
        self.assertIn("\\u001b", repr(polybed.read(folder)))


class Deep(Scratch):
    def test_keys_nested_without_end_have_their_place(self):
        deep = 60000
        for text, place in ((".".join(["a"] * deep) + " = 1\n", "1:64"), ("\n[" + ".".join(["a"] * deep) + "]\n", "2:65"),
                            ("x = " + "[" * deep, "1:37"), ("x = " + "{a=" * deep, "1:101"),
                            ("x = {" + ".".join(["a"] * deep) + " = 1}", "1:69")):
            done = self.ends(WRONG_CASE, "check", self.write("case.toml", text))
            self.assertIn(f"case.toml:{place}: nested more than 32 deep", done.stderr, text[:20])
        for key in (".".join(["a"] * deep) + "=1", "title={" + ".".join(["a"] * deep) + "=1}"):
            self.assertIn("nested more than 32 deep", self.ends(WRONG_CASE, "check", CASE, "--set", key).stderr)

    def test_what_is_in_quotes_and_comments_does_not_nest(self):
        dots = "[." * 1000
        text = f'title = "{dots}" # {dots}\n' + small_bed("1 ms").replace("[column]", f"# '''{dots}\n[column]")
        self.ends(DONE, "check", self.write("case.toml", text))

    def test_a_long_table_of_the_inlet_takes_time_in_proportion(self):
        """300 000 rows: a search through all of them for each took a hundred times the CPU time allowed here."""
        rows = ", ".join(f"[{n}e-6, 0.01]" for n in range(300000))
        case = self.write("case.toml", small_bed("1 ms").replace('"20 mm/s"', f"[{rows}]"))
        seconds = 40 if "sanitizers" in run("--version").stdout else 8
        done = self.ends(DONE, "check", case, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds)))
        self.assertRegex(done.stdout, r"polybed tfm +0\.001 s on .* of computing")


class Tables(Scratch):
    def changed(self, name, change, seal=True):
        """A table with one dataset or attribute changed, and its checksum set right unless it is to be wrong."""
        path = self.folder / f"{name}.h5"
        shutil.copy(TABLE, path)
        with h5py.File(path, "r+") as file:
            change(file)
            if seal:
                file.attrs["crc32"] = polybed.solids_table.checksum(file)
        return path

    def checked(self, paths):
        return run_all(["check", TABLE_CASE, *WET, "--set", f"effects.solids_stress=table:{path}"] for path in paths)

    def test_numbers_that_cannot_be_are_refused(self):
        wrong = {"p_ratio": (-0.5, 0, 1e9, np.nan), "mu_ratio": (-1,), "gamma_ratio": (np.inf,), "p_ratio_se": (-0.1, np.nan),
                 "p_ratio_n": (-3, 0), "T_ratio_12": (np.nan,), "T_ratio_12_n": (-1,), "phi": (-1, 2, np.nan), "stokes": (-1, np.nan),
                 "e": (np.nan, 1.5), "mu_p": (np.nan, -1), "x2": (np.nan, 2), "S": (np.nan, -1)}
        cases = [(name, value) for name, values in wrong.items() for value in values]

        def put(name, value):
            def change(file):
                data = file[name][...]
                data.flat[0] = value
                file[name][...] = data
            return change
        paths = [self.changed(f"{n}", put(*case)) for n, case in enumerate(cases)]
        for case, done in zip(cases, self.checked(paths)):
            self.assertEqual(done.returncode, FILE, (case, done.stderr))
            self.assertRegex(done.stderr, rf"{case[0]}( number \d+ is .* is possible| must rise)", case)

    def test_shapes_that_do_not_fit_are_refused(self):
        def replaced(name, data):
            def change(file):
                del file[name]
                if data is not None:
                    file[name] = data
            return change
        with h5py.File(TABLE) as file:
            shape = file["p_ratio"].shape
        turned = np.full(shape[1::-1] + shape[2:], 0.5)  # as many numbers
        changes = [replaced(name, data) for name in ("p_ratio", "p_ratio_n", "phi", "e", "S", "T_ratio_12_se")
                   for data in (None, [], [0.5], np.full(1000, 0.5), np.full((2, 2), 0.5), 0.5, turned, turned.ravel())]
        changes += [lambda file: file.attrs.__setitem__("lambda", np.nan), lambda file: file.attrs.__setitem__("size_ratio", -1.0),
                    lambda file: file.attrs.__delitem__("regime")]
        for n, done in enumerate(self.checked([self.changed(f"{n}", change) for n, change in enumerate(changes)])):
            if n == 26:  # e = [0.5] is another table
                continue
            self.assertIn(done.returncode, (FILE, WRONG_CASE), (n, done.stderr))
            self.assertEqual(done.stderr.count("\n"), 1, (n, done.stderr))

    def test_what_are_no_numbers_is_refused_here_and_in_python(self):
        makes = [lambda file, name, data: file.create_dataset(name, data=np.full(data.shape, b"0.5")),
                 lambda file, name, data: file.create_dataset(name, data=np.full(data.shape, "0.5", object), dtype=h5py.string_dtype()),
                 lambda file, name, data: file.create_group(name).create_dataset("values", data=data),
                 lambda file, name, data: file.create_dataset(name, data=np.zeros(data.shape, [("a", "f8"), ("b", "i4")])),
                 lambda file, name, data: file.create_dataset(name, data=data[None])]
        made = []
        for name, make in ((name, make) for name in ("p_ratio", "mu_ratio_se", "phi", "S") for make in makes):
            def change(file, name=name, make=make):
                data = file[name][...]
                del file[name], file.attrs["crc32"]
                make(file, name, data)
            made.append((self.changed(f"{len(made)}", change, seal=False), name))
        for (path, name), done in zip(made, self.checked([path for path, _ in made])):
            self.assertEqual(done.returncode, FILE, (path, done.stderr))
            self.assertRegex(done.stderr, rf"^(?=.*{path})(?=.*\b{name}\b).*\n$", path)
            with self.assertRaisesRegex(polybed.solids_table.DamagedError, rf"{path}.*\b{name}\b"):
                polybed.solids_table.read_table(path).names()

    def test_a_changed_number_is_noticed_here_and_in_python(self):
        def change(file):
            file["p_ratio"][0, 0, 0, 0, 0] *= 1 + 1e-15
        path = self.changed("changed", change, seal=False)
        self.assertIn("checksum", self.checked([path])[0].stderr)
        with self.assertRaisesRegex(polybed.solids_table.DamagedError, "checksum"):
            polybed.solids_table.read_table(path)
        self.assertEqual(self.checked([TABLE])[0].returncode, DONE)  # as it is shipped
        polybed.solids_table.read_table(TABLE)

    def test_a_table_without_a_checksum_is_read_with_a_warning(self):
        path = self.changed("old", lambda file: file.attrs.__delitem__("crc32"), seal=False)
        for table, warned in ((path, 1), (TABLE, 0)):
            directory = self.folder / f"run{warned}"
            done = self.ends(DONE, "tfm", TABLE_CASE, *WET, "--set", f"effects.solids_stress=table:{table}", "--set", "run.until=1e-4",
                             "-o", directory)
            self.assertEqual(done.stderr.count("carries no checksum"), 2 * warned)  # before the run and after it
            warnings = strict_json((directory / "run.json").read_text())["warnings"]
            self.assertEqual(len([line for line in warnings if "carries no checksum" in line]), warned)


if __name__ == "__main__":
    program.main()
