"""Loops of a drawing with their dense polylines made arcs."""

from typing import NamedTuple

import numpy as np

from parser.drawing.fit.fitted import Fitted
from parser.drawing.fit.lines.polylines import arcs_of_lines
from parser.drawing.model import Drawing, DrawnLoop, running
from parser.geometry.curves import Bools, Curves, Ints, joined

_DRAWN_AS_LINES = frozenset(("LINE", "LWPOLYLINE", "POLYLINE"))


class FittedLoops(NamedTuple):
    """Curves (n,) of loops, in running order one loop behind the other, and which entity each is of (n,).

    An arc is of the entity of the first of its lines. ``max_um`` is a bound of how far arcs lie off their lines.
    """

    curves: Curves
    entity: Ints
    loops: tuple[DrawnLoop, ...]
    max_um: float


def loops_with_arcs(drawing: Drawing, tolerance_um: float) -> FittedLoops:
    """Loops of a drawing, arcs within a tolerance in place of the dense lines that it was drawn with.

    Lines that were fitted to splines and ellipses stay, as they lie off these already.
    """
    is_drawn = np.array([entity.kind in _DRAWN_AS_LINES for entity in drawing.entities])[drawing.entity]
    fitted = [_fitted(drawing, loop, is_drawn, tolerance_um) for loop in drawing.loops]
    number = [len(each.of) for each in fitted]
    first = np.cumsum(number) - number
    return FittedLoops(
        joined([drawing.curves.picked(slice(0)), *(each.curves for each in fitted)]),
        np.concatenate([drawing.entity[:0], *(each.of for each in fitted)]),
        tuple(
            _running_ahead(loop, int(at), len(each.of))
            for loop, each, at in zip(drawing.loops, fitted, first, strict=True)
        ),
        max((each.max_um for each in fitted), default=0.0),
    )


def _fitted(drawing: Drawing, loop: DrawnLoop, is_drawn: Bools, tolerance_um: float) -> Fitted:
    """A loop in running order, begun at its leftmost place if it is closed; `of` is the entity of each curve."""
    part, of = running(drawing.curves, loop.row, loop.backwards), drawing.entity[loop.row]
    if (~part.is_arc).sum() < 2:
        return Fitted(part, of, 0.0)
    fitted = arcs_of_lines(part, is_drawn[loop.row], tolerance_um, is_closed=loop.closed)
    leftmost = np.lexsort([fitted.curves.start_um[:, 1], fitted.curves.start_um[:, 0]])[0] if loop.closed else 0
    order = np.roll(np.arange(len(fitted.of)), -leftmost)
    return Fitted(fitted.curves.picked(order), of[fitted.of[order]], fitted.max_um)


def _running_ahead(loop: DrawnLoop, first: int, number: int) -> DrawnLoop:
    return DrawnLoop(np.arange(first, first + number), np.zeros(number, dtype=np.bool_), loop.closed, loop.gap_um)
