"""Passes over the lanes of a slab, until each begins as the one ahead of it ends."""

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from sim.table.physics.drive import drives_of
from sim.table.physics.state import State
from sim.table.solve.lanes import Lanes
from sim.table.solve.march import Table
from sim.table.solve.slab import Slab

LANE_TICKS = 256
"""Ticks of a lane: enough of them that a table forgets how it began, few enough that many run side by side."""
AGREED_UM = 0.01
"""Lanes agree where the places differ by no more than this, and the swings that velocities make, v / ω."""
UNDECIDED_UM = 0.5
"""The same, besides half the backlash, once passes bring them no nearer: some tables hold on to chance.

A slide that steps throw about in its play, or that friction holds where it happened to be thrown, may go on in one of
several ways, whichever it began with. Half a step of that is not worth a pass for each lane.
"""
STALLED = 0.98
"""Share of the wrong lanes that a pass leaves wrong where it brought nothing."""
PATIENCE = 6
"""Passes that may bring nothing."""


def run_slab(slab: Slab, state: State, table: Table) -> Lanes:
    """Lanes of a slab that begins with the state (of one table), all run and in agreement."""
    borders = _borders(slab)
    lanes = Lanes(slab, borders, table)
    begin = _guessed(slab, borders, state, table)
    drives = drives_of(table.model)
    check = _Check(lanes, begin, slab.from_rest[borders[:-1]], np.sqrt(drives.spring[:, 0]))
    wrong, futile = np.ones(len(borders) - 1, dtype=bool), 0
    while wrong.any() and futile < PATIENCE:
        before = wrong.sum()
        lanes.run(np.flatnonzero(wrong), begin)
        wrong = check.after(wrong, np.zeros_like(wrong), AGREED_UM)
        futile = futile + 1 if wrong.sum() > STALLED * before else 0
    undecided_um = UNDECIDED_UM + drives.slack_um[:, 0]
    wrong = check.after(np.ones_like(wrong), wrong, undecided_um) if wrong.any() else wrong
    while wrong.any():
        # What goes on from lane to lane, lost steps and stops, is left: then only those run that begin for certain.
        due = wrong & ~np.append(False, wrong[:-1])
        lanes.run(np.flatnonzero(due), begin)
        wrong = check.after(due, wrong & ~due, undecided_um)
    return lanes


