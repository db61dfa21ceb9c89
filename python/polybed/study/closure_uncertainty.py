"""The band of an answer from the band of a drag law: what `--closure-uncertainty` of `polybed inversion` and of `polybed tfm` hands over to.

Its argument is a JSON object: what the command line says. The common factor and the ratio of the sizes are moved apart, each by the law's
band, and the answer is found again, by force balance or by runs. The changes are added in squares, and compared with both moved at once."""

import json
import math
import sys
import tempfile
from pathlib import Path

from polybed.study.output import draw, remark, taken, write_record
from polybed.study.cases import Case, refuse_without_ends
from polybed.study.closure_band import band_of, tilt_of, width_of, write_moved
from polybed.ending import DONE, NUMBERS, WRONG_CASE, StudyError, answer, guarded
from polybed.runner import answer_of, call, words_of
from polybed.study.stress_uncertainty import late_means, run_again, run_case

FINE = 0.5  # y below which the ratio has a band of its own
SMALL = 0.1  # of the band: the step of the linearised answer


def shares_of(bed, sizes):
    """Shares of the solids' volume; of one list of particles, whose sizes the case does not count, equal ones."""
    if len(bed.get("volume_share", [])) == len(sizes):
        return bed["volume_share"]
    counts = bed.get("particles", [])
    volumes = [n * d**3 for n, d in zip(counts, sizes)] if len(counts) == len(sizes) else [1] * len(sizes)
    return [volume / sum(volumes) for volume in volumes]


class Bed:
    """What of a case decides how the law is moved."""

    def __init__(self, request):
        self.case = Case(request["case"], request["overrides"], request["until"])
        self.law, self.partition, self.fluid = request["law"], request["partition"], request["fluid"]
        sizes = [species["diameter"] for species in self.case.keys["species"]]
        shares = shares_of(self.case.keys["bed"], sizes)
        self.composition = [(x, d) for x, d in zip(shares, sizes) if x > 0]
        self.mixed = len({d for _, d in self.composition}) > 1
        self.mean = 1 / sum(x / d for x, d in self.composition)
        self.band = band_of(self.law, self.partition)

    def widths(self):
        """The band of the common factor, and of the ratio, None for one size."""
        if not self.mixed:
            return width_of(self.band, "one_size", self.law), None
        fine = min(d for _, d in self.composition) / self.mean < FINE
        found = "ratio_fine" if fine and self.band["ratio_fine"] else "ratio"
        return width_of(self.band, "common", self.law), width_of(self.band, found, self.law)

    def directions(self, voidage, velocity):
        """(common, tilt) at plus one band for each direction, by name. velocity: superficial, m/s"""
        common, ratio = self.widths()
        found = {"common": (common, 0.0)}
        if ratio:
            reynolds = self.fluid["density"] * velocity * self.mean / self.fluid["viscosity"]
            found["ratio"] = (0.0, tilt_of(ratio, self.law, self.partition, self.composition, voidage, reynolds))
        return found

    def moved(self, directions, signs, path):
        """Override for the law moved by so many bands in each direction, a factor by its logarithm: plus and minus undo each other."""
        common = sum(math.log1p(directions[name][0]) * sign for name, sign in signs.items())
        tilt = sum(directions[name][1] * sign for name, sign in signs.items())
        return f'effects.drag="{write_moved(self.law, math.exp(common), tilt, path)}"'


def summary(base, found, both):
    """The band of one number. found: {direction: (minus, plus)}; both: with all directions at plus one band, None if not found"""
    if base is None or any(value is None for pair in found.values() for value in pair):
        return {"value": base, "low": None, "high": None}
    down, up = (math.hypot(*(end(base, *pair) - base for pair in found.values())) for end in (min, max))
    linear = base + sum((plus - minus) / 2 for minus, plus in found.values())
    return {"value": base, "low": base - down, "high": base + up,
            "by": {name: {"minus": minus, "plus": plus} for name, (minus, plus) in found.items()},
            "all_plus": {"linear": linear, "found": both}}


def base_record(request, bed, directions):
    return {"filetype": "polybed closure uncertainty", "version": 1, "kind": request["kind"], "law": bed.law, "partition": bed.partition,
            "band": {name: width for name, width in zip(("common", "ratio"), bed.widths()) if width is not None},
            "moved_to": {name: {"common": 1 + common, "tilt": tilt} for name, (common, tilt) in directions.items()}}


# The inversion point, by force balance.

def balance(request, overrides, near=None):
    """The inversion point of a case; that nearest to a voidage. None without one."""
    found = answer_of("inversion", request["case"], *words_of(overrides), "--method", request["method"])
    roots = found["roots"]
    if near is None or not roots:
        return found, roots[-1] if roots else None
    return found, min(roots, key=lambda root: abs(root["voidage"] - near))


