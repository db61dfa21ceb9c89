#!/usr/bin/python3
"""E2 of the specification of effects: what short runs left out, against the bounds. Usage: effects_promise.py PROGRAM [NAME]

Each run has the roles of its case, so that much is left out; its monitor evaluates it for every particle or cell at every tenth step
(particles: every hundredth). Code 1 where the greatest of an effect is beyond its bound. Whether the promise of the tolerance is kept is
told beside it: a case chosen by hand need not keep it.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
# Name, case, model, end time, further settings.
RUNS = [("B, packed", "matsuura-akehata", "tfm", "3 s", ["bed.start_solids_fraction=0.62"]),
        ("B, packed, cells of 6 mm", "matsuura-akehata", "tfm", "3 s",
         ["bed.start_solids_fraction=0.62", "column.cells=[10,99]"]),
        ("B, particles", "quarter-b", "dem", "0.2 s", ["bed.start_solids_fraction=0.58"]),
        ("A", "thesis-a", "tfm", "0.6 s", []),
        ("C", "thesis-c", "tfm", "1 s", []),
        ("sand, fed", "classifier", "tfm", "3 s", []),
        ("beads in air", "goldschmidt", "tfm", "0.2 s", [])]


def answer(program, *words):
    done = subprocess.run([program, *words], capture_output=True, text=True, timeout=900)
    if done.returncode not in (0, 3) or not done.stdout:
        raise RuntimeError(f"{words}: {done.stderr[-300:]}")
    return json.loads(done.stdout)


def main():
    program, names, beyond = os.path.abspath(sys.argv[1]), sys.argv[2:], []
    print("| run | model | effect | bound | greatest | 99 % below | out of range | promise |")
    print("| --- | --- | --- | ---: | ---: | ---: | ---: | --- |")
    for name, case, model, until, settings in RUNS:
        if names and name not in names:
            continue
        monitor = ["chooser.monitor=warn", "chooser.monitor_sample=1", f"chooser.monitor_every={10 if model == 'tfm' else 100}"]
        words = [word for setting in [*monitor, *settings] for word in ("--set", setting)]
        with tempfile.TemporaryDirectory() as folder:
            promise = answer(program, model, str(CASES / case / "case.toml"), "--until", until, "--quiet", "--no-picture", "--json",
                             "-o", folder + "/run", *words)["promise"]
        for seen in promise["observed"]:
            met = seen["encounters"] + seen["out_of_range"]
            kept = "" if seen["effect"] != "sum" else {True: "kept", False: "broken", None: "not to be told"}[promise["kept"]]
            print(f"| {name} | {model} | {seen['effect']} | {seen['bound']:.2g} | {seen['greatest']:.2g} | "
                  f"{seen['percentile_99']:.2g} | {100 * seen['out_of_range'] / met:.3g} % | {kept} |", flush=True)
            # Rounding alone: an attraction is the same for all of a size.
            if seen["greatest"] > seen["bound"] * (1 + 1e-12):
                beyond.append(f"{name}: {seen['effect']}")
    print("beyond the bound: " + ("; ".join(beyond) or "nothing"))
    return 1 if beyond else 0


if __name__ == "__main__":
    sys.exit(main())
