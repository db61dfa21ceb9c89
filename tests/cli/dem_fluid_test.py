#!/usr/bin/python3
"""polybed dem with a fluid as its user meets it: files, record, resumed runs, refusals. Usage: dem_fluid_test.py PROGRAM"""
import h5py
import numpy as np

import program
from program import DONE, ROOT, WRONG_CASE, Scratch, history, rising, same_bits, strict_json

# 630 spheres of two sizes in rising water; a step takes about 100 microseconds.
BED = rising('size = ["10 mm", "60 mm"]\ncells = [3, 18]', [600, 30], 0.45, "", """[run]
until = "60 ms"
[output]
every = "15 ms"
history_every = "0.125 ms"
checkpoint_every = "15 ms"
""")
# 200 spheres of 4 mm over a jet of air: a fall tells their speed, the jet that of the fluid. 42/0.42 m/s cross half a cell of 10 mm
# in 50 microseconds.
JET = """[column]
size = ["50 mm", "120 mm"]
depth = "8.8 mm"
cells = [5, 12]
[fluid]
density = 1.205
viscosity = 1.8e-5
[[species]]
name = "bead"
diameter = "4 mm"
density = 2700
[bed]
particles = [200]
solids_fraction = 0.58
start = "mixed"
start_solids_fraction = 0.45
[inlet]
superficial_velocity = 0
[[jet]]
from = ["20 mm"]
to = ["30 mm"]
superficial_velocity = "42 m/s"
[effects]
others = "none"
drag = "gidaspow"
contact = "linear"
[dem]
normal_stiffness = 20000
[run]
until = "5 ms"
"""
STRIP = ROOT / "cases/quarter-b/case.toml"
RESULTS = ("checkpoint.h5", "fields.h5", "particles.h5", "profiles.h5")
FIELDS = {"voidage", "pressure", "u_fluid", "phi_fine", "u_fine", "phi_coarse", "u_coarse"}
VOLUME = {"fine": 600 * np.pi / 6 * 0.8e-3**3, "coarse": 30 * np.pi / 6 * 2e-3**3}  # m3
CELL = 0.01 / 3 * 0.06 / 18 * (2 * 2e-3 + 2 * 0.08e-3)  # m3; the depth: two of the largest, twice a tenth of the least


class Bed(Scratch):
    def setUp(self):
        super().setUp()
        self.case = self.write("case.toml", BED)

    def dem(self, code, directory, *words, case=None):
        return self.ends(code, "dem", case or self.case, "--quiet", "--no-picture", "-o", self.folder / directory, *words)

    def last(self, directory):
        """Fields of the last step by name."""
        with h5py.File(self.folder / directory / "fields.h5") as file:
            step = file[f"step/{len(file['time_s']):06d}"]
            return {name: step[name][()] for name in step if name != "paraview"}


