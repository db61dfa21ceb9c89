#!/usr/bin/python3
"""polybed and OpenFOAM 1912's DPMFoam on one gas-fluidised bed: CPU seconds per particle-step and per simulated second.

    tests/cost/demcfd_peers.py PROGRAM [--phase NAME]... [--begin S] [--end S] [--repeat N] [--ledger] [--json FILE]

The bed of OpenFOAM's tutorial, 24 750 beads of 2.5 mm in air on 5400 cells (cases/goldschmidt-2004), each program with
its own steps. Phases: packed, from the bed at rest on its floor; lattice, as the tutorial starts. Both serial. Cost and
steps are those from --begin to --end; a particle-step is one step of one particle's motion, of which both programs
take several in a step of the fluid. CPU seconds: of OpenFOAM by the clock in its log; of polybed the kernel's for a run
to --end less one to --begin. Medians of the repeats; spread: largest less smallest over the median.
Exit code 1: a goal is missed or a run failed; 2: OpenFOAM is not installed, or polybed does not run the case.
"""
import argparse
import csv
import json
import re
import statistics
import sys
import tempfile
from pathlib import Path

import dem_polybed
import dem_process
import demcfd_bed
import openfoam_particles
import openfoam_run
from dem_goals import MOST_SPREAD, spread
from peer_report import print_verdicts

GOAL = 50.0  # OpenFOAM's CPU seconds per particle-step over polybed's
FLUID_EVERY = 5  # polybed's own steps of 3.7 us to one of its gas, which then is no longer than the tutorial's 20 us
# Of the height of the bed, at the end: the phases last milliseconds, in which no bead moves far
SAME_HEIGHT = 0.01
DIFFERENCES = """\
Same in both: beads and their places, box, cells, gas of constant density, Ergun's drag below and Wen and Yu's above a
  voidage of 0.8, Hertz's law with one set of moduli, restitution and friction; one process.
Different: polybed's beads feel the pressure gradient too; its drag laws are joined by an arctangent; its front and back
  are walls, OpenFOAM's are symmetric for the gas and reflect a bead whose centre meets them; its tangential spring has
  2/3 of OpenFOAM's stiffness; its gas moves in steps of 18.4 us, OpenFOAM's in the tutorial's of 20 us.
  OpenFOAM has the tutorial's second-order convection, steps of first order, and tolerances."""


class WithoutGas(dem_process.Failed):
    """A polybed that has no coupling."""


def dry(run):
    """Whether the gas has left no trace: a program without the coupling."""
    with open(run / "history.csv", newline="") as stream:
        return float(list(csv.DictReader(stream))[-1]["pressure_drop_Pa"]) == 0


def on_polybed(bed, arguments, directory):
    demcfd_bed.write_places(directory / "start.csv", bed, bed["places"])
    case, runs = directory / "case.toml", {}
    case.write_text(re.sub(r"\[bed\]\n(.+\n)+", '[bed]\nstart = "list:start.csv"\n', demcfd_bed.CASE.read_text()))
    for name, until in (("short", arguments.begin), ("long", arguments.end)):
        keys = {"output.every": f"{until} s", "output.history_every": f"{until} s"}
        words = [word for key, value in keys.items() for word in ("--set", f'{key}="{value}"')]
        words += ["--set", f"dem.fluid_every={FLUID_EVERY}"]
        words += ["--set", f"dem.ledger={str(arguments.ledger).lower()}"]
        cost = dem_process.run([arguments.program, "dem", case, "--quiet", "--no-picture", "-o", name, "--until",
                                f"{until} s", *words], directory, 1, arguments.limit)
        runs[name] = cost | json.loads((directory / name / "run.json").read_text())["work"]
    if dry(directory / "long"):
        raise WithoutGas("this polybed runs the case without its gas")
    cpu, steps = (runs["long"][what] - runs["short"][what] for what in ("cpu_s", "steps"))
    return {"cpu_s": cpu, "solid_steps": steps, "fluid_steps": steps / FLUID_EVERY,
            "places": demcfd_bed.stored(directory / "long")}


def on_openfoam(bed, arguments, directory):
    return openfoam_particles.solve(directory / "case", bed, arguments.begin, arguments.end, arguments.limit)


PROGRAMS = {"OpenFOAM": on_openfoam, "polybed": on_polybed}


