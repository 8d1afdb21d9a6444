"""Parts of a drawing: its closed loops as figures, by how they lie within each other.

Curves that close no contour: which may be left out, and which are contours with something missing.
"""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
import shapely

from parser.drawing.loops.chain import DOT_UM, flat_loops
from parser.drawing.model import BESIDE_UM, SAME_WITHIN_UM, Drawing, DrawnLoop, Entity, LeftOut, running
from parser.geometry.curves import Bools, Curves, Floats, Ints, extents, joined
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import near_places, nearest_um
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.contacts import Contacts, contacts, crossed, overlaps, self_contacts, spread
from sim.make.cam.contours import Contours, Nesting, contours_of, nesting
from sim.make.cam.model import CannotCutError, Figure, Parts, Refusal
from sim.setup.making import Making

_ALMOST_UM: Final = 1000.0
"""Loose ends this near are meant to meet: no drawing leaves a contour open by less on purpose (assumed)."""
_ALMOST_OF_LENGTH: Final = 0.4  # a bent chain open by less of its length is meant to close (assumed)
_LONGER: Final = 4.0  # times as long as they lie apart are curves that are meant to meet; strokes of a mark are not


class _Chains(NamedTuple):
    """Open chains (c,): both ends (c, 2, 2), length, whether it is more than a line, the entity of its first curve."""

    end_um: Floats
    length_um: Floats
    is_bent: Bools
    entity: Ints


def left_open(drawing: Drawing, loops: list[DrawnLoop], contours: Curves | None, gap_um: float) -> tuple[LeftOut, ...]:
    """What is left out of open chains of a drawing.

    CannotCutError where one of them is surely no free line: where it almost closes, alone or with another one
    (``almost-closed``), or where both of its ends lie on a contour or on another chain, so that it divides what lies
    there (``divided``).
    """
    if not loops:
        return ()
    chains = _chains(drawing, loops)
    near, by = _nearest(chains.end_um)
    _refuse_almost(drawing, chains, near, gap_um)
    _refuse_dividing(drawing, loops, chains, contours, gap_um)
    gap = by.min(axis=1)
    columns = zip(chains.entity.tolist(), chains.length_um.tolist(), chains.end_um[:, 0].tolist(), gap, strict=True)
    return tuple(
        LeftOut(
            drawing.entities[entity],
            "dot" if length <= DOT_UM else "open",
            (place[0], place[1]),
            float(open_um) if np.isfinite(open_um) else None,
        )
        for entity, length, place, open_um in columns
    )


def _chains(drawing: Drawing, loops: list[DrawnLoop]) -> _Chains:
    ends, lengths, bent, entity = [], [], [], []
    for loop in loops:
        ran = running(drawing.curves, loop.row, loop.backwards)
        ends.append((ran.start_um[0], ran.end_um[-1]))
        lengths.append(ran.length_um.sum())
        bent.append(len(ran) > 1 or bool(ran.is_arc[0]))
        entity.append(drawing.entity[loop.row[0]])
    return _Chains(np.array(ends), np.array(lengths), np.array(bent), np.array(entity))


def _nearest(end_um: Floats) -> tuple[Ints, Floats]:
    """Of each end (c, 2) the nearest other one in another place, numbered 2c and 2c + 1, and how far it lies, µm."""
    places = end_um.reshape(-1, 2)
    points = np.asarray(shapely.points(places))
    own, other = shapely.STRtree(points).query_nearest(points, exclusive=True, all_matches=False)
    near, by = np.arange(len(points)), np.full(len(points), np.inf)
    near[own], by[own] = other, np.hypot(*(places[own] - places[other]).T)
    return near.reshape(-1, 2), by.reshape(-1, 2)


