"""Strokes: a draft in whole steps of what ISO is written in, one for each block: places, centres, motion words."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints
from parser.write.draft import Draft, picked

_FULL_UM = 1.5
"""A turn that ends no farther from its start is written as a full circle."""
_SHORT_STEPS = 3.0
"""An arc of a longer chord keeps its sense, however its places are rounded; a shorter one is a line within a step."""

_LET_BE_STEPS = 0.6
"""Steps. As in `parser.step_words.chained`: what a CAM leaves off on an axis before it writes a step more or less."""


_SAME_DIGITS = 6
"""Places that differ behind these digits are one, and are rounded to the same side."""


class Strokes(NamedTuple):
    """Blocks to be written, (m,) rows; places are in steps of the text.

    Attributes
    ----------
    row
        Of the draft.
    motion
        0 in the air, 1 straight, 2 clockwise, 3 counter-clockwise.
    start, end
        (m, 2) int64 places.
    to_center
        (m, 2) int64, from the start to the centre; 0 without one.
    """

    row: Ints
    motion: Ints
    start: Ints
    end: Ints
    to_center: Ints


def strokes_of(draft: Draft, step_um: float) -> Strokes:
    """The strokes of a draft: places rounded from where it begins, so that rounding does not add up.

    Turns beyond a full one are strokes of their own. Rows that a step leaves no length are none, so that stops, sides
    and what follows have to be written by the rows of the draft.
    """
    turned, row = _in_turns(draft)
    strokes, moves = all_strokes(turned, step_um)
    return some_strokes(strokes._replace(row=row), np.flatnonzero(moves | turned.is_placed))


def some_strokes(strokes: Strokes, rows: Ints) -> Strokes:
    """Some of them, (k,) by their numbers."""
    return Strokes(*(column[rows] for column in strokes))


def all_strokes(turned: Draft, step_um: float) -> tuple[Strokes, Bools]:
    """A stroke for each row of a draft whose arcs turn once at most, and (n,) whether it moves."""
    curves = turned.curves
    full = _is_full(curves)
    places = _places(curves, step_um, full, 0.0 if turned.is_meant else _LET_BE_STEPS)
    start, end = places[:-1], places[1:]
    chord = np.hypot(*(end - start).T)
    short = curves.is_arc & ~full & (chord <= _SHORT_STEPS) & (np.abs(curves.sweep_rad) < np.pi)
    motion = np.select(
        [curves.kind == CurveKind.JUMP, ~curves.is_arc | short, curves.sweep_rad < 0.0], [0, 1, 2], 3
    ).astype(np.int64)
    center = np.where((motion >= 2)[:, None], _to_center(turned, start, places, step_um), 0)
    return Strokes(np.arange(len(curves)), motion, start, end, center), (chord > 0.0) | full


def _in_turns(draft: Draft) -> tuple[Draft, Ints]:
    """A draft whose arcs turn once at most, and (m,) the row that each of its rows is of."""
    curves = draft.curves
    whole = np.maximum(np.floor((np.abs(curves.sweep_rad) - 1e-9) / (2.0 * np.pi)), 0.0).astype(np.int64)
    whole[_is_full(curves)] = 0
    row = np.repeat(np.arange(len(draft)), whole + 1)
    if len(row) == len(draft):
        return draft, row
    is_whole = np.append(row[1:] == row[:-1], False)
    turned = picked(draft, row)
    arcs = turned.curves
    turn = np.copysign(2.0 * np.pi, arcs.sweep_rad)
    sweep = np.where(is_whole, turn, arcs.sweep_rad - turn * whole[row])
    end = np.where(is_whole[:, None], arcs.start_um, arcs.end_um)
    return replace(turned, curves=replace(arcs, end_um=end, sweep_rad=np.where(arcs.is_arc, sweep, 0.0))), row


def _is_full(curves: Curves) -> Bools:
    """(n,) arcs that turn once, and end where they start but for rounding."""
    off = np.hypot(*(curves.end_um - curves.start_um).T)
    full: Bools = curves.is_arc & (off <= _FULL_UM) & (np.abs(np.abs(curves.sweep_rad) - 2.0 * np.pi) < np.pi)
    return full


def _places(curves: Curves, step_um: float, full: Bools, let_be: float) -> Ints:
    """(n + 1, 2) places between the rows; a full circle ends where it starts."""
    by = np.where(full[:, None], 0.0, curves.end_um - curves.start_um) / step_um
    start = curves.start_um[:1] / step_um
    first = np.rint(start)
    ends = np.round(curves.end_um / step_um - start, _SAME_DIGITS) + first
    columns = [_rounded(first[:, axis], by[:, axis], ends[:, axis], full, let_be) for axis in (0, 1)]
    return np.array(columns, dtype=np.int64).reshape(2, -1).T


def _rounded(start: Floats, by: Floats, ends: Floats, full: Bools, let_be: float) -> list[int]:
    """Places on an axis: each way rounded by itself while it lets its end be, else the end itself."""
    places = [int(at) for at in start.tolist()]
    for way, end, stays in zip(np.rint(by).tolist(), ends.tolist(), full.tolist(), strict=True):
        at = places[-1] + int(way)
        places.append(at if stays or abs(at - end) <= let_be else round(end))
    return places


def _to_center(draft: Draft, start: Ints, places: Ints, step_um: float) -> Ints:
    """(n, 2) from the written start to the centre: as it is told, else to where the centre is.

    Told in finer steps than are written, a centre lies nearer to where it is than to what its block says.
    """
    if not len(draft):
        return np.zeros((0, 2), dtype=np.int64)
    shift = places[0] * step_um - draft.curves.start_um[0]
    exact = draft.curves.center_um + shift - start * step_um
    is_written = np.isnan(draft.told_um) | (step_um > 1.0)
    by: Floats = np.where(is_written, exact, draft.told_um)
    return np.nan_to_num(np.rint(by / step_um)).astype(np.int64)
