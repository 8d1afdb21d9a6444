"""A run's motion: the host drives the card, the card hands out its pulses, the table follows them tick by tick."""

import math
from collections import deque
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from controller.card.core.settings import CardSettings
from controller.card.log import CardLog
from controller.host.entries import Drive
from controller.host.host import Host
from controller.motion.limits import Feeds, row_limits
from controller.motion.planner import plan_rows
from controller.stepping.pulses import Pulses, joined
from controller.stepping.steps import Steps
from parser.toolpath import Toolpath
from sim.base.progress import Progress, silent
from sim.setup.machine.machine import Machine
from sim.table.follow import Following, Setup
from sim.table.history import History
from sim.table.losses import Loss, Peak
from sim.table.ticks import Sampling, Ticks, choose_ticks, probes_of, rhythm
from sim.table.trace import Trace, origin_um

_TOGETHER = 1 << 14
"""Pulses that the table follows at a time: each time costs it a millisecond, and slow feeds hand out few at once."""


class Motion(NamedTuple):
    """What is to be run, by which card, and on which table.

    Attributes
    ----------
    drive, card, table
        What is driven, the settings of its card, and the table.
    ticks
        When the table is looked at.
    until_s
        When the machine stops, whatever is left of the plan.
    """

    drive: Drive
    card: CardSettings
    table: Setup
    ticks: Ticks
    until_s: float = math.inf

    def until(self, t_s: float) -> "Motion":
        """The same motion, stopped at a time."""
        return self._replace(ticks=self.ticks.until(max(t_s, *self.ticks.step_tick_s)), until_s=t_s)


class Moved(NamedTuple):
    """How the table moved: its trace, losses of its drives, their peaks against the limits, and its history.

    `probes` are its places at pulses, where it lags most behind its command.
    """

    trace: Trace
    probes: Trace
    losses: tuple[Loss, ...]
    peaks: tuple[Peak, ...]
    history: History


def motion_of(  # noqa: PLR0913, PLR0917 - what moves, by what, and how closely it is watched
    toolpath: Toolpath,
    feeds: Feeds,
    machine: Machine,
    start_um: tuple[float, float],
    sampling: Sampling,
    steps: Steps | None = None,
) -> Motion:
    """Motion of a toolpath on a machine, planned at these feeds; the trace has samples as `sampling` has it.

    With its steps the table is looked at where it lags most, too.
    """
    controller = machine.controller
    limits = row_limits(toolpath, feeds, controller.limits)
    plan = plan_rows(limits, jerk_um_s3=controller.limits.jerk_um_s3)
    drive = Drive(toolpath, limits, plan, origin_um(toolpath), controller.interpolation)
    x, y = controller.limits.axis_speed_um_s
    table = Setup(machine.table, start_um, origin_um(toolpath), (x, y), machine.engine)
    period_s = controller.card_settings.servo_period_s if controller.interpolation == "card" else None
    probe_s = () if steps is None else (probes_of(steps, plan, period_s),)
    ticks = choose_ticks(toolpath, plan, rhythm(machine.table), sampling, *probe_s)
    return Motion(drive, controller.card_settings, table, ticks)


def driven(motion: Motion, log: CardLog | None = None) -> Iterator[Pulses]:
    """The pulses of a motion, as the host drives the card along it; every call, and the end, goes to `log`."""
    host = Host(motion.drive, motion.card, log, motion.until_s)
    for pulses in host.pulses():
        if log is not None:
            log.count(pulses)
        yield pulses
    if log is not None:
        log.close(host.card)


class TableRun:
    """A table that follows the pulses of a motion; they end where the machine stops.

    That is at the motion's `until_s`, or where a servo trips.
    """

    def __init__(self, motion: Motion, progress: Progress = silent) -> None:
        self._table = Following(motion.table, motion.ticks)
        self._until_s, self._progress = motion.until_s, progress
        self._total = int(min(motion.drive.plan.duration_s, motion.until_s))
        self._waiting: deque[Pulses] = deque()
        self._moved: Moved | None = None

    @property
    def moved(self) -> Moved:
        """How the table moved, once it has come to rest behind the last pulses."""
        if self._moved is None:
            self._moved = Moved(*self._table.finish())
        return self._moved

    def followed(self, pulses: Iterable[Pulses]) -> Iterator[Pulses]:
        """Let the table follow; the pulses come out again as soon as it is sure that the machine ran them."""
        for handed in joined(pulses, _TOGETHER):
            due = _up_to(handed, self._until_s)
            if not len(due.t_s):
                continue
            self._waiting.append(due)
            self._table.take(due)
            yield from self._ran(self._table.followed_s)
            self._progress("run", min(int(due.t_s[-1]), self._total), self._total)
        assert self.moved  # noqa: S101 - it comes to rest, which may trip it
        yield from self._ran(math.inf)

    def _ran(self, until_s: float) -> Iterator[Pulses]:
        """Those that wait and end by a time, as far as the machine ran."""
        while self._waiting and self._waiting[0].t_s[-1] <= until_s:
            ran = _up_to(self._waiting.popleft(), self._table.tripped_s)
            if len(ran.t_s):
                yield ran


def _up_to(pulses: Pulses, t_s: float) -> Pulses:
    """The pulses up to a time."""
    return pulses.part(0, int(np.searchsorted(pulses.t_s, t_s, side="right")))
