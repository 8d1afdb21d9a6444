"""Words of a whole path, each block told from where the one before it decodes to, so that rounding does not add up.

So do the CAMs (docs/3b.md §1). The controller's own chain, from stepped end to stepped end, is in
`controller.stepping.words`.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats
from parser.toolpath import StepWords
from parser.words.moves import moves
from parser.words.telling import chosen, words_of_arcs, words_of_lines, words_of_told_arcs

_LET_BE_UM = 0.6
"""A block that is told as it is drawn and ends no farther off on either axis is let be. So a CAM wrote the 3B beside
its ISO (docs/iso.md §10): three arcs bring it 0.575 µm off, and the line behind them still says 0."""
_FAR_UM = 1.25
"""An arc that would end farther off gets another centre than the one that it names."""


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
    words = _arcs(curves, told_um, slice(None), curves.start_um)
    by = moves(words).by_um
    ends = np.empty_like(by)
    at = curves.start_um[0] if len(curves) else np.zeros(2)
    for rows in _stretches(curves.is_arc | is_placed):
        first = rows.start
        if is_placed[first]:
            ends[rows] = curves.end_um[rows]
        elif not curves.is_arc[first]:
            base = curves.start_um[first] if _off(at, curves.start_um[first]) <= _LET_BE_UM else at
            ends[rows] = at + np.rint(curves.end_um[rows] - base)
        else:
            ends[first] = at + by[first]
            if _off(ends[first], curves.end_um[first]) > _LET_BE_UM:
                again = _arc_from(curves, told_um, rows, at)
                ends[rows] = at + moves(again).by_um
                for name in StepWords.__slots__:
                    getattr(words, name)[rows] = getattr(again, name)
        at = ends[rows.stop - 1]
    lines = words_of_lines(np.diff(ends, axis=0, prepend=curves.start_um[:1]))
    return Chained(chosen(curves.is_arc, words, lines), ends)


def _stretches(alone: Bools) -> Iterator[slice]:
    """Rows, in order: each one that stands alone, and the runs of others between them."""
    at = np.flatnonzero(alone)
    edges = np.unique(np.concatenate([[0], at, at + 1, [len(alone)]])).tolist()
    return (slice(first, past) for first, past in pairwise(edges))


def _arc_from(curves: Curves, told_um: Floats, row: slice, at: Floats) -> StepWords:
    """Words of the arc in a row that begins at a place (2,) beside its start."""
    words = _arcs(curves, told_um, row, at)
    if _off(at + moves(words).by_um[0], curves.end_um[row][0]) <= _FAR_UM:
        return words
    return _arcs(curves, np.full_like(told_um, np.nan), row, at)


def _arcs(curves: Curves, told_um: Floats, rows: slice, start_um: Floats) -> StepWords:
    """Words of rows as arcs that begin at places; about the centres that they name where they name one."""
    by = curves.end_um[rows] - start_um
    sweep, told = curves.sweep_rad[rows], told_um[rows]
    names = ~np.isnan(told[:, 0])
    if names.all():
        return words_of_told_arcs(np.rint(-told), by, sweep)
    out = start_um - np.where(curves.is_arc[rows, None], curves.center_um[rows], 0.0)
    about = words_of_arcs(out, out + by, sweep)
    return chosen(names, words_of_told_arcs(np.rint(-np.nan_to_num(told)), by, sweep), about) if names.any() else about


def _off(place_um: Floats, other_um: Floats) -> float:
    return max(abs(float(place_um[0] - other_um[0])), abs(float(place_um[1] - other_um[1])))
