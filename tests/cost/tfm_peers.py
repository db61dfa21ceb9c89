#!/usr/bin/python3
"""polybed and OpenFOAM 1912 on the same beds: CPU seconds per simulated second, bed height, centres, pressure drop.

    tests/cost/tfm_peers.py PROGRAM [--phase NAME]... [--repeat N] [--reference] [--solids-stress LAW] [--json FILE]

Both serial, on the same grid, over the same simulated time; CPU seconds of the process, without mesh or picture. Step
error of a run: its largest relative difference, over the compared times, from the same program with the next smaller
step or tolerance; error: that from the same program on cells of half the size, with --reference, which takes many
minutes.
Exit code 1: a goal is missed; 2: OpenFOAM is not installed.
"""
import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import openfoam_cases
import openfoam_run
import peer_beds
import polybed_case
from peer_report import print_verdicts

CHEAP = 15.0  # CPU s; dearer runs are not repeated


def measures_of(bed):
    return ["bed_height_m"] + [f"centre_{s['name']}_m" for s in bed["solids"]] + ["pressure_drop_Pa"]


def solve_openfoam(directory, bed, settings, begin, limit):
    openfoam_cases.write_case(directory, bed, settings)
    cpu = openfoam_run.solve(settings["program"], directory, limit)
    rows = openfoam_run.rows(directory, bed)
    start = {s["name"]: rows[0][f"volume_{s['name']}"] for s in bed["solids"]}
    log = openfoam_run.read_log(directory / "log", start)
    fields = {n: max(abs(row[f"volume_{n}"] / share - 1) for row in rows) for n, share in start.items()}
    if begin:
        cpu = openfoam_run.cpu_between(log["clock"], begin, settings["until"])
    return {"cpu_s": cpu, "rows": rows, "steps": log["steps"], "volume_change": fields,
            "record": {"volume_change_of_log": log["volume_change"], "phase_sum_error": log["phase_sum_error"]}}


def solve(arguments, phase, settings):
    """One run in a folder of its own; its settings and results, or why it failed."""
    bed = phase["bed"] | {"cells": tuple(n * settings.get("refine", 1) for n in phase["bed"]["cells"])}
    settings = settings | {"until": phase["end"], "every": phase["every"]}
    with tempfile.TemporaryDirectory() as folder:
        directory = Path(folder) / "case"
        try:
            if settings["code"] == "openfoam":
                result = solve_openfoam(directory, bed, settings, phase["begin"], arguments.limit)
            else:
                result = polybed_case.solve(arguments.program, directory, bed, settings, phase["begin"],
                                            arguments.limit)
        except openfoam_run.Failed as failure:
            return {"settings": settings, "failed": str(failure)}
    names = measures_of(bed)
    rows = [{"time_s": time} | {n: at(result["rows"], time)[n] for n in names} for time in (0.0, *phase["at"])]
    return {"settings": settings, "failed": None, "cpu_per_s": result["cpu_s"] / (phase["end"] - phase["begin"])} | {
        key: result[key] for key in ("steps", "volume_change", "record")} | {"measures": rows}


def at(rows, time):
    row = min(rows, key=lambda r: abs(r["time_s"] - time))
    if abs(row["time_s"] - time) > 1e-6:
        raise openfoam_run.Failed(f"nothing is stored at {time} s")
    return row


def difference(run, other, names):
    """Largest relative difference of the measures over the compared times; None where one of the runs failed."""
    if run["failed"] or other["failed"]:
        return None
    return max(abs(a[n] / b[n] - 1) for a, b in zip(run["measures"][1:], other["measures"][1:]) for n in names)


def check_start(runs, names):
    """Both programs start from one bed: the geometric measures agree at time zero."""
    starts = [run["measures"][0] for run in runs.values() if not run["failed"]]
    for name in (n for n in names if n != "pressure_drop_Pa"):
        values = [start[name] for start in starts]
        if max(values) / min(values) - 1 > 2e-3:  # the expanded bed ends within a cell, finer cells cut it elsewhere
            sys.exit(f"{name} differs at the start: {values}")


