"""Draws the heat map of the matrix of hard cases: what `polybed stability` hands over to.

    python3 -m polybed.stability DIRECTORY

reads DIRECTORY/stability.json and writes stability.png and stability.svg beside it. Exit codes are those of polybed: 0
done, 4 a file or a package is missing.
"""

import argparse
import sys
from pathlib import Path

from polybed.packages import NO_FILE, needed

with needed(__name__ == "__main__"):
    from polybed.drawing import hard_cases
    from polybed.files import FAULTS, contents_of, read_json
    from polybed.plot import save


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed.stability", description="Draws the matrix of hard cases.")
    parser.add_argument("directory", type=Path)
    directory = parser.parse_args(arguments).directory
    try:
        matrix = read_json(directory / "stability.json", "polybed stability")
        with contents_of(directory / "stability.json"):
            for ending in ("png", "svg"):
                print(save(hard_cases.draw(matrix), directory / f"stability.{ending}"))
    except FAULTS as error:
        print(error, file=sys.stderr)
        return NO_FILE
    return 0


if __name__ == "__main__":
    sys.exit(main())
