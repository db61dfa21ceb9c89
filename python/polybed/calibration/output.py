"""What a calibration says: nothing ends because nobody reads it, and what standard output refuses is remembered."""

import os

from polybed.packages import plain

OUT, ERR = 1, 2
refusals = []  # of standard output


def say(text, to=OUT):
    data = plain(text).encode("utf-8", "surrogateescape")
    try:
        while data:
            data = data[os.write(to, data):]
    except OSError as error:
        if to == OUT:
            refusals.append(error)


def columns(head, rows):
    """Lines of a table, all to the right. head: name and width of each column; rows: texts"""
    lines = [[name for name, _ in head], *rows]
    return "".join(" ".join(f"{cell:>{width}}" for cell, (_, width) in zip(line, head)) + "\n" for line in lines)


def mean_text(mean, error):
    return f"{mean:.4g}+-{error:.1g}"


def duration(seconds):
    """A length of time for people: "42 s", "3 min 20 s", "2 h 5 min"."""
    s = int(seconds + 0.5)
    if s < 60:
        return f"{s} s"
    return f"{s // 60} min {s % 60} s" if s < 3600 else f"{s // 3600} h {s % 3600 // 60} min"
