"""Table and picture of what pareto_b.py found: answers against the seconds for a simulated second that they took."""
import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import pareto_plan as plan
from polybed.drawing.style import COLOURS, GREY, PALE, STYLE

MARKS = {plan.BALANCE: ("*", GREY), plan.FLAT: ("v", COLOURS[4]), plan.GRID: ("s", COLOURS[0]), plan.SCHEME: ("o", COLOURS[5]),
         plan.LAW: ("D", COLOURS[1]), plan.STRESS: ("P", COLOURS[2]), plan.BOTH: ("X", PALE), plan.PARTICLES: ("h", COLOURS[3])}
NO_RUN = 2e-3  # s for a simulated second, where answers without a run are drawn
MEASURED = 30.0  # mm/s, inversion in the experiment of Matsuura and Akehata (1985)
REFERENCES = ("E 0.03 MPa", "E 0.1 MPa")  # particles with two stiffnesses of contacts


def rate(part):
    """Weighed work for a simulated second, s; 0 of an answer without a run."""
    return part["work_s"] / part["simulated_s"] if part.get("simulated_s") else 0.0


def value(row, quantity):
    """(value, half-width of what it is known by, mm or mm/s, the part of the row that has it), or nothing."""
    found = row.get("inversion" if quantity == "mm_s" else "height")
    if not found or found.get(quantity) is None:
        return None
    if quantity != "mm_s":
        return found[quantity], found[quantity.replace("_mm", "_ci_mm")], found
    return found["mm_s"], 0.0 if found["state"] == "exact" else (found["high_mm_s"] - found["low_mm_s"]) / 2, found


def reference(rows, quantity="common_height_mm"):
    """Mean of these runs of particles and its half-width: of each run's mean or of half what they differ by, the wider."""
    found = [value(row, quantity) for row in rows if row["name"] in REFERENCES and value(row, quantity)]
    if not found:
        return None
    values = [f[0] for f in found]
    return sum(values) / len(values), max(*(f[1] for f in found), (max(values) - min(values)) / 2)


def ranked(row, quantity):
    """Particles are followed with one drag law: by another a continuum may come near to them for a wrong reason."""
    return quantity == "mm_s" or row["settings"].get("effects.drag", "cello") == "cello"


def front(points):
    """Numbers of the points that no other beats in both cost and deviation. points: (cost, deviation)"""
    return [n for n, (cost, off) in enumerate(points)
            if not any(c <= cost and o <= off and (c, o) != (cost, off) for c, o in points)]


def rounded(item):
    """Numbers to six digits, lists and tables within."""
    if isinstance(item, float):
        return float(f"{item:.6g}")
    if isinstance(item, dict):
        return {key: rounded(each) for key, each in item.items()}
    return [rounded(each) for each in item] if isinstance(item, (list, tuple)) else item


def json_text(rows):
    """The results as JSON, a line for each row."""
    head = {"filetype": "polybed pareto of system B", "version": 1, "case": "cases/quarter-b/case.toml", "bed": plan.BED,
            "velocity_m_s": plan.VELOCITY, "turning_time_s": plan.TURNING_TIME}
    lines = ",\n".join(json.dumps(rounded(row)) for row in rows)
    return json.dumps(head)[:-1] + ', "rows": [\n' + lines + "\n]}\n"


def height_cells(row, against):
    """s by work and by CPU; bed height, its distance from the reference and the layers at the common time; height and layers at the end."""
    found = row.get("height")
    if not found:
        return ["-"] * 7
    if found["state"] != "done":
        return ["-", "-", found["state"], "-", "-", "-", "-"]
    off = "-" if against is None else f"{100 * (found['common_height_mm'] / against[0] - 1):+.1f}"
    if not found["simulated_s"]:
        height = f"{found['bed_height_mm']:.1f} (mixed {found['mixture_mm']:.1f})"
        return ["no run", "no run", height, off, f"{found['apart_mm']:.1f}", "-", "-"]
    clocks = [f"{rate(found):.3g}", f"{found['cpu_s'] / found['simulated_s']:.3g}"]
    common = [plus_minus(found, "common_height"), off, plus_minus(found, "common_apart")]
    last = plus_minus(found, "bed_height") + (f", {found['drift_mm_s']:+.2f} mm/s" if drifts(found) else "")
    last += ", an invariant broken" if found["broken"] else ""
    return [*clocks, *common, last, plus_minus(found, "apart")]


def plus_minus(found, name):
    return f"{found[name + '_mm']:.1f} ± {found[name + '_ci_mm']:.1f}"


def drifts(found):
    """Whether the bed would move by more than one per cent in another window."""
    return abs(found["drift_mm_s"]) * 0.25 * found["simulated_s"] > 0.01 * found["bed_height_mm"]


