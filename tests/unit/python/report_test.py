#!/usr/bin/python3
"""The page of a run, piece by piece, on runs that the C++ writers have written: report_test.py WRITER PACKAGE_DIRECTORY"""

import base64
import hashlib
import html
import json
import re
import shlex
import subprocess
import sys
import tempfile
import types
import unittest
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

WRITER, PACKAGE = sys.argv[1], sys.argv[2]
sys.path.insert(0, PACKAGE)

from report_pages import EVIL, Page, add_case, data_of

import polybed
from polybed.report import beds, build, ports, sections, series

MOST_BYTES = 10e6  # of a page


def unpacked(text, kind):
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), dtype=kind)


class GradedCells(unittest.TestCase):
    def test_rows_and_columns_of_a_map_are_as_small_as_the_smallest_cell(self):
        run = types.SimpleNamespace(faces={"x": np.array([0, 1, 3, 4]), "y": np.array([0, 1, 2, 4])}, record={"case": ""})
        rows, columns = beds.even_rows(run)
        np.testing.assert_array_equal(rows, [0, 1, 2, 2])
        np.testing.assert_array_equal(columns, [0, 1, 1, 2])


class SampleRun(unittest.TestCase):
    """Two species in a column of 60 mm by 200 mm, 18 x 60 cells, five times from 0 to 1 s; see write_sample_run.cpp."""

    kind = 2

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = Path(scratch.name) / "bed-tfm"
        subprocess.run([WRITER, self.directory, str(self.kind)], check=True)
        self.sample = polybed.read(self.directory)

    def page(self):
        path, size, seconds = build.write(self.directory)
        self.assertEqual(path.stat().st_size, size)
        self.assertGreater(seconds, 0)
        return path.read_text()


class Whole(SampleRun):
    def test_it_stands_alone_and_names_are_escaped(self):
        add_case(self.directory)
        text = self.page()
        page = Page(text)
        self.assertEqual(page.loaded, [], "nothing is loaded from elsewhere")
        self.assertFalse(any("onerror" in attributes for _, attributes in page.elements))
        self.assertIn(EVIL, "".join(page.text), "the title is shown as it is written")
        self.assertEqual(len([1 for tag, _ in page.elements if tag == "script"]), 2)

    def test_whatever_a_run_says_is_text(self):
        """Every text of run.json and of its case, and what limited the steps, in place of what the program writes."""
        card_of_run = {"lines": [f"bed           {EVIL}", EVIL], "steady": False}
        case = f"title = {json.dumps(EVIL)}\n[effects]\n{json.dumps(EVIL)} = {json.dumps(EVIL)}\n"
        (self.directory / "steps.csv").write_text(f'time_s,dt_s,error_norm,limited_by\n1,1,0.1,"{EVIL}"\n')
        for evil in ({"card": card_of_run}, {"card": None}):
            add_case(self.directory, **evil, case=case, state=EVIL, model=EVIL, program=EVIL, git_commit=EVIL, case_hash=EVIL,
                     timers={EVIL: 1.0}, work={EVIL: 1}, invariants=[{"name": EVIL, "worst": 1, "limit": 0}], step={"limited_by": EVIL})
            parts = build.parts(polybed.read(self.directory)) | {"all": ("", self.page())}
            for name, (_, text) in parts.items():
                page = Page(text)
                self.assertLessEqual({tag for tag, _ in page.elements} & {"img", "script"}, {"script"} if name == "all" else set(), name)
                self.assertFalse(any(of.startswith("on") for _, attributes in page.elements for of in attributes), name)
            self.assertEqual(len([1 for tag, _ in page.elements if tag == "script"]), 2)
            self.assertGreater("".join(page.text).count(EVIL), 10)

    def test_it_names_what_may_run(self):
        text = self.page()
        policy = next(attributes["content"] for _, attributes in Page(text).elements if attributes.get("http-equiv") == "Content-Security-Policy")
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("unsafe", policy)
        scripts = re.findall(r"<script>(.*?)</script>", text, re.S)
        self.assertEqual(len(scripts), 1)
        digest = base64.b64encode(hashlib.sha256(scripts[0].encode()).digest()).decode()
        self.assertIn(f"script-src 'sha256-{digest}';", policy)
        self.assertNotIn(" style=", re.sub(r"<script.*?</script>", "", text, flags=re.S))

    def test_sections(self):
        add_case(self.directory)
        shown = "".join(Page(self.page()).text)
        for words in ("Results", "The bed", "History", "Invariants", "Effects", "19 %, up to 22 %", "The case", "How to cite", "Commands",
                      "superficial" if self.kind == 2 else "fine"):
            self.assertIn(words, shown)

    def test_a_bare_run_has_a_page(self):
        for name in ("profiles.h5", "history.csv", "run.json"):
            (self.directory / name).unlink()
        self.assertIn("no run.json yet", "".join(Page(self.page()).text))

    def test_a_run_without_anything_stored(self):
        empty = self.directory.parent / "empty"
        empty.mkdir()
        path, _, _ = build.write(empty)
        Page(path.read_text())

    def test_damaged_files_are_told(self):
        record = json.loads((self.directory / "run.json").read_text()) | {"case": "no = [toml"}
        (self.directory / "run.json").write_text(json.dumps(record))
        with self.assertRaisesRegex(polybed.FormatError, "case in run.json"):
            build.write(self.directory)

    def test_the_command(self):
        line = [sys.executable, f"{PACKAGE}/polybed/isolated.py", "polybed.report.build"]
        done = subprocess.run([*line, self.directory], capture_output=True, text=True, env={"PYTHONPATH": PACKAGE})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"report\.html \([\d.e-]+ MB, made in [\d.]+ s\)")
        self.assertEqual(subprocess.run([*line, "nowhere"], capture_output=True, env={"PYTHONPATH": PACKAGE}).returncode, 4)


