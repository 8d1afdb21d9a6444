"""Steps: the 1 µm steps of a whole program as data that answers for any stretch of it.

Nothing is stored per step. `Steps` keeps one row a block; `Steps.chunk` works out any stretch of steps in closed
form, so that a program of any length streams in bounded memory.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.stepping.quadrants import ArcWalk
from controller.stepping.strokes import Strokes, arc_strokes, follow, line_strokes
from parser.geometry.curves import Bools, Floats, Ints

CHUNK_STEPS = 1 << 18
"""Steps worked out at once: their arrays stay in a processor's cache, and the cost of an array call is spread thin."""


class StepChunk(NamedTuple):
    """m steps in order.

    Attributes
    ----------
    x_um, y_um
        (m,) int32, where the table stands after each step, from where it stood at the program's start.
    row
        (m,) int32, row of the toolpath that made the step.
    along_um
        (m,) float64, length of the ideal path covered by then, never falling.
    """

    x_um: NDArray[np.int32]
    y_um: NDArray[np.int32]
    row: NDArray[np.int32]
    along_um: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """All steps of a program of n blocks.

    Attributes
    ----------
    count
        (n,) int64, steps of each block.
    before
        (n + 1,) int64, steps before each block; the last entry is the number of all.
    corner_um
        (n + 1, 2) int64, where the table stands before each block and at the end; starts at (0, 0).
    along_um
        (n + 1,) float64, length of the ideal path before each block.
    stretch
        (n,) float64, path length per length stepped: the last step of a block stands for its whole length.
    line_row, line_extent, line_sign, line_first_is_x
        Lines: their rows, absolute (m, 2) directions and the signs of them, and whether X is the first axis.
    arc_row, arc_walk, arc_turn
        Arcs: their rows, walks and senses.
    """

    count: Ints
    before: Ints
    corner_um: Ints
    along_um: Floats
    stretch: Floats
    line_row: Ints
    line_extent: Ints
    line_sign: Ints
    line_first_is_x: Bools
    arc_row: Ints
    arc_walk: ArcWalk
    arc_turn: Ints

    def __len__(self) -> int:
        return int(self.before[-1])

    def place_after(self, count: int) -> tuple[int, int]:
        """Where the table stands after so many steps, µm."""
        block = int(np.searchsorted(self.before, count))
        if self.before[block] == count:
            x, y = self.corner_um[block]
        else:
            (x,), (y,), _, _ = self.chunk(count - 1, count)
        return int(x), int(y)

    def chunks(self, size: int = CHUNK_STEPS) -> Iterator[StepChunk]:
        """All steps in stretches of `size`; the last may be shorter."""
        return (self.chunk(since, min(since + size, len(self))) for since in range(0, len(self), size))

    def chunk(self, since: int, until: int) -> StepChunk:
        """Steps number since + 1 to until. ValueError unless 0 ≤ since ≤ until ≤ len."""
        if not 0 <= since <= until <= len(self):
            raise ValueError(f"steps {since} to {until} of {len(self)}")
        strokes = self._strokes(since, until)
        row = strokes.row
        skipped = np.maximum(since - self.before[row] - strokes.base, 0)
        taken = np.minimum(until - self.before[row] - strokes.base, strokes.steps) - skipped
        x, y, along = follow(strokes, skipped, taken)
        return StepChunk(x.astype(np.int32), y.astype(np.int32), np.repeat(row.astype(np.int32), taken), along)

    def _strokes(self, since: int, until: int) -> Strokes:
        """Strokes that hold steps of the stretch, in order, placed in the program."""
        low = int(np.searchsorted(self.before, since, side="right")) - 1
        high = int(np.searchsorted(self.before, until, side="left"))
        lines = slice(*np.searchsorted(self.line_row, [low, high]))
        row = self.line_row[lines]
        line = line_strokes(
            row, self.line_extent[lines], self.line_sign[lines], self.line_first_is_x[lines], self.count[row]
        )
        arcs = slice(*np.searchsorted(self.arc_row, [low, high]))
        row = self.arc_row[arcs]
        first, last = np.maximum(since - self.before[row], 0), np.minimum(until - self.before[row], self.count[row])
        walk = ArcWalk._make(column[arcs] for column in self.arc_walk)
        arc = arc_strokes(row, walk, self.arc_turn[arcs], first, last)
        strokes = Strokes._make(np.concatenate(pair) for pair in zip(line, arc, strict=True))
        strokes = strokes.picked(np.lexsort((strokes.base, strokes.row)))
        row = strokes.row
        return strokes._replace(
            origin=strokes.origin + self.corner_um[row],
            lead_um=self.along_um[row] + self.stretch[row] * strokes.lead_um,
            stretch=self.stretch[row],
        )
