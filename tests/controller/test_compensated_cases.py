"""Compensation told by programs, case by case, with worked figures (docs/iso.md §9): textbook and LinuxCNC.

The figures of LinuxCNC are what its interpreter prints, to 4 decimals.
"""

import math
from typing import NamedTuple

import pytest
from compensating import LINUXCNC, TEXTBOOK, To, drawn_mm, moves_mm, told
from paths import Pen

from controller.offset.chain import RowOrigin
from controller.offset.programmed import Compensated, compensated
from controller.offset.stretches import AlarmKind
from parser.controller_words import CompensationRules

LEFT, RIGHT = 1, -1
ROUNDED_MM = 6e-5  # of figures with 4 decimals


class Case(NamedTuple):
    """Moves of a program in mm, compensated from the first on: where the textbook and LinuxCNC go.

    A controller that stops has the kind of alarm and its row instead.
    """

    start: tuple[float, float]
    moves: list[To]
    side: int
    textbook: list[To] | tuple[AlarmKind, int]
    linuxcnc: list[To] | tuple[AlarmKind, int]


def along_x(*moves: To) -> tuple[tuple[float, float], list[To]]:
    """Moves from (0, 0) behind a set-up along X, so that both ways of setting up agree."""
    return (-5.0, 0.0), [To(0, 0), *moves]


