"""Steps of least squares that lay a cut edge on a drawing.

A step is that of Gauss and Newton for distances across the nearest curve, which may slide along it (Y. Chen and G.
Medioni, Object modelling by registration of multiple range images, 1991). What the shape does not determine, such as
the turn of a circle, stays as it is.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.directions import headings_at, to_left
from parser.geometry.feet import feet
from sim.measure.compare.nearest import Index, Nearest, nearest
from sim.measure.compare.placement import Placement
from sim.measure.compare.placement import turning as turn_matrix
from sim.measure.compare.spread import Spread, spread
from sim.measure.compare.starts import RigidMotion

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
