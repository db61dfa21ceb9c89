#!/usr/bin/python3
"""The drag benchmark as a table: ns per evaluation of each law, and how much cheaper `cello` is than `vbk`.

    tests/cost/drag_speed.py build/tests/drag_benchmark
"""
import json
import subprocess
import sys

KINDS = ("alone", "batch", "mixture/2", "mixture/4")


def medians(program):
    """{(kind, law): ns per evaluation}, the median of five repetitions."""
    options = ["--benchmark_format=json", "--benchmark_repetitions=5", "--benchmark_report_aggregates_only=true",
               "--benchmark_min_time=0.05"]
    output = subprocess.run([program, *options], capture_output=True, text=True, check=True).stdout
    found = {}
    for entry in json.loads(output)["benchmarks"]:
        if entry["aggregate_name"] != "median":
            continue
        kind, law, *species = entry["run_name"].split("/")
        found["/".join([kind, *species]), law] = 1e9 / entry["items_per_second"]
    return found


if __name__ == "__main__":
    ns = medians(sys.argv[1])
    print("| law | " + " | ".join(KINDS) + " |")
    print("| --- |" + " ---: |" * len(KINDS))
    for law in dict.fromkeys(law for _, law in ns):
        print(f"| `{law}` | " + " | ".join(f"{ns[kind, law]:.1f}" for kind in KINDS) + " |")
    print("\nvbk over cello: " + ", ".join(f"{kind} {ns[kind, 'vbk'] / ns[kind, 'cello']:.1f}" for kind in KINDS))
