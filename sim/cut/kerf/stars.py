"""Stars: the union of the discs about the places of one stretch of the wire's way, as a polygon.

Seen from the middle of the stretch, a ray along the unit vector u leaves the disc of radius r about a place p at
p·u + √(r² − (p×u)²). The star ends at the farthest of these. Then corners are left out that lie within 0.02 µm of
the border without them (D. H. Douglas, T. K. Peucker, Cartographica 10 (1973) 112). A star stays one: its corners stay
in the order of their rays.
"""

from typing import Final

import numpy as np
import shapely

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Bools, Floats, Ints
from sim.cut.regions import Regions

SIMPLER_UM: Final = 0.02
"""Borders of stars are simplified by so much, once: all that is made of them lies as near to the real edge."""

_SCALLOP_UM: Final = 0.02  # left standing between two rays
_TOGETHER: Final = 512  # stars made in one go: some 3 MB of corners


def rays(offset_um: float) -> Floats:
    """Unit vectors (k, 2) all round, so many that chords between them stay within 0.02 µm of the discs.

    At the end of a stretch, the far side of the disc is two offsets from the middle. There the chords between rays are
    twice as long as on a circle of one offset; a chord of length d is d²/8r high.
    """
    number = int(np.ceil(4.0 * np.pi * np.sqrt(offset_um / (8.0 * _SCALLOP_UM))))
    angle = np.arange(number) * (2.0 * np.pi / number)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def stars(place_um: Floats, bounds: Ints, middle_um: Floats, offset_um: float) -> Regions:
    """Union of the discs of each stretch, (s,); every disc must hold the stretch's middle (s, 2).

    `bounds` (s, 2) are the indices of the places (m, 2) at which the stretches begin, and one past their last.
    """
    toward, bounds = np.ascontiguousarray(rays(offset_um).T), np.ascontiguousarray(bounds)
    places, middles = np.ascontiguousarray(place_um), np.ascontiguousarray(middle_um)
    made: Regions = np.empty(len(bounds), dtype=np.object_)
    for low in range(0, len(bounds), _TOGETHER):
        some = slice(low, low + _TOGETHER)
        corners, ends = _borders(places, bounds[some], middles[some], toward, offset_um)
        rings = np.arange(len(ends))
        made[some] = shapely.from_ragged_array(shapely.GeometryType.POLYGON, corners, (ends, rings))
    return made


def _borders(place: Floats, bounds: Ints, middle: Floats, toward: Floats, offset: float) -> tuple[Floats, Ints]:
    """Corners (c, 2) of the stars of s stretches, each ring closed, and (s + 1,) where each ring begins and ends."""
    number = toward.shape[1]
    border, room = np.empty((number, 2)), thinning_room(number)
    corners, ends = np.empty((len(middle) * (number + 1), 2)), np.zeros(len(middle) + 1, dtype=np.int64)
    _fill_in_borders((place, bounds, middle), toward, offset, (border, *room), (corners, ends))
    return corners[: ends[-1]], ends


@loop_part("void(f8[:,::1], f8[::1], f8[:,::1], f8, f8[:,::1])")
def _border(place: Floats, middle: Floats, toward: Floats, offset: float, border: Floats) -> None:
    """Fill in the border (k, 2) of the star about its middle (2,) along the rays, `toward` (2, k)."""
    x, y = middle[0], middle[1]
    for k in range(toward.shape[1]):
        border[k, 0] = 0.0  # how far the star reaches, at first
    for p in range(place.shape[0]):
        out_x, out_y = place[p, 0] - x, place[p, 1] - y
        for k in range(toward.shape[1]):
            across = out_x * toward[1, k] - out_y * toward[0, k]
            half = np.sqrt(max(offset * offset - across * across, 0.0))
            border[k, 0] = max(border[k, 0], out_x * toward[0, k] + out_y * toward[1, k] + half)
    for k in range(toward.shape[1]):
        reach = border[k, 0]
        border[k, 0] = x + reach * toward[0, k]
        border[k, 1] = y + reach * toward[1, k]


@loop_part("Tuple((i8, f8))(f8[:,::1], i8, i8)")
def _farthest(border: Floats, low: int, high: int) -> tuple[int, float]:
    """The corner between two others that lies farthest from the line between them, and the square of how far."""
    past = border.shape[0]
    start_x, start_y = border[low, 0], border[low, 1]
    by_x, by_y = border[high % past, 0] - start_x, border[high % past, 1] - start_y
    square = by_x * by_x + by_y * by_y
    at, most = low, 0.0
    for k in range(low + 1, high):
        to_x, to_y = border[k, 0] - start_x, border[k, 1] - start_y
        share = min(max((to_x * by_x + to_y * by_y) / square, 0.0), 1.0) if square > 0.0 else 0.0
        off_x, off_y = to_x - share * by_x, to_y - share * by_y
        off = off_x * off_x + off_y * off_y
        if off > most:
            at, most = k, off
    return at, most


def thinning_room(corners: int) -> tuple[Bools, Ints]:
    """Room for `thin` of a ring of so many corners (k,): which of them are kept (k,), and what waits (k + 1, 2)."""
    return np.empty(corners, dtype=np.bool_), np.empty((corners + 1, 2), dtype=np.int64)


@loop_part("void(f8[:,::1], f8, b1[::1], i8[:,::1])")
def thin(border: Floats, within: float, is_kept: Bools, waiting: Ints) -> None:
    """Mark the corners (k, 2) of a ring that are kept, so that no other lies farther off than `within`."""
    past = border.shape[0]
    for k in range(past):
        is_kept[k] = k == 0
    waiting[0, 0], waiting[0, 1] = 0, past
    number = 1
    while number > 0:
        number -= 1
        low, high = waiting[number, 0], waiting[number, 1]
        at, off = _farthest(border, low, high)
        if off > within * within:
            is_kept[at] = True
            waiting[number, 0], waiting[number, 1] = low, at
            waiting[number + 1, 0], waiting[number + 1, 1] = at, high
            number += 2


@compiled(
    "void(Tuple((f8[:,::1], i8[:,::1], f8[:,::1])), f8[:,::1], f8, Tuple((f8[:,::1], b1[::1], i8[:,::1])),"
    " Tuple((f8[:,::1], i8[::1])))"
)
def _fill_in_borders(
    stretches: tuple[Floats, Ints, Floats],
    toward: Floats,
    offset: float,
    room: tuple[Floats, Bools, Ints],
    rings: tuple[Floats, Ints],
) -> None:
    """Fill in corners and ends of the rings; `room` is for the border of one star, and to make it thin."""
    (place, bounds, middle), (border, is_border, waiting), (corners, ends) = stretches, room, rings
    made = 0
    for star in range(middle.shape[0]):
        _border(place[bounds[star, 0] : bounds[star, 1]], middle[star], toward, offset, border)
        thin(border, SIMPLER_UM, is_border, waiting)
        for k in range(toward.shape[1]):
            if is_border[k]:
                corners[made, 0], corners[made, 1] = border[k, 0], border[k, 1]
                made += 1
        corners[made, 0], corners[made, 1] = border[0, 0], border[0, 1]
        made += 1
        ends[star + 1] = made