class Files(Bed):
    def test_fields_hold_the_fluid_and_the_species(self):
        self.dem(DONE, "run", "--set", "dem.fluid_every=1", "--until", "15 ms")  # fields and particles of one moment
        fields = self.last("run")
        self.assertEqual(set(fields), FIELDS)
        self.assertEqual((fields["voidage"].shape, fields["u_fine"].shape), ((18, 3), (18, 3, 2)))
        # 1 less a sum of two; rounding
        np.testing.assert_allclose(fields["voidage"], 1 - fields["phi_fine"] - fields["phi_coarse"], atol=1e-15)
        with h5py.File(self.folder / "run/particles.h5") as file:
            step = file[f"step/{len(file['time_s']):06d}"]
            for n, name in enumerate(("fine", "coarse")):
                # shares are cut to whole units of a 2^62th of all, four of each particle
                self.assertAlmostEqual(fields[f"phi_{name}"].sum() * CELL / VOLUME[name], 1, delta=1e-12)
                of = step["species"][()] == n
                flux = (fields[f"phi_{name}"][..., None] * fields[f"u_{name}"]).sum(axis=(0, 1)) * CELL
                mean = step["velocity"][of][:, :2].mean(axis=0) * VOLUME[name]
                # the same shares in floating point: rounding of a few thousand terms, against the sum of magnitudes
                most = np.abs(step["velocity"][of]).mean() * VOLUME[name]
                np.testing.assert_allclose(flux, mean, atol=1e-11 * most)

    def test_what_flows_in_flows_out(self):
        """Above the bed the fluid alone carries the superficial velocity; the residual of the pressure is 1e-8 of the
        imbalance before it, which is less than the velocity."""
        self.dem(DONE, "run", "--until", "15 ms")
        np.testing.assert_allclose(self.last("run")["u_fluid"][-2:, :, 1], 0.02, rtol=1e-6)
        with h5py.File(self.folder / "run/profiles.h5") as file:
            self.assertLessEqual({"p", "u_fluid", "voidage", "phi_fine", "u_coarse"}, set(file))
            fields = self.last("run")
            np.testing.assert_allclose(file["p"][-1], fields["pressure"].mean(axis=1), rtol=1e-12, atol=1e-12)
            np.testing.assert_allclose(file["u_fluid"][-1], fields["u_fluid"][..., 1].mean(axis=1), rtol=1e-12)
        self.assertIn("u_fluid", (self.folder / "run/fields.xdmf").read_text())

    def test_the_fluid_carries_the_bed(self):
        self.dem(DONE, "run")
        rows = history(self.folder / "run")
        for name, values in rows.items():
            self.assertTrue(all(v is None or np.isfinite(v) for v in values), name)
        area = 0.01 * (2 * 2e-3 + 2 * 0.08e-3)
        weight = 9.81 * (VOLUME["fine"] * (1395 - 999) + VOLUME["coarse"] * (1170 - 999)) / area
        np.testing.assert_allclose(rows["buoyant_weight_Pa"], weight, rtol=1e-12)
        # It is lifted without touching the bottom. Over half the run its momentum changes by what 2 % of its weight give:
        # seen, with a random packing, 1 %.
        ratio = np.mean(rows["pressure_drop_Pa"][240:]) / weight
        self.assertAlmostEqual(ratio, 1, delta=0.03)
        self.assertLess(max(rows["max_solids_fraction"]), 0.74)  # the densest packing of equal spheres
        self.assertGreater(min(rows["max_solids_fraction"]), 0.4)

    def test_the_record_tells_of_the_fluid(self):
        record = strict_json(self.dem(DONE, "run", "--json", "--until", "15 ms").stdout)
        fluid = record["fluid"]
        self.assertEqual((fluid["every"], fluid["kernel"], fluid["kernel_width_m"]), (16, "bilinear", 0))
        self.assertEqual(fluid["steps"], record["work"]["steps"] // 16)
        self.assertAlmostEqual(fluid["dt_s"] / record["step"]["dt_s"], 16)
        self.assertGreaterEqual(fluid["iterations"], fluid["steps"])
        self.assertLessEqual(fluid["worst_residual"], 1e-8)  # what is asked of the solver
        self.assertLess(fluid["greatest_courant"], 1)
        self.assertGreater(fluid["greatest_courant"], 0)
        self.assertEqual(fluid["drag"]["law"], "cello")
        self.assertGreaterEqual(fluid["drag"]["evaluations"], 2 * fluid["steps"] * record["particles"])  # at both ends of a step
        self.assertEqual(fluid["work_J"], history(self.folder / "run")["work_J"][-1])
        self.assertLess(record["energy"]["worst_error"], record["energy"]["limit"])

    def test_two_lines_on_the_screen(self):
        text = self.ends(DONE, "dem", self.case, "--no-picture", "--details", "-o", self.folder / "run", "--until", "2 ms").stderr
        self.assertRegex(text, r"\nfluid: \d+ steps of .*Courant number up to .*; kernel bilinear; its forces change by .* % in a step\n"
                               r"drag cello: .* evaluations, .* % guarded, .* % at the bounds of voidage; work of the fluid ")

    def test_its_pictures_show_both(self):
        self.dem(DONE, "run", "--until", "15 ms")
        done = self.ends(DONE, "plot", self.folder / "run", "--what", "overview,fields,particles,profiles,history", "--format", "svg",
                         "--out", self.folder / "drawn", picture=True)
        self.assertEqual(len(done.stdout.split()), 5)
        for picture, text in (("fields", "vertical velocity"), ("profiles", "net pressure"), ("profiles", "<!-- fluid -->"),
                              ("history", "pressure drop")):
            self.assertIn(text, (self.folder / f"drawn/{picture}.svg").read_text(), picture)  # texts are comments beside glyphs

    def test_without_a_fluid_there_is_none_of_it(self):
        dry = BED.replace('name = "water"\ndensity = 999\nviscosity = "1.14e-3 Pa s"', 'name = "none"')
        dry = dry.replace('[inlet]\nsuperficial_velocity = "20 mm/s"\n', "").replace('drag = "cello"\n', "")
        self.dem(DONE, "run", "--until", "1 ms")
        self.assertTrue((self.folder / "run/fields.h5").exists())
        done = self.dem(DONE, "run", "--until", "1 ms", "--json", "--force", case=self.write("dry.toml", dry))
        self.assertNotIn("fluid", strict_json(done.stdout))
        self.assertEqual([p.name for p in (self.folder / "run").glob("fields*")], [])
        with h5py.File(self.folder / "run/profiles.h5") as file:
            self.assertFalse({"p", "u_fluid"} & set(file))
        self.assertNotIn("max_solids_fraction", history(self.folder / "run"))

    def test_a_gas_that_is_compressible(self):
        words = ["--set", "fluid.name=air", "--set", "fluid.equation_of_state=ideal_gas", "--set", "fluid.density=1.2", "--set",
                 "fluid.viscosity=1.8e-5", "--set", "inlet.superficial_velocity=0.5", "--until", "2 ms"]
        record = strict_json(self.dem(DONE, "run", "--json", *words).stdout)
        self.assertGreater(record["fluid"]["steps"], 0)
        self.assertEqual(set(self.last("run")), FIELDS | {"total_pressure", "density_fluid"})
        # the fluid's part of the column at the density given, within what the bed's weight, 70 Pa, does to 1e5 Pa
        free = 54 * CELL - sum(VOLUME.values())
        self.assertAlmostEqual(history(self.folder / "run")["mass_fluid_kg"][-1] / (1.2 * free), 1, delta=1e-3)


class GoOn(Bed):
    """A checkpoint falls between two steps of the fluid, and rows of the history between it and the next."""

    def same(self, case, until, *words):
        self.dem(DONE, "whole", *words, "--until", until[1], case=case)
        self.dem(DONE, "parts", *words, "--until", until[0], case=case)
        self.dem(DONE, "parts", *words, "--until", until[1], "--resume", case=case)
        whole, parts = self.folder / "whole", self.folder / "parts"
        for name in RESULTS:
            self.assertEqual(same_bits(whole / name, parts / name), [], name)
        self.assertEqual((whole / "history.csv").read_bytes(), (parts / "history.csv").read_bytes())
        records = [strict_json((run / "run.json").read_text()) for run in (whole, parts)]
        self.assertNotEqual(records[0]["work"]["steps"] % records[0]["fluid"]["every"], 0)
        self.assertEqual(program.lasting(whole), program.lasting(parts))

    def test_resumed_is_the_same_to_the_bit(self):
        self.same(self.case, ("15 ms", "30 ms"), "--set", "chooser.monitor=warn", "--set", "chooser.tolerance=1e-6",
                  "--set", "chooser.monitor_every=7")

    def test_with_a_kernel_too(self):
        self.same(self.case, ("4 ms", "8 ms"), "--set", "column.cells=[6,36]", "--set", "output.checkpoint_every=4e-3",
                  "--set", "output.every=4e-3")

    def test_the_strip_of_system_b(self):
        self.same(STRIP, ("2 ms", "4 ms"), "--set", "output.checkpoint_every=2e-3", "--set", "output.every=2e-3",
                  "--set", "output.history_every=1e-4")
        rows = history(self.folder / "whole")
        for name, values in rows.items():
            self.assertTrue(all(v is None or np.isfinite(v) for v in values), name)
        self.assertEqual(len(rows["time_s"]), 41)


class Check(Bed):
    def test_what_it_says_is_what_the_run_does(self):
        words = ["--until", "15 ms"]
        need = strict_json(self.ends(DONE, "check", self.case, "--json", "--set", "run.until=15e-3").stdout)["dem"]
        record = strict_json(self.dem(DONE, "run", "--json", *words).stdout)
        self.assertEqual(need["particles"], {"fine": 600, "coarse": 30})
        self.assertEqual(need["step"], record["step"])
        for key in ("every", "dt_s", "kernel", "kernel_width_m"):
            self.assertEqual(need["fluid"][key], record["fluid"][key], key)
        self.assertAlmostEqual(need["fluid"]["steps"], record["fluid"]["steps"], delta=1)
        self.assertEqual(need["fluid"]["cells"], 54)

    def test_the_kernel_and_why(self):
        text = self.ends(DONE, "check", self.case, "--details").stdout
        for line in (r"as particles, polybed dem:", r"630 particles: 600 fine, 30 coarse", r"memory about \d+ MB: .* fluid [\d.]+,",
                     r"fluid step [\d.e-]+ s, one in 16 of the particles': [\d.e+]+ steps on 54 cells",
                     r"kernel bilinear: the smallest cell has 1.67 of the largest diameters"):
            self.assertRegex(text, line)
        finer = self.ends(DONE, "check", self.case, "--details", "--set", "column.cells=[6,36]").stdout
        # 600 of 0.8 mm and 30 of 2 mm: 4 (307 + 240)/(307/0.8 + 240/2) mm
        self.assertIn("kernel diffusion, 4.34 mm wide: 2.2 of the largest diameters, as the smallest cell has only 0.833", finer)
        smeared = "the fluid sees the particles averaged over 4.34 mm"
        self.assertIn(smeared, finer)
        for other in (text, self.ends(DONE, "check", self.case, "--details", "--set", "column.cells=[6,36]", "--set", "dem.kernel_width=8 mm").stdout):
            self.assertNotIn(smeared, other)

    def test_steps_of_the_fluid_fit_a_jet(self):
        case = self.write("jet.toml", JET)
        need = strict_json(self.ends(DONE, "check", case, "--json").stdout)
        every, fluid = need["dem"]["fluid"]["every"], need["dem"]["fluid"]["dt_s"]
        self.assertEqual(every, int(50e-6 / need["dem"]["step"]["dt_s"]))
        self.assertAlmostEqual(fluid, every * need["dem"]["step"]["dt_s"], places=12)
        self.assertFalse([note for note in need["notes"] if "fluid_every" in note])
        record = strict_json(self.dem(DONE, "jet", "--json", case=case).stdout)
        self.assertEqual(record["fluid"]["every"], every)
        self.assertLess(record["fluid"]["greatest_courant"], 1)
        told = " ".join(strict_json(self.ends(DONE, "check", case, "--json", "--set", "dem.fluid_every=50").stdout)["notes"])
        self.assertRegex(told, r"dem\.fluid_every = 50: the fluid is expected to move by [\d.]+ cells in its step")
        self.assertIn(f"use at most {int(100e-6 / need['dem']['step']['dt_s'])}", told)

    def test_what_keeps_it_from_running_is_told(self):
        def notes(*words):
            return strict_json(self.ends(DONE, "check", self.case, "--json", *words).stdout)["notes"]
        self.assertFalse([n for n in notes() if "cannot" in n])
        compressible = ["--set", "column.outlet=open", "--set", "fluid.equation_of_state=tait"]
        self.assertTrue([n for n in notes(*compressible) if 'column.outlet = "open" in a compressible fluid: polybed tfm can run it' in n])
        self.assertTrue([n for n in notes("--set", "column.depth=3e-3") if "polybed dem cannot run it: column.depth" in n])

    def test_memory_is_that_of_a_run(self):
        """Of many cells; 30 %, as for particles alone, for how the parts of the solver vary."""
        if "sanitizers" in program.run("--version").stdout:
            self.skipTest("the address sanitizer keeps memory that was given back")
        words = ["--set", "column.cells=[120,720]", "--set", "run.until=3e-4"]
        need = strict_json(self.ends(DONE, "check", self.case, "--json", *words).stdout)["dem"]
        held = 1e-6 * program.peak_memory("dem", self.case, "--quiet", "--no-picture", *words, "-o", self.folder / "run")
        self.assertGreater(need["memory"]["fluid_MB"], 0.4 * need["memory_MB"])
        self.assertAlmostEqual(need["memory_MB"], held, delta=0.3 * held)


class Refused(Bed):
    def test_what_particles_cannot_do_in_a_fluid(self):
        told = self.dem(WRONG_CASE, "run", "--set", "column.outlet=open", "--set", "fluid.equation_of_state=tait").stderr
        self.assertIn('column.outlet = "open"', told)
        self.assertFalse((self.folder / "run/run.json").exists())

    def test_all_at_once(self):
        told = self.dem(WRONG_CASE, "run", "--set", "column.gravity_direction=[1,-1]", "--set", "dem.kernel=bilinear",
                        "--set", "dem.kernel_width=0.01", "--set", "dem.held=true", "--set", "effects.drag=none").stderr
        for key in ("column.gravity_direction", "dem.kernel_width", "dem.held"):
            self.assertIn(key, told)

    def test_cells_that_the_particles_do_not_fit_into(self):
        done = program.run("dem", self.case, "--quiet", "--no-picture", "-o", self.folder / "run", "--set", "column.cells=[20,120]",
                           "--set", "dem.kernel=bilinear")
        self.assertNotEqual(done.returncode, DONE)
        self.assertRegex(done.stderr, r"the cell near \([\d.e-]+, [\d.e-]+, [\d.e-]+\) m has a voidage of -?[\d.]+")
        self.assertIn('dem.kernel = "diffusion"', done.stderr)


if __name__ == "__main__":
    program.main()
