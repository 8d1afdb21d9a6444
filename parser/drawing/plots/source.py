"""What a file that is no DXF becomes: a document as a DXF file gives one, with its unit, so that all else reads it."""

import cmath
import math
from collections.abc import Iterator
from typing import Any, Final, NamedTuple

from ezdxf.document import Drawing as Document
from ezdxf.filemanagement import new

from parser.drawing.model import Unit
from parser.findings.catalogue import Remark
from parser.findings.errors import DrawingError

MOST_WAYS: Final = 20_000
"""Lines, circles and ways of a pen: a second is spent on them, and no part has more."""


class Source(NamedTuple):
    """A document, and how it is read.

    Attributes
    ----------
    document
        Curves by their layers, in numbers of the file.
    version
        What the file is: the release of a DXF file, else the name of its language.
    unit
        The unit of its numbers; None where the document names it.
    notes
        What was assumed and mended.
    """

    document: Document
    version: str
    unit: Unit | None = None
    notes: tuple[Remark, ...] = ()


class Sheet:
    """A document that is being drawn, in numbers of the file."""

    def __init__(self) -> None:
        self.document = new()
        self._space = self.document.modelspace()
        self._number = 0

    def line(self, start: complex, end: complex, **how: Any) -> None:
        """A line; places x + iy."""
        self._one_more()
        self._space.add_line((start.real, start.imag), (end.real, end.imag), dxfattribs=how)

    def circle(self, center: complex, radius: float, **how: Any) -> None:
        """A circle."""
        self._one_more()
        self._space.add_circle((center.real, center.imag), abs(radius), dxfattribs=how)

    def way(self, places: list[complex], bulges: list[float], **how: Any) -> None:
        """Lines and arcs from place to place: the bulge of each is tan(sweep / 4), counter-clockwise above 0.

        A way that ends where it begins is closed.
        """
        self._one_more()
        is_closed = len(places) > 2 and places[0] == places[-1]
        rows = [(p.real, p.imag, b) for p, b in zip(places, [*bulges, 0.0], strict=True)]
        space, corners = self._space, rows[:-1] if is_closed else rows
        space.add_lwpolyline(corners, format="xyb", close=is_closed, dxfattribs=how)

    def bezier(self, places: list[complex], **how: Any) -> None:
        """A Bézier curve of the third order, by four places."""
        self._one_more()
        spline = self._space.add_spline(dxfattribs={**how, "degree": 3})
        spline.control_points = [(place.real, place.imag, 0.0) for place in places]
        spline.knots = [0.0] * 4 + [1.0] * 4

    def spline(self, degree: int, knots: list[float], weights: list[float], places: list[complex], **how: Any) -> None:
        """A rational B-spline by its knots, and its weights and control points, one behind the other."""
        self._one_more()
        spline = self._space.add_spline(degree=degree, dxfattribs=how)
        spline.control_points = [(place.real, place.imag, 0.0) for place in places]
        spline.knots, spline.weights = knots, weights

    def point(self, place: complex, **how: Any) -> None:
        """A point."""
        self._one_more()
        self._space.add_point((place.real, place.imag), dxfattribs=how)

    def ellipse(self, center: complex, major: complex, ratio: float, params: tuple[float, float], **how: Any) -> None:
        """An arc of an ellipse about a centre, by its longer half axis, counter-clockwise between two parameters."""
        self._one_more()
        first, last = params
        self._space.add_ellipse((center.real, center.imag), (major.real, major.imag), ratio, first, last, how)

    def text(self, place: complex, **how: Any) -> None:
        """A text, of which nothing but its place matters here."""
        self._one_more()
        self._space.add_text("", dxfattribs={**how, "insert": (place.real, place.imag)})

    def _one_more(self) -> None:
        self._number += 1
        if self._number > MOST_WAYS:
            raise DrawingError("plot-too-long", most=MOST_WAYS)


def arc_places(start: complex, center: complex, sweep_rad: float, end: complex) -> Iterator[tuple[complex, float]]:
    """An arc of up to a turn as `Sheet.way` takes it: where it goes and with which bulge, from its start to its end.

    It is cut in two where it sweeps more than half a turn: of more a bulge says less and less. Places are x + iy, in
    numbers of the file.
    """
    parts = max(math.ceil(abs(sweep_rad) / math.pi), 1)
    bulge = math.tan(0.25 * sweep_rad / parts)
    for part in range(1, parts):
        yield center + (start - center) * cmath.exp(1j * sweep_rad * part / parts), bulge
    yield end, bulge
