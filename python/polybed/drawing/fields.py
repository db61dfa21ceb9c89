"""The fields at one time: volume fraction and vertical velocity of every species and of the fluid."""

import numpy as np

from polybed.drawing.curves import mean_over
from polybed.drawing.maps import Group, draw_maps
from polybed.drawing.style import FEW_SOLIDS, TRACE, greatest_fraction, in_plane, shown_height, title_of
from polybed.drawing.units import fitting

THIN = 0.05  # of the scale of all species, on which less looks like nothing


def stored_maps(run, step, classes=False):
    """Volume fractions of the species, voidage and upward velocities at a stored step, {(kind, label): values [y][x]}; no velocity where a
    species is absent. classes: of sizes one by one, or as one"""
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
