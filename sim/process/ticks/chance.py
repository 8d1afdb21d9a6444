"""Chance: random numbers, the same in every language, and how long a gap waits for a spark."""

import math

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Floats
from sim.process.ticks.state import HAS_SPARE, SEED_1, SEED_2, SPARE

CLOSE_UM = 3.84
"""Where the mean delay is least: nearer than this sparks come no sooner."""
LN_2 = 0.6931471805599453
_SHARE_1 = 1.0 / 2147483563.0
_SHARE_2 = 1.0 / 2147483399.0


@loop_part("f8(f8[::1])")
def random_share(state: Floats) -> float:
    """A random number between 0 and 1, neither of them.

    Combined multiplicative generator of P. L'Ecuyer, Communications of the ACM 31 (1988) 742: whole numbers below
    2^53, the same in every language. The quotient is no whole number, as the modulus is prime, and no nearer to one
    than 1 / modulus, which is fifty times its rounding: its floor is exact.
    """
    first = 40014.0 * state[SEED_1]
    first -= math.floor(first * _SHARE_1) * 2147483563.0
    second = 40692.0 * state[SEED_2]
    second -= math.floor(second * _SHARE_2) * 2147483399.0
    state[SEED_1] = first
    state[SEED_2] = second
    both = first - second
    if both < 1.0:
        both += 2147483562.0
    return float(both * _SHARE_1)


@loop_part("f8(f8[::1])")
def random_normal(state: Floats) -> float:
    """A random number of mean 0 and spread 1 (Box and Muller): two are made at once."""
    if state[HAS_SPARE] > 0.0:
        state[HAS_SPARE] = 0.0
        return float(state[SPARE])
    radius = math.sqrt(-2.0 * math.log(random_share(state)))
    angle = 2.0 * math.pi * random_share(state)
    state[SPARE] = radius * math.sin(angle)
    state[HAS_SPARE] = 1.0
    return radius * math.cos(angle)


@compiled("f8(f8)")
def mean_delay_us(gap_um: float) -> float:
    """Mean time from an open gap to a spark, µs: its median is 0.48 g² − 3.69 g + 14.05 with the gap g in µm."""
    gap = max(gap_um, CLOSE_UM)
    return (0.48 * gap * gap - 3.69 * gap + 14.05) / LN_2
