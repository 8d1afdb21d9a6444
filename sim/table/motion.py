"""A run's motion: the host drives the card, the card hands out its pulses, the table follows them tick by tick."""

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from controller.card.core.settings import CardSettings
from controller.card.log.writer import CardLog
from controller.host.entries import Drive
from controller.host.host import Host
from controller.motion.limits import Feeds, row_limits
from controller.motion.planner import plan_rows
from controller.stepping.pulses import Pulses
from parser.toolpath import Toolpath
from sim.setup.machine.machine import Machine
from sim.table.follow import Following, Setup
from sim.table.record.history import History
from sim.table.record.losses import Loss
from sim.table.record.peaks import Peak
from sim.table.solve.slow_step import NO_PLAY
from sim.table.solve.trial import slow_step
from sim.table.trace import Trace
from sim.table.when.rhythm import rhythm
from sim.table.when.ticks import Ticks, choose_ticks


class Progress(Protocol):
    """Told how far a stage has come; the stage by its name, of which people read the text in ``progress.toml``."""

    def __call__(self, stage: str, done: int, total: int) -> None:
        """`done` of `total` units of the stage."""


def silent(stage: str, done: int, total: int) -> None:
    """Progress that nobody watches."""


class Motion(NamedTuple):
    """What is to be run, by which card, and on which table, with the ticks to follow it by."""

    drive: Drive
    card: CardSettings
    table: Setup
    ticks: Ticks


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
    beats = rhythm(machine.table)
    slow = slow_step(machine.table, beats)
    x, y = controller.limits.axis_speed_um_s
    table = Setup(machine.table, start_um, origin_um(toolpath), slow or NO_PLAY, speed_limit_um_s=(x, y))
    ticks = choose_ticks(toolpath, plan, beats, spacing_um, every_step=slow is None)
    return Motion(drive, controller.card_settings, table, ticks)


def origin_um(toolpath: Toolpath) -> tuple[int, int]:
    """Start of the program in whole µm, where the steps begin."""
    x, y = np.rint(toolpath.start_um[0]).astype(int).tolist()
    return x, y


def simulate(
    motion: Motion,
    take: Callable[[Pulses], None],
    progress: Progress,
    log: CardLog | None = None,
) -> Moved:
    """Run the motion on card and table. Every pulse goes to `take`, every call to `log`, in program coordinates."""
    table = Following(motion.table, motion.ticks)
    total = int(motion.drive.plan.duration_s)

    def taken(pulses: Pulses) -> None:
        take(pulses)
        table.take(pulses)
        if log is not None:
            log.count(pulses)
        progress("run", min(int(pulses.t_s[-1]), total), total)

    host = Host(motion.drive, motion.card, taken, log)
    host.run()
    if log is not None:
        log.close(host.card)
    return Moved(*table.finish())
