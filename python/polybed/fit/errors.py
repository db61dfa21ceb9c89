"""Errors of laws on points, as the program evaluates them, the band that follows, and the page and the table that say them."""

import csv

import numpy as np

from polybed.runner import asked
from polybed.texts import markdown_table, percent

FINE = 0.5  # y below which a size is fine: ratios with it are less certain


def net_by_program(points, law, partition="none"):
    """n_j of every size of every point by the program; law: of the menu or "file:LAW.json"."""
    found = [None] * len(points)
    for mixed in (False, True):
        of = [n for n, p in enumerate(points) if (len(p.share) > 1) == mixed]
        sizes = [[float(value) for pair in zip(points[n].share, points[n].diameter) for value in pair] if mixed else [] for n in of]
        answers = asked("drag", law=law, partition=partition if mixed else "none",
                        points=[[float(points[n].voidage), float(points[n].reynolds), *own] for n, own in zip(of, sizes)]) if of else []
        for n, answer in zip(of, answers):
            found[n] = np.array([answer[f"n_{j + 1}"] for j in range(len(points[n].share))] if mixed else [answer["n"]])
    return found


def relative(points, nets):
    """Relative errors of all sizes of all points, one array."""
    return np.concatenate([net / p.net - 1 for p, net in zip(points, nets)])


def summary(errors):
    """Mean of the absolute errors, root mean square and greatest, in per cent; None without any."""
    errors = 100 * np.abs(errors[np.isfinite(errors)])
    if not len(errors):
        return None
    return {"mean": float(errors.mean()), "rms": float(np.sqrt((errors**2).mean())), "greatest": float(errors.max()), "points": len(errors)}


def rms(values):
    values = np.array(values, float)
    return float(np.sqrt((values**2).mean())) if len(values) else None


def band_of(points, nets):
    """What a result has to allow for, as root mean squares of ln(n/data): of one size; of the factor that all sizes of a packing have in
    common; of the ratio of two neighbouring sizes in a packing, apart where one of them is fine. None without such points."""
    one, common, ratio, fine = [], [], [], []
    for p, net in zip(points, nets):
        with np.errstate(divide="ignore"):  # ln 0, of a law that is 0 at voidage 1
            error = np.log(net / p.net)
        if len(error) == 1:
            one.append(error[0])
            continue
        if not np.isfinite(error).all():
            continue
        common.append(error.mean())
        order = np.argsort(p.y)
        if len(order) <= 4:
            for a, b in zip(order[:-1], order[1:]):
                (fine if p.y[a] < FINE else ratio).append(error[a] - error[b])
    return {"one_size": rms(one), "common": rms(common), "ratio": rms(ratio), "ratio_fine": rms(fine)}


COLUMNS = (("published", "published constants"), ("fitted", "fitted"), ("row_left_out", "row left out"),
           ("voidage_left_out", "voidages left out"))


def cell(found):
    return "-" if found is None else f"{found['mean']:.2f} / {found['rms']:.2f} / {found['greatest']:.1f}"


def error_table(record):
    return markdown_table(["rows", *(name for _, name in COLUMNS), "forces"],
                          [[source, *(cell(found[what]) for what, _ in COLUMNS), found["fitted"]["points"] if found["fitted"] else 0]
                           for source, found in record["errors"].items()])


def constant_table(record):
    def interval(name):
        between = record["interval"].get(name)
        return f"{between[0]:.4g} to {between[1]:.4g}" if between else "kept" if name not in record["free"] else "-"
    return markdown_table(["constant", "published", "fitted", "95 % interval"],
                          [[f"`{name}`", f"{record['published'][name]:.5g}", f"{value:.5g}", interval(name)]
                           for name, value in record["constants"].items()])


def band_table(record):
    names = (("one_size", "n of one size"), ("common", "n, the factor that all sizes of a packing have in common"),
             ("ratio", "ratio of two sizes"), ("ratio_fine", "ratio of two sizes, the finer below half the Sauter diameter"))
    return markdown_table(["quantity", "band (rms)"], [[text, percent(record["band"][name], none="-")] for name, text in names])


def sum_rule_line(worst):
    if worst is None:
        return "- Sum rule: an identity of the form; the rows have no mixtures."
    return f"- Sum rule: an identity of the form; on the rows it is off by {worst:.1g} at most."


def page(record):
    constraints = record["constraints"]
    return "\n".join([
        f"# Drag law of the form `{record['form']}`, fitted to {record['points']} points", "",
        f"Rows: {', '.join(record['rows'])}. Made by `polybed fit`, {record['created']}.", "",
        "## Errors", "",
        "Mean of absolute values / root mean square / greatest relative error of n_j in %, evaluated by `polybed drag` with the law file.",
        "Row left out: by a fit without the point (to first order). Voidages left out: by six fits, each without a sixth of the voidages.",
        "", error_table(record), "",
        "## Constants", "",
        f"Intervals by {record['bootstrap']} fits to rows drawn anew from each file. Constants that these rows do not determine are kept.",
        "", constant_table(record), "",
        f"From the constants alone the force on a row is uncertain by at most {percent(record['from_constants'], none='-')} "
        "(one standard deviation).",
        "", "## Constraints", "",
        "- f = 1 at voidage 1 and Re 0: an identity of the form.",
        "- f at least 1, never falling with Re or with the solids, voidage 0.35 to 1, Re 0 to 1050: greatest departure "
        f"{percent(constraints['greatest_violation'])} between neighbouring points of a grid.",
        sum_rule_line(constraints["sum_rule"]),
        f"- The guard answers on rows by up to {percent(record['guard_answers_by'])} other than the fitted form.", "",
        "## Band to state with a result", "", band_table(record), "",
        "`--closure-uncertainty` of `polybed inversion` and `polybed tfm` takes it from the law file.", ""])


def write_errors(path, points, arrays):
    with open(path, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["row", "eps", "Re", "size", "y", "n", *(name for name in arrays if arrays[name] is not None)])
        at = 0
        for p in points:
            for j in range(len(p.net)):
                values = [f"{values[at]:.6g}" if np.isfinite(values[at]) else "" for values in arrays.values() if values is not None]
                rows.writerow([p.where, p.voidage, p.reynolds, j + 1, f"{p.y[j]:.6g}", p.net[j], *values])
                at += 1