STEP_UP = To(0, 1)
# Arcs cannot be prolonged to where they meet, so that the textbook goes round these corners as well.
AROUND_ENDS = [
    To(0, -1),
    To(10, -1),
    To(11, 0, 10, 0, 1),
    To(19, 0, 15, 0, -1),
    To(20, -1, 20, 0, 1),
    To(30, -1),
]
CORNERS = {
    "outer 90": Case(
        *along_x(To(10, 0), To(10, -10)),
        LEFT,
        [STEP_UP, To(11, 1), To(11, -10)],
        [STEP_UP, To(10, 1), To(11, 0, 10, 0, -1), To(11, -10)],
    ),
    "inner 90": Case(
        *along_x(To(10, 0), To(10, 10)), LEFT, [STEP_UP, To(9, 1), To(9, 10)], [STEP_UP, To(9, 1), To(9, 10)]
    ),
    "outer 45": Case(
        *along_x(To(10, 0), To(20, -10)),
        LEFT,
        [STEP_UP, To(10.414214, 1), To(20.707107, -9.292893)],
        [STEP_UP, To(10, 1), To(10.7071, 0.7071, 10, 0, -1), To(20.7071, -9.2929)],
    ),
    "outer acute": Case(
        *along_x(To(10, 0), To(0, -10)),
        LEFT,
        [STEP_UP, To(11, 1), To(11.414214, 0), To(0.707107, -10.707107)],
        [STEP_UP, To(10, 1), To(10.7071, -0.7071, 10, 0, -1), To(0.7071, -10.7071)],
    ),
    "inner acute": Case(
        *along_x(To(10, 0), To(0, 10)),
        LEFT,
        [STEP_UP, To(7.585786, 1), To(-0.707107, 9.292893)],
        [STEP_UP, To(7.5858, 1), To(-0.7071, 9.2929)],
    ),
    "straight back": Case(
        *along_x(To(10, 0), To(-10, 0)),
        LEFT,
        [STEP_UP, To(11, 1), To(11, -1), To(-10, -1)],
        [STEP_UP, To(10, 1), To(10, -1, 10, 0, -1), To(-10, -1)],
    ),
    "into arcs, inner": Case(
        *along_x(To(10, 0), To(20, 0, 15, 0, -1), To(30, 0)),
        LEFT,
        [STEP_UP, To(9.083920, 1), To(20.916080, 1, 15, 0, -1), To(30, 1)],
        [STEP_UP, To(9.0839, 1), To(20.9161, 1, 15, 0, -1), To(30, 1)],
    ),
    "into arcs, outer": Case(
        *along_x(To(10, 0), To(20, 0, 15, 0, -1), To(30, 0)),
        RIGHT,
        AROUND_ENDS,
        AROUND_ENDS,
    ),
    "outside of a small arc": Case(
        *along_x(To(10, 0), To(10.5, 0.5, 10, 0.5, 1), To(10.5, 10)),
        RIGHT,
        [To(0, -1), To(10, -1), To(11.5, 0.5, 10, 0.5, 1), To(11.5, 10)],
        [To(0, -1), To(10, -1), To(11.5, 0.5, 10, 0.5, 1), To(11.5, 10)],
    ),
    "inside of a small arc": Case(
        *along_x(To(10, 0), To(10.5, 0.5, 10, 0.5, 1), To(10.5, 10)),
        LEFT,
        [STEP_UP, To(9.5, 1), To(9.5, 10)],
        (AlarmKind.TOO_SMALL, 2),
    ),
    "inside of an arc of the offset's radius": Case(
        *along_x(To(10, 0), To(11, 1, 10, 1, 1), To(11, 10)),
        LEFT,
        [STEP_UP, To(10, 1), To(10, 10)],
        (AlarmKind.TOO_SMALL, 2),
    ),
    "two half circles": Case(
        (0.0, 5.0),
        [To(0, 0), To(10, 0, 5, 0, 1), To(20, 0, 15, 0, 1)],
        LEFT,
        [To(1, 0), To(9, 0, 5, 0, 1), To(9, 1), To(11, 1), To(11, 0), To(19, 0, 15, 0, 1)],
        [To(1, 0), To(9, 0, 5, 0, 1), To(11, 0, 10, 0, -1), To(19, 0, 15, 0, 1)],
    ),
    "a step smaller than the offset": Case(
        *along_x(To(10, 0), To(10, 0.5), To(20, 0.5)),
        LEFT,
        [STEP_UP, To(9, 1), To(9, 1.5), To(20, 1.5)],
        (AlarmKind.VANISHED, 2),
    ),
    "a groove narrower than the kerf": Case(
        *along_x(To(10, 0), To(10, 1.5), To(0, 1.5)), LEFT, (AlarmKind.VANISHED, 2), (AlarmKind.VANISHED, 2)
    ),
    "a short inner chamfer": Case(
        *along_x(To(10, 0), To(10.4, 0.4), To(10.4, 10)),
        LEFT,
        [STEP_UP, To(9.4, 1), To(9.4, 10)],
        (AlarmKind.VANISHED, 2),
    ),
    "a block without length": Case(
        *along_x(To(10, 0), To(10, 0), To(10, -10)),
        LEFT,
        [STEP_UP, To(11, 1), To(11, -10)],
        [STEP_UP, To(10, 1), To(11, 0, 10, 0, -1), To(11, -10)],
    ),
    "an h": Case(
        (0.0, -5.0),
        [To(0, 0), To(0, 10), To(-10, 10, -5, 10, 1), To(-10, 0)],
        RIGHT,
        [To(1, 0), To(1, 10), To(-11, 10, -5, 10, 1), To(-11, 0)],
        [To(1, 0), To(1, 10), To(-11, 10, -5, 10, 1), To(-11, 0)],
    ),
}
ROUND_HOLE = [To(5, 0), To(5, 0, 0, 0, 1)]
SETUPS = {
    "into an outer corner": Case(
        (0, -5), [To(0, 0), To(10, 0)], LEFT, [To(0, 1), To(10, 1)], [To(-1, 0), To(0, 1, 0, 0, -1), To(10, 1)]
    ),
    "into an inner corner": Case(
        (0, -5), [To(0, 0), To(10, 0)], RIGHT, [To(0, -1), To(10, -1)], [To(1, -1), To(10, -1)]
    ),
    "shorter than the offset": Case(
        (0, -0.9), [To(0, 0), To(10, 0)], LEFT, [To(0, 1), To(10, 1)], (AlarmKind.SETUP_SHORT, 0)
    ),
    "as long as the offset": Case(
        (0, -1), [To(0, 0), To(10, 0)], LEFT, [To(0, 1), To(10, 1)], (AlarmKind.SETUP_SHORT, 0)
    ),
    "a hole from its centre": Case(
        (0, 0), ROUND_HOLE, LEFT, [To(4, 0), To(4, 0, 0, 0, 1)], [To(3.8730, 1), To(4, 0, 0, 0, 1)]
    ),
    "a disc from outside": Case(
        (10, 0), ROUND_HOLE, RIGHT, [To(6, 0), To(6, 0, 0, 0, 1)], [To(5.9161, 1), To(6, 0, 0, 0, 1)]
    ),
    "an arc": Case((-5, 0), [To(0, 5, -5, 5, 1), To(0, 10)], LEFT, (AlarmKind.SETUP_ARC, 0), (AlarmKind.SETUP_ARC, 0)),
}
BOTH = [
    pytest.param(case, rules, id=f"{name}, {of}")
    for name, case in (CORNERS | SETUPS).items()
    for of, rules in (("textbook", TEXTBOOK), ("LinuxCNC", LINUXCNC))
]


def assert_goes(made: Compensated, wanted: list[To]) -> None:
    moves = moves_mm(made.path.curves)
    assert [move.turn for move in moves] == [move.turn for move in wanted]
    for move, place in zip(moves, wanted, strict=True):
        assert move == pytest.approx(place, abs=ROUNDED_MM, nan_ok=True)


@pytest.mark.parametrize(("case", "rules"), BOTH)
def test_worked_cases(case: Case, rules: CompensationRules) -> None:
    wanted = case.textbook if rules == TEXTBOOK else case.linuxcnc
    made = compensated(told(drawn_mm(case.start, case.moves).path(), case.side, 1000.0, rules))
    if isinstance(wanted, list):
        assert_goes(made, wanted)
        assert not any(alarm.stops for alarm in made.alarms)
    else:
        first = made.alarms[0]
        assert (first.kind, first.row) == wanted
        assert first.stops == (rules == LINUXCNC or first.kind == AlarmKind.SETUP_ARC)


