"""The reference: the same ticks in Python, with the table as bodies that pymunk moves; ``--engine pymunk``.

It is some thousand times slower than the compiled loop, which tests hold against it.
"""

from parser.controller_words import Axis as AxisName
from sim.table.physics.bodies import Bodies
from sim.table.record.history import Record
from sim.table.solve.axis import Axis, AxisDemand, State
from sim.table.solve.tick import Passed, after, ahead_of, driven, due_s, recorded, waited


class InBodies:
    """An axis of a table of bodies: what `followed` of `sim.table.solve.tick` is to a compiled one."""

    def __init__(self, bodies: Bodies, name: AxisName) -> None:
        self._bodies, self._name = bodies, name

    def followed(self, axis: Axis, demand: AxisDemand, state: State, record: Record) -> State:
        """An axis that has followed its pulses to their end, has no room for slips in its record, or has tripped."""
        while (until_s := due_s(demand, state)) < demand.until_s and state.noted.slip < len(record.slip_s):
            if state.tripped_s < demand.braked_s:
                break
            waits = until_s > state.slide.t_s
            now = waited(state, until_s) if waits else self._ticked(axis, demand, state)
            state = recorded(axis, demand, state, now, record)
        return state

    def _ticked(self, axis: Axis, demand: AxisDemand, state: State) -> State:
        """An axis after a tick."""
        slide, ahead = state.slide, ahead_of(axis, demand, state)
        now = driven(axis, demand, slide, ahead)
        at_um = self._bodies.moved_um(self._name, slide, now.velocity * ahead.tick_s)
        velocity = (at_um - slide.at_um) / ahead.tick_s
        return after(axis, demand, state, ahead, Passed(now.force, at_um, velocity))
