"""Phases of motion, and their inverse: the time at which a length is reached.

Under jerk that is the root of ``s = v t + a t² / 2 + j t³ / 6``. In a phase of an S-curve the speed only rises or only
falls. One that falls is inverted from its end, backwards, where it rises too. There every power of t that matters is
positive, so nothing is lost by cancelling, and s(t) is convex: Newton's steps from above fall onto the root.
"""

from typing import NamedTuple

import numpy as np

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
