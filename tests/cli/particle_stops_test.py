#!/usr/bin/python3
"""Particle runs that must stop: they say where and with which particle. Usage: particle_stops_test.py PROGRAM"""
import program
from program import Scratch

NUMERICS = 3
BOX = """[column]
size = [0.05, 0.05, 0.05]
cells = [10, 10, 10]
gravity = 0
[fluid]
name = "none"
[[species]]
name = "bead"
diameter = "1 mm"
density = 2500
[bed]
start = "list:beads.csv"
[effects]
contact = "hertz_mindlin"
[dem]
greatest_speed = 1
[run]
until = 0.01
"""


class Stops(Scratch):
    def stops(self, rows):
        self.write("beads.csv", "species,x,y,z,vx,vy,vz\n" + rows)
        case = self.write("case.toml", BOX)
        return self.ends(NUMERICS, "dem", case, "-o", self.folder / "run", "--quiet").stderr

    def test_a_particle_that_would_jump_over_a_wall(self):
        """D10: 100 m/s at a wall, where 1 m/s was expected."""
        text = self.stops("bead,0.01,0.01,0.01,0,0,0\nbead,0.03,0.03,0.03,0,-100,0\n")
        self.assertRegex(text, "particle 1 moves by more than a tenth of its diameter .*dem.greatest_speed")

    def test_two_centres_in_one_place(self):
        """D14."""
        text = self.stops("bead,0.01,0.01,0.01,0,0,0\nbead,0.03,0.03,0.03,0,0,0\nbead,0.03,0.03,0.03,0,0,0\n")
        self.assertRegex(text, "particle 1 and particle 2")


if __name__ == "__main__":
    program.main()
