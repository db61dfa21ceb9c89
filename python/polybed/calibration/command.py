"""Runs boxes of particles and makes a table of the solids stress: what `polybed calibrate` hands over to."""

import json
import signal
import time
from pathlib import Path

from polybed.ending import DONE, WRONG_CASE, StudyError, answer, guarded, parser_of, whole
from polybed.calibration import fit
from polybed.calibration.boxes import Boxes, Plan, asked_of
from polybed.calibration.text import bed_lines, bed_rows, box_lines, deviation, deviation_lines, points_between, table_toml
from polybed.texts import duration
from polybed.files import in_place, put_text
from polybed.program import name_of
from polybed.runner import Door, ranks
from polybed.solids_table import read_table
from polybed.study.output import remark, subfolder, taken

# Axes of a table.
WORDS = {"phi": "solids fraction", "stokes": "Stokes number of the shear", "e": "restitution", "mu_p": "friction of particles",
         "x2": "volume share of the second species"}


def parsed(arguments):
    parser = parser_of("calibrate", "Runs boxes of particles and makes a table of the solids stress for the two-fluid model.",
                       "case", "--set", "--quiet", "--json")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="directory (default: runs/<case name>-calibrate)")
    parser.add_argument("-j", "--jobs", type=whole(1, 1024), metavar="JOBS", default=1, help="boxes at once (default: 1)")
    only = parser.add_mutually_exclusive_group()
    only.add_argument("--plan", action="store_true", help="which boxes, and how long; nothing is run")
    only.add_argument("--check", metavar="TABLE", help="run a few points that it was not fitted to, and compare")
    parser.add_argument("--bed", metavar="TABLE", help="of fluidised boxes (regime bed): its p_bed is put beside what is sheared")
    options = parser.parse_args(arguments)
    options.output = options.output or Path("runs") / f"{name_of(options.case)}-calibrate"
    options.on_ranks = ranks() > 1
    options.refused = None  # by standard output, which ends no calibration
    return options


def say(options, text):
    """For people: with --json standard output is the object's alone."""
    try:
        (remark if options.json else answer)(text)
    except StudyError as error:
        options.refused = error


def keep(options, name, lines):
    """Lines for people, said and written."""
    say(options, lines.rstrip("\n"))
    put_text(options.output / name, lines, "surrogateescape")


def show_plan(options, plan, boxes):
    case, axes, at_once = plan.case, plan.axes, plan.case["ranks"] if options.on_ranks else options.jobs
    text = f"regime {plan.regime}: {case['reason']}\n"
    for n in case["numbers"]:
        text += (f"  {n['species']}: shear rate {n['shear_rate']:.3g} 1/s in the bed, of voidage {n['voidage']:.3f}; times relaxation time "
                 f"{n['shear_times_relaxation']:.2g}\n    Stokes number of impacts {n['stokes_least']:.2g} to {n['stokes_most']:.2g}, of the "
                 f"shear {n['stokes_of_shear']:.2g}\n")
    if case["binary"] and not plan.pushed:
        text += ("no exchange between the species (beta_12): it is measured in dry boxes alone. Here a push would meet drag towards the flow and films, whose part the "
                 "drag law of the two-fluid model has already\n")
    expected = boxes.expected_left() / at_once
    text += f"{len(boxes.points)} boxes: {min(plan.seeds)} random start{'s' * (min(plan.seeds) > 1)} at each point of\n"
    text += "".join(f"  {WORDS[name] + ':':37} {', '.join(f'{value:.4g}' for value in values)}\n" for name, values in axes.items() if any(values))
    say(options, f"{text}{len(boxes.left())} left to run, about {duration(expected)}, {at_once} at once")
    if options.plan and options.json:
        answer(json.dumps({"regime": plan.regime, "reason": case["reason"], "boxes": len(boxes.points), "left": len(boxes.left()),
                           "expected_s": expected}, ensure_ascii=False))


def check_table(options, door, plan):
    """Runs points between the knots of a table and says how they compare."""
    door.ask("table", table=options.check)  # ends for a file that is no table
    table = read_table(options.check)
    if table.attributes["regime"] != plan.regime:
        raise StudyError(WRONG_CASE, f"{options.check} is a {table.attributes['regime']} table, the boxes of the case are {plan.regime}: "
                                  f"{plan.case['reason']}")
    points = points_between(table, plan.case["binary"])
    boxes = Boxes(door, options, points).run()
    ratios = door.ask("ratios", table=options.check, points=asked_of(points))
    deviations = [deviation(box, read, table.attributes["lambda"]) for box, read in zip(boxes, ratios)]
    keep(options, "check.txt", deviation_lines(points, deviations))


