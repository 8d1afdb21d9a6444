"""Where contours cross, touch, or run over themselves or each other.

What lies between figures: waste that is too narrow for the wire, walls that are thin.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from controller.offset.gouges import Approaches, approaches_of
from parser.drawing.loops.once import over
from parser.drawing.model import BESIDE_UM
from parser.findings.catalogue import Remark
from parser.geometry.along import along_um, places, places_at
from parser.geometry.curves import Bools, Curves, Floats, Ints, is_inside, joined
from parser.geometry.near import near_pairs, nearest_um
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.contours import Contours
from sim.make.cam.model import CannotCutError, Figure, Refusal

_TOUCH_UM: Final = 0.01
"""A contour that comes so near to itself touches itself: far above rounding, far below what any wire cuts."""
_LOCAL_UM: Final = 60.0
"""Round the finest wire, of 0.02 mm: shorter loops of a contour at a corner are rounding of its drawing, and no wire
follows them."""
_SHARES: Final = np.linspace(0.0, 1.0, 9)[:-1]  # of each curve, at which it is looked on which side of others it lies
_BETWEEN: Final = np.array([0.25, 0.5, 0.75])  # of each stretch from one contact to the next
_MOST_PAIRS: Final = 20_000_000


class Contacts(NamedTuple):
    """Places (k, 2) where contours come near each other, or themselves.

    Attributes
    ----------
    this, other
        (k,) the contours.
    row
        (k,) row of the contours' curves, of `this`, that comes near.
    place_um
        (k, 2) on that row.
    """

    this: Ints
    other: Ints
    row: Ints
    place_um: Floats

    def take(self, at: Ints | Bools) -> "Contacts":
        """Those at the indices `at`."""
        return Contacts(self.this[at], self.other[at], self.row[at], self.place_um[at])


def overlaps(contours: Contours) -> Contacts:
    """Where curves of contours run over each other; over others of their own contour, `this` is `other`."""
    curves, loop = contours.curves, contours.loop
    early, late, _ = near_pairs(curves, np.zeros_like(loop), _TOUCH_UM, _MOST_PAIRS, BESIDE_UM)
    like = np.flatnonzero(curves.kind[early] == curves.kind[late])
    found = over(curves, early[like], late[like])
    middle = 0.5 * (found.first_um + found.last_um)
    place = places(curves, found.row, middle / curves.length_um[found.row])
    return Contacts(loop[found.row], loop[found.by], found.row, place)


def self_contacts(contours: Contours) -> Contacts:
    """Where contours cross or touch themselves."""
    curves, loop = contours.curves, contours.loop
    early, late, _ = near_pairs(curves, loop, 0.0, _MOST_PAIRS, _TOUCH_UM)
    near = approaches_of(curves, curves, early, late, _TOUCH_UM)
    first = np.searchsorted(loop, np.arange(int(loop[-1]) + 2))
    total = np.add.reduceat(curves.length_um, first[:-1])
    before = curves.before_um
    at = [before[row] + along_um(curves, row, near.place_um) for row in (near.path_row, near.row)]
    along = np.abs(at[1] - at[0])
    along = np.minimum(along, total[loop[near.row]] - along)
    apart = near.take(np.flatnonzero(along > _LOCAL_UM))
    return Contacts(loop[apart.path_row], loop[apart.row], apart.path_row, apart.place_um)


def contacts(contours: Contours) -> Contacts:
    """Where different contours cross or touch; `this` is less than `other`."""
    near = between_contours(contours.curves, contours.loop, BESIDE_UM)
    return Contacts(contours.loop[near.path_row], contours.loop[near.row], near.path_row, near.place_um)


def between_contours(curves: Curves, loop: Ints, within_um: float) -> Approaches:
    """Where curves of a contour and of a later one come within a distance, by numbers (n,) that do not decrease."""
    early, late, _ = near_pairs(curves, np.zeros_like(loop), 0.0, _MOST_PAIRS, within_um)
    other = np.flatnonzero(loop[early] != loop[late])
    early, late = early[other], late[other]
    near = np.flatnonzero(~_are_rings_apart(curves, early, late, within_um))
    return approaches_of(curves, curves, early[near], late[near], within_um)


def _are_rings_apart(curves: Curves, early: Ints, late: Ints, within_um: float) -> Bools:
    """Whether circles of pairs of arcs (k,) lie apart, most of all those one within another, whose boxes meet."""
    between = np.hypot(*(curves.center_um[early] - curves.center_um[late]).T)
    radius, other = curves.radius_um[early], curves.radius_um[late]
    apart: Bools = np.maximum(between - radius - other, np.abs(radius - other) - between) > within_um
    return apart


def crossed(contours: Contours, found: Contacts, within_um: float) -> Contacts:
    """Those of contacts at which contours cross: a part of one lies within the other, a part of it outside.

    What lies within a distance of the other contour is on neither side of it.
    """
    if not len(found.this):
        return found
    key = found.this * (int(contours.loop[-1]) + 1) + found.other
    order = np.argsort(key, kind="stable")
    pairs = np.split(order, np.flatnonzero(np.diff(key[order])) + 1)
    cross = [pair for pair in pairs if _cross(contours, found.take(pair), within_um)]
    return found.take(np.concatenate([*cross, order[:0]]))


def _cross(contours: Contours, found: Contacts, within_um: float) -> bool:
    """Whether two contours cross, by all of their contacts."""
    around, rows = contours.contour(int(found.other[0])), contours.rows(int(found.this[0]))
    ring = contours.curves.picked(rows)
    row, before = found.row - rows.start, ring.before_um
    at = np.unique(before[row] + along_um(ring, row, found.place_um))
    past = np.append(at[1:], at[0] + before[-1])
    middle = np.mod((at[:, None] + _BETWEEN * (past - at)[:, None]).ravel(), before[-1])
    of = np.clip(np.searchsorted(before, middle, side="right") - 1, 0, len(ring) - 1)
    place = np.concatenate([places_at(ring, of, middle - before[of]), spread(ring)])
    clear = place[nearest_um(around, place, within_um) > within_um]
    inside = is_inside(around, clear)
    return bool(inside.any() and not inside.all())


def spread(ring: Curves) -> Floats:
    """Places (m, 2) along all curves of a contour."""
    row = np.repeat(np.arange(len(ring)), len(_SHARES))
    return places(ring, row, np.tile(_SHARES, len(ring)))


_LIMIT_SHARE = 1.0 - 1e-6  # a gap as wide as the kerf is cut


def walls(figures: Sequence[Figure], offset_um: Sequence[float], reach_um: float) -> tuple[Remark, ...]:
    """What is to be said of walls between figures that are thinner than the kerf is wide.

    CannotCutError, ``too-near``, where the wire of one figure would cut another one: it removes what lies within the
    largest offset of the figure's passes and its reach, on its side of the contour. Of figures with an offset of 0
    nothing is known.
    """
    if len(figures) < 2 or max(offset_um) <= 0.0:
        return ()
    removed = [offset + reach_um if offset > 0.0 else 0.0 for offset in offset_um]
    close = _closest(figures, max(*removed, 2.0 * reach_um))
    lies = [_lies(figures, removed, close, at) for at in range(len(close.apart_um))]
    across = np.array([lie.removed_um for lie in lies], dtype=np.float64)
    is_wall = np.array([lie.is_wall for lie in lies], dtype=np.bool_)
    bad = np.flatnonzero(close.apart_um < across * _LIMIT_SHARE)
    thin = np.flatnonzero(is_wall & (close.apart_um < 2.0 * reach_um * _LIMIT_SHARE))
    if len(bad):
        worst = int(bad[np.argmin(close.apart_um[bad])])
        values = (
            ("one", str(figures[int(close.this[worst])].number)),
            ("other", str(figures[int(close.other[worst])].number)),
            ("apart_mm", f"{mm(float(close.apart_um[worst])):.4g}"),
            ("kerf_mm", f"{mm(float(across[worst])):.4g}"),
        )
        near = np.unique(np.append(close.this[bad], close.other[bad]))
        numbers = tuple(figures[at].number for at in near.tolist())
        places_um = tuple(Point(x, y) for x, y in close.place_um[bad].tolist())
        raise CannotCutError(Refusal("too-near", places_um, values, numbers))
    touch = close.apart_um[thin] <= BESIDE_UM
    named = ("contours-touch", thin[touch]), ("thin-walls", thin[~touch])
    return tuple(_contact_remark(name, close, which) for name, which in named if len(which))


class _Close(NamedTuple):
    """Pairs (k,) of figures near each other, by their places in the sequence, how far apart, and where (k, 2)."""

    this: Ints
    other: Ints
    apart_um: Floats
    place_um: Floats


def _closest(figures: Sequence[Figure], within_um: float) -> _Close:
    curves = joined([figure.contour for figure in figures])
    of = np.repeat(np.arange(len(figures)), [len(figure.contour) for figure in figures])
    near = between_contours(curves, of, within_um * _LIMIT_SHARE)
    this, other = of[near.path_row], of[near.row]
    key = this * len(figures) + other
    order = np.lexsort([near.distance_um, key])
    first = order[np.diff(key[order], prepend=-1) > 0]
    return _Close(this[first], other[first], near.distance_um[first], near.place_um[first])


class _Lies(NamedTuple):
    """How much is removed between two figures by the wire of either, and whether a wall of material lies there."""

    removed_um: float
    is_wall: bool


def _lies(figures: Sequence[Figure], removed_um: Sequence[float], close: _Close, at: int) -> _Lies:
    this, other = int(close.this[at]), int(close.other[at])
    removed, is_wall = 0.0, True
    for mine, theirs in ((this, other), (other, this)):
        lies_inside = np.mean(is_inside(figures[mine].contour, spread(figures[theirs].contour))) > 0.5
        if lies_inside == figures[mine].runs_inside:
            removed, is_wall = max(removed, removed_um[mine]), False
    return _Lies(removed, is_wall)


def _contact_remark(name: str, close: _Close, thin: Ints) -> Remark:
    thinnest = int(thin[np.argmin(close.apart_um[thin])])
    x, y = (round(mm(at), 3) + 0.0 for at in close.place_um[thinnest].tolist())
    return Remark(name, {"number": len(thin), "width": float(close.apart_um[thinnest]), "place": f"({x:g}, {y:g})"})
