"""The curves of a page: the history in panels, and the profiles over height for every stored time."""

import numpy as np

from polybed.drawing.curves import panels, profile_kinds, profile_panel
from polybed.report import pack
from polybed.report.pack import packed, plain_numbers, thinned

MOST_ROWS = 1200  # of a history in a page
MOST_PROFILES = 200
DASHES = {"-": [], "--": [6, 4], ":": [2, 3], "-.": [8, 3, 2, 3]}  # by matplotlib's names


def looks_of(line):
    dash = line.looks["linestyle"]
    return {"label": line.label, "colour": line.looks["color"], "dash": DASHES[dash] if isinstance(dash, str) else list(dash[1])}


def history_of(run):
    """All panels of the history, for JSON."""
    found = []
    for panel in panels(run):
        lines = []
        for line in panel.lines:
            chosen = thinned(len(line.x), MOST_ROWS)
            lines.append(looks_of(line) | {"x": plain_numbers(line.x[chosen]), "y": plain_numbers(line.y[chosen] * panel.scale[0])})
        found.append({"title": panel.label, "lines": lines, "zero": panel.zero, "note": panel.note})
    return found


def chart(run, kind, chosen):
    """Profiles of one kind at the chosen times; None without any."""
    panel = profile_panel(run, kind, chosen)
    if not panel.lines:
        return None
    factor = panel.scale[0]
    finite = np.concatenate([line.x[np.isfinite(line.x)].ravel() for line in panel.lines] + [np.zeros(1)]) * factor
    # what has fallen below an opening is counted with the lowest layer, whose voidage may then be below 0
    low, high = (0.0, 1.0) if kind == "phi" else (min(0.0, float(finite.min())), max(float(finite.max()), 1e-12))
    lines = [looks_of(line) | {"x": None, "y": packed(pack.levels(line.x * factor, low, high, np.uint16))} for line in panel.lines]
    return {"title": panel.label, "low": low, "high": high, "lines": lines}


def profiles_of(run, factor):
    """Lateral means over height for the slider, for JSON; None without any. factor: of lengths in the page"""
    profiles = run.profiles
    if not profiles or len(profiles["time_s"]) == 0:
        return None
    chosen = thinned(len(profiles["time_s"]), MOST_PROFILES)
    charts = [chart(run, kind, chosen) for kind in profile_kinds(run)]
    return {"time": plain_numbers(profiles["time_s"][chosen]), "y": plain_numbers(profiles["y_m"] * factor), "charts": [one for one in charts if one]}