def inversion_cells(row):
    """The inversion velocity with what it is known by, and the CPU time of all its runs."""
    found = row.get("inversion")
    if not found:
        return ["-", "-"]
    if found["state"] in ("failed", "refused"):
        return [found["state"], "-"]
    if found["state"] == "exact":
        return [f"{found['mm_s']:.2f}", "-"]
    runs = f"{found['cpu_s']:.0f} ({found['runs']})" if "runs" in found else "-"
    if found["mm_s"] is None:
        low, high = found.get("low_mm_s"), found.get("high_mm_s")
        return [f"above {low:.0f}" if low and not high else f"below {high:.0f}" if high and not low else "not known", runs]
    return [f"{found['mm_s']:.1f} ({found['low_mm_s']:.0f} to {found['high_mm_s']:.0f})", runs]


def table(rows):
    """Lines of a table of all rows."""
    against = reference(rows)
    begin, end = plan.COMMON
    head = ["level", "setting", "s/s by work", "s/s by CPU", f"bed height at {begin:g} to {end:g} s, mm", "off, %", "coarse over fine, mm",
            "bed height at the end, mm", "coarse over fine, mm", "inversion, mm/s", "CPU s (runs)"]
    lines = ["| " + " | ".join(head) + " |", "| --- | --- |" + " ---: |" * (len(head) - 2)]
    for row in rows:
        cells = [row["level"], f"`{row['name']}`", *height_cells(row, against), *inversion_cells(row)]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def line(row):
    return "  ".join([row["level"], row["name"], *height_cells(row, None), *inversion_cells(row)])


def draw_panel(axes, rows, quantity, target):
    """One point each setting, hollow where it is not ranked, and the front towards the target."""
    shown = [(row, max(rate(found[2]), NO_RUN), found[0], found[1]) for row in rows if (found := value(row, quantity))]
    for level, (mark, colour) in MARKS.items():
        of_level = [p for p in shown if p[0]["level"] == level]
        for row, cost, mean, ci in sorted(of_level, key=lambda p: ranked(p[0], quantity)):
            axes.errorbar([cost], [mean], [ci], fmt=mark, color=colour, markersize=9 if mark in "*h" else 5, elinewidth=0.7, label=level,
                          markerfacecolor=colour if ranked(row, quantity) else "white", markeredgecolor="black", markeredgewidth=0.4)
    counted = [p for p in shown if ranked(p[0], quantity)]
    if target:
        best = sorted((counted[n] for n in front([(p[1], abs(p[2] - target)) for p in counted])), key=lambda p: p[1])
        axes.plot([p[1] for p in best], [p[2] for p in best], color="black", lw=1.5, alpha=0.5, zorder=0, label="front")
    axes.set(xscale="log", xlabel="s for a simulated second, by work (left edge: no run)", xlim=(0.7 * NO_RUN, None))


def bounds(axes, rows):
    """Arrows where the inversion lies beyond the velocities that were run."""
    for row in rows:
        found = row.get("inversion")
        if found and found.get("mm_s") is None and found.get("low_mm_s") is not None and found.get("high_mm_s") is None:
            mark, colour = MARKS[row["level"]]
            axes.errorbar([rate(found)], [found["low_mm_s"]], yerr=[2], lolims=True, fmt=mark, color=colour, markersize=8)


def draw(rows, path):
    """Bed height, layers and inversion velocity against the cost, with the front towards the reference of each."""
    with plt.rc_context(STYLE):
        figure, panels = plt.subplots(1, 3, figsize=(13, 5))
        figure.subplots_adjust(left=0.05, right=0.985, top=0.97, bottom=0.25, wspace=0.2)
        for axes, quantity in zip(panels, ("common_height_mm", "common_apart_mm")):
            against = reference(rows, quantity)
            draw_panel(axes, rows, quantity, against and against[0])
            if against:
                axes.axhspan(against[0] - against[1], against[0] + against[1], color=COLOURS[3], alpha=0.2, lw=0)
                axes.axhline(against[0], color=COLOURS[3], lw=0.8, label="reference: particles")
        draw_panel(panels[2], rows, "mm_s", MEASURED)
        bounds(panels[2], rows)
        panels[2].axhline(MEASURED, color="black", lw=0.8, ls=":", label="experiment")
        when = "{:g} mm/s, {:g} to {:g} s".format(1e3 * plan.VELOCITY, *plan.COMMON)
        panels[0].set_ylabel(f"bed height, {when}, mm")
        panels[1].set_ylabel(f"centre of coarse over fine, {when}, mm")
        panels[2].set_ylabel("inversion velocity, mm/s")
        handles = {label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels())}
        figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=4, fontsize=8)
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=110)
        plt.close(figure)
