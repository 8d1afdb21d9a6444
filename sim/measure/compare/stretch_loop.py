"""The compiled bound of a comparison: how far stretches of curves can lie from others at most, by what their ends tell.

For a stretch from p(0) to p(1) and any curve near it, let q(t) run on that curve between the feet of both ends. Then
|p − q| is no more than the larger of its values at the ends plus an eighth of the largest |p″ − q″|: 0 for two lines,
and next to 0 for two arcs about one centre. And no place is farther off than half of what both ends and the stretch's
length add up to.
"""

import math

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats, Ints
from sim.measure.curve_rows import IS_ARC, LENGTH, RADIUS, angle_at, distance_from, foot_angle, place_at

_FULL_TURN_RAD = 2.0 * math.pi


@compiled("f8(f8, UniTuple(f8, 2), f8, UniTuple(f8, 2))")
def _bend(own_radius: float, own: tuple[float, float], radius: float, other: tuple[float, float]) -> float:
    """Largest |p″ − q″| of arcs that run from angle to angle evenly, each R φ² toward its centre; R is 0 of a line."""
    p, q = own_radius * (own[1] - own[0]) ** 2, radius * (other[1] - other[0]) ** 2
    apart = (own[0] - other[0] + math.pi) % _FULL_TURN_RAD - math.pi
    turned = (own[1] - other[1]) - (own[0] - other[0])
    return abs(p - q) + min(p, q) * min(max(abs(apart), abs(apart + turned)), 2.0)


@compiled("f8(f8[::1], f8, f8, f8[::1])")
def _bulge(own: Floats, begin: float, end: float, other: Floats) -> float:
    """How much farther the stretch of a curve between two shares may lie from another curve than its ends do."""
    own_angle, angle = (0.0, 0.0), (0.0, 0.0)
    if own[IS_ARC]:
        own_angle = (angle_at(own, begin), angle_at(own, end))
    if other[IS_ARC]:
        begin_x, begin_y = place_at(own, begin)
        end_x, end_y = place_at(own, end)
        angle = (foot_angle(other, begin_x, begin_y), foot_angle(other, end_x, end_y))
    return _bend(own[RADIUS], own_angle, other[RADIUS], angle) / 8.0


@compiled("f8(f8[::1], f8, f8[::1])")
def _distance_at(own: Floats, share: float, other: Floats) -> float:
    """Distance of the place at a share of a curve from another curve."""
    x, y = place_at(own, share)
    return distance_from(other, x, y, math.inf)


@compiled("void(f8[:,::1], f8[:,::1], Tuple((i8[::1], f8[::1], f8[::1], f8[::1], f8[::1], i8[::1], i8[::1])), f8[::1])")
def bounds(
    own: Floats,
    others: Floats,
    stretches: tuple[Ints, Floats, Floats, Floats, Floats, Ints, Ints],
    bound_um: Floats,
) -> None:
    """Fill in the bounds (m,) of stretches, the columns of `Stretches`, of curves beside others, by their rows."""
    row, begin, end, begin_um, end_um, begin_other, end_other = stretches
    for at in range(len(row)):
        curve, first, last = own[row[at]], begin_other[at], end_other[at]
        most = 0.5 * (begin_um[at] + end_um[at] + curve[LENGTH] * (end[at] - begin[at]))
        to_end = end_um[at]
        if first != last:
            to_end = _distance_at(curve, end[at], others[first])
            off = max(_distance_at(curve, begin[at], others[last]), end_um[at])
            most = min(most, off + _bulge(curve, begin[at], end[at], others[last]))
        bound_um[at] = min(most, max(begin_um[at], to_end) + _bulge(curve, begin[at], end[at], others[first]))
