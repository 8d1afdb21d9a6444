"""Pictures as SVG, for documents and pages: lines stay lines at any size, and paths stay short.

Lines as data of an SVG path: whole and half units, by differences, so that they stay short.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from html import escape
from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw.canvas import arrow_head, dashes
from sim.show.draw.flatten import CHORD_PX, simplify
from sim.show.draw.layout import Box
from sim.show.draw.letters import text_width
from sim.show.draw.style import LIGHT, Paint, Theme, hexadecimal


def path_data(line: Floats) -> str:
    """A line (n, 2), n ≥ 1, units of the picture with y down, rounded to half a unit; empty where it does not move."""
    placed = np.round(2.0 * line)
    moves = np.concatenate([[True], (np.diff(placed, axis=0) != 0.0).any(axis=1)])
    corners = placed[moves]
    return f"M{_pair(corners[0])}l{' '.join(map(_pair, np.diff(corners, axis=0)))}" if len(corners) > 1 else ""


def _pair(place: Floats) -> str:
    return ",".join(f"{value / 2.0:g}" for value in place)


FAMILIES: Final = "'Noto Sans CJK SC','Noto Sans SC','Source Han Sans SC','Microsoft YaHei','PingFang SC',sans-serif"
"""Faces that have Chinese; texts are fitted to the width that they have in the shipped one, the first of these."""
RISE: Final = 0.436
"""Of a size, from the middle of a line to its baseline: half of the face's ascent, 1.16, less its descent, 0.288."""

MOST_PLACES: Final = 5000
"""Of one line, where these tell it to `COARSEST_PX`: 100,000 blocks up and down within a pixel would be megabytes."""
COARSEST_PX: Final = 1.6
"""How far a line of more places may leave the true one."""