def _borders(slab: Slab) -> Ints:
    """First ticks of the lanes, and the end: after a long tick where one is near."""
    number = max(1, len(slab) // LANE_TICKS)
    even = np.linspace(0, len(slab), number + 1).astype(np.int64)
    rest = np.append(np.flatnonzero(slab.from_rest[:-1]), len(slab))
    near = rest[np.minimum(np.searchsorted(rest, even), len(rest) - 1)]
    inner = np.where(near - even < LANE_TICKS // 4, near, even)[1:-1]
    return np.unique(np.concatenate([[0], inner, [len(slab)]]))


def _guessed(slab: Slab, borders: Ints, state: State, table: Table) -> State:
    """States that the lanes begin with if all goes slowly: each slide where its motor has drawn it."""
    begin = state.of(np.zeros(len(borders) - 1, dtype=np.int64))
    begin.at_um[1:] = _drawn(slab, borders, state.at_um[0] + state.lost_um[0], table.slow.play_um) - state.lost_um[0]
    np.clip(begin.at_um, *table.room_um, out=begin.at_um)
    begin.velocity[1:] = np.where(slab.from_rest[borders[1:-1], None], 0.0, slab.speed_um_s[borders[1:-1]])
    return begin


def _drawn(slab: Slab, borders: Ints, at_um: Floats, play_um: Floats) -> Floats:
    """Places (k - 1, 2) of the slides at the borders between lanes, each drawn along within its play.

    A slide stays within backlash and friction's hold of its motor, the play operator (M. Brokate, J. Sprekels,
    "Hysteresis and Phase Transitions", 1996, ch. 2): each tick clips its place, and clips in a row are one clip.
    """
    if not play_um.any():
        return slab.place_um[borders[1:-1]]
    low, high = np.full((len(borders) - 2, 2), -np.inf), np.full((len(borders) - 2, 2), np.inf)
    for number in range(int(np.diff(borders).max())):
        place = slab.place_um[np.minimum(borders[:-2] + number, borders[1:-1] - 1)]
        low, high = (np.clip(end, place - play_um, place + play_um) for end in (low, high))
    drawn = np.empty_like(low)
    for lane, (least, most) in enumerate(zip(low, high, strict=True)):
        drawn[lane] = at_um = np.clip(at_um, least, most)
    return drawn


class _Check:
    """Holds what lanes begin with against what those ahead of them end with.

    `begin` is what each lane is to begin with, corrected as it comes to be known; `from_rest` (k,) tells which lanes
    begin after a long tick, so at rest whatever came before; `frequency` (2,) are the natural ones of the axes, 1/s.
    """

    def __init__(self, lanes: Lanes, begin: State, from_rest: NDArray[np.bool_], frequency: Floats) -> None:
        self._lanes, self._begin, self._from_rest, self._frequency = lanes, begin, from_rest, frequency

    def after(
        self, run: NDArray[np.bool_], wrong: NDArray[np.bool_], tolerance_um: float | Floats
    ) -> NDArray[np.bool_]:
        """Lanes (k,) that are wrong now that some were `run` and others, `wrong`, were not."""
        wrong, told = wrong.copy(), np.append(False, run)
        for lane in range(1, len(wrong)):
            if told[lane]:
                told[lane + 1] |= self._tell(lane, wrong, tolerance_um)
        return wrong

    def _tell(self, lane: int, wrong: NDArray[np.bool_], tolerance_um: float | Floats) -> bool:
        """Correct what a lane begins with and whether it is `wrong`; whether the next lane is to be told."""
        one, was_wrong, ahead = np.array([lane]), bool(wrong[lane]), self._ahead(lane)
        lost = ahead.lost_um - self._lanes.begun.lost_um[lane]
        wrong[lane] = self._differs(lane, ahead, lost, tolerance_um)
        if wrong[lane]:
            self._begin.put(one, ahead)
            return not was_wrong
        if lost.any():
            self._lanes.shift(lane, lost[0])
        self._begin.put(one, self._lanes.begun.of(one))
        return was_wrong or bool(lost.any())

    def _ahead(self, lane: int) -> State:
        """How the lane ahead ends, for certain or, where it is wrong itself, likely: state of one table.

        An axis that did not move is off at the end by as much as at the beginning, and lost way shifts all that comes
        after it: so both go through many lanes at once.
        """
        ahead = np.array([lane - 1])
        begin, begun, end = (state.of(ahead) for state in (self._begin, self._lanes.begun, self._lanes.end))
        lost = begin.lost_um - begun.lost_um
        stays = ~self._lanes.moved[ahead] | begin.tripped[:, None]
        low, high = self._lanes.room_um
        at_um = np.where(stays, begin.at_um + end.at_um - begun.at_um, end.at_um - lost)
        still = stays | self._from_rest[lane] | (at_um < low) | (at_um > high)
        return State(
            at_um=np.clip(at_um, low, high),
            velocity=np.where(still, 0.0, end.velocity),
            lost_um=end.lost_um + lost,
            tripped=end.tripped | begin.tripped,
        )

    def _differs(self, lane: int, ahead: State, lost: Floats, tolerance_um: float | Floats) -> bool:
        """Whether the lane was run from another state than this: of one table, with (1, 2) more lost."""
        begun = self._lanes.begun
        off = np.abs(ahead.at_um + lost - begun.at_um[lane]) > tolerance_um
        off |= np.abs(ahead.velocity - begun.velocity[lane]) > tolerance_um * self._frequency
        off |= ahead.tripped != begun.tripped[lane]
        return bool(off.any()) or (bool(lost.any()) and self._lanes.near_stop(lane, lost[0]))
