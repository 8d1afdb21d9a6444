"""A program's own compensation: its stretches, from set-up to cancel, and what stops a controller in them.

What stops a controller that compensates, or should be known of how it does: by the row at which it happens.

What a program's own compensation makes of its blocks: stretches, from set-up to cancel, in runs of one offset.
"""

from enum import Enum
from typing import NamedTuple

import numpy as np

from controller.offset.shifted import NOTHING_UM, OffsetSection
from parser.controller_words import Compensation, CompensationRules
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.toolpath import Toolpath


class Stretch(NamedTuple):
    """Blocks from a set-up to its cancel (docs/iso.md §9).

    Attributes
    ----------
    setup
        Row of the toolpath with which compensation begins.
    past
        One past the last row under compensation.
    cancel
        Row that leads back to the contour, −1 where the program ends compensated.
    """

    setup: int
    past: int
    cancel: int


class Runs(NamedTuple):
    """k runs of blocks that have one offset, in order; a stretch has more than one where its offset changes.

    Attributes
    ----------
    first, past
        (k,) its first block, and one past its last.
    left_um
        (k,) how far the wire runs to the left of them.
    is_setup
        (k,) True where the first block is a set-up.
    is_wedge
        (k,) True where the first block begins at the offset of the run before it and ends at that of its own: a line
        whose offset changes, but not its side. Any other block is at its own offset from the start.
    is_handed_on
        (k,) True where the next run begins with a wedge.
    is_skipped
        (k,) True where the first block does not take part in the run: a set-up that ends on the normal of the next.
    cancel
        (k,) the block behind it that leads back to the contour, −1 for none.
    """

    first: Ints
    past: Ints
    left_um: Floats
    is_setup: Bools
    is_wedge: Bools
    is_handed_on: Bools
    is_skipped: Bools
    cancel: Ints

    @property
    def is_open(self) -> bool:
        """Whether the program ends compensated."""
        return len(self.cancel) > 0 and bool(self.cancel[-1] < 0)

    @property
    def sections(self) -> tuple[OffsetSection, ...]:
        """The blocks that are joined with each other in each run, a wedge in both of its runs."""
        first, last = self.first + self.is_skipped, self.past - 1 + self.is_handed_on
        return tuple(OffsetSection(a, b, closed=False) for a, b in zip(first.tolist(), last.tolist(), strict=True))


def idle_rows(toolpath: Toolpath, side: Ints) -> Bools:
    """(n,) True on blocks without length that the compensation passes over: those under a side, or before a cancel."""
    moves, is_on = toolpath.length_um > NOTHING_UM, side != 0
    last = np.maximum.accumulate(np.where(moves, np.arange(len(side)), -1))
    idle: Bools = ~moves & (is_on | ((last >= 0) & is_on[last]))
    return idle


def known_sides(compensation: Compensation) -> Ints:
    """(n,) the sides, but 0 all along a stretch in which the value of a register is not known."""
    is_on = compensation.side != 0
    number = np.cumsum(is_on & ~_before(is_on))
    is_unknown = np.zeros(len(number) + 1, dtype=np.bool_)
    is_unknown[number[is_on & np.isnan(compensation.by_um)]] = True
    return np.where(is_unknown[number], 0, compensation.side)


def runs_of(blocks: Curves, side: Ints, left_um: Floats, rules: CompensationRules) -> Runs:
    """The runs of n blocks with length; side (n,) and offset (n,) as in `Compensation`, all known."""
    is_on = side != 0
    was_on, was_left = _before(is_on), np.append(np.nan, left_um[:-1])
    is_first = is_on & ~(was_on & (left_um == was_left))
    first = np.flatnonzero(is_first)
    bounds = np.append(np.flatnonzero(is_first | (was_on & ~is_on)), len(side))
    past = bounds[np.searchsorted(bounds, first, side="right")]
    is_setup = ~was_on[first]
    is_wedge = ~is_setup & (was_left[first] * left_um[first] >= 0.0) & ~blocks.is_arc[first]
    is_handed_on = np.append(is_wedge[1:], False)[: len(first)]
    is_alone = (past - first == 1) & ~is_handed_on
    return Runs(
        first=first,
        past=past,
        left_um=left_um[first],
        is_setup=is_setup,
        is_wedge=is_wedge,
        is_handed_on=is_handed_on,
        is_skipped=is_setup & ~is_alone & (rules.startup == "next-normal"),
        cancel=np.where(np.append(~is_on, False)[past], past, -1),
    )


def stretches_of(runs: Runs, row: Ints) -> tuple[Stretch, ...]:
    """The stretches that runs of blocks make; `row` has the row of the toolpath of each block."""
    begin = np.flatnonzero(runs.is_setup)
    end = np.append(begin[1:], len(runs.first)) - 1 if len(begin) else begin
    cancel = runs.cancel[end]
    columns = row[runs.first[begin]], row[runs.past[end] - 1] + 1, np.where(cancel < 0, -1, row[cancel])
    return tuple(Stretch(*each) for each in zip(*(column.tolist() for column in columns), strict=True))


