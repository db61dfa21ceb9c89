"""What is drawn as curves in a page: the history in panels, and the profiles over height for every stored time."""

import numpy as np

from polybed.drawing.style import COLOURS, GREY, drop_over_weight, levels
from polybed.drawing.units import fitting
from polybed.outflow import discharge_rate, mass_out, recovery
from polybed.quantities import unit_of_field
from polybed.report.classes import mean_over, parts_of
from polybed.report import pack
from polybed.report.pack import packed, plain_numbers, thinned

MOST_ROWS = 1200  # of a history in a page
MOST_PROFILES = 200
DASHES = [[6, 4], [2, 3], [8, 3, 2, 3]]


def greatest(arrays):
    """The greatest magnitude in arrays that may hold what is no number; 0 without any."""
    return max([0.0] + [float(np.nanmax(np.abs(values))) for values in arrays if np.isfinite(values).any()])


def line(label, x, y, number=None, dash=None):
    """A curve: of the species of that number in its colour, else grey."""
    colour = GREY if number is None else COLOURS[number % len(COLOURS)]
    dash = dash or ([6, 3] if number is not None and number >= len(COLOURS) else [])
    return {"label": label, "x": x, "y": y, "colour": colour, "dash": dash}


def panel(title, unit, lines, zero=True, note=""):
    """Curves over time on one axis, in the unit that fits."""
    factor, name = fitting(unit, greatest([one["y"] for one in lines]))
    for one in lines:
        chosen = thinned(len(one["x"]), MOST_ROWS)
        one["x"], one["y"] = plain_numbers(one["x"][chosen]), plain_numbers(one["y"][chosen] * factor)
    return {"title": title + (f" ({name})" if name else ""), "lines": lines, "zero": zero, "note": note}


def of_species(run, title, unit, values, note=""):
    """A panel with a curve for each species in `values`; none without any."""
    t = run.history["time_s"]
    lines = [line(name, t, values[name], n) for n, name in enumerate(run.kinds) if name in values]
    return [panel(title, unit, lines, note=note)] if lines else []


def height_panel(run):
    history, t = run.history, run.history["time_s"]
    lines = [line(f"centre of {name}", t, history[f"centre_{name}_m"], n) for n, name in enumerate(run.kinds)
             if f"centre_{name}_m" in history]
    lines += [line(label, t, history[column], dash=DASHES[n % len(DASHES)]) for n, (column, label, _) in enumerate(levels(history))]
    return [panel("height", "m", lines)] if lines else []


def balance_panel(run):
    ratio = drop_over_weight(run.history)
    if ratio is None:
        return []
    return [panel("pressure drop over weight", "1", [line("1: the fluid carries the bed", run.history["time_s"], ratio)], zero=False)]


def outflow_panels(run):
    history, species = run.history, run.kinds
    found = of_species(run, "left the column", "kg", mass_out(history, species))
    found += of_species(run, "recovery", "1", recovery(history, species),
                        "what has left over what was there at the start or has been fed since")
    time, rate = discharge_rate(history, species)
    return found + ([panel("discharge rate", "kg/s", [line("all species", time, rate)])] if len(time) else [])


def single_panels(run):
    """Columns that have a panel of their own."""
    history, t, found = run.history, run.history["time_s"], []
    if len(run.species) > 1 and "mixing" in history:
        found.append(panel("mixing index", "1", [line("1: mixed, 0: apart", t, history["mixing"])]))
    energies = {name: history[f"{name}_J"] for name in ("kinetic", "rotational", "elastic") if f"{name}_J" in history}
    if energies:
        found.append(panel("energy of the particles", "J", [line(name, t, values, n) for n, (name, values) in enumerate(energies.items())]))
    for column, title, unit in (("contacts", "contacts", "1"), ("max_overlap_m", "largest overlap", "m"), ("dt_s", "time step", "s")):
        if column in history and greatest([history[column]]) > 0:
            found.append(panel(title, unit, [line(title, t, np.where(history[column] > 0, history[column], np.nan))]))
    return found


def history_of(run):
    """All panels of the history, for JSON."""
    history = run.history
    if not history or len(history["time_s"]) == 0:
        return []
    return height_panel(run) + outflow_panels(run) + balance_panel(run) + single_panels(run)


def curves(run, profiles, chosen, title, kind, extra):
    """Profiles of one kind of every species, and of `extra` (name, label), at the chosen times; None without any."""
    values, names = {}, []
    for n, species in enumerate(run.kinds):
        parts, shares = ([profiles[one][chosen] for one in parts_of(run, f"{of}_{species}") if one in profiles] for of in (kind, "phi"))
        if not parts or len(parts) < len(run.kinds[species]):
            continue
        names.append((f"{kind}_{species}", species, n))
        values[f"{kind}_{species}"] = sum(parts)
        if kind in ("u", "theta") and len(shares) == len(parts):
            values[f"{kind}_{species}"] = np.where(sum(shares) > 0.01, mean_over(parts, shares), np.nan)
    for name, label in extra:
        if name in profiles:
            names.append((name, label, None))
            values[name] = profiles[name][chosen]
    if not names:
        return None
    factor, unit = fitting(unit_of_field(names[0][0]), greatest(values.values()))
    finite = np.concatenate([v[np.isfinite(v)].ravel() for v in values.values()] + [np.zeros(1)]) * factor
    # what has fallen below an opening is counted with the lowest layer, whose voidage may then be below 0
    low, high = (0.0, 1.0) if kind == "phi" else (min(0.0, float(finite.min())), max(float(finite.max()), 1e-12))
    lines = [line(label, None, packed(pack.levels(values[name] * factor, low, high, np.uint16)), n, [5, 3] if n is None else None)
             for name, label, n in names]
    return {"title": title + (f" ({unit})" if unit else ""), "low": low, "high": high, "lines": lines}


def profiles_of(run, factor):
    """Lateral means over height for the slider, for JSON; None without any. factor: of lengths in the page"""
    profiles = run.profiles
    if not profiles or len(profiles["time_s"]) == 0:
        return None
    chosen = thinned(len(profiles["time_s"]), MOST_PROFILES)
    charts = [curves(run, profiles, chosen, "volume fraction", "phi", [("voidage", "voidage")]),
              curves(run, profiles, chosen, "upward velocity", "u", [("u_fluid", "fluid")])]
    charts.append(curves(run, profiles, chosen, "net pressure", "none", [("p", "net pressure")]) if "p" in profiles else
                  curves(run, profiles, chosen, "granular temperature", "theta", []))
    return {"time": plain_numbers(profiles["time_s"][chosen]), "y": plain_numbers(profiles["y_m"] * factor),
            "charts": [chart for chart in charts if chart]}
