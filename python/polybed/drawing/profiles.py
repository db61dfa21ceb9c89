"""Lateral means on the vertical axis: at one time beside each other, and of each species over height and time."""

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing.style import EMPTY, FEW_SOLIDS, GREY, PALE, fitted, length_unit, levels, species_line, title_of
from polybed.drawing.units import fitting
from polybed.read import nearest


def value_at(run, column, time):
    """A column of the history at the time nearest; None where it has no value."""
    history = run.history
    if column not in history or len(history["time_s"]) == 0:
        return None
    value = history[column][nearest(history["time_s"], time)]
    return None if np.isnan(value) else value


def mark_levels(axes, run, time, factor, named):
    for column, name, line in levels(run.history):
        level = value_at(run, column, time)
        if level is None:
            continue
        axes.axhline(level * factor, color=GREY, linestyle=line, linewidth=1, zorder=0, label=name if named else None)


def draw_quantity(axes, run, row, kind, factor, scale=1.0):
    """One quantity of every species; neither velocity nor temperature where the species is absent."""
    profiles, height = run.profiles, run.profiles["y_m"] * factor
    for n, name in enumerate(run.species):
        if f"{kind}_{name}" not in profiles:
            continue
        values = profiles[f"{kind}_{name}"][row] * scale
        if kind != "phi":
            values = np.where(profiles[f"phi_{name}"][row] > FEW_SOLIDS, values, np.nan)
        axes.plot(values, height, label=name, **species_line(n))


def draw_fractions(axes, run, row, factor):
    draw_quantity(axes, run, row, "phi", factor)
    if "voidage" in run.profiles:
        axes.plot(run.profiles["voidage"][row], run.profiles["y_m"] * factor, color=GREY, linewidth=1, label="voidage")
    axes.set_xlim(0, 1)
    axes.set_xlabel("volume fraction")


def greatest(run, row, kind):
    """The greatest magnitude of a quantity at a stored time, of all species and the fluid; 0 without any."""
    values = [np.abs(profile[row]) for name, profile in run.profiles.items() if name.startswith(f"{kind}_")]
    return max([0.0] + [float(np.nanmax(v)) for v in values if np.isfinite(v).any()])


def draw_velocities(axes, run, row, factor):
    scale, unit = fitting("m/s", greatest(run, row, "u"))
    draw_quantity(axes, run, row, "u", factor, scale)
    if "u_fluid" in run.profiles:
        height = run.profiles["y_m"] * factor
        axes.plot(run.profiles["u_fluid"][row] * scale, height, color="black", linestyle=(0, (3, 1)), linewidth=1, label="fluid")
    axes.axvline(0, color=PALE, linewidth=0.8, zorder=0)
    most = max(1e-3, 1.1 * max(np.abs(axes.get_xlim())))
    axes.set_xlim(-most, most)
    axes.set_xlabel(f"mean vertical velocity ({unit})")


def draw_pressure(axes, run, row, factor):
    weight = value_at(run, "buoyant_weight_Pa", run.profiles["time_s"][row])
    scale, unit = fitting("Pa", max(weight or 0, float(np.nanmax(np.abs(run.profiles["p"][row]))) if "p" in run.profiles else 0))
    if "p" in run.profiles:
        axes.plot(run.profiles["p"][row] * scale, run.profiles["y_m"] * factor, color="black")
    if weight is not None:
        axes.axvline(weight * scale, color=GREY, linestyle="-.", linewidth=1, label="buoyant weight")
    axes.set_xlim(left=min(0, axes.get_xlim()[0]))
    axes.set_xlabel(f"net pressure ({unit})")


def draw_temperature(axes, run, row, factor):
    scale, unit = fitting("m2/s2", greatest(run, row, "theta"))
    draw_quantity(axes, run, row, "theta", factor, scale)
    axes.set_xlim(0, max(1e-3, axes.get_xlim()[1]))  # of particles that move as one there is only rounding
    axes.set_xlabel(f"granular temperature ({unit})")


