"""Runs of narrow strips of the thesis's columns that may be stopped at any time and given again."""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))


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
