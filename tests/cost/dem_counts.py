#!/usr/bin/python3
"""What a step of the particle model sends, counted on 8 ranks (2 x 2 x 2 parts of a periodic box): one message to each
neighbour, one collective call, and the bytes of the ghosts.

    dem_counts.py POLYBED MPI_COUNTS_LIBRARY"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import open_mpi  # noqa: E402

MPI = {**open_mpi.SETTINGS, **open_mpi.MORE_THAN_CORES, "PYTHONHOME": "/nowhere"}
CASE = """
[column]
size = ["20 mm", "20 mm", "20 mm"]
cells = [4, 4, 4]
sides = "periodic"
ends = "periodic"
gravity = 0
[fluid]
name = "none"
[[species]]
name = "a"
diameter = "1 mm"
density = 2500
[bed]
particles = [4000]
start = "random"
solids_fraction = 0.6
[effects]
others = "none"
contact = "hertz_mindlin"
[dem]
start_speed = "0.2 m/s"
greatest_speed = "2 m/s"
fixed_step = "4 us"
[run]
until = 1
[output]
every = 10
history_every = 10
"""
RANKS, FEW, MANY = 8, 100, 500
BYTES_OF_GHOST = 9 * 8  # place, velocity, spin


def run(polybed, library, steps):
    """Messages, bytes and collective calls of each rank, and the record of the run."""
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder, "case.toml")
        case.write_text(CASE)
        settings = dict(os.environ, **MPI, OMPI_MCA_orte_tmpdir_base=folder, MPI_COUNTS=f"{folder}/counts")
        subprocess.run(["mpirun", "-q", "-n", str(RANKS), "-x", "MPI_COUNTS", "-x", f"LD_PRELOAD={library}", polybed, "dem",
                        case, "--quiet", "-o", f"{folder}/run", "--until", str(steps * 4e-6)],
                       env=settings, check=True, stdout=subprocess.DEVNULL)
        record = json.loads(pathlib.Path(folder, "run/run.json").read_text())
        assert record["work"]["steps"] == steps, record["work"]
        return [list(map(int, p.read_text().split())) for p in sorted(pathlib.Path(folder).glob("counts.*"))], record


def main():
    polybed, library = map(os.path.abspath, sys.argv[1:3])
    (few, before), (many, after) = (run(polybed, library, steps) for steps in (FEW, MANY))
    steps = MANY - FEW
    messages, sent, calls = (max((b[n] - a[n]) / steps for a, b in zip(few, many)) for n in range(3))
    rebuilds = after["work"]["rebuilds"] - before["work"]["rebuilds"]
    ghosts = sent / BYTES_OF_GHOST
    print(f"busiest of {RANKS} ranks, a step: {messages:.2f} messages, {sent / 1e3:.1f} kB "
          f"(some {ghosts:.0f} ghosts of {4000 // RANKS} particles), {calls:.2f} collective calls; "
          f"{rebuilds} lists in {steps} steps; work {after['work']['imbalance']:.2f} of its mean")
    # Every other rank is a neighbour. A new list sends ghosts once and migrants once or twice more, and asks all ranks
    # five times, first how far neighbours have moved apart; every 64th step asks whether the user wants to stop.
    failed = []
    if messages > 7 + 7 * 3 * rebuilds / steps:
        failed.append("more than one message to a neighbour")
    if calls > 1 + 5 * rebuilds / steps + 2 / 64 + 7 * (after["work"]["cuts"] - before["work"]["cuts"]) / steps:
        failed.append("more than one collective call a step")
    # A part of 10 mm sees 1.1 mm beyond its faces: (12.2^3 - 10^3)/10^3 = 0.82 of its own volume. Parts differ, since they
    # are cut for equal work; and migrants are among the bytes.
    if ghosts > 1.3 * 0.82 * 4000 / RANKS:
        failed.append("more ghosts than the shells around the parts hold")
    sys.exit("; ".join(failed) or 0)


if __name__ == "__main__":
    main()
