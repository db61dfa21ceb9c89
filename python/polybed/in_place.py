"""Files that are put in place whole."""

import os
from contextlib import contextmanager


@contextmanager
def in_place(path, ending=".temporary"):
    """The path to write under a temporary name in the same folder, `path.name + ending`; if all went well it is flushed to the disk and
    renamed.

    The temporary file is new: a link that has its name, in a folder that others may write, is removed and not followed.
    """
    temporary = path.with_name(path.name + ending)
    temporary.unlink(missing_ok=True)
    os.close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o666))
    try:
        yield temporary
        with open(temporary, "rb") as written:
            os.fsync(written)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def put_text(path, text, errors="strict"):
    """Puts a text file in place whole and returns its path."""
    with in_place(path) as temporary:
        temporary.write_text(text, encoding="utf-8", errors=errors)
    return path
