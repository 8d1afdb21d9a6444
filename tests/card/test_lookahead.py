"""Look-ahead of the library: end speeds in closed form and against a plain pass; the mode that fills the list."""

import itertools
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller import GECard
from controller.card.core.call import Code
from controller.card.core.settings import CardSettings
from controller.card.lookahead import TLookAheadMsg, TLookData


def opened(**settings: Any) -> GECard:
    card = GECard(CardSettings(**settings))
    assert card.GT_Open() == 0
    return card


def begun(time_ms: float = 2.0, amax: float = 0.5, am: float = 0.1, vmax: float = 50.0, n: int = 100) -> GECard:
    card = opened()
    assert card.GT_InitLookAhead(time_ms, amax, am, vmax, n, 1.0) == 0
    return card


def add_line(card: GECard, x: float, y: float, number: int, *, feed: float = 10.0, flag: int = 0) -> int:
    return int(card.GT_AddLookData(1, 17, 0.0, x, y, 0.0, feed, 0.0, 0.0, 0, number, flag))


def ends(card: GECard) -> list[tuple[int, float]]:
    told = []
    while (answer := card.GT_CalVel())[0] == 0:
        told.append((answer[2], answer[1]))
    assert answer == (Code.COMMAND, 0.0, 0)
    return told


def test_a_corner_is_passed_at_the_speed_that_turns_in_its_time() -> None:
    card = begun(time_ms=2.0, amax=0.5)
    add_line(card, 1e6, 0.0, 7)
    add_line(card, 1e6, 1e6, 8)
    # |Δv| = 2 v sin(90°/2) = amax T = 1 pulse/ms
    assert ends(card) == [(7, pytest.approx(1.0 / math.sqrt(2.0), rel=1e-12)), (8, 0.0)]


def test_straight_on_only_feed_and_what_is_left_to_brake_limit() -> None:
    card = begun(am=0.1)
    for number, x in enumerate((1e4, 1e4 + 80.0, 1e4 + 100.0)):
        add_line(card, x, 0.0, number)
    # v² = 2 a s before the end: 100 and 20 pulses before it
    assert ends(card) == [
        (0, pytest.approx(math.sqrt(2.0 * 0.1 * 100.0), rel=1e-12)),
        (1, pytest.approx(math.sqrt(2.0 * 0.1 * 20.0), rel=1e-12)),
        (2, 0.0),
    ]


def test_a_flag_is_a_rest_and_going_back_is_one_nearly() -> None:
    card = begun(time_ms=2.0, amax=0.5)
    add_line(card, 1e5, 0.0, 1, flag=1)
    add_line(card, 2e5, 0.0, 2)
    add_line(card, 0.0, 0.0, 3)
    assert ends(card) == [(1, 0.0), (2, pytest.approx(0.5, rel=1e-12)), (3, 0.0)]


def test_an_arc_is_bent_with_the_acceleration_of_corners_and_joins_smoothly() -> None:
    card = begun(amax=0.5)
    add_line(card, 1000.0, 0.0, 1, feed=40.0)
    # A half turn to the left, then straight back: no corner anywhere.
    card.GT_AddLookData(3, 17, 50.0, 1000.0, 100.0, 0.0, 40.0, 0.0, 0.0, 0, 2, 0)
    add_line(card, -1e5, 100.0, 3, feed=40.0)
    first = card.GT_CalVelEx()
    second = card.GT_CalVelEx()
    bend = math.sqrt(0.5 * 50.0)
    assert first == (0, pytest.approx(bend, rel=1e-9), 1, 40.0)
    assert second == (0, pytest.approx(bend, rel=1e-6), 2, pytest.approx(bend, rel=1e-12))


@pytest.mark.parametrize("code", [2, 3])
def test_an_arc_by_centre_is_that_by_radius(code: int) -> None:
    told = []
    for r, cx, cy in ((50.0, 0.0, 0.0), (0.0, 0.0, 50.0 if code == 3 else -50.0)):
        card = begun()
        end = (50.0, 50.0 if code == 3 else -50.0)
        assert card.GT_AddLookData(code, 17, r, *end, 0.0, 10.0, cx, cy, 0, 1, 0) == 0
        add_line(card, end[0], end[1] * 10.0, 2)
        told.append(ends(card))
    assert told[0] == [(number, pytest.approx(speed, rel=1e-9)) for number, speed in told[1]]


