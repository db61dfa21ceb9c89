#!/usr/bin/python3
"""polybed resolve: rows, resume, refusals, and one and two ranks. Usage: resolve_test.py PROGRAM"""
import csv
import re
import shutil
import signal

import h5py

from program import DONE, FILE, LONGEST, STOPPED, TWO_SIZES, WRONG_CASE, Scratch, main, strict_json, wait_until

CASE = """[column]
size = ["10 mm", "40 mm"]
cells = [4, 24]
[fluid]
name = "water"
density = 999
viscosity = "1.14e-3 Pa s"
""" + TWO_SIZES.replace("0.8 mm", "1 mm") + """[bed]
volume_share = [0.5, 0.5]
static_height = "12 mm"
solids_fraction = 0.6
[inlet]
superficial_velocity = "20 mm/s"
[run]
until = "1 s"
[resolve]
voidage = [0.6]
reynolds = [0, 5]
cells_per_diameter = 9
packings = 2
spheres = 9
"""


class Resolve(Scratch):
    def setUp(self):
        super().setUp()
        self.case = self.write("case.toml", CASE)
        self.out = self.folder / "out"

    def resolve(self, *words, code=DONE):
        return self.ends(code, "resolve", self.case, "-o", self.out, "--quiet", *words)

    def test_rows_are_those_of_the_header_and_a_drag_table(self):
        text = self.resolve().stdout
        rows = list(csv.DictReader(text.splitlines()))
        self.assertEqual([row["Re"] for row in rows], ["0", "5"])
        self.assertEqual(text, (self.out / "rows.csv").read_text())
        for row in rows:
            n, f = ([float(row[f"{letter}_{j}"]) for j in (1, 2)] for letter in "nf")
            self.assertGreater(n[1], n[0])  # the coarse feel more, the sum rule holds
            self.assertAlmostEqual(float(row["x1"]) + float(row["x2"]), 1, delta=1e-6)
            y = [float(row[f"D{j}"]) * sum(float(row[f"x{k}"]) / float(row[f"D{k}"]) for k in (1, 2)) for j in (1, 2)]
            mean = [sum(float(row[f"x{j + 1}"]) * v[j] / y[j] ** 2 for j in (0, 1)) for v in (n, f)]
            self.assertAlmostEqual(mean[1] / mean[0], 0.6, delta=0.02)
            self.assertLess(float(row["imbalance"]), 1e-4)
        self.assertGreater(float(rows[1]["n_1"]), float(rows[0]["n_1"]))
        told = list(csv.DictReader(self.ends(DONE, "drag", "--law", "cello", "--csv", self.out / "rows.csv").stdout.splitlines()))
        for row, by_law in zip(rows, told, strict=True):
            for j in (1, 2):  # 9 spheres in one box: the right size, no more
                self.assertLess(abs(float(row[f"n_{j}"]) / float(by_law[f"n_{j}"]) - 1), 0.5)

    def test_finished_boxes_are_kept(self):
        first = self.resolve("--set", "resolve.reynolds=[0]").stdout
        self.assertIn("--resume", self.resolve(code=WRONG_CASE).stderr)
        boxes = (self.out / "boxes.csv").read_text()
        again = self.resolve("--set", "resolve.reynolds=[0]", "--resume").stdout
        self.assertEqual(again, first)
        self.assertEqual((self.out / "boxes.csv").read_text(), boxes)
        told = self.ends(DONE, "resolve", self.case, "-o", self.out, "--set", "resolve.reynolds=[0]", "--resume").stderr
        self.assertIn("standard errors from 2 packings, without Student's factor: too few for a 95 % interval", told)
        self.out = self.folder / "other"
        self.resolve("--resume", code=FILE)

    def test_only_whole_rows_of_boxes_count(self):
        """A full disk cuts the last number of a row, 10.3249 to 10; other damage leaves a number that none wrote."""
        words = ["--set", "resolve.reynolds=[0]", "--resume"]
        rows = self.resolve(*words[:-1]).stdout
        path = self.out / "boxes.csv"
        whole = path.read_text()
        lines = whole.split("\n")[:-1]
        self.assertEqual(len(lines), 5, "a header, and two packings on two grids")
        cells = lines[1].split(",")
        forces = [",".join([*cells[:7], value, *cells[8:]]) for value in ("inf", "nan", "1" + cells[7])]
        for damaged in (whole[:-1], whole[:-16], whole.replace(cells[7], "1" + cells[7]), *(whole.replace(lines[1], row) for row in forces),
                        whole.replace(lines[1], ",".join(cells[:-1]))):
            path.write_text(damaged)
            again = self.resolve(*words)
            self.assertIn("boxes.csv: 1 row is cut short, damaged or without a check: not used", again.stderr)
            self.assertEqual(again.stdout, rows)
            self.assertEqual(sorted(row.split(",")[7:9] for row in path.read_text().split("\n")[1:-1]),
                             sorted(row.split(",")[7:9] for row in lines[1:]))

    def test_a_box_goes_on_where_it_was_stopped(self):
        # Double precision, whose limit of change it takes a second to reach; 22 spheres in one box.
        words = ["--set", "resolve.reynolds=[5]", "--set", "resolve.packings=1", "--set", "resolve.spheres=22",
                 "--set", 'resolve.precision="double"', "--set", 'resolve.checkpoint_every="1 ms"']
        rows = self.resolve(*words).stdout
        self.assertFalse(list(self.out.glob("box-*")))
        for how, code in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGTERM, STOPPED)):
            self.out = self.folder / how.name
            kept_boxes = lambda: [path for path in self.out.glob("box-*.h5") if ".previous" not in path.name]
            running = self.start("resolve", self.case, "-o", self.out, "--quiet", *words)
            wait_until(running, kept_boxes)
            running.send_signal(how)
            running.communicate(timeout=LONGEST)
            self.assertEqual(running.returncode, code)
            [box] = kept_boxes()
            with h5py.File(box) as file:
                kept = file["integers/steps"][()]
            if code == STOPPED:
                shutil.copytree(self.out, self.folder / "on-two")
            again = self.ends(DONE, "resolve", self.case, "-o", self.out, "--resume", *words)
            self.assertEqual(int(re.search(r"(\d+) steps", again.stderr)[1]), kept)
            self.assertEqual(again.stdout, rows)
            self.assertFalse(box.exists())
        self.assertEqual(self.on_ranks(2, "-o", self.folder / "on-two", "--resume", *words), rows)

    def on_ranks(self, ranks, *words):
        """The rows of a run on ranks."""
        return super().on_ranks(ranks, "resolve", self.case, "--quiet", *words).stdout

    def test_ranks_share_the_boxes_and_find_the_same(self):
        words = ["--set", "resolve.reynolds=[0]"]
        rows = self.resolve(*words).stdout
        boxes = lambda folder: {line.split(",")[0] for line in (folder / "boxes.csv").read_text().splitlines()[1:]}
        for ranks in (2, 3):
            folder = self.folder / f"on-{ranks}"
            self.assertEqual(self.on_ranks(ranks, "-o", folder, *words), rows)
            self.assertEqual((folder / "rows.csv").read_text(), rows)
            self.assertEqual(boxes(folder), boxes(self.out))

    def test_what_cannot_be_resolved_is_refused_with_its_number(self):
        for words, said in ((["resolve.cells_per_diameter=6", "resolve.voidage=[0.4]"], "resolve.cells_per_diameter = 6"),
                            (["resolve.reynolds=[250]"], "resolve.reynolds = 250"),
                            (["resolve.spheres=4"], "resolve.spheres = 4"),
                            (["resolve.voidage=[0.1]"], "resolve.voidage")):
            sets = [word for key in words for word in ("--set", key)]
            self.assertIn(said, self.resolve(*sets, code=WRONG_CASE).stderr)
        self.assertFalse(self.out.exists())

    def test_estimate_runs_nothing(self):
        told = strict_json(self.resolve("--estimate", "--json").stdout)
        self.assertFalse(self.out.exists())
        self.assertEqual([(p["eps"], p["Re"]) for p in told["points"]], [(0.6, 0), (0.6, 5)])
        self.assertAlmostEqual(sum(p["time_s"] for p in told["points"]), told["time_s"], delta=1e-9 * told["time_s"])
        # 25 sites an edge and one layer round them, 80 bytes each, and what the links take, less than as much again.
        sites = 27**3 * 80
        self.assertTrue(sites < told["memory_bytes"] < 2 * sites, told["memory_bytes"])
        more = strict_json(self.resolve("--estimate", "--json", "--set", "resolve.packings=4").stdout)
        part = lambda found: found["time_s"] * found["sites_per_second"]
        self.assertAlmostEqual(part(more) / part(told), 2, delta=1e-9)

    def rows(self, *words):
        return [{name: float(cell) for name, cell in row.items() if cell} for row in csv.DictReader(self.resolve(*words).stdout.splitlines())]

    def test_shares_that_spheres_miss_are_noted(self):
        words = ["resolve", self.case, "-o", self.out, "--estimate", "--set", "resolve.spheres=12"]
        self.assertRegex(self.ends(DONE, *words).stderr, r"(?m)^note: \d+ \+ \d spheres have the volume shares 0\.\d+, 0\.\d+, the case 0\.5, 0\.5: ")

    def test_relative_motion_adds_up_to_the_held_drag(self):
        words = ["--set", "resolve.reynolds=[0]", "--set", "resolve.grids=1"]
        [held] = self.rows(*words)
        self.out = self.folder / "moving"
        words += ["--set", "resolve.motion=moving"]
        [row] = self.rows(*words)
        for j in (1, 2):
            # Each flow is steady to 1e-4; f_j is the sum of what is printed in six digits.
            self.assertAlmostEqual(row[f"f_{j}"], held[f"f_{j}"], delta=1e-3 * held[f"f_{j}"])
            self.assertAlmostEqual(row[f"n_{j}"], held[f"n_{j}"], delta=1e-3 * held[f"n_{j}"])
            self.assertAlmostEqual(row[f"f_{j}_1"] + row[f"f_{j}_2"], row[f"f_{j}"], delta=1e-4 * row[f"f_{j}"])
        self.ends(DONE, "drag", "--law", "cello", "--csv", self.out / "rows.csv")
        boxes = (self.out / "boxes.csv").read_text().splitlines()
        self.assertEqual(len(boxes), 5, "a header, and two packings past two species")
        (self.out / "boxes.csv").write_text("\n".join(boxes[:-1]) + "\n")  # the last one is run again
        self.assertEqual(self.rows(*words, "--resume"), [row])
        self.assertEqual(self.on_ranks(2, "-o", self.folder / "on-2", *words), (self.out / "rows.csv").read_text())

    def test_moving_spheres_travel_above_stokes_flow(self):
        words = [word for key in ("grids=1", "packings=1", "reynolds=[0,5]", "voidage=[0.8]", "cells_per_diameter=6", "spheres=6")
                 for word in ("--set", f"resolve.{key}")] + ["--set", "species.coarse.diameter=1.2e-3"]
        held = self.rows(*words)[1]
        self.out = self.folder / "moving"
        words += ["--set", "resolve.motion=moving"]
        row = self.rows(*words)[1]
        self.assertEqual(len((self.out / "boxes.csv").read_text().splitlines()), 1 + 2 + 3, "two species alone; then also both")
        for j in (1, 2):
            self.assertEqual(row[f"f_{j}"], held[f"f_{j}"])  # one box with the same bits
            self.assertAlmostEqual(row[f"f_{j}_1"] + row[f"f_{j}_2"], row[f"f_{j}"], delta=1e-4 * row[f"f_{j}"])
            self.assertGreater(row[f"f_{j}_{j}"], 0)
        self.assertEqual(self.on_ranks(2, "-o", self.folder / "on-2", *words), (self.out / "rows.csv").read_text())

    def test_free_spheres_go_on_with_the_same_bits_on_any_ranks(self):
        words = [word for key in ("motion=free", "grids=1", "reynolds=[0]", "voidage=[0.8]", "spheres=30", "cells_per_diameter=6", 'until="0.2 s"')
                 for word in ("--set", f"resolve.{key}")] + ["--set", "fluid.viscosity=0.01"]
        self.assertNotIn("Re 0", self.resolve(*words, "--estimate").stdout)  # the weight decides on it
        text = self.resolve(*words).stdout
        [row] = csv.DictReader(text.splitlines())
        self.assertGreater(float(row["Re"]), 0)
        for j in (1, 2):
            self.assertGreater(float(row[f"u_{j}"]), 0)
            self.assertGreater(float(row[f"v_{j}"]), 0)
        self.assertLess(float(row["imbalance"]), 1e-4)  # single precision
        pairs = (self.out / "pairs.csv").read_text()
        self.assertEqual({(line["j"], line["k"]) for line in csv.DictReader(pairs.splitlines())}, {("1", "1"), ("1", "2"), ("2", "2")})
        self.out = self.folder / "stopped"
        running = self.start("resolve", self.case, "-o", self.out, "--quiet", *words, "--set", 'resolve.checkpoint_every="1 ms"')
        wait_until(running, lambda: list(self.out.glob("box-*.h5")))
        running.send_signal(signal.SIGTERM)
        running.communicate(timeout=LONGEST)
        self.assertEqual(running.returncode, STOPPED)
        self.assertEqual(self.on_ranks(2, "-o", self.out, "--resume", *words), text)
        self.assertEqual((self.out / "pairs.csv").read_text(), pairs)

    def test_json_names_the_table(self):
        answer = strict_json(self.resolve("--json", "--set", "resolve.reynolds=[0]", "--set", "resolve.packings=1").stdout)
        self.assertEqual(answer["table"], (self.out / "rows.csv").read_text())


if __name__ == "__main__":
    main()