def finer(name, phase):
    """Name of the run of the same program and models with the next smaller step or tolerance."""
    mine = phase["runs"][name]
    key = "rtol" if mine["code"] == "polybed" else "step"
    same = {n: s for n, s in phase["runs"].items() if {k: v for k, v in s.items() if k != key} ==
            {k: v for k, v in mine.items() if k != key} and s[key] < mine[key]}
    return max(same, key=lambda n: same[n][key]) if same else None


def too_fast(phase, run):
    """Why a run is wrong however accurate it looks: a packed bed cannot rise faster than the liquid that lifts it."""
    if run["failed"] or not phase.get("plug"):
        return None
    rise = run["measures"][1]["bed_height_m"] - run["measures"][0]["bed_height_m"]
    speed = rise / run["measures"][1]["time_s"] / phase["bed"]["velocity"]
    return f"wrong: the packed bed rises {speed:.1f} times as fast as the liquid" if speed > 1.05 else None


def repeated(arguments, phase, settings):
    """Result with the median cost; only cheap runs are repeated."""
    results = [solve(arguments, phase, settings)]
    length = phase["end"] - phase["begin"]
    while not results[0]["failed"] and results[0]["cpu_per_s"] * length < CHEAP and len(results) < arguments.repeat:
        results.append(solve(arguments, phase, settings))
    costs = [r["cpu_per_s"] for r in results if not r["failed"]]
    return results[0] | ({"cpu_per_s": statistics.median(costs), "cpu_per_s_all": costs} if costs else {})


def compare(arguments, phase):
    """Results of all runs of a phase, with their errors and the ratio of their cost to polybed's."""
    chosen = phase["runs"] | (phase["finest"] if arguments.reference else {})
    runs = {}
    for name, settings in chosen.items():
        runs[name] = repeated(arguments, phase, settings)
        print(f"  {phase['name']}, {name}: {runs[name].get('cpu_per_s', 'failed')}", file=sys.stderr, flush=True)
    names = measures_of(phase["bed"])
    check_start(runs, names)
    for name, run in runs.items():
        other = finer(name, phase) if name in phase["runs"] else None
        finest = runs.get("polybed finest" if run["settings"]["code"] == "polybed" else "OpenFOAM finest")
        same_models = finest not in (None, run) and "own models" not in name and "perfect" not in name
        run["step_error"] = difference(run, runs[other], names) if other else None
        run["error"] = difference(run, finest, names) if same_models else None
        run["from_polybed"] = difference(run, runs["polybed"], names)
        run["ratio"] = None if run["failed"] else run["cpu_per_s"] / runs["polybed"]["cpu_per_s"]
        run["wrong"] = too_fast(phase, run)
    return runs


def percent(value):
    return "-" if value is None else f"{100 * value:.2g}"


def print_phase(phase, runs):
    names = measures_of(phase["bed"])
    scale = {"m": (1e3, "mm"), "Pa": (1.0, "Pa")}
    heads = [f"{n.rsplit('_', 1)[0].replace('_', ' ')}, {scale[n.rsplit('_', 1)[1]][1]}" for n in names]
    print(f"\n### {phase['name']}: cost from {phase['begin']:g} to {phase['end']:g} s, "
          f"measures at {phase['at'][-1]:g} s\n")
    print("| run | CPU s per s | times polybed | steps | " + " | ".join(heads) +
          " | step error, % | error, % | from polybed, % | change of volume |")
    print("| --- |" + " ---: |" * (len(heads) + 7))
    for name, run in runs.items():
        if run["failed"]:
            print(f"| {name} | failed: {run['failed'].splitlines()[0]} |")
            continue
        values = [f"{run['measures'][-1][n] * scale[n.rsplit('_', 1)[1]][0]:.2f}" for n in names]
        print(f"| {name} | {run['cpu_per_s']:.2f} | {run['ratio']:.1f} | {run['steps']} | " + " | ".join(values) +
              f" | {percent(run['step_error'])} | {percent(run['error'])} | {percent(run['from_polybed'])} | "
              f"{max(run['volume_change'].values()):.0e} |" + (f" {run['wrong']}" if run["wrong"] else ""))
    print("\n" + phase["differences"])


