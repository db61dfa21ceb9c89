#!/usr/bin/python3
"""What a particle costs beside ones of another size: half of the solids fine, half coarse, from one size to ten to one.

    size_ratios.py POLYBED [--time]

Counted are the pairs that a search looks at and those that a step checks, per particle; they repeat exactly, and the test fails where
they grow beyond what the coarse ones' larger surface asks for. --time adds CPU time, medians of three runs."""
import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

FINE, MANY = 0.5, 6000  # mm, number
SOLIDS = 0.5
RATIOS = [1, 1.5, 2, 2.5, 3, 4, 6, 10]
# A search in cells of (1.1 d)^3: of one size half of 27 cells with SOLIDS 1.1^3 6/pi spheres in each, 17 candidates. Of two, the fine
# half of that, 9, and of the coarse ones all 27 cells, 17. Cells that have to fill a small box are up to 1.25 wider: 1.95 times 26.
MOST_CANDIDATES = 50
MOST_CHECKS = 1.3  # times those of one size: a coarse sphere has more around it, but is one of few
CASE = """
[column]
size = [{box}e-3, {box}e-3, {box}e-3]
cells = [1, 1, 1]
sides = "periodic"
ends = "periodic"
gravity = 0
[fluid]
name = "none"
[[species]]
name = "fine"
diameter = "{fine} mm"
density = 2500
[[species]]
name = "coarse"
diameter = "{coarse} mm"
density = 2500
[bed]
particles = [{many}, {few}]
start = "random"
solids_fraction = 0.6
[effects]
others = "none"
contact = "hertz_mindlin"
[dem]
youngs_modulus = "100 MPa"
start_speed = "0.1 m/s"
greatest_speed = "1 m/s"
ledger = false
[run]
until = {until}
[output]
every = 10
history_every = 10
"""


def case_of(ratio, until):
    few = round(MANY / ratio**3)
    volume = 3.14159265 / 6 * FINE**3 * (MANY + few * ratio**3)
    return CASE.format(box=(volume / SOLIDS) ** (1 / 3), fine=FINE, coarse=FINE * ratio, many=MANY, few=few, until=until)


def run(polybed, ratio, until):
    """The record of a run."""
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder, "case.toml")
        case.write_text(case_of(ratio, until))
        subprocess.run([polybed, "dem", case, "--quiet", "--no-picture", "-o", f"{folder}/run"], check=True, stdout=subprocess.DEVNULL)
        return json.loads(pathlib.Path(folder, "run/run.json").read_text())


def counts(record):
    """Pairs looked at in a search, pairs checked in a step, per particle; steps between searches."""
    work = record["work"]
    particles = work["particle_steps"] / work["steps"]
    return work["candidates"] / work["rebuilds"] / particles, work["pair_checks"] / work["particle_steps"], work["steps"] / work["rebuilds"]


def nanoseconds(polybed, ratio):
    """CPU time of a particle in a step, medians of long runs less short ones."""
    cost = []
    for _ in range(3):
        short, long = run(polybed, ratio, 0.5e-3), run(polybed, ratio, 10e-3)
        steps = long["work"]["particle_steps"] - short["work"]["particle_steps"]
        cost.append(1e9 * (long["cpu_s"] - short["cpu_s"]) / steps)
    return statistics.median(cost), 100 * (max(cost) - min(cost)) / statistics.median(cost)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("polybed")
    parser.add_argument("--time", action="store_true")
    given = parser.parse_args()
    head = ["ratio", "candidates", "pairs checked", "steps a list"] + (["ns per particle-step", "spread, %"] if given.time else [])
    print("| " + " | ".join(head) + " |\n|" + " ---: |" * len(head))
    problems, base = [], None
    for ratio in RATIOS:
        looked, checked, steps = counts(run(given.polybed, ratio, 0.5e-3))
        base = base or checked
        cells = [f"{ratio:g}", f"{looked:.1f}", f"{checked:.2f}", f"{steps:.0f}"]
        if given.time:
            cells += ["{:.0f}".format(x) for x in nanoseconds(given.polybed, ratio)]
        print("| " + " | ".join(cells) + " |", flush=True)
        if looked > MOST_CANDIDATES:
            problems.append(f"ratio {ratio}: {looked:.1f} candidates per particle, at most {MOST_CANDIDATES}")
        if checked > MOST_CHECKS * base:
            problems.append(f"ratio {ratio}: {checked:.2f} pairs checked per particle and step, {base:.2f} of one size")
    raise SystemExit("\n".join(problems) or 0)


if __name__ == "__main__":
    main()
