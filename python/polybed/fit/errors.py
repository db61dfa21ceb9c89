"""Errors of laws on points, as the program evaluates them, and the band that follows."""

import numpy as np

from polybed.runner import asked

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
    common; of the ratio of two sizes beside each other in a packing, apart where one of them is fine. None without such points."""
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
        y = p.diameter * (p.share / p.diameter).sum()
        order = np.argsort(y)
        if len(y) <= 4:
            for a, b in zip(order[:-1], order[1:]):
                (fine if y[a] < FINE else ratio).append(error[a] - error[b])
    return {"one_size": rms(one), "common": rms(common), "ratio": rms(ratio), "ratio_fine": rms(fine)}