def test_what_is_told_holds_when_more_comes() -> None:
    card = begun(am=0.1)
    add_line(card, 100.0, 0.0, 1)
    add_line(card, 120.0, 0.0, 2)
    assert card.GT_CalVel() == (0, pytest.approx(2.0, rel=1e-12), 1)
    add_line(card, 1e5, 0.0, 3)
    # from 2 pulse/ms, 20 pulses at 0.1 pulse/ms²
    assert card.GT_CalVel() == (0, pytest.approx(math.sqrt(4.0 + 4.0), rel=1e-12), 2)


def test_no_more_blocks_are_kept_than_asked() -> None:
    card = begun(n=2)
    assert [add_line(card, 10.0 * k, 0.0, k) for k in (1, 2, 3)] == [0, 0, 1]
    assert card.GT_CalVel()[2] == 1
    assert add_line(card, 30.0, 0.0, 3) == 0
    assert [number for number, _ in ends(card)] == [2, 3]


def test_units_are_pulses() -> None:
    speeds = []
    for con in (1.0, 10.0):
        card = opened()
        card.GT_InitLookAhead(1.0, 0.5, 0.1, 50.0, 10, con)
        add_line(card, 1000.0 / con, 0.0, 1)
        add_line(card, 1000.0 / con, 40.0 / con, 2)
        speeds.append(ends(card))
    assert speeds[0] == [(number, pytest.approx(speed, rel=1e-12)) for number, speed in speeds[1]]


POINTS = st.lists(
    st.tuples(st.integers(-500, 500), st.integers(-500, 500), st.floats(0.1, 40.0)), min_size=1, max_size=12
)


def plain_ends(points: list[tuple[int, int, float]], time_ms: float, amax: float, am: float) -> list[float]:
    """End speeds by a pass back and a pass forward, block by block."""
    places = [(0.0, 0.0), *((x, y) for x, y, _ in points)]
    moves = [(b[0] - a[0], b[1] - a[1]) for a, b in itertools.pairwise(places)]
    lengths = [math.hypot(*move) for move in moves]
    caps = []
    for k in range(len(moves) - 1):
        cross = moves[k][0] * moves[k + 1][1] - moves[k][1] * moves[k + 1][0]
        dot = moves[k][0] * moves[k + 1][0] + moves[k][1] * moves[k + 1][1]
        turn = abs(math.atan2(cross, dot))
        corner = amax * time_ms / (2.0 * math.sin(turn / 2.0)) if turn else math.inf
        caps.append(min(corner, points[k][2], points[k + 1][2]))
    caps.append(0.0)
    for k in range(len(caps) - 2, -1, -1):
        caps[k] = min(caps[k], math.sqrt(caps[k + 1] ** 2 + 2.0 * am * lengths[k + 1]))
    before = 0.0
    for k, length in enumerate(lengths):
        before = caps[k] = min(caps[k], math.sqrt(before**2 + 2.0 * am * length))
    return caps


@given(POINTS, st.floats(0.0, 5.0), st.floats(0.01, 2.0), st.floats(0.001, 1.0))
def test_speeds_are_those_of_a_plain_pass(
    points: list[tuple[int, int, float]],
    time_ms: float,
    amax: float,
    am: float,
) -> None:
    card = begun(time_ms, amax, am, vmax=50.0)
    taken = [
        point
        for point in enumerate(points)
        if add_line(card, point[1][0], point[1][1], point[0], feed=point[1][2]) == 0
    ]
    told = ends(card)
    assert [number for number, _ in told] == [number for number, _ in taken]
    expected = plain_ends([point for _, point in taken], time_ms, amax, am) if taken else []
    assert [speed for _, speed in told] == pytest.approx(expected, rel=1e-9, abs=1e-6)


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ((4, 17, 0.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0), Code.PARAMETER),
        ((1, 16, 0.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0), Code.PARAMETER),
        ((1, 17, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, 1, 0), Code.SPEED),
        ((1, 17, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0), Code.LENGTH),
        ((1, 17, 0.0, 1e12, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0), Code.LENGTH),
        ((2, 17, 4.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0), Code.CHORD),
        ((2, 17, 4.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0), Code.RADIUS),
        ((2, 17, 0.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0), Code.RADIUS),
        ((2, 17, 0.0, 10.0, 0.0, 0.0, 1.0, 10.0, 0.0, 0, 1, 0), Code.RADIUS),
    ],
)
def test_a_block_that_is_none_is_refused_and_not_kept(arguments: tuple[Any, ...], code: Code) -> None:
    card = begun()
    assert card.GT_AddLookData(*arguments) == code
    assert card.GT_AddLookDataEx(TLookData(*arguments)) == code
    assert card.GT_CalVel() == (Code.COMMAND, 0.0, 0)


