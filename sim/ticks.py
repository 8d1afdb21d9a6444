"""Ticks: when the table's physics is worked out. Fine where the drives are shaken, long where nothing happens.

Cutting is quasi-static: at 60 µm/s the table follows its drive for hours. A tick ends at every border of blocks and
after every few µm of path; only where the commanded velocity changes by enough to make the axes ring are there ticks
of a fraction of a millisecond, until the ringing has died.
"""

from typing import NamedTuple

import numpy as np

from controller.motion.plan import Plan
from parser.toolpath import Floats, Ints, Toolpath
from sim.directions import directions

SPACING_UM = 5.0
"""Path between two samples of the trace. On an arc of 100 µm radius the chord of it is 0.03 µm off."""
SPACED = 500_000
"""Samples along the path past which they are set wider apart: a program of any length is followed in seconds."""
FINE_RAD = 0.2
"""Phase of the ringing in one tick: thirty ticks to the period, half a millisecond on a table of 60 Hz."""
FELT_UM = 0.25
"""Ringing of less than this, a quarter of a step, is not resolved."""
SETTLED = 3.0
"""Decay times after which ringing counts as dead: e⁻³ is 5 %."""


_COINCIDE_S = 1e-6


class Ringing(NamedTuple):
    """How the slowest axis rings on its drive: natural frequency and decay rate, both 1/s."""

    frequency: float
    decay: float

    @property
    def tick_s(self) -> float:
        """Tick while it rings."""
        return FINE_RAD / self.frequency

    @property
    def settled_s(self) -> float:
        """Time after which it has died."""
        return SETTLED / self.decay


class Ticks(NamedTuple):
    """n ticks: (n,) float64 s, strictly rising, and (n,) int64 rows of the toolpath that each one ends in."""

    t_s: Floats
    row: Ints


def choose_ticks(toolpath: Toolpath, plan: Plan, ringing: Ringing) -> Ticks:
    """Ends of all ticks of a program, from 0 until the table has come to rest after the end of the plan."""
    before = np.concatenate([[0.0], np.cumsum(toolpath.length_um)])
    along = _spaced(before)
    times = np.concatenate([plan.time_at(along), plan.time_s, *_fine_windows(toolpath, plan, before, ringing)])
    rest = plan.duration_s + np.arange(ringing.tick_s, ringing.settled_s, ringing.tick_s)
    times = np.unique(np.concatenate([times[(times > 0.0) & (times <= plan.duration_s)], rest]))
    # Borders that all but coincide are one tick, the later of them.
    times = times[np.diff(times, append=np.inf) > _COINCIDE_S]
    row = np.searchsorted(plan.time_at(before[1:]), times - 1e-9, side="right")
    return Ticks(times, np.minimum(row, len(toolpath) - 1))


def _spaced(before: Floats) -> Floats:
    """Path lengths at most `SPACING_UM` apart where that makes up to `SPACED`, every border of blocks among them."""
    length = np.diff(before)
    spacing = max(SPACING_UM, float(before[-1]) / SPACED)
    parts = np.maximum(np.ceil(length / spacing), 1.0).astype(np.int64)
    row = np.repeat(np.arange(len(length)), parts)
    part = np.arange(1, len(row) + 1) - (np.cumsum(parts) - parts)[row]
    return np.minimum(before[row] + length[row] * (part / parts[row]), before[row + 1])


def _fine_windows(toolpath: Toolpath, plan: Plan, before: Floats, ringing: Ringing) -> list[Floats]:
    """Fine ticks from each shake until it has died, overlapping windows joined."""
    shakes = np.unique(np.concatenate([*_ramps(plan, ringing), _corners(toolpath, plan, before, ringing)]))
    if not len(shakes):
        return []
    length = ringing.settled_s
    opens = shakes[np.diff(shakes, prepend=-np.inf) > length]
    closes = np.append(shakes[:-1][np.diff(shakes) > length], shakes[-1]) + length
    return [np.arange(low, high, ringing.tick_s) for low, high in zip(opens, closes, strict=True)]


def _ramps(plan: Plan, ringing: Ringing) -> list[Floats]:
    """Times within phases whose acceleration bends the drives enough: lag is a / ω²."""
    ends = plan.acceleration_um_s2 + plan.jerk_um_s3 * np.diff(plan.time_s)
    felt = np.maximum(np.abs(plan.acceleration_um_s2), np.abs(ends)) / ringing.frequency**2 > FELT_UM
    return [
        np.append(np.arange(low, high, 1.0 / ringing.decay), high)
        for low, high in zip(plan.time_s[:-1][felt], plan.time_s[1:][felt], strict=True)
    ]


def _corners(toolpath: Toolpath, plan: Plan, before: Floats, ringing: Ringing) -> Floats:
    """Times of the block borders at which the velocity jumps enough: swing is Δv / ω."""
    ways = directions(toolpath)
    change = ways.leaving[1:] - ways.arriving[:-1]
    turn = np.hypot(change[:, 0], change[:, 1])
    speed = plan.speed_at(before[1:-1])
    shakes: Floats = plan.time_at(before[1:-1])[turn * speed / ringing.frequency > FELT_UM]
    return shakes
