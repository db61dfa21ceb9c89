#!/usr/bin/python3
"""At which velocity the layers of two species change places: by runs, beside four models that need none.

    PYTHONPATH=python /usr/bin/python3 python/gallery/inversion_scan.py [CASE] [-o DIR] [--short]
"""

from common import options, plt, save

import polybed
from polybed.drawing import inversion_scan

chosen = options(__doc__, "small-binary")
methods = ("force_balance", "bulk_density", "expansion", "density_maximum")
for method in methods:
    velocity = polybed.inversion(chosen.case, method=method)["velocity_m_s"]
    print(f"{method}: " + ("no inversion" if velocity is None else f"{velocity * 1e3:.2f} mm/s"))
short = {"until": "0.5 s", "overrides": {"output.history_every": "2 ms"}, "begin": "30 mm/s", "end": "33 mm/s"}
found = polybed.inversion(chosen.case, scan="tfm", output=chosen.output / "inversion", **(short if chosen.short else {}))
by_runs = found["models"]["tfm"]
if by_runs["velocity_m_s"] is None:
    print(f"runs: none between {by_runs['low_m_s'] * 1e3:.2f} and {by_runs['high_m_s'] * 1e3:.2f} mm/s")
else:
    print(f"runs: {by_runs['velocity_m_s'] * 1e3:.2f} mm/s, in {by_runs['cpu_s']:.0f} CPU s")
with plt.rc_context(inversion_scan.STYLE):
    save(inversion_scan.draw(found), chosen.output, "inversion.png")
