r"""S-curves: speed along stretches of the path under a jerk limit, with acceleration 0 at each end of a stretch.

A change of speed by Δ under acceleration a and jerk j, with mean speed (v0 + v1) / 2 since it is symmetric::

    speed                       acceleration
    v1 |            ____        a |     ____
       |         .'                |    /    \          Δ > a²/j: jerk a/j long, a held, jerk back
       |       /                   |   /      \         Δ ≤ a²/j: a is not reached, jerk sqrt(Δ/j) long
    v0 |____.'                   0 |__/        \__
       +---------------- t         +---------------- t

It takes T = Δ/a + a/j, or 2 sqrt(Δ/j) where a is not reached, and (v0 + v1) / 2 · T of path.

``ruckig`` finds the same profile from one state to another, a call from Python for each stretch; the border speeds of a
whole path it finds only in its cloud (community version, README, "Intermediate Waypoints"), and its tolerances are
absolute. So the closed form stands here, for all stretches at once, and ruckig is what it is compared with in tests.

Phases of motion, and their inverse: the time at which a length is reached.

Under jerk that is the root of ``s = v t + a t² / 2 + j t³ / 6``. In a phase of an S-curve the speed only rises or only
falls. One that falls is inverted from its end, backwards, where it rises too. There every power of t that matters is
positive, so nothing is lost by cancelling, and s(t) is convex: Newton's steps from above fall onto the root.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats

NEWTON_STEPS = 6
"""From above onto the root of a cubic, one to spare. Where the time of a length is sought, the start is at most some 3
times the root; 5 steps come from there into its last bits (tried over 20 decades). So they do where the speed that a
length can brake is sought, from the cube root of L √j (tried over 40 decades of v0)."""


class Phases(NamedTuple):
    """Phases in any shape: float64 lengths and times, and speeds, accelerations and jerks at their starts."""

    span_um: Floats
    time_s: Floats
    speed_um_s: Floats
    acceleration_um_s2: Floats
    jerk_um_s3: Floats


def times_of_lengths(phases: Phases, s_um: Floats) -> Floats:
    """Times (n,) since the starts of phases (n,) with jerk at which lengths (n,) from there are reached.

    Lengths outside of a phase count as its ends.
    """
    span, time, speed, start_acceleration, jerk = phases
    falls = start_acceleration + jerk * time / 2.0 < 0.0
    end_speed = speed + time * (start_acceleration + time * jerk / 2.0)
    end_acceleration = start_acceleration + time * jerk
    low = np.maximum(np.where(falls, end_speed, speed), 0.0)
    acceleration = np.maximum(np.where(falls, -end_acceleration, start_acceleration), 0.0)
    s = np.clip(np.where(falls, span - s_um, s_um), 0.0, span)
    t = np.minimum(_rising(s, low, acceleration, jerk, time), time)
    return np.where(falls, time - t, t)


def _rising(s: Floats, v: Floats, a: Floats, j: Floats, most: Floats) -> Floats:
    """Root t of v t + a t²/2 + j t³/6 = s with v, a ≥ 0, where a + j t ≥ 0 up to `most`."""
    # Each term alone gives a bound from above; where j < 0, a t²/2 + j t³/6 ≥ a t²/3.
    t = np.minimum(most, _over(s, v))
    t = np.minimum(t, np.sqrt(_over(np.where(j < 0.0, 3.0, 2.0) * s, a)))
    t = np.minimum(t, np.cbrt(_over(6.0 * s, j)))
    for _ in range(NEWTON_STEPS):
        excess = t * (v + t * (a / 2.0 + t * j / 6.0)) - s
        speed = v + t * (a + t * j / 2.0)
        t = t - np.divide(excess, speed, out=np.zeros_like(t), where=speed > 0.0)
    return np.maximum(t, 0.0)


def _over(dividend: Floats, divisor: Floats) -> Floats:
    return np.divide(dividend, divisor, out=np.full_like(dividend, np.inf), where=divisor > 0.0)


ROUNDING = 1e-12
"""Relative, far above that of ramp lengths, far below anything that a drive could tell."""

HALVINGS = 64
"""Steps of a bisection from any interval of doubles of one scale down to its last bit (53) and beyond."""


class Stretches(NamedTuple):
    """n stretches of the path: lengths µm, highest speeds µm/s, accelerations µm/s², (n,) float64, all > 0."""

    length_um: Floats
    speed_um_s: Floats
    acceleration_um_s2: Floats


def ramp_times(change_um_s: Floats, acceleration_um_s2: Floats, jerk_um_s3: float) -> Floats:
    """Time (n,) s of changes of speed (n,) ≥ 0."""
    short = 2.0 * np.sqrt(change_um_s / jerk_um_s3)
    long = change_um_s / acceleration_um_s2 + acceleration_um_s2 / jerk_um_s3
    return np.where(_is_short(change_um_s, acceleration_um_s2, jerk_um_s3), short, long)


def ramp_lengths(from_um_s: Floats, to_um_s: Floats, acceleration_um_s2: Floats, jerk_um_s3: float) -> Floats:
    """Path (n,) µm that changes of speed, up or down, take."""
    time = ramp_times(np.abs(to_um_s - from_um_s), acceleration_um_s2, jerk_um_s3)
    lengths: Floats = (from_um_s + to_um_s) / 2.0 * time
    return lengths


def border_speeds(stretches: Stretches, limit_um_s: Floats, jerk_um_s3: float) -> Floats:
    """Highest speeds (n + 1,) at the borders of n stretches under limits (n + 1,).

    No border is faster than its limit, nor than either neighbour's speed lets it be; there is one such set of speeds,
    since no speed reaches less than itself.
    """
    behind = _brakeable(stretches, limit_um_s, jerk_um_s3)
    turned = Stretches._make(column[::-1] for column in stretches)
    return _brakeable(turned, behind[::-1], jerk_um_s3)[::-1]


def braked_from(from_um_s: float, stretches: Stretches, allowed_um_s: Floats) -> Floats:
    """The allowed speeds (n + 1,), raised from the start on where a start too fast cannot be braked to them.

    Up to the first border that can be met, the full acceleration brakes, without limit of jerk.
    """
    speeds, speed = allowed_um_s.copy(), from_um_s
    room = 2.0 * stretches.acceleration_um_s2 * stretches.length_um
    for border in range(len(speeds)):
        if speed <= speeds[border]:
            break
        speeds[border] = speed
        if border < len(room):
            speed = math.sqrt(max(speed * speed - room[border], 0.0))
    return speeds


def s_curves(stretches: Stretches, border_um_s: Floats, jerk_um_s3: float) -> Phases:
    """Seven phases (n, 7) of each stretch: rise of three, peak held, fall of three.

    A fall too steep for the jerk limit is one phase of constant acceleration.
    """
    first, last, length = border_um_s[:-1], border_um_s[1:], stretches.length_um
    steep = ramp_lengths(first, last, stretches.acceleration_um_s2, jerk_um_s3) > length * (1.0 + ROUNDING)
    peak = np.where(steep, first, _peaks(stretches, first, last, jerk_um_s3))
    end = np.where(steep, last, peak)
    rise = _ramp(first, peak, stretches.acceleration_um_s2, jerk_um_s3)
    fall = _ramp(np.where(steep, peak, last), peak, stretches.acceleration_um_s2, jerk_um_s3)
    cruise_um = np.maximum(length - rise.span_um.sum(axis=1) - fall.span_um.sum(axis=1), 0.0)
    held_time = np.divide(2.0 * cruise_um, peak + end, out=np.zeros_like(cruise_um), where=cruise_um > 0.0)
    braking = (end - peak) * (end + peak) / (2.0 * length)
    zero = np.zeros_like(cruise_um)
    jerk = np.full_like(cruise_um, jerk_um_s3)
    up, down = rise.top_um_s2, -fall.top_um_s2
    return Phases(
        np.column_stack([rise.span_um, cruise_um, fall.span_um[:, ::-1]]),
        np.column_stack([rise.time_s, held_time, fall.time_s]),
        np.column_stack([rise.speed_um_s[:, :3], peak, fall.speed_um_s[:, :0:-1]]),
        np.column_stack([zero, up, up, braking, zero, down, down]),
        np.column_stack([jerk, zero, -jerk, zero, -jerk, zero, jerk]),
    )


class _Ramp(NamedTuple):
    """Rises of speed in three phases; a fall is one run backwards.

    Path and time (n, 3) of each phase, speeds (n, 4) at their borders, and the acceleration (n,) reached.
    """

    span_um: Floats
    time_s: Floats
    speed_um_s: Floats
    top_um_s2: Floats


def _ramp(low: Floats, high: Floats, a: Floats, j: float) -> _Ramp:
    change = high - low
    bend = np.where(_is_short(change, a, j), np.sqrt(change / j), a / j)
    plateau_s = np.where(_is_short(change, a, j), 0.0, change / a - a / j)
    gained, cubic = j * bend**2 / 2.0, j * bend**3 / 6.0
    return _Ramp(
        np.column_stack([low * bend + cubic, (low + change / 2.0) * plateau_s, high * bend - cubic]),
        np.column_stack([bend, plateau_s, bend]),
        np.column_stack([low, low + gained, high - gained, high]),
        j * bend,
    )


def _peaks(stretches: Stretches, first: Floats, last: Floats, j: float) -> Floats:
    """Highest speed (n,) within each stretch, never below its ends."""
    low = np.maximum(first, last)
    peak = np.maximum(stretches.speed_um_s, low)
    a, length = stretches.acceleration_um_s2, stretches.length_um
    over = np.flatnonzero(ramp_lengths(first, peak, a, j) + ramp_lengths(last, peak, a, j) > length)
    low, high, first, last, a, length = low[over], peak[over], first[over], last[over], a[over], length[over]
    for _ in range(HALVINGS):
        middle = low + (high - low) / 2.0
        fits = ramp_lengths(first, middle, a, j) + ramp_lengths(last, middle, a, j) <= length
        low, high = np.where(fits, middle, low), np.where(fits, high, middle)
    peak[over] = low
    return peak


def _brakeable(stretches: Stretches, limit_um_s: Floats, j: float) -> Floats:
    # Only borders that a lower one ahead holds down are walked; all others are told at once.
    length, a = stretches.length_um, stretches.acceleration_um_s2
    falls = np.maximum(limit_um_s[:-1] - limit_um_s[1:], 0.0)
    held_down = (limit_um_s[:-1] - falls / 2.0) * ramp_times(falls, a, j) > length
    speeds, lengths, accelerations = limit_um_s.tolist(), length.tolist(), a.tolist()
    for start in np.flatnonzero(held_down)[::-1].tolist():
        row = start
        while row >= 0:
            most = _reach(speeds[row + 1], lengths[row], accelerations[row], j)
            if most >= speeds[row]:
                break
            speeds[row] = most
            row -= 1
    return np.array(speeds)


def _reach(speed: float, length: float, a: float, j: float) -> float:
    """Highest speed to be had from a speed within a length; never too high, by the last bits."""
    # Without holding a: x³ + 2 v0 x = L √j with x = √Δ; at v0 = 0 the root is the cube root, below it otherwise.
    doubled, whole = 2.0 * speed, length * math.sqrt(j)
    x = math.cbrt(whole)
    for _ in range(NEWTON_STEPS):
        x = (2.0 * x * x * x + whole) / (3.0 * x * x + doubled)
    change, bend = x * x, a * a / j
    if change > bend:
        # Holding a: Δ² + (2 v0 + a²/j) Δ = 2 (a L − v0 a²/j).
        sum_, product = doubled + bend, 2.0 * a * length - doubled * bend
        change = 2.0 * product / (sum_ + math.sqrt(sum_ * sum_ + 4.0 * product))
    return max(math.nextafter(speed + change * (1.0 - ROUNDING), 0.0), speed)


def _is_short(change: Floats, a: Floats, j: float) -> NDArray[np.bool_]:
    short: NDArray[np.bool_] = change * j <= a * a
    return short
