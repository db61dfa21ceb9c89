"""The command line of polybed fit, and what it writes: law.json, fit.json, accuracy.md, errors.csv and fit.png."""

import json
import time
from pathlib import Path

import numpy as np

from polybed.ending import DONE, NUMBERS, WRONG_CASE, StudyError, answer, guarded, parser_of, whole
from polybed.fit import errors
from polybed.fit.fitting import Problem
from polybed.fit.errors import COLUMNS, page, write_errors
from polybed.fit.rows import read_points
from polybed.runner import answer_of
from polybed.study.output import draw, remark, taken, write_record
from polybed.study.cases import laws_of
from polybed.texts import text_table

INTERVAL = (2.5, 97.5)  # per cent of the draws
LARGE_ERROR = 10  # per cent, mean of a fit: several times what the forms have on resolved flow
UNCHANGED = 1e-6  # of the force on a row, by constants that are all moved
FORM_OFF = 1e-9  # of the force, between this package and the program: rounding


def parser():
    options = parser_of("fit", "Fits the constants of a drag law to rows of resolved flow, and writes a law file.", "--quiet", "--json", "--no-picture")
    options.add_argument("rows", nargs="+", metavar="ROWS", type=Path,
                         help="tables of polybed resolve or of tests/data/lbm; of a folder its tab_A_*.csv or rows.csv")
    options.add_argument("--form", choices=("cello", "brinkman_oseen"), default="brinkman_oseen")
    options.add_argument("-o", "--output", metavar="DIR", type=Path, help="folder; default runs/<name of the rows>-fit")
    options.add_argument("--bootstrap", type=whole(0, 10000), default=100, metavar="N", help="draws for the intervals (default: 100)")
    options.add_argument("--seed", type=whole(0, 2**63 - 1), default=1, help="of the draws")
    options.add_argument("--force", action="store_true", help="replace a fit that is in the folder")
    return options


def interval_of(problem, drawn):
    """95 % intervals of the constants, by name; empty without draws."""
    if not len(drawn):
        return {}
    low, high = np.percentile(drawn, INTERVAL, axis=0)
    below, above = problem.constants(low), problem.constants(high)
    return {name: [below[name], above[name]] for name in problem.free}


def band_of_draws(problem, drawn):
    """Greatest standard deviation of the force on any row that comes of the uncertainty of the constants; None without draws."""
    if not len(drawn):
        return None
    logs = np.log1p(np.array([problem.relative(problem.constants(d)) for d in drawn]))
    return float(np.nanmax(np.nanstd(logs[:, problem.known], axis=0)))


def write_law(path, form, constants, **members):
    text = {"filetype": "polybed drag law", "version": 1, "form": form, "constants": constants} | members
    path.write_text(json.dumps(text, indent=1, allow_nan=False) + "\n", encoding="utf-8")


def range_of(points):
    """Of voidage and Reynolds number in the rows: what the program takes as the range of the law."""
    return {name: [float(min(values)), float(max(values))]
            for name, values in (("voidage", [p.voidage for p in points]), ("reynolds", [p.reynolds for p in points]))}


def partition_bands(points, law):
    """The band of the law with each partition, on points with more than one size; empty without any."""
    mixtures = [p for p in points if len(p.net) > 1]
    one_size = errors.band_of(points, errors.net_by_program(points, law))["one_size"]
    return {partition: errors.band_of(mixtures, errors.net_by_program(mixtures, law, partition)) | {"one_size": one_size}
            for partition in (laws_of("partition") if mixtures else ())}


def by_source(points, arrays):
    """Summaries of arrays of errors, by the file of the points, and of all."""
    source = np.concatenate([[p.source] * len(p.net) for p in points])
    names = list(dict.fromkeys(p.source for p in points))
    parts = {name: source == name for name in names} | {"all": np.full(len(source), True)}
    return {name: {what: None if values is None else errors.summary(values[of]) for what, values in arrays.items()}
            for name, of in parts.items()}


def poor_fit(problem, found, own, mean):
    """Warnings of a fit whose errors are large, and of rows that no constant changes. own: relative errors by the fit; mean: of their
    absolute values, per cent"""
    if not mean > LARGE_ERROR:
        return []
    lines = [f"the fit is off by {mean:.0f} % in the mean: the form {problem.form} does not follow these rows"]
    moved = [problem.relative(problem.constants(found + 0.1 * unit)) for unit in np.eye(len(found))]
    fixed = problem.known & (np.max(np.abs(np.array(moved) - own), axis=0) < UNCHANGED)
    if fixed.any():
        at_rest = " at Re 0" if (problem.sizes.reynolds[fixed] == 0).all() else ""
        lines.append(f"{fixed.sum()} of {problem.known.sum()} forces{at_rest} are the same with any constants of {problem.form}, which are not "
                     f"fitted to them: off by up to {100 * np.abs(own[fixed]).max():.0f} %; see errors.csv, and --form")
    return lines


