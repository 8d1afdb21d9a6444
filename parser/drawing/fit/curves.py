"""Ellipses, splines and dense polylines of a drawing made arcs, many at a time.

Where some of them cannot be fitted, the others are.
"""

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.drawing.dxf.entities import CENTER, END, START, Spline
from parser.drawing.fit.arcs import Drawn, arcs_of_pieces
from parser.drawing.fit.pieces import Fitted, Spans, no_curves, pieces_of_ellipses, pieces_of_spans, spans_of
from parser.drawing.fit.polylines import arcs_of_lines
from parser.drawing.model import Drawing, DrawnLoop, refuse_many, running
from parser.geometry.curves import Bools, Curves, Floats, Ints, joined

_SAME_DECIMALS = 6  # of µm, to which curves are one but for their places
_AT_ONCE = 1_000  # curves: lengths along all of them are then told apart, and arrays stay small


def in_batches(number: int, fitted: Callable[[Ints], Fitted]) -> tuple[Fitted, Ints]:
    """What `fitted` makes of all curves, by their rows, and the rows that it has none for.

    Where it raises ValueError for several curves, each half of them is tried.
    """
    todo = [np.arange(first, min(first + _AT_ONCE, number)) for first in range(0, number, _AT_ONCE)][::-1]
    parts: list[tuple[Fitted, Ints]] = []
    refused: list[int] = []
    while todo:
        rows = todo.pop()
        try:
            made = fitted(rows)
        except ValueError:
            if len(rows) == 1:
                refused.append(int(rows[0]))
            else:
                todo += [rows[len(rows) // 2 :], rows[: len(rows) // 2]]
            continue
        parts.append((made._replace(of=rows[made.of]), np.empty(0, dtype=np.int64)))
    return several(parts, np.array(refused, dtype=np.int64))


def several(parts: Sequence[tuple[Fitted, Ints]], refused: Ints) -> tuple[Fitted, Ints]:
    """Parts in one, by rows, with all that is refused."""
    curves = joined([no_curves(), *(made.curves for made, _ in parts)])
    of = np.concatenate([np.empty(0, dtype=np.int64), *(made.of for made, _ in parts)])
    order = np.argsort(of, kind="stable")
    most = max((made.max_um for made, _ in parts), default=0.0)
    return Fitted(curves.picked(order), of[order], most), np.sort(np.concatenate([refused, *(no for _, no in parts)]))


def arcs_of_ellipses(forms: Floats, tolerance_um: float) -> tuple[Fitted, Ints]:
    """Arcs for placed arcs of ellipses (k, 17) within a tolerance of them, each from end to end.

    Behind them the ellipses that have none, as they would need arcs without number. Ellipses that are one but for their
    places are fitted once.
    """

    def fitted(which: Ints) -> Fitted:
        some = forms[first[which]]
        ends = np.stack([some[:, START], some[:, END]], axis=1)[:, :, :2]
        return arcs_of_pieces(pieces_of_ellipses(some), Drawn(some[:, CENTER][:, :2], ends), tolerance_um)

    moved, center = forms.copy(), forms[:, CENTER]
    for column in (START, END, CENTER):
        moved[:, column] -= center
    first, like = _alike([each.tobytes() for each in np.round(moved, _SAME_DECIMALS) + 0.0])
    return _placed(*in_batches(len(first), fitted), like, (center - center[first[like]])[:, :2])


def _alike(keys: Sequence[Hashable]) -> tuple[Ints, Ints]:
    """Rows (m,) of the first of all curves with the same key, and to which of these each curve (k,) belongs."""
    number: dict[Hashable, int] = {}
    first: list[int] = []
    like = np.empty(len(keys), dtype=np.int64)
    for row, key in enumerate(keys):
        like[row] = number.setdefault(key, len(first))
        if like[row] == len(first):
            first.append(row)
    return np.array(first, dtype=np.int64), like


def _shape(spline: Spline) -> Hashable:
    """The same for splines that are one but for their places."""
    moved = np.round(spline.control[:, :2] - spline.control[:, :2].mean(axis=0), _SAME_DECIMALS) + 0.0
    return moved.tobytes(), spline.weight.tobytes(), spline.knot.tobytes(), spline.degree


def _placed(made: Fitted, refused: Ints, like: Ints, by_um: Floats) -> tuple[Fitted, Ints]:
    """What some curves became, for each curve (k,) what that one became which it is `like`, moved by `by_um` (k, 2).

    Raises DrawingError, without the name of the file, where they are too many together.
    """
    number = int(like.max(initial=-1)) + 1
    begin, past = (np.searchsorted(made.of, np.arange(number), side=side) for side in ("left", "right"))
    count = (past - begin)[like]
    refuse_many(int(count.sum()))
    of = np.repeat(np.arange(len(like)), count)
    curves = made.curves.picked(np.arange(len(of)) - np.repeat(np.cumsum(count) - count - begin[like], count))
    by_um = by_um[of]
    placed = replace(
        curves,
        start_um=curves.start_um + by_um,
        end_um=curves.end_um + by_um,
        center_um=curves.center_um + by_um,
    )
    return Fitted(placed, of, made.max_um), np.flatnonzero(np.isin(like, refused))


def arcs_of_splines(splines: Sequence[Spline], tolerance_um: float) -> tuple[Fitted, Ints]:
    """Lines and arcs for placed splines within a tolerance of them, from end to end; their corners stay corners.

    Behind them the splines that have none, as their numbers make no curve, or one that needs arcs without number.
    Splines that are one but for their places are fitted once.
    """
    first, like = _alike([_shape(spline) for spline in splines])
    begin_um = np.array([spline.control[0, :2] for spline in splines]).reshape(-1, 2)
    made, refused = _arcs_of_splines([splines[row] for row in first.tolist()], tolerance_um)
    return _placed(made, refused, like, begin_um - begin_um[first[like]])


def _arcs_of_splines(splines: Sequence[Spline], tolerance_um: float) -> tuple[Fitted, Ints]:
    origins = np.array([spline.control[:, :2].mean(axis=0) for spline in splines]).reshape(-1, 2)
    spans: dict[int, Spans] = {}
    for row, spline in enumerate(splines):
        try:
            spans[row] = spans_of(spline, origins[row])
        except ValueError:
            continue
    parts = [
        _of_degree({row: span for row, span in spans.items() if splines[row].degree == degree}, origins, tolerance_um)
        for degree in sorted({splines[row].degree for row in spans})
    ]
    return several(parts, np.array([row for row in range(len(splines)) if row not in spans], dtype=np.int64))


def _of_degree(spans: Mapping[int, Spans], origins: Floats, tolerance_um: float) -> tuple[Fitted, Ints]:
    rows = np.array(list(spans), dtype=np.int64)

    def fitted(which: Ints) -> Fitted:
        return _fitted_spans([spans[row] for row in rows[which].tolist()], origins[rows[which]], tolerance_um)

    made, refused = in_batches(len(rows), fitted)
    return made._replace(of=rows[made.of]), rows[refused]


def _fitted_spans(spans: Sequence[Spans], origin_um: Floats, tolerance_um: float) -> Fitted:
    pieces = pieces_of_spans(spans)
    first = np.searchsorted(pieces.of, np.arange(len(spans)))
    last = np.searchsorted(pieces.of, np.arange(len(spans)), side="right") - 1
    ends = np.stack([pieces.control[first, 0], pieces.control[last, -1]], axis=1)
    ends_um = ends[:, :, :2] / ends[:, :, 2:] + origin_um[:, None]
    return arcs_of_pieces(pieces, Drawn(origin_um, ends_um), tolerance_um)


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
    fitted = [_fitted_loop(drawing, loop, is_drawn, tolerance_um) for loop in drawing.loops]
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


def _fitted_loop(drawing: Drawing, loop: DrawnLoop, is_drawn: Bools, tolerance_um: float) -> Fitted:
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
