#!/usr/bin/python3
"""Particles that are fed, or that a fluid carries out, on 1, 2, 3 and 4 ranks: the same bits of all of them and of what has entered and
left, with and without a restart on another number of ranks."""
import json
import random

import dem_ranks_test
from dem_ranks_test import LISTED, STIFF, Scratch, main

# a slot that is fed from above while it empties
FILLING = """
[column]
size = ["16 mm", "24 mm"]
cells = [4, 6]
depth = "4 mm"
""" + LISTED + """solids_fraction = 0.6
[[feed]]
species = "a"
at = "top"
superficial_velocity = "0.15 m/s"
velocity = "1.5 m/s"
from = ["1 mm"]
to = ["15 mm"]
[dem]
friction = 0.3
greatest_speed = "3 m/s"
""" + STIFF + 'opening = "7 mm"\n'

# the same in a round silo over a cone: fed through the whole circle
ROUND = """wall = [{shape="cone", from=[0.007, 0], to=[0.016, 0.008]}]
""" + FILLING.replace('size = ["16 mm", "24 mm"]\ncells = [4, 6]\ndepth = "4 mm"', 'shape = "cylinder"\nsize = ["16 mm", "16 mm", "24 mm"]\ncells = [4, 4, 6]'
                      ).replace('from = ["1 mm"]\nto = ["15 mm"]\n', "")
# and where the cone is the column's own
TAPERED = ROUND.replace('wall = [{shape="cone", from=[0.007, 0], to=[0.016, 0.008]}]\n', "").replace(
    "cells = [4, 4, 6]", "cells = [10, 10, 6]\nprofile = [[0, 0.007], [0.008, 0.016], [0.024, 0.016]]")


def above_slot():
    """A block of 10 by 8 by 3 particles above a slot, on its way down."""
    spread = random.Random(4)
    return [f"a,{(1.04 * i + 3.3) * 1e-3},{(1.04 * j + 0.6) * 1e-3},{(1.3 * k + 0.7) * 1e-3},"
            f"{spread.uniform(-0.2, 0.2)},{spread.uniform(-1.1, -0.7)},{spread.uniform(-0.2, 0.2)},0,0,0"
            for i in range(10) for j in range(8) for k in range(3)]


# the same water over a block of light particles that fly out through its top
LEAVING = dem_ranks_test.WET.replace("depth", 'outlet = "open"\ndepth').replace("50 mm/s", "0.3 m/s").replace(
    'particles = [80, 120]\nstart = "mixed"', 'start = "list:particles.csv"').replace("start_solids_fraction = 0.4\n", "")


# the same water through whose left side particles are fed, and which takes others out through the right one
SIDES = dem_ranks_test.WET + """[[feed]]
species = "b"
at = "left"
from = ["3 mm"]
to = ["15 mm"]
superficial_velocity = "40 mm/s"
velocity = "0.25 m/s"
[[discharge]]
at = "right"
from = ["2 mm"]
to = ["14 mm"]
superficial_velocity = "0.2 m/s"
"""
# and without it, thrown at the hole
THROWN = dem_ranks_test.CORNER.replace("40 mm", "21 mm").replace(LISTED, LISTED + "solids_fraction = 0.6\n") + """[[discharge]]
at = "right"
from = ["2 mm"]
to = ["24 mm"]
superficial_velocity = 0
[[feed]]
species = "a"
at = "left"
from = ["26 mm"]
to = ["29 mm"]
superficial_velocity = "20 mm/s"
velocity = "0.5 m/s"
"""


def below_top():
    """A block of 10 by 4 by 2 particles, the uppermost 0.3 mm below the top."""
    spread = random.Random(5)
    return [f"b,{(1.1 * i + 0.9) * 1e-3},{(1.0 * j + 20.3) * 1e-3},{(1.2 * k + 0.6) * 1e-3},"
            f"{spread.uniform(-0.1, 0.1)},{spread.uniform(0.3, 0.45)},{spread.uniform(-0.1, 0.1)},0,0,0"
            for i in range(10) for j in range(4) for k in range(2)]


def above_cone():
    """Two layers of particles that fill the circle above the cone, on their way down."""
    spread = random.Random(5)
    return [f"a,{(1.04 * i + 8) * 1e-3},{(1.1 * j + 9) * 1e-3},{(1.04 * k + 8) * 1e-3},"
            f"{spread.uniform(-0.2, 0.2)},{spread.uniform(-1.1, -0.7)},{spread.uniform(-0.2, 0.2)},0,0,0"
            for i in range(-7, 8) for j in range(2) for k in range(-7, 8) if 1.04 * (i * i + k * k) ** 0.5 < 7.4]


