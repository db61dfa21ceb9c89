#!/usr/bin/python3
"""polybed, LAMMPS and LIGGGHTS on one dense packing: particle-steps per CPU second, two ranks, memory, same physics.

    tests/cost/dem_peers.py PROGRAM [--native PROGRAM] [--phase COPIES]... [--repeat N] [--steps N] [--list HOW]
                            [--json FILE]

PROGRAM: polybed as built for any x86-64, as the peers of Debian are; --native: built for this machine. A packing of
4000 spheres, and 27 copies of it: 108 000. Every program gets the same particles, material, law as near as it has it,
time step and skin. Runs take turns, pinned to one core, or two for two ranks. A rate is that of the steps after the
first WARM_UP: of a long run less a short one, so that start and file reading are out of it; CPU seconds are the
kernel's, medians of the runs; spread: of the CPU seconds of the long runs, largest less smallest over the median.
Exit code 1: a goal is missed or a run failed; 2: no polybed with a particle model, or no peer, to be compared.
"""
import argparse
import json
import statistics
import sys
import tempfile
from pathlib import Path

import dem_bed
import dem_polybed
import lammps_run
import liggghts_run
from dem_goals import rate_goals, same_contacts, same_energy, speed_up, spread
from dem_process import Failed, run
from peer_report import print_verdicts

WARM_UP, TRACED, SAMPLE = 200, 300, 100  # steps
STEPS = {1: 4000, 3: 2000}  # by copies of the packing along each axis
PEERS = {"LAMMPS gran/hertz/history": (lammps_run, "fast"), "LAMMPS granular": (lammps_run, "same"),
         "LIGGGHTS": (liggghts_run, "hertz")}
SECANT = "LAMMPS granular, secant"  # for the trace alone: the law of LIGGGHTS
SAME_LAWS = (("polybed", "LAMMPS granular"), ("polybed native", "LAMMPS granular"), ("LIGGGHTS", SECANT))


def contestants(arguments):
    """Name: settings of each program that is here; what is not is told."""
    found = {}
    for name, program in (("polybed", arguments.program), ("polybed native", arguments.native)):
        if program and dem_polybed.knows_particles(program):
            found[name] = {"code": dem_polybed, "law": "mindlin", "program": program.resolve()}
        elif program:
            print(f"{program} has no command dem", file=sys.stderr)
    for name, (code, law) in PEERS.items():
        if code.installed():
            found[name] = {"code": code, "law": law}
        else:
            print(f"not installed: {name}; apt-get install --no-install-recommends {code.PACKAGE}", file=sys.stderr)
    return found


def versions(found):
    return {name: dem_polybed.version(s["program"]) if "program" in s else s["code"].version()
            for name, s in found.items()}


def solve(bed, settings, steps, ranks, arguments, sample=0):
    """What one run cost and reports."""
    settings = settings | {"steps": steps, "ranks": ranks, "sample": sample, "list": arguments.list}
    with tempfile.TemporaryDirectory() as folder:
        directory = Path(folder)
        settings["code"].write(directory, bed, settings)
        cost = run(settings["code"].command(settings), directory, ranks, arguments.limit)
        return cost | settings["code"].read(directory, settings)


def turn(bed, settings, steps, ranks, arguments):
    """A short and a long run, `steps` longer."""
    return {name: solve(bed, settings, count, ranks, arguments)
            for name, count in (("short", WARM_UP), ("long", WARM_UP + steps))}


def summary(turns, count, steps, ranks):
    """Rates of the steps after the first WARM_UP: those of the median long run less the median short one."""
    def difference(what):
        long, short = (statistics.median(t[length][what] for t in turns) for length in ("long", "short"))
        return long - short

    cpu, wall, last = difference("cpu_s"), difference("wall_s"), turns[-1]["long"]
    memory = statistics.median(t["long"]["memory_B"] for t in turns)
    return {"rate": count * steps / cpu, "wall_rate": count * steps / wall, "busy": cpu / (wall * ranks),
            "spread": spread([t["long"]["cpu_s"] for t in turns]), "memory_B": memory, "rebuilds": last["rebuilds"],
            "contacts": last["rows"][-1]["contacts"], "turns": turns}


def measure(bed, found, steps, arguments):
    """All programs on one and two ranks in turn, `repeat` times; summaries by (name, ranks), and what failed."""
    turns, failed = {(name, ranks): [] for ranks in arguments.ranks for name in found}, {}
    for repeat in range(arguments.repeat):
        for name, ranks in (key for key in turns if key not in failed):
            try:
                turns[name, ranks].append(turn(bed, found[name], steps, ranks, arguments))
                cpu = [f"{turns[name, ranks][-1][length]['cpu_s']:.2f}" for length in ("long", "short")]
                print(f"  {bed['count']} particles, {name}, ranks {ranks}, run {repeat + 1}: CPU s "
                      f"{' less '.join(cpu)}", file=sys.stderr, flush=True)
            except Failed as failure:
                failed[name, ranks] = str(failure)
                print(f"  {name}, ranks {ranks}: {failure}", file=sys.stderr, flush=True)
    good = {key: runs for key, runs in turns.items() if key not in failed}
    return {key: summary(runs, bed["count"], steps, key[1]) for key, runs in good.items()}, failed


