"""The reference: the same ticks in Python, with the table as bodies that pymunk moves; ``--engine pymunk``.

It is some thousand times slower than the compiled loop, which tests hold against it.
"""

from parser.told.step_words import Axis as AxisName
from sim.table.physics.bodies import Bodies
from sim.table.record.gather import Record
from sim.table.solve.axis import Asked, Axis, State
from sim.table.solve.tick import Passed, after, ahead_of, driven, due_s, recorded, waited


class InBodies:
    """An axis of a table of bodies: what `followed` of `sim.table.solve.tick` is to a compiled one."""

    def __init__(self, bodies: Bodies, name: AxisName) -> None:
        self._bodies, self._name = bodies, name

    def followed(self, axis: Axis, asked: Asked, state: State, record: Record) -> State:
        """An axis that has followed its pulses to their end, has no room for slips in its record, or has tripped."""
        while (until_s := due_s(asked, state)) < asked.until_s and state.noted.slip < len(record.slip_s):
            if state.tripped_s < asked.braked_s:
                break
            waits = until_s > state.slide.t_s
            now = waited(state, until_s) if waits else self._ticked(axis, asked, state)
            state = recorded(axis, asked, state, now, record)
        return state

    def _ticked(self, axis: Axis, asked: Asked, state: State) -> State:
        """An axis after a tick."""
        slide, ahead = state.slide, ahead_of(axis, asked, state)
        now = driven(axis, asked, slide, ahead)
        at_um = self._bodies.moved_um(self._name, slide, now.velocity * ahead.tick_s)
        velocity = (at_um - slide.at_um) / ahead.tick_s
        return after(axis, asked, state, ahead, Passed(now.force, at_um, velocity))
