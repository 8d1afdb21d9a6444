"""The way that closes a contour which begins and ends in the kerf of contours before it.

Two parts a kerf apart have an edge in common that one cut makes. The second of them needs to be cut from one end of it
round to the other alone: the kerf of the first one closes its contour.
"""

import heapq
from collections import defaultdict
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.arrangement import Edges, edges_of
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.shape.contours import are_in_kerf, closure_tolerance_um, runs
from parser.toolpath import Toolpath

_MOST_SETTLED: Final = 20_000  # corners of one search


class KerfWay(NamedTuple):
    """The way in the kerf of others from the end of a contour back to its start.

    Attributes
    ----------
    curves, backwards
        (m,) its curves as they were cut, and whether each is run from its end to its start.
    row
        (m,) rows of the toolpath that they are of.
    """

    curves: Curves
    backwards: Bools
    row: Ints


def kerf_ways(toolpath: Toolpath, first: Ints) -> dict[int, KerfWay]:
    """What closes those of the contours with first rows (k,) that begin and end in the kerf of others, by these rows.

    None for one that no way closes, of the paths before it.
    """
    whole = runs(toolpath)
    bounds: Ints = whole[np.isin(whole[:, 0], first)] - np.array([0, 1])
    arcs = [int(toolpath.is_arc[low : high + 1].sum()) for low, high in bounds.tolist()]
    tolerance = np.array([closure_tolerance_um(number) for number in arcs], dtype=np.float64)
    in_kerf = are_in_kerf(toolpath, bounds, tolerance)
    bounds = bounds[in_kerf]
    if not len(bounds):
        return {}
    cut = np.flatnonzero(~toolpath.is_jump)
    edges = edges_of(toolpath.picked(cut), float(tolerance[in_kerf].max()))
    graph = _Graph(edges._replace(row=cut[edges.row]))
    found: dict[int, KerfWay] = {}
    for low, high in bounds.tolist():
        way = graph.way(toolpath.end_um[high], toolpath.start_um[low], low)
        if way is not None:
            found[low] = way
    return found


class _Graph:
    """Edges between corners, along which ways are found."""

    def __init__(self, edges: Edges) -> None:
        self._edges = edges
        ends = np.concatenate([edges.curves.start_um, edges.curves.end_um])
        corner = edges.corner.T.ravel()
        self._place_um = np.zeros((int(corner.max()) + 1, 2))
        self._place_um[corner] = ends
        self._from = defaultdict[int, list[tuple[int, int, bool]]](list)
        for edge, (this, other) in enumerate(edges.corner.tolist()):
            self._from[this].append((edge, other, False))
            self._from[other].append((edge, this, True))

    def way(self, start_um: Floats, end_um: Floats, before: int) -> KerfWay | None:
        """The shortest way from a place to another one along edges of rows before one; None where none was found.

        Dijkstra (1959): corners are settled by their distance from the start.
        """
        start, end = (int(np.argmin(np.hypot(*(self._place_um - place).T))) for place in (start_um, end_um))
        length, row = self._edges.curves.length_um, self._edges.row
        came: dict[int, tuple[int, int, bool]] = {}
        least = {start: 0.0}
        waiting = [(0.0, start)]
        for _ in range(_MOST_SETTLED):
            if not waiting:
                break
            far, at = heapq.heappop(waiting)
            if at == end:
                return self._walked(came, start, end)
            for edge, other, is_back in self._from[at]:
                to = far + float(length[edge])
                if row[edge] < before and to < least.get(other, np.inf):
                    least[other], came[other] = to, (at, edge, is_back)
                    heapq.heappush(waiting, (to, other))
        return None

    def _walked(self, came: dict[int, tuple[int, int, bool]], start: int, end: int) -> KerfWay:
        """The way that was found, from its end back to its start and turned round."""
        edge, back, at = list[int](), list[bool](), end
        while at != start:
            at, number, is_back = came[at]
            edge.append(number)
            back.append(is_back)
        order = np.array(edge[::-1], dtype=np.int64)
        return KerfWay(self._edges.curves.picked(order), np.array(back[::-1], dtype=np.bool_), self._edges.row[order])