class Maps(SampleRun):
    def test_levels_are_the_fields(self):
        maps = data_of(self.page())["maps"]
        fine = next(m for m in maps["maps"] if (m["kind"], m["label"]) == ("solids", "fine"))
        levels = unpacked(fine["levels"], np.uint8).reshape(5, maps["ny"], maps["nx"])
        found = levels / (series.EMPTY - 1) * (fine["high"] - fine["low"]) + fine["low"]
        half_a_level = 0.5 * (fine["high"] - fine["low"]) / (series.EMPTY - 1)
        np.testing.assert_allclose(found, self.sample.phi_fine[:][:, : maps["ny"]], atol=1.001 * half_a_level)
        self.assertEqual(maps["time"], [0, 0.25, 0.5, 0.75, 1])

    def test_the_top_is_a_fifth_above_the_solids_of_all_times(self):
        # see plot_test.py: the highest cell with solids ends at 35/300 m at 1 s; 42 of 60 cells of 200 mm
        maps = data_of(self.page())["maps"]
        self.assertEqual(maps["ny"], 42)
        self.assertAlmostEqual(maps["size"][1], 140)

    def test_no_velocity_where_a_species_is_absent(self):
        maps = data_of(self.page())["maps"]
        up = next((m for m in maps["maps"] if (m["kind"], m["label"]) == ("velocity", "fine")), None)
        if up is not None:
            levels = unpacked(up["levels"], np.uint8).reshape(5, maps["ny"], maps["nx"])
            np.testing.assert_array_equal(levels == series.EMPTY, self.sample.phi_fine[:][:, : maps["ny"]] <= 0.01)
        fluid = next(m for m in maps["maps"] if (m["kind"], m["label"]) == ("velocity", "fluid"))
        self.assertEqual(fluid["low"], -fluid["high"])

    def test_averages_of_cells(self):
        values = np.arange(20.0).reshape(4, 5)
        np.testing.assert_array_equal(beds.coarse(values, 2), [[3, 5], [13, 15]])
        self.assertIs(beds.coarse(values, 1), values)


class Maps3D(Maps):
    kind = 3

    def test_levels_are_the_fields(self):
        maps = data_of(self.page())["maps"]
        fine = next(m for m in maps["maps"] if (m["kind"], m["label"]) == ("solids", "fine"))
        levels = unpacked(fine["levels"], np.uint8).reshape(5, maps["ny"], maps["nx"])
        half_a_level = 0.5 * fine["high"] / (series.EMPTY - 1)
        np.testing.assert_allclose(levels / (series.EMPTY - 1) * fine["high"], self.sample.phi_fine[:][:, 2, : maps["ny"]], atol=1.001 * half_a_level)
        self.assertIn("half depth", maps["note"])

    def test_no_velocity_where_a_species_is_absent(self):
        pass


