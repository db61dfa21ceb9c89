"""Makes the page of a run: what `polybed report` hands over to.

    python3 -m polybed.report RUN

Exit codes are those of polybed: 0 done, 2 the command is wrong, 4 a file or a package is missing.
"""

import argparse
import sys

from polybed.packages import needed

with needed(True):
    from polybed.ending import made
    from polybed.report.build import told, write


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed report", description="Makes report.html of a finished or a running run.")
    parser.add_argument("run", help="run directory")
    directory = parser.parse_args(arguments).run
    return made(lambda: [told(*write(directory))])


if __name__ == "__main__":
    sys.exit(main())
