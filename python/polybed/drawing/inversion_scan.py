"""Draws inversion.json of a scan, as `polybed inversion --scan` does at its end.

    python3 -m polybed.drawing.inversion_scan DIR

Exit codes are those of polybed: 0 done, 2 the command is wrong, 4 a file or a package is missing.
"""

import argparse
import sys
from pathlib import Path

from polybed.packages import needed

with needed(__name__ == "__main__"):
    import matplotlib.pyplot as plt
    import numpy as np

    from polybed.drawing.style import COLOURS, GREY, NAMES, PALE, STYLE
    from polybed.files import contents_of, print_made, read_json
    from polybed.plot import save
    from polybed.study.inversion_search import known


def read_scan(directory):
    """inversion.json of a folder, as a dictionary."""
    return read_json(Path(directory) / "inversion.json", "polybed inversion")


def columns(scan):
    """Velocities in mm/s, means and half-widths of a model's runs, by rising velocity."""
    rows = sorted((run["velocity_m_s"] * 1e3, run["centre_difference"], run["error"]) for run in scan["runs"])
    return np.array(rows).T


def draw(found):
    """Mean difference of the centres over the velocity, by each model, with what was found."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for n, (model, scan) in enumerate(found["models"].items()):
        velocity, value, error = columns(scan)
        label = NAMES[model]
        if scan["velocity_m_s"] is not None:
            low, high = known(scan["outcome"], *(scan[f"{name}_m_s"] for name in ("low", "high", "velocity", "error")))
            axes.axvspan(low * 1e3, high * 1e3, color=COLOURS[n], alpha=0.15, linewidth=0)
            label += f": {scan['velocity_m_s'] * 1e3:.3g} mm/s"
        axes.errorbar(velocity, value, error, color=COLOURS[n], marker="os"[n % 2], markersize=4, linewidth=1, capsize=2,
                      label=label)
    axes.axhline(0, color=PALE, linewidth=0.8, zorder=0)
    balance = found["force_balance"]
    if balance:
        axes.axvline(balance["velocity_m_s"] * 1e3, color=GREY, linestyle=":", linewidth=1,
                     label=f"force balance: {balance['velocity_m_s'] * 1e3:.3g} mm/s")
    first, second = found["species"]
    axes.set_xlabel("superficial velocity (mm/s)")
    axes.set_ylabel(f"centre of {second} less that of {first}, over the bed height")
    axes.legend(fontsize=8)
    return figure


def picture(directory, output=None):
    """Draws a scan into its folder as inversion.png, or where one says, and returns the path."""
    found = read_scan(directory)
    with plt.rc_context(STYLE), contents_of(Path(directory) / "inversion.json"):
        return save(draw(found), Path(output) if output else Path(directory) / "inversion.png")


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed.drawing.inversion_scan", description="Draws a scan for the inversion velocity.")
    parser.add_argument("directory", help="folder of inversion.json")
    directory = parser.parse_args(arguments).directory
    return print_made(lambda: [picture(directory)])


if __name__ == "__main__":
    sys.exit(main())
