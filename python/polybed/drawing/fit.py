"""Errors of a fitted drag law: against voidage, and against the same with rows left out."""

import matplotlib.pyplot as plt
import numpy as np

from polybed.drawing.style import COLOURS, GREY
from polybed.files import rows_of


def columns(path):
    rows = rows_of(path)
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0] if name != "row"}


def draw(record, folder):
    table = columns(folder / "errors.csv")
    kinds = [(name, label) for name, label in (("published", "published constants"), ("fitted", "fitted"),
                                               ("voidage_left_out", "voidages left out")) if name in table]
    figure, panels = plt.subplots(1, len(kinds), figsize=(3.4 * len(kinds), 3), sharey=True, squeeze=False)
    for axes, (name, label), colour in zip(panels[0], kinds, COLOURS):
        axes.axhline(0, color=GREY, lw=0.6)
        axes.plot(table["eps"], 100 * table[name], "o", ms=2.5, color=colour, alpha=0.6)
        axes.set_title(f"{label}: mean {record['errors']['all'][name]['mean']:.2f} %")
        axes.set_xlabel("voidage")
    panels[0][0].set_ylabel("error of $n_j$, %")
    figure.tight_layout()
    return figure
