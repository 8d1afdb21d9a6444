"""Deviation by cause: what each stage from the plan to the wire adds, and the meters on the pulses that tell it.

Deviation by cause: what each stage from the plan to the wire adds across the path, each by itself.

All that is measured of a run: deviation of its steps, its table and its wire, and what each cause adds to it.

Meters on the pulses of a run: how many steps a block makes, and how far they lie from ideal path and plan.
"""

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.compiled.loops import compiled
from controller.host.entries import Drive
from controller.motion.limits import Path, path_of
from controller.motion.plan import Plan
from controller.stepping.equal_time import chord_error_um
from controller.stepping.pulses import Pulses
from controller.stepping.steps import Steps
from parser.geometry.curves import Bools, Floats, Ints
from parser.toolpath import Toolpath
from sim.measure.deviation import ROUNDING_UM, Deviation, DeviationMeter, Where, across_um, farthest, summed, where
from sim.table.motion import Motion
from sim.table.ticks import BY_BORDER
from sim.table.trace import Trace

Whole = NDArray[np.int32]

PERIOD_ROUNDING = 1e-3
"""Share of a period by which rounding may move its end: 10⁻⁷ s over months of cutting."""


class Sampling(NamedTuple):
    """What interpolating at equal times costs.

    Attributes
    ----------
    axis_um
        Largest distance in X and in Y of the place commanded at the end of a servo period from the planned one.
    chord_um
        Largest distance of an arc from the chord between two such ends.
    rounding
        Deviation of the places commanded at those ends.
    """

    axis_um: tuple[float, float]
    chord_um: float
    rounding: Deviation


class StepMeters:
    """Deviation of the steps where they are, and of each block from where it began.

    Parameters
    ----------
    drive
        What is run.
    drift_um
        (n, 2) how far the steps are off when each block begins. The start point may lie between whole µm; and an
        interpolator that starts a block where the steps of the one before ended carries on what those missed.
    """

    def __init__(self, drive: Drive, drift_um: Floats) -> None:
        self._placed = DeviationMeter(drive.toolpath)
        self._own = DeviationMeter(drive.toolpath, drift_um) if drift_um.any() else self._placed

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses."""
        self._placed.add(pulses.row, pulses.x_um, pulses.y_um, pulses.t_s)
        if self._own is not self._placed:
            self._own.add(pulses.row, pulses.x_um, pulses.y_um, pulses.t_s)

    @property
    def placed(self) -> Deviation:
        """Of the steps where they are."""
        return self._placed.result()

    @property
    def own(self) -> Deviation:
        """Of the steps without what the blocks before missed."""
        return self._own.result()


class SamplingMeter:
    """How far the places commanded at equal times are from the planned ones."""

    def __init__(self, drive: Drive, period_s: float) -> None:
        self._drive, self._period_s = drive, period_s
        self._path = path_of(drive.toolpath)
        self._before = self._path.before_um
        self._shift = np.array(drive.origin_um) - drive.toolpath.start_um[:1]
        self._most = np.zeros(2)
        self._rounding = DeviationMeter(drive.toolpath, self._shift)

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses."""
        settled = self._ends_period(pulses.t_s)
        along = self._drive.plan.at(pulses.t_s[settled]).along_um
        row = np.minimum(np.searchsorted(self._before, along, side="right") - 1, len(self._path) - 1)
        wanted = self._path.place(row, along - self._before[row]) + self._shift
        place = np.stack([pulses.x_um[settled], pulses.y_um[settled]], axis=1)
        self._most = np.maximum(self._most, np.abs(place - wanted).max(axis=0, initial=0.0))
        self._rounding.add(pulses.row[settled], place[:, 0], place[:, 1], pulses.t_s[settled])

    def _ends_period(self, t_s: Floats) -> Bools:
        """Whether the pulse is the last at the end of a servo period; motion begins with one."""
        periods = t_s / self._period_s
        return (np.abs(periods - np.rint(periods)) < PERIOD_ROUNDING) & (np.diff(t_s, append=np.inf) > 0.0)

    def result(self) -> Sampling:
        """Of all pulses so far."""
        x, y = self._most.tolist()
        chord_um = chord_error_um(self._path, self._drive.plan, self._period_s)
        return Sampling((x, y), chord_um, self._rounding.result())


