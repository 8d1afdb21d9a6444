"""Bands: the union of the discs about the places of an even stretch of the wire's way, straight or bent, as a polygon.

Seen across the way, from the one end to the other, the border on either side is an envelope of circles of one radius:
two of them change places once, where they cross. So each disc in its turn hides those before it from where it crosses
them; a disc that is hidden from before it begins has no share in the border. Across a straight way all look the same
way; across an arc they look from its centre. What is left are arcs from one crossing to the next, known in closed form.

A band may be as long as the way is even: a straight block of 30 mm takes some ten bands where it takes 160 stars, a
circle of 6 mm six where it takes 100, and the union of few regions is made in a tenth of the time.

At its ends, two discs side by side leave a notch that a band fills: of places no farther apart than 4 µm across the way
it is (2 µm)² / 2r deep, 0.02 µm of a wire that cuts 0.2 mm wide.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np
import shapely

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Bools, Curves, Floats, Ints
from sim.cut.kerf.stars import SIMPLER_UM, thin, thinning_room
from sim.cut.kerf.ways import spacing_um
from sim.cut.regions import Regions

_ACROSS_UM: Final = 4.0
"""How far apart places of a stretch may lie across it: as far as backlash moves the wire where an axis turns."""
_BACK_UM: Final = 1.0
"""How far the wire may go back along a stretch: a step."""
_TIGHTEST: Final = 3.0
"""Offsets: radius of the tightest arc that has bands. A ray from its centre passes no disc near its end then."""
_TURN_RAD: Final = 1.5
"""Of a band along an arc, at most: far less than half a turn, so that angles about its centre are in order."""


def bends_of(curves: Curves) -> Floats:
    """Centre and radius (n, 3) of the arc of each row, the radius below 0 where it is clockwise; zeros of lines."""
    bend = np.zeros((len(curves), 3))
    is_arc = curves.is_arc
    bend[is_arc, :2] = curves.center_um[is_arc]
    bend[is_arc, 2] = np.copysign(curves.radius_um[is_arc], curves.sweep_rad[is_arc])
    return bend


def longest_bands_um(bend: Floats, longest_um: Floats, offset_um: Floats) -> Floats:
    """Longest band (n,) along each of some arcs and lines, but `longest_um` (n,); 0 of arcs that are too tight."""
    radius = np.abs(bend[:, 2])
    of_arcs = np.where(radius < _TIGHTEST * offset_um, 0.0, np.minimum(longest_um, _TURN_RAD * radius))
    longest: Floats = np.where(radius > 0.0, of_arcs, longest_um)
    return longest


def are_even(place_um: Floats, first: Ints, bend: Floats) -> Bools:
    """Which stretches (s,) of a way can be bands; `first` (s,) are the indices of places (m, 2) at which they begin.

    `bend` (s, 3) are centre and radius of the arc that each follows, as `bends_of` has them.
    """
    last = np.append(first[1:], len(place_um)) - 1
    own = np.repeat(np.arange(len(first)), last - first + 1)
    is_arc = bend[:, 2] != 0.0
    origin = np.where(is_arc[:, None], bend[:, :2], place_um[first])
    by = np.where(is_arc[:, None], place_um[first], place_um[last]) - origin
    length = np.hypot(by[:, 0], by[:, 1])
    toward = by / np.where(length > 0.0, length, 1.0)[:, None]
    out = place_um - origin[own]
    along = (out * toward[own]).sum(axis=1)
    across = toward[own, 0] * out[:, 1] - toward[own, 1] * out[:, 0]
    bent = is_arc[own]
    along[bent], across[bent] = (
        bend[own[bent], 2] * np.arctan2(across[bent], along[bent]),
        np.hypot(along[bent], across[bent]),
    )
    spread = np.maximum.reduceat(across, first) - np.minimum.reduceat(across, first)
    farthest = float(np.abs(along).max())
    apart = own * (2.0 * (farthest + _BACK_UM))  # each stretch lies ahead of those before it
    back = np.maximum.reduceat(np.maximum.accumulate(along + apart) - (along + apart), first)
    is_even: Bools = (length > 0.0) & (spread <= _ACROSS_UM) & (back <= _BACK_UM)
    return is_even


def bands(place_um: Floats, bounds: Ints, bend: Floats, offset_um: float) -> Regions:
    """Union of the discs of each of s stretches, (s,), which must be even (`are_even`).

    `bounds` (s, 2) are the indices of the places (m, 2) at which they begin, and one past their last; `bend` (s, 3) are
    centre and radius of the arcs that they follow.
    """
    places, bends = np.ascontiguousarray(place_um), np.ascontiguousarray(bend)
    made: Regions = np.empty(len(bounds), dtype=np.object_)
    if len(bounds):
        spacing = spacing_um(offset_um)
        room = _room(int(np.diff(bounds).max()), math.ceil(offset_um / spacing))
        for at, (low, high) in enumerate(bounds.tolist()):
            corners = _band(places[low:high], bends[at], (offset_um, spacing), (*room,))
            made[at] = shapely.Polygon(room.corner[:corners])
    return made


class _Room(NamedTuple):
    """Room for one band, of m places at most, and of k corners.

    Attributes
    ----------
    way
        (m, 2) its places: along and across a straight way; on an arc seen from its centre, the middle one at (x, 0).
    order
        (m + 2,) their indices in order along the way, and of the discs that reach farthest back and ahead, at the ends.
    seen
        (m + 2,) indices of the discs of one side's border, in order.
    crossing
        (m + 2, 2) where each of them begins.
    ring, corner
        (k, 2) corners of the band, as `way` has places, and (k + 1, 2) those that are kept, as places.
    is_kept, waiting
        As `thin` has them.
    """

    way: Floats
    order: Ints
    seen: Ints
    crossing: Floats
    ring: Floats
    corner: Floats
    is_kept: Bools
    waiting: Ints


def _room(places: int, radius: int) -> _Room:
    """Room for a band of so many places, of discs whose radius is so many spacings.

    A side is as long as the way, a third longer outside of a tight arc, and goes up and down by the spread of places at
    each disc at most: some 13 corners a disc where discs are small and lie as far apart as they may.
    """
    k = 2 * (16 * places + 16 * radius + 16)
    is_kept, waiting = thinning_room(k)
    return _Room(
        way=np.empty((places, 2)),
        order=np.empty(places + 2, dtype=np.int64),
        seen=np.empty(places + 2, dtype=np.int64),
        crossing=np.empty((places + 2, 2)),
        ring=np.empty((k, 2)),
        corner=np.empty((k + 1, 2)),
        is_kept=is_kept,
        waiting=waiting,
    )


_ROOM: Final = "Tuple((f8[:,::1], i8[::1], i8[::1], f8[:,::1], f8[:,::1], f8[:,::1], b1[::1], i8[:,::1]))"
_SHORT: Final = 1.05
"""Spacings: of a shorter arc the middle stands for all."""


@loop_part("UniTuple(f8, 5)(f8[:,::1], f8[::1], f8[:,::1])")
def _lay(place: Floats, bend: Floats, way: Floats) -> tuple[float, float, float, float, float]:
    """Fill in places (m, 2) as `_Room` has them; gives its origin, the direction of its first axis, and which turn.

    The turn is 1 where the second axis lies to the left of the first, and −1 where it lies to the right.
    """
    m = place.shape[0]
    radius, turn = abs(bend[2]), -1.0 if bend[2] < 0.0 else 1.0
    if radius > 0.0:
        from_x, from_y = bend[0], bend[1]
        by_x, by_y = place[m // 2, 0] - from_x, place[m // 2, 1] - from_y
    else:
        from_x, from_y = place[0, 0], place[0, 1]
        by_x, by_y = place[m - 1, 0] - from_x, place[m - 1, 1] - from_y
    length = np.sqrt(by_x * by_x + by_y * by_y)
    toward_x, toward_y = by_x / length, by_y / length
    for p in range(m):
        out_x, out_y = place[p, 0] - from_x, place[p, 1] - from_y
        way[p, 0] = out_x * toward_x + out_y * toward_y
        way[p, 1] = turn * (toward_x * out_y - toward_y * out_x)
    return from_x, from_y, toward_x, toward_y, turn


@loop_part("f8(f8, f8, b1)")
def _along(x: float, y: float, is_arc: bool) -> float:
    """What grows along the way: on an arc the tangent of the angle about its centre, which is below a right angle."""
    return y / x if is_arc else x


@loop_part("UniTuple(f8, 2)(f8[:,::1], i8, f8, f8, b1)")
def _tip(way: Floats, p: int, offset: float, ahead: float, is_arc: bool) -> tuple[float, float]:
    """Where the disc about a place ends, seen across the way: ahead 1, or back −1."""
    x, y = way[p, 0], way[p, 1]
    if not is_arc:
        return x + ahead * offset, y
    # The ray from the origin that only just meets the disc: its foot lies an offset off the middle, across the ray.
    square = x * x + y * y
    share, aside = 1.0 - offset * offset / square, offset * np.sqrt(square - offset * offset) / square
    return share * x - ahead * aside * y, share * y + ahead * aside * x


@loop_part("void(f8[:,::1], f8, b1, i8[::1])")
def _sort_along(way: Floats, offset: float, is_arc: bool, order: Ints) -> None:
    """Fill in the order of places (m, 2) as `_Room` has it: they are in order already but for steps back.

    Seen from the centre of an arc, the disc that reaches farthest back need not be the first one.
    """
    m = way.shape[0]
    back, ahead = 0, 0
    farthest_back, farthest = np.inf, -np.inf
    for p in range(m):
        at, own = p + 1, _along(way[p, 0], way[p, 1], is_arc)
        while at > 1 and _along(way[order[at - 1], 0], way[order[at - 1], 1], is_arc) > own:
            order[at] = order[at - 1]
            at -= 1
        order[at] = p
        begin_x, begin_y = _tip(way, p, offset, -1.0, is_arc)
        end_x, end_y = _tip(way, p, offset, 1.0, is_arc)
        begin, end = _along(begin_x, begin_y, is_arc), _along(end_x, end_y, is_arc)
        back, farthest_back = (p, begin) if begin < farthest_back else (back, farthest_back)
        ahead, farthest = (p, end) if end > farthest else (ahead, farthest)
    order[0], order[m + 1] = back, ahead


@loop_part("UniTuple(f8, 2)(f8[:,::1], i8, i8, f8, f8)")
def _crossing(way: Floats, this: int, other: int, offset: float, left: float) -> tuple[float, float]:
    """Where the circles about two places cross: to the left of the way from the one to the other, or to the right."""
    by_x, by_y = way[other, 0] - way[this, 0], way[other, 1] - way[this, 1]
    square = by_x * by_x + by_y * by_y
    share = left * np.sqrt(max(offset * offset / square - 0.25, 0.0))
    return 0.5 * (way[this, 0] + way[other, 0]) - share * by_y, 0.5 * (way[this, 1] + way[other, 1]) + share * by_x


@loop_part("b1(f8[:,::1], i8, UniTuple(f8, 2), f8, b1)")
def _is_hidden(way: Floats, p: int, crossing: tuple[float, float], offset: float, is_arc: bool) -> bool:
    """Whether the disc about a place would be seen only from behind its end on."""
    begins = _along(crossing[0], crossing[1], is_arc)
    if begins <= _along(way[p, 0], way[p, 1], is_arc):
        return False
    end_x, end_y = _tip(way, p, offset, 1.0, is_arc)
    return bool(begins >= _along(end_x, end_y, is_arc))


@loop_part("i8(f8[:,::1], i8[::1], Tuple((b1, f8, f8)), i8[::1], f8[:,::1])")
def _envelope(way: Floats, order: Ints, looks: tuple[bool, float, float], seen: Ints, crossing: Floats) -> int:
    """Fill in which discs are seen from a side, and where each begins; gives their number.

    `looks` are whether the way is an arc, the offset, and 1 for the left side, −1 for the right one.
    """
    is_arc, offset, left = looks
    number = 0
    for p in order:
        x, y = _tip(way, p, offset, -1.0, is_arc)
        is_seen = True
        while number > 0:
            before = seen[number - 1]
            is_seen = way[p, 0] != way[before, 0] or way[p, 1] != way[before, 1]
            if not is_seen:
                break
            x, y = _crossing(way, before, p, offset, left)
            if _along(x, y, is_arc) > _along(crossing[number - 1, 0], crossing[number - 1, 1], is_arc):
                is_seen = not _is_hidden(way, p, (x, y), offset, is_arc)
                break
            number -= 1
            x, y = _tip(way, p, offset, -1.0, is_arc)
        if is_seen:
            seen[number], crossing[number, 0], crossing[number, 1] = p, x, y
            number += 1
    return number


@loop_part("f8(f8[:,::1], i8, UniTuple(f8, 4), f8)")
def _turned(way: Floats, p: int, ends: tuple[float, float, float, float], turn: float) -> float:
    """Angle of the arc about a place from end to end: `turn` is 1 where it turns to the left, −1 where to the right."""
    out_x, out_y = ends[0] - way[p, 0], ends[1] - way[p, 1]
    to_x, to_y = ends[2] - way[p, 0], ends[3] - way[p, 1]
    return float(max(np.arctan2(turn * (out_x * to_y - out_y * to_x), out_x * to_x + out_y * to_y), 0.0))


@loop_part("i8(f8[:,::1], i8, Tuple((f8, f8, f8, i8)), f8[:,::1], i8)")
def _arc(way: Floats, p: int, arc: tuple[float, float, float, int], ring: Floats, made: int) -> int:
    """Fill in corners of the arc about a place but its ends; gives how many there are then.

    `arc` are where it begins, its angle, above 0 to the left, and in how many equal parts it is divided.
    """
    begin_x, begin_y, angle, parts = arc
    out_x, out_y = begin_x - way[p, 0], begin_y - way[p, 1]
    cosine, sine = np.cos(angle / parts), np.sin(angle / parts)
    for _ in range(parts - 1):
        out_x, out_y = out_x * cosine - out_y * sine, out_x * sine + out_y * cosine
        ring[made, 0], ring[made, 1] = way[p, 0] + out_x, way[p, 1] + out_y
        made += 1
    return made


@loop_part("i8(f8[:,::1], Tuple((i8[::1], f8[:,::1], i8)), Tuple((b1, f8, f8)), f8, Tuple((f8[:,::1], i8)))")
def _side(
    way: Floats,
    border: tuple[Ints, Floats, int],
    looks: tuple[bool, float, float],
    spacing: float,
    made_ring: tuple[Floats, int],
) -> int:
    """Fill in the corners of one side, from tip to tip; gives how many the ring has then.

    The middle of a short arc stands for all of it: where discs side by side cross between such arcs, the floor of the
    scallop is no corner, as even discs leave it as well.
    """
    (seen, crossing, number), (is_arc, offset, left), (ring, made) = border, looks, made_ring
    begin_x, begin_y, before, parts_before = crossing[0, 0], crossing[0, 1], seen[0], 3
    for k in range(number):
        p, is_last = seen[k], k + 1 == number
        end_x, end_y = _tip(way, p, offset, 1.0, is_arc) if is_last else (crossing[k + 1, 0], crossing[k + 1, 1])
        angle = _turned(way, p, (begin_x, begin_y, end_x, end_y), -left)
        parts = max(int(np.ceil(angle * offset / (_SHORT * spacing))), 2)
        apart = np.sqrt((way[p, 0] - way[before, 0]) ** 2 + (way[p, 1] - way[before, 1]) ** 2)
        if max(parts, parts_before) > 2 or apart > _SHORT * spacing:
            ring[made, 0], ring[made, 1] = begin_x, begin_y
            made += 1
        made = _arc(way, p, (begin_x, begin_y, -left * angle, parts), ring, made)
        begin_x, begin_y, before, parts_before = end_x, end_y, p, parts
    ring[made, 0], ring[made, 1] = begin_x, begin_y
    return made + 1


@compiled(f"i8(f8[:,::1], f8[::1], UniTuple(f8, 2), {_ROOM})")
def _band(place: Floats, bend: Floats, disc: tuple[float, float], room: tuple[Any, ...]) -> int:
    """Fill in the corners of the band of the places (m, 2) of one stretch, as a closed ring; gives their number.

    `bend` (3,) are centre and radius of its arc; `disc` are the offset, and how far apart places lie at most; `room` is
    that of `_Room`.
    """
    way, order, seen, crossing, ring, corner, is_kept, waiting = room
    offset, spacing = disc
    m, is_arc = place.shape[0], bend[2] != 0.0
    way, order = way[:m], order[: m + 2]
    from_x, from_y, toward_x, toward_y, turn = _lay(place, bend, way)
    _sort_along(way, offset, is_arc, order)
    left = (is_arc, offset, 1.0)
    first = _side(way, (seen, crossing, _envelope(way, order, left, seen, crossing)), left, spacing, (ring, 0))
    right = (is_arc, offset, -1.0)
    corners = _side(way, (seen, crossing, _envelope(way, order, right, seen, crossing)), right, spacing, (ring, first))
    for k in range((corners - first) // 2):  # it runs back
        for axis in range(2):
            at, mirrored = first + k, corners - 1 - k
            ring[at, axis], ring[mirrored, axis] = ring[mirrored, axis], ring[at, axis]
    thin(ring[:corners], SIMPLER_UM, is_kept[:corners], waiting)
    made = 0
    for k in range(corners):
        if is_kept[k]:
            aside = turn * ring[k, 1]
            corner[made, 0] = from_x + ring[k, 0] * toward_x - aside * toward_y
            corner[made, 1] = from_y + ring[k, 0] * toward_y + aside * toward_x
            made += 1
    corner[made, 0], corner[made, 1] = corner[0, 0], corner[0, 1]
    return made + 1
