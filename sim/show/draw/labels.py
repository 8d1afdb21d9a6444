"""Places for block numbers and arrows: none covers another one, nor a marker, and the path only where it must."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw.layout import Box, box_around

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
