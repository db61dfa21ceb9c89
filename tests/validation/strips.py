"""Runs of narrow strips of the thesis's columns that may be stopped at any time and given again."""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))


def arguments(description, names):
    """Those of a script that makes runs of some names, or reads them."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("runs", type=Path)
    parser.add_argument("name", nargs="*", choices=[[], *names])
    parser.add_argument("--read", action="store_true", help="run nothing, read what is there, finished or not")
    return parser.parse_args()


def finished(directory):
    try:
        return json.loads((directory / "run.json").read_text())["state"] == "done"
    except FileNotFoundError:
        return False


def run(program, model, case, directory, settings):
    """Runs a case with keys of its own, or goes on with that; a run that is done is left as it is."""
    if finished(directory):
        return
    words = [program, model, ROOT / "cases" / case / "case.toml", "-o", directory, "--quiet", "--no-picture"]
    words += [w for s in settings for w in ("--set", s)]
    words += ["--resume"] if (directory / "checkpoint.h5").exists() else ["--force"]
    subprocess.run(words, check=True)


def mean(values, digits=2):
    """Mean and standard error from four batches."""
    batches = [np.mean(part) for part in np.array_split(values, 4)]
    return f"{np.mean(values):.{digits}f} ± {np.std(batches, ddof=1) / 2:.{digits}f}"


def table(head, rows):
    for cells in (head, ["---"] * len(head), *rows):
        print("| " + " | ".join(cells) + " |")
