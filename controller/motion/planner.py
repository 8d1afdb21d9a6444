"""The planner: limits of rows to the fastest plan that keeps them.

Without a jerk limit every phase has constant acceleration. With one, the plan is made of S-curves, from border to
border of stretches that nothing inside holds back.

Look-ahead: the highest speeds at the borders of rows from which every limit ahead and behind can be kept.

With constant acceleration a along a row of length L, v² can grow or fall by the row's room 2aL, no more. So the
highest lawful v² at a border is the least, over all borders k, of the limit at k plus the room between: a backward pass
(what is ahead can still be braked for) and a forward pass (no more than can have been reached).
"""

from typing import NamedTuple

import numpy as np

from controller.motion.plan import EMPTY_PLAN, Plan, on_borders, plan_of
from controller.motion.s_curve import Phases, Stretches, border_speeds, braked_from, ramp_lengths, s_curves
from parser.geometry.curves import Floats, total_before


def reachable(limit_sq: Floats, room_sq: Floats) -> Floats:
    """Highest v² (n + 1,) at the borders of n rows under limits (n + 1,) and rooms 2aL (n,); all µm²/s², ≥ 0.

    The minimum over all distances is taken by windows that double (as in a sparse table), not over cumulated room:
    sums then stay as short as the ramps, and rounding stays relative to v² however long the path is.
    """
    backward = _backward(limit_sq, room_sq)
    return _backward(backward[::-1], room_sq[::-1])[::-1]


def _backward(limit_sq: Floats, room_sq: Floats) -> Floats:
    best, room, window = limit_sq.copy(), room_sq, 1
    while len(room) and room.min() < best.max():
        np.minimum(best[:-window], best[window:] + room, out=best[:-window])
        room = room[:-window] + room[window:]
        window *= 2
    return best


ALIKE = 1e-9
"""Limits that differ by less, relative, are the same to S-curves: the direction of a line cut in two is rounded."""


NEAR = (ALIKE, 0.01, 0.1, 0.3, 1.0)
"""Shares by which the accelerations of rows that run as one may differ. An S-curve has acceleration 0 at each border
where they do, which costs more than a little of the acceleration; so all these are tried, and the fastest is taken."""


class RowLimits(NamedTuple):
    """What the plan of n rows has to keep.

    Attributes
    ----------
    length_um
        (n,) float64, ≥ 0.
    speed_um_s, acceleration_um_s2
        (n,) float64, > 0: highest speed, and acceleration along the path, in each row.
    border_um_s
        (n + 1,) float64, ≥ 0: highest speed at each border of rows, the start and the end included.
    wait_s
        (n + 1,) float64, ≥ 0: time to stand still at each border. A border with a wait is passed at no more than its
        `border_um_s` either side of standing: the start speed.
    """

    length_um: Floats
    speed_um_s: Floats
    acceleration_um_s2: Floats
    border_um_s: Floats
    wait_s: Floats


def plan_rows(limits: RowLimits, from_um_s: float | None = None, jerk_um_s3: float = np.inf) -> Plan:
    """The fastest plan under the limits, from the first border's speed or less, or from `from_um_s`.

    With a jerk limit it is the fastest of those tried (`NEAR`).

    A start faster than the limits allow is braked with the rows' acceleration until it fits. Under a jerk limit the
    acceleration is 0 at the start, and at each border of rows where the limits change or hold back.
    """
    if not len(limits.length_um):
        return EMPTY_PLAN
    if jerk_um_s3 < np.inf:
        plan = _plan_s_curves(limits, from_um_s, jerk_um_s3)
    else:
        plan = plan_of(_phases(limits, border_speeds_sq(limits, from_um_s)), limits.wait_s)
    return on_borders(plan, total_before(limits.length_um))


def border_speeds_sq(limits: RowLimits, from_um_s: float | None = None) -> Floats:
    """v² (n + 1,) µm²/s² at the borders of rows in the fastest plan of constant accelerations."""
    room = 2.0 * limits.acceleration_um_s2 * limits.length_um
    limit = _border_limits(limits) ** 2
    if from_um_s is not None:
        # What cannot be braked any more is allowed.
        too_fast = from_um_s**2 - total_before(room)
        limit = np.maximum(limit, too_fast)
        limit[0] = from_um_s**2
    return reachable(limit, room)


def _border_limits(limits: RowLimits) -> Floats:
    """Speed (n + 1,) µm/s at each border that it and both of its rows allow."""
    speed = limits.border_um_s.copy()
    np.minimum(speed[:-1], limits.speed_um_s, out=speed[:-1])
    np.minimum(speed[1:], limits.speed_um_s, out=speed[1:])
    return speed


