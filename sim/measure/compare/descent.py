"""The motion that lays a cut edge on a drawing: steps of least squares, by those contours that agree.

A step is that of Gauss and Newton for distances across the nearest curve, which may slide along it (Y. Chen and G.
Medioni, Object modelling by registration of multiple range images, 1991). What the shape does not determine, such as
the turn of a circle, stays as it is.

The motion that lays the cut edge on the drawing: least squares of its distances from the nearest curves.

From each start a few steps, then from the best ones until nothing moves any more.

Where the drawing lies by those contours of the edge that agree, so that a wrong one pulls none of the others off.

Least squares give a contour that lies off a share in the whole: one hole of four that is shifted would turn the
program. So what is made least here is the sum of the root mean squares of the contours, each times its length: of that,
the most of them that fit together come out at rest. They alone are then laid by least squares.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import headings_at, to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.distance import feet
from sim.measure.compare.nearest import Index, Nearest, indexed, nearest
from sim.measure.compare.result import Edge
from sim.measure.compare.starts import CurveGroup, Placement, RigidMotion, Spread, centroid, groups, spread, starts
from sim.measure.compare.starts import turning as turn_matrix
from sim.measure.compare.unreachable import Reachable

_STILL_UM, _STILL = 1e-7, 1e-6  # µm, and of the root mean square where much is left: a step that moves no more
_UNDETERMINED = 1e-7  # of the largest eigenvalue: ways in which the distances do not change
_LARGEST_TURN_RAD = 0.3  # of a step
_ON_CURVE_UM = 1e-6  # nearer, the way to the foot has no direction of its own
_MOST_PLACES = 40_000
"""Of an edge as cut, whose many sides waver by 1 µm: 4000 leave 0.13 µm to chance, these 0.005 µm (measured)."""


class Stage(NamedTuple):
    """How many places and steps are taken; a motion stands still that is below `rough` times the bounds of the end."""

    places: int
    steps: int
    rough: float


LAST = Stage(4000, 30, 1.0)


class Fitted(NamedTuple):
    """A motion with the root mean square and the largest of the distances that it leaves."""

    motion: RigidMotion
    rms_um: float
    max_um: float


def places_of(edge: Curves, stage: Stage) -> Spread:
    """The places of an edge that a stage takes."""
    return spread(edge, stage.places, 3 * stage.places)


def last_stage(edge: Curves) -> Stage:
    """The stage that ends a fit of an edge."""
    return LAST._replace(places=min(max(LAST.places, len(edge)), _MOST_PLACES))


def descended(index: Index, of: Spread, motion: RigidMotion, stage: Stage, *, turning: bool = True) -> Fitted:
    """The best motion on the way of a stage's steps; without turning, of those that shift alone."""
    best = Fitted(motion, np.inf, np.inf)
    for _ in range(stage.steps):
        near = nearest(index, motion.of(of.place_um))
        rms = float(np.sqrt(np.average(near.distance_um**2, weights=of.weight_um)))
        if rms < best.rms_um:
            best = Fitted(motion, rms, float(near.distance_um.max()))
        motion, moved_um = step(index, near, of, motion, turning=turning)
        if moved_um < stage.rough * max(_STILL_UM, _STILL * rms):
            break
    return best


def step(
    index: Index, near: Nearest, of: Spread, motion: RigidMotion, *, turning: bool = True
) -> tuple[RigidMotion, float]:
    """The motion after one step of least squares of the places with their weights, and how far it moves them, µm.

    `near` are the curves nearest to the places as moved so far.
    """
    place, weight = motion.of(of.place_um), of.weight_um
    across, distance = _across(index.curves, near.row, place)
    middle = weight @ place / weight.sum()
    out = place - middle
    size = float(np.sqrt(np.average((out * out).sum(axis=1), weights=weight))) or 1.0
    turned = (across[:, 1] * out[:, 0] - across[:, 0] * out[:, 1]) / size
    change = np.column_stack([turned if turning else np.zeros_like(turned), across])
    share = weight[:, None] * change
    values, vectors = np.linalg.eigh(share.T @ change)
    known = values > _UNDETERMINED * values[-1]
    inverse = vectors[:, known] / values[known] @ vectors[:, known].T
    by = -inverse @ (share.T @ distance)
    turn = float(np.clip(by[0] / size, -_LARGEST_TURN_RAD, _LARGEST_TURN_RAD))
    matrix = turn_matrix(turn)
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