def trace(bed, found, arguments):
    """Rows of the first steps of each program, and of LAMMPS with the law of LIGGGHTS."""
    more = {SECANT: {"code": lammps_run, "law": "secant"}} if lammps_run.installed() else {}
    traces = {}
    for name, settings in (found | more).items():
        try:
            traces[name] = solve(bed, settings, TRACED, 1, arguments, SAMPLE)["rows"]
        except Failed as failure:
            print(f"  {name}: {failure}", file=sys.stderr, flush=True)
    return traces


def print_traces(traces):
    steps = [row["step"] for row in next(iter(traces.values()), []) if row["step"]]
    print("\n| kinetic energy, nJ, after steps | " + " | ".join(map(str, steps)) + " |")
    print("| --- |" + " ---: |" * len(steps))
    for name, rows in traces.items():
        print(f"| {name} | " + " | ".join(f"{1e9 * row['kinetic_J']:.3f}" for row in rows if row["step"]) + " |")


def print_phase(bed, runs, failed, steps):
    print(f"\n### {bed['count']} particles, {steps} steps; at the start {bed['contacts']:.2f} contacts and "
          f"{bed['listed']:.2f} within the skin per particle\n")
    print("| program | ranks | 1e6 particle-steps per CPU s | spread, % | per wall s | busy, % | lists | contacts | "
          "memory, MB |\n| --- |" + " ---: |" * 8)
    for (name, ranks), run_ in runs.items():
        contacts = "-" if run_["contacts"] is None else f"{run_['contacts']:.3f}"
        print(f"| {name} | {ranks} | {run_['rate'] / 1e6:.2f} | {100 * run_['spread']:.1f} | "
              f"{run_['wall_rate'] / 1e6:.2f} | {100 * run_['busy']:.0f} | {run_['rebuilds']:.0f} | {contacts} | "
              f"{run_['memory_B'] / 1e6:.0f} |")
    for (name, ranks), reason in failed.items():
        print(f"| {name} | {ranks} | failed: {reason.splitlines()[0]} |")


def verdicts(runs, copies):
    alone = {name: r for (name, ranks), r in runs.items() if ranks == 1}
    peers = {name: r for name, r in alone.items() if name in PEERS}
    lines = [same_contacts(alone)]
    for name in (n for n in alone if n not in PEERS):
        lines += rate_goals(name, alone[name], peers, copies)
        if (name, 2) in runs and copies == 3:
            lines.append(speed_up(name, alone[name], runs[name, 2], copies))
    return lines


def memory_per_particle(phases):
    """Bytes by program, from the peaks of the two packings on one rank."""
    if len(phases) < 2:
        return {}
    small, large = phases[0], phases[-1]
    return {name: (r["memory_B"] - small["runs"][name, ranks]["memory_B"]) / (large["count"] - small["count"])
            for (name, ranks), r in large["runs"].items() if ranks == 1 and (name, ranks) in small["runs"]}


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--native", type=Path, help="polybed built for this machine")
    parser.add_argument("--phase", type=int, action="append", choices=(1, 3), help="copies along each axis")
    parser.add_argument("--ranks", type=int, action="append", choices=(1, 2), help="default: 1, 2")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--steps", type=int, help="that are timed; default: 4000 of 4000 particles, 2000 of 108 000")
    parser.add_argument("--list", default="interval", choices=("interval", "displacement"),
                        help="when the peers renew their lists; polybed does by displacement")
    parser.add_argument("--limit", type=int, default=600, help="CPU seconds that one process may take")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    arguments.phase, arguments.ranks = sorted(arguments.phase or (1, 3)), sorted(arguments.ranks or (1, 2))
    return arguments


def as_record(phase):
    runs = [{"program": name, "ranks": ranks} | r for (name, ranks), r in phase["runs"].items()]
    failed = [{"program": name, "ranks": ranks, "why": why} for (name, ranks), why in phase["failed"].items()]
    return {"count": phase["count"], "runs": runs, "failed": failed}


def main():
    arguments = read_arguments()
    found = contestants(arguments)
    if not found:
        sys.exit(2)
    about = versions(found)
    print("\n".join(f"{name}: {version}" for name, version in about.items()))
    packing, phases, lines = dem_bed.settle(), [], []
    traces = trace(dem_bed.make(packing), found, arguments)
    print_traces(traces)
    lines += [same_energy(a, b, traces) for a, b in SAME_LAWS if a in traces and b in traces]
    for copies in arguments.phase:
        bed = dem_bed.make(packing, copies)
        steps = arguments.steps or STEPS[copies]
        runs, failed = measure(bed, found, steps, arguments)
        print_phase(bed, runs, failed, steps)
        lines += verdicts(runs, copies)
        phases.append({"count": bed["count"], "runs": runs, "failed": failed})
    memory = memory_per_particle(phases)
    print("\n" + "\n".join(f"{name}: {size:.0f} bytes per particle" for name, size in memory.items()))
    print_verdicts(lines)
    if arguments.json:
        record = {"filetype": "polybed particle peers", "version": 1, "versions": about, "traces": traces,
                  "phases": [as_record(p) for p in phases], "bytes_per_particle": memory,
                  "goals": [{"what": sentence, "met": met} for sentence, met in lines]}
        arguments.json.write_text(json.dumps(record, indent=1) + "\n")
    whole = any(n in PEERS for n in found) and any(n not in PEERS for n in found)
    sys.exit(1 if any(met is False for _, met in lines) or any(p["failed"] for p in phases) else 0 if whole else 2)


if __name__ == "__main__":
    main()
