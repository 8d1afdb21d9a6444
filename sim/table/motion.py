"""A run's motion: the host drives the card, the card hands out its pulses, the table follows them tick by tick."""

import math
from collections import deque
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from controller.card.core.settings import CardSettings
from controller.card.log.writer import CardLog
from controller.host.entries import Drive
from controller.host.host import Host
from controller.motion.limits import Feeds, row_limits
from controller.motion.planner import plan_rows
from controller.stepping.pulses import Pulses
from parser.toolpath import Toolpath
from sim.base.progress import Progress
from sim.setup.machine.machine import Machine
from sim.table.follow import Following, Setup
from sim.table.record.history import History
from sim.table.record.losses import Loss
from sim.table.record.peaks import Peak
from sim.table.trace import Trace, origin_um
from sim.table.when.rhythm import rhythm
from sim.table.when.ticks import Ticks, choose_ticks


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
    """How the table moved: its trace, the losses of its drives, their peaks against the limits, and its history."""

    trace: Trace
    losses: tuple[Loss, ...]
    peaks: tuple[Peak, ...]
    history: History


def motion_of(
    toolpath: Toolpath,
    feeds: Feeds,
    machine: Machine,
    start_um: tuple[float, float],
    spacing_um: float,
) -> Motion:
    """Motion of a toolpath on a machine, planned at these feeds; the trace has a sample every `spacing_um` of path."""
    controller = machine.controller
    limits = row_limits(toolpath, feeds, controller.limits)
    plan = plan_rows(limits, jerk_um_s3=controller.limits.jerk_um_s3)
    drive = Drive(toolpath, limits, plan, origin_um(toolpath), controller.interpolation)
    x, y = controller.limits.axis_speed_um_s
    table = Setup(machine.table, start_um, origin_um(toolpath), (x, y), machine.engine)
    ticks = choose_ticks(toolpath, plan, rhythm(machine.table), spacing_um)
    return Motion(drive, controller.card_settings, table, ticks)


Source = Callable[[Callable[[Pulses], None]], None]
"""Runs a motion, and hands its pulses, in program coordinates and in order, to what it is given."""


def of_host(motion: Motion, log: CardLog | None = None) -> Source:
    """The host drives the card along the motion; every call goes to `log`, which is told the end too."""

    def run(taken: Callable[[Pulses], None]) -> None:
        def counted(pulses: Pulses) -> None:
            if log is not None:
                log.count(pulses)
            taken(pulses)

        host = Host(motion.drive, motion.card, counted, log, motion.until_s)
        host.run()
        if log is not None:
            log.close(host.card)

    return run


def simulate(motion: Motion, source: Source, take: Callable[[Pulses], None], progress: Progress) -> Moved:
    """Run the motion on the table by the pulses of a source. Every pulse goes to `take`, in program coordinates.

    The pulses end where the machine stops: at the motion's `until_s`, or where a servo trips.
    """
    table = Following(motion.table, motion.ticks)
    total = int(min(motion.drive.plan.duration_s, motion.until_s))
    waiting: deque[Pulses] = deque()

    def hand_on(until_s: float) -> None:
        while waiting and waiting[0].t_s[-1] <= until_s:
            ran = _up_to(waiting.popleft(), table.tripped_s)
            if len(ran.t_s):
                take(ran)

    def taken(pulses: Pulses) -> None:
        pulses = _up_to(pulses, motion.until_s)
        if len(pulses.t_s):
            waiting.append(pulses)
            table.take(pulses)
            hand_on(table.followed_s)
            progress("run", min(int(pulses.t_s[-1]), total), total)

    source(taken)
    moved = Moved(*table.finish())
    hand_on(math.inf)
    return moved


def _up_to(pulses: Pulses, t_s: float) -> Pulses:
    """The pulses up to a time."""
    return pulses.part(0, int(np.searchsorted(pulses.t_s, t_s, side="right")))