def placement_of(motion: RigidMotion) -> Placement:
    """The motion of the edge onto the drawing, turned round: where the drawing lies."""
    back = motion.matrix.T
    shift = -back @ motion.shift_um
    # A mirror that comes first, then a turn, is its own inverse.
    turn = motion.turn_rad if motion.mirror else -motion.turn_rad
    return Placement(turn, (float(shift[0]), float(shift[1])), motion.mirror)


def motion_of(placement: Placement) -> RigidMotion:
    """The motion of the edge onto the drawing that lies so."""
    back = turn_matrix(placement.turn_rad, mirror=placement.mirror).T
    return RigidMotion(back, -back @ np.array(placement.shift_um))


_NEXT_STARTS, _NEXT_LEAST_TURNED = 6, 2
_EQUAL_RMS_UM, _EQUAL_MAX_UM = 0.1, 1.0
_FIRST, _NEXT = Stage(300, 3, 1e4), Stage(600, 12, 1e3)
_AS_IT_LIES = LAST._replace(steps=1)
_GROSS_UM, _FAR_BETTER = 20.0, 0.1  # µm of root mean square, and what is left of it


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
        return Fit(placement_of(whole.motion), whole.rms_um)
    # Something is cut that is not drawn, or is drawn elsewhere: the fit of the whole pulls all the rest off its place.
    outline = longest[0].curves
    by_one = _fitted(outline, np.zeros(len(outline), dtype=np.int64), index, drawing_loop)
    if by_one.rms_um > _FAR_BETTER * whole.rms_um:
        return Fit(placement_of(whole.motion), whole.rms_um)
    (laid,) = _stepped(index, edge, [by_one.motion], _AS_IT_LIES)
    return Fit(placement_of(laid.motion), laid.rms_um)


def _fitted(edge: Curves, edge_loop: Ints, index: Index, drawing_loop: Ints) -> Fitted:
    """The least squares of all of the edge."""
    from_, to = groups(edge, edge_loop), groups(index.curves, drawing_loop)
    tried = _stepped(index, edge, list(starts(from_, to)), _FIRST)
    tried = _stepped(index, edge, _different(tried, to[0]), _NEXT)
    chosen = _preferred(tried)
    (last,) = _stepped(index, edge, [chosen.motion], last_stage(edge))
    return last


def _stepped(index: Index, edge: Curves, motions: list[RigidMotion], stage: Stage) -> list[Fitted]:
    """The motions after the steps of a stage, with its places of the edge."""
    places = places_of(edge, stage)
    return [descended(index, places, motion, stage) for motion in motions]


def _different(tried: list[Fitted], drawing: CurveGroup) -> list[RigidMotion]:
    """The best motions, only one of those that nearly agree, and the least turned ones.

    A part that looks the same after several turns fits equally well by each, but for rounding: the least is wanted.
    """
    found: list[Fitted] = []
    least_turned = sorted(tried, key=_turned)[:_NEXT_LEAST_TURNED]
    for most, ranked in (
        (_NEXT_STARTS, sorted(tried, key=lambda fitted: fitted.rms_um)),
        (_NEXT_STARTS + _NEXT_LEAST_TURNED, least_turned),
    ):
        for each in ranked:
            if len(found) < most and not any(_agree(each.motion, other.motion, drawing.length_um) for other in found):
                found.append(each)
    return [fitted.motion for fitted in found]


def _turned(fitted: Fitted) -> tuple[bool, float]:
    """What to prefer of placements that fit equally well: no mirror, then the least turn."""
    return fitted.motion.mirror, abs(fitted.motion.turn_rad)


def _agree(this: RigidMotion, other: RigidMotion, length_um: float) -> bool:
    apart = np.abs(this.matrix - other.matrix).max() * length_um + np.abs(this.shift_um - other.shift_um).max()
    return bool(apart < 1e-4 * length_um)


def _preferred(tried: list[Fitted]) -> Fitted:
    best = min(tried, key=lambda fitted: fitted.rms_um)
    equal = [
        fitted
        for fitted in tried
        if fitted.rms_um <= best.rms_um + _EQUAL_RMS_UM and fitted.max_um <= best.max_um + _EQUAL_MAX_UM
    ]
    return min(equal, key=_turned)


_ROUNDS = 40
_STILL_ROUND_UM = 1e-3  # of a round that moves no more
_ROUND_BELOW = 0.2  # of the tolerance: contours nearer than this count alike
_EXPLAINS = 0.5  # of the deviations: what a turn has to leave less than, to be one of the whole


