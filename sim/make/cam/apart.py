"""Touching parts moved apart by a kerf, so that the wire between them leaves both as large as they are drawn.

Two parts with an edge in common want a cut as wide as the kerf where the drawing has none: across their edge the one is
moved by a kerf more than the other. Where all edges run along X and Y, parts move by whole kerfs: those in a row or a
column one behind the other. Where that cannot be, as with two parts above one between two others, each is pushed by
those before it, and edges that come to lie farther apart than a kerf are cut twice. With other edges, as of hexagons,
all equations are solved at once by the method of conjugate gradients (Hestenes and Stiefel, 1952), which from nothing
moved comes to the least that does. Where no moves do, as along arcs, all parts of that nest stay, and are not cut.
"""

from collections import defaultdict
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.affinity import translate

from parser.drawing.loops.once import over
from parser.drawing.model import BESIDE_UM, Drawing
from parser.findings.catalogue import Remark
from parser.geometry.along import directions
from parser.geometry.arrangement import merged
from parser.geometry.curves import Bools, Floats, Ints
from parser.geometry.near import near_pairs
from parser.units import mm
from sim.make.cam.cells import with_cells
from sim.make.cam.contours import Contours, contours_of
from sim.make.cam.frames import Boxes, frames
from sim.measure.compare.rings import polygon

LEAST_EDGE_UM: Final = 500.0
"""Of a shorter edge in common nothing is saved."""
_MOST_PAIRS: Final = 20_000_000
_SOLVED_UM: Final = 1e-4
_STRAIGHT: Final = 1.0 - 1e-9  # cosine of the angle to an axis
_MOST_ROUNDS: Final = 10  # of moving what comes too near
_WRONG_UM: Final = 1.0  # a step of the machine


Shapes = NDArray[np.object_]
"""Polygons (l,) of contours."""


class _Edges(NamedTuple):
    """Edges (k,) of two parts in common: the parts, and the way (k, 2) out of the first one across it, of length 1.

    `is_line` tells where it is straight.
    """

    this: Ints
    other: Ints
    out: Floats
    is_line: Bools

    def take(self, at: Bools) -> "_Edges":
        """Those at the indices `at`."""
        return _Edges(self.this[at], self.other[at], self.out[at], self.is_line[at])


def moved_apart(drawing: Drawing, kerf_um: float) -> Drawing:
    """The drawing with touching parts moved apart by a kerf each, all within them with them; a note says so."""
    drawing = with_cells(drawing)
    closed = [loop for loop in drawing.loops if loop.closed]
    if len(closed) < 2:
        return drawing
    contours = contours_of(drawing, closed)
    shapes = np.array([polygon(contours.contour(at)) for at in range(len(closed))])
    low, high = shapely.bounds(shapes)[:, :2], shapely.bounds(shapes)[:, 2:]
    is_frame = frames(drawing, contours, Boxes(shapely.area(shapes), low, high))
    part = _parts(shapes, is_frame)
    edges = _in_common(contours, part)
    if not len(edges.this):
        return drawing
    by = _moves(edges, shapes, kerf_um)
    if not by.any():
        return drawing
    return _moved(drawing, shapes, by, part, kerf_um)


def _parts(shapes: Shapes, is_frame: Bools) -> Ints:
    """(l,) the outermost contour about each one, itself where none is; −1 for frames."""
    inner = shapely.point_on_surface(shapes)
    tree = shapely.STRtree(shapes)
    which, around = tree.query(inner, predicate="within")
    area = shapely.area(shapes)
    is_around = (area[around] > area[which]) & ~is_frame[around]
    which, around = which[is_around], around[is_around]
    part = np.arange(len(shapes))
    order = np.argsort(area[around], kind="stable")  # the largest is entered last
    part[which[order]] = around[order]
    part[is_frame] = -1
    return part


