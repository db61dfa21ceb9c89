#!/usr/bin/python3
"""What a second of system B costs: in the packed start-up (1.5 s) and once developed (20 to 40 s).

    tests/cost/tfm_speed.py PROGRAM [--repeat 3]

20 x 200 cells of 3 mm, 30 mm/s, packed start at 0.62, explicit integrator, rtol 1e-3. Prints the median of the CPU
seconds, the counters, which repeat exactly, and the share of each term.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

CASE = Path(__file__).resolve().parents[2] / "cases/matsuura-akehata/case.toml"
SETTINGS = ['column.size=["60 mm", "600 mm"]', "column.cells=[20, 200]", "tfm.integrator=explicit", "tfm.rtol=1e-3"]
PHASES = (("packed start", 0, 1.5), ("developed", 20, 40))
COUNTERS = ("steps", "rejected_steps", "rhs_evaluations", "linear_iterations")


def run(program, directory, until, resume):
    command = [program, "tfm", CASE, "--quiet", "--until", f"{until} s", "-o", directory]
    command += ["--resume"] if resume else ["--force"]
    for setting in SETTINGS:
        command += ["--set", setting]
    subprocess.run([str(word) for word in command], check=True, stderr=subprocess.DEVNULL)
    return json.loads((Path(directory) / "run.json").read_text())


def phase(program, begin, end):
    """Record of the run from begin to end, with the counters of that part alone."""
    with tempfile.TemporaryDirectory() as directory:
        before = run(program, directory, begin, False) if begin else {"work": dict.fromkeys(COUNTERS, 0)}
        record = run(program, directory, end, bool(begin))
    record["work"] = {name: record["work"][name] - before["work"][name] for name in COUNTERS}
    return record


def print_phase(name, begin, end, records):
    cpu = statistics.median(r["cpu_s"] for r in records) / (end - begin)
    work = [records[0]["work"][c] for c in COUNTERS]
    assert all([r["work"][c] for c in COUNTERS] == work for r in records), "counters must repeat"
    print(f"| {name}, {begin:g} to {end:g} s | {cpu:.2f} | " + " | ".join(map(str, work)) + " |")


def print_terms(records):
    terms = records[-1]["timers"]
    rest = records[-1]["cpu_s"] - sum(terms.values())
    shares = sorted({**terms, "integrator and the rest": rest}.items(), key=lambda item: -item[1])
    print("  " + ", ".join(f"{name} {100 * s / records[-1]['cpu_s']:.0f} %" for name, s in shares))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--repeat", type=int, default=3)
    arguments = parser.parse_args()
    print("| phase | CPU s per simulated s | steps | rejected | right-hand sides | pressure iterations |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    all_records = []
    for name, begin, end in PHASES:
        all_records.append([phase(arguments.program, begin, end) for _ in range(arguments.repeat)])
        print_phase(name, begin, end, all_records[-1])
    for (name, _, _), records in zip(PHASES, all_records):
        print(f"\n{name}:")
        print_terms(records)
