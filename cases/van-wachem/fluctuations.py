#!/usr/bin/python3
"""Bed height and pressure of a bubbling bed in time, beside the measurements of van Wachem et al. (2001).

    cases/van-wachem/fluctuations.py runs/flat-bed --after 2 -o fluctuations.png

measured.csv has the measurements, digitised by the authors of Lethe from the paper's figures. The frequency is that of upward
crossings of the mean, those less than 0.15 s after another left out, between the first and the last of them.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
import polybed

PROBE = 0.045  # m above the bottom, in the middle of the bed
LEAST_PERIOD = 0.15  # s; the measured ones are 0.3 to 0.5 s
DENSE = 0.2  # solids fraction of the surface as an eye sees it


def frequency(time, values):
    """Hz, from upward crossings of the mean; nan if there are fewer than three."""
    above = values > values.mean()
    crossings = [time[n + 1] for n in np.nonzero(above[1:] & ~above[:-1])[0]]
    kept = crossings[:1]
    for crossing in crossings[1:]:
        if crossing - kept[-1] > LEAST_PERIOD:
            kept.append(crossing)
    return (len(kept) - 1) / (kept[-1] - kept[0]) if len(kept) > 2 else np.nan


def evenly(time, values):
    grid = np.arange(time[0], time[-1], 1e-3)
    return grid, np.interp(grid, time, values)


def measured():
    """{"height_m": (time, values), "pressure_Pa": (time, values)}"""
    rows = [line.split(",") for line in (Path(__file__).parent / "measured.csv").read_text().split("\n")
            if line and line[0] != "#"][1:]
    return {name: evenly(*np.array([(float(t), float(v)) for kind, t, v in rows if kind == name]).T)
            for name in ("height_m", "pressure_Pa")}


def layers(field):
    """[depth][height][width], one layer deep in two dimensions."""
    return field.reshape(-1, *field.shape[-2:])


def probe(run, steps):
    """Net pressure in the middle at the height of the probe, mean over the depth, Pa, linear between cells."""
    x, y = (0.5 * (run.faces[a][1:] + run.faces[a][:-1]) for a in "xy")
    columns = np.argsort(abs(x - x.mean()))[: 2 - len(x) % 2]
    return np.array([np.interp(PROBE, y, layers(run.pressure[int(n)])[..., columns].mean(axis=(0, 2))) for n in steps])


def top(run, steps):
    """Top of the highest cell with more solids than DENSE, m."""
    return np.array([run.faces["y"][1:][(1 - layers(run.voidage[int(n)]) > DENSE).any(axis=(0, 2))].max() for n in steps])


def simulated(run, after):
    steps = np.nonzero(run.time >= after)[0]
    late = run.history["time_s"] >= after
    pressure = probe(run, steps)
    return {"height_m": evenly(run.time[steps], top(run, steps)), "pressure_Pa": evenly(run.time[steps], pressure - pressure.mean()),
            "measure_m": (run.history["time_s"][late], run.history["bed_height_m"][late])}


def cells_of(series):
    height, pressure = series["height_m"], series["pressure_Pa"]
    cells = [f"{height[0][0]:.1f} to {height[0][-1]:.1f}", f"{height[1].mean() * 1e3:.0f} ± {height[1].std() * 1e3:.0f}",
             f"{height[1].min() * 1e3:.0f} to {height[1].max() * 1e3:.0f}", f"{frequency(*height):.1f}",
             f"{pressure[1].std():.0f}", f"{pressure[1].min():.0f} to {pressure[1].max():.0f}", f"{frequency(*pressure):.1f}"]
    if "measure_m" in series:
        measure = series["measure_m"][1]
        return [*cells, f"{measure.mean() * 1e3:.0f} ± {measure.std() * 1e3:.0f}"]
    return [*cells, "-"]


def draw(all_series, path):
    figure, panels = plt.subplots(2, 1, figsize=(8, 5), dpi=110, layout="constrained")
    for name, series in all_series.items():
        for panel, key, scale in zip(panels, ("height_m", "pressure_Pa"), (1e3, 1)):
            time, values = series[key]
            style = {"color": "k", "lw": 2} if name == "measured" else {"lw": 1}
            panel.plot(time, values * scale, label=name, **style)
    panels[0].set(ylabel="bed height (mm)", xlim=(2, 6))
    panels[1].set(ylabel="pressure less mean (Pa)", xlabel="time (s); phases are arbitrary", xlim=(2, 6))
    panels[0].legend(fontsize=8, loc="upper right")
    figure.savefig(path)
    print(f"drawn: {path}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", nargs="+", help="run directory")
    parser.add_argument("--after", type=float, default=2.0, help="start of the means, s")
    parser.add_argument("-o", "--output", help="file of the picture")
    arguments = parser.parse_args()
    everything = {"measured": measured()}
    everything.update({Path(d).name: simulated(polybed.read(d), arguments.after) for d in arguments.run})
    heads = ["", "s", "height, mm", "from, to", "Hz", "pressure's deviation, Pa", "from, to", "Hz", "by measures.md, mm"]
    for line in (heads, ["---", *["---:"] * (len(heads) - 1)], *([n, *cells_of(s)] for n, s in everything.items())):
        print("| " + " | ".join(line) + " |")
    if arguments.output:
        draw(everything, arguments.output)
