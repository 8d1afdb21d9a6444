"""When the trace has a sample of the table; and ticks, by which a table of bodies goes (`sim.table.bodies`).

While steps are felt, a tick is a fraction of the period at which its axis rings. Where the velocity itself changes by
enough to be felt, ticks are finer still until that shake has died. Between steps a slide stands, and needs none.

Rhythm: how the axes of a table answer, which says how finely and for how long they have to be watched.
"""

from typing import Final, NamedTuple

import numpy as np

from controller.motion.plan import Plan
from controller.stepping.pulses import time_steps
from controller.stepping.steps import Steps
from parser.geometry.along import directions
from parser.geometry.curves import Bools, Curves, Floats, Ints
from sim.setup.machine.table import TableModel
from sim.table.drive import drives_of

STEP_RAD = 0.125
"""Phase of the ringing in one tick while single steps are felt: fifty ticks to the period."""
STEPS_RAD = 0.1
"""The same while a motor makes several steps at once: their sum has corners within a tick."""
SHAKEN_RAD = 0.05
"""Phase of the ringing in one tick while the axes are shaken by more than a step."""
DIED = 6.0
"""Decay times after which a shake counts as dead: e⁻⁶ is 0.25 %."""
_ARRIVES = 14.0
"""Times of a position loop, 1 over its gain, after which it has come: of 1 mm that it was behind 1 nm is left."""


class Rhythm(NamedTuple):
    """How the axes answer.

    Attributes
    ----------
    frequencies
        Natural frequencies of X and Y, 1/s.
    decay
        Decay rate of the slower axis, 1/s.
    arrives_s
        Time that a position loop takes to come to its command; 0 without one.
    """

    frequencies: tuple[float, float]
    decay: float
    arrives_s: float = 0.0

    @property
    def frequency(self) -> float:
        """Natural frequency of the slower axis, 1/s."""
        return min(self.frequencies)

    def tick_s(self, phase_rad: float) -> tuple[float, float]:
        """Time in which X and Y go through a phase of their ringing."""
        x, y = self.frequencies
        return phase_rad / x, phase_rad / y

    @property
    def died_s(self) -> float:
        """Time after which a shake has died."""
        return DIED / self.decay

    @property
    def rests_s(self) -> float:
        """Time after which the table rests behind its last pulse."""
        return self.died_s + self.arrives_s


def rhythm(model: TableModel) -> Rhythm:
    """Rhythm of a table: ω = sqrt(k / m) of each axis, decay ζω of the slower, or that of the slow root where ζ > 1."""
    x, y = (drive.frequency for drive in drives_of(model))
    ratio = model.drive_damping_ratio
    slow = ratio - (ratio**2 - 1.0) ** 0.5 if ratio > 1.0 else ratio
    loop = model.motor.loop
    return Rhythm((x, y), slow * min(x, y), 0.0 if loop is None else _ARRIVES / loop.gain_per_s)


class Sampling(NamedTuple):
    """Where the trace has samples along the path, besides the borders of blocks.

    Attributes
    ----------
    spacing_um
        How far they are apart at most.
    lag_um
        How far the wire lags behind its guides: behind a corner it comes round within a few lags, and samples are
        closer there.
    """

    spacing_um: float
    lag_um: float = 0.0


SPACED = 500_000
"""Most samples along the path, about: a longer path has them wider apart. Each border of blocks is a sample besides."""
FELT_UM = 0.25
"""A ringing smaller than this gets no finer ticks than a single step does."""
_TURNED_LAGS = 4.0
"""Within so many lags behind a corner the wire cuts it off most: 1 to 1.36 on, or 2 more past more than 90°."""
_OF_A_LAG = 50
"""Samples there on a lag of way: of a right angle by a lag of 20 µm they show 9.6 of the 9.64 µm that are cut off."""
_TURN_RAD = 0.01
"""A wire cuts less than 0.004 lag off a corner of less."""

_COINCIDE_S = 1e-6
_AT_S = 1e-9
"""A moment that is so little behind a border of blocks still counts as at it."""


