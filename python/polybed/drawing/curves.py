"""What is drawn as curves, in pictures and in pages: the history of a run in panels, and its profiles over height."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from polybed.drawing.style import FEW_SOLIDS, GREY, drop_over_weight, length_unit, levels, species_line
from polybed.texts import fitting

PARTS = 40  # of the time, over each of which a rate is a mean
STORED = ("kinetic_J", "rotational_J", "elastic_J", "potential_J")
LEDGER = (*STORED, "dissipated_J", "work_J")
CARRIED = {"carried_out_J": 1, "carried_in_J": -1}  # there only where particles can leave, or are fed
# Kinds of profiles: title, unit, and the curve besides the species.
KINDS = {"phi": ("volume fraction", "1", "voidage", "voidage"), "u": ("upward velocity", "m/s", "u_fluid", "fluid"),
         "p": ("net pressure", "Pa", "p", "net pressure"), "theta": ("granular temperature", "m2/s2", "", "")}


def mass_out(history, species):
    """Mass of each species that has left since the start, kg, by name; only of runs that count it, and in which some has left."""
    found = {name: history[f"out_{name}_kg"] for name in species if f"out_{name}_kg" in history}
    return found if any(np.nanmax(values, initial=0) > 0 for values in found.values()) else {}


def recovery(history, species):
    """Share of each species that has left, of all that was there at the start or has been fed since, by name; 0 to 1."""
    found = {}
    for name, out in mass_out(history, species).items():
        fed = history.get(f"in_{name}_kg", np.zeros_like(out))
        there = history[f"mass_{name}_kg"][0] + fed
        found[name] = np.divide(out, there, out=np.full_like(out, np.nan), where=there > 0)
    return found


def discharge_rate(history, species):
    """(times, kg/s): of all species together, means over a fortieth of the time, at its middle; empty where nothing leaves."""
    time, out = history["time_s"], list(mass_out(history, species).values())
    if not out or len(time) < 3:
        return np.empty(0), np.empty(0)
    parts = min(PARTS, len(time) - 1)
    edges = np.linspace(time[0], time[-1], parts + 1)
    mass = np.interp(edges, time, sum(out))
    return (edges[1:] + edges[:-1]) / 2, np.diff(mass) / np.diff(edges)


class Line(NamedTuple):
    label: str
    x: np.ndarray
    y: np.ndarray
    number: int | None = None  # of a species, in its colour
    dash: object = None  # as of matplotlib, of a grey line

    @property
    def looks(self):
        return {"color": GREY, "linestyle": self.dash or "-"} if self.number is None else species_line(self.number)


@dataclass
class Panel:
    """Curves over time on one axis."""

    title: str
    unit: str
    lines: list
    zero: bool = True  # the axis begins at 0
    height: float = 1.0  # relative
    logarithmic: bool = False
    keyed: bool = False  # labels that no other panel has
    note: str = ""
    scale: tuple = ()  # (factor, name) of the unit in which it reads well

    def __post_init__(self):
        self.scale = self.scale or fitting(self.unit, greatest(line.y for line in self.lines))

    @property
    def label(self):
        return self.title + (f" ({self.scale[1]})" if self.scale[1] else "")


def greatest(arrays):
    """The greatest magnitude in arrays that can contain NaN; 0 without any."""
    return max([0.0] + [float(np.nanmax(np.abs(values))) for values in arrays if np.isfinite(values).any()])


def of_species(run, title, unit, values, **more):
    """A panel with a curve for each species in `values`; none without any."""
    t = run.history["time_s"]
    lines = [Line(name, t, values[name], n) for n, name in enumerate(run.kinds) if name in values]
    return [Panel(title, unit, lines, height=1.2, **more)] if lines else []


def heights(run, columns=None):
    """Centres of the species and levels in the bed, of these columns if some are named; in a box without ends the slips instead."""
    history, t = run.history, run.history["time_s"]
    slips = {name: history[f"slip_{name}_m_s"] for name in run.kinds if f"slip_{name}_m_s" in history}
    if slips:
        return of_species(run, "slip of the fluid", "m/s", slips)
    lines = [Line(f"centre of {name}", t, history[f"centre_{name}_m"], n) for n, name in enumerate(run.kinds) if f"centre_{name}_m" in history]
    lines += [Line(label, t, history[column], dash=dash) for column, label, dash in levels(history) if columns is None or column in columns]
    return [Panel("height", "m", lines, height=2.4, scale=length_unit(run))] if lines else []


def balance(run):
    ratio = drop_over_weight(run.history)
    return [] if ratio is None or not np.isfinite(ratio).any() else [Panel("pressure drop over weight", "1", [Line("1: the fluid carries the bed", run.history["time_s"], ratio)],
                                           zero=False, height=1.2)]


def outflow(run):
    history, species = run.history, run.kinds
    time, rate = discharge_rate(history, species)
    return [*of_species(run, "left the column", "kg", mass_out(history, species)),
            *of_species(run, "recovery", "1", recovery(history, species),
                        note="what has left over what was there at the start or has been fed since"),
            *([Panel("discharge rate", "kg/s", [Line("all species", time, rate)], height=1.2)] if len(time) else [])]


def energies(run):
    """What the particles store in motion and in contacts."""
    history = run.history
    found = [Line(name[:-2], history["time_s"], np.where(history[name] > 0, history[name], np.nan), n)
             for n, name in enumerate(STORED[:3]) if name in history]
    return [Panel("energy of the particles", "J", found, height=1.4, logarithmic=True, keyed=True)] if found else []


def ledger(run):
    """Energy since the start: stored, dissipated and carried out, less the work done and what was carried in, is 0."""
    history = run.history
    if not set(LEDGER) <= history.keys():
        return []
    carried = [column for column in CARRIED if column in history]
    since = {column: history[column] - history[column][0] for column in (*LEDGER, *carried)}
    stored = sum(since[column] for column in STORED)
    lines = {"stored": stored, "of it potential": since["potential_J"], "dissipated": since["dissipated_J"],
             "work": since["work_J"], **{column[:-2].replace("_", " "): since[column] for column in carried}}
    left = stored + since["dissipated_J"] - since["work_J"] + sum(CARRIED[column] * since[column] for column in carried)
    return [Panel("energy since the start", "J", [*(Line(name, history["time_s"], values, n) for n, (name, values) in enumerate(lines.items())),
                                                  Line("does not close", history["time_s"], left)], zero=False, height=1.4, keyed=True)]


def panels(run):
    """All panels of the history of a run."""
    history = run.history
    if not len(history.get("time_s", ())):
        return []

    def single(column, title, unit, label="", **more):
        shown = column in history and greatest([history[column]]) > 0
        return [Panel(title, unit, [Line(label or title, history["time_s"], history[column])], **more)] if shown else []

    time_step = [replace(panel, lines=[line._replace(y=np.where(line.y > 0, line.y, np.nan)) for line in panel.lines])
                 for panel in single("dt_s", "time step", "s", logarithmic=True)]
    mixing = single("mixing", "mixing index", "1", "1: mixed, 0: apart") if len(run.species) > 1 else []
    return [*heights(run), *balance(run), *outflow(run), *mixing, *energies(run), *ledger(run), *single("contacts", "contacts", "1"),
            *single("max_overlap_m", "largest overlap", "m"), *time_step]


def mean_over(values, shares):
    """The mean of arrays, one for each size class, weighted with the volume fractions of the classes; 0 where all of these are 0."""
    total = sum(shares)
    weighted = sum(value * share for value, share in zip(values, shares))
    return np.divide(weighted, total, out=np.zeros_like(total), where=total > 0)


def profile_kinds(run):
    """Volume fraction, velocity, and the pressure or, of particles without a fluid, the granular temperature."""
    profiles = run.profiles
    return ("phi", "u", "theta" if "p" not in profiles and any(name.startswith("theta_") for name in profiles) else "p")


def profile_panel(run, kind, rows):
    """A kind of profile at stored times, [time][y], of the fluid and each species; no velocity or temperature where it is absent."""
    profiles, (title, unit, fluid, label) = run.profiles, KINDS[kind]
    height, lines = profiles["y_m"], []
    for n, (species, classes) in enumerate(run.kinds.items()):
        parts, shares = ([profiles[f"{of}_{one}"][rows] for one in classes if f"{of}_{one}" in profiles] for of in (kind, "phi"))
        if len(parts) < len(classes):
            continue
        absent = kind != "phi" and len(shares) == len(parts)
        values = np.where(sum(shares) > FEW_SOLIDS, mean_over(parts, shares), np.nan) if absent else sum(parts)
        lines.append(Line(species, values, height, n))
    lines += [Line(label, profiles[fluid][rows], height)] if fluid in profiles else []
    return Panel(title, unit, lines, scale=fitting(unit, greatest(line.x for line in lines)))