def _before(is_on: Bools) -> Bools:
    """(n,) the value of the block before each; False for the first."""
    return np.append(False, is_on[:-1])[: len(is_on)]


class AlarmKind(Enum):
    """What happens at a row (docs/iso.md §9).

    UNKNOWN: the value of a register is not known, and the stretch stays without offset. SETUP_ARC, CANCEL_ARC: an arc
    begins or ends compensation; the path has a line in its place. SETUP_SHORT: a set-up is not longer than its offset.
    TOO_SMALL: an inner arc of a radius not larger than the offset vanishes. VANISHED: another block that would run
    backwards vanishes. OFFSET_CHANGED, SIDE_CHANGED: what is in force changes while compensation is on. NO_CANCEL: the
    program ends compensated; the row is the last one.
    """

    UNKNOWN = "unknown"
    SETUP_ARC = "setup-arc"
    CANCEL_ARC = "cancel-arc"
    SETUP_SHORT = "setup-short"
    TOO_SMALL = "too-small"
    VANISHED = "vanished"
    OFFSET_CHANGED = "offset-changed"
    SIDE_CHANGED = "side-changed"
    NO_CANCEL = "no-cancel"


class Alarm(NamedTuple):
    """One of these, at a row of the toolpath, and whether the controller stops there under its rules."""

    kind: AlarmKind
    row: int
    stops: bool


def alarms_of(toolpath: Toolpath, compensation: Compensation, runs: Runs, row: Ints, gone: Ints) -> tuple[Alarm, ...]:
    """All of a toolpath, by row.

    `row` has the row of each block of the runs; `gone` (v,) are the rows with length that have vanished.
    """
    found = [
        *_unknown(compensation),
        *_setups(toolpath, compensation, row[runs.first[runs.is_setup]]),
        *_changes(runs, row, compensation.rules),
        *_ends(toolpath, runs, row),
        *_vanished(toolpath, compensation, gone),
    ]
    return tuple(sorted(found, key=lambda alarm: alarm.row))


def _unknown(compensation: Compensation) -> list[Alarm]:
    """At the first row of each that has a register without a value behind one with another register, or none."""
    is_open = (compensation.side != 0) & np.isnan(compensation.by_um)
    if not is_open.any():
        return []
    register = np.array(compensation.register, dtype=object)
    goes_on = is_open[1:] & is_open[:-1] & (register[1:] == register[:-1])
    first = np.flatnonzero(is_open & ~np.append(False, goes_on))
    return _alarms_of(AlarmKind.UNKNOWN, first, stops=False)


def _setups(toolpath: Toolpath, compensation: Compensation, setup: Ints) -> list[Alarm]:
    is_short = toolpath.length_um[setup] <= np.abs(compensation.by_um[setup]) + NOTHING_UM
    return [
        *_alarms_of(AlarmKind.SETUP_ARC, setup[toolpath.is_arc[setup]], stops=True),
        *_alarms_of(AlarmKind.SETUP_SHORT, setup[is_short], stops=compensation.rules.startup == "own-normal"),
    ]


def _changes(runs: Runs, row: Ints, rules: CompensationRules) -> list[Alarm]:
    at = np.flatnonzero(~runs.is_setup)
    before, behind = runs.left_um[at - 1], runs.left_um[at]
    stops, first = rules.change_on == "alarm", row[runs.first[at]]
    return [
        *_alarms_of(AlarmKind.SIDE_CHANGED, first[before * behind < 0.0], stops=stops),
        *_alarms_of(AlarmKind.OFFSET_CHANGED, first[np.abs(before) != np.abs(behind)], stops=stops),
    ]


def _ends(toolpath: Toolpath, runs: Runs, row: Ints) -> list[Alarm]:
    cancel = row[runs.cancel[runs.cancel >= 0]]
    open_end = row[runs.past[-1:] - 1] if runs.is_open else row[:0]
    return [
        *_alarms_of(AlarmKind.CANCEL_ARC, cancel[toolpath.is_arc[cancel]], stops=True),
        *_alarms_of(AlarmKind.NO_CANCEL, open_end, stops=False),
    ]


def _vanished(toolpath: Toolpath, compensation: Compensation, gone: Ints) -> list[Alarm]:
    stops = compensation.rules.too_small == "alarm"
    is_inner = toolpath.sweep_rad[gone] * compensation.left_um[gone] > 0.0
    is_small: Bools = is_inner & (toolpath.radius_um[gone] <= np.abs(compensation.by_um[gone]) + NOTHING_UM)
    return [
        *_alarms_of(AlarmKind.TOO_SMALL, gone[is_small], stops=stops),
        *_alarms_of(AlarmKind.VANISHED, gone[~is_small], stops=stops),
    ]


def _alarms_of(kind: AlarmKind, rows: Ints, *, stops: bool) -> list[Alarm]:
    return [Alarm(kind, row, stops) for row in rows.tolist()]