def _in_common(contours: Contours, part: Ints) -> _Edges:
    """Edges that outermost contours have in common, each on its own side of it."""
    curves, loop = contours.curves, contours.loop
    early, late, _ = near_pairs(curves, np.zeros_like(loop), BESIDE_UM, _MOST_PAIRS, BESIDE_UM)
    outer = (part[loop[early]] == loop[early]) & (part[loop[late]] == loop[late]) & (loop[early] != loop[late])
    like = np.flatnonzero(outer & (curves.kind[early] == curves.kind[late]))
    found = over(curves, early[like], late[like])
    ways = directions(curves)
    against = (ways.leaving[found.row] * ways.leaving[found.by]).sum(axis=1) < 0.0
    is_line = ~curves.is_arc[found.row]
    is_long = found.last_um - found.first_um >= LEAST_EDGE_UM
    at = np.flatnonzero(is_long & (against | ~is_line))
    along = ways.leaving[found.row[at]]
    out = np.column_stack([along[:, 1], -along[:, 0]])
    return _Edges(loop[found.row[at]], loop[found.by[at]], out, is_line[at])


def _moves(edges: _Edges, shapes: Shapes, kerf_um: float) -> Floats:
    """How far (l, 2) µm each contour is moved; all that hang together not at all where that cannot be."""
    number = len(shapes)
    label = merged(np.arange(number), np.column_stack([edges.this, edges.other]))
    slants = np.abs(edges.out).max(axis=1) < _STRAIGHT
    is_slanting = np.isin(label[edges.this], label[edges.this[slants]])
    by = _solved(edges.take(is_slanting), number, kerf_um)
    by += _along_axes(edges.take(~is_slanting), shapes, kerf_um)
    by -= by[label]  # a label is the least number of those that hang together
    stays = np.isin(label, label[edges.this[~edges.is_line | (_ahead(edges, by) < kerf_um - _WRONG_UM)]])
    by[stays] = 0.0
    moves: Floats = np.round(by, 3) + 0.0
    return moves


def _solved(edges: _Edges, number: int, kerf_um: float) -> Floats:
    """The least moves (l, 2) that part the edges (k,) by a kerf each, as nearly as that can be."""
    by = np.zeros((number, 2))
    left = np.full(len(edges.this), kerf_um)
    way = _back(edges, left, number)
    slope, square = way, float((way**2).sum())
    for _ in range(20 * number + 100):
        step = _ahead(edges, slope)
        length = float((step**2).sum())
        if np.abs(left).max(initial=0.0) <= _SOLVED_UM or length == 0.0:
            break
        by += square / length * slope
        left -= square / length * step
        way = _back(edges, left, number)
        square, before = float((way**2).sum()), square
        slope = way + square / before * slope
    return by


def _ahead(edges: _Edges, by: Floats) -> Floats:
    """(k,) how much farther the second part of each edge is moved across it than the first one."""
    farther: Floats = ((by[edges.other] - by[edges.this]) * edges.out).sum(axis=1)
    return farther


def _back(edges: _Edges, left: Floats, number: int) -> Floats:
    """(l, 2) the transpose of that."""
    pull = left[:, None] * edges.out
    columns = [
        np.bincount(edges.other, pull[:, axis], number) - np.bincount(edges.this, pull[:, axis], number)
        for axis in range(2)
    ]
    return np.column_stack(columns)


class _Pushes(NamedTuple):
    """Contours (k,) that push others along an axis, 0 for X and 1 for Y: in its sense."""

    this: Ints
    other: Ints
    axis: Ints

    def along(self, axis: int) -> list[tuple[int, int]]:
        """Pairs of those along one axis."""
        at = self.axis == axis
        return list(zip(self.this[at].tolist(), self.other[at].tolist(), strict=True))


def _along_axes(edges: _Edges, shapes: Shapes, kerf_um: float) -> Floats:
    """Moves (l, 2) of whole kerfs that part edges across X and Y by a kerf, or by more where that cannot be.

    What comes to lie nearer than a kerf by that, such as parts that touch in a corner, pushes each other, too.
    """
    if not len(edges.this):
        return np.zeros((len(shapes), 2))
    number, axis = len(shapes), np.abs(edges.out).argmax(axis=1)
    ahead = edges.out[np.arange(len(axis)), axis] > 0.0
    pushes = _Pushes(np.where(ahead, edges.this, edges.other), np.where(ahead, edges.other, edges.this), axis)
    by = np.column_stack([_levelled(pushes.along(each), number) for each in range(2)])
    parts = np.unique(np.append(pushes.this, pushes.other))
    for _ in range(_MOST_ROUNDS):
        more = _too_near(shapes, parts, kerf_um * by, kerf_um)
        if not len(more.this):
            break
        pushes = _Pushes(*(np.append(*columns) for columns in zip(pushes, more, strict=True)))
        by = np.column_stack([_pushed(pushes.along(each), number) for each in range(2)])
    return kerf_um * by