class Svg:
    """A page of `width_px` × `height_px` user units; see `sim.show.draw.canvas.Canvas`.

    Every colour stands as an attribute, and as a class ``f-…`` or ``s-…`` of its paint, by which a page that holds the
    picture may colour it anew.
    """

    def __init__(self, width_px: int, height_px: int, theme: Theme = LIGHT) -> None:
        self.width_px, self.height_px = width_px, height_px
        self._theme = theme
        self._made: list[str] = []
        self._strokes: dict[str, list[Floats]] = {}  # lines by attributes: those that were stroked last
        self._rect(Box(0.0, 0.0, width_px, height_px), Paint.PAGE)

    def polyline(self, points: Floats, paint: Paint, width: float) -> None:
        """Stroke a line through `points`, (n, 2) with n ≥ 1, with round corners and ends."""
        self._stroke([points], paint, width)

    def dashed(self, points: Floats, paint: Paint, width: float, dash: float, gap: float) -> None:
        """Stroke each chord of `points`, (n, 2), with dashes of length `dash` and gaps of length `gap`."""
        self._stroke(dashes(points, dash, gap), paint, width)

    def ring(self, center: Floats, radius: float, paint: Paint, width: float) -> None:
        """Stroke a circle; `radius` is that of its middle line."""
        stroke = f'{self._colour("s", paint)} fill="none" stroke-width="{_figure(width)}"'
        self._add(f"<circle {_circle(center, radius)} {stroke}/>")

    def disc(self, center: Floats, radius: float, paint: Paint) -> None:
        """Fill a circle."""
        self._add(f"<circle {_circle(center, radius)} {self._colour('f', paint)}/>")

    def arrow(self, tip: Floats, direction: Floats, size: float, paint: Paint) -> None:
        """Fill an arrow head of length `size`; `direction` has length 1."""
        self.polygon(arrow_head(tip, direction, size), paint)

    def polygon(self, corners: Floats, paint: Paint) -> None:
        """Fill a polygon of `corners`, (n, 2) with n ≥ 3."""
        self.region([corners], paint)

    def region(self, rings: Sequence[Floats], paint: Paint) -> None:
        """Fill what lies inside of an odd number of rings, each (n, 2) with n ≥ 3: outlines with their holes."""
        self._add(f'<path d="{_path(rings, "Z")}" {self._colour("f", paint)} fill-rule="evenodd"/>')

    @contextmanager
    def clipped(self, box: Box) -> Iterator[None]:
        """Draw nothing outside a rectangle for as long as the context lasts."""
        # A nested picture hides what lies outside of it, and needs no name, which pictures of one page could share.
        left, top, right, bottom = box
        size = f'width="{_figure(right - left)}" height="{_figure(bottom - top)}"'
        view = " ".join(_figure(number) for number in (left, top, right - left, bottom - top))
        self._add(f'<svg x="{_figure(left)}" y="{_figure(top)}" {size} viewBox="{view}" overflow="hidden">')
        yield
        self._add("</svg>")

    def box(self, box: Box, fill: Paint, edge: Paint, width: float) -> None:
        """Fill a rectangle and stroke its border inwards."""
        self._rect(box, edge)
        self._rect(Box(box.left + width, box.top + width, box.right - width, box.bottom - width), fill)

    def text(self, at: tuple[float, float], text: str, size: float, paint: Paint, align: float = 0.0) -> None:
        """Write a line, vertically centred on `at`; `align` of its width lies to the left of `at`."""
        if not text:
            return
        width = text_width(text, size)
        place = f'x="{_figure(at[0] - align * width)}" y="{_figure(at[1] + RISE * size)}"'
        fitted = f'font-size="{_figure(size)}" textLength="{_figure(width)}" lengthAdjust="spacingAndGlyphs"'
        self._add(f"<text {place} {fitted} {self._colour('f', paint)}>{escape(text)}</text>")

    def fragment(self, label: str) -> str:
        """The picture as an element of a page, with a label for those who cannot see it."""
        head = f'viewBox="0 0 {self.width_px} {self.height_px}" font-family="{FAMILIES}" xml:space="preserve"'
        name = escape(label, quote=True)
        self._add()
        body = "\n".join(self._made)
        return f'<svg xmlns="http://www.w3.org/2000/svg" {head} role="img" aria-label="{name}">\n{body}\n</svg>'

    def document(self, label: str, width_px: int) -> str:
        """The picture as a file of its own, shown `width_px` wide."""
        height_px = _figure(self.height_px * width_px / self.width_px)
        sized = f'<svg width="{width_px}" height="{height_px}" '
        return '<?xml version="1.0" encoding="UTF-8"?>\n' + self.fragment(label).replace("<svg ", sized, 1) + "\n"

    def _stroke(self, lines: Iterable[Floats], paint: Paint, width: float) -> None:
        """Strokes alike in turn are one path: thousands of whiskers have no attributes of their own."""
        drawn = [line for line in lines if len(line)]
        if not drawn:
            return
        line = f'fill="none" stroke-width="{_figure(width)}" stroke-linecap="round" stroke-linejoin="round"'
        attributes = f"{self._colour('s', paint)} {line}"
        if attributes not in self._strokes:
            self._add()
            self._strokes[attributes] = []
        self._strokes[attributes] += drawn

    def _add(self, *elements: str) -> None:
        """Add elements over what was stroked before."""
        self._made += [f'<path d="{_path(lines)}" {attributes}/>' for attributes, lines in self._strokes.items()]
        self._strokes.clear()
        self._made += elements

    def _rect(self, box: Box, paint: Paint) -> None:
        left, top, right, bottom = box
        size = f'width="{_figure(right - left)}" height="{_figure(bottom - top)}"'
        self._add(f'<rect x="{_figure(left)}" y="{_figure(top)}" {size} {self._colour("f", paint)}/>')

    def _colour(self, what: str, paint: Paint) -> str:
        """Class and attribute of a fill (``f``) or a stroke (``s``)."""
        name = {"f": "fill", "s": "stroke"}[what]
        return f'class="{what}-{paint}" {name}="{hexadecimal(self._theme[paint])}"'


def _circle(center: Floats, radius: float) -> str:
    return f'cx="{_figure(center[0])}" cy="{_figure(center[1])}" r="{_figure(radius)}"'


def _path(lines: Iterable[Floats], end: str = "") -> str:
    """Lines (n, 2) as path data of two decimals: a hundredth of a pixel does not show."""
    drawn = [line for line in _drawn(lines) if len(line)]
    if not drawn:
        return ""
    # All formatted at once: a picture has tens of thousands of places, and as many lines of a few of them.
    figures = np.round(np.concatenate(drawn), 2) + 0.0  # no −0
    form = "".join(["M" + "L".join(["%.6g,%.6g"] * len(line)) + end for line in drawn])
    return form % tuple(figures.ravel().tolist())


def _fewer(line: Floats) -> Floats:
    """A line (n, 2) by fewer places, where it has more than `MOST_PLACES`: as near as these let it be."""
    tolerance, fewer = CHORD_PX, line
    while len(fewer) > MOST_PLACES and tolerance < COARSEST_PX:
        tolerance = min(1.25 * tolerance, COARSEST_PX)
        fewer = simplify(line, tolerance)
    return fewer


def _drawn(lines: Iterable[Floats]) -> Iterator[Floats]:
    """A place alone becomes a line to itself, which round ends show as a dot."""
    return (np.repeat(line, 2, axis=0) if len(line) == 1 else _fewer(line) for line in lines)


def _figure(number: float) -> str:
    text = f"{number:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
