"""The motion that lays the cut edge on the drawing: least squares of its distances from the nearest curves.

From each start a few steps, then from the best ones until nothing moves any more. A step is that of Gauss and Newton
for distances across the nearest curve, which may slide along it (Y. Chen and G. Medioni, Object modelling by
registration of multiple range images, 1991). What the shape does not determine, such as the turn of a circle, stays as
it is.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.directions import headings_at, to_left
from parser.geometry.feet import feet
from sim.measure.compare.nearest import Index, nearest
from sim.measure.compare.placement import Placement, turning
from sim.measure.compare.spread import Spread, spread
from sim.measure.compare.starts import CurveGroup, RigidMotion, groups, starts

_NEXT_STARTS, _NEXT_LEAST_TURNED = 6, 2
_STILL_UM, _STILL = 1e-7, 1e-6  # µm, and of the root mean square where much is left: a step that moves no more
_UNDETERMINED = 1e-7  # of the largest eigenvalue: ways in which the distances do not change
_LARGEST_TURN_RAD = 0.3  # of a step
_ON_CURVE_UM = 1e-6  # nearer, the way to the foot has no direction of its own
_EQUAL_RMS_UM, _EQUAL_MAX_UM = 0.1, 1.0


class _Stage(NamedTuple):
    """How many places and steps are taken; a motion stands still that is below `rough` times the bounds of the end."""

    places: int
    steps: int
    rough: float


_FIRST, _NEXT, _LAST = _Stage(300, 3, 1e4), _Stage(600, 12, 1e3), _Stage(4000, 30, 1.0)
_AS_IT_LIES = _Stage(4000, 1, 1.0)
_GROSS_UM, _FAR_BETTER = 20.0, 0.1  # µm of root mean square, and what is left of it
_MOST_PLACES = 40_000
"""Of an edge as cut, whose many sides waver by 1 µm: 4000 leave 0.13 µm to chance, these 0.005 µm (measured)."""


class _Fitted(NamedTuple):
    """A motion with the root mean square and the largest of the distances that it leaves."""

    motion: RigidMotion
    rms_um: float
    max_um: float

    @property
    def mirror(self) -> bool:
        return bool(np.linalg.det(self.motion.matrix) < 0.0)

    @property
    def turn_rad(self) -> float:
        side = -1.0 if self.mirror else 1.0
        return float(np.arctan2(side * self.motion.matrix[1, 0], side * self.motion.matrix[0, 0]))


class Fit(NamedTuple):
    """Where the drawing lies on the edge, and the root mean square of the distances of the edge, µm."""

    placement: Placement
    rms_um: float


def fit(edge: Curves, edge_loop: Ints, index: Index, drawing_loop: Ints) -> Fit:
    """Lay the drawing of the index on the edge; both have their loops (n,) told apart, −1 for none.

    Of placements that fit equally well, root mean square within 0.1 µm and the largest within 1 µm, the one without a
    mirror is taken, then the one that turns least. Where the whole lies off by far and its longest loop fits by itself,
    that loop is what counts.
    """
    whole = _fitted(edge, edge_loop, index, drawing_loop)
    longest = groups(edge, edge_loop)[1:2]
    if whole.rms_um <= _GROSS_UM or not longest or len(longest[0].curves) == len(edge):
        return Fit(_placement(whole), whole.rms_um)
    # Something is cut that is not drawn, or is drawn elsewhere: the fit of the whole pulls all the rest off its place.
    outline = longest[0].curves
    by_one = _fitted(outline, np.zeros(len(outline), dtype=np.int64), index, drawing_loop)
    if by_one.rms_um > _FAR_BETTER * whole.rms_um:
        return Fit(_placement(whole), whole.rms_um)
    (laid,) = _stepped(index, edge, [by_one.motion], _AS_IT_LIES)
    return Fit(_placement(laid), laid.rms_um)


def _fitted(edge: Curves, edge_loop: Ints, index: Index, drawing_loop: Ints) -> _Fitted:
    """The least squares of all of the edge."""
    from_, to = groups(edge, edge_loop), groups(index.curves, drawing_loop)
    tried = _stepped(index, edge, list(starts(from_, to)), _FIRST)
    tried = _stepped(index, edge, _different(tried, to[0]), _NEXT)
    chosen = _preferred(tried)
    final = _LAST._replace(places=min(max(_LAST.places, len(edge)), _MOST_PLACES))
    (last,) = _stepped(index, edge, [chosen.motion], final)
    return last


def _stepped(index: Index, edge: Curves, motions: list[RigidMotion], stage: _Stage) -> list[_Fitted]:
    """The motions after the steps of a stage, with its places of the edge."""
    number = stage.places
    places = spread(edge, number)
    if len(places.row) > 3 * number:  # of very many curves, every so many places
        every = slice(None, None, len(places.row) // number)
        places = Spread(places.place_um[every], places.row[every], places.weight_um[every])
    return [_descended(index, places, motion, stage) for motion in motions]


def _descended(index: Index, of: Spread, motion: RigidMotion, stage: _Stage) -> _Fitted:
    best = _Fitted(motion, np.inf, np.inf)
    for _ in range(stage.steps):
        place = motion.of(of.place_um)
        near = nearest(index, place)
        rms = float(np.sqrt(np.average(near.distance_um**2, weights=of.weight_um)))
        if rms < best.rms_um:
            best = _Fitted(motion, rms, float(near.distance_um.max()))
        motion, moved_um = _step(index.curves, place, near.row, of.weight_um, motion)
        if moved_um < stage.rough * max(_STILL_UM, _STILL * rms):
            break
    return best


def _step(curves: Curves, place: Floats, row: Ints, weight: Floats, motion: RigidMotion) -> tuple[RigidMotion, float]:
    """The motion after one step of least squares, and by how much it moves places, µm."""
    across, distance = _across(curves, row, place)
    middle = weight @ place / weight.sum()
    out = place - middle
    size = float(np.sqrt(np.average((out * out).sum(axis=1), weights=weight))) or 1.0
    turned = (across[:, 1] * out[:, 0] - across[:, 0] * out[:, 1]) / size
    change = np.column_stack([turned, across])
    share = weight[:, None] * change
    values, vectors = np.linalg.eigh(share.T @ change)
    known = values > _UNDETERMINED * values[-1]
    inverse = vectors[:, known] / values[known] @ vectors[:, known].T
    by = -inverse @ (share.T @ distance)
    turn = float(np.clip(by[0] / size, -_LARGEST_TURN_RAD, _LARGEST_TURN_RAD))
    matrix = turning(turn)
    moved = RigidMotion(matrix @ motion.matrix, matrix @ (motion.shift_um - middle) + middle + by[1:])
    return moved, float(np.abs(by).max())


def _across(curves: Curves, row: Ints, place: Floats) -> tuple[Floats, Floats]:
    """Unit vectors (m, 2) across the nearest curves, and the distances (m,) of the places along them.

    Past an end of a curve the vector points from that end to the place.
    """
    foot = feet(curves, row, place).place_um
    heading = headings_at(curves, row, foot)
    way = to_left(heading)
    by = place - foot
    distance = np.hypot(by[:, 0], by[:, 1])
    far = distance > _ON_CURVE_UM
    way[far] = by[far] / distance[far, None]
    return way, (way * by).sum(axis=1)


def _different(tried: list[_Fitted], drawing: CurveGroup) -> list[RigidMotion]:
    """The best motions, only one of those that nearly agree, and the least turned ones.

    A part that looks the same after several turns fits equally well by each, but for rounding: the least is wanted.
    """
    kept: list[_Fitted] = []
    least_turned = sorted(tried, key=_turned)[:_NEXT_LEAST_TURNED]
    for most, ranked in (
        (_NEXT_STARTS, sorted(tried, key=lambda fitted: fitted.rms_um)),
        (_NEXT_STARTS + _NEXT_LEAST_TURNED, least_turned),
    ):
        for one in ranked:
            if len(kept) < most and not any(_agree(one.motion, other.motion, drawing.length_um) for other in kept):
                kept.append(one)
    return [fitted.motion for fitted in kept]


def _turned(fitted: _Fitted) -> tuple[bool, float]:
    """What to prefer of placements that fit equally well: no mirror, then the least turn."""
    return fitted.mirror, abs(fitted.turn_rad)


def _agree(one: RigidMotion, other: RigidMotion, length_um: float) -> bool:
    apart = np.abs(one.matrix - other.matrix).max() * length_um + np.abs(one.shift_um - other.shift_um).max()
    return bool(apart < 1e-4 * length_um)


def _preferred(tried: list[_Fitted]) -> _Fitted:
    best = min(tried, key=lambda fitted: fitted.rms_um)
    equal = [
        fitted
        for fitted in tried
        if fitted.rms_um <= best.rms_um + _EQUAL_RMS_UM and fitted.max_um <= best.max_um + _EQUAL_MAX_UM
    ]
    return min(equal, key=_turned)


def _placement(fitted: _Fitted) -> Placement:
    """The motion of the edge onto the drawing, turned round: where the drawing lies."""
    back = fitted.motion.matrix.T
    shift = -back @ fitted.motion.shift_um
    # A mirror that comes first, then a turn, is its own inverse.
    turn = fitted.turn_rad if fitted.mirror else -fitted.turn_rad
    return Placement(turn, (float(shift[0]), float(shift[1])), fitted.mirror)