def edges(centres):
    """Ends of intervals around centres, for a map of rows stored at times that need not be even."""
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    middle = (centres[1:] + centres[:-1]) / 2
    return np.concatenate([[centres[0]], middle, [centres[-1]]])


def draw_in_time(axes, run, name, most, factor, time):
    """Volume fraction of a species over time and height, with the levels in the bed."""
    profiles, history = run.profiles, run.history
    y = profiles["y_m"]
    half = (y[1] - y[0]) / 2 if len(y) > 1 else y[0]
    faces = np.append(y - half, y[-1] + half) * factor
    axes.set_facecolor(EMPTY)
    mesh = axes.pcolormesh(
        edges(profiles["time_s"]), faces, profiles[f"phi_{name}"].T, cmap="viridis", vmin=0, vmax=most, rasterized=True
    )
    for column, _, line in levels(history):
        axes.plot(history["time_s"], history[column] * factor, color="white", linestyle=line, linewidth=1)
    axes.axvline(time, color="white", linewidth=0.6)
    axes.set_title(f"{name}: solids fraction in time")
    axes.set_xlabel("time (s)")
    return mesh


def shown_top(run):
    """Top of the profiles, m: a fifth above the highest mean fraction worth showing at any time."""
    profiles = run.profiles
    solids = sum(profiles[f"phi_{name}"] for name in run.species)
    rows = np.flatnonzero((np.atleast_2d(solids) > FEW_SOLIDS).any(axis=0))
    y = profiles["y_m"]
    return min(1.2 * y[rows[-1]], y[-1]) if len(rows) else y[-1]


def draw(run, time):
    """The figure of the profiles stored nearest to a time, above what came before and after."""
    profiles = run.profiles
    if not profiles or len(profiles["time_s"]) == 0:
        raise FileNotFoundError(f"{run.directory} has no stored profiles yet")
    factor, unit = length_unit(run)
    row = nearest(profiles["time_s"], time)
    shown = [name for name in run.species if f"phi_{name}" in profiles]
    figure = plt.figure(figsize=(10, 7.4), constrained_layout=True)
    upper, lower = figure.subfigures(2, 1, height_ratios=[1.15, 1])
    grid = upper.add_gridspec(1, 4, width_ratios=[1, 1, 1, 0.42])
    axes = [upper.add_subplot(grid[0])]
    axes += [upper.add_subplot(grid[n], sharey=axes[0]) for n in (1, 2)]
    time = profiles["time_s"][row]
    alone = "p" not in profiles and any(name.startswith("theta_") for name in profiles)  # particles without a fluid
    third = draw_temperature if alone else draw_pressure
    for ax, draw_one in zip(axes, (draw_fractions, draw_velocities, third)):
        draw_one(ax, run, row, factor)
        mark_levels(ax, run, time, factor, named=ax is axes[0])
    axes[0].set_ylabel(f"height y ({unit})")
    axes[0].set_ylim(0, shown_top(run) * factor)
    for ax in axes[1:]:
        ax.tick_params(labelleft=False)
    side = upper.add_subplot(grid[3])
    side.set_axis_off()
    lines = {label: line for ax in axes for line, label in zip(*ax.get_legend_handles_labels())}
    side.legend(lines.values(), lines.keys(), loc="center left")
    most = max(0.1, max(float(profiles[f"phi_{name}"].max()) for name in shown))
    below = lower.subplots(1, len(shown), sharey=True, squeeze=False)[0]
    for ax, name in zip(below, shown):
        mesh = draw_in_time(ax, run, name, most, factor, time)
    below[0].set_ylabel(f"height y ({unit})")
    below[0].set_ylim(0, shown_top(run) * factor)
    lower.colorbar(mesh, ax=list(below), pad=0.01).set_label("solids fraction")
    figure.suptitle(fitted(title_of(run, time) + "   lateral means", figure, 10), fontsize=10)
    return figure
