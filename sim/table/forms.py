"""Closed forms of an axis between two events, and the first time at which one of them rises through zero.

A slide that its drive train pushes is a mass on a damped spring: what it does is a wave, C + e^(-λt) (P cos ωt + Q sin
ωt), with cosh and sinh where it creeps. A slide that is pushed by a force that stays, or by none, coasts: friction that
grows with its speed takes it there.

Both are exact: J. P. Den Hartog, "Mechanical Vibrations", McGraw-Hill, 4th edition 1956, §2.3.
"""

import math
from typing import NamedTuple

from controller.compiled.loops import loop_part
from sim.table.drive import Drive

_ALL_BUT_CRITICAL = 1e-10
"""Share of k/m by which λ² may miss it: nearer, a wave and one that creeps are the same but for rounding."""
_SERIES_TO = 0.01
"""Share of a decay time below which the integrals of e^(-wt) are taken from their series: else rounding is 1e-12."""
_ITERATIONS = 60
"""Newton's steps at most; a root takes some five, and halving alone 50."""
_RESOLVED = 1e-14
"""Share of the time of a root by which the last step may move it."""


class Oscillation(NamedTuple):
    """How a slide on its drive train answers.

    Attributes
    ----------
    spring, damping
        k/m, 1/s², and damper and viscous friction over the mass together, 1/s.
    decay
        λ = damping / 2, 1/s.
    rate
        ω = |k/m - λ²|^½, 1/s.
    slow
        Slower decay rate of one that creeps, λ - ω, 1/s.
    creeps
        Whether λ² is above k/m: it never swings.
    """

    spring: float
    damping: float
    decay: float
    rate: float
    slow: float
    creeps: bool


def oscillation_of(drive: Drive) -> Oscillation:
    """How a slide on a drive answers; one that is all but critical is taken for one that swings very slowly."""
    decay = (drive.damper + drive.viscous) / 2.0
    past = drive.spring - decay**2
    if abs(past) < _ALL_BUT_CRITICAL * drive.spring:
        past = _ALL_BUT_CRITICAL * drive.spring
    rate = math.sqrt(abs(past))
    return Oscillation(drive.spring, 2.0 * decay, decay, rate, drive.spring / (decay + rate), past < 0.0)


class Pair(NamedTuple):
    """e^(-λt) cos ωt and e^(-λt) sin ωt, or cosh and sinh."""

    even: float
    odd: float


class Wave(NamedTuple):
    """A quantity over time: level + even · e^(-λt) cos ωt + odd · e^(-λt) sin ωt, or cosh and sinh."""

    level: float
    even: float
    odd: float


@loop_part("(Oscillation, f8)", Oscillation, Pair)
def pair_at(swings: Oscillation, after_s: float) -> Pair:
    """Both parts of its waves after a time."""
    if swings.creeps:
        slow, fast = math.exp(-swings.slow * after_s), math.expm1(-2.0 * swings.rate * after_s)
        return Pair(slow * (2.0 + fast) / 2.0, -slow * fast / 2.0)
    decayed, phase = math.exp(-swings.decay * after_s), swings.rate * after_s
    return Pair(decayed * math.cos(phase), decayed * math.sin(phase))


@loop_part("f8(Wave, Pair)", Wave, Pair)
def value_of(wave: Wave, pair: Pair) -> float:
    """Value of a wave."""
    return wave.level + wave.even * pair.even + wave.odd * pair.odd


@loop_part("(Oscillation, f8, f8, f8)", Oscillation, Wave)
def wave_of(swings: Oscillation, level: float, value: float, slope: float) -> Wave:
    """A wave about a level, by how far it is from there at the beginning, and by its slope then, per s."""
    return Wave(level, value, (slope + swings.decay * value) / swings.rate)


@loop_part("(Oscillation, Wave)", Oscillation, Wave)
def slope_of(swings: Oscillation, wave: Wave) -> Wave:
    """The slope of a wave, which is a wave about 0."""
    turned = swings.rate * wave.even if swings.creeps else -swings.rate * wave.even
    return Wave(0.0, swings.rate * wave.odd - swings.decay * wave.even, turned - swings.decay * wave.odd)


@loop_part("f8(Oscillation, Wave)", Oscillation, Wave)
def first_zero(swings: Oscillation, wave: Wave) -> float:
    """First time after 0 at which a wave about 0 is 0; infinite where there is none. Others follow each half period."""
    if swings.creeps:
        if wave.odd == 0.0 or not 0.0 < -wave.even / wave.odd < 1.0:
            return math.inf
        return math.atanh(-wave.even / wave.odd) / swings.rate
    if wave.even == 0.0 and wave.odd == 0.0:
        return math.inf
    phase = math.atan2(-wave.even, wave.odd)
    return (phase if phase > 0.0 else phase + math.pi) / swings.rate


