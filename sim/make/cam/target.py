"""What a program is held against: the contours of its drawing that are to be cut, as they are drawn, unfitted."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely

from parser.drawing.model import SAME_WITHIN_UM, Drawing, DrawnLoop, Entity, running
from parser.geometry.curves import Curves, Floats, Ints, curves_between, extents, joined
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.model import CutPlan
from sim.make.cam.proof_model import Fault
from sim.measure.compare.rings import polygon

_NEAR_UM = 1000.0
"""A figure's box may lie so far from that of its contour: what a wrong fit moves is told as a path that is off."""


class Target(NamedTuple):
    """The contours that are to be cut, k loops.

    Attributes
    ----------
    drawing
        They alone, their gaps bridged by lines.
    cut
        (k,) index of the plan's cut that each is of.
    shapes
        They as polygons.
    depth
        (k,) how many contours lie round each, cut or not.
    gap_um
        The largest gap that is bridged.
    """

    drawing: Drawing
    cut: Ints
    shapes: tuple[shapely.Polygon, ...]
    depth: Ints
    gap_um: float


def closed_shapes(drawn: Drawing) -> tuple[shapely.Polygon, ...]:
    """The closed contours of a drawing as polygons."""
    closed = (loop for loop in drawn.loops if loop.closed)
    return tuple(polygon(running(drawn.curves, loop.row, loop.backwards)) for loop in closed)


def target_of(drawn: Drawing, plan: CutPlan) -> tuple[Target | None, tuple[Fault, ...]]:
    """The contours of a drawing that a plan cuts, None where it cuts none; and what of the two is not in the other."""
    closed = [loop for loop in drawn.loops if loop.closed]
    rings = [running(drawn.curves, loop.row, loop.backwards) for loop in closed]
    features = _features(rings)
    found = _nearest(_features([cut.figure.contour for cut in plan.cuts]), features)
    known = np.flatnonzero(found >= 0)
    once, first = np.unique(found[known], return_index=True)
    left_out = {each.entity for each in plan.left_out}
    uncut = np.setdiff1d(_nearest(_features([each.contour for each in plan.uncut]), features), [-1, *once.tolist()])
    missing = [
        at
        for at in np.setdiff1d(np.arange(len(closed)), [*once.tolist(), *uncut.tolist()]).tolist()
        if not _is_told(drawn, closed[at], left_out)
    ]
    faults = (
        *(_of_cut("stray", plan, at) for at in np.flatnonzero(found < 0).tolist()),
        *(_of_cut("twice", plan, at) for at in np.setdiff1d(known, known[first]).tolist()),
        *(_missing(drawn, closed[at]) for at in missing),
    )
    if not len(once):
        return None, faults
    shapes = [polygon(rings[at]) for at in once.tolist()]
    others = [
        *(polygon(rings[at]) for at in missing),
        *(shapely.make_valid(polygon(each.contour)) for each in plan.uncut if each.why != "frame"),
    ]
    loops = [closed[at] for at in once.tolist()]
    gap_um = max(loop.gap_um for loop in loops)
    depth = _depths([*shapes, *others])[: len(loops)]
    return Target(_only(drawn, loops), known[first], tuple(shapes), depth, gap_um), faults


def _depths(shapes: Sequence[shapely.Geometry]) -> Ints:
    """(k,) how many of the others lie round each: a place within it lies within them, and they are larger."""
    area = shapely.area(shapes)
    inner = np.asarray(shapely.point_on_surface(shapes), dtype=np.object_)
    shape, around = shapely.STRtree(shapes).query(inner, predicate="within")
    depth: Ints = np.bincount(shape[area[around] > area[shape]], minlength=len(shapes))
    return depth


