"""Where things stand on a page: the plot's frame, its scale and ticks, block numbers and arrows.

Places for block numbers and arrows: none covers another one, nor a marker, and the path only where it must.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.units import mm
from sim.show.draw import style


class Box(NamedTuple):
    """An upright rectangle in px; y grows downwards."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: "Box") -> bool:
        """Whether the two share more than an edge."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )

    def holds(self, other: "Box") -> bool:
        """Whether `other` lies wholly inside."""
        return (
            self.left <= other.left
            and other.right <= self.right
            and self.top <= other.top
            and other.bottom <= self.bottom
        )


def box_around(center: Floats, width: float, height: float) -> Box:
    """Box of a size in px around the point `center`, (2,) px."""
    x, y = float(center[0]), float(center[1])
    return Box(x - width / 2, y - height / 2, x + width / 2, y + height / 2)


class View(NamedTuple):
    """Scale of a plot, equal on both axes.

    Attributes
    ----------
    px_per_um
        Scale.
    x_px, y_px
        Where the point (0, 0) µm falls on the page.
    """

    px_per_um: float
    x_px: float
    y_px: float

    def to_px(self, points_um: Floats) -> Floats:
        """Points of a part, (…, 2) µm with y upwards, on the page, (…, 2) px with y downwards."""
        return np.asarray(points_um * (self.px_per_um, -self.px_per_um) + (self.x_px, self.y_px), dtype=np.float64)

    def to_um(self, points_px: Floats) -> Floats:
        """Points of the page, (…, 2) px, on the part, (…, 2) µm."""
        return np.asarray((points_px - (self.x_px, self.y_px)) / (self.px_per_um, -self.px_per_um), dtype=np.float64)

    def range_um(self, plot: Box) -> Floats:
        """Give the part of the plane that `plot` shows: (2, 2) µm, lowest and highest (x, y)."""
        return self.to_um(np.array([[plot.left, plot.bottom], [plot.right, plot.top]]))


def fitted(bounds_um: Floats, plot: Box, pad: float = 0.0) -> View:
    """The view that shows a box (2, 2) µm in the middle of a plot, with `pad` px free at its sides."""
    wide_um, tall_um = np.maximum(bounds_um[1] - bounds_um[0], 1e-9).tolist()
    wide, tall = plot.right - plot.left - 2.0 * pad, plot.bottom - plot.top - 2.0 * pad
    return centred(bounds_um.mean(axis=0), min(wide / wide_um, tall / tall_um), plot)


def centred(place_um: Floats, px_per_um: float, plot: Box) -> View:
    """The view of a scale with a place (2,) µm in the middle of a plot."""
    x, y = (place_um * px_per_um).tolist()
    return View(px_per_um, (plot.left + plot.right) / 2 - x, (plot.top + plot.bottom) / 2 + y)


class Page(NamedTuple):
    """A page with one plot.

    Attributes
    ----------
    width_px, height_px
        Size of the page.
    unit
        Factor on the sizes of `sim.show.draw.style`.
    plot
        Frame of the plot.
    view
        Scale of the plot.
    """

    width_px: int
    height_px: int
    unit: float
    plot: Box
    view: View

    @property
    def inside(self) -> Box:
        """The plot without the line of its frame."""
        line = style.GRID_WIDTH * self.unit
        return Box(self.plot.left + line, self.plot.top + line, self.plot.right - line, self.plot.bottom - line)


class Margins(NamedTuple):
    """What is kept free at the four sides of something, in the sizes of `sim.show.draw.style`."""

    left: float
    top: float
    right: float
    bottom: float

    def within(self, box: Box, unit: float) -> Box:
        """What is left of a box."""
        return Box(
            box.left + self.left * unit,
            box.top + self.top * unit,
            box.right - self.right * unit,
            box.bottom - self.bottom * unit,
        )


BESIDE_PLOT: Final = Margins(style.LEFT, style.HEAD, style.EDGE, style.FOOT)
IN_PLOT: Final = Margins(style.PAD, style.PAD, style.PAD, style.PAD)


def unit_of(width_px: int) -> float:
    """Factor on the sizes of `sim.show.draw.style` for a page of this width."""
    return max(width_px / style.BASE_WIDTH, style.LEAST_UNIT)


def page_for(bounds_um: Floats, width_px: int, margins: Margins = BESIDE_PLOT, inside: Margins = IN_PLOT) -> Page:
    """Lay out a page so that a part fills its plot.

    Parameters
    ----------
    bounds_um
        (2, 2) µm, lowest and highest (x, y), neither of both sides 0.
    width_px
        Width of the page; its height follows from the part within `style.HEIGHT_RANGE`.
    beside, inside
        What is kept free between page and frame, and between frame and part.

    Raises
    ------
    ValueError
        The page is narrower than `style.LEAST_THUMBNAIL`.
    """
    if width_px < style.LEAST_THUMBNAIL:
        raise ValueError(f"a picture is at least {style.LEAST_THUMBNAIL} px wide, not {width_px}")
    unit = unit_of(width_px)
    wide_um, tall_um = np.maximum(bounds_um[1] - bounds_um[0], 1e-9).tolist()
    room = _room(width_px, width_px, margins, inside)
    other_px = width_px - (room.bottom - room.top)
    height_px = _height_px(width_px, other_px + (room.right - room.left) * tall_um / wide_um)
    room = _room(width_px, height_px, margins, inside)
    plot = margins.within(Box(0.0, 0.0, width_px, height_px), unit)
    return Page(width_px, height_px, unit, plot, fitted(bounds_um, room))


def _room(width_px: int, height_px: int, margins: Margins, inside: Margins) -> Box:
    """Where the part may lie on a page."""
    unit = unit_of(width_px)
    return inside.within(margins.within(Box(0.0, 0.0, width_px, height_px), unit), unit)


def _height_px(width_px: int, wanted_px: float) -> int:
    low, high = style.HEIGHT_RANGE
    return round(min(max(wanted_px, low * width_px), high * width_px))


def nice_below(value: float) -> float:
    """Largest of … 1, 2, 5, 10, 20 … that is not above `value`, which is above 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(digit * power for digit in (5.0, 2.0, 1.0) if digit * power <= value or digit == 1.0)