def fit(given, folder):
    points = read_points(given.rows)
    problem = Problem(given.form, answer_of("list")["drag_forms"][given.form], points)
    if problem.known.sum() <= len(problem.free):
        raise StudyError(WRONG_CASE, f"{problem.known.sum()} forces cannot determine {len(problem.free)} constants: give more rows")
    if not given.quiet:
        remark(f"{len(points)} points, {problem.known.sum()} forces, {len(problem.free)} constants of {given.form}")
    found = problem.fit()
    constants = problem.constants(found)
    drawn = problem.bootstrap(found, given.bootstrap, given.seed)
    law, by_law = folder / "law.json", f"file:{folder / 'law.json'}"
    write_law(law, given.form, constants)
    nets = errors.net_by_program(points, by_law)
    by_program, by_published = errors.relative(points, nets), errors.relative(points, errors.net_by_program(points, given.form))
    own = problem.relative(constants)
    off = np.nanmax(np.abs((1 + own) / (1 + by_program) - 1))
    if off > FORM_OFF:
        remark(f"on some rows the guard of {given.form} answers: up to {100 * off:.2g} % from the form that was fitted")
    arrays = {"published": by_published, "fitted": by_program, "row_left_out": problem.left_out_by_row(found),
              "voidage_left_out": problem.left_out_by_voidage(found)}
    broken = float(np.abs(problem.violations(constants)).max())
    summaries, band = by_source(points, arrays), errors.band_of(points, nets)
    for line in poor_fit(problem, found, own, summaries["all"]["fitted"]["mean"]):
        remark(f"warning: {line}")
    about = {"rows": [str(path) for path in given.rows], "points": len(points), "forces": int(problem.known.sum()),
             "form": given.form, "free": problem.free, "bootstrap": given.bootstrap, "seed": given.seed,
             "created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())}
    record = {"filetype": "polybed drag fit", "version": 1, **about, "law": str(law), "constants": constants,
              "published": problem.published, "interval": interval_of(problem, drawn), "errors": summaries, "band": band,
              "from_constants": band_of_draws(problem, drawn), "guard_answers_by": float(off),
              "constraints": {"greatest_violation": broken, "sum_rule": sum_rule(points, nets)}}
    write_law(law, given.form, constants, range=range_of(points), band=band, partition_bands=partition_bands(points, by_law), fit=about)
    (folder / "accuracy.md").write_text(page(record), encoding="utf-8")
    write_errors(folder / "errors.csv", points, arrays)
    return record


def sum_rule(points, nets):
    """Greatest departure of sum x_j n_j/y_j^2 from the law's mean, f_mean/eps: rounding, as both forms keep it. None without mixtures."""
    worst = None
    for p, net in zip(points, nets):
        if len(net) < 2:
            continue
        mean = (p.share * net / p.y**2).sum()  # = f_mean (1 + phi/eps) where the rule is kept: n_j = f_j + phi y^2 f_mean/eps
        pure = net - (1 - p.voidage) * p.y**2 * mean
        worst = max(worst or 0.0, abs((p.share * pure / p.y**2).sum() / (p.voidage * mean) - 1))
    return worst


def told(record):
    every = record["errors"]["all"]
    rows = [[name, f"{every[what]['mean']:.2f}", f"{every[what]['rms']:.2f}", f"{every[what]['greatest']:.1f}"]
            for what, name in COLUMNS if every[what]]
    band = ", ".join(f"{name} {100 * value:.1f} %" for name, value in record["band"].items() if value is not None)
    return "\n".join([text_table([f"% of {every['fitted']['points']} forces", "mean", "rms", "greatest"], rows), f"band: {band}",
                      f"{record['law']}: use it as drag = \"file:{record['law']}\""])


def make(given):
    name = given.rows[0].stem if len(given.rows) == 1 else given.rows[0].parent.name or "rows"
    folder = given.output or Path("runs") / f"{name}-fit"
    if (folder / "fit.json").exists() and not given.force:
        raise StudyError(WRONG_CASE, f"{folder} holds a fit already: --force replaces it, -o names another folder")
    with taken(folder):
        record = fit(given, folder)
        text = write_record(folder / "fit.json", record)
    if given.picture:
        draw(folder / "fit.json", "fit.png", given.quiet or given.json)
    answer(text if given.json else told(record))
    worst = record["constraints"]["greatest_violation"]
    if worst > 0.01:
        remark(f"the fitted law breaks a constraint by {100 * worst:.2g} %: see accuracy.md")
        return NUMBERS
    return DONE


def main(arguments=None):
    given = parser().parse_args(arguments)
    return guarded(lambda: make(given))