class Particles(SampleRun):
    """300 particles of 2 and 4 mm diameter on a lattice, one fewer at each time; see write_sample_run.cpp."""

    kind = "particles"

    def test_places_are_those_of_the_particles(self):
        found = data_of(self.page())["particles"]
        low, high, count = np.array(found["low"]), np.array(found["high"]), found["count"]
        self.assertEqual(count, 300)
        parts = unpacked(found["places"], np.uint8).reshape(2, 5, count, 3).astype(np.uint16)
        places = np.cumsum(parts[0] + 256 * parts[1], axis=0, dtype=np.uint16)
        ids = np.unique(np.concatenate([step.id for step in self.sample.particles]))
        for n, step in enumerate(self.sample.particles):
            there = places[n, :, 0] != 65535
            self.assertEqual(list(ids[there]), sorted(step.id), "one that has gone is not drawn")
            order = np.argsort(step.id)
            metres = places[n][there] / 65534 * (high - low) + low
            np.testing.assert_allclose(metres, 1e3 * step.position[order], atol=0.5001 * (high - low).max() / 65534)
            np.testing.assert_allclose(unpacked(found["radius"], "<f4")[there], 1e3 * step.radius[order], rtol=1e-6)
            np.testing.assert_array_equal(unpacked(found["species"], np.uint8)[there], step.species[order])

    def test_walls_and_opening_are_outlined(self):
        """The column is 60 mm wide and 8 mm deep. A slot of 10 mm in the middle, and a wall up to 150 mm, far above the particles."""
        wall = '[[wall]]\nfrom = [0.0, 0.15]\nto = [0.02, 0.01]\n[dem]\nopening = 0.01\n'
        add_case(self.directory, case="[column]\nsize = [0.06, 0.2]\n" + wall)
        found = data_of(self.page())["particles"]
        width, _, depth = found["size"]
        slab, slot = found["outlines"]
        self.assertEqual(slab, [[0, 150, 0], [20, 10, 0], [20, 10, depth], [0, 150, depth]])
        self.assertEqual(slot, [[width / 2 - 5, 0, 0], [width / 2 + 5, 0, 0], [width / 2 + 5, 0, depth], [width / 2 - 5, 0, depth]])
        self.assertGreaterEqual(found["size"][1], 150, "the view shows the wall")
        rod = '[[wall]]\nshape = "rod"\nfrom = [0.03, 0.05]\nthickness = 0.02\n'
        add_case(self.directory, case="[column]\nsize = [0.06, 0.2]\n" + rod)
        lines = data_of(self.page())["particles"]["outlines"]
        for x, y, z in lines[0] + lines[1]:
            self.assertAlmostEqual(np.hypot(x - 30, y - 50), 10, places=2)
        self.assertEqual({z for line in lines[:2] for _, _, z in line}, {0, depth})
        tube = '[[wall]]\nshape = "cylinder"\nfrom = [0.03, 0.05]\nto = [0.03, 0.1]\nthickness = 0.004\n'
        add_case(self.directory, case="[column]\nsize = [0.06, 0.06, 0.2]\n" + tube)
        radii = {round(float(np.hypot(x - width / 2, z - depth / 2)), 2)
                 for line in data_of(self.page())["particles"]["outlines"] for x, _, z in line}
        self.assertEqual(radii, {13, 17})
        add_case(self.directory, case="[column]\nsize = [0.06, 0.06, 0.2]\n[dem]\nopening = 0.01\n")
        [hole] = data_of(self.page())["particles"]["outlines"]
        for x, y, z in hole:
            self.assertAlmostEqual(np.hypot(x - width / 2, z - depth / 2), 5, places=2)
            self.assertEqual(y, 0)
        add_case(self.directory)
        self.assertEqual(data_of(self.page())["particles"]["outlines"], [])

    def test_ports_are_outlined(self):
        """On the side of a box, 60 mm wide and 8 mm deep in the sample; on the wall of a tube as wide as the sample's box."""
        jet = '[[jet]]\nat = "left"\nfrom = [0.02]\nto = [0.03]\n'
        add_case(self.directory, case="[column]\nsize = [0.06, 0.2]\n" + jet)
        [[name, _, line]] = data_of(self.page())["particles"]["ports"]
        self.assertEqual(name, "jet1")
        self.assertEqual([(min(x), max(x)) for x in zip(*line)], [(0, 0), (20, 30), (0, 8)])
        port = '[[discharge]]\nat = "right"\nfrom = [0.002, 0.02]\nto = [0.006, 0.03]\n'
        add_case(self.directory, case='[column]\nshape = "cylinder"\nsize = [0.06, 0.06, 0.2]\n' + port)
        [[name, _, line]] = data_of(self.page())["particles"]["ports"]
        self.assertEqual(name, "discharge1")
        for x, _, z in line:
            self.assertAlmostEqual(np.hypot(x - 30, z - 30), 30, places=1)
        add_case(self.directory)
        self.assertEqual(data_of(self.page())["particles"]["ports"], [])

    def test_ports_are_written_for_paraview(self):
        """As VTK's own reader finds them: names from codes of letters that end with a 0, points of each line up to its offset."""
        jet = '[[jet]]\nat = "left"\nfrom = [0.02]\nto = [0.03]\n[[discharge]]\nat = "bottom"\nfrom = [0.01]\nto = [0.05]\n'
        add_case(self.directory, case="[column]\nsize = [0.06, 0.2]\n" + jet)
        piece = ElementTree.parse(ports.write(self.directory)).getroot().find("PolyData/Piece")
        arrays = {array.get("Name", "points"): np.array(array.text.split(), float) for array in piece.iter() if array.get("format")}
        points, offsets = arrays["points"].reshape(-1, 3), arrays["offsets"].astype(int)
        self.assertEqual((piece.get("NumberOfPoints"), piece.get("NumberOfLines")), (str(len(points)), "2"))
        self.assertEqual((*arrays["connectivity"], offsets[-1]), (*range(len(points)), len(points)))
        self.assertEqual(bytes(arrays["name"].astype(np.uint8)).split(b"\0"), [b"jet1", b"discharge1", b""])
        self.assertEqual(list(arrays["kind"]), [0, 2])
        for line, corners in zip(np.split(points, offsets[:-1]), (((0, 0.02, 0), (0, 0.03, 0.008)), ((0.01, 0, 0), (0.05, 0, 0.008)))):
            np.testing.assert_allclose([line.min(axis=0), line.max(axis=0), line[0] - line[-1]], [*corners, (0, 0, 0)], atol=1e-12)
        add_case(self.directory, case='[column]\nshape = "axisymmetric"\nsize = [0.06, 0.2]\n' + jet)
        self.assertNotIn("0.008", ports.write(self.directory).read_text(), "in the plane in which such a run is stored")
        add_case(self.directory)
        self.assertIsNone(ports.write(self.directory))


