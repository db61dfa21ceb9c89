"""Draws a sweep of error against time: what `polybed cost` and `polybed plot` of its folder hand over to.

    python3 -m polybed.cost.picture DIR [--out DIR]

Reads DIR/cost.json, writes cost.png, cost.svg and the page cost.html and prints their paths. Exit codes are those of polybed.
"""

import argparse
import sys
from pathlib import Path

from polybed.packages import needed

with needed(__name__ == "__main__"):
    import matplotlib.pyplot as plt

    from polybed.drawing import cost
    from polybed.drawing.style import STYLE
    from polybed.ending import made
    from polybed.files import contents_of, read_json
    from polybed.plot import save

    from polybed.cost.page import write_page


def pictures(directory, out=None):
    """Draws the sweep in a folder as PNG and SVG and returns their paths."""
    folder = Path(out or directory)
    folder.mkdir(parents=True, exist_ok=True)
    path = Path(directory) / "cost.json"
    sweep = read_json(path, "polybed cost")
    with plt.rc_context(STYLE), contents_of(path):
        return [save(cost.draw(sweep), folder / f"cost.{ending}") for ending in ("png", "svg")]


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed plot", description="Draws a sweep of error against time.")
    parser.add_argument("directory")
    parser.add_argument("--out", help="folder of the pictures (default: that of the sweep)")
    options = parser.parse_args(arguments)
    return made(lambda: [*pictures(options.directory, options.out), *([] if options.out else [write_page(options.directory)])])


if __name__ == "__main__":
    sys.exit(main())