def _levelled(pairs: list[tuple[int, int]], number: int) -> Floats:
    """(l,) places by which the second of each pair lies one behind the first; where there are none, one at least."""
    neighbours = defaultdict[int, list[tuple[int, int]]](list)
    for this, other in pairs:
        neighbours[this].append((other, 1))
        neighbours[other].append((this, -1))
    at: dict[int, int] = {}
    for first in sorted(neighbours):
        if first in at:
            continue
        at[first], waiting, group = 0, [first], [first]
        for each in waiting:
            found = [(other, at[each] + step) for other, step in neighbours[each]]
            if any(at.get(other, place) != place for other, place in found):
                return _pushed(pairs, number)
            behind = [other for other, _ in dict(found).items() if other not in at]
            at.update(found)
            waiting += behind
            group += behind
        least = min(at[each] for each in group)
        at.update({each: at[each] - least for each in group})
    places = np.zeros(number)
    places[list(at)] = list(at.values())
    return places


def _pushed(pairs: list[tuple[int, int]], number: int) -> Floats:
    """(l,) the least places by which the second of each pair lies one or more behind the first; not for rings."""
    places = np.zeros(number)
    this, other = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    for _ in range(number):
        before = places.copy()
        np.maximum.at(places, other, places[this] + 1.0)
        if (places == before).all():
            break
    return places


def _too_near(shapes: Shapes, parts: Ints, by: Floats, kerf_um: float) -> _Pushes:
    """Parts that lie nearer than a kerf once they are moved, along the axis on which they lie farther apart."""
    moved = np.array([translate(shapes[at], *by[at].tolist()) for at in parts.tolist()])
    this, other = shapely.STRtree(moved).query(moved, predicate="dwithin", distance=kerf_um - _WRONG_UM)
    once = this < other
    this, other = parts[this[once]], parts[other[once]]
    bounds = shapely.bounds(shapes)
    ahead, behind = bounds[other, :2] - bounds[this, 2:], bounds[this, :2] - bounds[other, 2:]
    axis = np.maximum(ahead, behind).argmax(axis=1)
    at = np.arange(len(axis))
    is_ahead = ahead[at, axis] >= behind[at, axis]
    return _Pushes(np.where(is_ahead, this, other), np.where(is_ahead, other, this), axis)


def _moved(drawing: Drawing, shapes: Shapes, by: Floats, part: Ints, kerf_um: float) -> Drawing:
    """The drawing with its closed loops and the marks within them moved."""
    closed = [loop for loop in drawing.loops if loop.closed]
    of_row = np.zeros((len(drawing.curves), 2))
    for at, loop in enumerate(closed):
        of_row[loop.row] = by[part[at]] if part[at] >= 0 else 0.0
    curves = drawing.curves
    moved = replace(
        curves, start_um=curves.start_um + of_row, end_um=curves.end_um + of_row, center_um=curves.center_um + of_row
    )
    places = np.array([mark.place_um for mark in drawing.marks]).reshape(-1, 2)
    mark, around = shapely.STRtree(shapes).query(shapely.points(places), predicate="within")
    of_mark = np.zeros_like(places)
    is_part = part[around] == around
    of_mark[mark[is_part]] = by[around[is_part]]
    marks = tuple(
        each._replace(place_um=(float(x), float(y)))
        for each, (x, y) in zip(drawing.marks, (places + of_mark).tolist(), strict=True)
    )
    number = int((by != 0.0).any(axis=1).sum())
    values = {"number": number, "kerf_mm": mm(kerf_um), "most_mm": mm(float(np.hypot(*by.T).max()))}
    return replace(drawing, curves=moved, marks=marks, notes=(*drawing.notes, Remark("moved-apart", values)))