@dataclass(frozen=True, slots=True, eq=False)
class BlockSteps:
    """What the steps of n blocks came to.

    Attributes
    ----------
    count
        (n,) int64, steps of each block.
    corner_um
        (n + 1, 2) int64, place before each block and at the end, µm of the program.
    """

    count: Ints
    corner_um: Ints

    def __len__(self) -> int:
        return int(self.count.sum())


@compiled("void(i4[::1], i4[::1], i4[::1], i8[::1], i8[:, ::1])")
def _tally(row: Whole, x_um: Whole, y_um: Whole, count: Ints, end_um: Ints) -> None:
    """Count the steps (m,) of each block, and keep where the last one ends."""
    for i in range(len(row)):
        own = row[i]
        count[own] += 1
        end_um[own, 0], end_um[own, 1] = x_um[i], y_um[i]


class StepTally:
    """Counts steps as they stream in, in memory that does not grow with them."""

    def __init__(self, blocks: int, origin_um: tuple[int, int]) -> None:
        self._count = np.zeros(blocks, dtype=np.int64)
        self._end = np.zeros((blocks, 2), dtype=np.int64)
        self._origin = np.array([origin_um], dtype=np.int64)

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses, in program coordinates, rows never falling."""
        row, x, y = (column.astype(np.int32) for column in (pulses.row, pulses.x_um, pulses.y_um))
        _tally(row, x, y, self._count, self._end)

    def result(self) -> BlockSteps:
        """Of all steps so far; a block without steps ends where it began."""
        stepped = np.arange(1, len(self._count) + 1) * (self._count > 0)
        latest = np.maximum.accumulate(np.concatenate([[0], stepped]))
        return BlockSteps(self._count.copy(), np.concatenate([self._origin, self._end])[latest])


class Part(NamedTuple):
    """What one cause adds: the most, µm, and where it was met first; None where it adds nothing."""

    max_um: float
    where: Where | None


NOTHING = Part(0.0, None)


class Stage(NamedTuple):
    """Where a stage puts the m samples of a trace: places (m, 2) µm, and how far (m,) from the path, left positive."""

    place_um: Floats
    off_um: Floats


class Causes(NamedTuple):
    """Parts of the deviation.

    Attributes
    ----------
    interpolation
        Steps are rounded to whole µm.
    carried
        The steps of a block begin where those of the blocks before it ended, which missed its start.
    planning
        The card commands chords between the places planned for the ends of its periods. Nothing where the interpolator
        makes each step for the path itself.
    table
        The table does not stand where it is commanded.
    wire
        The wire bows back from where the table stands.
    """

    interpolation: Part
    carried: Part
    planning: Part
    table: Part
    wire: Part


def whole(deviation: Deviation) -> Part:
    """All of a deviation as one part."""
    return Part(deviation.max_um, deviation.where) if deviation.max_um > 0.0 else NOTHING


def added(trace: Trace, stage: Stage, before: Stage) -> Part:
    """What a stage adds across the path to the one before it.

    Places on two sides of a block are at least as far apart as both distances together. Where they are nearer, the
    block does not lie between them: one lies past its end, or each is measured from a block of its own. There the sides
    say nothing, and only the distances are compared. So no stage adds more than it moves.
    """
    moved = np.hypot(*(stage.place_um - before.place_um).T)
    across = np.abs(stage.off_um - before.off_um)
    nearer = np.abs(np.abs(stage.off_um) - np.abs(before.off_um))
    parted = across <= moved + ROUNDING_UM
    return _largest(trace, stage.place_um, np.where(parted, across, np.minimum(nearer, moved)))


def _largest(trace: Trace, place_um: Floats, away_um: Floats) -> Part:
    most = float(away_um.max())
    if most == 0.0:
        return NOTHING
    return Part(most, where(trace, place_um, farthest(away_um)))


def cut_off(toolpath: Toolpath, trace: Trace, plan: Plan, period_s: float) -> Part:
    """How far the path lies from chords between the places planned for the ends of periods, on arcs and at corners."""
    path = path_of(toolpath)
    on_arcs = trace.t_s[path.curvature[trace.row] > 0.0]
    at_corners = plan.time_at(path.before_um[1:-1])
    time = np.concatenate([on_arcs, at_corners])
    away = np.concatenate([_arcs_cut_off(path, plan, on_arcs, period_s), _corners_cut_off(path, plan, period_s)])
    if not away.any():
        return NOTHING
    at = int(np.argmax(away))
    row, place = _planned(path, plan.at(time[at : at + 1]).along_um)
    x, y = place[0].tolist()
    return Part(float(away[at]), Where(int(row[0]) + 1, x, y, float(time[at])))


def _arcs_cut_off(path: Path, plan: Plan, t_s: Floats, period_s: float) -> Floats:
    """Sagittas (m,) of the way that one period takes on arcs at times (m,); 2 sin² instead of 1 − cos keeps digits."""
    instant = plan.at(t_s)
    row = _row(path, instant.along_um)
    bend = path.curvature[row]
    way = np.minimum(instant.speed_um_s * period_s, path.length_um[row])
    sagitta = 2.0 * np.sin(np.minimum(bend * way, 2.0 * np.pi) / 4.0) ** 2
    return np.divide(sagitta, bend, out=np.zeros_like(bend), where=bend > 0.0)


def _corners_cut_off(path: Path, plan: Plan, period_s: float) -> Floats:
    """How far the chord over each inner border of rows stays away from the path there.

    With a way a before a corner of angle γ and b after it the chord is at most a b sin γ / (a + b) off both sides:
    where it crosses the line that halves the angle.
    """
    before = path.before_um[1:-1]
    period = np.floor(plan.time_at(before) / period_s)
    low, high = (plan.at(end * period_s).along_um for end in (period, period + 1.0))
    start, end = _planned(path, low)[1], _planned(path, high)[1]
    corner, by = path.start_um[1:] - start, end - start
    twice_the_area = np.abs(by[:, 0] * corner[:, 1] - by[:, 1] * corner[:, 0])
    return np.divide(twice_the_area, high - low, out=np.zeros_like(before), where=high > low)


def _planned(path: Path, along_um: Floats) -> tuple[Ints, Floats]:
    """Rows (m,) and places (m, 2) at lengths along the path."""
    row = _row(path, along_um)
    return row, path.place(row, np.minimum(along_um - path.before_um[row], path.length_um[row]))


def _row(path: Path, along_um: Floats) -> Ints:
    return np.clip(np.searchsorted(path.before_um, along_um, side="right") - 1, 0, len(path) - 1)


class Deviations(NamedTuple):
    """Deviation of steps, table and wire from the ideal geometry.

    `steps` is measured where the steps are. For `interpolation` the steps of each block are moved back by what they
    were off when the block began, so that what earlier blocks missed does not count. Where the wire does not bow,
    `wire` is the same as `table`. `by_cause` tells what each stage adds. `sampling` is None unless the card
    interpolates.
    """

    interpolation: Deviation
    steps: Deviation
    table: Deviation
    wire: Deviation
    by_cause: Causes
    sampling: Sampling | None


_MEASURED: Final = 2000
"""Pulses at which what the table adds is measured: so many where it lags most across, and by borders of blocks."""


def _largest_of(value: Floats) -> Ints:
    """Numbers of the `_MEASURED` largest values (m,)."""
    count = min(_MEASURED, len(value))
    return np.argpartition(value, len(value) - count)[len(value) - count :]


def _lag_across_um(toolpath: Toolpath, trace: Trace) -> Floats:
    """How far (m,) the table stands from its command across the block that runs, whichever way."""
    by, row = trace.table_um - trace.commanded_um, trace.row
    out = np.where(toolpath.is_arc[:, None], np.nan, toolpath.end_um - toolpath.start_um)[row]
    is_arc = toolpath.is_arc[row]
    radial = trace.commanded_um[is_arc] - toolpath.center_um[row[is_arc]]
    out[is_arc] = np.stack([-radial[:, 1], radial[:, 0]], axis=1)  # the way on an arc is across its radius
    length = np.hypot(out[:, 0], out[:, 1])
    across = np.abs(out[:, 0] * by[:, 1] - out[:, 1] * by[:, 0])
    lag: Floats = np.divide(across, length, out=np.zeros_like(length), where=length > 0.0)
    return lag


class Meters:
    """All that is measured of the pulses of a run, and of the trace that they make."""

    def __init__(self, motion: Motion, steps: Steps) -> None:
        drive = motion.drive
        self._toolpath, self._plan = drive.toolpath, drive.plan
        own = drive.interpolation == "card"
        start = drive.toolpath.start_um
        drift = np.array(drive.origin_um) - (start[:1] if own else start - steps.corner_um[:-1])
        self._drift: Floats = np.broadcast_to(drift, start.shape)
        self._steps = StepMeters(drive, self._drift)
        self._period_s = motion.card.servo_period_s
        self._sampling = SamplingMeter(drive, self._period_s) if own else None
        self.tally = StepTally(len(drive.toolpath), drive.origin_um)

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses."""
        self._steps.take(pulses)
        self.tally.take(pulses)
        if self._sampling is not None:
            self._sampling.take(pulses)

    def deviations(self, trace: Trace, probes: Trace) -> Deviations:
        """Of all pulses so far, and of the trace that they made; `probes` are places of the table at pulses."""
        along_um = self._plan.at(trace.t_s).along_um
        commanded, table = (self._stage(trace, along_um, place) for place in (trace.commanded_um, trace.table_um))
        bows = trace.wire_um is not trace.table_um
        wire = self._stage(trace, along_um, trace.wire_um) if bows else table
        sampling = self._sampling.result() if self._sampling is not None else None
        of_table = summed(self._toolpath, trace, *table)
        return Deviations(
            interpolation=self._steps.own,
            steps=self._steps.placed,
            table=of_table,
            wire=summed(self._toolpath, trace, *wire) if bows else of_table,
            by_cause=Causes(
                interpolation=whole(self._steps.own if sampling is None else sampling.rounding),
                carried=self._carried(trace, along_um, commanded),
                planning=NOTHING if sampling is None else cut_off(self._toolpath, trace, self._plan, self._period_s),
                table=max(added(trace, table, commanded), self._at_pulses(probes), key=lambda part: part.max_um),
                wire=added(trace, wire, table) if bows else NOTHING,
            ),
            sampling=sampling,
        )

    def _at_pulses(self, probes: Trace) -> Part:
        """What the table adds at the pulses that are looked at: it lags most before it moves for them.

        Of these the pulses are measured at which it lags most across their own blocks, and most at all by borders of
        blocks, where another block may be the nearer one.
        """
        if not len(probes):
            return NOTHING
        moved = np.hypot(*(probes.table_um - probes.commanded_um).T)
        by_border = np.zeros(len(probes), dtype=bool)
        around = np.flatnonzero(np.diff(probes.row))[:, None] + np.arange(-BY_BORDER, BY_BORDER + 1)
        by_border[np.clip(around.ravel(), 0, len(probes) - 1)] = True
        most = np.union1d(_largest_of(_lag_across_um(self._toolpath, probes)), _largest_of(moved * by_border))
        closest = Trace(probes.t_s[most], probes.commanded_um[most], *2 * (probes.table_um[most],), probes.row[most])
        along_um = self._plan.at(closest.t_s).along_um
        commanded, table = (self._stage(closest, along_um, each) for each in (closest.commanded_um, closest.table_um))
        return added(closest, table, commanded)

    def _stage(self, trace: Trace, along_um: Floats, place_um: Floats) -> Stage:
        return Stage(place_um, across_um(self._toolpath, trace, place_um, along_um))

    def _carried(self, trace: Trace, along_um: Floats, commanded: Stage) -> Part:
        """What the command adds to where it would be without what the blocks before missed."""
        if not self._drift.any():
            return NOTHING
        own_um = trace.commanded_um - self._drift[trace.row]
        return added(trace, commanded, self._stage(trace, along_um, own_um))