class _Places(NamedTuple):
    """Places spread over the edge, and the loop (m,) of each."""

    of: Spread
    loop: Ints

    def on(self, loops: Bools) -> Spread:
        """Those on the loops that are true of (k,)."""
        at = loops[self.loop]
        return Spread(self.of.place_um[at], self.of.row[at], self.of.weight_um[at])


def settled(edge: Edge, target: Reachable, placement: Placement, tolerance_um: float) -> Placement:
    """Where the target lies, begun from the least squares of the whole to the drawing, which has no fillets.

    They stand where no place is off by more than the tolerance. Otherwise the contours that agree within the
    tolerance tell, where they are the most of the edge or, two of them or more, of the contours. Where none agree, the
    whole is not turned by what explains nothing: a turn that leaves half of the deviations or more.
    """
    places, index = _places(edge), indexed(target.curves)
    motion = motion_of(placement)
    if target.unreachable:
        motion = descended(index, places.of, motion, last_stage(edge.curves)).motion
    if float(nearest(index, motion.of(places.of.place_um)).distance_um.max()) <= tolerance_um:
        return placement_of(motion)
    agree = _agreeing(places, index, motion, tolerance_um)
    if agree is not None:
        return placement_of(agree)
    return placement_of(_unturned(edge.curves, places.of, index, motion, tolerance_um))


def shifted_onto(curves: Curves, index: Index, start_um: Floats) -> Fitted:
    """Curves shifted onto those of the index, not turned, from a shift (2,) on."""
    stage = last_stage(curves)
    motion = RigidMotion(np.eye(2), start_um)
    return descended(index, places_of(curves, stage), motion, stage, turning=False)


def _places(edge: Edge) -> _Places:
    of = places_of(edge.curves, last_stage(edge.curves))
    return _Places(of, edge.loop[of.row])


def _agreeing(places: _Places, index: Index, motion: RigidMotion, tolerance_um: float) -> RigidMotion | None:
    """The least squares of the contours that agree; None where these are too few."""
    if not places.loop.any():
        return None
    motion = _least_sum(places, index, motion, tolerance_um)
    agree = _within(places, index, motion, tolerance_um)
    if not _enough(places, agree):
        return None
    return descended(index, places.on(agree), motion, last_stage(index.curves)).motion


def _least_sum(places: _Places, index: Index, motion: RigidMotion, tolerance_um: float) -> RigidMotion:
    """The motion that makes the sum of the root mean squares of the contours least, by weights anew each round."""
    weight, loop = places.of.weight_um, places.loop
    whole = np.maximum(np.bincount(loop, weight), 1.0)  # of a loop too short to have a place, nothing
    for _ in range(_ROUNDS):
        near = nearest(index, motion.of(places.of.place_um))
        rms = np.sqrt(np.bincount(loop, weight * near.distance_um**2) / whole)
        share = weight / np.maximum(rms, _ROUND_BELOW * tolerance_um)[loop]
        motion, moved_um = step(index, near, places.of._replace(weight_um=share), motion)
        if moved_um < _STILL_ROUND_UM:
            break
    return motion


def _within(places: _Places, index: Index, motion: RigidMotion, tolerance_um: float) -> Bools:
    """(k,) whether no place of a loop is off by more than the tolerance."""
    off = nearest(index, motion.of(places.of.place_um)).distance_um
    farthest = np.zeros(int(places.loop.max()) + 1)
    np.maximum.at(farthest, places.loop, off)
    within: Bools = farthest <= tolerance_um
    return within


def _enough(places: _Places, agree: Bools) -> bool:
    lengths = np.bincount(places.loop, places.of.weight_um)
    by_length = float(lengths[agree].sum()) > 0.5 * float(lengths.sum())
    return by_length or (int(agree.sum()) > 1 and 2 * int(agree.sum()) > len(agree))


def _unturned(edge: Curves, of: Spread, index: Index, motion: RigidMotion, tolerance_um: float) -> RigidMotion:
    """The motion without its turn, where that is large enough to be told and explains too little; else as it is."""
    size = float(np.ptp(edge.start_um, axis=0).max())
    if abs(motion.turn_rad) * size <= tolerance_um:
        return motion
    middle = centroid(of)
    matrix = turn_matrix(0.0, mirror=motion.mirror)
    straight = RigidMotion(matrix, motion.of(middle[None])[0] - matrix @ middle)
    stage = last_stage(edge)
    turned = descended(index, of, motion, stage._replace(steps=1))
    still = descended(index, of, straight, stage, turning=False)
    return still.motion if turned.rms_um > _EXPLAINS * still.rms_um else motion
