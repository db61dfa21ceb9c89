"""Maps of a column, side by side: equal aspect, one colour scale for each group of maps, sizes in inches; and the fields at one time."""

from dataclasses import dataclass, field

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing.curves import mean_over
from polybed.drawing.style import (EMPTY, FEW_SOLIDS, TRACE, around_axis, as_shown, faces_across, fitted, greatest_fraction, in_plane, length_unit,
                                   shown_height, title_of)
from polybed.files import DamagedError
from polybed.folder import case_of
from polybed.texts import fitting

HEIGHT, HEIGHT_IN_ROWS = 5.0, 3.4  # inches, the most, of maps in one row and in several
WIDEST = 12.0  # inches, a row of maps
WIDTHS = (0.8, 3.2)  # inches, least and most
LEFT, RIGHT, HEAD, BARS, GAP, GROUP_GAP = 0.75, 0.3, 0.75, 1.05, 0.32, 0.6


@dataclass
class Group:
    """Maps that share a colour scale."""

    label: str  # of the scale, with its unit
    colours: str
    limits: tuple
    maps: list = field(default_factory=list)  # (title, values [y][x])


def map_size(run, top, most, widths=WIDTHS):
    """Width and height of one map, inches."""
    aspect = run.size[0] * (2 if around_axis(run) else 1) / top
    width = float(np.clip(most * aspect, *widths))
    return width, min(most, width / aspect)


def axes_at(figure, left, bottom, width, height):
    """Axes at a place in inches."""
    across, high = figure.get_size_inches()
    return figure.add_axes((left / across, bottom / high, width / across, height / high))


def walls_of(run):
    """The walls inside the column and the side of a tapered one, (start, end, round, thickness): x and y of the ends of a flat one, diameter
    and height of a round one, m. The ends of a rod are one point."""
    try:
        case = case_of(run.record)
        side = [[diameter, height] for height, diameter in case.get("column", {}).get("profile", [])]
        inside = [(wall["from"], wall.get("to") or wall["from"], wall.get("shape") in ("cylinder", "cone"), float(wall.get("thickness", 0)))
                  for wall in case.get("wall", [])]
        return inside + [(low, high, True, 0.0) for low, high in zip(side, side[1:])]
    except DamagedError:
        return []


def outline(start, end, thickness, corners=24):
    """All points within half a thickness of a line: a closed line round them, [[x, y], ...]; the line itself without thickness."""
    start, end = np.array(start, dtype=float), np.array(end, dtype=float)
    if not thickness:
        return np.array([start, end])
    angles = np.arctan2(*(end - start)[::-1]) + np.linspace(-np.pi / 2, np.pi / 2, corners)
    half = thickness / 2 * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.vstack([end + half, start - half, end + half[:1]])


def inner_walls(run):
    """Lines in which the walls inside the column cut the plane of x and y in its middle, [[x, y], ...] each, m; closed round a thick one."""
    lines, axis = [], 0 if around_axis(run) else run.size[0] / 2
    for start, end, is_round, thickness in walls_of(run):
        ends = [[(axis + side * point[0] / 2, point[1]) for point in (start, end)] for side in (-1, 1)] if is_round else [(start, end)]
        lines += [outline(*pair, thickness) for pair in ends]
    return lines


PORTS = {"jet": "#0072b2", "feed": "#009e73", "discharge": "#d55e00"}
FACES = {"left": (0, 0), "right": (0, 1), "bottom": (1, 0), "top": (1, 1), "front": (2, 0), "back": (2, 1)}  # axis, side


def ports_of(run, size):
    """Jets, feeds and discharges with their place on the sides of a column of a size, (name, colour, axis, least and greatest corner in m)."""
    try:
        case = case_of(run.record)
    except DamagedError:
        return []
    flat, found = len(case.get("column", {}).get("size", size)) == 2, []
    for kind, colour in PORTS.items():
        for number, port in enumerate(case.get(kind, []), 1):
            axis, side = FACES[port.get("at", "bottom")]
            low, high = np.zeros(len(size)), np.array(size, dtype=float)
            low[axis] = high[axis] = side * size[axis] if axis < len(size) else 0
            along = [a for a in ((2, 1), (0, 2), (0, 1))[axis] if a < (2 if flat else 3)]
            for a, least, most in zip(along, port.get("from", []), port.get("to", [])):
                if a < len(size):
                    low[a], high[a] = least, most
            found.append((f"{kind}{number}", colour, axis, low, high))
    return found