def _features(contours: Sequence[Curves]) -> Floats:
    """(k, 5) of each contour: the box that it lies in, and the side of a square as large."""
    if not contours:
        return np.empty((0, 5))
    first = np.cumsum([0, *map(len, contours[:-1])])
    curves = joined(contours)
    low, high = extents(curves)
    start, end = curves.start_um, curves.end_um
    shift = np.repeat(start[first], np.diff(np.append(first, len(curves))), axis=0)
    x, y = (start - shift).T
    cross = x * (end - shift)[:, 1] - y * (end - shift)[:, 0]
    turn = np.where(curves.is_arc, curves.sweep_rad, 0.0)
    segment = np.where(curves.is_arc, curves.radius_um, 0.0) ** 2 * (turn - np.sin(turn))
    area = np.add.reduceat(0.5 * (cross + segment), first)
    lows, highs = np.minimum.reduceat(low, first), np.maximum.reduceat(high, first)
    return np.column_stack([lows, highs, np.sqrt(np.abs(area))])


def _nearest(of_cut: Floats, of_loop: Floats) -> Ints:
    """(c,) the loop that is most like each cut; −1 where none lies near."""
    found = np.full(len(of_cut), -1, dtype=np.int64)
    if not len(of_loop):
        return found
    tree = shapely.STRtree(np.asarray(shapely.points(of_loop[:, :2]), dtype=np.object_))
    cut, loop = tree.query(shapely.points(of_cut[:, :2]), predicate="dwithin", distance=_NEAR_UM)
    off = np.abs(of_cut[cut] - of_loop[loop]).max(axis=1)
    near = np.flatnonzero(off <= _NEAR_UM)
    order = near[np.argsort(-off[near], kind="stable")]  # the nearest is entered last
    found[cut[order]] = loop[order]
    return found


def _of_cut(name: str, plan: CutPlan, at: int) -> Fault:
    figure = plan.cuts[at].figure
    return Fault(name, {}, Point(*figure.contour.start_um[0].tolist()), figure.number)


def _is_told(drawn: Drawing, loop: DrawnLoop, told_entities: set[Entity]) -> bool:
    """Whether a contour is of entities that are left out, and told so."""
    return bool(told_entities) and {drawn.entities[int(at)] for at in drawn.entity[loop.row]} <= told_entities


def _missing(drawn: Drawing, loop: DrawnLoop) -> Fault:
    place = Point(*running(drawn.curves, loop.row[:1], loop.backwards[:1]).start_um[0].tolist())
    entity = drawn.entities[int(drawn.entity[loop.row[0]])]
    named = f"{entity.kind} {entity.handle}"
    return Fault("missing", {"entity": named, "x_mm": mm(place.x), "y_mm": mm(place.y)}, place)


def _only(drawn: Drawing, loops: Sequence[DrawnLoop]) -> Drawing:
    """A drawing of some loops alone, each of them bridged, its curves in running order."""
    rings = [_bridged(drawn, loop) for loop in loops]
    number = [len(ring) for ring, _ in rings]
    past = np.cumsum(number)
    entities, entity = np.unique(np.concatenate([of for _, of in rings]), return_inverse=True)
    return replace(
        drawn,
        curves=joined([ring for ring, _ in rings]),
        entity=entity.reshape(-1).astype(np.int64),
        entities=tuple(drawn.entities[at] for at in entities.tolist()),
        loops=tuple(
            DrawnLoop(np.arange(end - count, end), np.zeros(count, dtype=np.bool_), closed=True, gap_um=loop.gap_um)
            for loop, count, end in zip(loops, number, past.tolist(), strict=True)
        ),
        notes=(),
    )


def _bridged(drawn: Drawing, loop: DrawnLoop) -> tuple[Curves, Ints]:
    """A loop in running order with lines over its gaps, and the entity of each curve."""
    ring, entity = running(drawn.curves, loop.row, loop.backwards), drawn.entity[loop.row]
    if loop.gap_um <= SAME_WITHIN_UM:
        return ring, entity
    ahead = np.roll(ring.start_um, -1, axis=0)
    gap = np.flatnonzero(np.hypot(*(ahead - ring.end_um).T) > SAME_WITHIN_UM)
    lines = curves_between(ring.end_um[gap], ahead[gap], np.full((len(gap), 2), np.nan), np.zeros(len(gap)))
    order = np.argsort(np.concatenate([2 * np.arange(len(ring)), 2 * gap + 1]), kind="stable")
    return joined([ring, lines]).picked(order), np.concatenate([entity, entity[gap]])[order]
