"""The bytes of a file that is no DXF to its document, by what it holds and never by its name."""

from parser.drawing.plots.curve_list import list_source
from parser.drawing.plots.iges import iges_source
from parser.drawing.plots.plotter import plot_source
from parser.drawing.plots.source import Source
from parser.drawing.plots.svg import svg_source
from parser.files import kind_of


def source_of(data: bytes) -> Source | None:
    """The document of a plot, an SVG, an IGES file or a list of curves; None for any other file.

    DrawingError where it is damaged.
    """
    kind = kind_of(data)
    if kind == "kind-svg":
        return svg_source(data)
    if kind == "kind-iges":
        return iges_source(data.decode("latin-1"))
    if kind == "kind-curve-list":
        return list_source(data.decode("utf-8", errors="replace"))
    return plot_source(data.decode("latin-1")) if kind == "kind-hpgl" else None