def _phases(limits: RowLimits, border_sq: Floats) -> Phases:
    r"""Three phases (n, 3) of each row: to its peak, at it, from it; some have no length.

    ::

        speed                            speed
             |    cap ________                |    cap - - - -
        peak |       /        \          peak |      /\
             |      /          \              |     /  \
        last |     /            \        last |    /    \
       first |    /                      first |   /
             +------------------ t            +------------------ t

    The peak is the cap, or where the ramps cross: up and down share the room 2aL, so that v² is
    ``(first² + last² + 2aL) / 2`` there.
    """
    a, length = limits.acceleration_um_s2, limits.length_um
    first, last = border_sq[:-1], border_sq[1:]
    crest = (first + last) / 2.0 + a * length
    peak_sq = np.maximum(np.minimum(limits.speed_um_s**2, crest), np.minimum(first, last))
    rise = np.minimum(np.abs(peak_sq - first) / (2.0 * a), length)
    fall = np.minimum(np.abs(peak_sq - last) / (2.0 * a), length - rise)
    border, peak = np.sqrt(border_sq), np.sqrt(peak_sq)
    spans = np.column_stack([rise, length - rise - fall, fall])
    both = np.column_stack([border[:-1] + peak, 2.0 * peak, peak + border[1:]])
    return Phases(
        spans,
        np.divide(2.0 * spans, both, out=np.zeros_like(spans), where=spans > 0.0),
        np.column_stack([border[:-1], peak, peak]),
        np.column_stack([np.copysign(a, peak_sq - first), np.zeros_like(a), np.copysign(a, last - peak_sq)]),
        np.zeros_like(spans),
    )


def _plan_s_curves(limits: RowLimits, from_um_s: float | None, jerk_um_s3: float) -> Plan:
    """The fastest of the plans with rows merged whose accelerations differ by no more than each of `NEAR`."""
    tried: dict[int, Plan] = {}
    for near in NEAR:
        rows = merged(limits, near)
        if len(rows.length_um) not in tried:
            tried[len(rows.length_um)] = _plan_merged(rows, from_um_s, jerk_um_s3)
    return min(tried.values(), key=lambda plan: plan.duration_s)


def _plan_merged(limits: RowLimits, from_um_s: float | None, jerk_um_s3: float) -> Plan:
    if not len(limits.length_um):
        return plan_of(Phases(*np.zeros((5, 0, 7))), limits.wait_s)
    if from_um_s is not None:
        limits = _slowed_first(limits, from_um_s, jerk_um_s3)
    stretches = Stretches(limits.length_um, limits.speed_um_s, limits.acceleration_um_s2)
    borders = border_speeds(stretches, _border_limits(limits), jerk_um_s3)
    if from_um_s is not None and borders[0] < from_um_s:
        borders = braked_from(from_um_s, stretches, borders)
    return plan_of(s_curves(stretches, borders, jerk_um_s3), limits.wait_s)


def merged(limits: RowLimits, near: float = ALIKE) -> RowLimits:
    """The same limits in the fewest rows: none without length, and none ended by a border that holds nothing back.

    Rows whose accelerations differ by no more than `near`, relative, are one, with the least of them.
    """
    limits = _moving(limits)
    length, speed, a, border, wait = limits
    if not len(length):
        return limits
    alike = (np.abs(np.diff(speed)) <= ALIKE * speed[1:]) & (np.abs(np.diff(a)) <= near * np.maximum(a[1:], a[:-1]))
    passes = (border[1:-1] >= np.maximum(speed[1:], speed[:-1])) & (wait[1:-1] == 0.0)
    first = np.concatenate([[0], np.flatnonzero(~(alike & passes)) + 1])
    borders = np.append(first, len(length))
    return RowLimits(
        np.add.reduceat(length, first),
        np.minimum.reduceat(speed, first),
        np.minimum.reduceat(a, first),
        border[borders],
        wait[borders],
    )


def _moving(limits: RowLimits) -> RowLimits:
    """The rows with length; a border between them keeps the limits of all borders and rows that are dropped there."""
    moves = limits.length_um > 0.0
    rows, dropped = np.flatnonzero(moves), np.flatnonzero(~moves)
    falls_on = np.concatenate([[0], np.cumsum(moves)])
    border = np.full(len(rows) + 1, np.inf)
    np.minimum.at(border, falls_on, limits.border_um_s)
    np.minimum.at(border, falls_on[dropped], limits.speed_um_s[dropped])
    wait = np.bincount(falls_on, weights=limits.wait_s, minlength=len(rows) + 1).astype(np.float64)
    return RowLimits(limits.length_um[rows], limits.speed_um_s[rows], limits.acceleration_um_s2[rows], border, wait)


def _slowed_first(limits: RowLimits, from_um_s: float, jerk_um_s3: float) -> RowLimits:
    """Start at a speed; where it is above the first row's, slowing down is a row of its own if there is room for it."""
    length, speed, a, border, wait = limits
    border = np.concatenate([[from_um_s], border[1:]])
    slowing = ramp_lengths(np.array([from_um_s]), speed[:1], a[:1], jerk_um_s3)
    if from_um_s <= speed[0] or slowing[0] >= length[0]:
        return RowLimits(length, speed, a, border, wait)
    return RowLimits(
        np.concatenate([slowing, length[:1] - slowing, length[1:]]),
        np.concatenate([[from_um_s], speed]),
        np.concatenate([a[:1], a]),
        np.insert(border, 1, np.inf),
        np.insert(wait, 1, 0.0),
    )
