#!/usr/bin/python3
"""What either integrator takes for beds of all kinds, and which one `tfm.integrator = "auto"` chooses.

    tests/cost/integrators.py PROGRAM [--only WORD] [--repeat 1] [--json FILE]

Short runs on small grids, at rtol 1e-3 but where another is named, each by both integrators: liquid and gas, coarse and fine,
packed, settling, with jets, compressible, some near where the choice changes over; two CPU minutes. The counters repeat exactly,
the seconds are medians of --repeat runs. *Replaced*: explicit steps that an implicit one is expected to replace, what auto goes
by in liquids. A run that has not ended after LIMIT CPU seconds is stopped and told. A choice is called wrong where the other
integrator takes less than 1/1.25 of its time: a tenth is how far times of one run differ. Exit code 1: a choice costs more than
WORST times the other, or a run that auto takes did not end.
"""
import argparse
import json
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

CASES = Path(__file__).resolve().parents[2] / "cases"
LIMIT = 60  # CPU s of one run
WRONG = 1.25
WORST = 2.8  # 1.25 times the worst choice of docs/record/cost.md
COUNTERS = ("steps", "rejected_steps", "rhs_evaluations", "linear_iterations")
WATER, AIR = (998.2, 1.002e-3), (1.204, 1.813e-5)  # kg/m3, Pa s, 20 degC
SYSTEM_B = [(0.807, 1395, 0.569), (2.01, 1170, 0.431)]  # mm, kg/m3, share
FRICTION = {"drag": "cello", "solids_stress": "frictional", "species_exchange": "syamlal"}
GAS = {"drag": "gidaspow", "solids_stress": "frictional"}
KINETIC = {"drag": "gidaspow", "solids_stress": "kinetic", "granular_temperature": "algebraic", "solids_viscosity": "schaeffer"}


def glass(diameter, density=2500):
    return [(diameter, density, 1)]


def bed(until, width, height, cells, fluid, solids, static, start, velocity, effects=None, more="", equation="incompressible",
        packed=0.60, rtol=1e-3):
    """A case file. Lengths in mm, velocity in m/s, until in s; `more`: tables that follow."""
    species = "".join(f'[[species]]\nname = "s{n}"\ndiameter = "{d} mm"\ndensity = {rho}\n' for n, (d, rho, _) in enumerate(solids))
    roles = "".join(f'{role} = "{law}"\n' for role, law in (effects or FRICTION).items() if len(solids) > 1 or role != "species_exchange")
    return f"""[column]
size = ["{width} mm", "{height} mm"]
cells = [{cells[0]}, {cells[1]}]
[fluid]
name = "fluid"
density = {fluid[0]}
viscosity = {fluid[1]}
temperature = "20 degC"
equation_of_state = "{equation}"
{species}[bed]
volume_share = {[share for _, _, share in solids]}
static_height = "{static} mm"
solids_fraction = {packed}
start_solids_fraction = {start}
[inlet]
superficial_velocity = {velocity}
[effects]
others = "none"
{roles}[run]
until = {until}
[output]
every = {until}
history_every = {until}
checkpoint_every = {until}
[tfm]
rtol = {rtol}
{more}"""


def shipped(name, until):
    """A case that is shipped, cut to a time, s."""
    return re.sub(r"(?m)^until *=.*$", f"until = {until}", (CASES / name / "case.toml").read_text())


def in_water(until, solids, velocity, rtol=1e-3, scale=1):
    """A bed in water on 10 x 80 square cells of 2 mm times a scale."""
    width, height, static = 20 * scale, 160 * scale, 50 * scale
    return bed(until, width, height, (10, 80), WATER, solids, static, 0.45, velocity, rtol=rtol)


def jet(start, end, velocity):
    return f'[[jet]]\nfrom = ["{start} mm"]\nto = ["{end} mm"]\nsuperficial_velocity = {velocity}\n'


