#!/usr/bin/python3
"""Particles in a fluid on several ranks: what a run stores of both. Usage: dem_fluid_ranks_test.py PROGRAM"""
import json
import pathlib
import sys

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "cli")]
import open_mpi  # noqa: E402
from program import TWO_SIZES, Scratch, datasets, history, main, same_bits  # noqa: E402

# 630 spheres of two sizes in rising water, on few cells.
BED = """[column]
size = ["27 mm", "60 mm"]
cells = [8, 18]
[fluid]
name = "water"
temperature = "15 degC"
""" + TWO_SIZES + """[bed]
particles = [600, 30]
solids_fraction = 0.6
start = "mixed"
start_solids_fraction = 0.45
[inlet]
superficial_velocity = "20 mm/s"
[effects]
others = "none"
drag = "cello"
contact = "hertz_mindlin"
[dem]
youngs_modulus = "0.3 MPa"
kernel = "bilinear"
[run]
until = "10 ms"
[output]
every = "5 ms"
history_every = "0.5 ms"
checkpoint_every = "5 ms"
"""
# 3150 of them in a tube, whose wall cuts the cells.
ROUND = [word for setting in ("column.shape=cylinder", "column.size=[0.018,0.018,0.06]", "column.cells=[6,6,20]",
                              "bed.particles=[3000,150]") for word in ("--set", setting)]
# 1575 of them where it is a cone below.
CONE = [*ROUND, *(word for setting in ("column.profile=[[0,0.012],[0.024,0.018],[0.06,0.018]]", "bed.particles=[1500,75]")
                  for word in ("--set", setting))]
FILES = ("fields.h5", "particles.h5", "profiles.h5", "checkpoint.h5")


