"""What a study leaves and says: its record, whole or not at all, a picture of it, and remarks."""

import json
import sys
from contextlib import suppress

from polybed.in_place import put_text
from polybed.ending import FILE, NUMBERS, StudyError, answer


def json_text(found):
    """Raises StudyError if a number is not finite."""
    try:
        return json.dumps(found, ensure_ascii=False, allow_nan=False)
    except ValueError as error:
        raise StudyError(NUMBERS, "a number that is not finite was about to be written as JSON") from error


def write_record(path, found):
    """Puts a JSON file in place whole and returns its text. Raises StudyError."""
    text = json_text(found)
    try:
        put_text(path, text + "\n")
    except OSError as error:
        raise StudyError(FILE, f"cannot write {path}: {error.strerror}") from error
    return text


def remark(text):
    """Says something on standard error, as far as that can be written."""
    with suppress(OSError):
        print(text, file=sys.stderr, flush=True)


def draw(path, what, quiet):
    """Draws a record, and says where the pictures are, or why there is no `what`: the record is complete without. quiet: says nothing"""
    try:
        from polybed.plot import study_drawn  # matplotlib takes a second to be imported
        paths = study_drawn(path)
    except Exception as error:  # whatever is wrong with a picture, the study has ended well
        if not quiet:
            remark(f"no {what}: {error}")
    else:
        if not quiet:
            answer("\n".join(map(str, paths)))
