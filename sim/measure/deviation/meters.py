"""Meters on the pulses of a run: how many steps a block makes, and how far they lie from ideal path and plan."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.compiled.loops import compiled
from controller.host.entries import Drive
from controller.motion.limits import path_of
from controller.stepping.equal_time import chord_error_um
from controller.stepping.pulses import Pulses
from parser.geometry.curves import Bools, Floats, Ints
from sim.measure.deviation.deviation import Deviation, DeviationMeter

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
