"""The trial: a slow step of a table from every lag that it may rest at, tried in the engine."""

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from parser.units import from_mm
from sim.setup.machine.table_model import TableModel
from sim.table.physics.bodies import Engines
from sim.table.physics.drive import drives_of
from sim.table.physics.motor import Motors
from sim.table.physics.state import State
from sim.table.solve.march import March, Record, RunTable
from sim.table.solve.slab import Slab, slab_of
from sim.table.solve.slow_step import NO_PLAY, SlowStep
from sim.table.when.rhythm import Rhythm
from sim.table.when.ticks import Ticks

_WAIT = 3.0  # times a step is felt: then a slide stands still, or it never will
_MOVING_UM = 0.02
_NEAR = np.concatenate([np.linspace(-1.2, 2.5, 75), np.linspace(3.0, 6.0, 7)])  # µm from where friction gives way
_ACROSS = 17


def slow_step(model: TableModel, rhythm: Rhythm) -> SlowStep | None:
    """What slow steps do to the slides of a table; None where they do not come to rest between."""
    drives = drives_of(model)
    play = (drives.friction / drives.spring + drives.slack_um)[:, 0]
    if not play.any():
        return NO_PLAY
    before = _lags(play)
    end = after_a_step(model, rhythm, before)[2]
    if (np.abs(end.velocity) / rhythm.frequency > _MOVING_UM).any():
        return None
    return SlowStep(before, 1.0 - end.at_um.T)


def _lags(play_um: Floats) -> Floats:
    """Lags (2, g) at which slides may rest: closely where friction may give way to a step, both ways."""
    count = _ACROSS + 2 * len(_NEAR)
    lags = []
    for play in play_um:
        most = play + 1.2
        near = play - _NEAR
        all_ = np.unique(np.clip(np.concatenate([near, -near, np.linspace(-most, most, _ACROSS)]), -most, most))
        lags.append(np.interp(np.linspace(0.0, 1.0, count), np.linspace(0.0, 1.0, len(all_)), all_))
    return np.stack(lags)


def after_a_step(model: TableModel, rhythm: Rhythm, lag_um: Floats) -> tuple[Slab, Record, State]:
    """Ticks of a step of both axes from 0 to 1 µm, what tables (g) that rested at lags (2, g) µm do, and their end."""
    wait_s = _WAIT * rhythm.felt_s
    row = np.zeros(1, dtype=np.int32)
    motors = Motors(model.motor.step_time_s, (0, 0))
    motors.take(Pulses(np.array([0.1 * wait_s]), row + 1, row + 1, row), 0.0)
    ticks = Ticks(np.array([1.1 * wait_s]), np.array([rhythm.step_tick_s]), np.array([True]), np.array([0]))
    slab = slab_of(ticks, slice(0, 1), motors, model, rhythm.felt_s)
    half = from_mm(np.array([model.travel_x_mm, model.travel_y_mm])) / 2.0
    room = np.stack([-half, half])
    table = RunTable(model, room, NO_PLAY, Engines(model, room))
    number = lag_um.shape[1]
    begin = State(-lag_um.T, np.zeros((number, 2)), np.zeros((number, 2)), np.zeros(number, dtype=bool))
    return slab, *March(slab, np.repeat(np.arange(len(slab))[:, None], number, axis=1), table).run(begin)
