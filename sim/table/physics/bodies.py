"""Many tables in one pymunk space: a saddle on X guides carries a carriage on Y guides, held by stops at their ends.

The engine's lengths are µm, its masses kg. Its clock counts ticks, and a velocity is the way in a tick. So each table
may have ticks of its own length, although one call steps all tables. All data go in and out in batches.
"""

import numpy as np
import pymunk
from pymunk import batch

from parser.geometry.curves import Floats
from sim.setup.machine.table_model import TableModel

_MOVED = batch.BodyFields.POSITION | batch.BodyFields.VELOCITY
_ITERATIONS = 2  # guides hold at right angles, so one pass would do; the second is for the stops at their ends


_BATCH = 64  # the number of tables is rounded up to multiples of this, so that an engine can be used again


class Engines:
    """Engines with tables of one kind, one for each number of tables; parameters as in `Tables`."""

    def __init__(self, model: TableModel, room_um: Floats) -> None:
        self._model, self._room = model, room_um
        self._engines: dict[int, Tables] = {}

    def of(self, count: int) -> "Tables":
        """An engine with at least `count` tables; the same count gives the same engine."""
        size = count if count < _BATCH else -(-count // _BATCH) * _BATCH
        if size not in self._engines:
            self._engines[size] = Tables(self._model, self._room, size)
        return self._engines[size]


class Tables:
    """`count` tables that are alike and do not touch; fewer may be in use.

    Parameters
    ----------
    model
        Masses.
    room_um
        (2, 2), lowest and highest place of the travel, where the stops stand.
    """

    def __init__(self, model: TableModel, room_um: Floats, count: int) -> None:
        self._x_kg, self._y_kg = model.moved_kg
        self._space = pymunk.Space()
        self._space.iterations = _ITERATIONS
        for _ in range(count):
            self._add_table(model, room_um)
        self._out, self._in = batch.Buffer(), batch.Buffer()
        self._bodies = np.zeros((2 * count + 1, 4))  # the space's own body comes last
        self._force = np.zeros((2 * count + 1, 2))
        self._used = 2 * count
        self._in.set_float_buf(self._force)

    def _add_table(self, model: TableModel, room_um: Floats) -> None:
        saddle = pymunk.Body(model.saddle_mass_kg, float("inf"))
        carriage = pymunk.Body(model.carriage_mass_kg, float("inf"))
        (left, bottom), (right, top) = room_um.tolist()
        ground = self._space.static_body
        self._space.add(
            saddle,
            carriage,
            pymunk.GrooveJoint(ground, saddle, (left, 0.0), (right, 0.0), (0.0, 0.0)),
            pymunk.GrooveJoint(saddle, carriage, (0.0, bottom), (0.0, top), (0.0, 0.0)),
        )

    def put(self, at_um: Floats) -> None:
        """Put the tables at places (2, n), standing still."""
        self._used = used = 2 * at_um.shape[1]
        state = np.zeros((len(self._force), 4))
        state[0:used:2, 0], state[1:used:2, :2] = at_um[0], at_um.T
        self._force[:] = 0.0
        placed = batch.Buffer()
        placed.set_float_buf(state.tobytes())
        batch.set_space_bodies(self._space, _MOVED, placed)
        self._bodies = state

    @property
    def at_um(self) -> Floats:
        """Places (2, n) before the move of the last tick."""
        return self._bodies[1 : self._used : 2, :2].T

    @property
    def move_um(self) -> Floats:
        """Moves (2, n) of the last tick."""
        return self._bodies[1 : self._used : 2, 2:].T

    def step(self, gain_um: Floats) -> None:
        """Let a tick pass: the tables move on, then their drives push them to gain (2, n) µm a tick."""
        self._force[0 : self._used : 2, 0] = gain_um[0] * self._x_kg
        self._force[1 : self._used : 2, 1] = gain_um[1] * self._y_kg
        batch.set_space_bodies(self._space, batch.BodyFields.FORCE, self._in)
        self._space.step(1.0)
        self._out.clear()
        batch.get_space_bodies(self._space, _MOVED, self._out)
        self._bodies = np.frombuffer(self._out.float_buf(), dtype=np.float64).reshape(-1, 4)
