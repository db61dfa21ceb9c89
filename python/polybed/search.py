"""Where other programs are found: on the path, never in the working directory, which may hold a stranger's files."""

import os
import shutil


def path():
    """The environment's PATH without its relative and empty entries, which stand for the working directory."""
    return os.pathsep.join(entry for entry in os.environ.get("PATH", os.defpath).split(os.pathsep) if os.path.isabs(entry))


def find(name):
    """Absolute path of a program, or None."""
    return shutil.which(name, path=path())
