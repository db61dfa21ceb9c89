"""The run in time: heights, force balance, mixing, energies, contacts, steps; and the worst of every invariant against its limit."""

import functools

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing.style import COLOURS, GREY, PALE, drop_over_weight, fitted, length_unit, levels, species_line, title_of
from polybed.drawing.units import fitting
from polybed.outflow import discharge_rate, mass_out, recovery


def draw_heights(axes, run, factor, unit):
    history = run.history
    t = history["time_s"]
    for n, name in enumerate(run.kinds):
        if f"centre_{name}_m" in history:
            axes.plot(t, history[f"centre_{name}_m"] * factor, label=f"centre of {name}", **species_line(n))
    for column, name, line in levels(history):
        axes.plot(t, history[column] * factor, color=GREY, linestyle=line, linewidth=1, label=name)
    axes.set_ylim(bottom=0)
    axes.set_ylabel(f"height ({unit})")


def draw_force_balance(axes, run, ratio):
    axes.axhline(1, color=PALE, linewidth=0.8, zorder=0)
    axes.plot(run.history["time_s"], ratio, color="black", linewidth=0.8)
    known = ratio[np.isfinite(ratio)]
    if len(known):
        low, high = np.quantile(known, [0.02, 0.98])
        margin = 0.15 * max(high - low, 0.05)
        axes.set_ylim(min(low, 1) - margin, max(high, 1) + margin)
    axes.set_ylabel("pressure drop\n/ weight")


def draw_mixing(axes, run):
    axes.plot(run.history["time_s"], run.history["mixing"], color=COLOURS[2])
    axes.set_ylim(0, 1.05)
    axes.set_ylabel("mixing index")


def draw_steps(axes, run):
    history = run.history
    known = history["dt_s"] > 0
    factor, unit = fitting("s", history["dt_s"].max())
    axes.semilogy(history["time_s"][known], history["dt_s"][known] * factor, color=GREY, linewidth=0.8)
    axes.set_ylabel(f"time step\n({unit})")


LEDGER = ("kinetic_J", "rotational_J", "elastic_J", "potential_J", "dissipated_J", "work_J")
CARRIED = {"carried_out_J": 1, "carried_in_J": -1}  # there only where particles can leave, or are fed


def draw_energies(axes, run):
    """What the particles store in motion and in contacts, on a logarithmic axis."""
    t = run.history["time_s"]
    for n, name in enumerate(("kinetic", "rotational", "elastic")):
        values = run.history[name + "_J"]
        axes.plot(t, np.where(values > 0, values, np.nan), label=name, linewidth=1, **species_line(n))
    axes.set_yscale("log")
    axes.set_ylabel("energy (J)")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)


def draw_ledger(axes, run):
    """Energy since the start: stored, dissipated and carried out, less the work done and what was carried in, is 0."""
    history = run.history
    carried = [column for column in CARRIED if column in history]
    since = {column: history[column] - history[column][0] for column in (*LEDGER, *carried)}
    stored = sum(since[column] for column in LEDGER[:4])
    lines = {"stored": stored, "of it potential": since["potential_J"], "dissipated": since["dissipated_J"],
             "work": since["work_J"], **{column[:-2].replace("_", " "): since[column] for column in carried}}
    for n, (name, values) in enumerate(lines.items()):
        axes.plot(history["time_s"], values, label=name, linewidth=1, **species_line(n))
    left = stored + since["dissipated_J"] - since["work_J"] + sum(CARRIED[column] * since[column] for column in carried)
    axes.plot(history["time_s"], left, color="black", linewidth=0.8, label="does not close")
    axes.set_ylabel("since the\nstart (J)")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)


def draw_series(axes, time, series, unit, label):
    """Quantities in time, from 0 on, in the unit that fits. series: (values, looks of the line)"""
    factor, shown = fitting(unit, max(np.nanmax(values, initial=0) for values, _ in series))
    for values, line in series:
        axes.plot(time, values * factor, **line)
    axes.set_ylim(bottom=0)
    axes.set_ylabel(label + (f" ({shown})" if shown else ""))


def draw_species(axes, run, values, unit, label):
    lines = [(values[name], {"linewidth": 1, **species_line(n)}) for n, name in enumerate(run.kinds) if name in values]
    draw_series(axes, run.history["time_s"], lines, unit, label)


