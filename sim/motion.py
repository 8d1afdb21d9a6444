"""A run's motion: the host drives the card, the card hands out its pulses, the table follows them tick by tick."""

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from controller.card.log import CardLog
from controller.card.settings import CardSettings
from controller.host.entries import Drive
from controller.host.host import Host
from controller.stepping.pulses import Pulses
from parser.toolpath import Floats
from sim.table import Table
from sim.ticks import Ticks
from sim.trace import Trace

_TABLE_SLICE = 20_000  # ticks between two words to the progress
_GRACE_S = 1e-9  # a pulse due at the end of a tick is out, whichever way its time was rounded


class Progress(Protocol):
    """Told how far a stage has come."""

    def __call__(self, stage: str, done: int, total: int) -> None:
        """`done` of `total` units of the stage."""


class Motion(NamedTuple):
    """What is to be run, on which card, and the ticks to follow it by."""

    drive: Drive
    card: CardSettings
    ticks: Ticks


def run_card(
    motion: Motion,
    take: Callable[[Pulses], None],
    progress: Progress,
    log: CardLog | None = None,
) -> Floats:
    """Run the program on the card: positions (n, 2) µm commanded at the end of each of the n ticks.

    Every pulse goes to `take`, every call to `log`; pulses and positions are in program coordinates.
    """
    commands = _Commands(motion)
    total = int(motion.drive.plan.duration_s)

    def taken(pulses: Pulses) -> None:
        take(pulses)
        commands.take(pulses)
        if log is not None:
            log.count(pulses)
        progress("running the card", min(int(pulses.t_s[-1]), total), total)

    host = Host(motion.drive, motion.card, taken, log)
    host.run()
    if log is not None:
        log.close(host.card)
    return commands.result()


class _Commands:
    """Positions commanded at the end of each tick, as the pulses stream in."""

    def __init__(self, motion: Motion) -> None:
        self._t_s = motion.ticks.t_s
        self._command = np.empty((len(self._t_s), 2))
        self._done = 0
        self._at = np.array(motion.drive.origin_um, dtype=np.float64)

    def take(self, pulses: Pulses) -> None:
        place = np.empty((len(pulses.t_s) + 1, 2))
        place[0], place[1:, 0], place[1:, 1] = self._at, pulses.x_um, pulses.y_um
        until = int(np.searchsorted(self._t_s, pulses.t_s[-1] - _GRACE_S))
        ends = self._t_s[self._done : until] + _GRACE_S
        self._command[self._done : until] = place[np.searchsorted(pulses.t_s, ends, side="right")]
        self._done, self._at = max(until, self._done), place[-1]

    def result(self) -> Floats:
        self._command[self._done :] = self._at
        return self._command


def run_table(motion: Motion, command_um: Floats, table: Table, progress: Progress) -> Trace:
    """Trace of the table following the commands, a sample a tick and one at the start."""
    start = np.array(motion.drive.origin_um, dtype=np.float64)
    actual = np.empty_like(command_um)
    dt = np.diff(motion.ticks.t_s, prepend=0.0)
    for low in range(0, len(dt), _TABLE_SLICE):
        part = slice(low, low + _TABLE_SLICE)
        actual[part] = list(table.follow(dt[part], command_um[part] - start))
        progress("moving the table", min(low + _TABLE_SLICE, len(dt)), len(dt))
    return Trace(
        t_s=np.concatenate([[0.0], motion.ticks.t_s]),
        commanded_um=np.concatenate([start[None, :], command_um]),
        actual_um=np.concatenate([start[None, :], actual + start]),
        row=np.concatenate([motion.ticks.row[:1], motion.ticks.row]),
    )