def test_a_structure_is_as_its_parameters() -> None:
    card = begun()
    assert card.GT_AddLookDataEx(TLookData(1, 17, 0.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 5, 0)) == 0
    assert card.GT_CalVel() == (0, 0.0, 5)
    assert card.GT_AddLookDataEx((1, 17)) == Code.PARAMETER


@pytest.mark.parametrize(
    ("rules", "code"),
    [
        ((1.0, 0.0, 1.0, 1.0, 1, 1.0), Code.SPEED),
        ((1.0, 1.0, -1.0, 1.0, 1, 1.0), Code.SPEED),
        ((1.0, 1.0, 1.0, 0.0, 1, 1.0), Code.SPEED),
        ((-1.0, 1.0, 1.0, 1.0, 1, 1.0), Code.PARAMETER),
        ((1.0, 1.0, 1.0, 1.0, 0, 1.0), Code.PARAMETER),
        ((1.0, 1.0, 1.0, 1.0, 1, 0.0), Code.PARAMETER),
    ],
)
def test_rules_that_are_none_are_refused(rules: tuple[Any, ...], code: Code) -> None:
    card = opened()
    assert card.GT_InitLookAhead(*rules) == code
    assert add_line(card, 1.0, 0.0, 1) == Code.COMMAND


def test_a_reset_forgets_the_look_ahead() -> None:
    card = begun()
    add_line(card, 10.0, 0.0, 1)
    card.GT_Reset()
    assert card.GT_CalVel() == (Code.COMMAND, 0.0, 0)


def in_mode(n: int = 3, **settings: Any) -> GECard:
    card = opened(**settings)
    assert card.GT_SwitchLookaheadMode(1) == 0
    assert card.GT_InitLookAheadEx(2.0, 0.5, 0.1, n, 1.0) == 0
    assert card.GT_StrtList() == 0
    assert card.GT_MvXYEx(0.0, 0.0, 5.0) == 0
    return card


def test_blocks_go_to_the_list_when_more_come_than_are_kept() -> None:
    card = in_mode(n=3)
    messages = [card.GT_LnXYEx(100.0 * k, 0.0, 10.0, 0, 40 + k) for k in range(1, 6)]
    assert (
        messages
        == [
            (0, TLookAheadMsg()),
        ]
        * 5
    )
    card.GT_StrtMtn()
    card.sleep(60_000.0)
    assert card.places == [[200, 0, 0, 0]], "three are kept"
    assert card.GT_M30() == (0, TLookAheadMsg())
    card.sleep(60_000.0)
    assert card.places == [[500, 0, 0, 0]]
    assert card.GT_M30() == (0, TLookAheadMsg())


def test_a_message_tells_of_the_block_at_fault_and_how_many_before_it_are_kept() -> None:
    card = in_mode(n=3)
    for k in (1, 2):
        card.GT_LnXYEx(100.0 * k, 0.0, 10.0, 0, 40 + k)
    assert card.GT_LnXYEx(300.0, 0.0, -1.0, 0, 43) == (Code.SPEED, TLookAheadMsg(43, 2, Code.SPEED))
    assert card.GT_ArcXYPEx(900.0, 0.0, 10.0, 1, 10.0, 0, 44) == (Code.CHORD, TLookAheadMsg(44, 2, Code.CHORD))
    assert card.GT_LnXYEx(300.0, 0.0, 10.0, 0, 45) == (0, TLookAheadMsg())
    card.GT_EndList()
    assert card.GT_M30() == (Code.COMMAND, TLookAheadMsg(41, 0, Code.COMMAND))


