"""Neighbours of an axis that loses steps: the same run, begun some thousandths of a µm off, so that chance is seen.

Where a motor is too weak, what it loses may hang on the last digit of where its slide stood: neighbouring inputs part.
A run cannot tell which of them a machine is. So what it lost is told with what its neighbours lose.
"""

from parser.controller_words import Axis
from parser.geometry.curves import Floats
from sim.table.losses import Loss, SlipTally
from sim.table.run import AxisRun
from sim.table.ticks import Ticks
from sim.table.trace import Trace

NEIGHBOURS_UM = (-0.002, -0.001, 0.001, 0.002)
"""How far off the slides of neighbours stand as the pulses begin among which the first step is lost: far less than any
table is known."""


class AxisWithNeighbours:
    """An axis, what it loses, and its neighbours once it has lost a step."""

    def __init__(self, run: AxisRun, ticks: Ticks) -> None:
        self.run, self._ticks = run, ticks
        self.tally = SlipTally(ticks)
        self.neighbours: list[tuple[AxisRun, SlipTally]] = []

    def take(self, t_s: Floats, place_um: Floats) -> None:
        """Take the next pulses: when they come, and the places (n,) that they command."""
        for run in (self.run, *(neighbour for neighbour, _ in self.neighbours)):
            run.take(t_s, place_um)

    def losses(self, axis: Axis, trace: Trace) -> list[Loss]:
        """What it lost in each block."""
        return self.tally.losses(axis, trace, [tally for _, tally in self.neighbours])

    def follow(self, until_s: float, braked_s: float) -> None:
        """Let the axis follow its pulses up to a time, and its neighbours with it; note what they lose."""
        before = self.run.state
        slips = list(self.run.follow(until_s, braked_s))
        self.tally.take(slips)
        if slips and not self.neighbours:
            self.neighbours = [(self.run.neighbour(before, by_um), SlipTally(self._ticks)) for by_um in NEIGHBOURS_UM]
        for neighbour, tally in self.neighbours:
            tally.take(neighbour.follow(until_s, braked_s))
