#!/usr/bin/python3
"""That a box of even cells does not pay for columns of other shapes: instructions per cell of a right-hand side of the continuum
model (callgrind, AVX2), at most 1 % above the recorded number, and none of them for arrays of open shares.

    uniform_box_counts.py POLYBED COMPILER BUILD_TYPE

Ends with 77 where instructions cannot be counted (no valgrind, no AVX2) or were not recorded for the compiler (its name and
first number, for example "GNU 12"): compilers differ by more than 1 %. Counts repeat exactly on processors of all kinds."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "absent"), str(TESTS / "cost")]
import open_mpi  # noqa: E402
from dem_unit_costs import NOTHING_TO_COUNT_WITH, can_count  # noqa: E402
from off_means_absent import self_counts  # noqa: E402

CASE = """
[column]
size = {size}
cells = {cells}
sides = "wall"
{more}
[fluid]
name = "water"
temperature = "20 degC"
[[species]]
name = "fine"
diameter = "0.5 mm"
density = 2500
[[species]]
name = "coarse"
diameter = "1 mm"
density = 2000
[bed]
volume_share = [0.5, 0.5]
static_height = "20 mm"
solids_fraction = 0.55
[inlet]
superficial_velocity = "20 mm/s"
[effects]
drag = "cello"
solids_stress = "frictional"
species_exchange = "syamlal"
fluid_stress = "newtonian"
others = "none"
[tfm]
integrator = "explicit"
fixed_step = "0.5 ms"
momentum = "conservative_limited"
[run]
until = "4 ms"
[output]
every = 1
history_every = 1
"""
PLANE = ('["24 mm", "72 mm"]', "[24, 72]", 24 * 72)
SPACE = ('["12 mm", "12 mm", "28 mm"]', "[12, 12, 28]", 12 * 28 * 12)
GRADED = 'grading = 1.1\ngraded_above = "40 mm"'
EVALUATE = "RightHandSide::evaluate("
ARRAYS = re.compile(r"GeneralMetric|Spreading|core::cross_sections")
# Per cell and right-hand side, in two and in three dimensions, at commit 0fefeebd.
RECORDED = {"GNU 12": (939.3, 3141.8)}
BAND = 1.01


def inclusive(path, function):
    """Calls of a function and the instructions that they took, with all that it called."""
    names, called, next_is_call, calls, cost = {}, None, 0, 0, 0
    for line in open(path):
        if match := re.match(r"(c?)fn=\((\d+)\)(?: (.*))?", line):
            of_call, number, name = match.groups()
            names.setdefault(number, name)
            called = number if of_call else called
        elif match := re.match(r"calls=(\d+)", line):
            next_is_call = int(match[1])
        elif re.match(r"[+\-*\d]", line):
            if next_is_call and function in names[called]:
                calls += next_is_call
                cost += int(line.split()[1])
            next_is_call = 0
    return calls, cost


def counted(polybed, folder, name, size, cells, more=""):
    """Calls of the right-hand side, their instructions, and the functions that were run."""
    case, out = folder / f"{name}.toml", folder / f"{name}.out"
    case.write_text(CASE.format(size=size, cells=cells, more=more))
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", polybed, "tfm", case, "--quiet", "--no-picture",
               "-o", folder / name]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    calls, cost = inclusive(out, EVALUATE)
    assert calls > 24, f"{calls} right-hand sides in 8 steps of three stages"
    return calls, cost, self_counts(out)


def main():
    polybed, compiler, build_type = os.path.abspath(sys.argv[1]), *sys.argv[2:4]
    if not can_count():
        print("instructions are not counted: that takes valgrind and a processor with AVX2")
        sys.exit(NOTHING_TO_COUNT_WITH)
    os.environ.update(open_mpi.ONE_PROCESS, POLYBED_VECTORS="avx2")
    failed, found = [], []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        graded = counted(polybed, folder, "graded", PLANE[0], PLANE[1], GRADED)[2]
        assert any(map(ARRAYS.search, graded)), "a graded column runs no kernel with arrays: the test sees nothing"
        for name, (size, cells, count) in (("plane", PLANE), ("space", SPACE)):
            calls, cost, functions = counted(polybed, folder, name, size, cells)
            found.append(cost / calls / count)
            if arrays := [f for f in functions if ARRAYS.search(f)]:
                failed.append(f"a box of even cells runs {arrays[0]}")
    print(f"instructions per cell and right-hand side: {found[0]:.1f} in two, {found[1]:.1f} in three dimensions")
    recorded = RECORDED.get(compiler.split(".")[0]) if build_type == "Release" else None
    for now, before in zip(found, recorded or ()):
        if now > BAND * before:
            failed.append(f"{now:.1f} instructions per cell and right-hand side, recorded {before}")
    if failed:
        sys.exit("; ".join(failed))
    if recorded is None:
        print(f"no number is recorded for {compiler} {build_type}")
        sys.exit(NOTHING_TO_COUNT_WITH)


if __name__ == "__main__":
    main()
