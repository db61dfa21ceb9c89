#!/usr/bin/python3
"""What a dense bed of particles takes, in numbers that repeat: bytes of peak memory a particle, and instructions a contact
of a step (callgrind, AVX2). Fails where one of them exceeds its limit; ends with 77 where instructions cannot be counted.

    dem_unit_costs.py POLYBED

The bed is a body-centred lattice, pressed by a hundredth of the diameter: eight contacts a particle, all that are listed.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import open_mpi  # noqa: E402

CASE = """
[column]
size = [{side}, {side}, {side}]
cells = [4, 4, 4]
sides = "periodic"
ends = "periodic"
gravity = 0
[fluid]
name = "none"
[[species]]
name = "a"
diameter = "1 mm"
density = 2500
[bed]
start = "list:particles.csv"
[effects]
contact = "hertz_mindlin"
[dem]
greatest_speed = "0.2 m/s"
fixed_step = {step}
tangential = "mindlin"
ledger = false
[run]
until = 1
[output]
every = 1
history_every = 1
"""
STEP = 2e-6  # s
SPACING = 0.99 * 2e-3 / 3**0.5  # m
# The limits: measured on 2026-11-23 (docs/record/cost.md) and a tenth more, for other compilers and libraries;
# instructions: 289 on 2026-11-28 and 3 %.
MOST_BYTES = 710
MOST_INSTRUCTIONS = 299
NOTHING_TO_COUNT_WITH = 77


def write_bed(folder, cells):
    """A case of 2 cells^3 particles, whose speeds are pseudo-random numbers of up to 0.05 m/s."""
    lines, number = ["species,x,y,z,vx,vy,vz"], 1
    for n in range(2 * cells**3):
        corner, shift = n // 2, 0.25 + 0.5 * (n % 2)
        place = [SPACING * (corner // cells**k % cells + shift) for k in range(3)]
        speed = []
        for _ in range(3):
            number = number * 48271 % 2147483647  # minstd
            speed.append(0.1 * number / 2147483647 - 0.05)
        lines.append("a," + ",".join(f"{value:.9g}" for value in place + speed))
    (folder / "particles.csv").write_text("\n".join(lines) + "\n")
    (folder / "case.toml").write_text(CASE.format(side=SPACING * cells, step=STEP))


def run(command, folder, steps):
    """Peak of memory in bytes, the work of the run and what it said."""
    process = subprocess.Popen([*command, "dem", "case.toml", "--quiet", "--no-picture", "--force", "-o", "run", "--until",
                                str(steps * STEP)], cwd=folder, stderr=subprocess.PIPE, text=True)
    errors = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{command}: {errors}")
    return usage.ru_maxrss * 1024, json.loads((folder / "run/run.json").read_text())["work"], errors


def bytes_a_particle(polybed, folder):
    few, many = 16, 32
    peaks = []
    for cells in (few, many):
        write_bed(folder, cells)
        peaks.append(run([polybed], folder, 10)[0])
    return (peaks[1] - peaks[0]) / (2 * many**3 - 2 * few**3)


def can_count():
    cpu = pathlib.Path("/proc/cpuinfo")
    return shutil.which("valgrind") is not None and cpu.exists() and " avx2 " in cpu.read_text()


def instructions_a_contact(polybed, folder):
    """Of a whole step, by a long run less a short one."""
    os.environ["POLYBED_VECTORS"] = "avx2"
    write_bed(folder, 8)
    callgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", polybed]
    counted = []
    for steps in (10, 110):
        _, work, errors = run(callgrind, folder, steps)
        counted.append((int(re.search(r"Collected : (\d+)", errors).group(1)), work))
    (short, before), (long, after) = counted
    print(f"{after['contact_steps'] - before['contact_steps']} contacts, {after['rebuilds'] - before['rebuilds']} lists in "
          "100 steps")
    return (long - short) / (after["contact_steps"] - before["contact_steps"])


def main():
    polybed = os.path.abspath(sys.argv[1])
    os.environ.update(open_mpi.ONE_PROCESS)
    failed = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        size = bytes_a_particle(polybed, folder)
        print(f"peak memory: {size:.0f} bytes a particle, at most {MOST_BYTES}")
        if size > MOST_BYTES:
            failed.append("more memory a particle than before")
        if can_count():
            count = instructions_a_contact(polybed, folder)
            print(f"{count:.0f} instructions a contact of a step, at most {MOST_INSTRUCTIONS}")
            if count > MOST_INSTRUCTIONS:
                failed.append("more instructions a contact than before")
        else:
            print("instructions are not counted: that takes valgrind and a processor with AVX2")
    sys.exit("; ".join(failed) if failed else 0 if can_count() else NOTHING_TO_COUNT_WITH)


if __name__ == "__main__":
    main()
