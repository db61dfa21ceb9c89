#!/usr/bin/python3
"""E6 of the specification of effects: what is chosen against all that there is. Usage: effects_auto.py PROGRAM [SCENE]

Six short scenes of particles, each by its choice and with every effect on that has a law in the model and acts in the scene.
Bed height, centres (over the bed height) and pressure drop, means over the second half, may differ by twice the promise of 0.02:
the height amplifies force. They are transients from a loosened bed, so that the choice counts what goes with acceleration, too.
Each is run from three placements, the same ones by both: the mean difference has a 95 % interval, that of bubbling beds is wide.
Code 1 where a mean difference is greater; what the interval leaves open is told.
"""
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
ALLOWED = 2 * 0.02  # of the specification
PLACEMENTS = (1, 2, 3)
STUDENT = 4.303  # of 95 % with two degrees of freedom
# The laws of forces that the promise sums, and what the choice may leave out beside.
ALL_ON = {"lift": "saffman_mei", "magnus": "rubinow_keller", "history": "basset", "added_mass": "zuber",
          "brownian": "langevin", "fluid_stress": "newtonian", "lubrication": "wet_restitution",
          "cohesion": "van_der_waals"}
# Those of chooser's own surfaces, in a liquid and in a gas; asperities of 0.1 um.
SURFACES = {"liquid": 1e-20, "gas": 1e-19}

BED = """title = "{title}"
[column]
size = ["{width} mm", "{height} mm"]
depth = "{depth} mm"
cells = [{across}, {up}]
[fluid]
name = "liquid"
density = {fluid_density}
viscosity = {viscosity}
temperature = "20 degC"
{species}[bed]
particles = {particles}
solids_fraction = 0.6
start = "mixed"
start_solids_fraction = {start}
[inlet]
superficial_velocity = "{velocity} mm/s"
[chooser]
purpose = "transient"
[dem]
youngs_modulus = "{modulus} MPa"
friction = 0.3
restitution = 0.9
greatest_speed = "{speed} m/s"
fluid_every = 16
skin = "{skin} mm"
[run]
until = "{until} s"
[output]
every = "{until} s"
history_every = "{row} s"
"""
SPECIES = '[[species]]\nname = "{}"\ndiameter = "{} mm"\ndensity = {}\n'


def bed(fluid, species, particles, **numbers):
    """A strip two of the largest deep and eight wide, on cells of two diameters, thrice as high as the bed at its start."""
    largest = max(diameter for diameter, _ in species)
    skin = 0.02 * min(diameter for diameter, _ in species)
    width, depth, start = 8 * largest, 2.02 * largest + 2 * skin, 0.5
    solids = math.pi / 6 * sum(count * diameter**3 for count, (diameter, _) in zip(particles, species))
    up = math.ceil(3 * solids / (start * width * depth) / (2 * largest))
    numbers = {"width": width, "depth": depth, "height": 2 * largest * up, "across": 4, "up": up, "skin": skin,
               "row": numbers["until"] / 200, "start": start, **numbers}
    names = "".join(SPECIES.format(name, *one) for name, one in zip(("fine", "coarse"), species))
    return BED.format(species=names, particles=particles, fluid_density=fluid[0], viscosity=fluid[1], **numbers)


SCENES = {
    "A": ("liquid", bed((1070, 0.14), [(0.645, 3950), (1.079, 2910)], [500, 105], title="system A", velocity=1.8, modulus=0.2,
                        speed=0.02, until=0.3)),
    "B": ("liquid", bed((999.19, 1.14e-3), [(0.807, 1395), (2.01, 1170)], [800, 38], title="system B", velocity=30,
                        modulus=0.05, speed=0.1, until=0.3)),
    "C": ("liquid", bed((996.59, 0.85e-3), [(0.214, 2450), (0.776, 1500)], [1600, 31], title="system C", velocity=12.5,
                        modulus=0.05, speed=0.06, until=0.1)),
    "glass in air": ("gas", bed((1.2, 1.8e-5), [(0.5, 2500)], [600], title="glass in air", velocity=300, modulus=0.5,
                                speed=1, until=0.2)),
    "catalyst in air": ("gas", bed((1.2, 1.8e-5), [(0.06, 1500)], [600], title="catalyst in air", velocity=10, modulus=0.02,
                                   speed=0.1, until=0.01)),
    "beads in water": ("liquid", bed((998.2, 1.0016e-3), [(1, 2500)], [600], title="beads in water", velocity=40,
                                     modulus=0.1, speed=0.2, until=0.3)),
}