def identify(table, plan):
    """Says in a table which program made it, of which case and when."""
    table.attributes |= {"filetype": "polybed solids table", "version": 1, "git_commit": plan.case["git_commit"],
                         "created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), "case_hash": plan.case["case_hash"]}


def say_table(options, plan, count, tested):
    path = options.output / "table.h5"
    say(options, f"table: {path}")
    if options.json:
        answer(json.dumps({"table": str(path), "regime": plan.regime, "reason": plan.case["reason"], "boxes": count, **tested},
                          ensure_ascii=False))


def finish_bed(options, plan, boxes):
    """Fluidised boxes: p_bed by both measures, and the table of that by slabs."""
    table = fit.bed_table(plan.seeds, boxes, plan.case["weight_m2_s2"])
    keep(options, "boxes.txt", bed_lines(boxes) + "\n" + bed_rows(table))
    fit.require_usable_bed(table)
    identify(table, plan)
    with in_place(options.output / "table.h5") as path:
        table.write(path)
    say_table(options, plan, len(boxes), {"greatest_error": None, "fit_residual": None, "left_out_residual": None})


def tested_by(table, plan):
    """What a fit was tested by: by no scatter where a point has one box, and by no curve where there are too few solids fractions."""
    by_curve = len(table["phi"]) >= fit.LEAST_TO_LEAVE_OUT
    return {"greatest_error": float(max(fit.relative_errors(table))) if min(plan.seeds) > 1 else None,
            "fit_residual": table.attributes["fit_residual"] if by_curve else None,
            "left_out_residual": table.attributes["left_out_residual"] if by_curve else None}


def tested_lines(tested):
    error, residual, left_out = (None if share is None else f"{100 * share:.2f} %" for share in tested.values())
    return ["standard errors not known: one box at each point" if error is None else f"standard errors up to {error}",
            "fit not tested: too few solids fractions to leave one out" if left_out is None else
            f"with a solids fraction left out the fit is {left_out} off, {residual} beyond two standard errors"]


def finish_sheared(options, door, plan, boxes, table):
    """Sheared boxes: what they have measured, and the fitted table if it can be used."""
    if options.bed:
        of_bed = read_table(options.bed)
        table.arrays |= {"phi_bed": of_bed["phi"], "p_bed": of_bed["p_bed"]}
        table.arrays |= {"p_bed_se": of_bed["p_bed_se"]} if "p_bed_se" in of_bed.names() else {}
    keep(options, "boxes.txt", box_lines(boxes))
    tested = tested_by(table, plan)
    say(options, "\n".join(tested_lines(tested)))
    identify(table, plan)
    table.attributes |= {"size_ratio": float(plan.case["size_ratio"]), "units": "ratios to the reference; p_bed over |rho_p - rho_f| g D"}
    fit.require_exchange(table)
    with in_place(options.output / "table.h5") as path:
        table.write(path)
        shape = door.ask("table", table=path)
        if shape["falls_in_shear_up_to"] > 0:
            say(options, f"at fixed shear rate without a fluid the pressure falls up to phi = {shape['falls_in_shear_up_to']:.3f}, as a "
                         "dilute gas does")
        fit.require_usable(table, shape["falls"])
    put_text(options.output / "table.toml", table_toml(table, plan, boxes, shape["a"]), "surrogateescape")
    say_table(options, plan, len(boxes), tested)


def calibrate(options, door):
    plan = Plan(door.ask("case", case=options.case, settings=options.set))
    if options.bed:
        door.ask("bed", table=options.bed)  # ends for a file that is no table
    if options.on_ranks and options.jobs > 1:
        raise StudyError(WRONG_CASE, "-j starts processes of its own: under mpirun the ranks run the boxes, leave it out")
    if options.plan:
        return show_plan(options, plan, Boxes(door, options, plan.boxes()))
    with taken(options.output):
        subfolder(options.output, "boxes")
        return check_table(options, door, plan) if options.check else make_table(options, door, plan)


def make_table(options, door, plan):
    boxes = Boxes(door, options, plan.boxes())
    show_plan(options, plan, boxes)
    results = boxes.run()
    if plan.regime == "bed":
        return finish_bed(options, plan, results)
    table = fit.fitted(plan, results)
    while fit.add_seeds(plan, table):
        results = Boxes(door, options, plan.boxes()).run()
        table = fit.fitted(plan, results)
    return finish_sheared(options, door, plan, results, table)


def main(arguments=None):
    options = parsed(arguments)
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.default_int_handler)

    def work():
        with Door(ranks()) as door:
            calibrate(options, door)
        if options.refused:
            raise options.refused
        return DONE
    return guarded(work, "stopped by the user; boxes that are finished are kept, the same command goes on")
