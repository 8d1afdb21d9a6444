"""Passes over the lanes of a slab: run them, match each with the lane ahead, run again those that do not match."""

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from sim.table.physics.drive import drives_of
from sim.table.physics.state import State
from sim.table.solve.lanes import Lanes
from sim.table.solve.march import RunTable
from sim.table.solve.slab import Slab
from sim.table.solve.stops import lost_at_stops_um

LANE_TICKS = 256
"""Ticks of a lane: enough of them that a table forgets how it began, few enough that many run side by side."""
AGREED_UM = 0.01
"""Lanes agree where the places differ by no more than this, and the swings that velocities make, v / ω."""
UNDECIDED_UM = 0.5
"""Once passes bring lanes no nearer to each other, they agree within this and half the backlash.

Some tables never forget how they began: steps throw a slide about in its play, or friction holds it where it was
thrown. Then several motions fit the same steps. They differ by half a step, which is not worth a pass for each lane.
"""
STALLED = 0.98
"""A pass that leaves more than this share of its lanes wrong has brought nothing."""
PATIENCE = 6
"""Passes that may bring nothing."""


def run_slab(slab: Slab, state: State, table: RunTable) -> Lanes:
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
        # Lost steps and stops go on from lane to lane. So a lane runs only once the lane ahead of it is right.
        due = wrong & ~np.append(False, wrong[:-1])
        lanes.run(np.flatnonzero(due), begin)
        wrong = check.after(due, wrong & ~due, undecided_um)
    return lanes


def _borders(slab: Slab) -> Ints:
    """First ticks of the lanes, and the end of the last; a lane begins after a long tick where one is near."""
    number = max(1, len(slab) // LANE_TICKS)
    even = np.linspace(0, len(slab), number + 1).astype(np.int64)
    rest = np.append(np.flatnonzero(slab.from_rest[:-1]), len(slab))
    near = rest[np.minimum(np.searchsorted(rest, even), len(rest) - 1)]
    inner = np.where(near - even < LANE_TICKS // 4, near, even)[1:-1]
    return np.unique(np.concatenate([[0], inner, [len(slab)]]))


def _guessed(slab: Slab, borders: Ints, state: State, table: RunTable) -> State:
    """States that the lanes begin with if all goes slowly: each slide where its motor has drawn it.

    Where a motor drives it against a stop, it stands there, and the motor loses what it goes on.
    """
    begin = state.of(np.zeros(len(borders) - 1, dtype=np.int64))
    lost_um = lost_at_stops_um(slab, state.lost_um[0], table)
    drawn_um = _drawn(slab.place_um - lost_um, borders, state.at_um[0], table.slow.play_um)
    begin.at_um[1:] = np.clip(drawn_um, *table.room_um)
    begin.lost_um[1:] = lost_um[borders[1:-1]]
    stands = slab.from_rest[borders[1:-1], None] | (begin.at_um[1:] != drawn_um)
    begin.velocity[1:] = np.where(stands, 0.0, slab.speed_um_s[borders[1:-1]])
    return begin


def _drawn(motor_um: Floats, borders: Ints, at_um: Floats, play_um: Floats) -> Floats:
    """Places (k - 1, 2) of the slides at the borders between lanes, each drawn along within its play from `at_um`.

    `motor_um` (n + 1, 2) are the places of the motors, less what they lost.

    A slide stays within backlash and friction's hold of its motor, the play operator (M. Brokate, J. Sprekels,
    "Hysteresis and Phase Transitions", 1996, ch. 2): each tick clips its place, and clips in a row are one clip.
    """
    if not play_um.any():
        return motor_um[borders[1:-1]]
    low, high = np.full((len(borders) - 2, 2), -np.inf), np.full((len(borders) - 2, 2), np.inf)
    for number in range(int(np.diff(borders).max())):
        place = motor_um[np.minimum(borders[:-2] + number, borders[1:-1] - 1)]
        low, high = (np.clip(end, place - play_um, place + play_um) for end in (low, high))
    drawn = np.empty_like(low)
    for lane, (least, most) in enumerate(zip(low, high, strict=True)):
        drawn[lane] = at_um = np.clip(at_um, least, most)
    return drawn


class _Check:
    """The matching condition: compares the state in which each lane began with that in which the lane ahead ended.

    `begin` is the state that each lane is to begin with; the check corrects it after every pass. `from_rest` (k,)
    tells which lanes begin after a long tick: they begin at rest. `frequency` (2,) are the natural ones of the axes,
    1/s.
    """

    def __init__(self, lanes: Lanes, begin: State, from_rest: NDArray[np.bool_], frequency: Floats) -> None:
        self._lanes, self._begin, self._from_rest, self._frequency = lanes, begin, from_rest, frequency

    def after(
        self, run: NDArray[np.bool_], wrong: NDArray[np.bool_], tolerance_um: float | Floats
    ) -> NDArray[np.bool_]:
        """Which lanes (k,) began wrong, after a pass in which those of `run` ran and those of `wrong` did not."""
        wrong, told = wrong.copy(), np.append(False, run)
        for lane in range(1, len(wrong)):
            if told[lane]:
                told[lane + 1] |= self._tell(lane, wrong, tolerance_um)
        return wrong

    def _tell(self, lane: int, wrong: NDArray[np.bool_], tolerance_um: float | Floats) -> bool:
        """Correct the state that a lane begins with, and its `wrong`; True where the next lane has to be looked at."""
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
        """The state in which the lane ahead ends; a guess where that lane itself began wrong.

        An axis that did not move ends as far off as it began. Way that its motor lost shifts all that comes after. So
        one pass carries both through many lanes.
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
        """Whether the lane ran from another state than `ahead`, in which `lost` (1, 2) µm more were lost."""
        begun = self._lanes.begun
        off = np.abs(ahead.at_um + lost - begun.at_um[lane]) > tolerance_um
        off |= np.abs(ahead.velocity - begun.velocity[lane]) > tolerance_um * self._frequency
        off |= ahead.tripped != begun.tripped[lane]
        return bool(off.any()) or (bool(lost.any()) and self._lanes.near_stop(lane, lost[0]))
