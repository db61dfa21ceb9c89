"""The curves of a page, the history in panels and the profiles over height for every stored time; and arrays as they stand in a page: whole
numbers of one or two bytes, compressed, as text, which the script of the page unpacks."""

import base64
import zlib

import numpy as np

from polybed.drawing.curves import panels, profile_kinds, profile_panel

MOST_ROWS = 1200  # of a history in a page
MOST_PROFILES = 200
DASHES = {"-": [], "--": [6, 4], ":": [2, 3], "-.": [8, 3, 2, 3]}  # by matplotlib's names


def looks_of(line):
    dash = line.looks["linestyle"]
    return {"label": line.label, "colour": line.looks["color"], "dash": DASHES[dash] if isinstance(dash, str) else list(dash[1])}


def history_of(run):
    """All panels of the history, for JSON."""
    def curve(line, factor):
        chosen = thinned(len(line.x), MOST_ROWS)
        return looks_of(line) | {"x": plain_numbers(line.x[chosen]), "y": plain_numbers(line.y[chosen] * factor)}

    return [{"title": panel.label, "lines": [curve(line, panel.scale[0]) for line in panel.lines], "zero": panel.zero, "note": panel.note}
            for panel in panels(run)]


def chart(run, kind, chosen):
    """Profiles of one kind at the chosen times; None without any."""
    panel = profile_panel(run, kind, chosen)
    if not panel.lines:
        return None
    factor = panel.scale[0]
    finite = np.concatenate([line.x[np.isfinite(line.x)].ravel() for line in panel.lines] + [np.zeros(1)]) * factor
    # what has fallen below an opening is counted with the lowest layer, whose voidage can then be below 0
    low, high = (0.0, 1.0) if kind == "phi" else (min(0.0, float(finite.min())), max(float(finite.max()), 1e-12))
    lines = [looks_of(line) | {"x": None, "y": packed(levels(line.x * factor, low, high, np.uint16))} for line in panel.lines]
    return {"title": panel.label, "low": low, "high": high, "lines": lines}


def profiles_of(run, factor):
    """Lateral means over height for the slider, for JSON; None without any. factor: of lengths in the page"""
    profiles = run.profiles
    if not profiles or len(profiles["time_s"]) == 0:
        return None
    chosen = thinned(len(profiles["time_s"]), MOST_PROFILES)
    charts = [chart(run, kind, chosen) for kind in profile_kinds(run)]
    return {"time": plain_numbers(profiles["time_s"][chosen]), "y": plain_numbers(profiles["y_m"] * factor), "charts": [one for one in charts if one]}


EMPTY = 255  # of a map where there is nothing to show; levels are 0 to 254, so that 127 is the middle of a scale with two signs


def packed(values):
    """Text of an array of bytes or of two-byte numbers, little end first."""
    plain = np.ascontiguousarray(values).astype(values.dtype.newbyteorder("<"))
    return base64.b64encode(zlib.compress(plain.tobytes(), 6)).decode()


def levels(values, low, high, kind=np.uint8):
    """Values as levels of one byte or two between the ends of a scale, which can be arrays; the highest stands for no number."""
    empty = np.iinfo(kind).max
    share = (np.asarray(values, np.float32 if kind is np.uint8 else float) - low) / np.where(np.greater(high, low), np.subtract(high, low), 1)
    with np.errstate(invalid="ignore"):
        found = np.rint(np.clip(share, 0, 1) * (empty - 1))
    return np.where(np.isfinite(found), found, empty).astype(kind)


def changes(values):
    """Two-byte numbers [step][...] as changes from step to step, low and high bytes apart: what moves little compresses well."""
    change = np.diff(values, axis=0, prepend=np.zeros_like(values[:1])).astype(np.uint16)
    return np.concatenate([(change & 255).astype(np.uint8).ravel(), (change >> 8).astype(np.uint8).ravel()])


def plain_numbers(values, digits=5):
    """Numbers for JSON, to some digits; null for others."""
    return [float(f"{value:.{digits}g}") if np.isfinite(value) else None for value in np.asarray(values, dtype=float)]


def thinned(count, most):
    """Numbers of at most so many of `count` entries, the last one among them, evenly."""
    stride = max(1, -(-count // most))
    return np.arange(count)[::-1][::stride][::-1]
