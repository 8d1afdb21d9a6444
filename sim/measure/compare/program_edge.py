"""The cut edge of a program: the innermost edge that its passes leave beside each loop, on the side of the part.

The edge that several passes over it leave: of all their kerfs, whatever each of them leaves, or does not reach.

Lead-ins and lead-outs that cut into the part: how deep their kerf reaches past the edge.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from controller.offset.reach import reach
from controller.offset.shifted import Side
from parser.findings.catalogue import Remark
from parser.geometry.along import deepest, headings_at, places
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import feet
from parser.toolpath import Point, Toolpath
from sim.cut.kerf.edges import nominal_region
from sim.cut.regions import cut_by_blocks, union_all
from sim.measure.compare.nearest import Index, indexed, nearest
from sim.measure.compare.result import Edge, LeadGouge
from sim.measure.compare.rings import PathEdge, PathLoop, PathPass, Rings, orientation, polygon, rings_of

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


_SLIT_UM = 0.005  # half of what rounding may leave open between shapes of a kerf that abut
_SIMPLER_UM = 0.01
_CRUMB_UM2 = 1000.0  # 30 µm square: cusps between kerfs, no part
_OF_PART = 0.75  # of an outline: half of a band that two passes leave between them lies on the side of the waste


def left_by_passes(passes: Sequence[PathPass], part_side: int, offset_um: float) -> list[PathLoop]:
    """Loops of the edge on the side of the part, +1 on the left of the first pass; none where they leave a gap.

    Each side of them belongs to the pass that cut nearest, of equal ones to the last. Arcs are polylines, right to
    0.02 µm. RegionError where the kerfs could not be joined.
    """
    with cut_by_blocks(*(int(end(each.block)) for end, each in ((np.min, passes[0]), (np.max, passes[-1])))):
        kerf = union_all(
            [
                nominal_region(curves, np.ones(len(curves), np.bool_), np.full(len(curves), offset_um))
                for curves in (path_pass.curves for path_pass in passes)
            ]
        )
    kerf = kerf.buffer(_SLIT_UM, join_style="mitre").buffer(-_SLIT_UM, join_style="mitre")
    latest = list(reversed(passes))
    cut = joined([each.curves for each in latest])
    block = np.concatenate([each.block for each in latest])
    side = part_side * np.repeat([each.sense for each in latest], [len(each.curves) for each in latest])
    index, loops = indexed(cut), []
    for corner, of_part in _outlines(kerf):
        none = np.full((len(corner) - 1, 2), np.nan)
        curves = curves_between(corner[:-1], corner[1:], none, np.zeros(len(corner) - 1))
        middle = places(curves, np.arange(len(curves)), np.full(len(curves), 0.5))
        row = nearest(index, middle).row
        foot = feet(cut, row, middle).place_um
        way, out = headings_at(cut, row, foot), middle - foot
        is_on_side = np.sign(way[:, 0] * out[:, 1] - way[:, 1] * out[:, 0]) == side[row]
        if float(np.average(is_on_side, weights=curves.length_um)) >= _OF_PART:
            loops.append(PathLoop(curves, block[row], of_part))
    return loops


def _outlines(kerf: shapely.Geometry) -> Iterator[tuple[Floats, int]]:
    """Corners (m, 2) of the outlines of a kerf, counter-clockwise, and the side on which it does not lie."""
    for body in shapely.get_parts(kerf).tolist():
        rings = [(body.exterior, -1), *((ring, 1) for ring in body.interiors)]
        for ring, free_side in rings:
            filled = orient(shapely.simplify(shapely.Polygon(ring), _SIMPLER_UM))
            if filled.area >= _CRUMB_UM2:
                yield np.asarray(filled.exterior.coords)[:, :2], free_side


class ProgramEdges(NamedTuple):
    """A program's loops with the sides of their parts.

    `sides` are one or two guesses (k,) of them, +1 left, −1 right: the second where no lead-in tells a side.
    """

    rings: Rings
    sides: tuple[Ints, ...]
    offset_um: float

    def alone(self, at: int) -> "ProgramEdges":
        """One of the rings by itself."""
        rings = self.rings._replace(rings=self.rings.rings[at : at + 1], open_blocks=())
        return self._replace(rings=rings, sides=tuple(sides[[at]] for sides in self.sides))


def program_edges(toolpath: Toolpath, offset_um: float) -> ProgramEdges:
    """Loops and sides of a program whose wire cuts `offset_um` past its path; no loop where no contour closes."""
    rings = rings_of(toolpath)
    side = np.array([ring.part_side for ring in rings.rings], dtype=np.int64)
    if side.all():
        return ProgramEdges(rings, (side,), offset_um)
    nested = _nested_sides(rings.rings)
    return ProgramEdges(rings, tuple(np.where(side == 0, guess, side) for guess in (nested, -nested)), offset_um)


def _nested_sides(rings: Sequence[PathEdge]) -> Ints:
    """Side (k,) of each ring's part, +1 left, −1 right, if outermost rings are parts and those in them holes."""
    shapes = [polygon(ring.loop.curves) for ring in rings]
    begins = shapely.points([ring.loop.curves.start_um[0] for ring in rings])
    inner, _ = shapely.STRtree(shapes).query(begins, predicate="within")
    depth = np.bincount(inner, minlength=len(rings))
    turns = np.array([orientation(ring.loop.curves) for ring in rings], dtype=np.int64)
    return turns * np.where(depth % 2 == 0, 1, -1)


