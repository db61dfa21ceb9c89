"""The beds of openfoam_cases as cases of polybed, and its runs."""
import csv
import json
from pathlib import Path

from openfoam_run import run


def text(bed, settings):
    """A case file of the same bed; settings: effects {role: law}, rtol, integrator, until, every, and more tfm keys."""
    share, total = [s["fraction"] for s in bed["solids"]], sum(s["fraction"] for s in bed["solids"])
    size, cells = list(bed["size"]), list(bed["cells"])
    if "layers" in bed:  # the depth is the second axis
        size[1:1], cells[1:1] = [bed["depth"]], [bed["layers"]]
    tables = [("title", '"the same bed as another program\'s"'), ("[column]",), ("size", size), ("cells", cells), ("[fluid]",), ("name", quoted("fluid")),
              ("density", bed["fluid"]["density"]), ("viscosity", bed["fluid"]["viscosity"])]
    for solid in bed["solids"]:
        tables += [("[[species]]",), ("name", quoted(solid["name"])), ("diameter", solid["diameter"]),
                   ("density", solid["density"])]
    settled = bed.get("settled", total)
    tables += [("[bed]",), ("volume_share", [s / total for s in share]), ("solids_fraction", settled),
               ("static_height", bed["height"] * total / settled), ("start_solids_fraction", total),
               ("[inlet]",), ("superficial_velocity", bed["velocity"]), ("[effects]",),
               ("others", quoted("none"))]
    tables += [(role, quoted(law)) for role, law in settings["effects"].items()]
    tables += [("[run]",), ("until", settings["until"]), ("[output]",), ("every", settings["until"]),
               ("history_every", settings["every"]), ("checkpoint_every", settings["until"])]
    tables += [("[dem]",), ("restitution", bed.get("restitution", 0.9)), ("[tfm]",), ("rtol", settings["rtol"]),
               ("integrator", quoted(settings["integrator"]))]
    tables += list(settings.get("tfm", {}).items())
    return "".join(line[0] + "\n" if len(line) == 1 else f"{line[0]} = {line[1]}\n" for line in tables)


def quoted(word):
    return f'"{word}"'


def solve(program, directory, bed, settings, begin, limit):
    """CPU seconds from `begin` to the end, rows of the history, steps, largest relative change of a species' mass.

    The CPU seconds are the kernel's for the process itself. The picture that polybed has Python draw when a run ends,
    0.8 s whatever the run, is left out, as OpenFOAM draws none; cpu_with_picture_s has it in.
    """
    directory = Path(directory)
    directory.mkdir(parents=True)
    case, out = directory / "case.toml", directory / "run"
    case.write_text(text(bed, settings))
    command = [program, "tfm", case, "--quiet", "-o", out]
    if begin:
        run(command + ["--until", f"{begin} s"], directory, directory / "log.before", limit)
        command.append("--resume")
    whole = run(command + ["--until", f"{settings['until']} s"], directory, directory / "log", limit)
    with open(out / "history.csv", newline="") as stream:
        rows = [{key: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(stream)]
    record = json.loads((out / "run.json").read_text())
    masses = {s["name"]: [row[f"mass_{s['name']}_kg"] for row in rows] for s in bed["solids"]}
    drift = {name: max(abs(m / values[0] - 1) for m in values) for name, values in masses.items()}
    kept = ("git_commit", "program", "machine", "integrator", "work", "warnings", "guards")
    return {"cpu_s": record["cpu_s"], "rows": rows, "steps": record["work"]["steps"], "volume_change": drift,
            "record": {key: record[key] for key in kept} | {"cpu_with_picture_s": whole}}