def draw_invariants(axes, run):
    """Worst value over limit on a logarithmic axis; a bar that ends before its mark at 1 has held."""
    entries = [i for i in run.record.get("invariants", []) if i["limit"] > 0]
    least, most = 1e-6, 10
    for n, entry in enumerate(entries):
        share = max(entry["worst"] / entry["limit"], least)
        axes.barh(n, share - least, left=least, height=0.4, color=COLOURS[0] if share <= 1 else COLOURS[1])
        axes.plot([1, 1], [n - 0.28, n + 0.28], color="black", linewidth=1.2)
        text = f"{entry['name']}: {entry['worst']:.1g} of {entry['limit']:.0e}"
        axes.text(least, n - 0.3, text, fontsize=8, va="bottom", ha="left")
    axes.set_xscale("log")
    axes.set_xlim(least, max([most] + [3 * i["worst"] / i["limit"] for i in entries]))
    axes.set_ylim(max(len(entries), 6) - 0.5, -0.8)
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.set_xlabel("worst value of each invariant / its limit")


def panels(run):
    """(relative height, function) of what the history holds."""
    history = run.history
    chosen = [(2.4, lambda axes: draw_heights(axes, run, *length_unit(run)))]
    ratio = drop_over_weight(history)
    if ratio is not None:
        chosen.append((1.2, lambda axes: draw_force_balance(axes, run, ratio)))
    left = mass_out(history, run.kinds)
    if left:
        shares = recovery(history, run.kinds)
        chosen += [(1.2, lambda axes: draw_species(axes, run, left, "kg", "left the\ncolumn")),
                   (1.2, lambda axes: draw_species(axes, run, shares, "1", "recovery"))]
        time, rate = discharge_rate(history, run.kinds)
        if len(time):
            chosen.append((1.2, lambda axes: draw_series(axes, time, [(rate, {"color": GREY, "linewidth": 1})], "kg/s", "discharge\nrate")))
    if "mixing" in history and len(run.species) > 1:
        chosen.append((1, lambda axes: draw_mixing(axes, run)))
    if set(LEDGER[:3]) <= history.keys():
        chosen.append((1.4, lambda axes: draw_energies(axes, run)))
    if set(LEDGER) <= history.keys():
        chosen.append((1.4, lambda axes: draw_ledger(axes, run)))
    for column, unit, label in (("contacts", "1", "contacts"), ("max_overlap_m", "m", "largest\noverlap")):
        if column in history:
            line = (history[column], {"color": GREY, "linewidth": 0.8})
            chosen.append((1, functools.partial(draw_series, time=history["time_s"], series=[line], unit=unit, label=label)))
    if "dt_s" in history and (history["dt_s"] > 0).any():
        chosen.append((1, lambda axes: draw_steps(axes, run)))
    return chosen


def draw(run, time=None):
    """The figure of the whole history; a line marks a time."""
    history = run.history
    if not history or len(history["time_s"]) == 0:
        raise FileNotFoundError(f"{run.directory} has no history yet")
    chosen = panels(run)
    figure = plt.figure(figsize=(10.5, 1.2 + 1.15 * sum(height for height, _ in chosen)), constrained_layout=True)
    held = run.record.get("invariants") and len(chosen) > 1
    heights = [height for height, _ in chosen]
    grid = figure.add_gridspec(len(chosen), 1 + bool(held), width_ratios=[2.2, 1] if held else [1], height_ratios=heights)
    first = None
    for n, (_, draw_one) in enumerate(chosen):
        axes = figure.add_subplot(grid[n, 0], sharex=first)
        first = first or axes
        draw_one(axes)
        if time is not None:
            axes.axvline(time, color=PALE, linewidth=0.8, zorder=0)
        axes.tick_params(labelbottom=n == len(chosen) - 1)
    axes.set_xlabel("time (s)")
    t = history["time_s"]
    first.set_xlim(t[0], t[-1] if t[-1] > t[0] else t[0] + 1)
    if held:
        side = figure.add_subplot(grid[0, 1])
        side.set_axis_off()
        side.legend(*first.get_legend_handles_labels(), loc="center left", fontsize=9)
        draw_invariants(figure.add_subplot(grid[1:, 1]), run)
    else:
        first.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)
    figure.suptitle(fitted(title_of(run), figure, 10), fontsize=10)
    return figure
