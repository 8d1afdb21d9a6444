"""Where contours cross, touch, or run over themselves or each other."""

from typing import Final, NamedTuple

import numpy as np

from controller.offset.closest import approaches
from parser.drawing.loops.overlaps import over
from parser.drawing.model import BESIDE_UM
from parser.geometry.along import along_um, places
from parser.geometry.broad_phase_pairs import near_pairs
from parser.geometry.broad_phase_places import nearest_um
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.meets import prolonged_meet
from sim.cam.parts.contours import Contours
from sim.cam.parts.inside import is_inside

_TOUCH_UM: Final = 0.01
"""A contour that comes so near to itself touches itself: far above rounding, far below what any wire cuts."""
_ON: Final = 20.0  # times as near as they come, along the contour: places nearer than that are one place of it
_SHARES: Final = np.linspace(0.0, 1.0, 9)[:-1]  # of each curve, at which it is looked on which side of others it lies
_MOST_PAIRS: Final = 20_000_000


class Contacts(NamedTuple):
    """Places (k, 2) where the contours `one` and `other` (k,) come within `BESIDE_UM` of each other."""

    one: Ints
    other: Ints
    place_um: Floats


def overlaps(contours: Contours) -> Contacts:
    """Where curves of contours run over each other; over others of their own contour, `one` is `other`."""
    curves, loop = contours.curves, contours.loop
    early, late, _ = near_pairs(curves, np.zeros_like(loop), _TOUCH_UM, _MOST_PAIRS, BESIDE_UM)
    like = np.flatnonzero(curves.kind[early] == curves.kind[late])
    found = over(curves, early[like], late[like])
    middle = 0.5 * (found.first_um + found.last_um)
    place = places(curves, found.row, middle / curves.length_um[found.row])
    return Contacts(loop[found.row], loop[found.by], place)


def self_contacts(contours: Contours) -> Contacts:
    """Where contours cross or touch themselves."""
    curves, loop = contours.curves, contours.loop
    near = approaches(curves, curves, _TOUCH_UM)
    mine = np.flatnonzero((loop[near.path_row] == loop[near.row]) & (near.path_row < near.row))
    near = near.take(mine)
    first = np.searchsorted(loop, np.arange(int(loop[-1]) + 2))
    total = np.add.reduceat(curves.length_um, first[:-1])
    before = curves.before_um
    at = [before[row] + along_um(curves, row, near.place_um) for row in (near.path_row, near.row)]
    along = np.abs(at[1] - at[0])
    along = np.minimum(along, total[loop[near.row]] - along)
    following = _follow(loop, first, near.path_row, near.row)
    apart = np.flatnonzero((along > _ON * _TOUCH_UM) & ~following)
    place = near.place_um[apart]
    number = loop[near.row[apart]]
    again, where = _meet_again(curves, loop, first)
    return Contacts(np.append(number, again), np.append(number, again), np.concatenate([place, where]))


def _follow(loop: Ints, first: Ints, early: Ints, late: Ints) -> Bools:
    """Whether curves of one contour follow each other."""
    of = loop[early]
    follow: Bools = (late == early + 1) | ((early == first[of]) & (late == first[of + 1] - 1))
    return follow


def _meet_again(curves: Curves, loop: Ints, first: Ints) -> tuple[Ints, Floats]:
    """Contours (k,) of which a curve crosses the one before it, and where (k, 2).

    Curves that run into each other smoothly cross by as much as their numbers are rounded: that is no crossing.
    """
    after = np.arange(1, len(loop) + 1)
    after[first[1:] - 1] = first[:-1]
    row = np.flatnonzero(after != np.arange(len(loop)))
    met = prolonged_meet(curves, row, after[row])
    deep = (met.overlap_um > BESIDE_UM) & np.isfinite(met.overlap_um)
    pair, which = np.nonzero(deep[:, None] & ~np.isnan(met.place_um[:, :, 0]))
    place, one, other = met.place_um[pair, which], row[pair], after[row[pair]]
    inner = np.ones(len(pair), dtype=np.bool_)
    for curve in (one, other):
        along = along_um(curves, curve, place)
        on = places(curves, curve, along / curves.length_um[curve])
        inner &= np.hypot(*(on - place).T) <= _TOUCH_UM
        inner &= np.minimum(along, curves.length_um[curve] - along) > BESIDE_UM
    return loop[one[inner]], place[inner]


def contacts(contours: Contours) -> Contacts:
    """Where different contours cross or touch; `one` is less than `other`."""
    near = approaches(contours.curves, contours.curves, BESIDE_UM)
    one, other = contours.loop[near.path_row], contours.loop[near.row]
    apart = np.flatnonzero(one < other)
    return Contacts(one[apart], other[apart], near.place_um[apart])


def crossed(contours: Contours, found: Contacts, within_um: float) -> Contacts:
    """Those of contacts at which contours cross: a part of one lies within the other, a part of it outside.

    What lies within a distance of the other contour is on neither side of it.
    """
    key = found.one * (int(contours.loop[-1]) + 1) + found.other
    pairs, of = np.unique(key, return_inverse=True)
    numbers = np.stack(np.divmod(pairs, int(contours.loop[-1]) + 1), axis=1)
    cross = np.array([_cross(contours, one, other, within_um) for one, other in numbers.tolist()], dtype=np.bool_)[of]
    return Contacts(found.one[cross], found.other[cross], found.place_um[cross])


def _cross(contours: Contours, one: int, other: int, within_um: float) -> bool:
    around, ring = contours.one(other), contours.one(one)
    place = spread(ring)
    clear = place[nearest_um(around, place, within_um) > within_um]
    inside = is_inside(around, clear)
    return bool(inside.any() and not inside.all())


def spread(ring: Curves) -> Floats:
    """Places (m, 2) along all curves of a contour."""
    row = np.repeat(np.arange(len(ring)), len(_SHARES))
    return places(ring, row, np.tile(_SHARES, len(ring)))
