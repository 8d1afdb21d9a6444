"""Lead-ins and lead-outs that cut into the part: how deep their kerf reaches past the edge."""

from typing import NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.deepest import deepest
from parser.toolpath import Point
from sim.measure.compare.edge import Edge, LeadGouge
from sim.measure.compare.nearest import Index, indexed, nearest
from sim.measure.compare.rings import orientation, polygon

_LEAST_UM = 1.0  # shallower, it is the rounding of the program's ends
_RIGHT_TO_UM = 0.5


class _Part(NamedTuple):
    """The edge with its loops as polygons, and of each whether the part lies inside, and where it is known."""

    nearest: Index
    loop: Ints
    shapes: shapely.STRtree
    inside: Ints
    known: Ints


def gouges(edge: Edge, leads: Curves, block: Ints, offset_um: float) -> tuple[LeadGouge, ...]:
    """Gouges of leads (m,) made by blocks (m,), each deepest place right to 0.5 µm, by block.

    The kerf reaches the offset past the wire's centre. So a wire that stands d inside of the part has cut as deep as
    the offset plus d; one that stands d outside, as the offset less d.
    """
    if not len(leads) or not len(edge.curves):
        return ()
    part = _part(edge)
    depth_um, place_um = deepest(leads, lambda _, place: _depth(part, place, offset_um), _LEAST_UM, _RIGHT_TO_UM)
    found = [
        LeadGouge(int(block[at]), Point(*place_um[at].tolist()), float(depth_um[at]))
        for at in np.flatnonzero(depth_um > _LEAST_UM).tolist()
    ]
    return tuple(sorted(found))


def of_parts(edge: Edge) -> Bools:
    """(k,) whether each loop of an edge is round a part, or round an opening of one; else it is one of the frame."""
    loops = _loops(edge)
    within = _within(edge, loops)
    shapes = shapely.STRtree([polygon(loops[at]) for at in np.flatnonzero(within).tolist()])
    begins = shapely.points([loop.start_um[0] for loop in loops])
    found = within.copy()
    found[shapes.query(begins, predicate="within")[0]] = True
    return found


def _within(edge: Edge, loops: list[Curves]) -> Bools:
    """(k,) whether the part lies within each loop."""
    sides = edge.part_side[np.searchsorted(edge.loop, np.arange(len(loops)))]
    within: Bools = sides == np.array([orientation(loop) for loop in loops])
    return within


def _loops(edge: Edge) -> list[Curves]:
    return [edge.curves.picked(edge.loop == of) for of in range(int(edge.loop.max()) + 1)]


def _part(edge: Edge) -> _Part:
    loops = _loops(edge)
    shapes = shapely.STRtree([polygon(loop) for loop in loops])
    known = edge.part_side[np.searchsorted(edge.loop, np.arange(len(loops)))] != 0
    return _Part(indexed(edge.curves), edge.loop, shapes, _within(edge, loops).astype(np.int64), known.astype(np.int64))


def _depth(part: _Part, place_um: Floats, offset_um: float) -> Floats:
    """How deep (m,) µm a wire at places (m, 2) cuts into the part, negative by how far it stays off."""
    near = nearest(part.nearest, place_um)
    loop = part.loop[near.row]
    place, within = part.shapes.query(shapely.points(place_um), predicate="within")
    inside = np.zeros(len(place_um), dtype=np.int64)
    inside[place[within == loop[place]]] = 1
    into = np.where(inside == part.inside[loop], near.distance_um, -near.distance_um)
    return np.where(part.known[loop] == 1, offset_um + into, -np.inf)
