#!/usr/bin/python3
"""The implicit integrator on 1 to 4 ranks: the same steps, the same bits. Closed and open, packed and loose, gas and liquid, one and
two species, a feed, two and three dimensions; and within the tolerance where layers are wide."""
import json
import pathlib
import sys

import h5py
import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "cli")]
import open_mpi  # noqa: E402
from program import Scratch, main  # noqa: E402

# A layer of more than 64 cells is relaxed by multigrid, in another order across a cut, so that Newton's iterations end elsewhere within
# its tolerance: rounding alone may shift when a step changes (0.06 where the topmost cell of a bed is just full), and each run may be
# this far from the solution.
WIDE_STEPS, DEFAULT_RTOL = 0.1, 1e-4

ONE = '[[species]]\nname = "a"\ndiameter = "{}"\ndensity = {}\n'
POWDER, SAND, FINE = (ONE.format(*of) for of in (("80 um", 1500), ("0.5 mm", 2500), ("0.3 mm", 2500)))
TWO = FINE + '[[species]]\nname = "b"\ndiameter = "0.5 mm"\ndensity = 1600\n'
FEED = '[[feed]]\nspecies = "a"\nat = "top"\nsuperficial_velocity = "1 mm/s"\nvelocity = "20 mm/s"\nfrom = ["2 mm"]\nto = ["6 mm"]\n'
PORTS = (FEED.replace('"top"', '"left"').replace("2 mm", "6 mm", 1).replace('to = ["6 mm"]', 'to = ["14 mm"]')
         + '[[jet]]\nat = "right"\nfrom = ["4 mm"]\nto = ["16 mm"]\nsuperficial_velocity = "20 mm/s"\n'
         '[[discharge]]\nat = "right"\nfrom = ["18 mm"]\nto = ["30 mm"]\nsuperficial_velocity = "8 mm/s"\n')


# A run has 400 rows of the history unless told otherwise, for each of which ranks wait for each other: more than for its steps.
# Even starts: from uneven ones an open bed of water finds no first step at a tolerance of 1e-9.
def scene(cells, size, fluid, species, height, until, inlet=None, start=None, more="", outlet=""):
    closed = "" if inlet else "closed = true\n"
    shares = [1] if species.count("[[") == 1 else [0.5, 0.5]
    loose = f"start_solids_fraction = {start}\n" if start else ""
    flow = f'[inlet]\nsuperficial_velocity = "{inlet}"\n' if inlet else ""
    return (f'[column]\nsize = {json.dumps(size)}\ncells = {cells}\n{closed}{outlet}[fluid]\nname = "{fluid}"\ntemperature = "20 degC"\n{species}[bed]\n'
            f'volume_share = {shares}\nperturbation = 0\nstatic_height = "{height}"\nsolids_fraction = 0.6\n{loose}'
            '[effects]\nothers = "none"\ndrag = "gidaspow"\n'
            f'solids_stress = "frictional"\n{flow}{more}[run]\nuntil = "{until}"\n[output]\nevery = "{until}"\n'
            f'history_every = "{until}"\ncheckpoint_every = "{until}"\n[tfm]\nintegrator = "implicit"\n')


SCENES = {
    "closed gas, packed": scene([3, 20], ["3 mm", "20 mm"], "air", POWDER, "10 mm", "0.05 s"),
    "closed gas, loose": scene([3, 20], ["3 mm", "20 mm"], "air", POWDER, "10 mm", "0.05 s", start=0.4),
    "closed gas, wide": scene([8, 20], ["8 mm", "20 mm"], "air", POWDER, "10 mm", "0.05 s"),
    "closed water, packed": scene([3, 20], ["6 mm", "40 mm"], "water", SAND, "20 mm", "0.1 s"),
    "closed water, loose": scene([3, 20], ["6 mm", "40 mm"], "water", SAND, "20 mm", "0.1 s", start=0.4),
    "closed water, dilute": scene([6, 20], ["12 mm", "40 mm"], "water", FINE, "20 mm", "0.2 s", start=0.3),
    "closed water, two species": scene([4, 20], ["8 mm", "40 mm"], "water", TWO, "20 mm", "0.1 s"),
    "open gas, loose": scene([6, 24], ["12 mm", "48 mm"], "air", FINE, "20 mm", "0.05 s", inlet="0.1 m/s", start=0.45),
    "open gas, two species": scene([4, 20], ["8 mm", "40 mm"], "air", TWO, "20 mm", "0.05 s", inlet="0.1 m/s"),
    "open water, fluidised": scene([6, 24], ["12 mm", "48 mm"], "water", SAND, "20 mm", "0.1 s", inlet="10 mm/s"),
    "open water, packed": scene([6, 24], ["12 mm", "48 mm"], "water", SAND, "20 mm", "0.1 s", inlet="2 mm/s"),
    "water with a feed": scene([4, 20], ["8 mm", "40 mm"], "water", FINE, "6 mm", "0.1 s", inlet="5 mm/s", more=FEED,
                               outlet='outlet = "open"\n'),
    "water with ports in its sides": scene([4, 20], ["8 mm", "40 mm"], "water", FINE, "20 mm", "0.1 s", inlet="5 mm/s", more=PORTS),
    "closed water, wide": scene([72, 16], ["72 mm", "32 mm"], "water", SAND, "20 mm", "20 ms"),
    "closed gas in 3-D": scene([4, 4, 16], ["8 mm", "8 mm", "32 mm"], "air", POWDER, "10 mm", "0.02 s"),
}


class ImplicitRanks(Scratch):
    def run_on(self, ranks, name, *words):
        """The record of a run, and its last fractions and velocities."""
        case = self.write(f"{name}.toml", SCENES[name])
        out = self.folder / f"{name} on {ranks}"
        self.on_ranks(ranks, "tfm", case, "--quiet", "--force", "-o", out, *words)
        with h5py.File(out / "fields.h5") as file:
            last = file["step"][sorted(file["step"])[-1]]
            fields = {field: last[field][...] for field in last if field.startswith("phi_")}
        return json.loads((out / "run.json").read_text()), fields

    def test_ranks_take_the_steps_of_one_rank(self):
        for name in SCENES:
            alone, fields = self.run_on(1, name)
            for ranks in (2,) if open_mpi.SHORT else (2, 3, 4):
                record, others = self.run_on(ranks, name)
                with self.subTest(scene=name, ranks=ranks):
                    steps = record["work"]["steps"] / alone["work"]["steps"] - 1
                    difference = max(np.abs(fields[field] - others[field]).max() for field in fields)
                    wide = name == "closed water, wide"
                    self.assertLessEqual(abs(steps), WIDE_STEPS if wide else 0)
                    self.assertLessEqual(difference, 2 * DEFAULT_RTOL if wide else 0, "solids fractions at the end")


if __name__ == "__main__":
    main()
