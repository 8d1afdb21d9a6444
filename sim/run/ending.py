"""What ends a run before its program is through: a servo that trips, or the end of the travel."""

from collections.abc import Iterable
from typing import Literal, NamedTuple

import numpy as np

from controller.motion.plan import Plan
from controller.stepping.chunks import CHUNK_STEPS, chunk_of
from controller.stepping.steps import Steps
from parser.controller_words import Axis
from parser.toolpath import Toolpath
from parser.units import from_mm
from sim.check.travel import ROUNDING_UM, beyond_um
from sim.run.prepare import Prepared
from sim.setup.machine.machine import TableModel
from sim.setup.scenario import Scenario
from sim.table.losses import Loss
from sim.table.motion import Motion, motion_of
from sim.table.trace import origin_um

Cause = Literal["trip", "travel"]

_STEPPED_UM = 2.0
"""The steps of a block leave its curve by less than this."""


class Ending(NamedTuple):
    """Where the machine stopped before its program was through.

    Attributes
    ----------
    cause
        ``trip``: a servo gave up; ``travel``: the next step would have left the travel.
    axis
        Whose servo, or whose travel.
    row
        Row of the toolpath that was running (block number less one).
    t_s
        When.
    x_um, y_um
        Place in program coordinates: of the table at a trip, of the last step at the end of the travel.
    """

    cause: Cause
    axis: Axis
    row: int
    t_s: float
    x_um: float
    y_um: float


def trip_of(losses: Iterable[Loss]) -> Ending | None:
    """The trip among the losses of a run, if there is one."""
    trip = next((loss for loss in losses if loss.kind == "trip"), None)
    return trip and Ending("trip", trip.axis, trip.row, trip.t_s, trip.x_um, trip.y_um)


def motion_to_end(ready: Prepared, scenario: Scenario) -> tuple[Motion, Ending | None]:
    """The motion of a program, and where it ends early because the path leaves the travel."""
    toolpath, machine, start_um = ready.program.toolpath, scenario.machine, scenario.start_um
    motion = motion_of(toolpath, ready.feeds, machine, start_um, scenario.trace_spacing_um)
    if scenario.past_stop:
        return motion, None
    ended = travel_end(ready, motion, scenario)
    return (motion.until(ended.t_s), ended) if ended else (motion, None)


def travel_end(ready: Prepared, motion: Motion, scenario: Scenario) -> Ending | None:
    """Where a motion leaves the travel; None where it does not."""
    of = ready.program.toolpath, ready.steps, motion.drive.plan
    return _travel_end(*of, scenario.machine.table, scenario.start_um)


def _travel_end(
    toolpath: Toolpath, steps: Steps, plan: Plan, table: TableModel, start_um: tuple[float, float]
) -> Ending | None:
    """The last step before the one that first leaves the travel, from a start on the table; None where all fit."""
    beyond = beyond_um(toolpath, steps, table, start_um)
    highest = from_mm(np.array([table.travel_x_mm, table.travel_y_mm]))
    for row in np.flatnonzero((beyond > -_STEPPED_UM).any(axis=1)).tolist():
        past = int(steps.before[row + 1])
        for since in range(int(steps.before[row]), past, CHUNK_STEPS):
            chunk = chunk_of(steps, since, min(since + CHUNK_STEPS, past))
            place = np.stack([chunk.x_um, chunk.y_um], axis=1) + np.array(start_um)
            out = np.argwhere((place < -ROUNDING_UM) | (place > highest + ROUNDING_UM))
            if len(out):
                return _before_step(toolpath, steps, plan, since + int(out[0, 0]), Axis(int(out[0, 1])))
    return None


def _before_step(toolpath: Toolpath, steps: Steps, plan: Plan, number: int, axis: Axis) -> Ending:
    """The place and the time before the step that has so many steps before it."""
    row = int(np.searchsorted(steps.before, number, side="right")) - 1
    along_um = (
        chunk_of(steps, number - 1, number).along_um if number > steps.before[row] else steps.along_um[row : row + 1]
    )
    x, y = steps.place_after(number)
    x0, y0 = origin_um(toolpath)
    return Ending("travel", axis, row, float(plan.time_at(along_um)[0]), float(x + x0), float(y + y0))
