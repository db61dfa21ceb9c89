"""What the standard errors of a table of stresses mean for a bed: what `polybed tfm --stress-uncertainty` hands over to, with what the
command line says as a JSON object. The case is run with its table, and with the table at plus and minus one standard error."""

import json
import os
import sys
from pathlib import Path

from polybed.files import in_place
from polybed.solids_table import read_table
from polybed.study.cases import Case
from polybed.ending import DONE, WRONG_CASE, StudyError, guarded
from polybed.study.measured import means_of
from polybed.study.output import remark, write_record
from polybed.runner import asked, flags, has_checkpoint, run, words_of

MOVED = ("p_ratio", "mu_ratio", "p_bed")  # pressures and viscosities of a table


def moved_table(table, sigma, path):
    """Writes a table whose pressures and viscosities are off by a number of their standard errors, and returns what to set in a case so that
    it is read. Raises StudyError if the table has no errors, or if its pressure would fall with the solids fraction."""
    moved = read_table(table)
    errors = [name for name in MOVED if f"{name}_se" in moved.arrays]
    if not errors:
        raise StudyError(WRONG_CASE, f"{table}: no p_bed_se: nothing tells how uncertain p_bed is")
    for name in errors:
        moved.arrays[name] = moved[name] + sigma * moved[f"{name}_se"]
    with in_place(Path(path)) as written:
        moved.write(written)
        require_rising(table, sigma, written)
    return f'effects.solids_stress="table:{path}"'


def require_rising(table, sigma, moved):
    """Raises StudyError if the pressure of a moved table of sheared boxes falls; the model that reads a bed's pressure looks at that itself."""
    if read_table(moved).attributes["regime"] == "bed":
        return
    falls = asked("table", table=moved)["falls"]
    if falls:
        raise StudyError(WRONG_CASE, f"{table} moved by {sigma:+g} standard errors: its pressure falls {falls[0]}")


def late_means(directory):
    """Means of bed height and centre difference over the window of comparisons, by name; None for what a run lacks."""
    means = means_of(directory).runs[0].means
    return {name: means[name].mean if name in means else None for name in ("bed_height_m", "centre_difference")}


def band(name, unit, minus, table, plus):
    """A band as it is written; said on standard error."""
    low, high = min(minus, table, plus), max(minus, table, plus)
    remark(f"{name}: {table:.5g}{unit}, {low:.5g} to {high:.5g} within one standard error of the table")
    return {"table": table, "minus": minus, "plus": plus, "low": low, "high": high}


def run_case(request, case):
    """The case as it is, which answers for the command."""
    run("tfm", request["case"], *words_of(case.overrides), "-o", request["directory"], *([] if request["picture"] else ["--no-picture"]),
        *flags(request, "resume", "force", "permissive", "quiet", "json"), answers=True)


def run_again(request, case, name, override):
    """The case with one more override, in a folder of the run."""
    output = os.path.join(request["directory"], name)
    again = "--resume" if request["resume"] and has_checkpoint(output) else "--force" if request["force"] else None
    run("tfm", request["case"], *words_of([*case.overrides, override]), "-o", output, "--no-picture", *flags(request, "permissive", "quiet"),
        *([again] if again else []))
    return output


def run_moved(request, case, name, sigma):
    return run_again(request, case, name, moved_table(case.table, sigma, os.path.join(request["directory"], f"table-{name}.h5")))


def make(request):
    directory = request["directory"]
    case = Case(request["case"], request["overrides"], request["until"])
    run_case(request, case)
    means = [late_means(folder) for folder in (run_moved(request, case, "minus", -1), directory, run_moved(request, case, "plus", 1))]
    found = {"filetype": "polybed stress uncertainty", "version": 1, "table": case.table, "standard_errors": 1,
             "window": "last quarter, from where it is stationary"}
    for name, unit in (("bed_height_m", " m"), ("centre_difference", "")):
        values = [of[name] for of in means]
        if None not in values:
            found[name] = band(name, unit, *values)
    write_record(Path(directory) / "stress_uncertainty.json", found)
    return DONE


def main():
    return guarded(lambda: make(json.loads(sys.argv[1])))