class Ticks(NamedTuple):
    """Ticks and samples of a run.

    Attributes
    ----------
    t_s
        (n,) float64, times of the samples, strictly rising; the last is the end of the run.
    row
        (n,) int64, row of the toolpath that was running then.
    shaken_s
        (m, 2) float64, times in order from which to which the axes are shaken by more than a step.
    step_tick_s, steps_tick_s, shaken_tick_s
        Ticks of X and of Y, falling: while single steps are felt, while a motor makes several at once, and while the
        axes are shaken by more.
    probe_s, probe_row
        (p,) float64 and int64, times of pulses at which the table is looked at besides, for the most that it adds to
        its command, and the rows that were running; the trace has no samples of them.
    """

    t_s: Floats
    row: Ints
    shaken_s: Floats
    step_tick_s: tuple[float, float]
    steps_tick_s: tuple[float, float]
    shaken_tick_s: tuple[float, float]
    probe_s: Floats = np.empty(0)
    probe_row: Ints = np.empty(0, dtype=np.int64)

    @property
    def looks(self) -> tuple[Floats, Bools]:
        """All times (n + p,) at which the table is looked at, in order, and which of them are pulses and no samples."""
        t_s = np.concatenate([self.t_s, self.probe_s])
        order = np.argsort(t_s, kind="stable")
        return t_s[order], order >= len(self.t_s)

    def row_at(self, t_s: float) -> int:
        """Row of the toolpath that was running at a time."""
        return int(self.row[min(int(np.searchsorted(self.t_s, t_s)), len(self.row) - 1)])

    def until(self, t_s: float) -> "Ticks":
        """The ticks up to a time above 0, where the trace gets its last sample."""
        at, probes = (int(np.searchsorted(times, t_s - _COINCIDE_S)) for times in (self.t_s, self.probe_s))
        return self._replace(
            t_s=np.append(self.t_s[:at], t_s),
            row=np.append(self.row[:at], self.row_at(t_s)),
            probe_s=self.probe_s[:probes],
            probe_row=self.probe_row[:probes],
        )


_NO_PROBES: Final = np.empty(0)


def choose_ticks(
    toolpath: Curves, plan: Plan, rhythm: Rhythm, sampling: Sampling, probe_s: Floats = _NO_PROBES
) -> Ticks:
    """Ticks of a program, from 0 until the table has come to rest after the end of the plan.

    The trace gets a sample at every border of blocks, and on the path as `sampling` has it. `probe_s` are rising times
    of pulses.
    """
    before = toolpath.before_um
    borders = plan.time_at(before)
    rest = plan.duration_s + rhythm.rests_s
    along = np.concatenate([_spaced(before, sampling.spacing_um), _behind_corners(toolpath, before, sampling)])
    samples = np.concatenate([plan.time_at(np.sort(along)), [plan.duration_s, rest]])
    samples = _apart(np.unique(samples[samples > 0.0]))
    return Ticks(
        t_s=samples,
        row=_rows_at(borders, samples),
        shaken_s=_joined(np.concatenate([shakes(toolpath, plan, before, rhythm), [[plan.duration_s, rest]]])),
        step_tick_s=rhythm.tick_s(STEP_RAD),
        steps_tick_s=rhythm.tick_s(STEPS_RAD),
        shaken_tick_s=rhythm.tick_s(SHAKEN_RAD),
        probe_s=probe_s,
        probe_row=_rows_at(borders, probe_s),
    )


def _rows_at(border_s: Floats, t_s: Floats) -> Ints:
    """Rows of the toolpath (m,) that run at times, by the times of their borders."""
    return np.minimum(np.searchsorted(border_s[1:], t_s - _AT_S, side="right"), len(border_s) - 2)


MOST_PROBES: Final = 100_000
"""Pulses that the table is looked at, about, besides those at borders of blocks: of more, runs of `_TOGETHER`."""
_TOGETHER: Final = 2000
BY_BORDER: Final = 20
"""Pulses on either side of a border of blocks, where what lags may lie across another block."""
_MOST_BORDERS: Final = 150
"""Borders that are looked at where not all pulses are."""