def ticks(low: float, high: float, step: float) -> Floats:
    """Multiples of `step` from `low` to `high`, in their unit."""
    return np.asarray(np.arange(math.ceil(low / step), math.floor(high / step) + 1) * step, dtype=np.float64)


def mm_text(length_um: float, step_um: float) -> str:
    """Write a length in mm with the decimals that steps of `step_um` need, such as ``−12.5``."""
    decimals = max(0, -math.floor(math.log10(mm(step_um)) + 1e-9))
    return f"{mm(length_um) + 0.0:.{decimals}f}".replace("-", "−")


CELL_PX: Final = 4.0
MOST_NUMBERS: Final = 80


def number_stride(blocks: int) -> int:
    """Every how manyth block shows its number: 1, 2, 5, 10, 20 … so that no more than `MOST_NUMBERS` show."""
    strides = (digit * power for power in (1, 10, 100, 1000, 10_000, 100_000, 1_000_000) for digit in (1, 2, 5))
    return next(stride for stride in strides if blocks <= stride * MOST_NUMBERS)


class Ink:
    """The cells of a page through which the path runs.

    A table of sums answers for any box at once.
    """

    def __init__(self, runs: Iterable[Floats], width_px: int, height_px: int) -> None:
        cells = np.zeros((int(height_px // CELL_PX) + 2, int(width_px // CELL_PX) + 2), dtype=np.int64)
        for run in runs:
            column, row = np.floor(_densify(run, CELL_PX / 2) / CELL_PX).astype(np.int64).T
            cells[row + 1, column + 1] = 1
        self._sums = cells.cumsum(axis=0).cumsum(axis=1)

    def within(self, box: Box) -> int:
        """How many inked cells a box on the page touches."""
        left, top = int(box.left // CELL_PX), int(box.top // CELL_PX)
        right, bottom = int(box.right // CELL_PX) + 1, int(box.bottom // CELL_PX) + 1
        sums = self._sums
        return int(sums[bottom, right] - sums[top, right] - sums[bottom, left] + sums[top, left])


def _densify(points: Floats, step: float) -> Floats:
    """Points no further apart than `step` along the same line, (k, 2)."""
    length = np.hypot(*np.diff(points, axis=0).T)
    count = np.ceil(length / step).astype(np.int64)
    chord = np.repeat(np.arange(len(count)), count)
    part = np.arange(len(chord)) - np.repeat(np.cumsum(count) - count, count)
    share = (part / count[chord])[:, None]
    return np.concatenate([points[chord] * (1 - share) + points[chord + 1] * share, points[-1:]])


class Room:
    """The free room in a frame; what finds its place there is taken out.

    Parameters
    ----------
    area
        The frame.
    ink
        The path, which a box covers only where nothing else is left.
    taken
        Boxes to keep clear of.
    """

    def __init__(self, area: Box, ink: Ink, taken: Iterable[Box]) -> None:
        self._area = area
        self._ink = ink
        self._taken = list(taken)

    def take(self, tries: Sequence[Box]) -> Box | None:
        """Take the first of `tries` that covers the least of the path; None where all of them overlap something."""
        return self._taking(min(self._free(tries), key=self._ink.within, default=None))

    def take_clear(self, tries: Sequence[Box]) -> Box | None:
        """Take the first of `tries` that covers nothing of the path; None where there is none."""
        return self._taking(next((box for box in self._free(tries) if not self._ink.within(box)), None))

    def _free(self, tries: Sequence[Box]) -> Iterator[Box]:
        return (box for box in tries if self._area.holds(box) and not any(box.meets(other) for other in self._taken))

    def _taking(self, box: Box | None) -> Box | None:
        self._taken += [box] if box else []
        return box

    def block(self, box: Box) -> None:
        """Take a box whether it is free or not."""
        self._taken.append(box)


class Anchors(NamedTuple):
    """Places on n blocks: (n, 2) px, and the unit normals there to the right of the direction of travel, (n, 2)."""

    points: Floats
    normals: Floats


def place_numbers(anchors: Sequence[Anchors], sizes: Floats, gap: float, room: Room) -> list[Box | None]:
    """Find a box beside each block for its number.

    Parameters
    ----------
    anchors
        Tries for the place on each of n blocks, best first.
    sizes
        (n, 2) px, width and height of each box.
    gap
        Least distance from the block, px.
    room
        What is free.

    Returns
    -------
    n boxes, None where there is no room; earlier blocks choose first.
    """
    return [room.take(_tries(anchors, row, sizes[row], gap)) for row in range(len(sizes))]


def _tries(anchors: Sequence[Anchors], row: int, size: Floats, gap: float) -> list[Box]:
    boxes = []
    for distance, (points, normals), side in product((gap, 2.5 * gap), anchors, (1.0, -1.0)):
        reach = distance + float(np.abs(normals[row]) @ size) / 2
        boxes.append(box_around(points[row] + side * reach * normals[row], float(size[0]), float(size[1])))
    return boxes
