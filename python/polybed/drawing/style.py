"""What all pictures share: colours, units, names, and the plane and the height that are shown.

Colours of the species after Okabe and Ito (2008), distinct for any kind of colour vision; maps
of one sign are viridis and cividis, maps of two signs red and blue, of equal lightness on both sides.
"""

import itertools

import matplotlib

matplotlib.use("Agg")
import numpy as np

from polybed.files import DamagedError
from polybed.quantities import LEVELS
from polybed.folder import case_of, title_of_case

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
NAMES = {"tfm": "two-fluid", "dem": "particles"}  # of the models, side by side
LINES = ["-", "--", "-."]  # beyond six species the colours repeat with another line
LEVEL_LINES = ["--", ":", "-.", (0, (5, 1, 1, 1, 1, 1))]  # of levels in the bed
TITLE = 90  # characters of a title in a picture
GREY = "#555555"
PALE = "#bbbbbb"
EMPTY = "#eeeeee"  # of a map where there is nothing to show
STYLE = {
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "axes.grid": False,
    "savefig.dpi": 160,
    "figure.dpi": 160,
    "svg.hashsalt": "polybed",  # the same picture gives the same file
}
FEW_SOLIDS = 0.01  # a volume fraction below which a place counts as empty
TRACE = 1e-5  # below which nothing is suspended


def colour(n):
    return COLOURS[n % len(COLOURS)]


def species_line(n):
    """Colour and line of the species number n."""
    return {"color": colour(n), "linestyle": LINES[n // len(COLOURS) % len(LINES)]}


def levels(history):
    """(column, label, line) of each level with values in a history: bed height, interface of two species (three have more than one), ..."""
    lines = dict(zip(LEVELS, itertools.cycle(LEVEL_LINES)))
    species = sum(column.startswith("centre_") for column in history)
    return [(column, label, lines[column]) for column, label in LEVELS.items()
            if not np.isnan(history.get(column, np.nan)).all() and not (column == "interface_m" and species > 2)]


def drop_over_weight(history):
    """Pressure drop over the buoyant weight, 1 where the fluid carries the bed; None of particles without a fluid, which have no pressure."""
    if not {"pressure_drop_Pa", "buoyant_weight_Pa"} <= history.keys() or not np.any(history["pressure_drop_Pa"] != 0):
        return None
    weight = history["buoyant_weight_Pa"]
    return np.divide(history["pressure_drop_Pa"], weight, out=np.full_like(weight, np.nan), where=weight != 0)


def length_unit(run):
    """(factor, name) of the unit in which lengths of a run read well."""
    return (1e3, "mm") if run.size[1] < 2 else (1.0, "m")


def in_plane(field):
    """A field without components as [y][x]: of a 3-D run the plane at half depth."""
    return field[field.shape[0] // 2] if field.ndim == 3 else field


def around_axis(run):
    """Whether a run stores one side of a round column, from its axis to the wall."""
    try:
        return case_of(run.record).get("column", {}).get("shape") == "axisymmetric"
    except DamagedError:
        return False


def as_shown(run, plane):
    """Values [y][x] as a map shows them: nothing beyond the wall, and both sides of an axis."""
    if run.open is not None:
        plane = np.ma.masked_where(in_plane(run.open) == 0, plane)
    if not around_axis(run):
        return plane
    return (np.ma if np.ma.isMaskedArray(plane) else np).hstack([plane[:, ::-1], plane])


def faces_across(run):
    """Faces of the cells from wall to wall, m; 0 is the axis of a run around one."""
    x = run.faces["x"] if run.faces else np.array([0, run.size[0]])
    return np.concatenate([-x[:0:-1], x]) if around_axis(run) else x


def shown_height(run, steps):
    """Top of the maps, m: a fifth above the highest solids of the steps, so that a bed in a tall column is not a
    strip at the bottom; never above the column. What is suspended thinly counts, too, but for traces."""
    faces, top = run.faces["y"], 0
    for step in steps:
        each = [in_plane(run.field(f"phi_{name}")[step]).max(axis=1) for name in run.species]
        for phi in each:
            rows = np.flatnonzero((sum(each) > FEW_SOLIDS) | (phi > max(0.05 * phi.max(), TRACE)))
            top = max(top, faces[rows[-1] + 1] if len(rows) else 0)
    return min(1.2 * top, faces[-1]) if top > 0 else faces[-1]


def greatest_fraction(run, steps):
    """Upper end of the scale that all species share."""
    return max([0.1] + [float(run.field(f"phi_{name}")[step].max()) for name in run.species for step in steps])


def shortened(text):
    """A title that fits above a picture, as plain text: nothing in it is read as mathematics."""
    plain = " ".join(text.split()).replace("$", r"\$")
    return plain if len(plain) <= TITLE else plain[: TITLE - 1].rstrip() + "\u2026"


def fitted(title, figure, size):
    """A title that fits above a figure, in letters of a size in points: in two lines if need be, a name that is too long cut."""
    letters = int(figure.get_figwidth() * 72 / (0.56 * size))  # of the mean width of DejaVu Sans
    name, gap, rest = title.partition("   ")
    if len(title) <= letters or not gap:
        return title
    return (name if len(name) <= letters else name[: letters - 1].rstrip() + "\u2026") + "\n" + rest


def title_of(run, time=None, maps=False, digits=".4g"):
    """What a picture shows, in one line; maps of a 3-D run are marked as one plane of it."""
    model = {"tfm": "two-fluid model", "dem": "discrete particles"}.get(run.record.get("model"), "")
    state = run.record.get("state", "done")
    parts = [shortened(title_of_case(run.record) or run.directory.resolve().name), model, "" if time is None else f"t = {time:{digits}} s",
             "" if state == "done" else state.split(":")[0]]
    if maps and run.dimensions == 3:
        parts.append("plane at half depth")
    return "   ".join(part for part in parts if part)