@pytest.mark.parametrize(("case", "rules"), BOTH)
def test_a_negative_offset_swaps_the_side(case: Case, rules: CompensationRules) -> None:
    path = drawn_mm(case.start, case.moves).path()
    one = compensated(told(path, case.side, 1000.0, rules))
    other = compensated(told(path, -case.side, -1000.0, rules))
    assert repr(moves_mm(one.path.curves)) == repr(moves_mm(other.path.curves))
    assert one.alarms == other.alarms


def test_a_hole_from_its_centre_stays_open_with_the_set_up_on_its_own_normal() -> None:
    path = told(drawn_mm((0, 0), [*ROUND_HOLE, To(0, 0)]).path(), [1, 1, 0], 1000.0, LINUXCNC)
    assert_goes(compensated(path), [To(3.8730, 1), To(4, 0, 0, 0, 1), To(0, 0)])
    sweep = compensated(path).path.curves.sweep_rad[1]
    assert 360.0 - math.degrees(sweep) == pytest.approx(14.48, abs=0.005)


def test_the_same_at_an_offset_of_a_tenth() -> None:
    path = drawn_mm((0, 0), [*ROUND_HOLE, To(0, 0)]).path()
    made = compensated(told(path, [1, 1, 0], 100.0, LINUXCNC))
    assert_goes(made, [To(4.898979, 0.1), To(4.9, 0, 0, 0, 1), To(0, 0)])
    assert 360.0 - math.degrees(made.path.curves.sweep_rad[1]) == pytest.approx(1.169, abs=0.0005)
    made = compensated(told(path, [1, 1, 0], 100.0))
    assert_goes(made, [To(4.9, 0), To(4.9, 0, 0, 0, 1), To(0, 0)])
    assert made.path.curves.sweep_rad[1] == 2.0 * math.pi


@pytest.mark.parametrize("rules", [TEXTBOOK, LINUXCNC])
def test_a_cancel_goes_straight_to_its_end(rules: CompensationRules) -> None:
    path = drawn_mm((-5, 0), [To(0, 0), To(10, 0), To(10, -5)]).path()
    made = compensated(told(path, [1, 1, 0], 1000.0, rules))
    assert_goes(made, [To(0, 1), To(10, 1), To(10, -5)])
    assert made.path.made.tolist() == [RowOrigin.LEAD, RowOrigin.SHIFTED, RowOrigin.LEAD]
    assert made.alarms == ()


@pytest.mark.parametrize("rules", [TEXTBOOK, LINUXCNC])
def test_an_arc_cannot_cancel(rules: CompensationRules) -> None:
    path = drawn_mm((-5, 0), [To(0, 0), To(10, 0), To(15, -5, 10, -5, -1)]).path()
    made = compensated(told(path, [1, 1, 0], 1000.0, rules))
    assert [tuple(alarm) for alarm in made.alarms] == [(AlarmKind.CANCEL_ARC, 2, True)]
    assert_goes(made, [To(0, 1), To(10, 1), To(15, -5)])


@pytest.mark.parametrize("rules", [TEXTBOOK, LINUXCNC])
def test_a_program_that_ends_compensated_stays_at_the_offset(rules: CompensationRules) -> None:
    made = compensated(told(drawn_mm((-5, 0), [To(0, 0), To(10, 0)]).path(), 1, 1000.0, rules))
    assert_goes(made, [To(0, 1), To(10, 1)])
    assert [tuple(alarm) for alarm in made.alarms] == [(AlarmKind.NO_CANCEL, 1, False)]


@pytest.mark.parametrize(
    ("by_um", "side", "end_mm"),
    [
        (100.0, LEFT, (199.9108421, 300.0452865)),
        (100.0, RIGHT, (200.0891579, 299.9547135)),
        (10_000.0, LEFT, (191.0842113, 304.5286546)),
        (10_000.0, RIGHT, (208.9157887, 295.4713454)),
    ],
)
def test_the_line_of_the_course(by_um: float, side: int, end_mm: tuple[float, float]) -> None:
    """From P0 (72, 48) to Pe (200, 300): the slide's figure of both centre paths, P′ and P″."""
    before = Pen(72_000.0 - 128_000.0, 48_000.0 - 252_000.0).to(72_000.0, 48_000.0)
    path = told(before.to(200_000.0, 300_000.0).path(), side, by_um)
    assert path.length_um[1] == pytest.approx(282_644.6532, abs=1e-4)
    made = compensated(path).path.curves
    assert 0.001 * made.end_um[1] == pytest.approx(end_mm, abs=1e-7)
    assert made.length_um[1] == pytest.approx(path.length_um[1], abs=1e-6)