BEDS = {
    "two sizes (system B), expanded": bed(10, 60, 620, (9, 99), WATER, SYSTEM_B, 66, 0.2, 0.03, packed=0.62),
    "the same, rtol 1e-4": bed(10, 60, 620, (9, 99), WATER, SYSTEM_B, 66, 0.2, 0.03, packed=0.62, rtol=1e-4),
    "the same, 18 x 198 cells": bed(4, 60, 620, (18, 198), WATER, SYSTEM_B, 66, 0.2, 0.03, packed=0.62),
    "the same, 6 x 62 cells": bed(10, 60, 620, (6, 62), WATER, SYSTEM_B, 66, 0.2, 0.03, packed=0.62),
    "the same, packed start": bed(1.5, 60, 620, (9, 99), WATER, SYSTEM_B, 66, 0.62, 0.03, packed=0.62),
    "the same, below u_mf": bed(1, 60, 310, (9, 50), WATER, SYSTEM_B, 66, 0.60, 0.003, packed=0.62),
    "the same, jet": bed(2, 60, 300, (18, 60), WATER, SYSTEM_B, 66, 0.5, 0.015, more=jet(20, 40, 0.12), packed=0.62),
    "glass 0.8 mm in water": in_water(5, glass(0.8), 0.03),
    "0.8 mm, cells of 4 mm": in_water(5, glass(0.8), 0.03, scale=2),
    "0.5 mm": in_water(4, glass(0.5), 0.018),
    "0.4 and 0.6 mm": in_water(4, [(0.4, 2500, 0.5), (0.6, 2500, 0.5)], 0.018),
    "0.4 mm": in_water(4, glass(0.4), 0.015),
    "0.4 mm, rtol 1e-4": in_water(2, glass(0.4), 0.015, rtol=1e-4),
    "0.3 mm": in_water(3, glass(0.3), 0.01),
    "0.3 mm, rtol 1e-4": in_water(3, glass(0.3), 0.01, rtol=1e-4),
    "0.1 mm": in_water(1, glass(0.1), 0.002),
    "2 mm in a viscous liquid": bed(1, 40, 320, (10, 80), (1200, 0.1), glass(2), 100, 0.45, 0.01),
    "thesis-c": shipped("thesis-c", 1.5),
    "small-binary": shipped("small-binary", 5),
    "classifier": shipped("classifier", 3),
    "two sizes settling": bed(5, 60, 620, (9, 99), WATER, SYSTEM_B, 66, 0.2, 0, packed=0.62),
    "0.4 mm settling": bed(5, 20, 160, (10, 80), WATER, glass(0.4), 50, 0.2, 0),
    "gas, bubbling, 1.5 mm": bed(0.4, 90, 300, (9, 30), AIR, glass(1.545, 1150), 78.5, 0.55, 0.9, KINETIC),
    "gas, bubbling, 0.275 mm": bed(0.2, 280, 1000, (14, 50), AIR, glass(0.275), 400, 0.55, 0.38, KINETIC),
    "gas, packed start, ten times u_mf": bed(0.08, 32, 160, (8, 40), AIR, glass(0.5), 50, 0.58, 2.1, GAS),
    "gas, jet": bed(0.15, 32, 160, (8, 40), AIR, glass(0.5), 50, 0.58, 0.2, GAS, more=jet(12, 20, 4.2)),
    "compressible gas": bed(0.06, 30, 120, (12, 48), AIR, glass(0.5), 50, 0.55, 0.5, GAS, equation="ideal_gas"),
    "compressible liquid": bed(0.02, 30, 100, (6, 20), WATER, SYSTEM_B, 40, 0.55, 0.03, equation="tait", packed=0.62),
}


def stop_at_limit():
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 5))


def solve(program, case, integrator):
    """The record of the run; None if it did not end within the limit."""
    with tempfile.TemporaryDirectory() as directory:
        path, out = Path(directory) / "case.toml", Path(directory) / "run"
        path.write_text(case)
        command = [program, "tfm", path, "--quiet", "--no-picture", "-o", out, "--set", f"tfm.integrator={integrator}"]
        ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, preexec_fn=stop_at_limit)
        if ended.returncode < 0 or ended.returncode >= 128:
            return None
        if ended.returncode != 0:
            raise RuntimeError(f"{integrator}: {ended.stderr[-500:]}")
        return json.loads((out / "run.json").read_text())


def checked(program, case, integrator):
    """What `polybed check` says of the case."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory) / "case.toml"
        path.write_text(case)
        command = [program, "check", path, "--json", "--set", f"tfm.integrator={integrator}"]
        ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True)
        return json.loads(ended.stdout)


def measure(program, case, repeat):
    step = {which: checked(program, case, which)["dt_limits"]["expanded"]["expected_step_s"] for which in ("explicit", "implicit")}
    found = {"auto": checked(program, case, "auto")["integrator"], "replaced": step["implicit"] / step["explicit"]}
    for integrator in ("explicit", "implicit"):
        records = [solve(program, case, integrator) for _ in range(repeat)]
        found[integrator] = None if None in records else {
            "cpu_s": statistics.median(r["cpu_s"] for r in records), **{name: records[0]["work"][name] for name in COUNTERS},
            "git_commit": records[0]["git_commit"]}
    return found


def row(name, until, found):
    cells = [name, until, f"{found['replaced']:.1f}"]
    for integrator in ("explicit", "implicit"):
        one = found[integrator]
        cells += [f"above {LIMIT}", "-", "-", "-"] if one is None else [
            f"{one['cpu_s']:.2f}", f"{one['steps']} ({one['rejected_steps']})", str(one["rhs_evaluations"]), str(one["linear_iterations"])]
    other = "implicit" if found["auto"] == "explicit" else "explicit"
    taken, left = (found[which] and found[which]["cpu_s"] for which in (found["auto"], other))
    factor = float("inf") if taken is None else 0 if left is None else taken / left
    verdict = f"**wrong**, {factor:.1f} times" if factor > WRONG else "right" if factor < 1 / WRONG else "either"
    return "| " + " | ".join([*cells, found["auto"], verdict]) + " |", factor


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--only", default="", help="beds whose names have this in them")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--json", help="file for the figures")
    arguments = parser.parse_args()
    print("| bed | s | replaced | explicit: CPU s | steps (rejected) | right-hand sides | pressure iterations | implicit: CPU s | steps (rejected) "
          "| right-hand sides | Krylov iterations | auto | choice |")
    print("| --- | ---: |" + " ---: |" * 9 + " --- | --- |")
    results, factors = {}, []
    for name, case in BEDS.items():
        if arguments.only not in name:
            continue
        results[name] = measure(arguments.program, case, arguments.repeat)
        until = case.split("until = ")[1].split("\n")[0]
        line, factor = row(name, until, results[name])
        factors.append(factor)
        print(line, flush=True)
    print(f"right or either: {sum(factor <= WRONG for factor in factors)} of {len(factors)}; the worst {max(factors, default=0):.1f} times")
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(results, indent=1))
    return 1 if max(factors, default=0) > WORST else 0


if __name__ == "__main__":
    sys.exit(main())
