"""The drawing surface, as pictures know it: strokes, areas and text in px of the page, in paints that a theme colours.

Pictures say what is drawn where; a backend makes pixels (`sim.show.draw.raster`) or SVG (`sim.show.draw.svg`) of it.
"""

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager
from typing import Protocol

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw.layout import Box
from sim.show.draw.style import Paint


class Canvas(Protocol):
    """An empty page; all coordinates and sizes are px of it, y downwards."""

    @property
    def width_px(self) -> int:
        """Width of the page."""

    @property
    def height_px(self) -> int:
        """Height of the page."""

    def polyline(self, points: Floats, paint: Paint, width: float) -> None:
        """Stroke a line through `points`, (n, 2) with n ≥ 1, with round corners and ends."""

    def dashed(self, points: Floats, paint: Paint, width: float, dash: float, gap: float) -> None:
        """Stroke each chord of `points`, (n, 2), with dashes of length `dash` and gaps of length `gap`."""

    def ring(self, center: Floats, radius: float, paint: Paint, width: float) -> None:
        """Stroke a circle; `radius` is that of its middle line."""

    def disc(self, center: Floats, radius: float, paint: Paint) -> None:
        """Fill a circle."""

    def arrow(self, tip: Floats, direction: Floats, size: float, paint: Paint) -> None:
        """Fill an arrow head of length `size`; `direction` has length 1."""

    def polygon(self, corners: Floats, paint: Paint) -> None:
        """Fill a polygon of `corners`, (n, 2) with n ≥ 3."""

    def region(self, rings: Sequence[Floats], paint: Paint) -> None:
        """Fill what lies inside of an odd number of rings, each (n, 2) with n ≥ 3: outlines with their holes."""

    def box(self, box: Box, fill: Paint, edge: Paint, width: float) -> None:
        """Fill a rectangle and stroke its border inwards."""

    def clipped(self, box: Box) -> AbstractContextManager[None]:
        """Draw nothing outside a rectangle for as long as the context lasts; not to be nested."""

    def text(self, at: tuple[float, float], text: str, size: float, paint: Paint, align: float = 0.0) -> None:
        """Write a line, vertically centred on `at`; `align` of its width lies to the left of `at`."""


def arrow_head(tip: Floats, direction: Floats, size: float) -> Floats:
    """Corners (4, 2) of an arrow head."""
    side = np.array([-direction[1], direction[0]])
    back = tip - size * direction
    return np.array([tip, back + 0.36 * size * side, tip - 0.75 * size * direction, back - 0.36 * size * side])


def dashes_along(points: Floats, dash: float, gap: float) -> Iterator[Floats]:
    """Dashes (k, 2) along a curve of `points`, (n, 2), whatever its chords; none where it has no length."""
    before = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    start = np.arange(0.0, before[-1], dash + gap)
    end = np.minimum(start + dash, before[-1])
    ends = np.stack([[np.interp(at, before, axis) for axis in points.T] for at in (start, end)]).transpose(2, 0, 1)
    first, past = before.searchsorted(start, side="right"), before.searchsorted(end)
    for (begin, finish), low, high in zip(ends, first.tolist(), past.tolist(), strict=True):
        yield np.concatenate([begin[None], points[low:high], finish[None]])


def dashes(points: Floats, dash: float, gap: float) -> Floats:
    """Dashes (k, 2, 2), from and to, along each chord of `points`, (n, 2)."""
    by = np.diff(points, axis=0)
    length = np.hypot(by[:, 0], by[:, 1])
    number = np.ceil(length / (dash + gap)).astype(np.int64)
    chord = np.repeat(np.arange(len(by)), number)
    start = (np.arange(len(chord)) - (np.cumsum(number) - number)[chord]) * (dash + gap)
    ends = np.stack([start, np.minimum(start + dash, length[chord])], axis=1) / length[chord, None]
    made: Floats = points[chord, None] + ends[:, :, None] * by[chord, None]
    return made
