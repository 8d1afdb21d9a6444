"""Where the drawing lies by those contours of the edge that agree, so that a wrong one pulls none of the others off.

Least squares give a contour that lies off a share in the whole: one hole of four that is shifted would turn the
program. So what is made least here is the sum of the root mean squares of the contours, each times its length: of that,
the most of them that fit together come out at rest. They alone are then laid by least squares.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats, Ints
from sim.measure.compare.descent import Fitted, descended, last_stage, motion_of, placement_of, places_of, step
from sim.measure.compare.edge import Edge
from sim.measure.compare.nearest import Index, indexed, nearest
from sim.measure.compare.starts import Placement, RigidMotion, Spread, centroid
from sim.measure.compare.starts import turning as turn_matrix
from sim.measure.compare.unreachable import Reachable

_ROUNDS = 40
_STILL_UM = 1e-3  # of a round that moves no more
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
        if moved_um < _STILL_UM:
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
