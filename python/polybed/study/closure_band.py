"""The band of a drag law, and the law moved within it.

A band is what the law's errors on lattice-Boltzmann rows leave open, as root mean squares of ln(n_law/n_data): of the force on one size, of
the factor that all sizes of a packing have in common, and of the ratio of two sizes. That of a law of the menu is in closure_bands.json,
which `python3 -m polybed.study.closure_band ROWS...` makes of tests/data/lbm; the band of a fitted law is in its file.
"""

import json
import math
import sys
from pathlib import Path

from polybed.files import contents_of, read_text
from polybed.errors import ProgramError
from polybed.runner import asked
from polybed.ending import FILE, WRONG_CASE, StudyError, guarded
from polybed.study.cases import laws_of

BANDS = Path(__file__).with_name("closure_bands.json")
WIDEST = 0.5  # of a tilt, as the law file has it
GREATEST = 0.5  # of a band: beyond, the law is used far outside its range and has no band that could be added to an answer


def file_of(law):
    return Path(law.removeprefix("file:")) if law.startswith("file:") else None


def content_of(law):
    """A law of the menu, or of a file, as a law file has it."""
    path = file_of(law)
    if not path:
        return {"filetype": "polybed drag law", "version": 1, "law": law}
    with contents_of(path):
        return json.loads(read_text(path))


def band_of(law, partition):
    """The band of a law with its partition. Raises StudyError if it has none."""
    content = content_of(law)
    path, name = file_of(law), content.get("law")
    if path and not name:
        band = content.get("band") if partition == "none" else content.get("partition_bands", {}).get(partition)
        if not band:
            beside = "" if partition == "none" else f" with the partition {partition}: polybed fit writes it where its rows have mixtures"
            raise StudyError(FILE, f"{path} has no band{beside}")
        return band
    try:
        return json.loads(BANDS.read_text(encoding="utf-8"))["bands"][name][partition]
    except KeyError:
        raise StudyError(WRONG_CASE, f"the drag law {name} with partition {partition} has no band") from None


def width_of(band, name, law):
    """One width of a band. Raises StudyError where the law is too far from the rows, or the rows say nothing of it."""
    width = band[name]
    if width is None or width > GREATEST:
        far = "without end" if width is None else f"{100 * width:.0f} % (rms)"
        raise StudyError(WRONG_CASE, f"the drag law {law} is off by {far} in {name} on its rows, or they have none of that kind: no band; "
                                     f"take a law within {100 * GREATEST:.0f} %, docs/record/accuracy.md")
    return width


def write_moved(law, common, tilt, path):
    """Writes a law file with f_j times common (1 + tilt (y_j - 1)), and returns its name as a drag law."""
    content = content_of(law)
    content |= {"common": common * content.get("common", 1), "tilt": tilt + content.get("tilt", 0)}
    path.write_text(json.dumps(content) + "\n", encoding="utf-8")
    return f"file:{path}"


def tilt_of(ratio, law, partition, composition, voidage, reynolds):
    """The tilt that moves n of the finest over that of the coarsest size by a ratio, and the derivative that gives it. With the sum kept,
    the change of f_j is that of n_j, so d ln(n_1/n_2)/d tilt = f_1 (y_1 - 1)/n_1 - f_2 (y_2 - 1)/n_2.

    composition: pairs of share and diameter
    """
    mean = 1 / sum(x / d for x, d in composition)
    sizes = [value for pair in composition for value in pair]
    [row] = asked("drag", law=law, partition=partition, points=[[voidage, reynolds, *sizes]])
    order = sorted(range(len(composition)), key=lambda j: composition[j][1])
    fine, coarse = (row[f"f_{j + 1}"] * (composition[j][1] / mean - 1) / row[f"n_{j + 1}"] for j in (order[0], order[-1]))
    slope = fine - coarse
    if abs(ratio) > WIDEST * abs(slope):
        raise StudyError(WRONG_CASE, f"the ratio of the sizes cannot be moved by {100 * ratio:.3g} % at voidage {voidage:.3g}")
    return ratio / slope


def every_band(rows):
    """Bands of every law of the menu with every partition, on rows."""
    from polybed.fit.errors import band_of as band_on, net_by_program
    from polybed.fit.rows import read_points
    points = read_points(rows)
    bands = {}
    for law in laws_of("drag"):
        if law.startswith("file:"):
            continue
        for partition in ("none", *laws_of("partition")):
            try:
                nets = net_by_program(points, law, partition)
            except ProgramError:  # of a law that cannot be shared
                if partition == "none":
                    raise
                continue
            band = band_on(points, nets)
            bands.setdefault(law, {})[partition] = {name: round(value, 5) if math.isfinite(value) else None for name, value in band.items()}
    return {"rows": sorted({Path(p.source).name for p in points}), "bands": bands}


def main():
    BANDS.write_text(json.dumps(every_band(sys.argv[1:]), indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
