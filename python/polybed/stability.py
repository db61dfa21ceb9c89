"""Draws the heat map of the matrix of hard cases: what `polybed stability` hands over to.

    python3 -m polybed.stability DIRECTORY

reads DIRECTORY/stability.json and writes stability.png and stability.svg beside it. Exit codes are those of polybed: 0
done, 4 a file or a package is missing.
"""

import argparse
import sys
from pathlib import Path

from polybed.packages import needed

with needed(__name__ == "__main__"):
    from polybed.drawing import hard_cases
    from polybed.ending import made
    from polybed.files import contents_of, read_json
    from polybed.plot import save


def pictures(directory):
    """Draws the matrix in a folder as PNG and SVG and returns their paths."""
    path = directory / "stability.json"
    matrix = read_json(path, "polybed stability")
    with contents_of(path):
        return [save(hard_cases.draw(matrix), path.with_suffix(f".{ending}")) for ending in ("png", "svg")]


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed.stability", description="Draws the matrix of hard cases.")
    parser.add_argument("directory", type=Path)
    directory = parser.parse_args(arguments).directory
    return made(lambda: pictures(directory))


if __name__ == "__main__":
    sys.exit(main())
