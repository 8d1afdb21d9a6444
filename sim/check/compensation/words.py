"""What the words of compensation say: registers without a value, sides and offsets that change, where it begins, ends.

The controller's alarms tell most of it; no path is looked at.

Whether a program asks for compensation itself, and whether all is known that it takes.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from controller.offset.stretches import Alarm, AlarmKind
from parser.controller_words import Compensation
from parser.dialect.reader import at_block
from parser.findings.codes import Severity
from parser.findings.findings import Fact, Finding, Value
from parser.program import Program
from parser.text.source import Field
from parser.toolpath import Toolpath


@dataclass(frozen=True, slots=True)
class WithoutValue(Fact):
    """The block compensates by an offset that nobody tells: the program cannot run."""


def compensation_of(toolpath: Toolpath) -> Compensation | None:
    """What a program asks for by G41 and G42; None where it does not, or where nothing moves."""
    compensation = toolpath.compensation
    return compensation if compensation is not None and compensation.side.any() and toolpath.length_um.any() else None


def is_known(compensation: Compensation) -> bool:
    """Whether the offset of every block that has a side is known, so that the program can run."""
    return not np.isnan(compensation.by_um[compensation.side != 0]).any()


_ON_ARCS = {AlarmKind.SETUP_ARC: "set-up", AlarmKind.CANCEL_ARC: "cancel"}


def word_findings(
    program: Program, compensation: Compensation, alarms: Sequence[Alarm], wedges: Collection[int]
) -> Iterator[Finding]:
    """Findings ISO500 to ISO503, ISO508 to ISO510 and ISO513.

    A register, and a change that a program makes again and again, is told where it first occurs; `wedges` are rows of
    contours that begin at one offset and end at another, of which the first is told.
    """
    yield from _without_value(program, compensation, alarms)
    for alarm in alarms:
        if alarm.kind in _ON_ARCS:
            yield _at(program, compensation, "ISO502", alarm.row, Field.SIDE, what=_ON_ARCS[alarm.kind])
        elif alarm.kind is AlarmKind.SETUP_SHORT and compensation.by_um[alarm.row] != 0.0:
            length_um = float(program.toolpath.length_um[alarm.row])
            yield _graver(_at(program, compensation, "ISO503", alarm.row, Field.SIDE, length=length_um), alarm)
        elif alarm.kind is AlarmKind.NO_CANCEL:
            yield _at(program, compensation, "ISO510", alarm.row)
    sides, offsets = (
        [alarm for alarm in alarms if alarm.kind is kind] for kind in (AlarmKind.SIDE_CHANGED, AlarmKind.OFFSET_CHANGED)
    )
    if sides:
        before = _before(compensation, sides[0].row)
        found = _at(program, compensation, "ISO508", sides[0].row, Field.SIDE, **before, more=len(sides) - 1)
        yield _graver(found, sides[0])
    if offsets:
        first = next((alarm for alarm in offsets if alarm.row in wedges), offsets[0])
        before = _before(compensation, first.row)
        found = _at(program, compensation, "ISO509", first.row, Field.REGISTER, **before, more=len(offsets) - 1)
        yield _graver(found._replace(graver=Severity.WARNING if first.row in wedges else None), first)


def _without_value(program: Program, compensation: Compensation, alarms: Sequence[Alarm]) -> Iterator[Finding]:
    """Registers without a value (ISO500), no register at all (ISO501), and registers that hold nothing (ISO513)."""
    unknown = {
        compensation.register[alarm.row]: alarm.row for alarm in reversed(alarms) if alarm.kind is AlarmKind.UNKNOWN
    }
    for register, row in unknown.items():
        if register:
            found = _at(
                program,
                compensation,
                "ISO500",
                row,
                Field.REGISTER,
                lacking=compensation.lacking.get(register, register),
            )
        else:
            found = _at(program, compensation, "ISO501", row, Field.SIDE)
        yield found.with_fact(WithoutValue())
    nothing = np.flatnonzero((compensation.side != 0) & (compensation.by_um == 0.0)).tolist()
    for row in {compensation.register[row]: row for row in reversed(nothing)}.values():
        yield _at(program, compensation, "ISO513", row, Field.REGISTER)


def _before(compensation: Compensation, row: int) -> dict[str, Value]:
    """Side and offset that were in force before a row at which one of them changes."""
    return {"before": _side(compensation, row - 1), "was": abs(float(compensation.by_um[row - 1]))}


def _graver(finding: Finding, alarm: Alarm) -> Finding:
    """The finding, an error where the controller stops."""
    return finding._replace(graver=Severity.ERROR) if alarm.stops else finding


def _at(
    program: Program, compensation: Compensation, code: str, row: int, field: Field | None = None, **values: Value
) -> Finding:
    """Finding at a row, with the side, the register and the offset that are in force there."""
    in_force: dict[str, Value] = {"side": _side(compensation, row), "register": compensation.register[row]}
    if not np.isnan(compensation.by_um[row]):
        in_force["offset"] = abs(float(compensation.by_um[row]))
    return at_block(program.toolpath, program.lines, code, row, field, **in_force, **values)


def _side(compensation: Compensation, row: int) -> str:
    """The word of the side in force at a row; a block that cancels has that of the one before it."""
    return "G41" if compensation.side[row] > 0 else "G42"
