"""Which contours that a program compensates are one edge: a program writes each pass over it along the same places."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from parser.geometry.along import along_um, headings_along, places
from parser.geometry.broad_phase_places import nearest_um
from parser.geometry.curves import Bools, Curves, Floats, extents
from parser.geometry.distance import distance_to_curves
from parser.shape.closing import CLOSED_WITHIN_UM

_ON_UM = CLOSED_WITHIN_UM  # whole µm, and arcs that were drawn anew for a later pass
_MOST = 0.5  # of a contour that runs along another


class Along(NamedTuple):
    """A contour among all of a program.

    Attributes
    ----------
    edge
        Number of its edge, from 0 in the order first cut.
    number
        Of its pass over this edge, from 1.
    is_back
        Whether it runs against the first pass over this edge.
    is_tab
        Whether it cuts what the first pass leaves between its ends.
    """

    edge: int
    number: int
    is_back: bool
    is_tab: bool


ALONE = Along(0, 1, is_back=False, is_tab=False)
"""The only contour."""


class _Edge(NamedTuple):
    """The first contour along an edge: its curves, its box (2, 2), its length, and whether it closes."""

    curves: Curves
    box_um: Floats
    length_um: float
    is_closed: bool


def edges_of_contours(contours: Sequence[Curves]) -> tuple[Along, ...]:
    """Edges of the contours, each of them in the order in which it is cut."""
    ones = [_edge(curves) for curves in contours]
    boxes = np.empty((2, 2, len(ones)))  # of the first contour of each edge: low and high, X and Y
    first: list[int] = []  # contour of each edge
    counts: list[int] = []
    found = []
    for at, each_one in enumerate(ones):
        near = np.flatnonzero(_meets(boxes[:, :, : len(first)], each_one.box_um)).tolist()
        of, is_tab = next(_matches(each_one, {edge: ones[first[edge]] for edge in near}), (len(first), False))
        if of == len(first):
            boxes[:, :, of] = each_one.box_um
            first.append(at)
            counts.append(0)
        counts[of] += 1
        is_back = counts[of] > 1 and _is_back(each_one, ones[first[of]], is_tab)
        found.append(Along(of, counts[of], is_back, is_tab))
    return tuple(found)


def _meets(boxes_um: Floats, box_um: Floats) -> Bools:
    """(k,) whether boxes (2, 2, k) overlap another one (2, 2); by whole columns, for there may be thousands."""
    (low_x, low_y), (high_x, high_y) = boxes_um
    (x0, y0), (x1, y1) = (box_um[0] - _ON_UM).tolist(), (box_um[1] + _ON_UM).tolist()
    overlaps: Bools = (low_x <= x1) & (high_x >= x0) & (low_y <= y1) & (high_y >= y0)
    return overlaps


def _edge(curves: Curves) -> _Edge:
    low, high = extents(curves)
    gap_um = float(np.hypot(*(curves.end_um[-1] - curves.start_um[0])))
    box = np.stack([low.min(axis=0), high.max(axis=0)])
    return _Edge(curves, box, float(curves.length_um.sum()), gap_um <= CLOSED_WITHIN_UM)


def _matches(each_edge: _Edge, edges: Mapping[int, _Edge]) -> Iterator[tuple[int, bool]]:
    """Of some edges, by their numbers, those that a contour runs along, or whose tab it cuts."""
    for number, other in edges.items():
        shorter, longer = sorted((each_edge, other), key=lambda edge: edge.length_um)
        if shorter.length_um >= _MOST * longer.length_um and _share_on(shorter.curves, longer.curves) >= _MOST:
            yield number, False
        elif _is_tab(each_edge, other):
            yield number, True


def _share_on(curves: Curves, other: Curves) -> float:
    """Share of the length of curves that runs along others, by the middles of the curves."""
    middle = places(curves, np.arange(len(curves)), np.full(len(curves), 0.5))
    on = nearest_um(other, middle, _ON_UM) <= _ON_UM
    return float(curves.length_um[on].sum() / max(float(curves.length_um.sum()), 1e-9))


def _is_tab(this: _Edge, other: _Edge) -> bool:
    """Whether a contour goes from one end of an open one to the other, at most a little way along it."""
    if other.is_closed or this.is_closed or this.length_um > _MOST * other.length_um:
        return False
    ends = np.stack([other.curves.start_um[0], other.curves.end_um[-1]])
    return bool((nearest_um(this.curves, ends, _ON_UM) <= _ON_UM).all())


def _is_back(edge: _Edge, first: _Edge, is_tab: bool) -> bool:
    """Whether a contour runs against the first one along its edge, or its tab from the start of that one to its end."""
    if is_tab:
        from_end = np.hypot(*(edge.curves.start_um[0] - first.curves.end_um[-1]))
        return bool(np.hypot(*(edge.curves.start_um[0] - first.curves.start_um[0])) < from_end)
    row = np.array([int(np.argmax(edge.curves.length_um))])
    place = places(edge.curves, row, np.array([0.5]))
    rows = np.arange(len(first.curves))
    off, _ = distance_to_curves(first.curves, rows, *np.broadcast_to(place, (len(rows), 2)).T)
    near = np.array([int(np.argmin(off))])
    way = headings_along(first.curves, near, along_um(first.curves, near, place))
    own = headings_along(edge.curves, row, 0.5 * edge.curves.length_um[row])
    return float((way * own).sum()) < 0.0