def solve(name, bed, arguments):
    """One run in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "case").mkdir()
        result = PROGRAMS[name](bed, arguments, Path(folder))
    return result | demcfd_bed.measures(bed, result.pop("places"))


def summary(runs, bed, simulated):
    """Medians: CPU ns per particle-step and CPU s per simulated second; the rest from the last run."""
    cpu = statistics.median(run["cpu_s"] for run in runs)
    return runs[-1] | {"ns": 1e9 * cpu / (bed["count"] * runs[-1]["solid_steps"]), "cpu_per_s": cpu / simulated,
                       "spread": spread([run["cpu_s"] for run in runs]), "cpu_s": [run["cpu_s"] for run in runs]}


def measure(phase, bed, arguments):
    """Programs in turn, `repeat` times: summaries by name, and why the others failed."""
    turns, failed = {name: [] for name in PROGRAMS}, {}
    for repeat in range(arguments.repeat):
        for name in (n for n in turns if n not in failed):
            try:
                turns[name].append(solve(name, bed, arguments))
                cpu = turns[name][-1]["cpu_s"]
                print(f"  {phase}, {name}, run {repeat + 1}: CPU s {cpu:.2f}", file=sys.stderr, flush=True)
            except (openfoam_run.Failed, dem_process.Failed) as failure:
                failed[name] = failure
                print(f"  {phase}, {name}: {failure}", file=sys.stderr, flush=True)
    simulated = arguments.end - arguments.begin
    return {name: summary(runs, bed, simulated) for name, runs in turns.items() if name not in failed}, failed


def print_phase(phase, start, runs, failed, arguments):
    print(f"\n### {phase}: {1e3 * arguments.begin:g} to {1e3 * arguments.end:g} ms; bed at the start "
          f"{1e3 * start['bed_height_m']:.1f} mm, centre {1e3 * start['centre_m']:.2f} mm\n")
    print("| program | ns per particle-step | CPU s per simulated s | solid steps | fluid steps | bed, mm | "
          "centre, mm | spread, % |\n| --- |" + " ---: |" * 7)
    for name, run in runs.items():
        print(f"| {name} | {run['ns']:.0f} | {run['cpu_per_s']:.0f} | {run['solid_steps']:.0f} | "
              f"{run['fluid_steps']:.0f} | {1e3 * run['bed_height_m']:.2f} | {1e3 * run['centre_m']:.3f} | "
              f"{100 * run['spread']:.1f} |")
    for name, why in failed.items():
        print(f"| {name} | failed: {str(why).splitlines()[0]} |")


def verdicts(runs):
    """Goals as (sentence, met); met None: not judged."""
    if len(runs) < 2:
        return []
    mine, peer = runs["polybed"], runs["OpenFOAM"]
    noisy = max(mine["spread"], peer["spread"]) > MOST_SPREAD
    note = f"; fewer than three runs, or times that spread by more than {MOST_SPREAD:.0%}" if noisy else ""
    ratio, whole = peer["ns"] / mine["ns"], peer["cpu_per_s"] / mine["cpu_per_s"]
    apart = abs(mine["bed_height_m"] / peer["bed_height_m"] - 1)
    return [(f"per particle-step OpenFOAM takes {ratio:.2f} times polybed's CPU, goal at least {GOAL:g}{note}",
             None if noisy else ratio >= GOAL),
            (f"per simulated second {whole:.2f} times; no goal", None),
            (f"heights of the bed apart by {apart:.2%}, at most {SAME_HEIGHT:.0%}", apart <= SAME_HEIGHT)]


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--phase", action="append", choices=("packed", "lattice"), help="default: both")
    parser.add_argument("--begin", type=float, default=1e-3, help="s, where cost begins to count")
    parser.add_argument("--end", type=float, default=6e-3, help="s")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--ledger", action="store_true", help="have polybed account for the energy, which OpenFOAM cannot")
    parser.add_argument("--limit", type=int, default=3600, help="CPU seconds that one run may take")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    arguments.program = arguments.program.resolve()
    return arguments


def starts(bed, arguments):
    """Places of the beads by phase."""
    with tempfile.TemporaryDirectory() as folder:
        makers = {"packed": lambda: demcfd_bed.packed(bed, arguments.program, folder, arguments.limit),
                  "lattice": lambda: demcfd_bed.lattice(bed)}
        return {phase: makers[phase]() for phase in arguments.phase or makers}


def main():
    arguments = read_arguments()
    if missing := openfoam_run.missing((openfoam_particles.PROGRAM, "blockMesh")):
        print(f"not installed: {', '.join(missing)}; install {openfoam_run.PACKAGE}", file=sys.stderr)
        sys.exit(2)
    if not dem_polybed.knows_particles(arguments.program):
        print(f"{arguments.program} has no command dem", file=sys.stderr)
        sys.exit(2)
    bed, phases, lines, without_gas = demcfd_bed.read(arguments.program), {}, [], False
    versions = {"openfoam": openfoam_run.version(), "polybed": dem_polybed.version(arguments.program)}
    print(", ".join(f"{name} {version}" for name, version in versions.items()))
    for phase, places in starts(bed, arguments).items():
        runs, failed = measure(phase, bed | {"places": places}, arguments)
        print_phase(phase, demcfd_bed.measures(bed, places), runs, failed, arguments)
        lines += [(f"{phase}: {sentence}", met) for sentence, met in verdicts(runs)]
        phases[phase] = {"runs": runs, "failed": {n: str(why) for n, why in failed.items()}}
        without_gas |= any(isinstance(why, WithoutGas) for why in failed.values())
    print("\n" + DIFFERENCES)
    print_verdicts(lines)
    if arguments.json:
        record = {"filetype": "polybed coupled peers", "version": 1, "versions": versions, "phases": phases,
                  "goals": [{"what": sentence, "met": met} for sentence, met in lines]}
        arguments.json.write_text(json.dumps(record, indent=1) + "\n")
    wrong = any(phase["failed"] for phase in phases.values()) or any(met is False for _, met in lines)
    sys.exit(2 if without_gas else wrong)


if __name__ == "__main__":
    main()
