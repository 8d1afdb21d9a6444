"""Steps: the 1 µm steps of a whole program as data that answers for any stretch of it.

Nothing is stored per step. `Steps` keeps one row a block; `chunks` makes any stretch of steps from that, so that a
program of any length streams in bounded memory.
"""

from dataclasses import dataclass

import numpy as np

from controller.stepping.strokes import ArcWalk, Strokes, arc_strokes, line_strokes, reached
from parser.geometry.curves import Bools, Floats, Ints


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
            last = self.strokes_of(count - 1, count)
            x, y = reached(last, count - self.before[last.row] - last.base).place_um[0]
        return int(x), int(y)

    def strokes_of(self, since: int, until: int) -> Strokes:
        """Strokes that hold steps number since + 1 to until, in order, placed in the program."""
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
