#!/usr/bin/python3
"""How a run of the continuum model scales over ranks: measured as far as the machine's cores go, then projected from
measured counts of work, messages and collective calls.

    tfm_scaling.py POLYBED MPI_COUNTS_LIBRARY [--json]

Strong: 100 x 500 cells of system B on 1 and 2 ranks. Weak: 100 x 250 cells a rank. At once: two runs on one rank each, at the
same time: what the cores leave each other of memory and caches, which no program can share out better. Times are the terms of
run.json less output, the median of three runs. Counts repeat exactly and are taken on 8 ranks in blocks of 2 x 4, more than there are
cores: such ranks wait for each other, but what they send is what they would send elsewhere."""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import open_mpi  # noqa: E402

CASE = ROOT / "cases/matsuura-akehata/case.toml"
STEPS, STEP = 50, 2e-4
# Assumptions of the projection, of a present cluster: time of a message, of a byte, and of one stage of a reduction.
LATENCY, PER_BYTE, STAGE = 1.5e-6, 1 / 10e9, 2e-6


def run(polybed, ranks, cells, steps=STEPS, library=None):
    """The record of a run with steps of one length, and the counts of each rank if a library counts them."""
    with tempfile.TemporaryDirectory() as folder:
        settings = os.environ | open_mpi.SETTINGS | {"OMPI_MCA_orte_tmpdir_base": folder}
        command = ["mpirun", "-q", "-n", str(ranks)]
        if library:
            settings |= open_mpi.MORE_THAN_CORES | {"MPI_COUNTS": f"{folder}/counts"}
            command += ["-x", "MPI_COUNTS", "-x", f"LD_PRELOAD={library}"]
        width, height = 0.6 * cells[0] / 1000, 0.62 * cells[1] / 500  # m: the shape of a cell does not change
        command += [polybed, "tfm", CASE, "--quiet", "--no-picture", "-o", f"{folder}/run", "--until", str(steps * STEP)]
        for key, value in (("column.cells", list(cells)), ("column.size", [width, height]), ("tfm.fixed_step", STEP),
                           ("tfm.integrator", '"explicit"'), ("output.every", 100), ("output.history_every", 100),
                           ("output.checkpoint_every", 100), ("bed.static_height", 0.1 * height)):
            command += ["--set", f"{key}={value}"]
        subprocess.run(list(map(str, command)), env=settings, check=True, stdout=subprocess.DEVNULL)
        record = json.loads(pathlib.Path(folder, "run/run.json").read_text())
        counts = [list(map(int, path.read_text().split())) for path in sorted(pathlib.Path(folder).glob("counts.*"))]
        return record, counts


def seconds_per_step(record):
    return sum(t for term, t in record["timers"].items() if term != "output") / STEPS


def median_time(polybed, ranks, cells):
    return statistics.median(seconds_per_step(run(polybed, ranks, cells)[0]) for _ in range(3))


def median_time_at_once(polybed, cells):
    """Seconds per step of two runs beside each other, one rank each: the mean of both."""
    def pair():
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            return statistics.mean(pool.map(lambda _: seconds_per_step(run(polybed, 1, cells)[0]), range(2)))
    return statistics.median(pair() for _ in range(3))


def counts_per_step(polybed, library, cells):
    """The busiest rank's messages, bytes and collective calls of a step; a run without steps is taken off."""
    few, many = (run(polybed, 8, cells, steps, library)[1] for steps in (10, 60))
    return [max((b[n] - a[n]) / 50 for a, b in zip(few, many)) for n in range(3)]


def projection(per_cell, counts, cells, ranks):
    """Seconds of a step on a number of ranks in two dimensions: the cells of a block, four neighbours in place of the
    three that a rank of 2 x 4 has, bytes by the length of its sides, coarser grids of multigrid by levels."""
    side = math.sqrt(cells / ranks)
    messages = counts[0] * 4 / 3 * math.log2(max(cells, 2)) / math.log2(COUNTED[0] * COUNTED[1])
    bytes_sent = counts[1] * 4 / 3 * side / math.sqrt(COUNTED[0] * COUNTED[1] / 8)
    talk = messages * LATENCY + bytes_sent * PER_BYTE + counts[2] * STAGE * math.log2(ranks)
    return per_cell * cells / ranks + (talk if ranks > 1 else 0)


COUNTED = (100, 500)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("polybed")
    parser.add_argument("library")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    strong = {n: median_time(options.polybed, n, (100, 500)) for n in (1, 2)}
    larger = {n: median_time(options.polybed, n, (200, 1000)) for n in (1, 2)}
    weak = {n: median_time(options.polybed, n, (100, 250 * n)) for n in (1, 2)}
    at_once = median_time_at_once(options.polybed, (100, 500))
    counts = counts_per_step(options.polybed, options.library, COUNTED)
    per_cell = strong[1] / (COUNTED[0] * COUNTED[1])
    table = []
    for ranks in (1, 2, 8, 32, 128, 512, 1000):
        fixed, grown = 4_000_000, 50_000 * ranks
        of_fixed = projection(per_cell, counts, fixed, 1) / projection(per_cell, counts, fixed, ranks)
        efficiency = projection(per_cell, counts, 50_000, 1) / projection(per_cell, counts, grown, ranks)
        table.append({"ranks": ranks, "strong_speedup": of_fixed, "weak_efficiency": efficiency})
    result = {"speedup_50000_cells": strong[1] / strong[2], "speedup_200000_cells": larger[1] / larger[2],
              "at_once_50000_cells": strong[1] / at_once, "weak_efficiency": weak[1] / weak[2], "us_per_cell_and_step": 1e6 * per_cell,
              "messages_per_step": counts[0], "bytes_per_step": counts[1], "collectives_per_step": counts[2],
              "projection": table}
    if options.json:
        print(json.dumps(result, indent=2))
        return
    print(f"measured, two ranks against one: {result['speedup_50000_cells']:.2f} times as fast at 50 000 cells (goal 1.8), "
          f"{result['speedup_200000_cells']:.2f} at 200 000; weak efficiency {result['weak_efficiency']:.2f}")
    print(f"two runs at once, each on a core: {result['at_once_50000_cells']:.2f} of the rate of one alone")
    print(f"a step: {result['us_per_cell_and_step']:.2f} us per cell; the busiest of 8 ranks sends {counts[0]:.0f} messages, "
          f"{1e-3 * counts[1]:.0f} kB, and takes part in {counts[2]:.0f} collective calls")
    print(f"projected with {1e6 * LATENCY:g} us a message, {1e-9 / PER_BYTE:g} GB/s, {1e6 * STAGE:g} us a stage of a reduction:")
    print(f"{'ranks':>6} {'4e6 cells, times as fast':>26} {'50 000 cells a rank, efficiency':>33}")
    for row in table:
        print(f"{row['ranks']:6} {row['strong_speedup']:26.1f} {row['weak_efficiency']:33.2f}")


if __name__ == "__main__":
    sys.exit(main())
