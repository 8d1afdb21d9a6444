"""The table as bodies in a pymunk space: a saddle on X guides carries a carriage on Y guides, with stops at their ends.

The engine's lengths are µm, its masses kg. Its clock counts ticks, and a velocity is the way in a tick: so each axis
may have ticks of its own.
"""

import pymunk

from parser.controller_words import Axis
from parser.geometry.curves import Floats
from sim.setup.machine.table_model import TableModel
from sim.table.physics.state import Slide

_ITERATIONS = 400  # guides hold at right angles; a stop has to take the velocity of both bodies, whatever their masses


class Bodies:
    """Saddle and carriage, standing at a place; `room_um` (2, 2) are the lowest and the highest place of the travel."""

    def __init__(self, model: TableModel, room_um: Floats, at_um: tuple[float, float]) -> None:
        self._space = pymunk.Space()
        self._space.iterations = _ITERATIONS
        self._saddle = pymunk.Body(model.saddle_mass_kg, float("inf"))
        self._carriage = pymunk.Body(model.carriage_mass_kg, float("inf"))
        self._saddle.position, self._carriage.position = (at_um[0], 0.0), at_um
        self._moved_kg, self._room = model.moved_kg, room_um.tolist()
        (left, bottom), (right, top) = self._room
        ground = self._space.static_body
        self._space.add(
            self._saddle,
            self._carriage,
            pymunk.GrooveJoint(ground, self._saddle, (left, 0.0), (right, 0.0), (0.0, 0.0)),
            pymunk.GrooveJoint(self._saddle, self._carriage, (0.0, bottom), (0.0, top), (0.0, 0.0)),
        )

    def moved_um(self, axis: Axis, slide: Slide, way_um: float) -> float:
        """Where an axis is after a tick in which its drive pushes its slide to go a way; no farther than its stops.

        A step of the engine moves the bodies first and pushes them then. So the slide is put to where it was a tick
        before; it comes from there, and is pushed.
        """
        came_um = slide.velocity * slide.tick_s
        driven = self._saddle if axis is Axis.X else self._carriage
        for body in (self._saddle, self._carriage):
            place, velocity = list(body.position), [0.0, 0.0]
            if body is driven or axis is Axis.X:
                place[axis], velocity[axis] = slide.at_um - came_um, came_um
            body.position, body.velocity = (place[0], place[1]), (velocity[0], velocity[1])
        push = (way_um - came_um) * self._moved_kg[axis]
        driven.force = (push, 0.0) if axis is Axis.X else (0.0, push)
        self._space.step(1.0)
        reached_um = self._carriage.position[axis] + self._carriage.velocity[axis]
        low, high = self._room
        return float(min(max(reached_um, low[axis]), high[axis]))