def draw_ports(axes, run):
    """Ports in colour with their names: a bar on the wall, or the outline of one in front or behind; on both sides of an axis."""
    factor = length_unit(run)[0]
    for name, colour, axis, low, high in ports_of(run, run.size[:2]):
        x, y = np.array([low[0], high[0]]) * factor, np.array([low[1], high[1]]) * factor
        for across in (x, -x) if around_axis(run) else (x,):
            corners = (across[[0, 1, 1, 0, 0]], y[[0, 0, 1, 1, 0]]) if axis == 2 else (across, y)
            axes.plot(*corners, color=colour, linewidth=1 if axis == 2 else 7, solid_capstyle="butt", zorder=4)
        right = 2 * x.mean() > sum(axes.get_xlim())
        axes.annotate(name, (x.max() if right else x.min(), y.max()), (-4 if right else 4, 2), textcoords="offset points", color=colour,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.8}, fontsize=6, ha="right" if right else "left", zorder=5, annotation_clip=True)


def frame(axes, run, title, top, first):
    """Axes that show the column up to a height, to scale, in the unit of the run."""
    factor, unit = length_unit(run)
    faces = faces_across(run) * factor
    axes.set(aspect="equal", title=title, xlabel=f"{'r' if faces[0] < 0 else 'x'} ({unit})", ylim=(0, top * factor))
    axes.set_xlim(faces[0], faces[-1])
    axes.set_xticks([faces[0], faces[-1]], [f"{faces[0]:g}", f"{faces[-1]:g}"])
    axes.spines[["top", "right"]].set_visible(True)
    for line in inner_walls(run):
        if len(line) > 2:
            axes.fill(*(factor * line.T), color=EMPTY, zorder=2)
        axes.plot(*(factor * line.T), color="black", linewidth=1)
    draw_ports(axes, run)
    if first:
        axes.set_ylabel(f"y ({unit})")
    else:
        axes.tick_params(labelleft=False)


def draw_map(axes, run, group, title, values, top, first):
    """One map in the unit of the run, and its mesh."""
    factor = length_unit(run)[0]
    colours = plt.get_cmap(group.colours).with_extremes(bad=EMPTY)
    mesh = axes.pcolormesh(faces_across(run) * factor, run.faces["y"] * factor, as_shown(run, values), rasterized=True, cmap=colours,
                           vmin=group.limits[0], vmax=group.limits[1])
    frame(axes, run, title, top, first)
    return mesh


def draw_scale(axes, colours, ticks, labels, title, extend="neither", **words):
    """A colour scale. extend: as of matplotlib; words: how the title is written"""
    bar = axes.figure.colorbar(colours, cax=axes, orientation="horizontal", extend=extend)
    bar.set_ticks(ticks, labels=labels)
    bar.set_label(title, **words)
    bar.outline.set_linewidth(0.5)


def draw_bar(mesh, axes, group):
    """The colour scale of a group, below its maps, with the ends and the middle told."""
    low, high = group.limits
    ticks = [low, (low + high) / 2, high]
    draw_scale(axes, mesh, ticks, [f"{value:.3g}" for value in ticks], group.label)


def wrapped(groups, width):
    """Groups side by side, in a new row where the widest row is full."""
    rows, filled = [[]], 0
    for group in groups:
        wide = len(group.maps) * (width + GAP) + GROUP_GAP
        if rows[-1] and filled + wide > WIDEST:
            rows.append([])
            filled = 0
        rows[-1].append(group)
        filled += wide
    return rows