def run(program, case, folder, settings):
    words = [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run([program, "dem", case, "--quiet", "--no-picture", "--json", "-o", folder, *words],
                          capture_output=True, text=True, timeout=900)
    if done.returncode != 0:
        raise RuntimeError(f"{folder}: {done.stderr[-400:]}")
    record = json.loads(done.stdout)
    with open(folder + "/history.csv") as file:
        rows = list(csv.DictReader(file))
    rows = rows[len(rows) // 2:]
    mean = lambda name: sum(float(row[name]) for row in rows) / len(rows)  # noqa: E731
    names = [name for name in rows[0] if name == "bed_height_m" or name.startswith("centre_")]
    found = {name[:-2]: mean(name) for name in names}
    found["pressure_drop"] = mean("pressure_drop_Pa") / mean("buoyant_weight_Pa")
    return record, found


def both(program, fluid, text, folder):
    """Roles of the choice, CPU seconds by it and by all, and per quantity the differences over the bed height."""
    case, roles, cpu, apart = folder + "/case.toml", {}, [0, 0], {}
    for seed in PLACEMENTS:
        placed = [f"bed.seed={seed}"]
        pathlib.Path(case).write_text('effects = "auto"\n' + text)
        record, chosen = run(program, case, f"{folder}/auto-{seed}", placed)
        lines = record["case"].split("[effects]")[1].split("\n[")[0].strip().splitlines()
        roles = {role: law.strip('"') for role, law in (line.split(" = ") for line in lines)}
        given = {**roles, **ALL_ON, "added_mass": roles.get("added_mass", ALL_ON["added_mass"])}
        pathlib.Path(case).write_text(text + "[effects]\n" + "".join(f'{role} = "{law}"\n' for role, law in given.items()))
        surfaces = [f"dem.hamaker_constant={SURFACES[fluid]}", 'dem.cohesion_gap="0.4 nm"', 'dem.asperity_radius="0.05 um"']
        full, everything = run(program, case, f"{folder}/all-{seed}", placed + surfaces)
        cpu = [cpu[0] + record["cpu_s"], cpu[1] + full["cpu_s"]]
        for key, value in chosen.items():
            scale = 1 if key == "pressure_drop" else everything["bed_height"]
            apart.setdefault(key, []).append((value - everything[key]) / scale)
    return roles, cpu, apart


def main():
    program, wanted, beyond, unsure = os.path.abspath(sys.argv[1]), sys.argv[2:], [], []
    print("| scene | chosen beside drag and contact | furthest apart | by, with its interval | CPU s, chosen, all | others |")
    print("| --- | --- | --- | ---: | ---: | --- |")
    for name, (fluid, text) in SCENES.items():
        if wanted and name not in wanted:
            continue
        with tempfile.TemporaryDirectory() as folder:
            roles, cpu, apart = both(program, fluid, text, folder)
        mean = {key: abs(statistics.mean(values)) for key, values in apart.items()}
        chance = {key: STUDENT * statistics.stdev(values) / math.sqrt(len(values)) for key, values in apart.items()}
        worst = max(mean, key=mean.get)
        beside = ", ".join(sorted(set(roles) - {"drag", "contact", "solids_stress", "granular_temperature"}))
        others = ", ".join(f"{key} {value:.2g} +- {chance[key]:.2g}" for key, value in mean.items() if key != worst)
        print(f"| {name} | {beside} | {worst} | {mean[worst]:.2g} +- {chance[worst]:.2g} | {cpu[0]:.2g}, {cpu[1]:.2g} | {others} |",
              flush=True)
        if not mean[worst] <= ALLOWED:
            beyond.append(f"{name}: {worst}")
        elif max(mean[key] + chance[key] for key in mean) > ALLOWED:
            unsure.append(name)
    print(f"differ by more than {ALLOWED}: " + ("; ".join(beyond) or "none"))
    print("chance leaves it open: " + (", ".join(unsure) or "none"))
    return 1 if beyond else 0


if __name__ == "__main__":
    sys.exit(main())
