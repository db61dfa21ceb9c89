"""polybed validate: measured beds against the models. Exit codes are those of polybed."""

import sys

from polybed.packages import needed

with needed(True):
    from polybed.validation.command import main

sys.exit(main(sys.argv[1:]))