def _refuse_almost(drawing: Drawing, chains: _Chains, near: Ints, gap_um: float) -> None:
    """Look at each end with the one nearest to it, and at both ends of each chain."""
    ends = chains.end_um.reshape(-1, 2)
    chain_number = np.arange(len(chains.length_um))
    end, mate = (
        np.concatenate([np.arange(len(ends)), 2 * chain_number]),
        np.concatenate([near.ravel(), 2 * chain_number + 1]),
    )
    apart = np.hypot(*(ends[end] - ends[mate]).T)
    shorter = np.minimum(chains.length_um[end // 2], chains.length_um[mate // 2])
    itself = (end // 2 == mate // 2) & chains.is_bent[end // 2] & (apart < _ALMOST_OF_LENGTH * shorter)
    close = (apart < _ALMOST_UM) & (shorter > _LONGER * apart)
    almost = np.flatnonzero((itself | close) & (apart > gap_um))
    if not len(almost):
        return
    first = almost[np.argmin(apart[almost])]
    entity = drawing.entities[int(chains.entity[end[first] // 2])]
    values = (("entity", named(entity)), ("gap_mm", f"{mm(float(apart[first])):.4g}"))
    places = _points(0.5 * (ends[end[almost]] + ends[mate[almost]]))
    raise CannotCutError(Refusal("almost-closed", places, values))


def _refuse_dividing(
    drawing: Drawing, loops: list[DrawnLoop], chains: _Chains, contours: Curves | None, gap_um: float
) -> None:
    within = max(gap_um, SAME_WITHIN_UM)
    ran = [running(drawing.curves, loop.row, loop.backwards) for loop in loops]
    chain = np.repeat(np.arange(len(loops)), [len(each) for each in ran])
    lines = joined([*ran, *([] if contours is None else [contours])])
    chain = np.append(chain, np.full(len(lines) - len(chain), -1))
    end = chains.end_um.reshape(-1, 2)
    near = near_places(lines, end, within)
    near = near.take(np.flatnonzero(chain[near.row] != near.other // 2))
    distance, _ = distance_to_curves(lines, near.row, end[near.other, 0], end[near.other, 1])
    tied = np.zeros(len(end), dtype=np.bool_)
    tied[near.other[distance <= within]] = True
    divides = np.flatnonzero(tied.reshape(-1, 2).all(axis=1))
    if len(divides):
        entity = drawing.entities[int(chains.entity[divides[0]])]
        raise CannotCutError(
            Refusal("divided", _points(chains.end_um[divides].reshape(-1, 2)), (("entity", named(entity)),))
        )


def named(entity: Entity) -> str:
    """An entity as people find it: its kind, its handle, its layer."""
    return " ".join(filter(None, (entity.kind, entity.handle, f"({entity.layer})")))


def _points(places: Floats) -> tuple[Point, ...]:
    """Each of places (k, 2) once, from left to right."""
    return tuple(Point(x, y) for x, y in np.unique(np.round(places, 3), axis=0).tolist())


_MOST_PLACES: Final = 20  # of one refusal
_CLEAR_UM: Final = 1000.0  # from other contours is far enough to tell within which ones a place lies


class _Found(NamedTuple):
    """Closed loops as contours, and what each one (l,) is: its area µm², its box (l, 2) µm."""

    loops: list[DrawnLoop]
    contours: Contours
    area_um2: Floats
    low_um: Floats
    high_um: Floats


def parts_of(drawing: Drawing, making: Making) -> Parts:
    """Figures of the closed loops of a drawing, and what is cut of none.

    Figures are numbered part by part, parts from left to right by the leftmost place of their outlines, from below
    where these begin equally far left; in each part its holes in the same order, and its outline last. Neither the
    order of entities in the file nor the way they were drawn changes a number.

    CannotCutError, by name and place, where what is drawn is not certain: ``no-contour``, ``crosses-itself``,
    ``crossing``, ``shared-edge``, and those of `left_open`.
    """
    loops = [loop for loop in drawing.loops if not _is_thread(drawing, loop, making.thread_layer)]
    closed, loose = ([loop for loop in loops if loop.closed is whole] for whole in (True, False))
    flat = flat_loops(drawing.curves, closed)
    drawn = contours_of(drawing, closed) if len(flat) < len(closed) else None
    left = left_open(drawing, loose, None if drawn is None else drawn.curves, making.gap_um)
    if drawn is None:
        starts = [drawing.curves.start_um[closed[at].row[0]].tolist() for at, _ in flat]
        places = [*starts, *(each.place_um for each in left if each.place_um)]
        raise CannotCutError(Refusal("no-contour", tuple(Point(*place) for place in places)))
    found = _found(closed, drawn)
    _refuse_itself(drawing, found)
    within = BESIDE_UM + 2.0 * (0.0 if drawing.fit is None else drawing.fit.tolerance_um)
    found, again = _once(drawing, found, within)
    touching = _touching(drawing, found, within)
    nested = nesting(found.contours, _places(found, touching), found.area_um2)
    return Parts(_figures(drawing, found, nested), (*_left_of(drawing, making.thread_layer), *left, *again), ())


def _is_thread(drawing: Drawing, loop: DrawnLoop, layer: str | None) -> bool:
    """Whether a loop lies on the layer of thread points."""
    return _is_on(drawing.entities[int(drawing.entity[loop.row[0]])], layer)


def _is_on(entity: Entity, layer: str | None) -> bool:
    return layer is not None and entity.layer.lower() == layer.lower()


def _left_of(drawing: Drawing, thread_layer: str | None) -> Iterator[LeftOut]:
    """What its reader left out; dots on the layer of thread points are meant as such."""
    return (each for each in drawing.left_out if each.why != "dot" or not _is_on(each.entity, thread_layer))


def _found(loops: list[DrawnLoop], contours: Contours) -> _Found:
    curves, first = contours.curves, np.searchsorted(contours.loop, np.arange(len(loops)))
    start, end = curves.start_um, curves.end_um
    segment = np.where(curves.is_arc, curves.radius_um**2 * (curves.sweep_rad - np.sin(curves.sweep_rad)), 0.0)
    origin = start[first][contours.loop]
    cross = (start - origin)[:, 0] * (end - origin)[:, 1] - (start - origin)[:, 1] * (end - origin)[:, 0]
    low, high = extents(curves)
    return _Found(
        loops,
        contours,
        np.add.reduceat(0.5 * (cross + segment), first),
        np.minimum.reduceat(low, first),
        np.maximum.reduceat(high, first),
    )


def _picked_loops(found: _Found, keep: Bools) -> _Found:
    """Those loops that are kept, numbered anew."""
    at = np.flatnonzero(keep)
    contours = found.contours
    row = np.flatnonzero(keep[contours.loop])
    number = np.cumsum(keep) - 1
    left = Contours(contours.curves.picked(row), number[contours.loop[row]], contours.entity[row])
    loops = [found.loops[each] for each in at.tolist()]
    return _Found(loops, left, found.area_um2[at], found.low_um[at], found.high_um[at])


def _left_out(drawing: Drawing, found: _Found, which: Ints, why: str) -> tuple[LeftOut, ...]:
    return tuple(
        LeftOut(drawing.entities[int(drawing.entity[found.loops[at].row[0]])], why, _start(found, at))
        for at in which.tolist()
    )


def _start(found: _Found, at: int) -> tuple[float, float]:
    x, y = found.contours.contour(at).start_um[0].tolist()
    return x, y


def _refuse_itself(drawing: Drawing, found: _Found) -> None:
    itself, over = self_contacts(found.contours), overlaps(found.contours)
    is_own = over.this == over.other
    for places, why in ((itself, "crosses-itself"), (over.take(is_own), "crosses-itself"), (over, "shared-edge")):
        if len(places.this):
            raise CannotCutError(_refusal(drawing, found, places, why))


def _once(drawing: Drawing, found: _Found, within_um: float) -> tuple[_Found, tuple[LeftOut, ...]]:
    """Loops without those that lie upon another one all round, as curves do that were fitted twice."""
    order = np.lexsort([found.low_um[:, 1], found.low_um[:, 0]])
    low = found.low_um[order, 0]
    past = np.searchsorted(low, low + within_um, side="right")
    number = past - np.arange(len(low)) - 1
    this = np.repeat(np.arange(len(low)), number)
    other = this + 1 + np.arange(len(this)) - (np.cumsum(number) - number)[this]
    this, other = order[this], order[other]
    off = np.maximum(
        np.abs(found.low_um[this] - found.low_um[other]), np.abs(found.high_um[this] - found.high_um[other])
    )
    keep = np.ones(len(found.loops), dtype=np.bool_)
    for at in np.flatnonzero(off.max(axis=1) <= within_um).tolist():
        first, again = int(this[at]), int(other[at])
        rings = [found.contours.contour(number) for number in (first, again)]
        if keep[first] and all(
            (nearest_um(ring, spread(mate), within_um) <= within_um).all() for ring, mate in (rings, rings[::-1])
        ):
            keep[again] = False
    return _picked_loops(found, keep), _left_out(drawing, found, np.flatnonzero(~keep), "drawn-twice")


def _touching(drawing: Drawing, found: _Found, within_um: float) -> Contacts:
    """Where contours touch. CannotCutError where they cross."""
    touching = contacts(found.contours)
    crossing = crossed(found.contours, touching, within_um)
    if len(crossing.this):
        raise CannotCutError(_refusal(drawing, found, crossing, "crossing"))
    return touching


def _refusal(drawing: Drawing, found: _Found, contact: Contacts, why: str) -> Refusal:
    places = np.unique(np.round(contact.place_um, 3), axis=0)[:_MOST_PLACES]
    names = [
        named(drawing.entities[int(drawing.entity[found.loops[int(numbers[0])].row[0]])])
        for numbers in (contact.this, contact.other)
    ]
    values = tuple(zip(("entity", "other"), names, strict=True))
    return Refusal(why, tuple(Point(x, y) for x, y in places.tolist()), values)


def _places(found: _Found, touching: Contacts) -> Floats:
    """A place (l, 2) of each contour that lies on no other one."""
    contours = found.contours
    first = np.searchsorted(contours.loop, np.arange(len(found.loops)))
    place = contours.curves.start_um[first].copy()
    both = np.append(touching.this, touching.other), np.append(touching.other, touching.this)
    pairs = np.unique(np.stack(both, axis=1), axis=0)
    for at in np.unique(pairs[:, 0]).tolist():
        mates = pairs[slice(*np.searchsorted(pairs[:, 0], (at, at + 1)).tolist()), 1]
        on = spread(contours.contour(at))
        clear = [nearest_um(contours.contour(mate), on, _CLEAR_UM) for mate in mates.tolist()]
        place[at] = on[np.argmax(np.min(clear, axis=0))]
    return place


def _figures(drawing: Drawing, found: _Found, nested: Nesting) -> tuple[Figure, ...]:
    """Figures in the order of their numbers."""
    is_hole = nested.depth % 2 == 1
    outline = np.where(is_hole, nested.around, np.arange(len(is_hole)))
    rank = np.argsort(_order(found))
    order = np.lexsort([rank, ~is_hole, rank[outline]])
    part = np.cumsum(np.diff(outline[order], prepend=-1) != 0)
    return tuple(
        Figure(
            number=number,
            kind="hole" if is_hole[at] else "outline",
            part=int(part[number - 1]),
            depth=int(nested.depth[at]),
            contour=found.contours.contour(at),
            entity=found.contours.entity[found.contours.rows(at)],
            layer=drawing.entities[int(drawing.entity[found.loops[at].row[0]])].layer,
            runs_inside=bool(is_hole[at]),
        )
        for number, at in enumerate(order.tolist(), 1)
    )


def _order(found: _Found) -> Ints:
    """Contours (l,) from left to right, from below where they begin equally far left, to a whole µm."""
    low = np.round(found.low_um)
    start = np.round([_start(found, at) for at in range(len(low))])
    return np.lexsort([found.area_um2, start[:, 1], low[:, 1], low[:, 0]])