def test_the_list_runs_what_went_through_the_look_ahead() -> None:
    card = in_mode(n=3)
    assert card.GT_LnXYEx(1000.0, 0.0, 10.0, 0, 1)[0] == 0
    assert card.GT_ArcXYEx(1000.0, 500.0, 90.0, 10.0, 0, 2)[0] == 0
    assert card.GT_BufIOBitEx(3, 0) == 0
    assert card.GT_ArcXYPEx(1000.0, 1000.0, 500.0, 1, 10.0, 0, 3)[0] == 0
    assert card.GT_LnXYG0Ex(0.0, 1000.0, 20.0, 1, 4)[0] == 0
    assert card.GT_DelayEx(5) == 0
    assert card.GT_EndLookaheadMode() == 0
    assert card.GT_EndList() == 0
    assert card.GT_StrtMtn() == 0
    assert card.GT_GetExOpt() == (0, 0xFFFF)
    card.sleep(60_000.0)
    assert card.GT_GetExOpt() == (0, 0xFFF7)
    assert card.GT_GetCrdSts() == (0, 0x2001)
    assert [card.GT_GetAtlPos(axis)[1] for axis in (1, 2)] == [0, 1000]


def test_corners_in_the_list_are_passed_at_the_speed_of_the_look_ahead() -> None:
    card = in_mode(n=10, call_s=1e-6)
    card.GT_LnXYEx(20_000.0, 0.0, 10.0, 0, 1)
    card.GT_LnXYEx(20_000.0, 20_000.0, 10.0, 0, 2)
    card.GT_M30()
    card.GT_StrtMtn()
    # Braked to |Δv| = 1 pulse/ms at the corner, v = 1/√2: least speed along the way
    least = math.inf
    while card.GT_GetPrfPnt()[1][1] < 100.0:
        card.sleep(0.5)
        if card.GT_GetPrfPnt()[1][0] > 19_000.0:
            least = min(least, card.GT_GetPrfVel()[1])
    assert least == pytest.approx(1.0 / math.sqrt(2.0), abs=0.06), "a sample within 0.5 ms of it, at 0.1 pulse/ms²"


def test_a_full_list_refuses_and_keeps_all() -> None:
    card = in_mode(n=1, capacity=3)
    assert card.GT_LnXYEx(10.0, 0.0, 1.0, 0, 1) == (0, TLookAheadMsg())
    assert card.GT_LnXYEx(20.0, 0.0, 1.0, 0, 2) == (0, TLookAheadMsg())
    assert card.GT_LnXYEx(30.0, 0.0, 1.0, 0, 3) == (0, TLookAheadMsg())
    assert card.GT_LnXYEx(40.0, 0.0, 1.0, 0, 4) == (Code.COMMAND, TLookAheadMsg(4, 1, Code.COMMAND))
    assert card.GT_GetCmdSts() == (0, 0x8000)
    assert card.GT_M30()[0] == Code.COMMAND
    card.GT_StrtMtn()
    card.sleep(10_000.0)
    assert card.GT_LnXYEx(40.0, 0.0, 1.0, 0, 4) == (0, TLookAheadMsg())
    assert card.GT_M30() == (0, TLookAheadMsg())
    card.sleep(10_000.0)
    assert card.GT_GetAtlPos(1) == (0, 40)


def test_without_the_mode_or_a_list_its_calls_are_refused() -> None:
    card = opened()
    card.GT_InitLookAheadEx(2.0, 0.5, 0.1, 3, 1.0)
    card.GT_StrtList()
    assert card.GT_LnXYEx(1.0, 0.0, 1.0, 0, 1)[0] == Code.COMMAND
    card.GT_SwitchLookaheadMode(1)
    assert card.GT_LnXYEx(1.0, 0.0, 1.0, 0, 1)[0] == 0
    assert card.GT_SwitchLookaheadMode(0) == Code.COMMAND, "a block is kept"
    card.GT_M30()
    card.GT_EndList()
    assert card.GT_LnXYEx(2.0, 0.0, 1.0, 0, 1)[0] == Code.COMMAND
    assert card.GT_SwitchLookaheadMode(2) == Code.PARAMETER
    assert card.GT_SwitchLookaheadMode(0) == 0


