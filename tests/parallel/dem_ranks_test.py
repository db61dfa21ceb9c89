#!/usr/bin/python3
"""Particles on 1, 2, 3, 4 and 8 ranks: the same bits of every place, velocity, spin and contact history, with and without a
restart on another number of ranks."""
import hashlib
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "cli")]
import open_mpi  # noqa: E402
import program  # noqa: E402
from program import Scratch, main  # noqa: E402

RANKS = (1, 2) if open_mpi.SHORT else (1, 2, 3, 4, 8)
STEP = 4e-6  # s
# A restart is in the middle. Where many touch from the start on, half as many steps make and lose thousands of contacts.
STEPS, FEWER = 2000, 1000

BEADS = """[[species]]
name = "a"
diameter = "1 mm"
density = 2500
"""
LISTED = BEADS + '[bed]\nstart = "list:particles.csv"\n'
STIFF = 'fixed_step = "4 us"\nyoungs_modulus = "20 MPa"\n'

# dense, in motion, with friction: particles are pushed apart from random places, so that every contact is sheared
DENSE = """
[column]
size = ["10 mm", "8 mm", "7 mm"]
cells = [5, 4, 4]
sides = "periodic"
ends = "periodic"
gravity = 0
""" + BEADS + """[bed]
particles = [560]
start = "random"
solids_fraction = 0.6
[dem]
start_speed = "0.3 m/s"
friction = 0.5
greatest_speed = "2 m/s"
""" + STIFF

# all in one corner of a column with walls, falling and running off to the other end
CORNER = """
[column]
size = ["40 mm", "30 mm"]
cells = [10, 10]
""" + LISTED + """[dem]
friction = 0.3
greatest_speed = "3 m/s"
""" + STIFF

# sizes of ratio 4: several levels of the search, the synchronised integrator
UNEQUAL = """
[column]
size = ["12 mm", "12 mm", "12 mm"]
cells = [3, 3, 3]
sides = "periodic"
[[species]]
name = "large"
diameter = "4 mm"
density = 1500
[[species]]
name = "small"
diameter = "1 mm"
density = 2500
[bed]
particles = [9, 500]
start = "random"
solids_fraction = 0.6
[dem]
start_speed = "0.1 m/s"
friction = 0.4
tangential = "mindlin_deresiewicz"
rolling_friction = 0.02
greatest_speed = "2 m/s"
""" + STIFF

# a crowd that drifts through all faces and the corner of a periodic box
CROSSING = """
[column]
size = ["5.5 mm", "5.5 mm", "5.5 mm"]
cells = [3, 3, 3]
sides = "periodic"
ends = "periodic"
gravity = 0
""" + LISTED + """[dem]
friction = 0.5
greatest_speed = "4 m/s"
""" + STIFF

# a block that drops through a hole, some of it while the run goes on and some stopped by the rim
EMPTYING = """
[column]
size = ["16 mm", "16 mm", "20 mm"]
cells = [4, 4, 5]
""" + LISTED + """[dem]
friction = 0.3
greatest_speed = "3 m/s"
""" + STIFF + 'opening = "7 mm"\n'

# two sizes in water that rises through them, with drag and added mass; two of the larger deep, so that there are pairs that are
# listed with two images
WET = """
[column]
size = ["12 mm", "24 mm"]
cells = [5, 10]
depth = "2.4 mm"
[[species]]
name = "a"
diameter = "1.2 mm"
density = 2500
[[species]]
name = "b"
diameter = "0.8 mm"
density = 1400
[bed]
particles = [80, 120]
start = "mixed"
solids_fraction = 0.55
start_solids_fraction = 0.4
[inlet]
superficial_velocity = "50 mm/s"
[dem]
friction = 0.4
greatest_speed = "0.5 m/s"
fixed_step = "4 us"
youngs_modulus = "2 MPa"
fluid_every = 16
"""

COMMON = """
[fluid]
name = "none"
[effects]
others = "none"
contact = "hertz_mindlin"
[run]
until = "8 ms"
[output]
every = "8 ms"
history_every = "8 ms"
checkpoint_every = "4 ms"
"""

BRIEF = COMMON.replace("4 ms", "2 ms").replace("8 ms", "4 ms")
WITH_FLUID = BRIEF.replace('name = "none"', 'name = "water"\ntemperature = "20 degC"').replace(
    "[effects]", '[effects]\ndrag = "cello"\nadded_mass = "zuber"\nfluid_stress = "newtonian"')


