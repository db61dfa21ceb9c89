"""Draws a field of a run with ParaView, to a PNG or, with --film, to numbered PNGs, one for each stored time.

    pvpython docs/guide/paraview_view.py RUN [--field phi_fine] [--time T] [--out picture.png] [--film] [--size 600,1000]

A 2-D run is drawn as it is; of a 3-D run the plane at half depth, within the outline of the column. Without a screen:
xvfb-run -a pvpython ...
"""

import argparse
import sys
from pathlib import Path

from paraview.simple import (
    ColorBy,
    CreateView,
    GetColorTransferFunction,
    GetScalarBar,
    Hide,
    Outline,
    Render,
    SaveScreenshot,
    Show,
    Slice,
    Text,
    Xdmf3ReaderS,
)


def first_fraction(reader):
    """The volume fraction of the first species, where none is asked for."""
    names = [name for name in reader.CellData.keys() if name.startswith("phi_")]
    return names[0] if names else "voidage"


def plane_of(reader, bounds):
    """What is coloured: a 2-D run itself, of a 3-D one the plane at half depth."""
    if bounds[5] - bounds[4] <= 0:
        return reader
    plane = Slice(Input=reader)
    plane.SliceType.Origin = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    plane.SliceType.Normal = [0, 0, 1]
    return plane


def look_along_z(view, bounds):
    """Parallel projection that shows the whole column, with room for the scale beside it."""
    width, height = bounds[1] - bounds[0], bounds[3] - bounds[2]
    centre = [(bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, (bounds[4] + bounds[5]) / 2]
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = centre
    view.CameraPosition = [centre[0], centre[1], centre[2] + 10 * max(width, height)]
    view.CameraViewUp = [0, 1, 0]
    room = 1.15 * max(height, 1.6 * width * view.ViewSize[1] / view.ViewSize[0])
    view.CameraParallelScale = room / 2


def coloured(source, view, field, limits):
    """Shows a source by a field on a fixed scale, so that pictures of several times compare."""
    shown = Show(source, view)
    shown.Representation = "Surface"
    shown.Ambient, shown.Diffuse = 1, 0  # colours as the scale has them, without shading
    ColorBy(shown, ("CELLS", field))
    colours = GetColorTransferFunction(field)
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(*limits)
    scale = GetScalarBar(colours, view)
    scale.Title, scale.ComponentTitle = field, ""
    scale.WindowLocation = "Any Location"
    scale.Position, scale.ScalarBarLength = [0.8, 0.3], 0.4
    scale.AutomaticLabelFormat, scale.LabelFormat, scale.RangeLabelFormat = 0, "%.3g", "%.3g"
    scale.TitleColor = scale.LabelColor = [0, 0, 0]
    shown.SetScalarBarVisibility(view, True)


def range_over(reader, field, times):
    """Least and greatest value of a field over some times."""
    low, high = [], []
    for time in times:
        reader.UpdatePipeline(time)
        least, most = reader.CellData.GetArray(field).GetRange()
        low.append(least)
        high.append(most)
    return (0.0 if field.startswith("phi_") else min(low)), max(high)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path)
    parser.add_argument("--field", help="a scalar: phi_<name>, voidage, pressure")
    parser.add_argument("--time", type=float, help="s; the stored time nearest to it (default: the last)")
    parser.add_argument("--out", type=Path, default=Path("paraview.png"))
    parser.add_argument("--film", action="store_true", help="every stored time")
    parser.add_argument("--size", default="600,1000", help="pixels")
    options = parser.parse_args()
    path = options.run / "fields.xdmf"
    if not path.exists():
        sys.exit(f"{path} is missing: is {options.run} a run directory?")
    reader = Xdmf3ReaderS(FileName=[str(path)])  # the older "XDMF Reader" shows a line of a 2-D run
    reader.UpdatePipelineInformation()
    stored = list(reader.TimestepValues)
    reader.UpdatePipeline(stored[0])
    wanted = stored[-1] if options.time is None else min(stored, key=lambda t: abs(t - options.time))
    times = stored if options.film else [wanted]
    field = options.field or first_fraction(reader)
    if field not in reader.CellData.keys():
        sys.exit(f"{field} is not in {path}; there are {', '.join(reader.CellData.keys())}")
    view = CreateView("RenderView")
    view.ViewSize = [int(n) for n in options.size.split(",")]
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    bounds = reader.GetDataInformation().GetBounds()
    source = plane_of(reader, bounds)
    coloured(source, view, field, range_over(reader, field, times))
    if source is not reader:
        Hide(reader, view)
    frame = Show(Outline(Input=reader), view)
    frame.AmbientColor = frame.DiffuseColor = [0, 0, 0]
    title = Text()
    shown_title = Show(title, view)
    shown_title.Color = [0, 0, 0]
    Render(view)  # the first picture turns the camera as it likes
    look_along_z(view, bounds)
    for number, time in enumerate(times):
        view.ViewTime = time
        title.Text = f"t = {time:.4g} s"
        Render(view)
        out = options.out.with_name(f"{options.out.stem}-{number:04d}.png") if options.film else options.out
        SaveScreenshot(str(out), view)
        print(out)


main()
