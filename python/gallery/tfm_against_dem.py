#!/usr/bin/python3
"""One case by both models: what differs, in numbers and on a page to send to a colleague.

    PYTHONPATH=python /usr/bin/python3 python/gallery/tfm_against_dem.py [CASE] [-o DIR] [--short]
"""

from common import options, plt, save

import polybed
from polybed.drawing.comparison import draw_history

chosen = options(__doc__, "small-binary")
short = {"until": "20 ms", "overrides": {"output.every": "1 ms", "output.history_every": "0.2 ms"}}
folder = chosen.output / "both"
found = polybed.compare(chosen.case, output=folder, page=True, **(short if chosen.short else {}))


def text(value, digits):
    return "-" if value is None else f"{value:{digits}}"


for name, measure in found["measures"].items():
    print(f"{name:28} two-fluid {text(measure['tfm'], '.4g'):>10}   particles {text(measure['dem'], '.4g'):>10}")
for name, score in found["scores"].items():
    if name != "order":  # who is on top is no number
        verdict = {True: "reached", False: "missed", None: "not judged"}[score["reached"]]
        print(f"{name:28} {text(score['value'], '.3f')}, goal {text(score['goal'], '.3g')}: {verdict}")
runs = {model: polybed.read(found["models"][model]["directory"]) for model in ("tfm", "dem")}
save(draw_history(runs, found["window"]), chosen.output, "tfm-against-dem.png")
print(folder / "comparison.html")
