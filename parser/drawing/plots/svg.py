"""SVG to a document: the outlines of its shapes and paths, as lines, arcs, ellipses and splines.

What is hidden is left out; text is told as such, and so are pictures. The groups that lie in no other one are layers,
by their labels or names. Widths, fills and colours say nothing of a contour, a dash says that it is none.
"""

import cmath
import io
import math
import re
from collections import Counter
from collections.abc import Iterator
from typing import Any, Final
from xml.etree import ElementTree

import svgelements

from parser.drawing.model import Unit
from parser.drawing.plots.source import MOST_WAYS, Sheet, Source, arc_places
from parser.findings.catalogue import Remark
from parser.findings.errors import DrawingError
from parser.text.encoding import printable

_PER_INCH: Final = 96.0
"""Of the unit px, as CSS has it."""
_PX: Final = Unit("px", 25_400.0 / _PER_INCH)
_REAL_SIZE: Final = re.compile(r"\s*[\d.]+(?:e[-+]?\d+)?\s*(?:mm|cm|in|pt|pc)\s*", re.IGNORECASE)
_LABEL: Final = "{http://www.inkscape.org/namespaces/inkscape}label"
_LINK: Final = "{http://www.w3.org/1999/xlink}href"
_ROUND: Final = 1e-6
"""Radii of an arc that differ by a smaller share are one."""


def svg_source(data: bytes) -> Source:
    """The document of an SVG file, in px. DrawingError where it is none, or repeats parts of itself without end."""
    root = _root(data)
    _refuse_bombs(root)
    try:
        drawn = svgelements.SVG.parse(io.BytesIO(data), reify=True, ppi=_PER_INCH)
        return _source(drawn, has_size=bool(_REAL_SIZE.fullmatch(root.get("width") or "")))
    except DrawingError:
        raise
    except Exception as error:  # damaged files end in any error
        raise DrawingError("svg-damaged", why=type(error).__name__) from None


def _source(drawn: svgelements.SVG, *, has_size: bool) -> Source:
    pen = _Pen(float(drawn.height or 0.0))
    for layer, element, is_broken in _elements(drawn, "", is_broken=False):
        pen.draw(element, {"layer": layer or "0", **({"linetype": "DASHED"} if is_broken else {})})
    notes = [] if has_size else [Remark("no-svg-size", {"per_inch": _PER_INCH})]
    if pen.passed_over:
        listed = ", ".join(f"{number} {name}" for name, number in sorted(pen.passed_over.items()))
        notes.append(Remark("svg-passed-over", {"elements": listed}))
    return Source(pen.sheet.document, "SVG", _PX, tuple(notes))


def _root(data: bytes) -> ElementTree.Element:
    """The root of the file. Entities of its own are refused: they may stand for others without end."""
    if b"<!ENTITY" in data:
        raise DrawingError("svg-damaged", why="<!ENTITY")
    try:
        return ElementTree.fromstring(data)  # noqa: S314 - no entity is left to expand
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise DrawingError("svg-damaged", why=printable(str(error))[:80]) from None


def _refuse_bombs(root: ElementTree.Element) -> None:
    """DrawingError where elements that repeat others come to more than are read, or repeat themselves."""
    named = {each.get("id"): each for each in root.iter() if each.get("id")}
    sizes: dict[ElementTree.Element, float] = {}
    within = set[ElementTree.Element]()

    def size(element: ElementTree.Element) -> float:
        if element in within or len(within) > _DEEPEST:
            return math.inf
        if element not in sizes:
            within.add(element)
            link = element.get("href") or element.get(_LINK) or ""
            repeated = named.get(link.removeprefix("#")) if element.tag.endswith("use") else None
            parts = [*element, *([] if repeated is None else [repeated])]
            sizes[element] = 1.0 + sum(map(size, parts))
            within.discard(element)
        return sizes[element]

    if size(root) > MOST_WAYS:
        raise DrawingError("plot-too-long", most=MOST_WAYS)


_DEEPEST: Final = 200  # groups in groups