class Noise:
    """A run whose fields, or particles, are noise, which nothing compresses: the worst that there is for the size of a page."""

    def __init__(self, steps, cells, species):
        self.generator = np.random.default_rng(1)
        self.time, self.cells = np.linspace(0, 1, steps), cells
        self.species = [f"s{n}" for n in range(species)]
        self.kinds = {name: [name] for name in self.species}
        self.fields = [*(f"phi_{name}" for name in self.species), *(f"u_{name}" for name in self.species), "voidage", "u_fluid"]
        self.faces = {"x": np.linspace(0, 0.1, cells[1] + 1), "y": np.linspace(0, 0.3, cells[0] + 1)}
        self.size, self.dimensions, self.record, self.open = (0.1, 0.3), 2, {}, None

    def noise(self, name):
        return self.generator.random((*self.cells, 2) if name.startswith("u_") else self.cells)

    def field(self, name):
        return [self.noise(name)]

    def fields_at(self, _, names):
        return {name: self.noise(name) for name in names}


class NoisyParticles:
    def __init__(self, steps, count):
        self.generator = np.random.default_rng(2)
        self.time, self.count = np.linspace(0, 1, steps), np.full(steps, count)
        self.species, self.size = ["fine"], np.array([0.1, 0.3, 0.1])

    def __len__(self):
        return len(self.time)

    def __getitem__(self, _):
        count = self.count[0]
        return types.SimpleNamespace(id=np.arange(count), species=np.zeros(count, int), radius=np.full(count, 1e-3),
                                     position=self.generator.random((count, 3)) * self.size, velocity=self.generator.random((count, 3)))


class Sizes(unittest.TestCase):
    def test_a_hundred_frames_of_noise_are_below_the_limit(self):
        # of both kinds together, which no run has; the rest of a page is below 1 MB
        maps = beds.maps_of(Noise(100, (200, 70), 3))
        run = types.SimpleNamespace(particles=NoisyParticles(100, 20_000), size=(0.1, 0.3), record={})
        particles = beds.particles_of(run)
        self.assertLess(len(json.dumps([maps, particles])), MOST_BYTES - 1e6)
        self.assertGreaterEqual(len(maps["time"]), 20, "most frames of this size fit, were they not noise")
        self.assertIn("of 100 stored times", maps["note"])
        self.assertGreaterEqual(len(particles["time"]), beds.FEWEST_STEPS)
        self.assertEqual(particles["open"], run.particles.time[-1])

    def test_all_frames_are_kept_where_they_fit(self):
        run = Noise(100, (60, 20), 2)
        run.noise = lambda name: np.zeros((*run.cells, 2) if name.startswith("u_") else run.cells)
        maps = beds.maps_of(run)
        self.assertEqual(len(maps["time"]), 100)
        self.assertEqual(maps["note"], "")

    def test_a_fine_grid_is_averaged(self):
        maps = beds.maps_of(Noise(2, (900, 300), 1))
        self.assertLessEqual(maps["nx"] * maps["ny"], beds.MOST_CELLS)
        self.assertIn("mean of 3 x 3 cells", maps["note"])


