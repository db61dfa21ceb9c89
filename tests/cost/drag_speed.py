#!/usr/bin/python3
"""The drag benchmark as a table: ns per evaluation of each law, and what `cello` and `brinkman_oseen` cost beside `vbk`.

    tests/cost/drag_speed.py build/tests/drag_benchmark

Fails where a batch of `cello`, guarded, costs more than `vbk` without its guard, or one of `brinkman_oseen` more than three
times `vbk`. Powers are computed several at a time, which made `vbk` three times as fast as it was when `cello` was to cost a
quarter of it.
"""
import json
import subprocess
import sys

KINDS = ("alone", "alone/bare", "1_species", "1_species/bare", "2_species", "2_species/bare", "4_species")
GOAL = 1
MOST_OF_BRINKMAN = 3
BATCHES = ("1_species", "2_species", "4_species")


def medians(program):
    """{(kind, law): ns per evaluation}, the median of five repetitions."""
    options = ["--benchmark_format=json", "--benchmark_repetitions=5", "--benchmark_report_aggregates_only=true",
               "--benchmark_min_time=0.05"]
    output = subprocess.run([program, *options], capture_output=True, text=True, check=True).stdout
    found = {}
    for entry in json.loads(output)["benchmarks"]:
        if entry["aggregate_name"] != "median":
            continue
        way, law, *rest = entry["run_name"].split("/")
        kind = "/".join((["alone"] if way == "alone" else []) + rest)
        found[kind, law] = 1e9 / entry["items_per_second"]
    return found


if __name__ == "__main__":
    ns = medians(sys.argv[1])
    print("| law | " + " | ".join(KINDS) + " |")
    print("| --- |" + " ---: |" * len(KINDS))
    for law in dict.fromkeys(law for _, law in ns):
        print(f"| `{law}` | " + " | ".join(f"{ns[kind, law]:.1f}" if (kind, law) in ns else "-" for kind in KINDS) + " |")
    ratios = {kind: ns[f"{kind}/bare", "vbk"] / ns[kind, "cello"] for kind in ("alone", *BATCHES)}
    print("\nvbk without guard over cello: " + ", ".join(f"{kind} {ratio:.1f}" for kind, ratio in ratios.items()))
    brinkman = {kind: ns[kind, "brinkman_oseen"] / ns[kind, "vbk"] for kind in BATCHES}
    print("brinkman_oseen over vbk: " + ", ".join(f"{kind} {ratio:.2f}" for kind, ratio in brinkman.items()))
    sys.exit(any(ratios[kind] < GOAL for kind in BATCHES) or any(ratio > MOST_OF_BRINKMAN for ratio in brinkman.values()))