def _elements(group: Any, layer: str, *, is_broken: bool) -> Iterator[tuple[str, Any, bool]]:
    """What a group holds, with its layer, and whether it is dashed."""
    for element in group:
        values = getattr(element, "values", {})
        dashed = is_broken or str(values.get("stroke-dasharray") or "none").strip() not in ("none", "0")
        if isinstance(element, (svgelements.Group, svgelements.Use)):
            own = values.get("attributes", values)
            name = layer or printable(str(own.get(_LABEL) or own.get("id") or ""))
            yield from _elements(element, name, is_broken=dashed)
        else:
            yield layer, element, dashed


class _Pen:
    """Draws elements; the Y of a document points up, that of SVG down from `height`."""

    def __init__(self, height: float) -> None:
        self.sheet = Sheet()
        self.passed_over = Counter[str]()
        self._height = height

    def draw(self, element: Any, how: dict[str, Any]) -> None:
        """One element."""
        if isinstance(element, svgelements.Text):
            self.sheet.text(self._place(complex(element.x or 0.0, element.y or 0.0)), **how)
        elif isinstance(element, svgelements.Shape):
            for way in _ways(svgelements.Path(element).reify()):
                self._draw_way(way, how)
        elif isinstance(element, svgelements.SVGElement):
            self.passed_over[type(element).__name__.lower()] += 1

    def _place(self, place: Any) -> complex:
        at = place if isinstance(place, complex) else complex(float(place[0]), float(place[1]))
        return complex(at.real, self._height - at.imag)

    def _draw_way(self, way: list[Any], how: dict[str, Any]) -> None:
        """Lines and arcs in one; ellipses and splines by themselves."""
        places, bulges = list[complex](), list[float]()

        def end() -> None:
            if len(places) > 1:
                self.sheet.way([*places], [*bulges], **how)
            places.clear()
            bulges.clear()

        for segment in way:
            start, to = self._place(segment.start), self._place(segment.end)
            if isinstance(segment, (svgelements.QuadraticBezier, svgelements.CubicBezier)):
                end()
                self.sheet.bezier([self._place(each) for each in _cubic(segment)], **how)
            elif isinstance(segment, svgelements.Arc) and abs(segment.rx - segment.ry) > _ROUND * segment.rx:
                end()
                self._draw_ellipse(segment, how)
            elif start != to or isinstance(segment, svgelements.Arc):
                if not places:
                    places.append(start)
                for stop, turn in self._arc(segment) if isinstance(segment, svgelements.Arc) else [(to, 0.0)]:
                    places.append(stop)
                    bulges.append(turn)
        end()

    def _draw_ellipse(self, arc: Any, how: dict[str, Any]) -> None:
        """An arc with two radii; seen from below, it turns the other way."""
        first, last = sorted((-arc.get_start_t(), -arc.get_start_t() - arc.sweep))
        wide, high = arc.rx * cmath.exp(-1j * float(arc.get_rotation())), arc.ry
        if arc.ry > arc.rx:
            wide, high = 1j * arc.ry * wide / abs(wide), arc.rx
            first, last = first - 0.5 * math.pi, last - 0.5 * math.pi
        self.sheet.ellipse(self._place(arc.center), wide, high / abs(wide), (first, last), **how)

    def _arc(self, arc: Any) -> Iterator[tuple[complex, float]]:
        """The places and bulges of a circular arc; seen from below, it turns the other way."""
        start, center, end = map(self._place, (arc.start, arc.center, arc.end))
        return arc_places(start, center, -float(arc.sweep), end)


def _ways(path: Any) -> Iterator[list[Any]]:
    """Segments of a path from move to move, without those that draw nothing."""
    way: list[Any] = []
    for segment in path:
        if isinstance(segment, svgelements.Move):
            yield way
            way = []
        elif segment.start is not None and segment.end is not None:
            way.append(segment)
    yield way


def _cubic(segment: Any) -> list[Any]:
    """The four places of a Bézier curve of the second or third order."""
    if isinstance(segment, svgelements.CubicBezier):
        return [segment.start, segment.control1, segment.control2, segment.end]
    start, control, end = (complex(each[0], each[1]) for each in (segment.start, segment.control, segment.end))
    return [start, start + 2.0 * (control - start) / 3.0, end + 2.0 * (control - end) / 3.0, end]