def verdicts(phase, runs):
    """Goals of the phase against what was measured, as (sentence, met); met None: could not be judged."""
    lines = []
    for name in ("polybed", "polybed, own models"):
        if "rate_goal" in phase:
            rate = runs[name]["cpu_per_s"]
            lines.append((f"{name}: {rate:.2f} CPU s per s, goal at most {phase['rate_goal']:g}",
                          rate <= phase["rate_goal"]))
    goal = phase["goal"]
    peers = {n: r for n, r in runs.items()
             if r["settings"]["code"] == "openfoam" and n in phase["runs"] and not r["failed"]}
    for name, run in peers.items():
        lines.append((f"{name}: " + (run["wrong"] or f"{run['ratio']:.1f} times polybed, goal at least {goal:g}"),
                      None if run["wrong"] else run["ratio"] >= goal))
    return lines + [equal_error(kind, runs["polybed"], peers, goal) for kind in ("step_error", "error")
                    if runs["polybed"][kind] is not None]


def equal_error(kind, mine, peers, goal):
    """The cheapest run of OpenFOAM whose error is at most polybed's; if there is none, what first order would cost."""
    judged = {n: r for n, r in peers.items() if r[kind] is not None and not r["wrong"]}
    as_good = {n: r for n, r in judged.items() if r[kind] <= mine[kind]}
    what = f"{kind.replace('_', ' ')} at most polybed's {percent(mine[kind])} %"
    if as_good:
        name = min(as_good, key=lambda n: as_good[n]["ratio"])
        ratio = as_good[name]["ratio"]
        return f"{what}: {name}, {ratio:.1f} times, goal at least {goal:g}", ratio >= goal
    note = ""
    if kind == "step_error" and judged:
        least = min(run["ratio"] * run[kind] / mine[kind] for run in judged.values())
        note = f"; extrapolated with first order in the step: {least:.0f} times"
    return f"{what}: no run of OpenFOAM{note}", None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--phase", action="append", help="as in peer_beds.py; default: all")
    parser.add_argument("--repeat", type=int, default=3, help="of runs below 15 CPU s")
    parser.add_argument("--reference", action="store_true", help="also runs on cells of half the size")
    parser.add_argument("--solids-stress", default="frictional", help="of polybed's gas bed: frictional | kinetic")
    parser.add_argument("--limit", type=int, default=900, help="CPU seconds that one run may take")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    arguments.program = arguments.program.resolve()
    if openfoam_run.missing():
        print(f"not installed: {', '.join(openfoam_run.missing())}; install {openfoam_run.PACKAGE}", file=sys.stderr)
        sys.exit(2)
    chosen = peer_beds.phases(arguments.solids_stress)
    unknown = set(arguments.phase or ()) - {p["name"] for p in chosen}
    if unknown:
        parser.error(f"no phase {', '.join(sorted(unknown))}; there are {', '.join(p['name'] for p in chosen)}")
    versions = {"openfoam": openfoam_run.version(),
                "polybed": subprocess.check_output([arguments.program, "--version"], text=True).strip()}
    print(", ".join(f"{name} {version}" for name, version in versions.items()))
    report = {"filetype": "polybed peers", "version": 1, "versions": versions, "phases": {}}
    for phase in chosen:
        if arguments.phase and phase["name"] not in arguments.phase:
            continue
        runs = compare(arguments, phase)
        print_phase(phase, runs)
        lines = verdicts(phase, runs)
        print_verdicts(lines)
        report["phases"][phase["name"]] = {"runs": runs, "goals": [{"what": s, "met": met} for s, met in lines]}
    if arguments.json:
        arguments.json.write_text(json.dumps(report, indent=1) + "\n")
    sys.exit(any(goal["met"] is False for phase in report["phases"].values() for goal in phase["goals"]))


if __name__ == "__main__":
    main()
