#!/usr/bin/python3
"""The shipped cases of particles, shortened, against what is known of them. Usage: dem_cases_test.py PROGRAM"""
import h5py
import numpy as np

import program
from program import DONE, ROOT, Scratch, history, strict_json

CASES = ROOT / "cases"
GRAVITY = 9.81


def settings(**values):
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


class Steps:
    """Stored particles of a run: arrays [step][particle] and so on."""

    def __init__(self, directory):
        with h5py.File(directory / "particles.h5") as file:
            self.time = file["time_s"][()]
            steps = [file[f"step/{n + 1:06d}"] for n in range(len(self.time))]
            for name in ("position", "velocity", "spin", "radius"):
                setattr(self, name, np.array([step[name][()] for step in steps]))


class Cases(Scratch):
    def dem(self, name, *words):
        directory = self.folder / name
        done = self.ends(DONE, "dem", CASES / name / "case.toml", "--quiet", "--json", "-o", directory, *words)
        return strict_json(done.stdout), directory

    def closes(self, record):
        self.assertLess(record["energy"]["worst_error"], record["energy"]["limit"])


class SettledBed(Cases):
    def test_a_tenth_of_it_settles(self):
        record, directory = self.dem("settled-bed", *settings(
            bed__particles="[2040,100]", column__size="[0.02,0.05]", column__cells="[6,50]", run__until=0.1))
        rows = history(directory)
        self.closes(record)
        self.assertEqual(record["particles"], 2140)
        kinetic = rows["kinetic_J"]
        # at rest: below a ten-thousandth of what it had in the fall; 1.3e-5 was seen
        self.assertLess(kinetic[-1], 1e-4 * max(kinetic))
        # the greatest energy of the fall is below what gravity gave, and all of that is lost but for what the springs store
        given = rows["potential_J"][0] - rows["potential_J"][-1]
        self.assertLess(max(kinetic), given)
        self.assertAlmostEqual(rows["dissipated_J"][-1] / given, 1, delta=0.02)
        # what lies at rest: between loose random packing of spheres that rub, 0.55, and dense packing of two sizes, 0.72
        with h5py.File(directory / "profiles.h5") as file:
            solids = 1 - file["voidage"][-1]
            inner = (file["y_m"][()] > 0.004) & (file["y_m"][()] < 0.014)
        self.assertGreater(solids[inner].mean(), 0.55)
        self.assertLess(solids[inner].mean(), 0.72)
        # nothing but the fall moves the species: both stay mixed, their centres within 5 % of each other (2 % was seen)
        self.assertAlmostEqual(rows["centre_fine_m"][-1] / rows["centre_coarse_m"][-1], 1, delta=0.05)
        # the bed falls: the centre of a uniform bed is at half its height
        self.assertLess(rows["bed_height_m"][-1], 0.8 * rows["bed_height_m"][0])


class FedHopper(Cases):
    def test_it_is_filled_while_it_empties(self):
        """80 mm/s of solids over 40 mm by 10 mm from 0.3 s on: 6.4 cm3 by 0.5 s, of 33.5 mm3 each."""
        record, directory = self.dem("fed-hopper", *settings(run__until=0.5))
        self.closes(record)
        self.assertEqual(record["feed"]["glass"]["particles"], 190)
        self.assertEqual(record["feed"]["glass"]["waiting"], 0)
        self.assertGreater(record["outflow"]["glass"]["particles"], 250)
        rows = history(directory)
        # it empties until what is fed has fallen 0.2 m, and then fills
        least = int(np.argmin(rows["mass_glass_kg"]))
        self.assertGreater(rows["mass_glass_kg"][-1], 1.5 * rows["mass_glass_kg"][least])


class RoundHopper(Cases):
    def test_a_quarter_of_it_leaves(self):
        record, _ = self.dem("round-hopper", *settings(bed__particles="[300]", run__until=0.3))
        self.closes(record)
        self.assertEqual((record["particles"], record["outflow"]["glass"]["particles"]), (0, 300))


