"""What a calibration says: nothing ends because nobody reads it, and what standard output refuses is remembered."""

import os

from polybed.packages import plain

OUT, ERR = 1, 2
refusals = []  # of standard output


def say(text, to=OUT):
    """Writes a text to a stream."""
    data = plain(text).encode("utf-8", "surrogateescape")
    try:
        while data:
            data = data[os.write(to, data):]
    except OSError as error:
        if to == OUT:
            refusals.append(error)


def duration(seconds):
    """A length of time for people: "42 s", "3 min 20 s", "2 h 5 min"."""
    s = int(seconds + 0.5)
    if s < 60:
        return f"{s} s"
    return f"{s // 60} min {s % 60} s" if s < 3600 else f"{s // 3600} h {s % 3600 // 60} min"
