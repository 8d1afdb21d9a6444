"""What a program is held against: the contours of its drawing that are to be cut, as they are drawn, unfitted."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely

from parser.drawing.model import SAME_WITHIN_UM, Drawing, DrawnLoop, LeftOut, running
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.geometry.extents import extents
from parser.toolpath import Point
from parser.units import mm
from sim.cam.model import CutPlan
from sim.cam.proof.result import Fault

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
    gap_um
        The largest gap that is bridged.
    """

    drawing: Drawing
    cut: Ints
    gap_um: float


def target_of(drawn: Drawing, plan: CutPlan) -> tuple[Target | None, tuple[Fault, ...]]:
    """The contours of a drawing that a plan cuts, None where it cuts none; and what of the two is not in the other."""
    loops = [loop for loop in drawn.loops if loop.closed]
    of_loop = _features([running(drawn.curves, loop.row, loop.backwards) for loop in loops])
    of_cut = _features([cut.figure.contour for cut in plan.cuts])
    found = _nearest(of_cut, of_loop)
    faults = [_stray(plan, at) for at in np.flatnonzero(found < 0).tolist()]
    known = np.flatnonzero(found >= 0)
    once, first = np.unique(found[known], return_index=True)
    again = np.setdiff1d(known, known[first])
    faults += [Fault("twice", {}, _place(plan, at), plan.cuts[at].figure.number) for at in again.tolist()]
    missing = np.setdiff1d(np.arange(len(loops)), once)
    faults += _missing(drawn, [loops[at] for at in missing.tolist()], plan.left_out)
    if not len(once):
        return None, tuple(faults)
    kept = [loops[at] for at in once.tolist()]
    return Target(_only(drawn, kept), known[first], max(loop.gap_um for loop in kept)), tuple(faults)


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


def _stray(plan: CutPlan, at: int) -> Fault:
    return Fault("stray", {}, _place(plan, at), plan.cuts[at].figure.number)


def _place(plan: CutPlan, at: int) -> Point:
    return Point(*plan.cuts[at].figure.contour.start_um[0].tolist())


def _missing(drawn: Drawing, loops: Sequence[DrawnLoop], left_out: Sequence[LeftOut]) -> Iterator[Fault]:
    """Closed contours that are not cut, and of which nobody said that they are left out."""
    told = {one.entity for one in left_out}
    for loop in loops:
        entities = {drawn.entities[int(at)] for at in drawn.entity[loop.row]}
        if entities <= told:
            continue
        place = Point(*running(drawn.curves, loop.row[:1], loop.backwards[:1]).start_um[0].tolist())
        entity = drawn.entities[int(drawn.entity[loop.row[0]])]
        named = f"{entity.kind} {entity.handle}"
        yield Fault("missing", {"entity": named, "x_mm": mm(place.x), "y_mm": mm(place.y)}, place)


def _only(drawn: Drawing, loops: Sequence[DrawnLoop]) -> Drawing:
    """A drawing of some loops alone, each of them bridged, its curves in running order."""
    rings = [_bridged(drawn, loop) for loop in loops]
    number = [len(ring) for ring, _ in rings]
    past = np.cumsum(number)
    kept, entity = np.unique(np.concatenate([of for _, of in rings]), return_inverse=True)
    return replace(
        drawn,
        curves=joined([ring for ring, _ in rings]),
        entity=entity.reshape(-1).astype(np.int64),
        entities=tuple(drawn.entities[at] for at in kept.tolist()),
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