def edge_at(of: ProgramEdges, sides: Ints, offset_um: float) -> Edge:
    """The edge `offset_um` to the side of the part, negative to the other side, 0 for the path itself.

    A wire cuts it where the offset is above 0; the others tell only where an edge would lie.
    """
    loops, notes = [], []
    for ring, side in zip(of.rings.rings, sides.tolist(), strict=True):
        made = _moved(ring, side, offset_um)
        if not made:
            span = dict(zip(("first", "last"), ring.last_blocks, strict=True))
            remark = Remark("no-edge-beside", {**span, "offset": offset_um})
            # Several passes leave none where they leave a gap, such as a tab that is never cut.
            notes.append(Remark("no-loop", span) if len(ring.passes) > 1 else remark)
        loops += made
    notes += [Remark("no-loop", {"first": first, "last": last}) for first, last in of.rings.open_blocks]
    if not loops:
        nothing = np.empty(0, dtype=np.int64)
        return Edge(of.rings.leads.picked(nothing), nothing, nothing, nothing, offset_um, notes=tuple(notes))
    number = [len(loop.curves) for loop in loops]
    return Edge(
        curves=joined([loop.curves for loop in loops]),
        block=np.concatenate([loop.block for loop in loops]),
        loop=np.repeat(np.arange(len(loops)), number),
        part_side=np.repeat(np.array([loop.part_side for loop in loops], dtype=np.int64), number),
        offset_um=offset_um,
        reach_um=max(offset_um, 0.0),
        notes=tuple(notes),
    )


def with_gouges(of: ProgramEdges, edge: Edge) -> Edge:
    """The edge with what the program's leads cut into parts.

    A lead is held against every part that is cut out, and against the frame round the openings of its own contour: what
    it cuts of the frame beside the openings of others, as on its way to a punch, is no gouge.
    """
    rings, reach_um = of.rings, of.offset_um
    cut_out, ring_of_loop = of_parts(edge), _ring_of_loop(of, edge)
    found = [gouges(edge.on(np.flatnonzero(cut_out)), rings.leads, rings.lead_block, reach_um)]
    in_contour: dict[int, list[int]] = {}
    for at, ring in enumerate(rings.rings):
        for contour in ring.contours.tolist():
            in_contour.setdefault(contour, []).append(at)
    for contour in np.unique(rings.lead_contour).tolist():
        own = np.flatnonzero(np.isin(ring_of_loop, in_contour[contour]) & ~cut_out)
        leads = np.flatnonzero(rings.lead_contour == contour)
        found.append(gouges(edge.on(own), rings.leads.picked(leads), rings.lead_block[leads], reach_um))
    return replace(edge, gouges=tuple(sorted(gouge for each in found for gouge in each)))


def _ring_of_loop(of: ProgramEdges, edge: Edge) -> Ints:
    """Which ring each loop (k,) of the edge is of: that whose passes its blocks are in."""
    ring_of_block = np.zeros(max(int(ring.block.max()) for ring in of.rings.rings) + 1, dtype=np.int64)
    for at, ring in enumerate(of.rings.rings):
        ring_of_block[ring.block] = at
    first_row = np.flatnonzero(np.diff(edge.loop, prepend=-1))
    of_loop: Ints = ring_of_block[edge.block[first_row]]
    return of_loop


def _moved(ring: PathEdge, side: int, offset_um: float) -> list[PathLoop]:
    """The edge of a ring, in as many pieces as that makes: of one pass, or of several what all of them leave.

    On the other side, and on the path itself, it is that of the last pass.
    """
    if offset_um > 0.0 and len(ring.passes) > 1:
        return left_by_passes(ring.passes, side, offset_um)
    curves, block, _ = ring.loop
    if offset_um == 0.0:
        return [PathLoop(curves, block, side)]
    toward = Side(side if offset_um > 0.0 else -side)
    reached = reach(curves, abs(offset_um), toward)
    return [PathLoop(loop.curves, block[loop.source_row], side) for loop in reached.loops]
