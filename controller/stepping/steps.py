"""Steps: words to steps of 1 µm as a 3B controller makes them, and those of a whole program as data.

Point-by-point comparison (zhúdiǎn bǐjiào fǎ): words to steps, as a 3B controller makes them (docs/3b.md §3).

Words that a controller steps a path by: those of its program, or words of its own where the program has none.

Steps: the 1 µm steps of a whole program as data that answers for any stretch of it.

Nothing is stored per step. `Steps` keeps one row a block; `chunks` makes any stretch of steps from that, so that a
program of any length streams in bounded memory.
"""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from controller.stepping.strokes import ArcWalk, Strokes, arc_strokes, line_strokes, reached, walk_arcs
from parser.controller_words import Axis, StepWords
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.step_words.words import words_of_arcs, words_of_lines
from parser.toolpath import Toolpath


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


Number = TypeVar("Number", np.int64, np.float64)


def interpolate_words(words: StepWords, length_um: Floats) -> Steps:
    """Steps of n blocks from their words and the lengths (n,) µm of their ideal lines and arcs.

    A block of length 0 (no count, or one that no controller can finish) makes no step.
    """
    n = len(length_um)
    place = np.stack([words.x_um, words.y_um], axis=1)
    sign = words.signs
    is_arc = (words.turn != 0) & (length_um > 0.0)
    line, arc = np.flatnonzero(~is_arc), np.flatnonzero(is_arc)
    first_is_x = words.quadrant[line] % 2 == 1  # X in L1 and L3, Y in L2 and L4
    in_j = np.where(length_um > 0.0, words.count_um, 0)
    start = (place * sign)[arc]
    walk = walk_arcs(start[:, 0], start[:, 1], in_j[arc], words.count_axis[arc], words.turn[arc])
    count = np.zeros(n, dtype=np.int64)
    count[line] = count_line(place[line], in_j[line], words.count_axis[line], first_is_x)
    count[arc] = walk.steps
    lines = line_strokes(line, place[line], sign[line], first_is_x, count[line]).picked(count[line] > 0)
    arcs = arc_strokes(arc, walk, words.turn[arc], np.maximum(walk.steps - 1, 0), walk.steps)
    moved, along = np.zeros((n, 2), dtype=np.int64), np.zeros(n)
    for last in (lines, arcs):
        moved[last.row], along[last.row] = reached(last, last.steps)
    return Steps(
        count=count,
        before=_running(count),
        corner_um=_running(moved),
        along_um=_running(length_um),
        stretch=np.divide(length_um, along, out=np.ones(n), where=along > 0.0),
        line_row=line,
        line_extent=place[line],
        line_sign=sign[line],
        line_first_is_x=first_is_x,
        arc_row=arc,
        arc_walk=walk,
        arc_turn=words.turn[arc],
    )


_ENDLESS_STEPS = 10**12
"""Counts of lines are held at this, a million times what any table runs, so that their sums stay whole numbers."""


def count_line(extent: Ints, count_um: Ints, count_axis: Ints, first_is_x: Bools) -> Ints:
    """Steps until each of m lines made its count on the counted axis, whose extent is not 0; (m,) int64.

    On the first axis the last counted step waits for F ≥ 0, on the second for F < 0.
    """
    on_first = (count_axis == Axis.X) == first_is_x
    first = np.where(first_is_x, extent[:, 0], extent[:, 1])
    second = np.where(first_is_x, extent[:, 1], extent[:, 0])
    before = count_um - 1
    waits_for_first = -(-second * before // np.maximum(first, 1))
    waits_for_second = first * before // np.maximum(second, 1) + 1
    steps = count_um + np.where(on_first, waits_for_first, waits_for_second)
    return np.where(count_um > 0, np.minimum(steps, _ENDLESS_STEPS), 0)


def _running(column: NDArray[Number]) -> NDArray[Number]:
    """Sums before each row and after the last, one more than there are rows."""
    return np.concatenate([np.zeros((1, *column.shape[1:]), dtype=column.dtype), np.cumsum(column, axis=0)])


def interpolate(toolpath: Toolpath) -> Steps:
    """Steps of a whole toolpath, each block from where the steps of the one before it ended."""
    return interpolate_words(words_of(toolpath), toolpath.length_um)


def words_of(toolpath: Toolpath) -> StepWords:
    """Words to step a toolpath by: exactly those of its program, else words that end each block where it should end."""
    return stepped_words(toolpath) if toolpath.words is None else toolpath.words


def stepped_words(curves: Curves) -> StepWords:
    """Words of n curves, all places in whole µm from where the first one begins; jumps are told as lines.

    A controller counts its own pulses, so that rounding does not add up. A first pass tells and steps all blocks, as if
    each began at the whole µm next to its start. The next pass tells those again that turn out to begin elsewhere, and
    so on. A line ends at the whole µm next to its end wherever it begins, and so do most arcs. So each pass has fewer
    blocks: 100,000 arcs without a line between them take 76 passes, and 4 times the work of one. After n passes nothing
    can change any more.
    """
    n = len(curves)
    origin = curves.start_um[:1]
    begins = np.rint(curves.start_um - origin).astype(np.int64)
    ends = np.empty_like(begins)
    told_slots = {name: np.empty(n, dtype=np.int64) for name in StepWords.__slots__}
    row = np.arange(n)
    while len(row):
        words = _words_from(curves, row, begins[row] + origin)
        for name, column in told_slots.items():
            column[row] = getattr(words, name)
        moved = np.diff(interpolate_words(words, curves.length_um[row]).corner_um, axis=0)
        ends[row] = begins[row] + moved
        late = row[row < n - 1] + 1
        row = late[(begins[late] != ends[late - 1]).any(axis=1)]
        begins[row] = ends[row - 1]
    return StepWords(**told_slots)


def _words_from(curves: Curves, row: Ints, begin_um: Floats) -> StepWords:
    """Words of the rows (k,) that begin at places (k, 2) and end where they should."""
    end = curves.end_um[row]
    words = words_of_lines(end - begin_um)
    is_arc = curves.is_arc[row]
    center = curves.center_um[row[is_arc]]
    arcs = words_of_arcs(begin_um[is_arc] - center, end[is_arc] - center, curves.sweep_rad[row[is_arc]])
    for name in StepWords.__slots__:
        getattr(words, name)[is_arc] = getattr(arcs, name)
    return words
