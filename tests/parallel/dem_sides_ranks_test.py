#!/usr/bin/python3
"""Lift, spin, history, heat motion and lubrication of particles in a fluid on 1, 2 and 3 ranks: the same bits of all that is kept of them, with and
without a restart on another number of ranks."""
import json

import h5py

import dem_ranks_test
from dem_ranks_test import Scratch, main

# a crowd in a narrow column that the fluid lifts: faster in the middle than at the walls
CASE = """
[column]
size = ["12 mm", "24 mm"]
depth = "2.4 mm"
cells = [6, 12]
[fluid]
name = "test liquid"
temperature = "20 degC"
density = 1000
viscosity = "1e-3 Pa s"
[inlet]
superficial_velocity = "30 mm/s"
[[species]]
name = "a"
diameter = "1 mm"
density = 1800
[bed]
start = "list:particles.csv"
[effects]
others = "none"
drag = "cello"
fluid_stress = "newtonian"
contact = "hertz_mindlin"
lift = "saffman_mei"
magnus = "rubinow_keller"
history = "basset"
brownian = "langevin"
added_mass = "zuber"
lubrication = "LUBRICATION"
[dem]
friction = 0.3
greatest_speed = "1 m/s"
fixed_step = "10 us"
fluid_every = 8
kernel = "bilinear"
[run]
until = "20 ms"
[output]
every = "20 ms"
history_every = "20 ms"
checkpoint_every = "10 ms"
"""


def crowd():
    """Rows of particles that fly sideways and spin."""
    return [f"a,{(1.3 * i + 1.2) * 1e-3},{(1.3 * j + 1.2) * 1e-3},{1.1e-3},{0.1 * (-1) ** j},{0.02 * i},0,0,{10 * i},{50 - 20 * j}"
            for i in range(8) for j in range(9)]


class SideRanks(Scratch):
    start_on, on = dem_ranks_test.DemRanks.start_on, dem_ranks_test.DemRanks.on

    def arrays(self, run):
        with h5py.File(run / "checkpoint.h5") as file:
            return {name: file["arrays"][name][()].tobytes() for name in file["arrays"]}

    def test_the_same_bits_on_any_number_of_ranks(self):
        self.check("film")

    def test_likewise_with_wet_contacts(self):
        self.check("wet_restitution")

    def check(self, lubrication):
        self.write("particles.csv", "\n".join(["species,x,y,z,vx,vy,vz,wx,wy,wz", *crowd()]) + "\n")
        case = self.write("case.toml", CASE.replace("LUBRICATION", lubrication))
        runs = {}
        for ranks in (1, 2, 3):
            self.on(ranks, case, "-o", self.folder / str(ranks))
            runs[ranks] = self.arrays(self.folder / str(ranks))
        self.assertEqual(len(runs[1]["fluid_sides"]), 8 * 53 * 72)
        self.assertGreater(len(runs[1]["contacts"]), 0)
        for ranks in (2, 3):
            for name, numbers in runs[1].items():
                self.assertEqual(numbers, runs[ranks][name], f"{name} on {ranks} ranks")
        cut = self.folder / "cut"
        self.on(2, case, "--until", "10 ms", "-o", cut)
        self.assertNotEqual(self.arrays(cut)["fluid_sides"], runs[1]["fluid_sides"])
        self.on(3, case, "--resume", "-o", cut)
        self.assertEqual(self.arrays(cut), runs[1])

    def test_the_chooser_and_its_monitor_say_the_same_on_any_number_of_ranks(self):
        self.write("particles.csv", "\n".join(["species,x,y,z,vx,vy,vz,wx,wy,wz", *crowd()]) + "\n")
        effects = CASE.index("[effects]"), CASE.index("[dem]")
        case = self.write("auto.toml", 'effects = "auto"\n[chooser]\nmonitor_every = 20\nmonitor_sample = 3\n' +
                          CASE[:effects[0]] + CASE[effects[1]:])
        records = {}
        for ranks in (1, 3):
            self.on(ranks, case, "--until", "4 ms", "-o", self.folder / f"auto-{ranks}")
            records[ranks] = json.loads((self.folder / f"auto-{ranks}/run.json").read_text())
        self.assertIn("drag = ", records[1]["case"])
        self.assertEqual(records[1]["case"], records[3]["case"])
        self.assertGreater(records[1]["promise"]["observed"][-1]["encounters"], 100)
        self.assertEqual(records[1]["promise"], records[3]["promise"])


if __name__ == "__main__":
    main()
