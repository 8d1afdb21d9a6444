"""The check of a program's own compensation: its words, the path that comes of it, and that path beside the contour.

What the words of compensation say: registers without a value, sides and offsets that change, where it begins, ends.

The controller's alarms tell most of it; no path is looked at.

Whether a program asks for compensation itself, and whether all is known that it takes.

The passes that a program writes out itself, each between its own set-up and cancel.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from controller.offset.chain import OffsetPath, offset_toolpath
from controller.offset.passes import PassedPath, PassedRound
from controller.offset.programmed import compensated
from controller.offset.shifted import Side
from controller.offset.stretches import Alarm, AlarmKind
from parser.controller_words import Compensation
from parser.dialect.reader import at_block
from parser.findings.codes import Severity
from parser.findings.findings import Fact, Finding, Value, file_order
from parser.geometry.curves import Bools, Floats, Ints
from parser.program import Program
from parser.shape.passes import Pass, Passes, with_edges
from parser.text.source import Field
from parser.toolpath import Toolpath
from sim.check.compensation.contours import CompensatedStretch, compensated_stretches, contour_findings
from sim.check.compensation.rounds import CompensatedRound, compensated_rounds, moved_um
from sim.check.offset import Offsetting, PassBeside


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


def drawn_passes(runs: Sequence[CompensatedRound], rows: int) -> Passes:
    """Passes in the `rows` of the program's own toolpath, which all of them run along the same places."""
    bounds = np.array([compensated_round.round.section[:2] for compensated_round in runs], dtype=np.int64).reshape(
        -1, 2
    )
    return _passes([compensated_round._replace(by_um=0.0) for compensated_round in runs], bounds, rows)


def path_passes(runs: Sequence[CompensatedRound], path: OffsetPath) -> Passes:
    """Passes in the rows of the compensated path."""
    bounds = np.array(
        [
            (compensated_round.round.section.first, compensated_round.round.section.last + 1)
            for compensated_round in runs
        ],
        dtype=np.int64,
    )
    first, past = np.searchsorted(path.source_row, bounds.reshape(-1, 2)).T
    return _passes(runs, np.stack([first, past - 1], axis=1), len(path.source_row))


def passes_beside(runs: Sequence[CompensatedRound], left_um: Floats) -> tuple[PassBeside, ...]:
    """The passes of each number: the least offset, and the direction of the first of them.

    Where no contour is run along, one pass at the least of the offsets `left_um` (n,) of the blocks.
    """
    found: dict[int, PassBeside] = {}
    for compensated_round in runs:
        number = compensated_round.along.number
        known = found.setdefault(number, PassBeside(compensated_round.by_um, compensated_round.along.is_back))
        found[number] = known._replace(by_um=min(known.by_um, compensated_round.by_um))
    if not found:
        by_um = np.abs(left_um[left_um != 0.0])
        return (PassBeside(float(by_um.min()) if len(by_um) else 0.0, is_back=False),)
    return tuple(found[number] for number in sorted(found))


def _passes(runs: Sequence[CompensatedRound], bounds: Ints, rows: int) -> Passes:
    """Passes in the rows between `bounds` (k, 2), both included; a pass without a row is none."""
    waste: dict[int, float] = {}
    last: dict[tuple[int, bool], float] = {}
    for compensated_round in runs:
        waste.setdefault(compensated_round.along.edge, float(np.sign(_aside_um(compensated_round))))
        last[compensated_round.along.edge, compensated_round.along.is_tab] = _aside_um(compensated_round)
    of_row = np.full(rows, -1, dtype=np.int64)
    passes: list[Pass] = []
    for compensated_round, (low, high) in zip(runs, bounds.tolist(), strict=True):
        edge, number, is_back, is_tab = compensated_round.along
        if low <= high:
            of_row[low : high + 1] = len(passes)
            shift_um = (_aside_um(compensated_round) - last[edge, is_tab]) * waste[edge]
            closed = compensated_round.round.section.closed
            passes.append(
                Pass(
                    edge,
                    number,
                    low,
                    high,
                    is_back,
                    closed,
                    is_tab,
                    shift_um,
                    -compensated_round.side,
                    compensated_round.by_um,
                )
            )
    return Passes(with_edges(passes), of_row)


def _aside_um(compensated_round: CompensatedRound) -> float:
    """How far to the left of the first pass over its edge the wire runs, along that."""
    return compensated_round.by_um * compensated_round.side * (-1 if compensated_round.along.is_back else 1)


class OwnCompensation(NamedTuple):
    """What a program's own compensation makes of it, and the passes of its own toolpath, as drawn."""

    made: Offsetting
    drawn_passes: Passes


def own_compensation(program: Program, compensation: Compensation, is_judged: Bools) -> OwnCompensation:
    """What the compensation of a program, as `compensation`, makes of it.

    Stretches whose offset is not known run on the contour. `is_judged` (n,) is False on blocks of contours that are not
    whole: no findings come of their shape.
    """
    drawn = program.toolpath
    made = compensated(drawn)
    stretches = compensated_stretches(drawn, made.path, compensated_rounds(drawn, moved_um(compensation)))
    runs = [stretch.run for stretch in stretches]
    judged = [stretch for stretch in stretches if is_judged[slice(*stretch.run.round[:2])].all()]
    found = [
        *word_findings(program, compensation, made.alarms, [run.wedge for run in runs]),
        *contour_findings(program, made.path, judged, made.alarms),
    ]
    passes = drawn_passes(runs, len(drawn))
    passed = _as_written(drawn, runs, passes)
    offset = Offsetting(
        passed=passed,
        program=replace(program, toolpath=offset_toolpath(passed, made.path)),
        path=made.path,
        side=Side(int(compensation.side[np.flatnonzero(compensation.side)[0]])),
        passes=passes_beside(runs, moved_um(compensation)),
        edge_passes=path_passes(runs, made.path),
        left_um=_left_um(made.path, stretches),
        gouges=tuple(gouge for stretch in stretches for gouge in stretch.offset_round.gouges),
        loops=tuple(stretch.offset_round.loops for stretch in stretches if stretch.offset_round.loops is not None),
        findings=tuple(sorted(found, key=file_order)),
    )
    return OwnCompensation(offset, passes)


def _as_written(drawn: Toolpath, runs: Sequence[CompensatedRound], passes: Passes) -> PassedPath:
    """The toolpath as passes that the program writes out itself."""
    number = np.array([*(pass_.number - 1 for pass_ in passes.passes), -1], dtype=np.int64)[passes.of_row]
    rounds = tuple(
        PassedRound(compensated_round.round, compensated_round.along.number - 1) for compensated_round in runs
    )
    forward = np.zeros(len(drawn), dtype=np.bool_)
    return PassedPath(drawn, drawn.picked(slice(None)), np.arange(len(drawn)), number, forward, rounds, drawn.stops)


def _left_um(path: OffsetPath, stretches: Sequence[CompensatedStretch]) -> Floats:
    """(v,) what stays at each row that vanished; 0 at those that lead to a contour or away from it."""
    left_um = np.zeros(len(path.vanished))
    for compensated_stretch in stretches:
        section = compensated_stretch.run.round.section
        left_um[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))] = (
            compensated_stretch.offset_round.left_um
        )
    return left_um
