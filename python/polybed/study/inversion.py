"""The inversion velocity by runs of one model or of both: what `polybed inversion --scan` hands over to.

Its argument is a JSON object: what the command line says, with velocities in m/s. The runs lie in folders called by their velocity and the
hash of their case, so that a scan that is made again finds those that are finished.
"""

import json
import os
import sys
from contextlib import suppress
from pathlib import Path

from polybed.files import contents_of, read_bytes
from polybed.folder import drift_lines, read_record
from polybed.study import inversion_report as report
from polybed.study.cases import Case, hash_of, refuse_without_ends
from polybed.ending import DONE, WRONG_CASE, StudyError, answer, guarded
from polybed.study.inversion_search import Mean, search
from polybed.study.measured import means_of
from polybed.study.output import draw, taken, write_record
from polybed.runner import flags, has_checkpoint, ranks, run, words_of
from polybed.study.stress_uncertainty import moved_table

RAMP_SHARE = 0.02  # of a run, in which the velocity leaves that of the run before: far from the window, the last quarter
SURFACES = ("hamaker_constant", "cohesion_gap", "asperity_radius")  # keys that a choice of cohesion sets
DIGITS = 10  # of a hash in the name of a folder


class RunsOfModel:
    """The runs of a scan by one model."""

    def __init__(self, request, model, name, table, overrides):
        """name: of the scan, and of its folder; table: hash of its table of the solids stress, or empty"""
        self.request, self.model, self.name, self.table, self.overrides = request, model, name, table, overrides
        self.runs, self.velocities, self.integrators = [], [], []

    def scan(self):
        found = search(self.request["from_m_s"], self.request["to_m_s"], self.mean_at)
        return report.ScanOfModel(self.model, found, self.runs)

    def mean_at(self, velocity, source):
        case = Case(self.request["case"], [*self.overrides, *self.start_of(velocity, source)], self.request["until"])
        digest = hash_of((case.text + self.table).encode())
        directory = os.path.join(self.request["directory"], self.name, f"{1e3 * velocity:.3f}mm_s-{digest[:DIGITS]}")
        record = Path(directory) / "run.json"
        reused = record.exists() and read_record(record)["state"] == "done"  # the name of the folder says of which case
        if not reused:
            again = "--resume" if has_checkpoint(directory) else "--force"  # replaces what a killed run has left without a checkpoint
            run(self.model, case.path, *words_of(case.overrides), "-o", directory, again, "--quiet", "--no-picture",
                *flags(self.request, "permissive"))
        made, integrator = measure(directory)
        self.runs.append(made)
        self.velocities.append(velocity)
        self.integrators.append(integrator)
        say(self.request, report.line(self.name, velocity, None if source is None else self.velocities[source], made, reused))
        column = case.keys["column"]
        below_top = column["size"][1] * (1 - 1 / column["cells"][1])
        return Mean(made["centre_difference"], made["error"], made["bed_height_m"] >= below_top)

    def start_of(self, velocity, source):
        """Overrides for the start. A run that continues another begins with its velocity, and keeps its integrator."""
        if source is None:
            return [f"inlet.superficial_velocity={velocity!r}"]
        checkpoint = os.path.join(self.runs[source]["directory"], "checkpoint.h5")
        ramp = [[0.0, self.velocities[source]], [RAMP_SHARE * self.request["until_s"], velocity]]
        start = [f"inlet.superficial_velocity={ramp}", f'bed.start="checkpoint:{checkpoint}"']
        return start + ([f'tfm.integrator="{self.integrators[source]}"'] if self.model == "tfm" else [])


def speaks(request):
    """Whether each run has a line."""
    return not (request["json"] or request["quiet"])


def say(request, line):
    """A line in between: nobody has to read it."""
    if speaks(request):
        with suppress(StudyError):
            answer(line)


def measure(directory):
    """What a finished run has measured, as in inversion.json, and its integrator. The interface is from the mean profile."""
    (begin, end, _), [run], _ = means_of(directory)
    b, height = (run.means.get(name) for name in ("centre_difference", "bed_height_m"))
    if b is None or height is None or b.error is None:
        raise StudyError(WRONG_CASE, f"{directory}: too few rows of its history in the last quarter to tell a mean: a smaller "
                                     "output.history_every gives more")
    interface, top = (run.of_profile.get(name) for name in ("interface_m", "bed_height_m"))
    over_height = interface.mean / top.mean if interface and top and top.mean else None
    path = Path(directory) / "run.json"
    record = read_record(path)
    with contents_of(path):
        run = {"centre_difference": b.mean, "error": b.error, "bed_height_m": height.mean, "bed_height_error_m": height.error, "begin_s": begin,
               "end_s": end, "cpu_s": record["cpu_s"], "directory": directory, "git_commit": record["git_commit"],
               "warnings": drift_lines(record), "interface_over_height": over_height}
        return run, record["integrator"]


def choice_of(keys):
    """Effects chosen for the case, as overrides: the same for every run, though the choice follows from the velocity. keys: of the case"""
    laws, chosen = keys["effects"], keys.get("chooser", {}).get("chosen", [])
    surfaces = SURFACES if "cohesion" in chosen and "cohesion" in laws else ()  # what cohesion was weighed with
    return ([f'effects.{role}="{laws.get(role, "none")}"' for role in chosen]
            + [f"dem.{key}={keys['dem'][key]!r}" for key in surfaces if key in keys["dem"]])


def scan_of(request, table, model):
    """The scan by a model; with the stress uncertainty two more by the two-fluid model, its table moved both ways."""
    digest = hash_of(read_bytes(table)) if table else ""
    scan = RunsOfModel(request, model, model, digest, request["overrides"]).scan()
    if request["stress_uncertainty"] and model == "tfm":
        for name, sigma in (("tfm-minus", -1), ("tfm-plus", 1)):
            overrides = [*request["overrides"], moved_table(table, sigma, os.path.join(request["directory"], f"table-{name}.h5"))]
            scan.moved.append(RunsOfModel(request, model, name, digest, overrides).scan())
    return scan


def record_of(request, case, scans):
    """inversion.json: all that a command line needs to make the same scan again, and what was found."""
    return {"filetype": "polybed inversion", "version": 1, "git_commit": case.git_commit, "case": request["case"],
            "case_hash": case.scan_hash, "directory": request["directory"], "overrides": request["overrides"], "scan": request["scan"],
            "from_m_s": request["from_m_s"], "to_m_s": request["to_m_s"], "until_s": request["until_s"], "ranks": ranks(),
            "species": case.species, "force_balance": request["force_balance"], "beside": request["beside"],
            "models": {scan.model: scan.plain() for scan in scans}, "agreement": report.agreement_of(scans)}


def make(request):
    """Makes the scan that is asked for, and writes inversion.json."""
    directory = Path(request["directory"])
    case = Case(request["case"], request["overrides"], request["until"])
    refuse_without_ends(case.keys, "polybed inversion --scan")
    request["until_s"] = case.keys["run"]["until"]
    request["overrides"] = [*request["overrides"], *choice_of(case.keys)]
    with taken(directory):
        say(request, report.head())
        models = ["tfm", "dem"] if request["scan"] == "both" else [request["scan"]]
        scans = [scan_of(request, case.table, model) for model in models]
        path = directory / "inversion.json"
        text = write_record(path, record_of(request, case, scans))
        answer(text if request["json"] else f"{report.findings(scans, request['force_balance'], request['beside'], case.species)}{path}")
        if request["picture"]:
            draw(path, "picture", not speaks(request))
    return DONE


def main():
    return guarded(lambda: make(json.loads(sys.argv[1])))