@loop_part("f8(Oscillation, Wave, f8, f8)", Oscillation, Wave)
def _rise_in(swings: Oscillation, wave: Wave, low_s: float, high_s: float) -> float:
    """Where a wave passes 0 in a time in which it rises from below to above it: Newton's steps within a bracket."""
    slope = slope_of(swings, wave)
    low, high = value_of(wave, pair_at(swings, low_s)), value_of(wave, pair_at(swings, high_s))
    if low >= 0.0:
        return low_s
    at_s = low_s + (high_s - low_s) * (-low / (high - low))
    for _ in range(_ITERATIONS):
        pair = pair_at(swings, at_s)
        value = value_of(wave, pair)
        if value > 0.0:
            high_s = at_s
        else:
            low_s = at_s
        rising = value_of(slope, pair)
        next_s = at_s - value / rising if rising > 0.0 else math.inf
        if not low_s < next_s < high_s:
            next_s = (low_s + high_s) / 2.0
        if abs(next_s - at_s) <= _RESOLVED * high_s:
            return next_s
        at_s = next_s
    return at_s


class Span(NamedTuple):
    """A time from 0 on, with both parts of a slide's waves at its end, and whether it is less than half a period."""

    until_s: float
    last: Pair
    is_short: bool


@loop_part("(Oscillation, f8)", Oscillation, Span)
def span_of(swings: Oscillation, until_s: float) -> Span:
    """The time up to another."""
    return Span(until_s, pair_at(swings, until_s), swings.creeps or swings.rate * until_s < math.pi)


@loop_part("f8(Oscillation, Wave, Span, f8)", Oscillation, Wave, Span)
def wave_rises(swings: Oscillation, wave: Wave, span: Span, least: float) -> float:
    """First time within a span at which a wave that begins below 0 rises above it, and beyond `least` at last.

    Infinite where there is none.
    """
    below, until_s = least - wave.level, span.until_s
    most = abs(wave.even) + abs(wave.odd)
    if below >= most or (below > 0.0 and not swings.creeps and below**2 >= wave.even**2 + wave.odd**2):
        return math.inf
    slope = slope_of(swings, wave)
    # Within half a period it turns once: where it rises to its end, or turns upwards, it is highest at an end.
    if span.is_short and (slope.even < 0.0 or value_of(slope, span.last) > 0.0) and value_of(wave, span.last) <= least:
        return math.inf
    half_s = math.inf if swings.creeps else math.pi / swings.rate
    turns_s, since_s = first_zero(swings, slope), 0.0
    while True:
        end_s = min(turns_s, until_s)
        pair = pair_at(swings, end_s)
        if value_of(wave, pair) > least:
            return _rise_in(swings, wave, since_s, end_s)
        died = not swings.creeps and most * math.exp(-swings.decay * end_s) <= below
        if died or end_s >= until_s:
            return math.inf
        since_s, turns_s = end_s, turns_s + half_s


class Coasting(NamedTuple):
    """Integrals of e^(-wt) from 0: once, twice and three times; s, s², s³."""

    once: float
    twice: float
    thrice: float


@loop_part("(f8, f8)", Coasting)
def coasting(viscous: float, after_s: float) -> Coasting:
    """How far a velocity that decays at a rate, 1/s, leads in a time."""
    x = viscous * after_s
    if x < _SERIES_TO:
        once = 1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0))))
        twice = 0.5 - x / 6.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0 * (1.0 - x / 7.0))))
        thrice = 1.0 / 6.0 - x / 24.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0 * (1.0 - x / 7.0 * (1.0 - x / 8.0))))
        return Coasting(after_s * once, after_s**2 * twice, after_s**3 * thrice)
    once = -math.expm1(-x) / viscous
    twice = (after_s - once) / viscous
    return Coasting(once, twice, (after_s**2 / 2.0 - twice) / viscous)


@loop_part("f8(f8, f8)")
def coasted_s(viscous: float, once: float) -> float:
    """The time after which `coasting` has come to `once`; infinite where it never does."""
    share = viscous * once
    if once < 0.0 or share >= 1.0:
        return math.inf
    return -math.log1p(-share) / viscous if share > 0.0 else once


class Coast(NamedTuple):
    """A quantity over time, s, of a slide that coasts: value + slope · t + bend · (second integral of e^(-wt))."""

    value: float
    slope: float
    bend: float


@loop_part("f8(f8, Coast, f8, f8)", Coast)
def coast_rises(viscous: float, coast: Coast, until_s: float, least: float) -> float:
    """First time at which a quantity that begins below 0 rises above it, and beyond `least` at last.

    Infinite where it does not by `until_s`. It bends one way alone, so that Newton's steps come from one side.
    """
    value, slope, bend = coast
    end_s = until_s
    if bend < 0.0:
        if slope <= 0.0:
            return math.inf
        end_s = min(coasted_s(viscous, -slope / bend), until_s)
    if value + slope * end_s + bend * coasting(viscous, end_s).twice <= least:
        return math.inf
    if value >= 0.0 and slope >= 0.0:
        return 0.0
    at_s = 0.0 if bend < 0.0 else end_s
    for _ in range(_ITERATIONS):
        passed = coasting(viscous, at_s)
        rising = slope + bend * passed.once
        if rising <= 0.0:
            break
        next_s = min(max(at_s - (value + slope * at_s + bend * passed.twice) / rising, 0.0), end_s)
        if abs(next_s - at_s) <= _RESOLVED * end_s:
            return next_s
        at_s = next_s
    return at_s
