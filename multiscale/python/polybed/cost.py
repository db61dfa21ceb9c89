"""Draws a sweep of error against time: what `polybed cost` and `polybed plot` of its folder hand over to.

    python3 -m polybed.cost DIR [--out DIR]

Reads DIR/cost.json, writes cost.png and cost.svg and prints their paths. Exit codes are those of polybed.
"""

import argparse
import json
import os
import sys
from pathlib import Path

try:
    import matplotlib.pyplot as plt

    from polybed.drawing import cost
    from polybed.drawing.style import STYLE
except ImportError as missing:
    if (missing.name or "").startswith("polybed"):
        raise
    if __name__ == "__main__":
        print(f"Python's package {missing.name} is missing, which pictures need: "
              "apt-get install python3-numpy python3-h5py python3-matplotlib", file=sys.stderr)
        sys.exit(4)
    raise

NO_FILE = 4


def read(directory):
    """The sweep in a folder; refuses another file or version."""
    sweep = json.loads((Path(directory) / "cost.json").read_text())
    if sweep.get("filetype") != "polybed cost" or sweep.get("version") != 1:
        raise ValueError(f"{directory}/cost.json: no \"polybed cost\" of version 1")
    return sweep


def pictures(directory, out=None):
    """Draws the sweep in a folder as PNG and SVG and returns their paths."""
    folder = Path(out or directory)
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / "cost.png", folder / "cost.svg"]
    with plt.rc_context(STYLE):
        figure = cost.draw(read(directory))
        for path in paths:
            temporary = path.with_name(path.name + ".temporary")
            figure.savefig(temporary, format=path.suffix[1:])
            os.replace(temporary, path)
        plt.close(figure)
    return paths


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed plot", description="Draws a sweep of error against time.")
    parser.add_argument("directory")
    parser.add_argument("--out", help="folder of the pictures (default: that of the sweep)")
    options = parser.parse_args(arguments)
    try:
        print("\n".join(map(str, pictures(options.directory, options.out))))
    except (OSError, ValueError, KeyError) as error:
        print(error, file=sys.stderr)
        return NO_FILE
    return 0


if __name__ == "__main__":
    sys.exit(main())