def probes_of(steps: Steps, plan: Plan, period_s: float | None) -> Floats:
    """Times of pulses, rising, at which a table lags most behind its command: all of them, or runs of them.

    Each step of `steps` has a pulse; where a card interpolates, pulses come at the ends of its periods.
    """
    if period_s is not None:
        borders = (plan.border_s(steps.along_um) / period_s).astype(np.int64)
        ends = np.concatenate([np.arange(*window) for window in _windows(int(plan.duration_s / period_s), borders)])
        return np.asarray((ends + 1.0) * period_s)
    from controller.stepping.chunks import chunk_of  # noqa: PLC0415 - loads the compiler

    times = [time_steps(chunk_of(steps, *window), plan).t_s for window in _windows(len(steps), steps.before)]
    return np.concatenate(times)


def _windows(count: int, border: Ints) -> list[tuple[int, int]]:
    """First and past number of runs that are looked at, of so many; `border` are numbers at borders of blocks."""
    if count <= MOST_PROBES:
        return [(0, count)]
    first = np.linspace(0, count - _TOGETHER, MOST_PROBES // _TOGETHER).astype(np.int64)
    every = 1 + len(border) // _MOST_BORDERS
    low = np.concatenate([first, np.maximum(border[::every] - BY_BORDER, 0)])
    past = np.concatenate([first + _TOGETHER, np.minimum(border[::every] + BY_BORDER, count)])
    joined = _joined(np.stack([low, past], axis=1).astype(np.float64))
    return [(int(begin), int(end)) for begin, end in joined.tolist() if end > begin]


def _spaced(before: Floats, spacing_um: float) -> Floats:
    """Path lengths of the samples: at most `spacing_um` apart, or wider so that `SPACED` do; borders of blocks too."""
    length = np.diff(before)
    spacing = max(spacing_um, float(before[-1]) / SPACED)
    parts = np.maximum(np.ceil(length / spacing), 1.0).astype(np.int64)
    row = np.repeat(np.arange(len(length)), parts)
    part = np.arange(1, len(row) + 1) - (np.cumsum(parts) - parts)[row]
    return np.minimum(before[row] + length[row] * (part / parts[row]), before[row + 1])


def _behind_corners(toolpath: Curves, before: Floats, sampling: Sampling) -> Floats:
    """Path lengths of samples behind corners, where a wire that lags comes round; `SPACED` at most, about."""
    lag_um = sampling.lag_um
    if sampling.spacing_um * _OF_A_LAG <= lag_um or not lag_um:
        return np.empty(0)
    ways = directions(toolpath)
    turn = np.hypot(*(ways.leaving[1:] - ways.arriving[:-1]).T)  # of unit vectors, so rad where it is small
    corner = before[1:-1][turn > _TURN_RAD]
    on = np.arange(1.0, _TURNED_LAGS * _OF_A_LAG) / _OF_A_LAG
    on = on[:: 1 + len(on) * len(corner) // SPACED]
    along = (corner[:, None] + on * lag_um).ravel()
    within: Floats = along[along < before[-1]]
    return within


def _apart(t_s: Floats) -> Floats:
    """Rising times, with those left out that all but coincide with the next time."""
    return t_s[np.diff(t_s, append=np.inf) > _COINCIDE_S]


def _joined(windows: Floats) -> Floats:
    """Windows (n, 2) in order, overlapping ones joined."""
    windows = windows[np.argsort(windows[:, 0], kind="stable")]
    reach = np.maximum.accumulate(windows[:, 1])
    first = np.append(True, windows[1:, 0] > reach[:-1])
    last = np.append(first[1:], True)
    return np.stack([windows[first, 0], reach[last]], axis=1)


def shakes(toolpath: Curves, plan: Plan, before: Floats, rhythm: Rhythm) -> Floats:
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


def _corners(toolpath: Curves, plan: Plan, before: Floats, rhythm: Rhythm) -> Floats:
    """Times of the block borders at which the velocity jumps enough: swing is Δv / ω."""
    ways = directions(toolpath)
    change = ways.leaving[1:] - ways.arriving[:-1]
    turn = np.hypot(change[:, 0], change[:, 1])
    speed = plan.speed_at(before[1:-1])
    shakes: Floats = plan.time_at(before[1:-1])[turn * speed / rhythm.frequency > FELT_UM]
    return shakes