def inversion_band(request, bed):
    """The record of the study, and what `polybed inversion` says by itself."""
    plain, base = balance(request, bed.case.overrides)
    if base is None:
        raise StudyError(NUMBERS, f"no inversion point by {request['method']} with {bed.law}: nothing to put a band about")
    directions = bed.directions(base["voidage"], base["velocity_m_s"])

    def at(signs):
        with tempfile.TemporaryDirectory() as folder:
            override = bed.moved(directions, signs, Path(folder) / "law.json")
            return balance(request, [*bed.case.overrides, override], base["voidage"])[1]

    pairs = {name: (at({name: -1}), at({name: 1})) for name in directions}
    steps = {name: (at({name: -SMALL}), at({name: SMALL})) for name in directions}
    both = at({name: 1 for name in directions})
    record = base_record(request, bed, directions) | {"method": request["method"]}
    for key in ("velocity_m_s", "voidage"):
        def of(*roots, key=key):
            return tuple(root and root[key] for root in roots)
        record[key] = summary(base[key], {name: of(*pair) for name, pair in pairs.items()}, *of(both))
        if all(root for pair in steps.values() for root in pair):
            slopes = {name: (plus[key] - minus[key]) / (2 * SMALL) for name, (minus, plus) in steps.items()}
            record[key]["linear_half_width"] = math.hypot(*slopes.values())
    return record, plain


def inversion_lines(record):
    velocity, voidage = record["velocity_m_s"], record["voidage"]
    if velocity["low"] is None:
        return ["  within the band of the drag law there is not always an inversion point: no band of the velocity"]
    moved = ", ".join(f"{name} {100 * width:.1f} %" for name, width in record["band"].items())
    lines = [f"  drag law within its band ({moved}): {1e3 * velocity['low']:.2f} to {1e3 * velocity['high']:.2f} mm/s, voidage "
             f"{voidage['low']:.4f} to {voidage['high']:.4f}"]
    for name, pair in velocity["by"].items():
        low, high = sorted(pair.values())
        lines.append(f"    {name} alone: {1e3 * low:.2f} to {1e3 * high:.2f} mm/s")
    check = velocity["all_plus"]
    if check["found"] is not None:
        lines.append(f"    linearised: +-{1e3 * velocity['linear_half_width']:.2f} mm/s; all at plus: {1e3 * check['found']:.2f} mm/s, by the "
                     f"sum of both {1e3 * check['linear']:.2f}")
    return lines


def make_inversion(request):
    bed = Bed(request)
    record, plain = inversion_band(request, bed)
    if request["output"]:
        folder = Path(request["output"])
        with taken(folder):
            write_record(folder / "closure_uncertainty.json", record)
            if request["picture"]:
                draw(folder / "closure_uncertainty.json", "picture", True)
    velocity = record["velocity_m_s"]
    if request["json"]:
        band = None if velocity["low"] is None else [velocity["low"], velocity["high"]]
        answer(json.dumps(plain | {"closure_band_m_s": band, "closure_uncertainty": record}))
        return DONE
    said = call("inversion", request["case"], *words_of(bed.case.overrides), "--method", request["method"])
    answer("\n".join([said.rstrip("\n"), *inversion_lines(record)]))
    return DONE


# The bed, by runs of the two-fluid model.

def mean_voidage(bed, height):
    """That of the bed at a mean height; as it rests where that cannot be told."""
    keys = bed.case.keys["bed"]
    fraction = keys.get("solids_fraction", 0.6)
    if not height or not keys.get("static_height"):
        return 1 - fraction
    return 1 - min(fraction, fraction * keys["static_height"] / height)


def run_moved(request, bed, directions, signs, name):
    """The case with its law moved, in a folder of the run; its late means."""
    override = bed.moved(directions, signs, Path(request["directory"]) / f"law-{name}.json")
    return late_means(run_again(request, bed.case, name, override))


def tfm_record(request, bed, base):
    velocity = bed.case.velocity or 0.0
    directions = bed.directions(mean_voidage(bed, base["bed_height_m"]), velocity)
    runs = {name: (run_moved(request, bed, directions, {name: -1}, f"{name}-minus"),
                   run_moved(request, bed, directions, {name: 1}, f"{name}-plus")) for name in directions}
    both = run_moved(request, bed, directions, {name: 1 for name in directions}, "all-plus") if len(directions) > 1 else None
    record = base_record(request, bed, directions) | {"window": "last quarter, from where it is stationary"}
    for key in base:
        if base[key] is not None:
            record[key] = summary(base[key], {name: (minus[key], plus[key]) for name, (minus, plus) in runs.items()},
                                  both[key] if both else None)
    return record


def tell_tfm(record):
    for key, unit in (("bed_height_m", " m"), ("centre_difference", "")):
        found = record.get(key)
        if not found or found["low"] is None:
            continue
        remark(f"{key}: {found['value']:.5g}{unit}, {found['low']:.5g} to {found['high']:.5g} within the band of the drag law")
        if found["all_plus"]["found"] is not None:
            remark(f"  all at plus: {found['all_plus']['found']:.5g}{unit}, by the sum of both {found['all_plus']['linear']:.5g}")


def make_tfm(request):
    bed = Bed(request)
    refuse_without_ends(bed.case.keys, "--closure-uncertainty")
    if "profile" in bed.case.keys["column"]:
        raise StudyError(WRONG_CASE, "--closure-uncertainty: the bands are those at one voidage, which differs along a column that tapers")
    run_case(request, bed.case)
    record = tfm_record(request, bed, late_means(request["directory"]))
    write_record(Path(request["directory"]) / "closure_uncertainty.json", record)
    tell_tfm(record)
    if request["picture"]:
        draw(Path(request["directory"], "closure_uncertainty.json"), "picture", True)
    return DONE


def main():
    request = json.loads(sys.argv[1])
    return guarded(lambda: make_tfm(request) if request["kind"] == "tfm" else make_inversion(request))
