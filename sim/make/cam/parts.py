"""Parts of a drawing: its closed loops as figures, by how they lie within each other, and what of them is not cut.

What is certain is cut. A contour that crosses another one, or itself, stays uncut and is told, with its place and why;
so is one that nobody picked. All contours count in how they lie within each other, cut or not.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np

from parser.drawing.loops.chain import flat_loops
from parser.drawing.model import BESIDE_UM, SAME_WITHIN_UM, Drawing, DrawnLoop, Entity, LeftOut, running
from parser.geometry.curves import Bools, Curves, Floats, Ints, extents, is_inside, joined
from parser.geometry.near import nearest_um
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.contacts import Contacts, contacts, crossed, overlaps, self_contacts, spread
from sim.make.cam.contours import Contours, Nesting, contours_of, nesting
from sim.make.cam.frames import Boxes, frames
from sim.make.cam.loose import Closing, Loose, loose_of
from sim.make.cam.model import Bridge, CannotCutError, Figure, Parts, Refusal, Uncut
from sim.make.cam.picks import Pickable, picked
from sim.setup.making import Making, SideWish
from sim.setup.part import GAP_UM

_MOST_PLACES: Final = 20  # of one refusal
_CLEAR_UM: Final = 1000.0  # from other contours is far enough to tell within which ones a place lies


class _Found(NamedTuple):
    """Closed loops as contours, and what each one (l,) is: its number so far, its area µm², its box (l, 2) µm.

    Those that are not whole are closed by lines, and are not cut.
    """

    loops: list[DrawnLoop]
    contours: Contours
    number: Ints
    is_whole: Bools
    area_um2: Floats
    low_um: Floats
    high_um: Floats


def parts_of(drawing: Drawing, making: Making) -> Parts:
    """Figures of the closed loops of a drawing, and what is cut of none.

    Contours are numbered part by part, parts from left to right by the leftmost place of their outlines, from below
    where these begin equally far left; in each part its holes in the same order, and its outline last. Neither the
    order of entities in the file nor the way they were drawn changes a number, nor does what is picked.

    CannotCutError, by name and place, where no contour is left: ``no-contour``, ``almost-closed``, ``divided``,
    ``crosses-itself``, ``crossing``, ``shared-edge``; and ``no-pick`` where something is picked that there is not.
    """
    loops = [loop for loop in drawing.loops if not _is_thread(drawing, loop, making.thread_layer)]
    closed, open_ones = ([loop for loop in loops if loop.closed is whole] for whole in (True, False))
    flat = flat_loops(drawing.curves, closed)
    drawn = contours_of(drawing, closed) if len(flat) < len(closed) else None
    loose = loose_of(drawing, open_ones, drawn, making.gap_um)
    if drawn is None:
        raise CannotCutError(_nothing_closed(drawing, [closed[at] for at, _ in flat], loose))
    within = BESIDE_UM + 2.0 * (0.0 if drawing.fit is None else drawing.fit.tolerance_um)
    found, again = _once(drawing, _found(closed, drawn, loose.almost), within)
    is_frame, framing, frame_entities = _frames(drawing, found)
    found = _picked_loops(found, ~is_frame)
    touching = contacts(found.contours)
    nested = nesting(found.contours, _places(found, touching), found.area_um2)
    wanted = picked(_pickable(drawing, found, nested), making.picks) if making.picks else found.is_whole
    why = {at: _Uncertain("not-picked") for at in np.flatnonzero(found.is_whole & ~wanted).tolist()}
    why |= _uncertain(found, wanted, touching, loose.divided, within)
    by_nesting = wanted & _are_by_nesting(drawing, found, making)
    why = {**_within_open(found, by_nesting, loose.around), **why}
    is_cut = found.is_whole.copy()
    is_cut[list(why)] = False
    if not is_cut.any():
        raise CannotCutError(_nothing_certain(drawing, found, why))
    reasons = {at: why[at].why if at in why else "almost-closed" for at in np.flatnonzero(~is_cut).tolist()}
    uncut = [Uncut(found.contours.contour(at), reason) for at, reason in reasons.items()]
    left_out = (*loose.left_out, *again, *frame_entities, *_uncut_said(drawing, found, why))
    figures = _figures(drawing, found, nested, is_cut)
    return Parts(figures, (*framing, *uncut), (*_left_of(drawing, making.thread_layer), *left_out), ())


def _frames(drawing: Drawing, found: _Found) -> tuple[Bools, tuple[Uncut, ...], tuple[LeftOut, ...]]:
    """Which contours (l,) are frames of a sheet: what lies in these is no hole."""
    is_frame = frames(drawing, found.contours, Boxes(found.area_um2, found.low_um, found.high_um))
    numbers = np.flatnonzero(is_frame)
    uncut = tuple(Uncut(found.contours.contour(at), "frame") for at in numbers.tolist())
    return is_frame, uncut, _left_out(drawing, found, numbers, "frame")


class _Uncertain(NamedTuple):
    """Why a contour is not cut, the other contour that it is about, and where this is seen, places (k, 2)."""

    why: str
    other: int | None = None
    place_um: Floats = np.empty((0, 2))


def _uncertain(
    found: _Found, wanted: Bools, touching: Contacts, divided: frozenset[int], within_um: float
) -> dict[int, _Uncertain]:
    """Those of the contours that are wanted (l,) that are not certain, by their numbers; of several reasons the first.

    What is not wanted makes no other one uncertain.
    """
    over = overlaps(found.contours)
    is_own = over.this == over.other
    why = dict[int, _Uncertain]()
    for places, name in (
        (self_contacts(found.contours), "crosses-itself"),
        (over.take(is_own), "crosses-itself"),
        (over.take(~is_own), "shared-edge"),
        (crossed(found.contours, touching, within_um), "crossing"),
    ):
        drawn = places.take(wanted[places.this] & wanted[places.other])
        own, mate = np.append(drawn.this, drawn.other), np.append(drawn.other, drawn.this)
        place = np.concatenate([drawn.place_um, drawn.place_um])
        order = np.argsort(own, kind="stable")
        numbers, first = np.unique(own[order], return_index=True)
        for at, here in zip(numbers.tolist(), np.split(order, first[1:]), strict=False):  # no number, one empty part
            why.setdefault(at, _Uncertain(name, int(mate[here[0]]), place[here]))
    for at in np.flatnonzero(wanted & np.isin(found.number, list(divided))).tolist():
        why.setdefault(at, _Uncertain("divided"))
    return why


def _are_by_nesting(drawing: Drawing, found: _Found, making: Making) -> Bools:
    """(l,) of which contours nobody says on which side the wire runs, for their layers or for all."""
    of_layer = {wish.layer.casefold(): wish.side for wish in making.layers if wish.side is not None}
    layers = [_entity(drawing, found, at).layer.casefold() for at in range(len(found.loops))]
    return np.array([of_layer.get(layer, making.side) == "nesting" for layer in layers], dtype=np.bool_)


def _within_open(found: _Found, wanted: Bools, around: Sequence[Curves]) -> dict[int, _Uncertain]:
    """Contours that are wanted (l,) and lie within open chains, closed by lines: they may be holes."""
    start = np.array([_start(found, at) for at in range(len(found.loops))])
    within = np.zeros(len(start), dtype=np.bool_)
    for ring in around:
        low, high = extents(ring)
        near = np.flatnonzero(((start > low.min(axis=0)) & (start < high.max(axis=0))).all(axis=1))
        within[near[is_inside(ring, start[near])]] = True
    return {at: _Uncertain("within-open") for at in np.flatnonzero(within & wanted).tolist()}


def _uncut_said(drawing: Drawing, found: _Found, why: dict[int, _Uncertain]) -> Iterator[LeftOut]:
    """What is said of the contours that are not cut, each by the first of its entities."""
    for at, uncut in why.items():
        place = uncut.place_um[0].tolist() if len(uncut.place_um) else _start(found, at)
        yield LeftOut(_entity(drawing, found, at), uncut.why, (place[0], place[1]))


def _entity(drawing: Drawing, found: _Found, at: int) -> Entity:
    return drawing.entities[int(drawing.entity[found.loops[at].row[0]])]


def _nothing_closed(drawing: Drawing, flat: list[DrawnLoop], loose: Loose) -> Refusal:
    """Why there is no contour: what almost closes, with the gap that would join it, else where everything is."""
    almost = [each for each in loose.left_out if each.why == "almost-closed"]
    if almost:
        nearest = min(almost, key=lambda each: each.gap_um or 0.0)
        gap_um = nearest.gap_um or 0.0
        gap = ("gap_mm", f"{mm(gap_um):.4g}"), ("joins_um", f"{math.ceil(gap_um) + 1}")
        why = "almost-closed" if gap_um < GAP_UM.high else "wide-open"
        return Refusal(why, _points(loose.gaps_um), (("entity", named(nearest.entity)), *gap))
    starts = [drawing.curves.start_um[loop.row[0]].tolist() for loop in flat]
    open_ones = [each.place_um for each in loose.left_out if each.place_um]
    return Refusal("no-contour", tuple(Point(*place) for place in (*starts, *open_ones)))


def _nothing_certain(drawing: Drawing, found: _Found, why: dict[int, _Uncertain]) -> Refusal:
    """Why no contour is cut: the first reason that is one of the drawing itself."""
    at = min(why, key=lambda each: (why[each].why == "not-picked", each))
    alike = [each for each in why if why[each].why == why[at].why]
    places = [each for number in alike for each in why[number].place_um] or [_start(found, each) for each in alike]
    other = why[at].other
    names = [named(_entity(drawing, found, each)) for each in (at, at if other is None else other)]
    values = tuple(zip(("entity", "other"), names, strict=True))
    return Refusal(why[at].why, _points(np.array(places))[:_MOST_PLACES], values)


def named(entity: Entity) -> str:
    """An entity as people find it: its kind, its handle, its layer."""
    return " ".join(filter(None, (entity.kind, entity.handle, f"({entity.layer})")))


def _points(places: Floats) -> tuple[Point, ...]:
    """Each of places (k, 2) once, from left to right."""
    return tuple(Point(x, y) for x, y in np.unique(np.round(places, 3), axis=0).tolist())


def _pickable(drawing: Drawing, found: _Found, nested: Nesting) -> Pickable:
    entities = [
        [drawing.entities[each] for each in np.unique(found.contours.entity[found.contours.rows(at)]).tolist()]
        for at in range(len(found.loops))
    ]
    return Pickable(found.contours, nested, found.area_um2, tuple(map(tuple, entities)), found.is_whole)


def _is_thread(drawing: Drawing, loop: DrawnLoop, layer: str | None) -> bool:
    """Whether a loop lies on the layer of thread points."""
    return _is_on(drawing.entities[int(drawing.entity[loop.row[0]])], layer)


def _is_on(entity: Entity, layer: str | None) -> bool:
    return layer is not None and entity.layer.lower() == layer.lower()


def _left_of(drawing: Drawing, thread_layer: str | None) -> Iterator[LeftOut]:
    """What its reader left out; dots on the layer of thread points are meant as such."""
    return (each for each in drawing.left_out if each.why != "dot" or not _is_on(each.entity, thread_layer))


def _found(closed: list[DrawnLoop], drawn: Contours, almost: tuple[Closing, ...]) -> _Found:
    """Closed loops with their contours, and behind them those that almost close."""
    loops = [*closed, *(each.loop for each in almost)]
    lines = [each.contour for each in almost]
    more = np.repeat(np.arange(len(closed), len(loops)), [len(each) for each in lines])
    contours = Contours(
        joined([drawn.curves, *lines]),
        np.append(drawn.loop, more),
        np.append(drawn.entity, np.zeros(len(more), dtype=np.int64)),
    )
    curves, first = contours.curves, np.searchsorted(contours.loop, np.arange(len(loops)))
    start, end = curves.start_um, curves.end_um
    segment = np.where(curves.is_arc, curves.radius_um**2 * (curves.sweep_rad - np.sin(curves.sweep_rad)), 0.0)
    origin = start[first][contours.loop]
    cross = (start - origin)[:, 0] * (end - origin)[:, 1] - (start - origin)[:, 1] * (end - origin)[:, 0]
    low, high = extents(curves)
    number = np.arange(len(loops))
    return _Found(
        loops,
        contours,
        number,
        number < len(closed),
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
    number, area, low, high = found.number[at], found.area_um2[at], found.low_um[at], found.high_um[at]
    return _Found(loops, left, number, found.is_whole[at], area, low, high)


def _left_out(drawing: Drawing, found: _Found, which: Ints, why: str) -> tuple[LeftOut, ...]:
    return tuple(LeftOut(_entity(drawing, found, at), why, _start(found, at)) for at in which.tolist())


def _start(found: _Found, at: int) -> tuple[float, float]:
    x, y = found.contours.contour(at).start_um[0].tolist()
    return x, y


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
    whole = found.is_whole[this] & found.is_whole[other]
    for at in np.flatnonzero(whole & (off.max(axis=1) <= within_um)).tolist():
        first, again = int(this[at]), int(other[at])
        rings = [found.contours.contour(number) for number in (first, again)]
        if keep[first] and all(
            (nearest_um(ring, spread(mate), within_um) <= within_um).all() for ring, mate in (rings, rings[::-1])
        ):
            keep[again] = False
    return _picked_loops(found, keep), _left_out(drawing, found, np.flatnonzero(~keep), "drawn-twice")


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


def _figures(drawing: Drawing, found: _Found, nested: Nesting, is_cut: Bools) -> tuple[Figure, ...]:
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
            first=_entity(drawing, found, at),
            runs_inside=bool(is_hole[at]),
            bridges=_bridges(drawing, found.loops[at]),
        )
        for number, at in enumerate(order.tolist(), 1)
        if is_cut[at]
    )


def _bridges(drawing: Drawing, loop: DrawnLoop) -> tuple[Bridge, ...]:
    """The gaps of a closed loop as it is drawn."""
    if loop.gap_um <= SAME_WITHIN_UM:
        return ()
    ring = running(drawing.curves, loop.row, loop.backwards)
    end, start = ring.end_um, np.roll(ring.start_um, -1, axis=0)
    gap_um, middle = np.hypot(*(start - end).T), 0.5 * (start + end)
    return tuple(
        Bridge(Point(*middle[at].tolist()), float(gap_um[at]))
        for at in np.flatnonzero(gap_um > SAME_WITHIN_UM).tolist()
    )


def _order(found: _Found) -> Ints:
    """Contours (l,) from left to right, from below where they begin equally far left, to a whole µm."""
    low = np.round(found.low_um)
    start = np.round([_start(found, at) for at in range(len(low))])
    return np.lexsort([found.area_um2, start[:, 1], low[:, 1], low[:, 0]])


_MOST_NAMED: Final = 10


def with_sides(figures: Sequence[Figure], making: Making) -> tuple[Figure, ...]:
    """The figures with the sides that are asked for, for their layers or for all."""
    of_layer = {wish.layer.casefold(): wish.side for wish in making.layers if wish.side is not None}
    return tuple(_with_side(figure, of_layer.get(figure.layer.casefold(), making.side)) for figure in figures)


def refuse_strange_layers(figures: Sequence[Figure], making: Making) -> None:
    """CannotCutError, ``no-such-layer``, where a layer for which something is asked has no figure: a slip, maybe."""
    layers = {figure.layer.casefold(): figure.layer for figure in figures}
    strange = [wish.layer for wish in making.layers if wish.layer.casefold() not in layers]
    if strange:
        values = (("layer", strange[0]), ("layers", ", ".join(sorted(layers.values())[:_MOST_NAMED])))
        raise CannotCutError(Refusal("no-such-layer", (), values))


def _with_side(figure: Figure, side: SideWish) -> Figure:
    inside = figure.kind == "hole" if side == "nesting" else side == "inside"
    return figure._replace(runs_inside=inside)
