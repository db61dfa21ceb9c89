"""The bed over its stored times for a page: maps of the fields, and the particles in three dimensions."""

import numpy as np

from polybed.drawing.maps import outline, ports_of, stored_maps, walls_of
from polybed.drawing.style import FEW_SOLIDS, around_axis, as_shown, colour, faces_across, length_unit
from polybed.texts import fitting
from polybed.particles import step_shown
from polybed.read import kinds_among
from polybed.folder import case_of
from polybed.report.series import EMPTY, changes, levels, packed, plain_numbers, thinned

MOST_CELLS = 40_000  # of one map; a finer one is averaged
MOST_LEVELS = 24_000_000  # of all maps together: bytes before they are compressed
MOST_TEXT = 4_000_000  # characters of all maps, and of all particles
ROUND = 48  # corners of a circle
SUMS = "the size classes of a species are added up; polybed plot RUN --what fields draws each"
FEWEST_STEPS = 12  # of particles; fewer steps are not enough to see a motion: particles are left out instead


def coarse(values, share):
    """Means over share x share cells; cells left at the upper ends are left out."""
    if share == 1:
        return values
    ny, nx = (length // share for length in values.shape)
    return values[: ny * share, : nx * share].reshape(ny, share, nx, share).mean(axis=(1, 3))


def even_rows(run):
    """The cells in each row and each column of a map: rows are as high as the lowest layer, where layers are graded, too, and
    columns as wide as the narrowest cell."""
    def even(faces):
        size = faces[-1] - faces[0]
        count = round(size / np.diff(faces).min())
        return np.searchsorted(faces, faces[0] + (np.arange(count) + 0.5) * size / count) - 1
    return even(run.faces["y"]), even(faces_across(run))


def read_maps(run, chosen, share):
    """The maps [step][y][x] by kind and label."""
    cells, maps = np.ix_(*even_rows(run)), {}
    for step in chosen:
        for key, plane in stored_maps(run, int(step)).items():
            maps.setdefault(key, []).append(coarse(np.ma.filled(as_shown(run, plane), np.nan)[cells], share).astype(np.float32))
    return {key: np.stack(planes) for key, planes in maps.items()}


def scale_of(kind, arrays):
    """(low, high, colours, unit factor and name) that the maps of a kind share."""
    most = max([1e-9] + [float(np.nanmax(np.abs(a))) for a in arrays if np.isfinite(a).any()])
    if kind == "velocity":
        factor, unit = fitting("m/s", most)
        return -most, most, "signed", factor, f"upward velocity ({unit})"
    if kind == "voidage":
        least = min(float(np.nanmin(a)) for a in arrays)
        return min(np.floor(least * 10) / 10, 0.9), 1.0, "fluid", 1.0, "voidage (volume fraction of the fluid)"
    later = max(float(np.nanmax(a[len(a) // 2:])) for a in arrays)  # a packed bed at the start would darken the expanded one
    return 0.0, max(0.1, later), "solids", 1.0, "solids fraction"


def rows_shown(maps):
    """How many rows from the bottom: a fifth above the highest solids of all steps."""
    solids = sum(values for (kind, _), values in maps.items() if kind == "solids")
    count = next(iter(maps.values())).shape[1]
    filled = np.flatnonzero(np.max(np.nan_to_num(solids), axis=(0, 2)) > FEW_SOLIDS) if np.ndim(solids) else []
    return min(count, max(1, int(np.ceil(1.2 * (filled[-1] + 1))))) if len(filled) else count


def maps_of(run):
    """The maps for JSON, with the slider's times; None of a run without fields."""
    first = stored_maps(run, 0) if len(run.time) else {}
    if not first:
        return None
    cells = tuple(map(len, even_rows(run)))
    share = max(1, int(np.ceil(np.sqrt(cells[0] * cells[1] / MOST_CELLS))))
    share = min(share, *cells)
    bytes_of_step = len(first) * (cells[0] // share) * (cells[1] // share)
    chosen = thinned(len(run.time), max(2, MOST_LEVELS // bytes_of_step))
    maps = read_maps(run, chosen, share)
    rows, factor = rows_shown(maps), length_unit(run)[0]
    scales = {kind: scale_of(kind, [values[:, :rows] for (of, _), values in maps.items() if of == kind]) for kind, _ in maps}
    while True:
        found = []
        for (kind, label), values in maps.items():
            low, high, colours, scale, title = scales[kind]
            found.append({"label": label, "kind": kind, "scale": title, "colours": colours, "low": low * scale, "high": high * scale,
                          "levels": packed(levels(values[:, :rows], low, high))})
        if sum(len(one["levels"]) for one in found) <= MOST_TEXT or len(chosen) <= 2:
            break
        kept = thinned(len(chosen), len(chosen) // 2)
        chosen, maps = chosen[kept], {name: values[kept] for name, values in maps.items()}
    ny, nx = next(iter(maps.values())).shape[1:]
    across = faces_across(run)
    size = [float((across[-1] - across[0]) / cells[1] * nx * share * factor), float(run.faces["y"][-1] / cells[0] * rows * share * factor)]
    notes = [f"{len(chosen)} of {len(run.time)} stored times"] if len(chosen) < len(run.time) else []
    notes += [f"each pixel is the mean of {share} x {share} cells"] if share > 1 else []
    notes += ["the plane at half depth"] if run.dimensions == 3 else ["both sides of the axis"] if around_axis(run) else []
    notes += [SUMS] if len(run.kinds) < len(run.species) else []
    if "solids" in scales and any(np.nanmax(values) > 1.1 * scales["solids"][1] for (kind, _), values in maps.items() if kind == "solids"):
        notes.append("the scale of the solids fraction is that of the later half")
    return {"time": plain_numbers(run.time[chosen]), "nx": nx, "ny": rows, "size": size, "maps": found, "note": "; ".join(notes),
            "empty": EMPTY}


def positions_of(run, steps, ids):
    """Places as two-byte shares of the box about the column, [step][particle][axis], 65535 of one that is not there; the box; speeds; species
    and radius of every particle, whenever it is there."""
    shape = len(steps), len(ids)
    place = np.full((*shape, 3), np.nan)
    speed = np.full(shape, np.nan)
    species, radius = np.zeros(len(ids), np.uint8), np.zeros(len(ids))
    for n, step in enumerate(steps):
        at = np.searchsorted(ids, step.id)
        known = np.flatnonzero((at < len(ids)) & (ids[np.minimum(at, len(ids) - 1)] == step.id))
        place[n, at[known]] = step.position[known]
        speed[n, at[known]] = np.sqrt((step.velocity[known] ** 2).sum(axis=1))
        species[at[known]], radius[at[known]] = step.species[known], step.radius[known]
    low = np.minimum(np.nanmin(place, axis=(0, 1), initial=0.0), 0)
    high = np.maximum(np.nanmax(place, axis=(0, 1), initial=0.0), run.particles.size)
    high = np.where(high > low, high, low + 1e-9)
    return levels(place, low, high, np.uint16), low, high, speed, species, radius


def kind_numbers(species):
    """The number of its kind, by the number of a species: size classes share one."""
    return np.array([n for n, classes in enumerate(kinds_among(species).values()) for _ in classes], np.uint8)


def packed_particles(run, chosen, share):
    """Every share-th particle at the chosen steps, as they stand in the page."""
    steps = [run.particles[int(n)] for n in chosen]
    ids = np.unique(np.concatenate([step.id for step in steps]))[::share]
    places, low, high, speed, species, radius = positions_of(run, steps, ids)
    species = kind_numbers(run.particles.species)[species]
    heights = places[..., 1][places[..., 1] != 65535]
    highest = heights.max() / 65534 if len(heights) else 0
    most = float(np.nanquantile(speed, 0.99)) if np.isfinite(speed).any() else 0.0
    most = max(most, 1e-6)
    factor, unit = fitting("m/s", most)
    return {"count": len(ids), "places": packed(changes(places)), "speeds": packed(levels(speed, 0, most)),
            "species": packed(species), "radius": packed((radius * length_unit(run)[0]).astype(np.float32)),
            "low": [float(v) for v in low * length_unit(run)[0]], "high": [float(v) for v in high * length_unit(run)[0]],
            "top": float(low[1] + (high[1] - low[1]) * highest) * length_unit(run)[0], "fastest": f"{most * factor:.3g} {unit}"}


def circle_in(size, diameter, height):
    """A closed line about the axis of a column."""
    return [[(size[0] + diameter * np.cos(angle)) / 2, height, (size[2] + diameter * np.sin(angle)) / 2]
            for angle in np.linspace(0, 2 * np.pi, ROUND, endpoint=False)]


def opening_of(run):
    """The rim of the opening in the bottom as a closed line: of a slot as deep as the column, in 3-D of a round hole; [] without one."""
    case, size = case_of(run.record), run.particles.size
    width = case.get("dem", {}).get("opening")
    if not width:
        return []
    x, half = size[0] / 2, float(width) / 2
    if len(case["column"]["size"]) == 2:
        return [[[x - half, 0, 0], [x + half, 0, 0], [x + half, 0, size[2]], [x - half, 0, size[2]]]]
    return [circle_in(size, float(width), 0)]


def outlines_of_wall(size, start, end, is_round, thickness):
    """Closed lines round a wall inside the column: round both its ends and along it."""
    if not is_round and not thickness:
        return [[[*start, 0], [*end, 0], [*end, size[2]], [*start, size[2]]]]
    if not is_round:
        ends = [[[x, y, z] for x, y in outline(start, end, thickness)] for z in (0, size[2])]
        return ends + [[low, high] for low, high in zip(*(line[::6] for line in ends))]
    lines, along = [], np.array([end[0] / 2 - start[0] / 2, end[1] - start[1]])
    across = np.array([along[1], -along[0]]) / np.hypot(*along) * thickness / 2  # of its profile, from the axis outwards
    for side in (1, -1) if thickness else (1,):
        ends = [circle_in(size, max(point[0] + 2 * side * across[0], 0), point[1] + side * across[1]) for point in (start, end)]
        lines += ends + [[low, high] for low, high in zip(*(line[:: ROUND // 8] for line in ends))]
    return lines


def outlines_of(run):
    """Closed lines round the walls inside the column, the opening and the foot of a round column, [[x, y, z], ...] each, m."""
    size = run.particles.size
    lines = [line for wall in walls_of(run) for line in outlines_of_wall(size, *wall)]
    if case_of(run.record).get("column", {}).get("shape") == "cylinder":
        lines.append(circle_in(size, size[0], 0))
    return [np.array(line, dtype=float).reshape(-1, 3) for line in lines + opening_of(run)]


def outlines_of_ports(run, size):
    """(name, colour, closed line round a port) in a column of a size, on the wall of a round column for one in its side; m."""
    ports = []
    is_round = case_of(run.record).get("column", {}).get("shape") == "cylinder"
    for name, colour, axis, low, high in ports_of(run, size):
        a, b = (n for n in range(3) if n != axis)
        line = np.array([low] * (4 * ROUND))
        there = np.linspace(0, 1, ROUND, endpoint=False)
        line[:, a] = low[a] + (high[a] - low[a]) * np.concatenate([there, np.ones(ROUND), 1 - there, np.zeros(ROUND)])
        line[:, b] = low[b] + (high[b] - low[b]) * np.concatenate([np.zeros(ROUND), there, np.ones(ROUND), 1 - there])
        if is_round and axis != 1:
            other, radius = 2 - axis, size[0] / 2
            reach = np.sqrt(np.maximum(radius**2 - (line[:, other] - radius) ** 2, 0))
            line[:, axis] = radius + (reach if low[axis] > 0 else -reach)
        ports.append((name, colour, line))
    return ports


def particles_of(run):
    """The particles for JSON, with the slider's times; None of a run without any."""
    total = int(run.particles.count.max()) if len(run.particles) else 0
    if total == 0:
        return None
    count, share = len(run.particles), max(1, -(-total * FEWEST_STEPS * 5 // MOST_TEXT))
    chosen = thinned(count, max(FEWEST_STEPS, MOST_TEXT // (3 * max(1, total // share))))
    while True:
        found = packed_particles(run, chosen, share)
        size = sum(len(found[name]) for name in ("places", "speeds", "species", "radius"))
        if size <= MOST_TEXT:
            break
        if len(chosen) > FEWEST_STEPS:
            chosen = chosen[thinned(len(chosen), max(FEWEST_STEPS, len(chosen) * MOST_TEXT // (size + MOST_TEXT // 4)))]
        else:
            share *= 2
    notes = [f"{len(chosen)} of {count} stored times"] if len(chosen) < count else []
    notes += [f"one particle in {share}"] if share > 1 else []
    factor, outlines, names = length_unit(run)[0], outlines_of(run), list(kinds_among(run.particles.species))
    ports = outlines_of_ports(run, run.particles.size)
    size = run.particles.size * factor
    walls = max((float(line[:, 1].max()) * factor for line in outlines + [line for *_, line in ports]), default=0.0)
    size[1] = min(size[1], max(1.1 * found["top"], 0.25 * size[0], walls))  # a bed in a tall column is not to be a strip at the bottom
    return found | {"time": plain_numbers(run.particles.time[chosen]), "open": float(run.particles.time[step_shown(run.particles.count)]),
                    "names": names, "size": [float(v) for v in size],
                    "outlines": [[plain_numbers(point * factor) for point in line] for line in outlines],
                    "ports": [[name, colour, [plain_numbers(point * factor) for point in line]] for name, colour, line in ports],
                    "colours": [colour(n) for n in range(len(names))], "note": "; ".join(notes)}
