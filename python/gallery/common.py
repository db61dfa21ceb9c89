"""What the scripts of the gallery share: their options, and the case they begin with."""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent
# Beside the sources, or as installed.
CASES = next(folder for folder in (HERE.parents[2] / "cases", HERE.parents[1] / "cases") if folder.is_dir())


def options(text, case):
    """The options of a script; its case is one of those that are shipped, unless another is given."""
    parser = argparse.ArgumentParser(description=text.split("\n")[0])
    parser.add_argument("case", nargs="?", default=str(CASES / case / "case.toml"), help=f"case file (default: {case})")
    parser.add_argument("-o", "--output", type=Path, default=Path("gallery"), help="folder of the runs and the picture")
    parser.add_argument("--short", action="store_true", help="a few short runs, to see that it works: no result")
    return parser.parse_args()


def save(figure, folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / name, dpi=150)
    plt.close(figure)
    print(folder / name)
