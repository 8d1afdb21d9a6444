"""Runs of the table alone: a model, the pulses of any motion, and ticks that are all alike or chosen by the program."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from controller.motion.limits import Feeds
from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from parser.program import parse_program
from sim.setup.machine.machine import Machine
from sim.setup.machine.motor import Motor
from sim.setup.machine.table import TableEngine, TableModel
from sim.table.follow import Following, Setup
from sim.table.motion import Motion, Moved, TableRun, driven, motion_of
from sim.table.ticks import Sampling, Ticks

TICK_S = 1e-4
"""Of runs with ticks that are all alike."""

STEPPER = Motor("stepper", 0.002, 6.0, np.inf, ((0.0, 1e5),))
MODEL = TableModel(
    travel_x_mm=400.0,
    travel_y_mm=500.0,
    saddle_mass_kg=100.0,
    carriage_mass_kg=60.0,
    drive_stiffness_n_um=20.0,
    drive_damping_ratio=0.2,
    motor=STEPPER,
)
"""A table without friction, backlash, or a limit of force that is felt; different masses so that a mix-up shows."""
MOVED_KG = (160.0, 60.0)
CENTRE = (200_000.0, 250_000.0)

Path = Callable[[Floats], Floats]


class Drawn(NamedTuple):
    """A table drawn along: times (n,), places (n, 2) at the end of each tick, and all that came of it."""

    t_s: Floats
    at_um: Floats
    moved: Moved


def strong(force_n: float, **motor: object) -> Motor:
    """The stepper with another force at all rates."""
    return STEPPER._replace(force_curve=((0.0, force_n),), **motor)


def pulses_of(x_um: Path, y_um: Path, until_s: float, grid_s: float = 2e-6) -> Pulses:
    """Whole µm next to a motion; each change in the middle of the stretch of a fine grid that it is found in."""
    t_s = np.arange(0.0, until_s, grid_s)
    place = np.rint(np.stack([x_um(t_s), y_um(t_s)], axis=1)).astype(np.int32)
    changed = np.flatnonzero((np.diff(place, axis=0) != 0).any(axis=1)) + 1
    return Pulses(t_s[changed] - grid_s / 2.0, *place[changed].T, np.zeros(len(changed), dtype=np.int32))


def still(t_s: Floats) -> Floats:
    """A motion that is none."""
    return np.zeros_like(t_s)


def even_ticks(until_s: float, tick_s: float = TICK_S) -> Ticks:
    """Ticks all alike, and as many samples."""
    n = round(until_s / tick_s)
    t_s = tick_s * np.arange(1.0, n + 1.0)
    return Ticks(t_s, np.zeros(n, dtype=np.int64), np.empty((0, 2)), *[(tick_s, tick_s)] * 3)


def draw(
    model: TableModel,
    pulses: Pulses,
    ticks: Ticks,
    start_um: tuple[float, float] = CENTRE,
    engine: TableEngine = "compiled",
) -> Drawn:
    """Let a table follow pulses from standstill."""
    following = Following(Setup(model, start_um, (0, 0), engine=engine), ticks)
    following.take(pulses)
    moved = Moved(*following.finish())
    return Drawn(moved.trace.t_s, moved.trace.table_um, moved)


def motion(
    text: str,
    machine: Machine,
    feeds: Feeds,
    spacing_um: float = 20.0,
    start_um: tuple[float, float] = CENTRE,
) -> Motion:
    """A program's motion on a machine."""
    return motion_of(parse_program(text).toolpath, feeds, machine, start_um, Sampling(spacing_um))


def fixed(chosen: Motion, tick_s: float = TICK_S) -> Motion:
    """The same motion in ticks of one length all the way; samples at the same times."""
    alike = dict.fromkeys(("step_tick_s", "steps_tick_s", "shaken_tick_s"), (tick_s, tick_s))
    return chosen._replace(ticks=chosen.ticks._replace(**alike))


def moved(motion: Motion) -> Moved:
    """What the table makes of a motion."""
    table = TableRun(motion)
    for _ in table.followed(driven(motion)):
        pass  # nobody looks at the pulses
    return table.moved


def farthest_um(one: Moved, other: Moved) -> float:
    """Largest distance between two runs sampled at the same times."""
    return float(np.hypot(*(one.trace.table_um - other.trace.table_um).T).max())