class Numbers(unittest.TestCase):
    def test_prefixes(self):
        for value, unit, told in ((2.3, "m/s", "2.3 m/s"), (0.0023, "m/s", "2.3 mm/s"), (1.0, "m", "1 m"), (0.9999, "m", "1e+03 mm"),
                                  (4.5e-7, "s", "450 ns"), (101325, "Pa", "101 kPa"), (2.5e-6, "kg", "2.5 mg"), (3.2, "kg", "3.2 kg"),
                                  (2e-6, "m2/s2", "2 mm\u00b2/s\u00b2"), (0, "m", "0 m"), (0.25, "1", "0.25")):
            self.assertEqual(polybed.texts.text(value, unit), told)

    def test_every_nth_entry_keeps_the_last(self):
        self.assertEqual(list(series.thinned(10, 4)), [0, 3, 6, 9])
        self.assertEqual(list(series.thinned(9, 4)), [2, 5, 8])
        self.assertEqual(list(series.thinned(3, 4)), [0, 1, 2])

    def test_levels(self):
        np.testing.assert_array_equal(series.levels([0, 0.5, 1, 7, np.nan], 0, 1), [0, 127, 254, 254, series.EMPTY])
        self.assertEqual(series.plain_numbers([1.234567, np.nan]), [1.2346, None])


class Written(unittest.TestCase):
    def test_reasons_without_their_place(self):
        self.assertEqual(sections.reason_of("error test: u_fine.y (0, 1)"), "error test: u_fine.y")
        self.assertEqual(sections.reason_of("stop at output"), "stop at output")

    def test_a_run_that_drifts_has_the_command_that_goes_on(self):
        run = types.SimpleNamespace(directory=Path("runs/bed"))
        for state, steady, told in (("done", False, '--resume --until "40 s"'), ("done", True, None), ("stopped by the user", None, "--resume\n")):
            text = sections.commands(run, {"model": "tfm", "state": state, "time_s": 20, "card": {"steady": steady}}).replace("&quot;", '"')
            self.assertEqual("--resume" in text, told is not None)
            self.assertIn(told or "polybed plot", text)

    def test_a_command_that_is_copied_runs_polybed_alone(self):
        text = html.unescape(sections.commands(types.SimpleNamespace(directory=Path("a;b")), {"model": "tfm; touch x", "state": "running"}))
        for line in text.removeprefix("<pre>").split("\n# in Python")[0].split("\n"):
            if not line.startswith("#"):
                self.assertEqual([word for word in shlex.shlex(line, punctuation_chars=True) if word == ";"], [], line)

    def test_shares_of_steps(self):
        with tempfile.TemporaryDirectory() as scratch:
            path = Path(scratch) / "steps.csv"
            path.write_text('time_s,dt_s,error_norm,limited_by\n1,1,0.1,"drag at (0, 1)"\n2,1,0.1,"drag at (0, 2)"\n5,3,0.1,"growth"\n'
                            '6,inf,0.1,"growth"\n6,1,0.1,"gro\n6,1,0.1,"gro')
            seconds, steps = sections.limits_of_steps(path)
        self.assertEqual((dict(seconds), dict(steps)), ({"drag": 2, "growth": 3}, {"drag": 2, "growth": 1}))

    def test_a_recorded_card_is_rendered(self):
        rows = ["bed           fluidised, mixed, 271 \u00b1 4 mm high", "fluidises at  fine <b> 1.05 mm/s", "              estimate by Beverloo's law"]
        found = Page(sections.recorded(rows))
        self.assertEqual([tag for tag, _ in found.elements].count("td"), 6)
        self.assertIn("bedfluidised, mixed, 271 \u00b1 4 mm highfluidises atfine <b> 1.05 mm/sestimate", "".join(found.text))


class Gallery(unittest.TestCase):
    def test_films_of_the_docs_are_small(self):
        films = [path for ending in ("gif", "mp4") for path in (Path(PACKAGE).parent / "docs/pictures").glob(f"*.{ending}")]
        self.assertTrue(films)
        for path in films:
            self.assertLess(path.stat().st_size, 2e6, path.name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
