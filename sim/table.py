"""The two-axis table in pymunk: a saddle on X guides carries a carriage on Y guides, each pulled by its drive.

A drive is the spring and damper of its train between the commanded position and the slide, limited in force; what an
axis can accelerate is what that force can do with the mass it moves. At the ends of the travel the drives stall.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pymunk

from parser.toolpath import Floats
from parser.units import from_mm
from sim.machine import TableModel
from sim.ticks import Ringing
from sim.units import engine_force, engine_stiffness

GUIDE_ENDS_UM = 100_000.0
"""How far the guides go on past the travel, so that no slide swings off them."""


class Drive(NamedTuple):
    """Drive of one axis in the engine's units (µm, kg, s)."""

    mass: float
    stiffness: float
    damping: float
    force_limit: float

    def force(self, command: float, speed: float, at: float, velocity: float, dt: float) -> float:
        """Force on the axis over a tick of `dt` that ends with the command at `command` and `speed`.

        Spring and damper are taken at the end of the tick (backward Euler), so that no tick is too long to be stable;
        for short ticks it is the spring and damper themselves. Compare E. Catto, "Soft Constraints", GDC 2011.
        """
        pull = self.stiffness * (command - at - dt * velocity) + self.damping * (speed - velocity)
        pull /= 1.0 + dt * (self.damping + dt * self.stiffness) / self.mass
        return max(-self.force_limit, min(self.force_limit, pull))


def drives(model: TableModel) -> tuple[Drive, Drive]:
    """X and Y drive of a table; damping is the ratio to critical damping of the axis' mass on its spring."""
    stiffness = engine_stiffness(model.drive_stiffness_n_um)
    limit = engine_force(model.drive_force_limit_n)
    x, y = (
        Drive(mass, stiffness, 2.0 * model.drive_damping_ratio * (stiffness * mass) ** 0.5, limit)
        for mass in model.moved_kg
    )
    return x, y


def ringing(model: TableModel) -> Ringing:
    """Ringing of the slower axis: ω = sqrt(k / m), decay ζω, or that of the slow root where ζ > 1."""
    frequency = min((drive.stiffness / drive.mass) ** 0.5 for drive in drives(model))
    ratio = model.drive_damping_ratio
    slow = ratio - (ratio**2 - 1.0) ** 0.5 if ratio > 1.0 else ratio
    return Ringing(frequency, slow * frequency)


class Table:
    """The table, standing still at the program's start.

    Parameters
    ----------
    model
        Masses, drives and travel.
    start_um
        Place of the start on the table, from the corner of the travel; positions are given relative to it.
    """

    def __init__(self, model: TableModel, start_um: tuple[float, float]) -> None:
        self._drives = drives(model)
        self._saddle, self._carriage = _guided(model)
        self._space = pymunk.Space()
        # The two guides hold at right angles: one pass of the solver satisfies both.
        self._space.iterations = 1
        self._space.add(self._saddle, self._carriage)
        room = _room(model, start_um)
        self._stall = _Stall(room)
        (left, bottom), (right, top) = room[0] - GUIDE_ENDS_UM, room[1] + GUIDE_ENDS_UM
        ground = self._space.static_body
        self._space.add(
            pymunk.GrooveJoint(ground, self._saddle, (left, 0.0), (right, 0.0), (0.0, 0.0)),
            pymunk.GrooveJoint(self._saddle, self._carriage, (0.0, bottom), (0.0, top), (0.0, 0.0)),
        )

    def follow(self, dt_s: Floats, command_um: Floats) -> Iterator[tuple[float, float]]:
        """Positions (x, y) µm at the end of each tick of `dt_s` (n,), commanded to `command_um` (n, 2) by then.

        At an end of the travel the motor stalls: steps beyond it are lost, and all that follows is off by as much.
        A loop over ticks: each depends on the one before, and pymunk steps one at a time.
        """
        if not len(dt_s):
            return
        last_x, last_y = self._stall.at_um.tolist()
        held = self._stall.held(command_um)
        x_drive, y_drive = self._drives
        saddle, carriage, step = self._saddle, self._carriage, self._space.step
        for dt, (x, y) in zip(dt_s.tolist(), held.tolist(), strict=True):
            (at_x, at_y), (v_x, v_y) = carriage.position, carriage.velocity
            saddle.force = x_drive.force(x, (x - last_x) / dt, at_x, v_x, dt), 0.0
            carriage.force = 0.0, y_drive.force(y, (y - last_y) / dt, at_y, v_y, dt)
            step(dt)
            pymunk.Body.update_position(saddle, dt)
            pymunk.Body.update_position(carriage, dt)
            last_x, last_y = x, y
            yield carriage.position


class _Stall:
    """What the motors make of commands: steps beyond an end of the travel are lost for good.

    `at_um` is where they stand, (2,) µm from the start.
    """

    def __init__(self, room_um: Floats) -> None:
        self._low, self._high = room_um
        self._asked, self.at_um = np.zeros(2), np.zeros(2)

    def held(self, command_um: Floats) -> Floats:
        """Where the motors stand for the next commands, (n, 2) µm."""
        held = command_um + (self.at_um - self._asked)
        if not np.all((held >= self._low) & (held <= self._high)):
            at, moves = self.at_um, np.diff(command_um, axis=0, prepend=self._asked[None, :])
            for tick, move in enumerate(moves):
                held[tick] = at = np.clip(at + move, self._low, self._high)
        self._asked, self.at_um = command_um[-1], held[-1]
        return held


def _guided(model: TableModel) -> tuple[pymunk.Body, pymunk.Body]:
    saddle, carriage = (
        pymunk.Body(model.saddle_mass_kg, float("inf")),
        pymunk.Body(model.carriage_mass_kg, float("inf")),
    )
    for body in (saddle, carriage):
        # The engine moves bodies before it accelerates them; with ticks of changing length the move belongs after.
        body.position_func = _stay
    return saddle, carriage


def _stay(body: pymunk.Body, dt: float) -> None:
    """Leave the move to `Table.follow`."""


def _room(model: TableModel, start_um: tuple[float, float]) -> Floats:
    """Lowest and highest place of the travel, (2, 2) µm relative to the start."""
    travel = from_mm(np.array([[0.0, 0.0], [model.travel_x_mm, model.travel_y_mm]]))
    room: Floats = travel - np.array(start_um)
    return room
