"""The edges that a cut leaves: what the wire's path cuts along each, and the outlines of the kerf, block by block.

What the wire's path cuts along each edge: its passes, each closed one cut to one turn, and the leads beside them.

The edge of a part as it was cut: the outlines that the kerf left of it, with the blocks that cut them.

Closed outlines with fewer corners, each of those left out within a stated distance of the side that replaces it.

From a corner that stays, a side may run to a later one as long as it passes all corners between within that distance:
each of them leaves open a sector of directions, and the side has to run within them all (Z. Zhao and A. Saalfeld,
Linear-time sleeve-fitting polyline simplification algorithms, 1997).
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from controller.compiled.loops import compiled, loop_part
from parser.drawing.model import running
from parser.findings.errors import SettingsError
from parser.geometry.along import outline, places
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import feet
from parser.shape.contours import CLOSED_WITHIN_UM, contour_rows, runs
from parser.shape.kerf_ways import KerfWay, kerf_ways
from parser.shape.passes import Pass, Passes, find_passes
from parser.toolpath import Toolpath
from sim.cut.kerf.swept import Kerf
from sim.cut.kerf.ways import NOBODY, rows_that_made
from sim.cut.pieces.kept_edges import kept_shapes
from sim.cut.pieces.pieces import Pieces
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.result import Edge

MOST_CONTOURS = 2_000
"""Contours of a program that are compared: overlapping ones cost some 0.04 s each."""
MOST_PASSES = 10_000
"""Passes over all of them: five over each of the most contours."""


class PathLoop(NamedTuple):
    """One closed loop: its curves, end to start, and the block of each; `part_side` +1 with the part on the left."""

    curves: Curves
    block: Ints
    part_side: int


class PathPass(NamedTuple):
    """One pass over an edge: its curves and the block of each; `sense` is −1 where it runs against the first one."""

    curves: Curves
    block: Ints
    sense: int


class PathEdge(NamedTuple):
    """What the wire cuts along one edge.

    Attributes
    ----------
    passes
        In the order they are cut.
    loop
        The way round of the last of them, of the last one over the tab too, run as the first pass; gaps are bridged.
    part_side
        +1 with the part on the left of the loop, −1 on the right, 0 where no lead-in tells.
    contours
        Numbers of the contours that they are cut in.
    """

    passes: tuple[PathPass, ...]
    loop: PathPass
    part_side: int
    contours: Ints

    @property
    def block(self) -> Ints:
        """Blocks of all passes."""
        return np.concatenate([pass_.block for pass_ in self.passes])

    @property
    def last_blocks(self) -> tuple[int, int]:
        """The first and the last block of the last way round."""
        return int(self.loop.block.min()), int(self.loop.block.max())


class Rings(NamedTuple):
    """Edges of a program; `leads` is cut beside any pass over them, by which blocks and in which contours (m,).

    `open_blocks` are the first and last blocks of contours that close no loop.
    """

    rings: tuple[PathEdge, ...]
    leads: Curves
    lead_block: Ints
    lead_contour: Ints
    open_blocks: tuple[tuple[int, int], ...]


def rings_of(toolpath: Toolpath) -> Rings:
    """Edges of all contours, the leads beside them, and the contours without one.

    SettingsError where there are more than `MOST_CONTOURS` edges or `MOST_PASSES` passes.
    """
    found = find_passes(toolpath)
    edges = _by_edge(found)
    _refuse_too_many(edges)
    block, contour, rows = toolpath.source.block, contour_rows(toolpath), runs(toolpath)
    is_open = np.array([passes[0].first for passes in edges if not _is_ring(passes)], dtype=np.int64)
    closing = kerf_ways(toolpath, rows[contour[is_open], 0])
    rings, open_blocks, within = [], [], []
    leads: list[PathPass] = []
    for passes in edges:
        of = int(contour[passes[0].first])
        way = closing.get(int(rows[of, 0]))
        if way is not None and not _is_ring(passes):
            rings.append(_closed_by_kerf(toolpath, slice(*rows[of].tolist()), way, of))
            continue
        if not _is_ring(passes):
            open_blocks.append((int(block[passes[0].first]), int(block[passes[0].last])))
            continue
        made, rests = zip(*(_path(toolpath, pass_) for pass_ in passes), strict=True)
        contours = contour[[pass_.first for pass_ in passes]]
        rings.append(PathEdge(made, _way_round(passes, made), _part_side(passes), np.unique(contours)))
        leads += rests
        within += [np.full(len(rest.block), of) for rest, of in zip(rests, contours.tolist(), strict=True)]
    led = np.concatenate([ring.contours for ring in rings]) if rings else np.empty(0, dtype=np.int64)
    is_lead = (found.of_row < 0) & (contour >= 0) & np.isin(contour, led)
    leads.append(PathPass(toolpath.picked(is_lead), block[is_lead], 1))
    return Rings(
        rings=tuple(rings),
        leads=joined([lead.curves for lead in leads]),
        lead_block=np.concatenate([lead.block for lead in leads]),
        lead_contour=np.concatenate([*within, contour[is_lead]]),
        open_blocks=tuple(open_blocks),
    )


def _closed_by_kerf(toolpath: Toolpath, rows: slice, way: KerfWay, contour: int) -> PathEdge:
    """The edge of a contour, some rows, that begins and ends in the kerf of others; it encloses the part."""
    back = running(way.curves, np.arange(len(way.row)), way.backwards)
    # Its ends are those of the contour, and of each curve the end of the one before it: whole µm part them.
    back = replace(
        back,
        start_um=np.concatenate([toolpath.end_um[rows][-1:], back.end_um[:-1]]),
        end_um=np.concatenate([back.end_um[:-1], toolpath.start_um[rows][:1]]),
    )
    block = toolpath.source.block
    ring = joined([toolpath.picked(rows), back])
    loop = PathPass(ring, np.concatenate([block[rows], block[way.row]]), 1)
    return PathEdge((loop,), loop, orientation(ring), np.array([contour], dtype=np.int64))


def _by_edge(found: Passes) -> list[list[Pass]]:
    """The passes over each edge."""
    edges: dict[int, list[Pass]] = {}
    for pass_ in found.passes:
        edges.setdefault(pass_.edge, []).append(pass_)
    return list(edges.values())


def _is_ring(passes: Sequence[Pass]) -> bool:
    return len(passes) > 1 or passes[0].is_closed


def _refuse_too_many(edges: Sequence[Sequence[Pass]]) -> None:
    rings = [len(passes) for passes in edges if _is_ring(passes)]
    if len(rings) > MOST_CONTOURS:
        raise SettingsError("too-many-contours", found=len(rings), most=MOST_CONTOURS)
    if sum(rings) > MOST_PASSES:
        raise SettingsError("too-many-passes", found=sum(rings), most=MOST_PASSES)


def _path(toolpath: Toolpath, pass_: Pass) -> tuple[PathPass, PathPass]:
    """The path of a pass, one turn of it where it closes, and what is cut behind that turn."""
    row = np.arange(pass_.first, pass_.last + 1)
    block, sense = toolpath.source.block[row], -1 if pass_.is_back else 1
    if not pass_.is_closed:
        return PathPass(toolpath.picked(row), block, sense), PathPass(toolpath.picked(row[:0]), block[:0], sense)
    alone = pass_.first == pass_.last
    to_start, rest = _parted(toolpath.picked(row[-1:]), toolpath.start_um[pass_.first], alone=alone)
    ring = PathPass(joined([toolpath.picked(row[:-1]), to_start]), block, sense)
    return ring, PathPass(rest, block[len(row) - len(rest) :], sense)


def _part_side(passes: Sequence[Pass]) -> int:
    """Side of the part along the first pass over an edge, told by the first pass that has one."""
    told_passes = (-pass_.part_side if pass_.is_back else pass_.part_side for pass_ in passes)
    return next((side for side in told_passes if side), 0)


def _way_round(passes: Sequence[Pass], made: Sequence[PathPass]) -> PathPass:
    """The last pass all along the edge, and the last one over the tab behind it, run as the first pass."""
    last = [
        max((at for at, pass_ in enumerate(passes) if pass_.is_tab == is_tab), default=None) for is_tab in (False, True)
    ]
    ahead = [_ahead(made[at]) for at in last if at is not None]
    if len(ahead) == 1:
        return ahead[0]
    return PathPass(joined([each.curves for each in ahead]), np.concatenate([each.block for each in ahead]), 1)


def _ahead(path_pass: PathPass) -> PathPass:
    """A pass, turned round where it runs against the first one."""
    if path_pass.sense > 0:
        return path_pass
    back = np.arange(len(path_pass.curves))[::-1]
    return PathPass(running(path_pass.curves, back, np.ones(len(back), dtype=np.bool_)), path_pass.block[::-1], 1)


def polygon(curves: Curves) -> shapely.Polygon:
    """Outline of a closed chain as a polygon; an empty one where it has no inside."""
    corners = outline(curves)
    return shapely.Polygon(corners) if len(corners) > 2 else shapely.Polygon()


def orientation(curves: Curves) -> int:
    """+1 of a closed chain that runs counter-clockwise, −1 clockwise."""
    x, y = (outline(curves) - curves.start_um[0]).T
    return 1 if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) >= 0.0 else -1


def _parted(curves: Curves, place_um: Floats, *, alone: bool) -> tuple[Curves, Curves]:
    """One curve up to its foot of a place, and the rest of it; `alone` it is a loop by itself, of a whole turn."""
    if not alone and np.hypot(*(curves.end_um[0] - place_um)) <= CLOSED_WITHIN_UM:
        return curves, curves.picked(slice(0, 0))
    foot = feet(curves, np.zeros(1, dtype=np.int64), place_um[None])
    sweep = float(curves.sweep_rad[0])
    turned = float(np.clip(sweep, -2.0 * np.pi, 2.0 * np.pi)) if alone else float(foot.angle_rad[0])
    if sweep and not alone:
        turned -= float(curves.start_angle_rad[0])
    middle = curves.end_um if alone and turned == sweep else foot.place_um
    starts, ends = np.concatenate([curves.start_um, middle]), np.concatenate([middle, curves.end_um])
    both = curves_between(starts, ends, curves.center_um[[0, 0]], np.array([turned, sweep - turned]))
    rest = both.length_um[1] > CLOSED_WITHIN_UM
    return both.picked(slice(0, 1)), both.picked(slice(1, 2) if rest else slice(0, 0))


_FULL_TURN_RAD = 2.0 * math.pi


@loop_part("i8(f8[:,::1], i8, f8)")
def _farthest(corner_um: Floats, from_: int, within_um: float) -> int:
    """The last corner that a side from the corner `from_` may run to; corners go away from that one all the way."""
    x, y, reached = corner_um[from_, 0], corner_um[from_, 1], from_ + 1
    ahead, low, high, farthest_um = 0.0, -math.pi, math.pi, 0.0
    for at in range(from_ + 1, len(corner_um)):
        by_x, by_y = corner_um[at, 0] - x, corner_um[at, 1] - y
        away_um = math.hypot(by_x, by_y)
        if away_um < farthest_um:
            break
        if away_um > within_um:
            if farthest_um <= within_um:
                ahead = math.atan2(by_y, by_x)
            turned = (math.atan2(by_y, by_x) - ahead + math.pi) % _FULL_TURN_RAD - math.pi
            if not low <= turned <= high:
                break
            aside = math.asin(within_um / away_um)
            low, high = max(low, turned - aside), min(high, turned + aside)
        reached, farthest_um = at, away_um
    return reached


@compiled("i8(f8[:,::1], f8, i8[::1])")
def _stay(corner_um: Floats, within_um: float, kept_rows: Ints) -> int:
    """Fill in which corners stay, and give how many."""
    number, from_, last = 0, 0, len(corner_um) - 1
    while from_ < last:
        kept_rows[number], number = from_, number + 1
        from_ = _farthest(corner_um, from_, within_um)
    kept_rows[number] = last
    return number + 1


def coarser(corner_um: Floats, within_um: float) -> Floats:
    """The corners (k, 2) that stay of a chain of corners (m, 2), the first and the last among them."""
    corner = np.empty(len(corner_um), dtype=np.int64)
    number = _stay(np.ascontiguousarray(corner_um), within_um, corner)
    return corner_um[corner[:number]]


_PART_LEFT, _PART_RIGHT = 1, -1
_SIMPLER_UM = 0.05
"""Outlines are as exact as 0.1 µm; with half the corners they are compared twice as fast (docs/compare.md)."""
_LONGEST_UM = 100.0  # of a side: two blocks may make one straight edge


def edge_as_cut(toolpath: Toolpath, kerf: Kerf, pieces: Pieces) -> Edge | None:
    """Outlines of all parts with their holes, and of the openings that slugs leave in the frame; None without any.

    Each side belongs to the block whose wire made it.
    """
    rings = list(_rings(pieces))
    if not rings:
        return None
    curves = [_sides(ring) for ring, _ in rings]
    number = [len(curve) for curve in curves]
    edge = joined(curves)
    return Edge(
        curves=edge,
        block=_blocks(toolpath, edge, kerf),
        loop=np.repeat(np.arange(len(rings)), number),
        part_side=np.repeat([side for _, side in rings], number),
        reach_um=kerf.offset_um,
    )


def _rings(pieces: Pieces) -> Iterator[tuple[shapely.LinearRing, int]]:
    """Outlines, counter-clockwise, and the side that the part lies on."""
    for shape in kept_shapes(pieces):
        outline = orient(shapely.Polygon(shape.outline_um.exterior)).exterior
        corners = coarser(np.asarray(outline.coords)[:, :2], _SIMPLER_UM)
        longest = shapely.segmentize(shapely.LinearRing(corners), _LONGEST_UM)
        yield longest, _PART_LEFT if shape.what == "part" else _PART_RIGHT


def _sides(ring: shapely.LinearRing) -> Curves:
    corner = np.asarray(ring.coords)[:, :2]
    none = np.full((len(corner) - 1, 2), np.nan)
    return curves_between(corner[:-1], corner[1:], none, np.zeros(len(corner) - 1))


def _blocks(toolpath: Toolpath, edge: Curves, kerf: Kerf) -> Ints:
    """Block (n,) of the program whose wire made the middle of each side.

    Of what no wire made, as the edge of the work, it is the one that ran nearest; jumps cut nothing.
    """
    middle = places(edge, np.arange(len(edge)), np.full(len(edge), 0.5))
    row = rows_that_made([each.way for each in kerf.swept], middle, kerf.offset_um)
    nobody = np.flatnonzero(row == NOBODY)
    cut = np.flatnonzero(~toolpath.is_jump)
    row[nobody] = cut[nearest(indexed(toolpath.picked(cut)), middle[nobody]).row]
    return toolpath.source.block[row]