class FluidOnRanks(Scratch):
    def on(self, ranks, *words):
        self.on_ranks(ranks, "dem", self.folder / "case.toml", "--quiet", *words)

    def setUp(self):
        super().setUp()
        self.write("case.toml", BED)
        self.one = self.folder / "one"
        self.on(1, "-o", self.one)

    def record(self, run):
        return json.loads((run / "run.json").read_text())["fluid"]

    def test_each_with_the_whole_fluid_stores_the_same_bits(self):
        for ranks in (2,) if open_mpi.SHORT else (2, 3):
            run = self.folder / f"on{ranks}"
            self.on(ranks, "-o", run, "--set", "dem.fluid_ranks=auto")  # of few cells
            for name in FILES[:3]:
                self.assertEqual(same_bits(self.one / name, run / name), [], name)
            self.assertEqual((self.one / "history.csv").read_bytes(), (run / "history.csv").read_bytes())
            self.assertEqual(self.record(run), self.record(self.one))
            self.assertEqual(self.record(run)["ranks"], "each")

    def test_a_shared_fluid_stores_the_same_to_the_solver(self):
        """Pressure to 1e-8 of the imbalance of each of some 40 steps; contacts do not yet make more of it."""
        for ranks in (2,) if open_mpi.SHORT else (2, 4):
            run = self.folder / f"on{ranks}"
            self.on(ranks, "-o", run, "--set", "dem.fluid_ranks=shared")
            self.assertEqual(self.record(run)["ranks"], "shared")
            for name in ("fields.h5", "profiles.h5"):
                ours, other = datasets(self.one / name), datasets(run / name)
                self.assertEqual(set(ours), set(other))
                for path, values in ours.items():
                    np.testing.assert_allclose(other[path], values, rtol=0, atol=1e-6 * max(np.abs(values).max(), 1e-12),
                                               err_msg=path)
            self.check_particles(datasets(run / "particles.h5"), ranks)

    def test_a_shared_fluid_goes_on_from_a_checkpoint(self):
        """The first rank alone knows what the run had done before."""
        whole, parted = self.folder / "whole", self.folder / "parted"
        shared = ["--set", "dem.fluid_ranks=shared", "-o"]
        self.on(2, *shared, whole)
        self.on(2, *shared, parted, "--until", "5 ms")
        self.on(2, *shared, parted, "--resume")
        for name in FILES[:3]:
            self.assertEqual(same_bits(whole / name, parted / name), [], name)
        self.assertEqual(self.record(whole), self.record(parted))

    def test_jets_in_sides_store_the_same_on_several_ranks_and_after_a_restart(self):
        jets = ["--set", 'jet=[{at="left", from=[0.005], to=[0.012], superficial_velocity=0.06}, '
                         '{at="right", from=[0.01], to=[0.03], superficial_velocity=[[0, 0], [0.004, 0.03]]}]']
        one, each, parted = (self.folder / name for name in ("jets", "each", "parted"))
        self.on(1, *jets, "-o", one)
        self.on(2, *jets, "-o", each)
        self.on(2, *jets, "-o", parted, "--until", "5 ms")
        self.on(2, *jets, "-o", parted, "--resume")
        for name in FILES[:3]:
            self.assertEqual(same_bits(one / name, each / name), [], name)
            self.assertEqual(same_bits(one / name, parted / name), [], name)
        self.assertNotEqual(same_bits(one / "fields.h5", self.one / "fields.h5"), [])

    def check_round(self, words):
        one, each, shared, parted = (self.folder / name for name in ("round", "each", "shared", "parted"))
        self.on(1, *words, "-o", one)
        self.on(2, *words, "-o", each)
        self.on(2, *words, "-o", parted, "--until", "5 ms")
        self.on(2, *words, "-o", parted, "--resume")
        for name in FILES[:3]:
            self.assertEqual(same_bits(one / name, each / name), [], name)
            self.assertEqual(same_bits(one / name, parted / name), [], name)
        self.on(2, *words, "-o", shared, "--set", "dem.fluid_ranks=shared")
        self.assertEqual(self.record(shared)["ranks"], "shared")
        ours, other = datasets(one / "fields.h5"), datasets(shared / "fields.h5")
        for path, values in ours.items():
            np.testing.assert_allclose(other[path], values, rtol=0, atol=1e-6 * max(np.abs(values).max(), 1e-12), err_msg=path)

    def test_a_box_with_joined_ends_stores_the_same_on_several_ranks_and_after_a_restart(self):
        box = BED.replace('[inlet]\nsuperficial_velocity = "20 mm/s"\n', "").replace("start_solids_fraction = 0.45\n", "")
        self.write("case.toml", box.replace("[fluid]", 'sides = "periodic"\nends = "periodic"\n[fluid]'))
        self.check_round([])
        gradient = history(self.folder / "round")["pressure_gradient_Pa_m"]
        self.assertEqual(len(set(gradient)), 1)
        self.assertLess(gradient[0], 0)
        momentum = history(self.folder / "round")["mass_velocity_m_s"]
        self.assertLess(max(map(abs, momentum)), 1e-15)  # of some mm/s: round-off of a thousand terms

    def test_a_round_column_stores_the_same_on_several_ranks_and_after_a_restart(self):
        self.check_round(ROUND)

    def test_a_cone_stores_the_same_on_several_ranks_and_after_a_restart(self):
        self.check_round(CONE)

    def check_ports(self, *more):
        self.check_round([*ROUND, *(word for setting in (
            'feed=[{species="fine", at="left", from=[0.006,0.04], to=[0.012,0.05], superficial_velocity=0.02, velocity=0.2}]',
            'discharge=[{at="right", from=[0.006,0.005], to=[0.012,0.012], superficial_velocity=0.05}, '
            '{at="back", from=[0.005,0.02], to=[0.011,0.026], pressure=-5}]', *more) for word in ("--set", setting))])

    def test_ports_in_a_tube_store_the_same_on_several_ranks_and_after_a_restart(self):
        self.check_ports()

    def test_ports_in_a_graded_tube_store_the_same_on_several_ranks_and_after_a_restart(self):
        self.check_ports("column.grading=1.2", "column.graded_above=0.015")

    def check_particles(self, found, ranks):
        """What each step's pressure lets go wrong with a particle is 1e-8 of what the fluid does to it in that step, so that
        velocities and spins are off by 1e-8 of the greatest, and places by 1e-8 of the longest way. In 10 ms contacts do
        not multiply it: on 2 and 4 ranks 5e-12 was seen. Later particles part, as chaotic systems do."""
        ours = datasets(self.one / "particles.h5")
        self.assertEqual(set(ours), set(found))
        start = ours["/step/000001/position"]
        for path, values in ours.items():
            quantity = path.rsplit("/", 1)[-1]
            if quantity not in ("position", "velocity", "spin"):
                np.testing.assert_array_equal(found[path], values, err_msg=path)
                continue
            scale = np.abs(values - start if quantity == "position" else values).max()
            np.testing.assert_allclose(found[path], values, rtol=0, atol=1e-8 * scale, err_msg=f"{ranks} ranks, {path}")


if __name__ == "__main__":
    main()
