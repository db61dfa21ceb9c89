"""polybed cost: error against time for a case, and what follows from it. Exit codes are those of polybed."""

import sys

from polybed.packages import needed

with needed(True):
    from polybed.cost.command import main

sys.exit(main(sys.argv[1:]))
