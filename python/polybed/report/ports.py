"""Puts ports.vtp into a run directory, for ParaView: jets, feeds and discharges as closed lines with their names."""

import numpy as np

from polybed.drawing.maps import PORTS
from polybed.drawing.style import around_axis
from polybed.files import contents_of, put_text
from polybed.read import Snapshot
from polybed.report.beds import outlines_of_ports

NAME = "ports.vtp"


def array(kind, values, **more):
    """An array of VTK's XML; texts have another element."""
    element, said = "Array" if kind == "String" else "DataArray", "".join(f' {key}="{value}"' for key, value in more.items())
    return f'<{element} type="{kind}" format="ascii"{said}>{" ".join(f"{value:.9g}" for value in np.ravel(values))}</{element}>'


def text_of(ports):
    """The file (VTK XML, PolyData). ports: (name, points of a closed line, m)"""
    names, lines = [name for name, _ in ports], [np.vstack([line, line[:1]]) for _, line in ports]
    counts = [len(line) for line in lines]
    letters = [[*name.encode(), 0] for name in names]  # a text ends with a 0
    kinds = [next(n for n, kind in enumerate(PORTS) if name.startswith(kind)) for name in names]
    return "\n".join(['<?xml version="1.0"?>', '<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">', "<PolyData>",
                      f'<Piece NumberOfPoints="{sum(counts)}" NumberOfVerts="0" NumberOfLines="{len(lines)}" NumberOfStrips="0" NumberOfPolys="0">',
                      "<Points>", array("Float64", np.concatenate(lines), NumberOfComponents=3), "</Points>",
                      "<Lines>", array("Int64", np.arange(sum(counts)), Name="connectivity"), array("Int64", np.cumsum(counts), Name="offsets"), "</Lines>",
                      "<CellData>", array("String", np.concatenate(letters), Name="name"), array("Int32", kinds, Name="kind"),
                      "</CellData>", "</Piece>", "</PolyData>", "</VTKFile>", ""])


def write(directory):
    """Returns the path of the file, or None of a run without ports."""
    run = Snapshot(directory)
    with contents_of(run.directory):
        size = run.particles.size if len(run.particles) else np.array([run.faces[axis][-1] for axis in "xyz"])
        size = size * [1, 1, 0] if around_axis(run) else size  # ParaView shows such a run in one plane
        ports = [(name, line) for name, _, line in outlines_of_ports(run, size)]
        return put_text(run.directory / NAME, text_of(ports)) if ports else None
