"""polybed fit: constants of a drag law from rows of resolved flow. Exit codes are those of polybed."""

import sys

from polybed.packages import needed

with needed(True):
    from polybed.fit.command import main

sys.exit(main(sys.argv[1:]))
