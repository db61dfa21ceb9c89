#!/usr/bin/python3
"""The thesis's columns whole, particle by particle, at its velocities: whole_systems.py PROGRAM RUNS [NAME ...] [--read]

NAME, for instance C-27, chooses; without it all are run one after the other: days. A run that is done is not run again, one that was
stopped goes on where it was. Prints how far each is, and means over the last quarter of its time. --read: run nothing.
"""
from strips import arguments, run, table
from thesis_systems import ALL, STRIPS, row

import polybed

# System, mm/s, seconds as in the thesis, and what differs from the case. C at the two temperatures between which the measurements leave
# the choice: at 27 degC a force balance puts its inversion at 13.2 mm/s, at 25 degC at 12.7.
COLUMNS = {
    "C-27": ("C", 12, 50, []),
    "C-25": ("C", 12, 50, ["fluid.viscosity=0.89e-3"]),
    "B-30": ("B", 30, 170, []),
    "B-25": ("B", 25, 170, []),
    "B-35": ("B", 35, 170, []),
    "A-0.3": ("A", 0.3, 92, []),
}
SIZE_KEYS = ("column.", "bed.", "dem.skin")
OFTEN = ["output.every=0.5", "output.history_every=0.05", "output.checkpoint_every=0.25"]  # where a second takes minutes


def settings(system, velocity, until, own):
    """Contacts and steps as in the strip of the system, the column and its particles as in the case."""
    keys = [*(s for s in STRIPS[system] if not s.startswith(SIZE_KEYS)), *ALL, *(OFTEN if system == "C" else []),
            f"inlet.superficial_velocity={velocity * 1e-3:g}", f"run.until={until}", *own]
    last = {key.split("=")[0]: key for key in keys}
    return list(last.values())


def main():
    given = arguments(__doc__, COLUMNS)
    rows = []
    for name in given.name or COLUMNS:
        system, velocity, until, own = COLUMNS[name]
        directory = given.runs / name
        if not given.read:
            run(given.program.resolve(), "dem", f"thesis-{system.lower()}", directory, settings(system, velocity, until, own))
        if (directory / "history.csv").exists():
            cells = row(system, velocity, "dem", polybed.read(directory))
            rows.append([name, cells[1], f"{cells[3]} of {until}", *cells[4:]])
    table(["column", "mm/s", "s", "bed height, mm", "its drift, mm/s", "centre of fine, mm", "centre of coarse, mm", "coarse over fine, mm",
           "over the height", "interface, mm (of the time)", "drop / weight", "CPU s"], rows)


if __name__ == "__main__":
    main()
