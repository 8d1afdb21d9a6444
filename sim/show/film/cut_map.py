"""When each pixel of the plot was cut: worked out once for a view; then one comparison tells what is cut by a time."""

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Bools, Floats, box_of, total_before
from sim.show.draw.layout import Box, View
from sim.show.draw.silent_pygame import pygame
from sim.table.trace import Trace

FINE: Final = 3
"""Each pixel is looked at in 3 × 3 places."""
FULL: Final = FINE * FINE
"""Level of a pixel that is cut wholly."""
SCALLOP_PX: Final = 0.1  # height d²/8r of what two discs of radius r, d apart, leave standing between them
NEVER: Final = 0xFFFFFF

Levels = NDArray[np.uint8]
"""(h, w) how many of the 9 places in each pixel are cut."""


class Discs(NamedTuple):
    """Places of the wire while it cuts, k of them in order, so near each other that discs about them make the kerf.

    Attributes
    ----------
    t_s
        (k,) float64, when the wire is there.
    centers
        (k, 2) float64, px of the page.
    radius
        (k,) float64, half the width of the kerf there, px.
    """

    t_s: Floats
    centers: Floats
    radius: Floats

    @property
    def widest(self) -> float:
        """The largest radius; 0 where nothing is cut."""
        return float(self.radius.max(initial=0.0))


class Span(NamedTuple):
    """Pixels of a plot, counted from its corner: columns `left` up to `right`, rows `top` up to `bottom`."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def of(self) -> tuple[slice, slice]:
        """Index of the rows and columns in an array (h, w, …)."""
        return slice(self.top, self.bottom), slice(self.left, self.right)

    def joined(self, other: "Span") -> "Span":
        """The smallest span that holds both."""
        lows, highs = zip(self[:2], other[:2], strict=True), zip(self[2:], other[2:], strict=True)
        return Span(*(min(pair) for pair in lows), *(max(pair) for pair in highs))


def discs_of(trace: Trace, is_jump: Bools, view: View, plot: Box, radius: Floats) -> Discs:
    """Discs of the cut that show in a plot; `is_jump` (n,) and `radius` (n,) px by row."""
    way = view.to_px(trace.wire_um)
    travel = total_before(np.hypot(*np.diff(way, axis=0).T))
    spacing, widest = max(1.0, math.sqrt(8.0 * float(radius.min()) * SCALLOP_PX)), float(radius.max())
    at = np.append(np.arange(0.0, travel[-1], spacing), travel[-1])
    centers = np.stack([np.interp(at, travel, way[:, axis]) for axis in (0, 1)], axis=1)
    sample = np.clip(np.searchsorted(travel, at), 1, max(len(travel) - 1, 1)) if len(travel) > 1 else np.zeros_like(at)
    row = trace.row[sample.astype(np.int64)]
    seen = (centers >= (plot.left - widest, plot.top - widest)).all(axis=1)
    seen &= (centers <= (plot.right + widest, plot.bottom + widest)).all(axis=1)
    seen &= ~is_jump[row]
    return Discs(np.interp(at[seen], travel, trace.t_s), centers[seen], radius[row[seen]])


class CutMap:
    """The discs of a plot, by which of them each place in it was cut first."""

    def __init__(self, discs: Discs, plot: Box) -> None:
        self._discs = discs
        self._corner = np.array([plot.left, plot.top])
        self._wide, self._tall = round(plot.right - plot.left), round(plot.bottom - plot.top)
        self._first = self._drawn()

    def front(self, t_s: float) -> int:
        """How many discs are cut by a time."""
        return int(np.searchsorted(self._discs.t_s, t_s, side="right"))

    def levels(self, front: int, span: Span) -> Levels:
        """What is cut of a span once so many discs are."""
        cut = self._first[(slice(None), *span.of)] < front
        return np.asarray(cut.view(np.uint8).sum(axis=0, dtype=np.uint8))

    def changed(self, front: int, other: int) -> Span:
        """Pixels that may differ between two fronts."""
        low, high = sorted((front, other))
        if low == high:
            return Span(0, 0, 0, 0)
        centers = self._discs.centers[low:high]
        return self._near(*box_of(centers))

    def tip(self, center: Floats, radius: float) -> tuple[Span, Levels]:
        """A disc of the kerf about any place (2,) px of the page, for where the wire is between two discs."""
        span = self._near(center, center)
        x = np.arange(span.left, span.right) + 0.5 + self._corner[0] - center[0]
        y = np.arange(span.top, span.bottom) + 0.5 + self._corner[1] - center[1]
        inside = radius + 0.5 - np.sqrt(x**2 + y[:, None] ** 2)
        return span, np.rint(np.clip(inside, 0.0, 1.0) * FULL).astype(np.uint8)

    @property
    def whole(self) -> Span:
        """All pixels."""
        return Span(0, 0, self._wide, self._tall)

    def _near(self, low: Floats, high: Floats) -> Span:
        """Pixels as near a box as discs reach."""
        reach = self._discs.widest + 2.0
        room = (self._wide, self._tall)
        first = np.clip(np.floor(low - reach - self._corner), 0, room).astype(int).tolist()
        past = np.clip(np.ceil(high + reach - self._corner), 0, room).astype(int).tolist()
        return Span(*first, *past)

    def _drawn(self) -> NDArray[np.uint32]:
        """Number (9, h, w) of the first disc over each place: drawn from the last one back, the first stays on top."""
        surface = pygame.Surface((self._wide * FINE, self._tall * FINE), depth=32)
        surface.fill(NEVER)
        fine = np.rint((self._discs.centers - self._corner) * FINE).astype(np.int64).tolist()
        radius = np.maximum(np.rint(self._discs.radius * FINE), 1).astype(np.int64).tolist()
        for number in range(len(fine) - 1, -1, -1):
            pygame.draw.circle(surface, number, fine[number], radius[number])
        places = pygame.surfarray.pixels2d(surface).T.reshape(self._tall, FINE, self._wide, FINE)
        return np.ascontiguousarray(places.transpose(1, 3, 0, 2).reshape(FULL, self._tall, self._wide))
