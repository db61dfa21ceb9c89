#!/usr/bin/python3
"""One case on 1, 2, 3 and 4 ranks: the same fields, the same restart, one voice."""
import json
import pathlib
import sys

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "cli")]
import open_mpi  # noqa: E402
from program import CASE, Scratch, datasets, history, main  # noqa: E402

# Where rows are short every rank solves for the whole column, and sums over cells have no order: all fields have the same bits.
# Beyond 64 cells across ranks share the pressure, whose residual, 1e-12, is what fields may differ by after 50 steps of one length.
SHARED = 1e-10
ROUND_OFF = 1e-13  # of sums for the history and the record, over 1e3 cells
TIGHT = ["--set", "tfm.pressure_tolerance=1e-12"]
FIXED = ["--set", "tfm.fixed_step=0.001", "--set", 'tfm.integrator="explicit"', "--set", "run.until=0.05",
         "--set", "output.every=0.01", "--set", "output.history_every=0.01", "--set", "output.checkpoint_every=0.02"]
FLAT = ["--set", "column.cells=[12,60]"]
WIDE = ["--set", "column.cells=[72,20]"]
DEEP = ["--set", 'column.size=["60 mm","24 mm","620 mm"]', "--set", "column.cells=[12,8,40]",
        "--set", 'column.sides="periodic"']
FORCES = ["--set", 'effects.lift="saffman_mei"', "--set", 'effects.added_mass="zuber"']


def case_without(key):
    """The shipped case without one of its keys, or several in a tuple."""
    return "".join(line for line in CASE.read_text().splitlines(keepends=True) if not line.startswith(key))


RANKS = (2,) if open_mpi.SHORT else (2, 3, 4)


