"""A run's motion: the card hands out its pulses, the table follows them tick by tick."""

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from controller.card import Status, StepCard
from controller.plan import Plan
from controller.pulses import Pulses
from controller.steps import Steps
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
    """What is to be run: steps and plan, the ticks to follow them by, and the start in whole µm of the program."""

    steps: Steps
    plan: Plan
    ticks: Ticks
    origin_um: tuple[int, int]


def run_card(motion: Motion, take: Callable[[Pulses], None], progress: Progress) -> Floats:
    """Positions (n, 2) µm commanded at the end of each of the n ticks; every pulse goes to `take`.

    Pulses and positions are in program coordinates.
    """
    x0, y0 = motion.origin_um
    t_s = motion.ticks.t_s
    command = np.empty((len(t_s), 2))
    done, made, at = 0, 0, np.array([x0, y0], dtype=np.float64)
    card = StepCard()
    card.load(motion.steps, motion.plan)
    card.start()
    while card.status is Status.RUNNING:
        pulses = card.take()
        pulses = pulses._replace(x_um=pulses.x_um + np.int32(x0), y_um=pulses.y_um + np.int32(y0))
        take(pulses)
        place = np.empty((len(pulses.t_s) + 1, 2))
        place[0], place[1:, 0], place[1:, 1] = at, pulses.x_um, pulses.y_um
        until = int(np.searchsorted(t_s, pulses.t_s[-1] - _GRACE_S))
        command[done:until] = place[np.searchsorted(pulses.t_s, t_s[done:until] + _GRACE_S, side="right")]
        done, made, at = until, made + len(pulses.t_s), place[-1]
        progress("stepping", made, len(motion.steps))
    command[done:] = at
    return command


def run_table(motion: Motion, command_um: Floats, table: Table, progress: Progress) -> Trace:
    """Trace of the table following the commands, a sample a tick and one at the start."""
    start = np.array(motion.origin_um, dtype=np.float64)
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
