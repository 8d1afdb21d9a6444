"""Leads that cut into the part: their kerf reaches past the edge that the last pass leaves.

How deep one cuts does not depend on the wire, whose kerf reaches as far beside a lead as beside a pass. So the path of
the lead is held against that of the pass that runs nearest to the part: what of it lies on the part's side is cut out
of the part. A comparison with a drawing does the same with the edges (`sim/measure/compare/program_edge.py`).
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import at_block
from parser.findings.findings import Finding
from parser.geometry.along import corners, deepest, runs_back_over
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between
from parser.geometry.distance import distance_to_curves
from parser.program import Program
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.shape.passes import Pass, Passes, leads_of
from parser.toolpath import Toolpath
from parser.units import mm

_RIGHT_TO_UM = 0.5
_SAGITTA_UM = 1.0  # of the chords of an outline, which tells only on which side of it a place lies
_MOST_RAD = 2.0 * np.pi + 1e-3  # of an arc: past that it is no side of a ring (3B210)
_MOST_BLOCKS = 8  # of a way out to the start hole and back: loops begin behind no more than four
_CHUNK = 1 << 18  # pairs of a place and a block looked at in one go: some 40 MB


class _Rings(NamedTuple):
    """Closed ways round k edges, each along the passes that run nearest to the part.

    Attributes
    ----------
    row, first
        (n,) rows of the toolpath, ring after ring, and (k + 1,) where each ring begins among them.
    bridge, bridge_first
        Lines (b,) from the end of each pass to the start of the next one round the ring, and (k + 1,) where each ring's
        begin.
    corner_um, corner
        (m, 2) their outlines, and (k + 1,) where each begins among them.
    holds_part
        (k,) whether the part lies within.
    """

    row: Ints
    first: Ints
    bridge: Curves
    bridge_first: Ints
    corner_um: Floats
    corner: Ints
    holds_part: Bools


class _Pairs(NamedTuple):
    """Leads and the rings that they are held against, pairs (m,): rows of the toolpath, and numbers of rings."""

    row: Ints
    ring: Ints


def gouge_findings(program: Program, contour: Ints, passes: Passes) -> Iterator[Finding]:
    """Finding 3B321 at each lead that cuts more than `CLOSED_WITHIN_UM` into the part.

    `contour` (n,) is each row's, −1 where it is not judged.
    """
    toolpath = program.toolpath
    ring_of_edge, rings = _rings(toolpath, contour, passes)
    pairs = _pairs(toolpath, contour, passes, ring_of_edge)
    if not len(pairs.row):
        return

    def depth_of(at: Ints, place_um: Floats) -> Floats:
        return _depth_um(toolpath, rings, pairs.ring[at], place_um)

    leads = toolpath.picked(pairs.row)
    found = deepest(leads, depth_of, CLOSED_WITHIN_UM, _RIGHT_TO_UM)
    cuts_in = found.depth_um > CLOSED_WITHIN_UM
    if cuts_in.any():
        cuts_in &= ~_in_slits(pairs, depth_of, leads)
    for at in np.flatnonzero(cuts_in).tolist():
        x_um, y_um = found.place_um[at].tolist()
        values = {"by": float(found.depth_um[at]), "x_mm": mm(x_um), "y_mm": mm(y_um)}
        yield at_block(toolpath, program.lines, "3B321", int(pairs.row[at]), **values)


def _rings(toolpath: Toolpath, contour: Ints, passes: Passes) -> tuple[Ints, _Rings]:
    """The ring (e,) of each edge, −1 of one that is open, not judged, or whose part nobody knows; and the rings."""
    over: dict[int, tuple[list[Pass], list[Pass]]] = {}
    for pass_ in passes.passes:
        over.setdefault(pass_.edge, ([], []))[pass_.is_tab].append(pass_)
    ring_of_edge = np.full(max(over, default=-1) + 1, -1, dtype=np.int64)
    own: list[tuple[Pass, ...]] = []
    turn_rad = np.abs(toolpath.sweep_rad)
    for edge, (main, tab) in over.items():
        ring = tuple(_nearest(part) for part in (main, tab) if part)
        last = ring[0]
        is_known = bool(main) and last.part_side != 0 and contour[last.first] >= 0 and (last.is_closed or bool(tab))
        if is_known and not any((turn_rad[each.first : each.last + 1] > _MOST_RAD).any() for each in ring):
            ring_of_edge[edge] = len(own)
            own.append(ring)
    rows = [np.arange(each.first, each.last + 1) for ring in own for each in ring]
    row = np.concatenate([np.zeros(0, dtype=np.int64), *rows])
    first = np.cumsum([0, *(sum(each.last + 1 - each.first for each in ring) for ring in own)])
    corner_um, of = corners(toolpath.picked(row), _SAGITTA_UM)
    corner = np.searchsorted(of, first)
    side = np.array([ring[0].part_side for ring in own], dtype=np.int64)
    bridge, holds_part = _bridges(toolpath, own), np.asarray(_areas(corner_um, corner) * side > 0.0)
    bridge_first = np.cumsum([0, *map(len, own)])
    return ring_of_edge, _Rings(row, first, bridge, bridge_first, corner_um, corner, holds_part)


def _bridges(toolpath: Toolpath, rings: list[tuple[Pass, ...]]) -> Curves:
    """Lines from the end of each pass to the start of the next one round its ring; short where the path closes."""
    last = np.array([each.last for ring in rings for each in ring], dtype=np.int64)
    first = np.array([each.first for ring in rings for each in (*ring[1:], ring[0])], dtype=np.int64)
    start, end = toolpath.end_um[last], toolpath.start_um[first]
    return curves_between(start, end, np.full_like(start, np.nan), np.zeros(len(last)))


def _nearest(passes: list[Pass]) -> Pass:
    """Of passes over one edge the last of those that run nearest to the part."""
    return [pass_ for pass_ in passes if pass_.shift_um <= pass_.edge_um][-1]


def _areas(corner_um: Floats, first: Ints) -> Floats:
    """Twice the areas (k,) within corners (m, 2) that begin at `first` (k + 1,), negative where they run clockwise."""
    if len(first) < 2:
        return np.zeros(0)
    from_first = corner_um - np.repeat(corner_um[first[:-1]], np.diff(first), axis=0)
    x, y = from_first.T
    cross = np.append(x[:-1] * y[1:] - x[1:] * y[:-1], 0.0)
    cross[first[1:] - 1] = 0.0  # the last side of a ring leads to its first corner, which is (0, 0) here
    return np.add.reduceat(cross, first[:-1])


def _pairs(toolpath: Toolpath, contour: Ints, passes: Passes, ring_of_edge: Ints) -> _Pairs:
    """Each lead with the ring of the passes before and behind it in its contour.

    A way from one edge to another is no lead: where it is cut, 3B310 says so. Nor is one of many blocks, which may be
    a pass that was not found.
    """
    is_lead = leads_of(passes, toolpath) & (contour >= 0)
    begins = is_lead & ~(np.append(False, is_lead[:-1]) & (contour == np.append(-1, contour[:-1])))
    number = np.cumsum(begins) - 1
    blocks = np.bincount(number[is_lead], minlength=1)
    row = np.flatnonzero(is_lead)
    row = row[blocks[number[row]] <= _MOST_BLOCKS]
    first = np.array([pass_.first for pass_ in passes.passes], dtype=np.int64)
    edge = np.array([pass_.edge for pass_ in passes.passes], dtype=np.int64)
    if not len(first):
        return _Pairs(row[:0], row[:0])
    later = np.searchsorted(first, row)
    around = np.stack([later - 1, later], axis=1)
    there = (around >= 0) & (around < len(first))
    around = np.clip(around, 0, len(first) - 1)
    there &= contour[first[around]] == contour[row][:, None]
    of = np.where(there, edge[around], -1)
    own = np.where((of[:, 0] == of[:, 1]) | (of.min(axis=1) < 0), of.max(axis=1), -1)
    ring = np.where(own >= 0, ring_of_edge[own], -1)
    at = np.flatnonzero(ring >= 0)
    return _Pairs(row[at], ring[at])


def _in_slits(pairs: _Pairs, depth_of: Callable[[Ints, Floats], Floats], leads: Curves) -> Bools:
    """(m,) whether a lead is one of those that leave the edge into the part and come back to where they left it.

    The first of them begins on the edge, and none comes out of the part: such a slit is meant. So is one of a single
    block that ends in the part, and over which the next block runs back, however far beyond.
    """
    order = np.lexsort((pairs.row, pairs.ring))
    ring, row, ways = pairs.ring[order], pairs.row[order], leads.picked(order)
    start, end = depth_of(order, ways.start_um), depth_of(order, ways.end_um)
    begins = (np.diff(ring, prepend=-1) != 0) | (np.diff(row, prepend=-2) != 1) | (np.abs(start) <= CLOSED_WITHIN_UM)
    first = np.flatnonzero(begins)
    last = np.append(first[1:], len(order)) - 1
    shallowest = np.minimum.reduceat(np.minimum(start, end), first)
    apart = np.hypot(*(ways.end_um[last] - ways.start_um[first]).T)
    whole = (shallowest >= -CLOSED_WITHIN_UM) & (apart <= CLOSED_WITHIN_UM)
    slit = whole[np.cumsum(begins) - 1]
    at = np.flatnonzero((np.abs(start[:-1]) <= CLOSED_WITHIN_UM) & (end[:-1] > CLOSED_WITHIN_UM))
    at = at[(ring[at + 1] == ring[at]) & (row[at + 1] == row[at] + 1)]
    at = at[runs_back_over(ways, at, at + 1)]
    slit[at] = slit[at + 1] = True
    found = np.zeros(len(order), dtype=np.bool_)
    found[order] = slit
    return found


def _depth_um(toolpath: Toolpath, rings: _Rings, ring: Ints, place_um: Floats) -> Floats:
    """How far (m,) places (m, 2) lie on the part's side of their rings (m,), negative on the other side."""
    depth = np.empty(len(ring))
    most = max(int(np.diff(rings.corner).max()), int(np.diff(rings.first).max()))
    for low in range(0, len(ring), max(_CHUNK // most, 1)):
        part = slice(low, low + max(_CHUNK // most, 1))
        away, inside = _away(toolpath, rings, ring[part], place_um[part]), _is_within(rings, ring[part], place_um[part])
        depth[part] = np.where(inside == rings.holds_part[ring[part]], away, -away)
    return depth


def _away(toolpath: Toolpath, rings: _Rings, ring: Ints, place_um: Floats) -> Floats:
    """Distances (m,) of places from the blocks of their rings, and what bridges these."""
    at, of, begin = _each(rings.first, ring)
    from_blocks, _ = distance_to_curves(toolpath, rings.row[at], place_um[of, 0], place_um[of, 1])
    at, of, begin_bridge = _each(rings.bridge_first, ring)
    from_bridges, _ = distance_to_curves(rings.bridge, at, place_um[of, 0], place_um[of, 1])
    return np.minimum(np.minimum.reduceat(from_blocks, begin), np.minimum.reduceat(from_bridges, begin_bridge))


def _is_within(rings: _Rings, ring: Ints, place_um: Floats) -> Bools:
    """(m,) whether places lie within the outlines of their rings: a ray crosses those an odd number of times."""
    at, of, begin = _each(rings.corner, ring)
    following = at + 1
    following[np.append(begin[1:], len(at)) - 1] = rings.corner[ring]
    begins, ends = rings.corner_um[at], rings.corner_um[following]
    x, y = place_um[of].T
    rises = np.flatnonzero((begins[:, 1] > y) != (ends[:, 1] > y))
    begins, ends, x, y = begins[rises], ends[rises], x[rises], y[rises]
    crosses = x < begins[:, 0] + (y - begins[:, 1]) * (ends[:, 0] - begins[:, 0]) / (ends[:, 1] - begins[:, 1])
    inside: Bools = np.bincount(of[rises], weights=crosses, minlength=len(ring)) % 2 == 1
    return inside


def _each(first: Ints, ring: Ints) -> tuple[Ints, Ints, Ints]:
    """All entries of the rings (m,), one ring behind the other: entry, which of m it is of, and where each begins."""
    count = np.diff(first)[ring]
    begin = np.cumsum(count) - count
    of = np.repeat(np.arange(len(ring)), count)
    return first[ring][of] + np.arange(len(of)) - begin[of], of, begin
