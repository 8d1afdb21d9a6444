"""Ticks: when the table's physics is worked out. Fine where the drives are shaken, long where nothing happens.

Cutting is quasi-static: at 60 µm/s each step shakes the table for a few milliseconds and then leaves it alone. Before
each sample of the trace, ticks are a fraction of the period at which the axes ring. They begin at the last moment
before the sample at which no step was felt (`sim.table.solve.slab`). Between samples a tick may be as long as it likes.
Where the velocity itself changes by enough to be felt, ticks are finer still until that shake has died.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.motion.plan import Plan
from parser.geometry.curves import Floats, Ints
from parser.geometry.directions import directions
from parser.toolpath import Toolpath
from sim.table.when.rhythm import STEP_RAD, Rhythm

SPACED = 500_000
"""Most samples along the path, about: a longer path has them wider apart. Each border of blocks is a sample besides."""
SHAKEN_RAD = 0.05
"""Phase of the ringing in one tick while the axes are shaken by more than a step."""

_COINCIDE_S = 1e-6
FELT_UM = 0.25
"""A ringing smaller than this gets no finer ticks than a single step does."""


class Ticks(NamedTuple):
    """The ticks of a run, in n stretches of equal ticks.

    Attributes
    ----------
    t_s
        (n,) float64, end of each stretch, strictly rising.
    tick_s
        (n,) float64, longest tick in it; infinite where the stretch is one long tick, in which the axes only creep.
    sampled
        (n,) bool, whether the trace has a sample at its end.
    row
        (n,) int64, row of the toolpath that it ends in.
    step_tick_s
        Longest tick while steps are felt.
    """

    t_s: Floats
    tick_s: Floats
    sampled: NDArray[np.bool_]
    row: Ints
    step_tick_s: float = math.inf

    @property
    def long(self) -> NDArray[np.bool_]:
        """Which stretches are one long tick, (n,)."""
        return np.isinf(self.tick_s)

    @property
    def parts(self) -> Ints:
        """Ticks in each stretch, (n,)."""
        return parts(np.diff(self.t_s, prepend=0.0), self.tick_s)

    def until(self, t_s: float) -> "Ticks":
        """The ticks up to a time above 0, where the trace gets its last sample; those before it are short."""
        at = int(np.searchsorted(self.t_s, t_s - _COINCIDE_S))
        since_s = float(self.t_s[at - 1]) if at else 0.0
        ends_s = np.array([t_s - self.step_tick_s, t_s])
        new = ends_s - since_s > _COINCIDE_S
        ends_s, within = ends_s[new], np.full(int(new.sum()), min(at, len(self.t_s) - 1))
        tick_s = self.tick_s[within]
        tick_s[-1:] = np.minimum(tick_s[-1:], self.step_tick_s)
        sampled = np.concatenate([self.sampled[:at], np.zeros(len(ends_s), dtype=bool)])
        sampled[-1:] = True
        return self._replace(
            t_s=np.concatenate([self.t_s[:at], ends_s]),
            tick_s=np.concatenate([self.tick_s[:at], tick_s]),
            sampled=sampled,
            row=np.concatenate([self.row[:at], self.row[within]]),
        )


def parts(length_s: Floats, tick_s: Floats) -> Ints:
    """Number (n,) of equal ticks, of at most `tick_s` each, that stretches of these lengths are cut into."""
    return np.maximum(np.ceil(length_s / tick_s - 1e-9), 1.0).astype(np.int64)


def choose_ticks(toolpath: Toolpath, plan: Plan, rhythm: Rhythm, spacing_um: float, *, every_step: bool) -> Ticks:
    """Ticks of a program, from 0 until the table has come to rest after the end of the plan.

    The trace gets a sample at every border of blocks and after every `spacing_um` of path. With `every_step` no tick is
    long.
    """
    before = toolpath.before_um
    borders = plan.time_at(before)
    rest = plan.duration_s + rhythm.died_s
    samples = np.concatenate([plan.time_at(_spaced(before, spacing_um)), [plan.duration_s, rest]])
    samples = _apart(np.unique(samples[samples > 0.0]))
    before_sample = 0.0 if every_step else samples - rhythm.step_tick_s
    felt = _joined(np.stack(np.broadcast_arrays(before_sample, samples), axis=1))
    shaken = _joined(np.concatenate([shakes(toolpath, plan, before, rhythm), [[plan.duration_s, rest]]]))
    cuts = np.concatenate([samples, felt.ravel(), shaken.ravel()])
    t_s = _apart(np.unique(cuts[(cuts > 0.0) & (cuts <= samples[-1])]), samples)
    length = np.diff(t_s, prepend=0.0)
    middle = t_s - length / 2.0
    is_felt, is_shaken = _within(felt, middle), _within(shaken, middle)
    tick_s = np.where(is_shaken, SHAKEN_RAD, STEP_RAD) / rhythm.fastest
    return Ticks(
        t_s=t_s,
        tick_s=np.where(is_felt | is_shaken, tick_s, np.inf),
        sampled=np.isin(t_s, samples),
        row=np.minimum(np.searchsorted(borders[1:], t_s - 1e-9, side="right"), len(toolpath) - 1),
        step_tick_s=rhythm.step_tick_s,
    )


def _spaced(before: Floats, spacing_um: float) -> Floats:
    """Path lengths of the samples: at most `spacing_um` apart, or wider so that `SPACED` do; borders of blocks too."""
    length = np.diff(before)
    spacing = max(spacing_um, float(before[-1]) / SPACED)
    parts = np.maximum(np.ceil(length / spacing), 1.0).astype(np.int64)
    row = np.repeat(np.arange(len(length)), parts)
    part = np.arange(1, len(row) + 1) - (np.cumsum(parts) - parts)[row]
    return np.minimum(before[row] + length[row] * (part / parts[row]), before[row + 1])


def _apart(t_s: Floats, kept: Floats | None = None) -> Floats:
    """Rising times, with those left out that all but coincide with the next time, or with a time in `kept`."""
    if kept is None:
        return t_s[np.diff(t_s, append=np.inf) > _COINCIDE_S]
    near = np.searchsorted(kept, t_s)
    after = kept[np.minimum(near, len(kept) - 1)] - t_s
    before = t_s - kept[np.maximum(near - 1, 0)]
    close = ((after > 0.0) & (after <= _COINCIDE_S)) | ((near > 0) & (before <= _COINCIDE_S))
    return np.union1d(_apart(t_s[~close]), kept)


def _joined(windows: Floats) -> Floats:
    """Windows (n, 2) in order, overlapping ones joined."""
    windows = windows[np.argsort(windows[:, 0], kind="stable")]
    reach = np.maximum.accumulate(windows[:, 1])
    first = np.append(True, windows[1:, 0] > reach[:-1])
    last = np.append(first[1:], True)
    return np.stack([windows[first, 0], reach[last]], axis=1)


def _within(windows: Floats, t_s: Floats) -> NDArray[np.bool_]:
    """Whether (n,) times lie in one of the windows, in order and apart."""
    window = np.searchsorted(windows[:, 0], t_s, side="right") - 1
    inside: NDArray[np.bool_] = (window >= 0) & (t_s <= windows[window, 1])
    return inside


def shakes(toolpath: Toolpath, plan: Plan, before: Floats, rhythm: Rhythm) -> Floats:
    """Windows (n, 2) s from each shake until it has died: ramps of speed, corners."""
    ramps, corners = _ramps(plan, rhythm), _corners(toolpath, plan, before, rhythm)
    windows = np.concatenate([ramps, np.stack([corners, corners], axis=1)])
    windows[:, 1] += rhythm.died_s
    return windows


def _ramps(plan: Plan, rhythm: Rhythm) -> Floats:
    """Phases (n, 2) s that bend the drives enough: lag is a / ω², and no more than Δv / ω."""
    time = np.diff(plan.time_s)
    ends = plan.acceleration_um_s2 + plan.jerk_um_s3 * time
    lag = np.maximum(np.abs(plan.acceleration_um_s2), np.abs(ends)) / rhythm.frequency**2
    change = np.abs(plan.acceleration_um_s2 + ends) * time / 2.0
    felt = np.minimum(lag, change / rhythm.frequency) > FELT_UM
    return np.stack([plan.time_s[:-1], plan.time_s[1:]], axis=1)[felt]


def _corners(toolpath: Toolpath, plan: Plan, before: Floats, rhythm: Rhythm) -> Floats:
    """Times of the block borders at which the velocity jumps enough: swing is Δv / ω."""
    ways = directions(toolpath)
    change = ways.leaving[1:] - ways.arriving[:-1]
    turn = np.hypot(change[:, 0], change[:, 1])
    speed = plan.speed_at(before[1:-1])
    shakes: Floats = plan.time_at(before[1:-1])[turn * speed / rhythm.frequency > FELT_UM]
    return shakes
