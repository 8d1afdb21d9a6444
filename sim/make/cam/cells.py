"""Contours that lines divide, as the cells between them: two parts that share an edge, drawn once.

Exploded drawings have each edge of a nest once, or twice and read as one. All curves of contours that others divide are
cut where they meet. Then each cell is walked round: at every corner on along the next curve clockwise.
"""

from dataclasses import replace
from typing import Final

import numpy as np

from parser.drawing.loops.chain import Run, signed_areas
from parser.drawing.model import SAME_WITHIN_UM, Drawing, DrawnLoop
from parser.geometry.along import directions
from parser.geometry.arrangement import Edges, edges_of, merged
from parser.geometry.curves import Bools, Ints, joined

_SAME_HEADING: Final = 1e-9  # of directions that are compared


def with_cells(drawing: Drawing) -> Drawing:
    """The drawing with cells in place of contours that open chains divide; the same where none does."""
    is_open = np.zeros(len(drawing.curves), dtype=np.bool_)
    for loop in drawing.loops:
        is_open[loop.row] = not loop.closed
    if not is_open.any() or is_open.all():
        return drawing
    edges = _without_ends(edges_of(drawing.curves, SAME_WITHIN_UM))
    edges = edges.take(_are_divided(edges, is_open))
    if not len(edges.row):
        return drawing
    cells = _cells(edges)
    divided = np.zeros(len(drawing.curves), dtype=np.bool_)
    divided[edges.row] = True
    others = [loop for loop in drawing.loops if not divided[loop.row].any()]
    number = [len(loop.row) for loop in (*others, *cells)]
    past = np.cumsum(number)
    rows = np.concatenate([*(loop.row for loop in others), np.empty(0, dtype=np.int64)])
    walked = np.concatenate([loop.row for loop in cells])
    loops = tuple(
        replace(loop, row=np.arange(end - count, end))
        for loop, count, end in zip((*others, *cells), number, past.tolist(), strict=True)
    )
    curves = joined([drawing.curves.picked(rows), edges.curves.picked(walked)])
    return replace(
        drawing,
        curves=curves,
        entity=np.concatenate([drawing.entity[rows], drawing.entity[edges.row[walked]]]),
        loops=loops,
        notes=tuple(note for note in drawing.notes if note.name not in _OF_JOINTS),
    )


_OF_JOINTS: Final = frozenset({"branches", "many-branches"})
"""What is said of places where more than two ends meet: corners of cells are no doubt."""


def _without_ends(edges: Edges) -> Edges:
    """Those that bound cells on both sides or one: no corner is the end of a single curve."""
    while len(edges.row):
        met = np.bincount(edges.corner.ravel())
        loose = (met[edges.corner] < 2).any(axis=1) & (edges.corner[:, 0] != edges.corner[:, 1])
        if not loose.any():
            break
        edges = edges.take(~loose)
    return edges


def _are_divided(edges: Edges, is_open: Bools) -> Bools:
    """Which of the edges (e,) hang together with one of an open chain."""
    if not len(edges.row):
        return np.zeros(0, dtype=np.bool_)
    label = merged(np.arange(int(edges.corner.max()) + 1), edges.corner)
    of = label[edges.corner[:, 0]]
    divided: Bools = np.isin(of, of[is_open[edges.row]])
    return divided


def _cells(edges: Edges) -> tuple[DrawnLoop, ...]:
    """The cells as loops of the edges' curves, counter-clockwise."""
    number = len(edges.row)
    ways = directions(edges.curves)
    bend = np.where(edges.curves.is_arc, np.sign(edges.curves.sweep_rad) / edges.curves.radius_um, 0.0)
    leaving = np.concatenate([ways.leaving, -ways.arriving])
    angle = np.round(np.arctan2(leaving[:, 1], leaving[:, 0]) / _SAME_HEADING)
    angle[angle == np.round(-np.pi / _SAME_HEADING)] *= -1.0
    at = np.concatenate([edges.corner[:, 0], edges.corner[:, 1]])
    order = np.lexsort([np.concatenate([bend, -bend]), angle, at])
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    first = np.searchsorted(at[order], at)
    past = np.searchsorted(at[order], at, side="right")
    turned = np.where(rank == first, past - 1, rank - 1)
    back = np.concatenate([np.arange(number, 2 * number), np.arange(number)])
    following = order[turned][back]
    run = _walked(following, number)
    areas = signed_areas(edges.curves, run)
    return tuple(
        DrawnLoop(run.row[run.of == each], run.backwards[run.of == each], closed=True, gap_um=0.0)
        for each in np.flatnonzero(areas > SAME_WITHIN_UM).tolist()
    )


def _walked(following: Ints, number: int) -> Run:
    """The rounds that half-edges make, each with the one that follows it; the second half of them run back."""
    after = following.tolist()
    of, walked, rounds = [-1] * len(after), list[int](), 0
    for begin in range(len(after)):
        at = begin
        while of[at] < 0:
            of[at] = rounds
            walked.append(at)
            at = after[at]
        rounds = of[begin] + 1 if of[begin] == rounds else rounds
    half = np.array(walked, dtype=np.int64)
    return Run(half % number, half >= number, np.array(of)[half], np.ones(rounds, dtype=np.bool_))
