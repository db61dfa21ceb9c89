"""What the scripts of the gallery share: their options, and the case they begin with."""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import polybed


def options(text, case):
    """The options of a script; its case is one of those that are shipped, unless another is given."""
    parser = argparse.ArgumentParser(description=text.split("\n")[0])
    parser.add_argument("case", nargs="?", help=f"case file (default: {case})")
    parser.add_argument("-o", "--output", type=Path, default=Path("gallery"), help="folder of the runs and the picture")
    parser.add_argument("--short", action="store_true", help="a few short runs, to see that it works: no result")
    chosen = parser.parse_args()
    chosen.case = chosen.case or str(polybed.case(case))  # the package finds it, wherever the script lies
    return chosen


def save(figure, folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / name, dpi=150)
    plt.close(figure)
    print(folder / name)