def in_corner():
    """A block of 12 by 24 particles that all fly towards the other end of the column."""
    spread = random.Random(1)
    return [f"a,{(1.02 * i + 0.6) * 1e-3},{(1.02 * j + 0.6) * 1e-3},{0.0011 + spread.uniform(-2e-4, 2e-4)},"
            f"{spread.uniform(0.5, 1.5)},{spread.uniform(-0.5, 0.5)},{spread.uniform(-0.1, 0.1)},0,0,0"
            for i in range(12) for j in range(24)]


def crossing():
    """A crowd that drifts along the diagonal once around the box, in motion and spinning."""
    spread = random.Random(2)
    return [",".join(map(str, ["a", *((1.1 * k + 0.3) * 1e-3 for k in (n % 5, n // 5 % 5, n // 25)),
                               *(0.8 + spread.uniform(-0.4, 0.4) for _ in range(3)),
                               *(spread.uniform(-300, 300) for _ in range(3))])) for n in range(125)]


def dropping():
    """A block of 10 by 10 by 8 particles on its way down: the lowest are out before half of the run is over."""
    spread = random.Random(3)
    return [f"a,{(1.04 * i + 3.3) * 1e-3},{(1.04 * j + 0.6) * 1e-3},{(1.04 * k + 3.3) * 1e-3},"
            f"{spread.uniform(-0.2, 0.2)},{spread.uniform(-1.1, -0.7)},{spread.uniform(-0.2, 0.2)},0,0,0"
            for i in range(10) for j in range(8) for k in range(10)]


def hash_of(checkpoint):
    """SHA-256 of places, velocities and spins by id, of the histories of all contacts, of the fluid, and of what has left or entered."""
    with h5py.File(checkpoint) as file:
        particles = file["arrays/particles"][()].reshape(-1, 23)
        contacts = file["arrays/contacts"][()]
        more = [file[f"arrays/{name}"][()].tobytes() for name in sorted(file["arrays"]) if name.startswith(("fluid_", "feed_"))]
        outflow = file["arrays/outflow"][()] if "outflow" in file["arrays"] else np.zeros(1)
        if outflow.any():
            more += [outflow.tobytes()] + [file[f"integers/outflow_{name}"][()].tobytes()
                                           for name in ("steps", "energy", "energy_part")]
    assert (np.diff(particles[:, 0]) > 0).all() and particles[-1, 0] < len(particles) + outflow.sum()
    assert np.isfinite(particles).all() and np.isfinite(contacts).all()
    seen = particles[:, :11].tobytes() + contacts.tobytes() + b"".join(more)
    return hashlib.sha256(seen).hexdigest(), len(particles), len(contacts)


def ulps_up(value, count=1):
    for _ in range(count):
        value = np.nextafter(value, np.inf)
    return repr(float(value))


def processes_of(folder):
    """Those that were started on a folder: mpirun and its ranks."""
    for command in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if str(folder).encode() in command.read_bytes():
                yield int(command.parent.name)
        except OSError:  # gone meanwhile
            pass


def kill_all(folder):
    """Kills them and waits until they are gone: ranks outlive an mpirun that is killed, and would go on writing."""
    deadline = time.monotonic() + 60
    while (alive := list(processes_of(folder))) and time.monotonic() < deadline:
        for process in alive:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.01)


class DemRanks(Scratch):
    def start_on(self, ranks, *words):
        """`polybed dem` on a number of ranks, begun."""
        settings = os.environ | open_mpi.SETTINGS | open_mpi.MORE_THAN_CORES
        settings |= {"OMPI_MCA_orte_tmpdir_base": tempfile.mkdtemp(dir=self.folder), "PYTHONHOME": "/nowhere"}
        return subprocess.Popen(["mpirun", "-q", "-n", str(ranks), program.PROGRAM, "dem", *map(str, words), "--quiet", "--no-picture"],
                                env=settings, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")

    def on(self, ranks, *words, code=0):
        """The same, ended; what it said."""
        process = self.start_on(ranks, *words)
        out, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, code, f"{ranks} ranks: {words}\n{out[-500:]}\n{err[-1500:]}")
        return err

    def scene(self, text, rows=None, common=COMMON):
        if rows is not None:
            self.write("particles.csv", "\n".join(["species,x,y,z,vx,vy,vz,wx,wy,wz", *rows]) + "\n")
        return self.write("case.toml", text + common)

    def check_same(self, case, restart, touching=True, numbers=RANKS, steps=STEPS):
        """One hash on all numbers of ranks, and with a restart on another number; the records of the runs.
        :param touching: whether contacts have to be there at the end, so that histories are compared"""
        if open_mpi.SHORT:
            numbers, restart = RANKS, (2, 1)
        hashes, records = {}, {}
        for ranks in numbers:
            run = self.folder / f"on{ranks}"
            self.on(ranks, case, "-o", run)
            hashes[f"{ranks} ranks"], *sizes = hash_of(run / "checkpoint.h5")
            records[ranks] = json.loads((run / "run.json").read_text())
            self.assertEqual(records[ranks]["work"]["steps"], steps)
            self.assertGreater(sizes[1], 0 if touching else -1)
        cut = shutil.copytree(self.folder / f"on{restart[0]}", self.folder / "cut")  # goes on from its first checkpoint, in the middle
        middle, *_ = hash_of((cut / "checkpoint.previous.h5").replace(cut / "checkpoint.h5"))
        self.on(restart[1], case, "--resume", "-o", cut)
        hashes[f"restarted, {restart}"], *_ = hash_of(cut / "checkpoint.h5")
        self.assertEqual(len(set(hashes.values())), 1, hashes)
        self.assertNotIn(middle, hashes.values())
        return records

    def test_dense_box(self):
        records = self.check_same(self.scene(DENSE, common=BRIEF), restart=(8, 3), steps=FEWER)
        self.assertGreater(records[1]["work"]["contact_steps"], 100 * FEWER)
        self.assertGreater(records[1]["work"]["rebuilds"], 20)

    def test_all_from_one_corner(self):
        records = self.check_same(self.scene(CORNER, in_corner()), restart=(1, 4))
        for ranks in RANKS[1:]:  # what is cut for the corner does not do for the column
            self.assertGreater(records[ranks]["work"]["cuts"], 0, ranks)
        self.assertEqual(records[1]["work"]["cuts"], 0)

    def test_liquid_bridges(self):
        """Bridges across ranks stretch and rupture; whether one is there is in the history of its contact."""
        wet = CORNER.replace("cells = [10, 10]", 'cells = [10, 10]\ndepth = "2.4 mm"') + 'surface_tension = "72 mN/m"\nliquid_fraction = 0.02\n'
        case = self.scene(wet, in_corner(), COMMON.replace("[effects]", '[effects]\nliquid_bridge = "willett"'))
        self.check_same(case, restart=(2, 1), numbers=(1, 2))
        particles, contacts = (h5py.File(self.folder / "on1/checkpoint.h5")[f"arrays/{name}"][()] for name in ("particles", "contacts"))
        particles, contacts = particles.reshape(-1, 23), contacts.reshape(-1, 12)  # ids, 3 of friction, bridge, 6 of the ledger
        place = {int(p[0]): p[2:5] for p in particles}
        pairs = contacts[contacts[:, 1] >= 0]
        gap = np.array([np.linalg.norm(place[int(a)] - place[int(b)]) - 1e-3 for a, b in pairs[:, :2]])
        held = pairs[:, 5]
        self.assertLessEqual(set(held), {0, 1})
        self.assertTrue(np.all(held[gap < 0] == 1))
        self.assertGreater(np.count_nonzero(held[gap > 0]), 20)  # stretched
        self.assertGreater(np.count_nonzero(held[gap > 0] == 0), 0)  # near, and never touched or ruptured

    def test_unequal_sizes(self):
        records = self.check_same(self.scene(UNEQUAL, common=BRIEF), restart=(2, 4), steps=FEWER)
        self.assertEqual(records[1]["integrator"], "synchronised")

    def test_contacts_across_faces_and_corners(self):
        records = self.check_same(self.scene(CROSSING, crossing()), restart=(4, 8))
        self.assertGreater(records[1]["work"]["contact_steps"], STEPS)

    def test_with_a_fluid_between_them(self):
        records = self.check_same(self.scene(WET, common=WITH_FLUID), restart=(3, 2), numbers=(1, 2, 3, 4), steps=FEWER)
        self.assertGreater(records[1]["work"]["contact_steps"], FEWER)

    def test_particles_that_leave(self):
        records = self.check_same(self.scene(EMPTYING, dropping()), restart=(3, 4))
        left = {json.dumps([record["outflow"], record["particles"], record["energy"]["carried_out_J"]])
                for record in records.values()}
        self.assertEqual(len(left), 1, left)
        out = records[1]["outflow"]["a"]["particles"]
        self.assertGreater(out, 50)
        self.assertGreater(records[1]["particles"], 50)
        self.assertEqual(out + records[1]["particles"], 800)

    def test_inner_walls(self):
        """The block meets two slopes, whose contacts and friction are in the histories."""
        sloped = "wall = [{from=[0, 0.006], to=[0.0045, 0]}, {from=[0.016, 0.006], to=[0.0115, 0]}]" + EMPTYING
        rows = [row.split(",") for row in dropping()]  # 5 mm higher
        rows = [",".join([a, x, repr(float(y) + 5e-3), *others]) for a, x, y, *others in rows]
        self.check_same(self.scene(sloped, rows), restart=(2, 1), numbers=(1, 2))
        contacts = h5py.File(self.folder / "on1/checkpoint.h5")["arrays/contacts"][()].reshape(-1, 11)  # ids, friction, ledger
        self.assertTrue({-6.0, -7.0} & set(contacts[:, 1]))  # walls 0 to 4 are faces: bottom, sides, front and back

    def test_fewer_particles_than_ranks(self):
        rows = [f"a,{x * 1e-3},0.004,0.004,{v},{v},0,30,0,10" for x, v in ((1, 2.0), (3, 0.5), (4.5, -1.0))]
        self.check_same(self.scene(CROSSING, rows), restart=(8, 1), touching=False)

    def test_one_bit_at_the_start_tells(self):
        """The hash sees the least there is to see: one unit in the last place of one velocity of one particle."""
        rows = crossing()
        case = self.scene(CROSSING, rows)
        self.on(2, case, "-o", self.folder / "one")
        entries = rows[5].split(",")
        entries[4] = ulps_up(float(entries[4]))
        self.scene(CROSSING, [*rows[:5], ",".join(entries), *rows[6:]])
        self.on(2, case, "-o", self.folder / "other")
        self.assertNotEqual(hash_of(self.folder / "one/checkpoint.h5"), hash_of(self.folder / "other/checkpoint.h5"))

    def test_a_killed_run_goes_on_elsewhere(self):
        case = self.scene(CORNER, in_corner())
        often = ["--set", 'output.checkpoint_every="1 ms"']
        self.on(1, case, *often, "-o", self.folder / "whole")
        process = self.start_on(3, case, *often, "-o", self.folder / "killed")
        program.wait_until(process, (self.folder / "killed/checkpoint.h5").exists)
        kill_all(self.folder / "killed")
        process.communicate(timeout=60)
        middle = hash_of(self.folder / "killed/checkpoint.h5")
        self.on(2, case, *often, "--resume", "-o", self.folder / "killed")
        end = hash_of(self.folder / "killed/checkpoint.h5")
        self.assertNotEqual(middle, end)
        self.assertEqual(end, hash_of(self.folder / "whole/checkpoint.h5"))

    def test_ranks_thinner_than_a_particle_are_refused(self):
        narrow = CROSSING.replace('"5.5 mm", "5.5 mm", "5.5 mm"', '"3 mm", "3 mm", "3 mm"')
        rows = ["a,0.001,0.001,0.001,1,0,0,0,0,0"]
        error = self.on(32, self.scene(narrow, rows), "-o", self.folder / "a", code=2)
        self.assertEqual(error.count("32 ranks would own parts of 0.00075 m, thinner than the largest particle, 0.001 m"), 1, error)
        self.on(8, self.scene(narrow, rows), "-o", self.folder / "b")

    def test_too_deep_an_overlap_is_told_with_its_ids(self):
        """By the rank that met it, once, through the first."""
        rows = ["a,0.001,0.001,0.001,0,0,0,0,0,0", "a,0.004,0.004,0.004,0,0,0,0,0,0", "a,0.0048,0.004,0.004,0,0,0,0,0,0"]
        error = self.on(4, self.scene(CROSSING, rows), "-o", self.folder / "a", code=3)
        self.assertEqual(error.count("particle 1 and particle 2 overlap"), 1, error)


if __name__ == "__main__":
    main()