class ShearBox(Cases):
    def test_its_temperature_is_that_of_kinetic_theory(self):
        """Steady simple shear: production mu_s(T) gamma^2 meets dissipation(T), both after Lun, Savage, Jeffrey and Chepurniy,
        J. Fluid Mech. 140 (1984) 223, Table 1, with g0 of Carnahan and Starling; by hand T = 0.977 (gamma D)^2."""
        _, directory = self.dem("shear-box", *settings(
            bed__particles="[500]", column__size="[0.00868,0.00868,0.00868]", column__cells="[8,8,8]", run__until=1.5, output__every=0.05))
        steps, rate, diameter, phi, e = Steps(directory), 10.0, 1e-3, 0.4, 0.9
        eta, g0 = (1 + e) / 2, (1 - phi / 2) / (1 - phi) ** 3
        production = 5 * np.sqrt(np.pi) / 96 * (
            1 / (eta * (2 - eta) * g0) + 8 / 5 * (3 * eta - 1) / (2 - eta) * phi
            + 64 / 25 * eta * ((3 * eta - 2) / (2 - eta) + 12 / np.pi) * phi**2 * g0)
        dissipation = 48 / np.sqrt(np.pi) * eta * (1 - eta) * phi**2 * g0
        expected = production / dissipation
        self.assertAlmostEqual(expected, 0.977, delta=5e-4)
        temperatures = []
        for position, velocity in zip(steps.position, steps.velocity):
            own = velocity - rate * position[:, 1:2] * [1, 0, 0]
            temperatures.append(((own - own.mean(axis=0)) ** 2).mean() / (rate * diameter) ** 2)
        self.assertGreater(temperatures[0], 3)  # it starts four times as hot as it will be
        steady = np.mean(temperatures[len(temperatures) // 2:])
        # 5 % below was seen with 2000 spheres; 10 % for what kinetic theory leaves out (correlations, soft contacts)
        self.assertAlmostEqual(steady / expected, 1, delta=0.1)
        # the flow stays linear: v_x over y has the slope of the case; noise sqrt(T/n) over the height, below 2 % of it
        slope = np.mean([np.polyfit(p[:, 1], v[:, 0], 1)[0] for p, v in zip(steps.position, steps.velocity)])
        self.assertAlmostEqual(slope / rate, 1, delta=0.05)


class BounceAndRoll(Cases):
    RADIUS, FALL, FRICTION, RESTITUTION, SPEED = 2e-3, 10e-3, 0.3, 0.9, 0.1

    def test_on_a_level_floor(self):
        record, directory = self.dem("bounce-and-roll")
        self.closes(record)
        steps = Steps(directory)
        # dropped: the height of the flight after k impacts, R + h e^(2k), from height and speed at a time in between
        first = np.sqrt(2 * self.FALL / GRAVITY)
        for k, time in ((1, 0.085), (2, 0.165)):
            at = np.argmin(np.abs(steps.time - time))
            self.assertGreater(time, first)
            top = steps.position[at, 0, 1] + steps.velocity[at, 0, 1] ** 2 / (2 * GRAVITY)
            realised = ((top - self.RADIUS) / self.FALL) ** (1 / (2 * k))
            # 50 steps per contact realise a restitution of 0.9 to 1e-3 (docs/theory/particle-contact.md); three times that
            self.assertAlmostEqual(realised, self.RESTITUTION, delta=3e-3)
        # sliding: slows down by mu g until it rolls at 5/7 of its speed, w R = v, after 2 v/(7 mu g) = 9.7 ms
        before, after = np.argmin(np.abs(steps.time - 0.005)), np.argmin(np.abs(steps.time - 0.05))
        # 0.1 %: the springs of a contact at rest are not rigid
        slowed = self.SPEED - self.FRICTION * GRAVITY * 0.005
        self.assertAlmostEqual(steps.velocity[before, 1, 0] / slowed, 1, delta=1e-3)
        self.assertAlmostEqual(steps.velocity[after, 1, 0] / (5 / 7 * self.SPEED), 1, delta=1e-3)
        rolls = -steps.spin[:, 1, 2] * self.RADIUS / steps.velocity[:, 1, 0]
        # the contact is nearer than R by the overlap, 1.5e-3 of it
        np.testing.assert_allclose(rolls[after:], 1, rtol=2e-3)
        # lying: at the overlap that carries its weight it stays where it is, to 1e-3 of the overlap, 3e-6 m
        self.assertLess(np.abs(steps.position[:, 2] - steps.position[0, 2]).max(), 3e-9)

    def test_on_a_tilted_floor(self):
        record, directory = self.dem("bounce-and-roll", *settings(column__gravity_direction="[0.17365,0,-0.98481]"))
        self.closes(record)
        steps = Steps(directory)
        # tan 10 degrees = 0.18 is below 3.5 mu: it rolls with 5/7 g sin; 2e-3 for the overlap and the start of the contact
        expected = 5 / 7 * GRAVITY * 0.17365 * steps.time[-1]
        self.assertAlmostEqual(steps.velocity[-1, 2, 0] / expected, 1, delta=2e-3)
        travelled = steps.position[-1, 2, 0] - steps.position[0, 2, 0]
        self.assertAlmostEqual(travelled / (0.5 * expected * steps.time[-1]), 1, delta=2e-3)


class ColumnAtRest(Cases):
    def test_it_comes_to_rest(self):
        record, directory = self.dem("column-at-rest", *settings(bed__particles="[600]", run__until=0.2))
        self.closes(record)
        rows, steps = history(directory), Steps(directory)
        # all together move with less than a hundredth of what lifts one bead by its diameter; 2e-3 was seen. Beads that are
        # held between two contacts spin on about the axis through them, which no law of contact here resists: all together
        # with less than lifts one bead; 0.13 was seen
        bead = rows["mass_beads_kg"][0] / 600 * GRAVITY * 1.2e-3
        self.assertLess(rows["kinetic_J"][-1], 0.01 * bead)
        self.assertLess(rows["rotational_J"][-1], bead)
        self.assertGreater(max(rows["kinetic_J"]), 100 * bead)  # which was not so while it fell
        # contacts have taken what gravity gave, but for what the springs store and the ledger's own error
        lost = rows["potential_J"][0] - rows["potential_J"][-1]
        self.assertAlmostEqual(rows["dissipated_J"][-1] / lost, 1, delta=0.02)
        # all are in the box: centres at least a radius less the greatest overlap allowed from each wall
        reach = 0.95 * steps.radius[-1][:, None]
        self.assertTrue((steps.position[-1] >= reach).all())
        self.assertTrue((steps.position[-1][:, [0, 2]] <= 0.012 - reach).all())


if __name__ == "__main__":
    program.main()
