"""A fitted drag law against its rows, and the band that the uncertainty of a drag law puts about an answer."""

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing.style import COLOURS, GREY, PALE
from polybed.files import rows_of
from polybed.fit.errors import COLUMNS
from polybed.read import read
from polybed.study.measured import centre_column, species_of


def draw_inversion(record, figure):
    """The inversion point in the plane of velocity and voidage, with the points of each move."""
    axes = figure.add_subplot()
    velocity, voidage = record["velocity_m_s"], record["voidage"]
    if velocity["low"] is not None:
        axes.axvspan(1e3 * velocity["low"], 1e3 * velocity["high"], color=PALE, alpha=0.5, lw=0, label="band")
        for (name, pair), colour in zip(velocity["by"].items(), COLOURS):
            at = [1e3 * pair["minus"], 1e3 * velocity["value"], 1e3 * pair["plus"]]
            of = voidage["by"][name]
            axes.plot(at, [of["minus"], voidage["value"], of["plus"]], "o-", ms=3, color=colour, label=name)
    axes.plot(1e3 * velocity["value"], voidage["value"], "k+", ms=9, label=record["law"])
    axes.set(xlabel="inversion velocity, mm/s", ylabel="voidage")
    axes.legend()


def series_of(folder):
    """Time, bed height and centre difference of a run."""
    history = read(folder).history
    centres = [history[centre_column(name)] for name in species_of(history)][:2]
    difference = (centres[1] - centres[0]) / history["bed_height_m"] if len(centres) > 1 else np.empty(0)
    return history["time_s"], {"bed_height_m": history["bed_height_m"], "centre_difference": difference}


def draw_runs(record, folder, figure):
    """Bed height and centre difference over time, with the range of the runs whose law is moved."""
    time, base = series_of(folder)
    moved = [series_of(folder / f"{name}-{sign}") for name in record["band"] for sign in ("minus", "plus")]
    panels = [pair for pair in (("bed_height_m", "bed height, m"), ("centre_difference", "centre difference")) if len(base[pair[0]])]
    for n, (name, label) in enumerate(panels, 1):
        axes = figure.add_subplot(1, len(panels), n)
        all_runs = np.array([base[name], *(np.interp(time, at, values[name]) for at, values in moved)])
        axes.fill_between(time, all_runs.min(axis=0), all_runs.max(axis=0), color=PALE, alpha=0.6, lw=0, label="law within its band")
        axes.plot(time, base[name], color=COLOURS[0], lw=1, label=record["law"])
        if record.get(name, {}).get("low") is not None:
            axes.axhspan(record[name]["low"], record[name]["high"], xmin=0.75, color=GREY, alpha=0.25, lw=0)
        axes.set(xlabel="time, s", ylabel=label)
    axes.legend()


def columns(path):
    rows = rows_of(path)
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0] if name != "row"}


def draw_fit(record, folder):
    """Errors of a fitted law against voidage, and the same with rows left out."""
    table = columns(folder / "errors.csv")
    kinds = [(name, label) for name, label in COLUMNS if name in table and name != "row_left_out"]
    figure, panels = plt.subplots(1, len(kinds), figsize=(3.4 * len(kinds), 3), sharey=True, squeeze=False)
    for axes, (name, label), colour in zip(panels[0], kinds, COLOURS):
        axes.axhline(0, color=GREY, lw=0.6)
        axes.plot(table["eps"], 100 * table[name], "o", ms=2.5, color=colour, alpha=0.6)
        axes.set(title=f"{label}: mean {record['errors']['all'][name]['mean']:.2f} %", xlabel="voidage")
    panels[0][0].set_ylabel("error of $n_j$, %")
    figure.tight_layout()
    return figure


def draw(record, folder):
    """The picture of fit.json or of closure_uncertainty.json."""
    if record["filetype"] == "polybed drag fit":
        return draw_fit(record, folder)
    figure = plt.figure(figsize=(6.4 if record["kind"] == "tfm" else 4, 3))
    draw_inversion(record, figure) if record["kind"] == "inversion" else draw_runs(record, folder, figure)
    figure.tight_layout()
    return figure
