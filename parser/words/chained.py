"""Words of a whole path, each block told from where the one before it decodes to, so that rounding does not add up.

So do the CAMs (docs/3b.md §1). The controller's own chain, from stepped end to stepped end, is in
`controller.stepping.words`.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats
from parser.told.step_words import StepWords
from parser.words.moves import moves
from parser.words.one_arc import OneBlock, Place, arc_of, told_arc_of
from parser.words.telling import chosen, words_of_arcs, words_of_lines, words_of_told_arcs

_LET_BE_UM = 0.6
"""A block that is told as it is drawn and ends no farther off on either axis is let be. So a CAM wrote the 3B beside
its ISO (docs/iso.md §10): three arcs bring it 0.575 µm off, and the line behind them still says 0."""
_FAR_UM = 1.25
"""An arc that would end farther off gets another centre than the one that it names."""
_TOLD = "x_um", "y_um", "count_um", "count_axis", "quadrant", "turn"


class Chained(NamedTuple):
    """Words of n blocks, and (n, 2) where each ends exactly."""

    words: StepWords
    end_um: Floats


def chained_words(curves: Curves, told_um: Floats, is_placed: Bools) -> Chained:
    """Words of n curves: as they are drawn while that leads near enough to their ends, else from the last decoded end.

    Parameters
    ----------
    curves
        What is to be told; jumps are told as lines.
    told_um
        (n, 2) ways from the starts of arcs to the centres that they name; NaN where any centre will do with which the
        arc ends where it should.
    is_placed
        (n,) rows that end at the very place, however it is reached.
    """
    words = _arcs(curves, told_um)
    again, ends = _told_in_turn(curves, told_um, is_placed, moves(words).by_um)
    if again:
        rows, blocks = list(again), zip(*(told[: len(_TOLD)] for told in again.values()), strict=True)
        for name, column in zip(_TOLD, blocks, strict=True):
            getattr(words, name)[rows] = column
    lines = words_of_lines(np.diff(ends, axis=0, prepend=curves.start_um[:1]))
    return Chained(chosen(curves.is_arc, words, lines), ends)


def _told_in_turn(
    curves: Curves, told_um: Floats, is_placed: Bools, by_um: Floats
) -> tuple[dict[int, OneBlock], Floats]:
    """The arcs, by their rows, that are told otherwise than drawn, which goes `by_um` (n, 2); and (n, 2) all ends.

    Lines that follow each other are told from where the first of them begins.
    """
    again: dict[int, OneBlock] = {}
    ends: list[Place] = []
    at = _place(curves.start_um[0].tolist() if len(curves) else [0.0, 0.0])
    origin = base = at
    is_behind_line = False
    drawn = zip(*(column.tolist() for column in (curves.start_um, curves.end_um, by_um)), strict=True)
    kinds = zip(curves.is_arc.tolist(), is_placed.tolist(), strict=True)
    for row, ((is_arc, is_named), (start, end, by)) in enumerate(zip(kinds, drawn, strict=True)):
        is_line = not (is_arc or is_named)
        if is_line and not is_behind_line:
            origin, base = at, _place(start) if _off(at, start) <= _LET_BE_UM else at
        is_behind_line = is_line
        if is_line:
            at = origin[0] + round(end[0] - base[0]), origin[1] + round(end[1] - base[1])
        elif is_named:
            at = _place(end)
        else:
            begin, at = at, (at[0] + by[0], at[1] + by[1])
            if _off(at, end) > _LET_BE_UM:
                told = again[row] = _arc_from(curves, told_um, row, begin)
                at = begin[0] + told.by_um[0], begin[1] + told.by_um[1]
        ends.append(at)
    return again, np.array(ends).reshape(-1, 2)


def _arc_from(curves: Curves, told_um: Floats, row: int, at: Place) -> OneBlock:
    """Words of the arc in a row that begins at a place beside its start; about the centre that it names, if it may."""
    (x, y), (told_x, told_y) = curves.end_um[row].tolist(), told_um[row].tolist()
    by, sweep = (x - at[0], y - at[1]), float(curves.sweep_rad[row])
    if not math.isnan(told_x):
        told = told_arc_of((-told_x, -told_y), by, sweep)
        if _off((at[0] + told.by_um[0], at[1] + told.by_um[1]), (x, y)) <= _FAR_UM:
            return told
    center_x, center_y = curves.center_um[row].tolist()
    out = at[0] - center_x, at[1] - center_y
    return arc_of(out, (out[0] + by[0], out[1] + by[1]), sweep)


def _arcs(curves: Curves, told_um: Floats) -> StepWords:
    """Words of all rows as arcs as they are drawn, about the centres that they name where they name one."""
    by = curves.end_um - curves.start_um
    names = ~np.isnan(told_um[:, 0])
    out = curves.start_um - np.where(curves.is_arc[:, None], curves.center_um, 0.0)
    about = words_of_arcs(out, out + by, curves.sweep_rad)
    return chosen(names, words_of_told_arcs(np.rint(-np.nan_to_num(told_um)), by, curves.sweep_rad), about)


def _place(xy: Sequence[float]) -> Place:
    return xy[0], xy[1]


def _off(place_um: Sequence[float], other_um: Sequence[float]) -> float:
    return max(abs(place_um[0] - other_um[0]), abs(place_um[1] - other_um[1]))
