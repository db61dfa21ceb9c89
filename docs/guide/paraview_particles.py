"""Draws the particles of a run with ParaView as spheres, to a PNG or, with --film, to numbered PNGs.

    pvpython docs/guide/paraview_particles.py RUN [--colour species|speed|radius] [--time T] [--out picture.png] [--film]

Seen from the front. Without a screen: xvfb-run -a pvpython ...
"""

import argparse
import sys
from pathlib import Path

from paraview.simple import (
    Calculator,
    ColorBy,
    CreateView,
    GetColorTransferFunction,
    GetScalarBar,
    Render,
    SaveScreenshot,
    Show,
    Text,
    Xdmf3ReaderS,
)

EXPRESSIONS = {"species": "species", "speed": "mag(velocity)", "radius": "radius"}
TITLES = {"species": "species", "speed": "speed (m/s)", "radius": "radius (m)"}


def range_over(source, name, times):
    """Least and greatest value over some times, and the bounds of all particles."""
    low, high, bounds = [], [], None
    for time in times:
        source.UpdatePipeline(time)
        if source.GetDataInformation().GetNumberOfPoints() == 0:
            continue
        least, most = source.PointData.GetArray(name).GetRange()
        low.append(least)
        high.append(most)
        here = source.GetDataInformation().GetBounds()
        ends = zip(here, bounds or here)
        bounds = [min(pair) if n % 2 == 0 else max(pair) for n, pair in enumerate(ends)]
    if bounds is None:
        sys.exit("there are no particles at any of these times")
    return (min(low), max(high)), bounds


def spheres(source, view, name, limits, title):
    """Each particle as a sphere of its own radius, drawn by the graphics card: a million are no burden."""
    shown = Show(source, view)
    shown.Representation = "Point Gaussian"
    shown.ShaderPreset = "Sphere"
    shown.GaussianRadius = 1
    shown.ScaleByArray = 1
    shown.SetScaleArray = ["POINTS", "radius"]
    shown.UseScaleFunction = 0
    ColorBy(shown, ("POINTS", name))
    colours = GetColorTransferFunction(name)
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(*limits)
    scale = GetScalarBar(colours, view)
    scale.Title, scale.ComponentTitle = title, ""
    scale.WindowLocation = "Any Location"
    scale.Position, scale.ScalarBarLength = [0.8, 0.3], 0.4
    scale.AutomaticLabelFormat, scale.LabelFormat, scale.RangeLabelFormat = 0, "%.3g", "%.3g"
    scale.TitleColor = scale.LabelColor = [0, 0, 0]
    shown.SetScalarBarVisibility(view, True)


def look_from_the_front(view, bounds):
    """Parallel projection along z that shows all particles, with room for the scale beside them."""
    width, height = bounds[1] - bounds[0], bounds[3] - bounds[2]
    centre = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = centre
    view.CameraPosition = [centre[0], centre[1], centre[2] + 10 * max(width, height)]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = 1.15 * max(height, 1.6 * width * view.ViewSize[1] / view.ViewSize[0]) / 2


def white_view(size):
    view = CreateView("RenderView")
    view.ViewSize = [int(n) for n in size.split(",")]
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    return view


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path)
    parser.add_argument("--colour", default="species", choices=EXPRESSIONS)
    parser.add_argument("--time", type=float, help="s; the stored time nearest to it (default: the last)")
    parser.add_argument("--out", type=Path, default=Path("particles.png"))
    parser.add_argument("--film", action="store_true", help="every stored time")
    parser.add_argument("--size", default="600,1000", help="pixels")
    options = parser.parse_args()
    path = options.run / "particles.xdmf"
    if not path.exists():
        sys.exit(f"{path} is missing: is {options.run} a run of particles?")
    reader = Xdmf3ReaderS(FileName=[str(path)])
    reader.UpdatePipelineInformation()
    stored = list(reader.TimestepValues)
    wanted = stored[-1] if options.time is None else min(stored, key=lambda t: abs(t - options.time))
    times = stored if options.film else [wanted]
    shown = Calculator(Input=reader, Function=EXPRESSIONS[options.colour], ResultArrayName="shown")
    limits, bounds = range_over(shown, "shown", times)
    view = white_view(options.size)
    spheres(shown, view, "shown", limits, TITLES[options.colour])
    title = Text()
    Show(title, view).Color = [0, 0, 0]
    Render(view)  # the first picture turns the camera as it likes
    look_from_the_front(view, bounds)
    for number, time in enumerate(times):
        view.ViewTime = time
        title.Text = f"t = {time:.4g} s"
        Render(view)
        out = options.out.with_name(f"{options.out.stem}-{number:04d}.png") if options.film else options.out
        SaveScreenshot(str(out), view)
        print(out)


main()