class Ranks(Scratch):
    def on(self, ranks, *words, code=0):
        """`polybed tfm` on a number of ranks; its standard error and output."""
        return self.on_ranks(ranks, "tfm", *words, code=code)

    def largest_difference(self, one, other):
        """Between the last fields of two runs, relative to the greatest value of each field; p has the scale of the
        weight of the bed, velocities share theirs."""
        a, b = datasets(one / "fields.h5"), datasets(other / "fields.h5")
        self.assertEqual(sorted(a), sorted(b))
        velocity = max(np.abs(a[n]).max() for n in a if "/u_" in n)
        worst = 0
        for name in a:
            scale = velocity if "/u_" in name else max(np.abs(a[name]).max(), 1e-300)
            worst = max(worst, float(np.abs(a[name] - b[name]).max() / scale))
        return worst

    def check_equal(self, *words, same=0, case=CASE, on=RANKS):
        for ranks in (1, *on):
            self.on(ranks, case, *words, "--quiet", "-o", self.folder / f"on{ranks}")
            if ranks > 1:
                self.assertLessEqual(self.largest_difference(self.folder / "on1", self.folder / f"on{ranks}"), same)

    def test_a_flat_bed_is_the_same(self):
        self.check_equal(*FLAT, *FIXED)
        record = json.loads((self.folder / f"on{RANKS[-1]}/run.json").read_text())
        self.assertEqual(record["ranks"], RANKS[-1])
        alone = json.loads((self.folder / "on1/run.json").read_text())["well_posedness"]
        self.assertEqual(record["well_posedness"]["share_below_1"], alone["share_below_1"])
        self.assertEqual(record["well_posedness"]["least"], alone["least"])
        self.assertAlmostEqual(record["well_posedness"]["critical_slope_Pa"] / alone["critical_slope_Pa"], 1, delta=ROUND_OFF)

    def test_first_order_fluxes_are_the_same(self):
        """A bed that starts 0.005 above its packing, with a stress too weak to throw it apart: cells on both sides of every cut
        are flagged, above 0.001, and none ends the run, as they would above 0.01."""
        words = [*FIXED, "--set", 'column.size=["60 mm","90 mm"]', "--set", "column.cells=[24,12]",
                 "--set", "tfm.max_packing=0.615", "--set", "tfm.frictional_onset=0.607",
                 "--set", 'tfm.frictional_pressure="1e-7 Pa"']
        self.check_equal(*words)
        flagged = {json.loads((self.folder / f"on{n}/run.json").read_text())["work"]["first_order_cells"]
                   for n in (1, *RANKS)}
        self.assertEqual(len(flagged), 1)
        self.assertGreater(flagged.pop(), 100)
        cut = self.folder / "cut"  # and the flags go to other ranks with the checkpoint
        self.on(RANKS[-1], CASE, *words, "--until", "0.02", "-o", cut)
        self.on(1, CASE, *words, "--resume", "-o", cut)
        self.assertEqual(self.largest_difference(self.folder / "on1", cut), 0)

    def test_a_deep_bed_with_joined_sides_is_the_same(self):
        self.check_equal(*DEEP, *FIXED, case=self.write("deep.toml", case_without("depth")))

    def test_a_box_with_joined_ends_is_the_same(self):
        case = self.write("joined.toml", case_without(("superficial_velocity", "[inlet]", "start")))
        self.check_equal("--set", "column.cells=[12,60]", "--set", 'column.ends="periodic"', "--set", 'column.sides="periodic"',
                         *FIXED, "--set", "tfm.fixed_step=2e-4", "--set", "run.until=0.01", case=case)

    def test_a_tapered_bed_is_the_same(self):
        """Cells that the wall closes lie on both sides of every cut."""
        case = CASE.parents[1] / "templates/tapered-bed/case.toml"
        self.check_equal("--set", "column.cells=[12,60]", *FIXED, "--set", "tfm.fixed_step=2e-4", "--set", "run.until=0.02", case=case)

    def test_a_dam_in_layers_is_the_same(self):
        """Its faces lie inside cells, and cuts between ranks inside the dam."""
        dam = "from=[0], to=[0.027]"
        layers = f'layer=[{{species="fine", height=0.071, {dam}}}, {{volume_share=[0.5, 0.5], height=0.034, solids_fraction=0.58, {dam}}}]'
        self.check_equal(*FLAT, *FIXED, "--set", layers, "--set", "bed.start_solids_fraction=0.5",
                         case=self.write("dam.toml", case_without(("volume_share", "static_height", "start"))))

    def test_every_stress_is_the_same(self):
        effects = {"solids_stress": "kinetic", "granular_temperature": "transported", "solids_viscosity": "schaeffer",
                   "fluid_stress": "newtonian"}
        words = [w for role, law in effects.items() for w in ("--set", f'effects.{role}="{law}"')]
        self.check_equal(*FLAT, *FIXED, *words, "--set", 'tfm.solids_wall="johnson_jackson"',
                         "--set", 'tfm.momentum="conservative_limited"', on=RANKS[-1:])

    def test_forces_on_particles_are_the_same(self):
        """Vorticity takes velocities from across every cut, corners included; added mass changes what a pressure does."""
        self.check_equal(*FLAT, *FIXED, *FORCES)

    def test_forces_on_particles_of_a_deep_bed_are_the_same(self):
        self.check_equal(*DEEP, *FIXED, *FORCES, case=self.write("deep.toml", case_without("depth")), on=RANKS[-1:])

    def test_a_compressible_fluid_is_the_same(self):
        self.check_equal(*FLAT, "--set", 'fluid.equation_of_state="tait"', "--set", 'tfm.integrator="explicit"',
                         "--set", "tfm.fixed_step=1e-6", "--set", "run.until=1e-4", "--set", "output.every=1e-4",
                         "--set", "output.history_every=1e-4", on=RANKS[-1:])

    def test_a_graded_bed_is_the_same_within_its_pressure(self):
        """Widths are those of the whole column on every rank."""
        self.check_equal(*FLAT, *FIXED, *TIGHT, "--set", "column.grading_across=1.1", "--set", "column.grading=1.1",
                         "--set", "column.graded_above=0.2", same=SHARED)

    def test_a_wide_bed_is_the_same_within_its_pressure(self):
        self.check_equal(*WIDE, *FIXED, *TIGHT, "--set", "tfm.fixed_step=2e-4", "--set", "run.until=0.01", same=SHARED)

    def test_what_is_fed_and_leaves_is_the_same(self):
        words = ["--set", "tfm.fixed_step=1e-4", "--set", 'tfm.integrator="explicit"', "--set", "run.until=5e-3",
                 "--set", "output.every=5e-3", "--set", "output.history_every=1e-3"]
        self.check_equal(*words, case=CASE.parents[1] / "classifier/case.toml", on=RANKS[-1:])
        one, other = history(self.folder / "on1"), history(self.folder / f"on{RANKS[-1]}")
        for name in one:
            if name.startswith(("in_", "out_")):
                self.assertLessEqual(abs(one[name][-1] - other[name][-1]), ROUND_OFF * max(abs(one[name][-1]), 1e-6), name)

    def test_what_crosses_the_sides_is_the_same(self):
        """Ports across every cut, and a restart on other ranks in the middle."""
        ports = ('jet=[{at="left", from=[0.02], to=[0.1], superficial_velocity=0.1}]',
                 'feed=[{species="fine", at="left", from=[0.2], to=[0.4], superficial_velocity=2e-3, velocity=0.05}]',
                 'discharge=[{at="right", from=[0.03], to=[0.5], superficial_velocity=[[0, 0], [0.03, 0.02]]}]')
        overflow = ('discharge=[{at="right", from=[0.03], to=[0.5], pressure=-20}, {at="left", from=[0.12], to=[0.18], pressure=50}]',
                    'column.outlet="lid"')
        for more in (ports[2:], overflow):
            words = [*FLAT, *FIXED, *(word for port in (*ports[:2], *more) for word in ("--set", port))]
            self.check_equal(*words, "--force")
            cut = self.folder / f"cut{len(more)}"
            self.on(RANKS[-1], CASE, *words, "--until", "0.02", "-o", cut)
            self.on(1, CASE, *words, "--resume", "-o", cut)
            self.assertEqual(self.largest_difference(self.folder / "on1", cut), 0)

    def test_what_crosses_the_wall_of_a_tube_is_the_same(self):
        """Ports in cut cells on both sides of the cuts, and a restart on other ranks in the middle."""
        ports = ('jet=[{at="front", from=[0.02, 0.02], to=[0.04, 0.1], superficial_velocity=0.1}]',
                 'feed=[{species="fine", at="left", from=[0.01, 0.2], to=[0.03, 0.4], superficial_velocity=2e-3, velocity=0.05}]',
                 'discharge=[{at="right", from=[0.02, 0.03], to=[0.05, 0.3], superficial_velocity=0.02}, '
                 '{at="back", from=[0.02, 0.45], to=[0.04, 0.5], pressure=0}]', 'column.outlet="lid"')
        words = ["--set", "column.shape=cylinder", "--set", "column.size=[0.06,0.06,0.62]", "--set", "column.cells=[8,8,24]", *FIXED, *TIGHT,
                 *(word for port in ports for word in ("--set", port))]
        case = self.write("tube.toml", case_without("depth"))
        self.check_equal(*words, case=case, on=RANKS[-1:], same=SHARED)
        rows = history(self.folder / "on1")
        self.assertGreater(rows["discharge1_fine_kg"][-1], 0)
        self.assertAlmostEqual(rows["discharge1_m3_s"][-1] / (0.03 * 0.27 * 0.02), 1, delta=1e-12)
        cut = self.folder / "cut"
        self.on(RANKS[-1], case, *words, "--until", "0.02", "-o", cut)
        self.on(1, case, *words, "--resume", "-o", cut)
        self.assertLessEqual(self.largest_difference(self.folder / "on1", cut), SHARED)

    def test_momentum_of_second_order_is_the_same(self):
        """Fluxes of the solids are taken from neighbours across every cut, corners included."""
        self.check_equal(*FLAT, *FIXED, "--set", 'tfm.momentum="conservative_limited"', on=RANKS[-1:])

    def test_adaptive_steps_are_the_same(self):
        for integrator in ("explicit", "imex"):
            self.check_equal(*FLAT, "--force", "--set", f'tfm.integrator="{integrator}"', "--set", "run.until=0.05", "--set", "output.every=0.05",
                             "--set", "output.history_every=0.05")

    def test_restart_on_other_ranks(self):
        words = [CASE, *FLAT, *FIXED, "--quiet"]
        self.on(1, *words, "-o", self.folder / "whole")
        for first, then in ((1, 2), (2, 1)) if open_mpi.SHORT else ((1, 3), (4, 2)):
            run = self.folder / f"from{first}to{then}"
            self.on(first, *words, "--until", "0.02", "-o", run)
            self.on(then, *words, "--resume", "-o", run)
            self.assertEqual(self.largest_difference(self.folder / "whole", run), 0)
            self.assertEqual(history(run)["time_s"], history(self.folder / "whole")["time_s"])

    def test_files_of_any_number_of_ranks_are_the_same_to_the_bit(self):
        """One state, read and written again by 1 to 4 ranks before anything is computed, in two and in three dimensions."""
        deep = [self.write("deep.toml", case_without("depth")), *DEEP]
        for name, words in (("flat", [CASE, *FLAT]), ("deep", deep)):
            self.on(1, *words, *FIXED, "--until", "0.005", "-o", self.folder / f"{name}0", "--quiet")
            start = f'bed.start="checkpoint:{self.folder / f"{name}0/checkpoint.h5"}"'
            for ranks in (1, *RANKS):
                self.on(ranks, *words, *FIXED, "--quiet", "--set", start, "--until", "0.001", "-o",
                        self.folder / f"{name}{ranks}")
            for ranks in (0, *RANKS):
                one, other = (datasets(self.folder / f"{name}{n}/fields.h5") for n in (1, ranks))
                step = "/step/000002" if ranks == 0 else "/step/000001"
                names = [n.removeprefix(step) for n in other if n.startswith(step)]
                self.assertIn("/u_fluid", names)
                for field in names:
                    self.assertEqual(one["/step/000001" + field].tobytes(), other[step + field].tobytes(), (ranks, field))

    def test_errors_are_told_once(self):
        done = self.on(3, CASE, "--set", "column.cells=[6,5]", "--quiet", "-o", self.folder / "a", code=2)
        self.assertEqual(done.stderr.count("cannot be cut"), 1, done.stderr)
        done = self.on(2, CASE, "--set", "species.1.diameter=-1", "-o", self.folder / "b", code=2)
        self.assertEqual(done.stderr.count("out of range"), 1, done.stderr)
        (self.folder / "file").write_text("in the way")
        self.on(2, CASE, "--quiet", "-o", self.folder / "file/c", code=4)


if __name__ == "__main__":
    main()
