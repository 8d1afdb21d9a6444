"""What stops a controller that compensates, or should be known of how it does: by the row at which it happens."""

from enum import Enum
from typing import NamedTuple

import numpy as np

from controller.offset.shifted import NOTHING_UM
from controller.offset.stretches import Runs
from parser.controller_words import Compensation, CompensationRules
from parser.geometry.curves import Bools, Ints
from parser.toolpath import Toolpath


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
