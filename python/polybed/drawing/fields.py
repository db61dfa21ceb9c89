"""The fields at one time: volume fraction and vertical velocity of every species and of the fluid."""

import numpy as np

from polybed.drawing.maps import Group, draw_maps
from polybed.drawing.style import FEW_SOLIDS, TRACE, greatest_fraction, in_plane, shown_height, title_of
from polybed.drawing.units import fitting

THIN = 0.05  # of the scale of all species, on which less looks like nothing


def fractions(run, step, classes=True):
    """Volume fractions of the species, on one scale; classes of sizes one by one, or as one."""
    species = {name: [name] for name in run.species} if classes else run.kinds
    maps = [(name, in_plane(sum(run.field(f"phi_{one}")[step] for one in parts))) for name, parts in species.items()]
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
    maps = []
    for name in [n for n in run.species if f"u_{n}" in run.fields]:
        up = in_plane(run.field(f"u_{name}")[step][..., 1])
        present = in_plane(run.field(f"phi_{name}")[step]) > FEW_SOLIDS
        maps.append((name, np.ma.masked_where(~present, up)))
    if "u_fluid" in run.fields:
        maps.append(("fluid", in_plane(run.field("u_fluid")[step][..., 1])))
    most = max([1e-6] + [float(np.abs(values).max()) for _, values in maps if np.ma.count(values)])
    factor, unit = fitting("m/s", most)
    most = float(f"{most * factor:.2g}")  # two digits on the scale; a colour at its end is not to be read closer
    return Group(f"vertical velocity ({unit})", "RdBu_r", (-most, most), [(name, values * factor) for name, values in maps])


def draw(run, step):
    groups = [*thin_apart(fractions(run, step)), voidages(run, step), velocities(run, step)]
    groups = [group for group in groups if group.maps]
    return draw_maps(run, groups, title_of(run, run.time[step], maps=True), shown_height(run, [step]))[0]
