#!/usr/bin/python3
"""The band of `polybed estimate` is to hold what a run took in nine of ten: every shipped case and template, by each model that can run
it, cut to the time for which so many seconds of computing are expected. Usage: estimate_band.py PROGRAM [SECONDS [NAME ...]]

Some CPU minutes at 3 s. Prints a table of them all, for docs/record/cost.md, and by kind of step what the runs took over what was expected:
from that come the middles and factors in multiscale/estimate/estimate.cpp."""
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import tomllib

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
ENOUGH = 0.9
TOO_LONG = 6  # times the seconds: a start that cannot be cut


def answer(program, *words):
    done = subprocess.run([program, *map(str, words), "--json"], capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip().split("\n")[0])
    return json.loads(done.stdout)


def cut(program, case, model, seconds):
    """(simulated time, estimate) of a run that is expected to take no longer."""
    until = full = tomllib.loads(answer(program, "check", case, "--resolved")["case"])["run"]["until"]
    for _ in range(4):
        expected = answer(program, "estimate", case, "--model", model, "--set", f"run.until={until}")["cpu_s"]
        if expected["expected"] < 1.5 * seconds:
            break
        until = float(f"{min(full, until * max(0.05, seconds / expected['expected'])):.3g}")
    return until, expected


def main():
    program, seconds, names = os.path.abspath(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 3, sys.argv[3:]
    cases = [path for path in sorted(CASES.glob("*/case.toml")) + sorted(CASES.glob("[tv]*/*/case.toml"))
             if not names or path.parent.name in names]
    ratios, held = {}, []
    print("| case | model | simulated | expected, s | band | taken, s | within |\n| --- | --- | --- | ---: | ---: | ---: | --- |")
    for case in cases:
        for model in ("tfm", "dem"):
            try:
                until, expected = cut(program, case, model, seconds)
                if expected["expected"] > TOO_LONG * seconds:
                    continue
                with tempfile.TemporaryDirectory() as folder:
                    run = answer(program, model, case, "--until", f"{until} s", "--quiet", "--no-picture", "-o", folder + "/run")
            except RuntimeError as error:
                print(f"{case.parent.name} {model}: {error}", file=sys.stderr)  # most often no case for this model
                continue
            taken, kind = run["cpu_s"], run.get("integrator") if model == "tfm" else model
            held.append(expected["least"] <= taken <= expected["most"])
            ratios.setdefault(kind, []).append(taken / expected["expected"])
            print(f"| {case.parent.name} | {model} | {until:g} s | {expected['expected']:.2g} | {expected['least']:.2g} to {expected['most']:.2g} "
                  f"| {taken:.2g} | {'yes' if held[-1] else 'no'} |", flush=True)
    for kind, values in ratios.items():
        logs = [math.log(value) for value in values]
        print(f"{kind}: {len(values)} runs took {min(values):.2g} to {max(values):.2g} of what was expected, {math.exp(statistics.mean(logs)):.2g} in "
              f"the geometric mean, with a standard deviation of the logarithm of {statistics.pstdev(logs):.2g}")
    print(f"{sum(held)} of {len(held)} within")
    return 0 if sum(held) >= ENOUGH * len(held) else 1


if __name__ == "__main__":
    sys.exit(main())
