#!/usr/bin/python3
"""Runs a test of the label nightly where what it guards has changed since it last passed, which tests/nightly.txt notes, or where
POLYBED_NIGHTLY is 1. Else it is skipped, or run in its short form if it has one.

Usage: nightly.py NAME BUILD [--short] PATH ... -- COMMAND ...    sets POLYBED_NIGHTLY for the command: 1, the whole test; 0, the short form
       nightly.py --record BUILD                                  notes what has passed in a build since it was made
"""
import hashlib
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
NOTED = ROOT / "tests/nightly.txt"
SKIPPED = 77


def digest(paths):
    """Of the names and contents of all files below the paths."""
    total = hashlib.sha256()
    for path in paths:
        place = ROOT / path
        files = [place] if place.is_file() else sorted(f for f in place.rglob("*") if f.is_file() and f.suffix != ".pyc")
        if not files:
            sys.exit(f"tests/nightly.py: there is no {path}")
        for file in files:
            total.update(f"{file.relative_to(ROOT)}\0".encode() + file.read_bytes() + b"\0")
    return total.hexdigest()[:16]


def noted():
    lines = NOTED.read_text().splitlines() if NOTED.exists() else []
    return dict(line.split() for line in lines if not line.startswith("#"))


def record(build):
    passed = {file.name: file.read_text() for file in (build / "nightly").iterdir()}
    rows = [f"{name} {value}\n" for name, value in sorted((noted() | passed).items())]
    NOTED.write_text("# What each nightly test guarded when it last passed: tests/nightly.py --record\n" + "".join(rows))


def main(words):
    if words[:1] == ["--record"]:
        return record(pathlib.Path(words[1]))
    at = words.index("--")
    (name, build, *paths), command = words[:at], words[at + 1:]
    has_short = "--short" in paths
    guarded = digest([path for path in paths if path != "--short"])
    whole = os.environ.get("POLYBED_NIGHTLY") == "1" or noted().get(name) != guarded
    if not whole and not has_short:
        print(f"{name}: what it guards has not changed since it passed")
        return SKIPPED
    code = subprocess.run(command, env=os.environ | {"POLYBED_NIGHTLY": str(int(whole))}).returncode
    if whole and code == 0:
        note = pathlib.Path(build) / "nightly" / name
        note.parent.mkdir(parents=True, exist_ok=True)
        note.write_text(guarded)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