def test_bad_path_calls_are_refused_as_those_without_look_ahead() -> None:
    card = in_mode(axes=2)
    assert card.GT_LnXYEx(0.0, 0.0, 1.0, 0, 1)[0] == Code.LENGTH
    assert card.GT_LnXYEx(1.0, 0.0, 0.0, 0, 1)[0] == Code.SPEED
    assert card.GT_LnXYZEx(1.0, 0.0, 1.0, 1.0, 0, 1)[0] == Code.COMMAND
    assert card.GT_ArcYZEx(1.0, 0.0, 90.0, 1.0, 0, 1)[0] == Code.COMMAND
    assert card.GT_ArcXYEx(0.0, 0.0, 90.0, 1.0, 0, 1)[0] == Code.RADIUS
    assert card.GT_ArcXYEx(1.0, 0.0, 361.0, 1.0, 0, 1)[0] == Code.PARAMETER
    assert card.GT_ArcXYPEx(10.0, 0.0, 4.0, 1, 1.0, 0, 1)[0] == Code.CHORD
    assert card.GT_ArcXYPEx(10.0, 0.0, 5.0, 2, 1.0, 0, 1)[0] == Code.PARAMETER
    assert card.GT_MvXYEx(1.0, 1.0, 0.0) == Code.SPEED
    assert card.GT_BufIOBitEx(16, 0) == Code.PARAMETER
    assert card.GT_DelayEx(-1) == Code.PARAMETER
    assert card.GT_M30() == (0, TLookAheadMsg())


def test_a_list_begun_anew_forgets_the_blocks_kept_for_the_old_one() -> None:
    card = in_mode(n=5)
    card.GT_LnXYEx(100.0, 0.0, 10.0, 0, 1)
    card.GT_LnXYEx(200.0, 0.0, 10.0, 0, 2)
    card.GT_StrtList()
    card.GT_LnXYEx(0.0, 50.0, 10.0, 0, 3)
    assert card.GT_M30() == (0, TLookAheadMsg())
    card.GT_StrtMtn()
    card.sleep(10_000.0)
    assert card.places == [[0, 50, 0, 0]]


def test_no_more_is_kept_than_the_list_can_take() -> None:
    card = in_mode(n=100, capacity=4)
    told = [card.GT_LnXYEx(10.0 * k, 0.0, 10.0, 0, k) for k in range(1, 10)]
    assert [code for code, _ in told] == [0] * 7 + [1, 1], "3 in the list behind the move, 4 kept"
    assert card.GT_BufIOEx(0) == Code.COMMAND
    assert card.GT_GetCmdSts() == (0, 0x8000)
    card.GT_StrtMtn()
    card.sleep(10_000.0)
    assert card.GT_M30() == (0, TLookAheadMsg())
    card.sleep(10_000.0)
    assert card.places == [[70, 0, 0, 0]]


def test_the_mode_is_left_without_blocks_whatever_the_list() -> None:
    card = opened()
    assert card.GT_EndLookaheadMode() == 0
    assert card.GT_M30()[0] == Code.COMMAND


def test_a_positioning_move_lets_the_blocks_before_it_go_or_changes_nothing() -> None:
    card = in_mode(n=5, needs_axis_on=False)
    for k in (1, 2, 3):
        card.GT_LnXYEx(100.0 * k, 0.0, 10.0, 0, k)
    assert card.GT_MvXYEx(0.0, 50.0, 5.0) == 0
    card.GT_EndList()
    card.GT_StrtMtn()
    card.sleep(10_000.0)
    assert card.places == [[0, 50, 0, 0]]
    assert card.GT_GetMtnNm() == (0, 4)


def test_a_positioning_move_that_is_refused_keeps_the_blocks() -> None:
    card = opened(needs_axis_on=True)
    card.GT_AxisOn(1)
    card.GT_SwitchLookaheadMode(1)
    card.GT_InitLookAheadEx(2.0, 0.5, 0.1, 5, 1.0)
    card.GT_StrtList()
    assert card.GT_LnXYEx(100.0, 0.0, 10.0, 0, 1)[0] == 0
    assert card.GT_MvXYEx(0.0, 50.0, 5.0) == Code.COMMAND, "axis 2 is off"
    card.GT_StrtMtn()
    card.sleep(5000.0)
    assert card.places == [[0, 0, 0, 0]], "the block is kept still"
    assert card.GT_M30()[0] == 0
    card.sleep(5000.0)
    assert card.places == [[100, 0, 0, 0]]