def draw_maps(run, groups, title, top):
    """The figure of groups of maps up to a height; and the meshes, group by group, map by map."""
    size = map_size(run, top, HEIGHT)
    rows = wrapped(groups, size[0])
    if len(rows) > 1:
        size = map_size(run, top, HEIGHT_IN_ROWS)
        rows = wrapped(groups, size[0])
    span = [sum(len(g.maps) * (size[0] + GAP) - GAP for g in row) + GROUP_GAP * (len(row) - 1) for row in rows]
    width = max(LEFT + max(span) + RIGHT, 4.2)
    height = HEAD + len(rows) * (size[1] + BARS) + (len(rows) - 1) * 0.35
    figure = plt.figure(figsize=(width, height))
    meshes, base = [], height - HEAD
    for row in rows:
        base -= size[1]
        x = max(LEFT, (width - max(span)) / 2)
        for number, group in enumerate(row):
            begin = x
            meshes.append([])
            for n, (name, values) in enumerate(group.maps):
                first = number == 0 and n == 0
                meshes[-1].append(draw_map(axes_at(figure, x, base, *size), run, group, name, values, top, first))
                x += size[0] + GAP
            draw_bar(meshes[-1][0], axes_at(figure, begin, base - 0.6, x - GAP - begin, 0.1), group)
            x += GROUP_GAP - GAP
        base -= BARS + 0.35
    figure.suptitle(fitted(title, figure, 10), y=1 - 0.12 / height, fontsize=10)
    return figure, meshes


THIN = 0.05  # of the scale of all species, on which less looks like nothing


def stored_maps(run, step, classes=False):
    """Fractions, voidage and upward velocities at a step, {(kind, label): [y][x]}; NaN without a species. classes: one by one"""
    names = [name for name in run.fields if name.startswith(("phi_", "u_")) or name == "voidage"]
    stored = {name: in_plane(values[..., 1] if name.startswith("u_") else values) for name, values in run.fields_at(step, names).items()}
    species = {name: [name] for name in run.species} if classes else run.kinds
    solids = {name: [stored[f"phi_{one}"] for one in parts] for name, parts in species.items() if f"phi_{parts[0]}" in stored}
    found = {("solids", name): sum(parts) for name, parts in solids.items()}
    found |= {("voidage", "fluid"): stored["voidage"]} if "voidage" in stored else {}
    for name, parts in solids.items():
        if f"u_{species[name][0]}" in stored:
            mean = mean_over([stored[f"u_{one}"] for one in species[name]], parts)
            found["velocity", name] = np.where(sum(parts) > FEW_SOLIDS, mean, np.nan)
    return found | ({("velocity", "fluid"): stored["u_fluid"]} if "u_fluid" in stored else {})


def fractions(run, step, classes=True):
    """Volume fractions of the species, on one scale; classes of sizes one by one, or as one."""
    maps = [(label, values) for (kind, label), values in stored_maps(run, step, classes).items() if kind == "solids"]
    most = max([greatest_fraction(run, [step])] + [float(values.max()) for _, values in maps])
    return Group("solids fraction", "viridis", (0, most), maps)


def thin_apart(group):
    """A group, and for each species that is suspended so thinly that its map would look empty a group with a scale of its own."""
    thin = [TRACE < values.max() < THIN * group.limits[1] for _, values in group.maps]
    group_of = {own: [one for one, is_thin in zip(group.maps, thin) if is_thin == own] for own in (False, True)}
    own = [Group(group.label, group.colours, (0, float(one[1].max())), [one]) for one in group_of[True]]
    return [Group(group.label, group.colours, group.limits, group_of[False]), *own]


def voidages(run, step):
    """The volume fraction of the fluid, on its own scale, since it is never small."""
    voidage = in_plane(run.field("voidage")[step])
    return Group("voidage", "cividis", (min(np.floor(float(voidage.min()) * 10) / 10, 0.9), 1), [("fluid", voidage)])


def velocities(run, step):
    """Vertical velocities on one symmetric scale; where a species is absent it has none to show."""
    maps = [(label, np.ma.masked_invalid(values)) for (kind, label), values in stored_maps(run, step, True).items() if kind == "velocity"]
    most = max([1e-6] + [float(np.abs(values).max()) for _, values in maps if np.ma.count(values)])
    factor, unit = fitting("m/s", most)
    most = float(f"{most * factor:.2g}")  # two digits on the scale; a colour at its end is not to be read closer
    return Group(f"vertical velocity ({unit})", "RdBu_r", (-most, most), [(name, values * factor) for name, values in maps])


def draw(run, step):
    groups = [*thin_apart(fractions(run, step)), voidages(run, step), velocities(run, step)]
    groups = [group for group in groups if group.maps]
    return draw_maps(run, groups, title_of(run, run.time[step], maps=True), shown_height(run, [step]))[0]