class FeedRanks(Scratch):
    start_on, on, scene, check_same = (getattr(dem_ranks_test.DemRanks, name) for name in ("start_on", "on", "scene", "check_same"))

    def test_particles_that_enter(self):
        records = self.check_same(self.scene(FILLING, above_slot()), restart=(3, 4), numbers=(1, 2, 3, 4))
        passed = {json.dumps([record["feed"], record["outflow"], record["energy"]["carried_in_J"]]) for record in records.values()}
        self.assertEqual(len(passed), 1, passed)
        self.assertEqual(records[1]["feed"]["a"], {"particles": 128, "mass_kg": records[1]["feed"]["a"]["mass_kg"], "waiting": 0})

    def check_hopper(self, silo):
        """Particles meet the side and the cone, whose contacts are in the histories."""
        records = self.check_same(self.scene(silo, above_cone()), restart=(3, 2), numbers=(1, 2, 3))
        passed = {json.dumps([record["feed"], record["outflow"], record["energy"]["carried_in_J"]]) for record in records.values()}
        self.assertEqual(len(passed), 1, passed)
        self.assertGreater(records[1]["feed"]["a"]["particles"], 100)

    def test_particles_that_enter_a_round_hopper(self):
        self.check_hopper(ROUND)

    def test_particles_that_enter_a_tapered_column(self):
        self.check_hopper(TAPERED)

    def test_particles_that_enter_a_fluid(self):
        feed = '[[feed]]\nspecies = "b"\nat = "top"\nsuperficial_velocity = "40 mm/s"\nvelocity = "0.25 m/s"\n'
        case = self.scene(dem_ranks_test.WET + feed, common=dem_ranks_test.WITH_FLUID)
        records = self.check_same(case, restart=(4, 2), numbers=(1, 2, 4), steps=dem_ranks_test.FEWER)
        self.assertEqual(records[1]["feed"]["b"]["particles"], 17)  # 40 mm/s of 28.8 mm2 for 4 ms

    def check_sides(self, case, **words):
        records = self.check_same(case, **words)
        passed = {json.dumps([record["feed"], record["outflow"], record["particles"], record["energy"]["carried_out_J"]]) for record in records.values()}
        self.assertEqual(len(passed), 1, passed)
        return records[1]

    def test_particles_that_cross_the_sides_of_a_fluid(self):
        record = self.check_sides(self.scene(SIDES, common=dem_ranks_test.WITH_FLUID), restart=(3, 2), numbers=(1, 2, 3),
                                  steps=dem_ranks_test.FEWER)
        self.assertEqual(record["feed"]["b"]["particles"], 17)  # 40 mm/s of 28.8 mm2 for 4 ms

    def test_particles_that_cross_a_side_with_a_pressure(self):
        side = SIDES.replace('superficial_velocity = "0.2 m/s"', 'pressure = "-20 Pa"')
        self.check_sides(self.scene(side, common=dem_ranks_test.WITH_FLUID), restart=(3, 2), numbers=(1, 2, 3), steps=dem_ranks_test.FEWER)

    def test_particles_that_cross_the_sides(self):
        record = self.check_sides(self.scene(THROWN, dem_ranks_test.in_corner()), restart=(3, 2), numbers=(1, 2, 3))
        self.assertGreater(record["outflow"]["a"]["particles"], 5)
        self.assertGreater(record["feed"]["a"]["particles"], 0)

    def test_particles_that_a_fluid_carries_out(self):
        case = self.scene(LEAVING, below_top(), common=dem_ranks_test.WITH_FLUID)
        records = self.check_same(case, restart=(4, 2), numbers=(1, 2, 4), steps=dem_ranks_test.FEWER, touching=False)
        left = {json.dumps([record["outflow"], record["particles"], record["energy"]["carried_out_J"]]) for record in records.values()}
        self.assertEqual(len(left), 1, left)
        out = records[1]["outflow"]["b"]["particles"]
        self.assertGreater(out, 10)  # most of the 20 uppermost: 1.1 mm at 0.3 to 0.45 m/s for 4 ms
        self.assertEqual(out + records[1]["particles"], 80)


if __name__ == "__main__":
    main()
