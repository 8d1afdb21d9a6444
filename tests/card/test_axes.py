"""Axes: status words, limits, captures, positions, errors and encoders."""

from typing import Any

import pytest

from controller import GECard
from controller.card.core.call import AxisSts, Code
from controller.card.core.settings import CardSettings, Switches, Wiring

MACHINE = (Switches(-2000.0, 3000.0, (-600.0, -500.0), 1000.0), Switches())
IDLE = 0x2001


def opened(**settings: Any) -> GECard:
    card = GECard(CardSettings(**settings))
    assert card.GT_Open() == 0
    return card


def moving(x: float = 1000.0, y: float = 0.0, **settings: Any) -> GECard:
    """A card on its way, at once, at 1 pulse/ms and 0.01 pulse/ms²."""
    card = opened(**settings)
    assert card.GT_LnXY(x, y) == 0
    return card


def word(card: GECard, axis: int) -> AxisSts:
    code, value = card.GT_GetSts(axis)
    assert code == 0
    assert value >> 12 & 3 == axis - 1
    return AxisSts(value & ~0x3000)


def wait_idle(card: GECard) -> None:
    for _ in range(100_000):
        if card.GT_GetCrdSts()[1] & 1:
            return
        card.sleep(10.0)
    raise AssertionError("it moves for ever")


def test_bits_follow_the_axis_on_its_way() -> None:
    card = opened()
    assert word(card, 1) == AxisSts.LIMITS_ON
    card.GT_AxisOn(1)
    assert word(card, 1) == AxisSts.LIMITS_ON | AxisSts.ENABLED
    card.GT_LnXY(100.0, 0.0)
    assert word(card, 1) == AxisSts.LIMITS_ON | AxisSts.ENABLED | AxisSts.MOVING
    assert word(card, 2) == AxisSts.LIMITS_ON
    wait_idle(card)
    assert word(card, 1) == AxisSts.LIMITS_ON | AxisSts.ENABLED | AxisSts.FINISHED
    assert word(card, 2) == AxisSts.LIMITS_ON, "it did not move"
    card.GT_AxisOff(1)
    card.GT_LmtsOff(1)
    assert word(card, 1) == AxisSts.FINISHED


def test_clearing_takes_the_latched_bits_and_a_mask_keeps_its_own() -> None:
    card = moving(100.0)
    wait_idle(card)
    card.GT_SetPosErr(1, 0xFFFF)
    assert word(card, 1) & (AxisSts.FINISHED | AxisSts.HOST_ERROR) == AxisSts.FINISHED | AxisSts.HOST_ERROR
    assert card.GT_RstSts(1, AxisSts.FINISHED) == 0
    assert word(card, 1) == AxisSts.FINISHED | AxisSts.LIMITS_ON
    card.GT_RstSts(1, 0xFFFF)
    assert word(card, 1) == AxisSts.FINISHED | AxisSts.LIMITS_ON
    card.GT_ClrSts(1)
    assert word(card, 1) == AxisSts.LIMITS_ON


@pytest.mark.parametrize(
    ("call", "arguments", "code"),
    [("GT_SetPosErr", (2, 0x8000), 7), ("GT_MapCnt", (2, 0.0), 7), ("GT_SetKp", (2, float("nan")), 7)],
)
def test_a_bad_call_to_an_axis_is_latched_there(call: str, arguments: tuple[Any, ...], code: int) -> None:
    card = opened()
    assert getattr(card, call)(*arguments) == code
    assert [bool(word(card, axis) & AxisSts.HOST_ERROR) for axis in (1, 2, 3, 4)] == [False, True, False, False]


@pytest.mark.parametrize("axis", [0, 5, -1, 3])
def test_an_axis_that_is_none_is_refused_and_latched_nowhere(axis: int) -> None:
    card = opened(axes=2)
    for call in (card.GT_AxisOn, card.GT_ClrSts, card.GT_ZeroPos, card.GT_CaptHome, card.GT_StepDir):
        assert call(axis) == Code.PARAMETER
    assert card.GT_GetSts(axis) == (Code.PARAMETER, 0)
    assert [word(card, own) for own in (1, 2)] == [AxisSts.LIMITS_ON] * 2


def test_limit_switches_are_two_bits_an_axis_and_idle_1() -> None:
    card = opened(switches=MACHINE)
    assert card.GT_GetLmtSwt() == (0, 0xFF)
    card.GT_LmtsOff(1)
    card.GT_SetSynVel(10.0)
    card.GT_LnXY(3000.0, 0.0)
    wait_idle(card)
    assert card.GT_GetLmtSwt() == (0, 0xFE)
    card.GT_LnXY(-2000.0, 0.0)
    wait_idle(card)
    assert card.GT_GetLmtSwt() == (0, 0xFD)


@pytest.mark.parametrize("sense", [0x00, 0xFF, 0x0F, 0x5A])
def test_switches_that_the_program_senses_rightly_never_answer_but_where_they_are(sense: int) -> None:
    card = opened(switches=MACHINE)
    card.GT_LmtSns(sense)
    card.GT_SetSynVel(10.0)
    assert card.GT_GetLmtSwt() == (0, sense), "idle levels are those that do not trigger"
    card.GT_LnXYZA(2500.0, 500.0, 500.0, 500.0)
    wait_idle(card)
    assert card.places == [[2500, 500, 500, 500]]
    card.GT_LnXY(4000.0, 500.0)
    wait_idle(card)
    assert word(card, 1) & AxisSts.POSITIVE_LIMIT
    assert card.GT_GetLmtSwt() == (0, sense ^ 0x1)


@pytest.mark.parametrize(
    ("wiring", "sense", "idle", "is_right"),
    [
        ("normally-open", 0xFF, 0xFF, True),
        ("normally-open", 0x00, 0xFF, False),
        ("normally-open", None, 0xFF, False),
        ("normally-closed", 0x00, 0x00, True),
        ("normally-closed", 0xFF, 0x00, False),
        ("normally-closed", None, 0x00, True),
    ],
)
def test_a_level_is_that_of_the_wiring_and_a_wrong_sense_stops_all_motion(
    wiring: Wiring, sense: int | None, idle: int, is_right: bool
) -> None:
    card = opened(switches=tuple(Switches(-900.0, 900.0, limit_wiring=wiring) for _ in range(4)))
    if sense is not None:
        card.GT_LmtSns(sense)
    assert card.GT_GetLmtSwt() == (0, idle)
    assert card.GT_LnXY(100.0, 0.0) == 0
    wait_idle(card)
    assert card.places == [[100 if is_right else 0, 0, 0, 0]]
    assert bool(word(card, 1) & AxisSts.POSITIVE_LIMIT) is not is_right
    card.GT_Reset()
    assert card.GT_GetLmtSwt() == (0, idle)


def test_home_switches_are_a_bit_an_axis_and_idle_1() -> None:
    card = opened(switches=MACHINE)
    assert card.GT_GetHomeSwt() == (0, 0xF)
    card.GT_LnXY(-550.0, 0.0)
    wait_idle(card)
    assert card.GT_GetHomeSwt() == (0, 0xE)
    card.GT_HomeSns(0x0)
    assert card.GT_GetHomeSwt() == (0, 0x1)
    card.GT_HomeSns(0x3)
    assert card.GT_GetHomeSwt() == (0, 0x2)


def test_a_home_switch_answers_on_both_ends_of_its_place_and_not_a_pulse_beyond() -> None:
    card = opened(switches=MACHINE)
    first, last = MACHINE[0].home
    for place, level in ((first - 1, 0xF), (first, 0xE), (last, 0xE), (last + 1, 0xF)):
        card.GT_LnXY(place, 0.0)
        wait_idle(card)
        assert card.GT_GetHomeSwt() == (0, level), place


def test_a_limit_is_flagged_at_once_and_the_axis_brakes_beyond_it() -> None:
    card = opened(switches=MACHINE, call_s=1e-6)
    card.GT_SetSynVel(10.0)
    card.GT_SetSynAcc(1.0)
    card.GT_SetStpAcc(0.1)
    card.GT_LnXY(10_000.0, 0.0)
    while not word(card, 1) & AxisSts.POSITIVE_LIMIT:
        card.sleep(0.1)
    assert word(card, 1) & AxisSts.MOVING, "it brakes"
    assert card.GT_GetAtlPos(1)[1] == pytest.approx(3000, abs=3)
    wait_idle(card)
    # v²/2d beyond the switch
    assert card.GT_GetAtlPos(1)[1] == pytest.approx(3000 + 500, abs=2)
    assert card.GT_GetCrdSts()[1] & 1 << 9
    assert card.GT_LnXY(0.0, 0.0) == 0, "a move away, while the flag is latched"
    assert word(card, 1) & AxisSts.POSITIVE_LIMIT
    wait_idle(card)
    assert card.GT_GetAtlPos(1) == (0, 0)


def test_limits_that_are_off_stop_nothing_until_they_are_on() -> None:
    card = opened(switches=MACHINE)
    card.GT_SetSynVel(10.0)
    card.GT_LmtsOff(1)
    card.GT_LnXY(20_000.0, 0.0)
    while card.GT_GetAtlPos(1)[1] < 5000:
        card.sleep(1.0)
    assert not word(card, 1) & AxisSts.POSITIVE_LIMIT
    card.GT_LmtsOn(1)
    wait_idle(card)
    assert word(card, 1) & AxisSts.POSITIVE_LIMIT
    assert card.GT_GetAtlPos(1)[1] < 20_000


def test_home_is_found_as_programs_do() -> None:
    card = opened(switches=MACHINE)
    for call in (card.GT_AxisOn, card.GT_ClrSts, card.GT_CaptHome):
        assert call(1) == 0
    assert word(card, 1) & AxisSts.HOME_ARMED
    assert card.GT_SetSynVel(2.0) == 0
    assert card.GT_SetSynAcc(0.01) == 0
    assert card.GT_LnXY(-1_000_000.0, 0.0) == 0
    for _ in range(100_000):
        if word(card, 1) & AxisSts.CAPTURED:
            break
    assert not word(card, 1) & AxisSts.HOME_ARMED
    assert card.GT_StpMtn() == 0
    wait_idle(card)
    stopped = card.GT_GetAtlPos(1)[1]
    assert card.GT_GetCapt(1) == (0, -500), "the edge of the switch"
    assert stopped < -510, "it ran on while it braked"
    assert card.GT_LnXY(-500.0, 0.0) == 0
    wait_idle(card)
    assert card.GT_GetAtlPos(1) == (0, -500)
    assert card.GT_ZeroPos(1) == 0
    assert card.GT_GetPrfPnt() == (0, (0.0, 0.0, 0.0, 0.0))
    assert card.GT_GetCapt(1) == (0, 0), "places count from the zero"


def test_an_index_mark_is_captured_in_passing() -> None:
    card = opened(switches=MACHINE)
    card.GT_LnXY(400.0, 0.0)
    wait_idle(card)
    card.GT_CaptIndex(1)
    assert word(card, 1) & AxisSts.INDEX_ARMED
    card.GT_LnXY(1500.0, 0.0)
    wait_idle(card)
    assert word(card, 1) == AxisSts.LIMITS_ON | AxisSts.FINISHED | AxisSts.CAPTURED
    assert card.GT_GetCapt(1) == (0, 1000)
    assert card.GT_GetAtlPos(1) == (0, 1500)


def test_a_capture_armed_on_the_way_works() -> None:
    card = moving(-1000.0, switches=MACHINE)
    card.sleep(100.0)
    card.GT_CaptHome(1)
    wait_idle(card)
    assert card.GT_GetCapt(1) == (0, -500)


def test_without_a_capture_there_is_no_place() -> None:
    assert opened().GT_GetCapt(1) == (0, 0)


def test_zero_is_where_the_axis_stands_and_not_on_the_way() -> None:
    card = moving(100.0, 50.0)
    assert card.GT_ZeroPos(1) == Code.COMMAND
    wait_idle(card)
    assert card.GT_ZeroPos(1) == 0
    assert card.GT_GetPrfPnt() == (0, (0.0, 50.0, 0.0, 0.0))
    assert [card.GT_GetAtlPos(axis)[1] for axis in (1, 2)] == [0, 50]
    card.GT_LnXY(10.0, 50.0)
    wait_idle(card)
    assert card.places == [[110, 50, 0, 0]]


def test_zero_forgets_the_part_of_a_pulse_the_profile_is_off() -> None:
    card = moving(10.4, 0.0)
    wait_idle(card)
    assert card.GT_GetPrfPnt()[1][0] == pytest.approx(10.4, abs=1e-9)
    assert card.GT_GetAtlPos(1) == (0, 10)
    card.GT_ZeroPos(1)
    card.GT_LnXY(0.4, 0.0)
    wait_idle(card)
    assert card.GT_GetAtlPos(1) == (0, 0)


def test_an_actual_position_can_be_said_and_shows_as_error() -> None:
    card = moving(100.0)
    wait_idle(card)
    assert card.GT_SetAtlPos(1, 60.4) == 0
    assert (card.GT_GetAtlPos(1), card.GT_GetAtlErr(1)) == ((0, 60), (0, 40))
    card.GT_SetAtlPos(1, -1e6)
    assert card.GT_GetAtlErr(1) == (0, 32767)
    card.GT_SetAtlPos(1, 1e6)
    assert card.GT_GetAtlErr(1) == (0, -32767)
    assert card.GT_SetAtlPos(1, 1e12) == Code.PARAMETER
    card.GT_ZeroPos(1)
    assert (card.GT_GetAtlPos(1), card.GT_GetAtlErr(1)) == ((0, 0), (0, 0))


def test_an_error_over_its_limit_is_latched_and_stops_if_asked() -> None:
    card = moving(10_000.0)
    card.sleep(200.0)
    assert card.GT_GetPosErr(1) == (0, 32767)
    assert card.GT_SetPosErr(1, 100) == 0
    assert not word(card, 1) & AxisSts.MOTION_ERROR
    card.GT_SetAtlPos(1, -1000.0)
    assert word(card, 1) & AxisSts.MOTION_ERROR
    card.sleep(100.0)
    assert card.GT_GetPrfVel()[1] == pytest.approx(1.0, rel=1e-9), "no stop was asked for"
    card.GT_AuStpOn(1)
    wait_idle(card)
    assert card.GT_GetPrfPnt()[1][0] < 1000.0
    card.GT_AuStpOff(1)
    assert card.GT_LnXY(2000.0, 0.0) == 0
    card.sleep(300.0)
    assert card.GT_SetPosErr(1, 10) == 0
    assert card.GT_GetPrfVel()[1] == pytest.approx(1.0, rel=1e-9)


def test_an_error_that_lasts_is_latched_again_and_stops_every_motion() -> None:
    card = opened()
    card.GT_SetPosErr(1, 100)
    card.GT_SetAtlPos(1, -500.0)
    for clear in (lambda: card.GT_ClrSts(1), lambda: card.GT_RstSts(1, 0)):
        assert clear() == 0
        assert word(card, 1) & AxisSts.MOTION_ERROR
    assert not word(card, 2) & AxisSts.MOTION_ERROR
    assert card.GT_AuStpOn(1) == 0
    assert card.GT_LnXY(1000.0, 500.0) == 0
    wait_idle(card)
    assert card.places == [[0, 0, 0, 0]]
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.01)
    card.GT_LnXY(1000.0, 500.0)
    card.GT_StrtMtn()
    wait_idle(card)
    assert card.places == [[0, 0, 0, 0]]
    card.GT_ZeroPos(1)
    card.GT_ClrSts(1)
    assert not word(card, 1) & AxisSts.MOTION_ERROR
    assert card.GT_RestoreMtn() == 0
    wait_idle(card)
    assert card.places == [[1000, 500, 0, 0]]


def test_a_status_word_is_a_plain_number() -> None:
    card = moving(100.0)
    wait_idle(card)
    assert type(card.GT_GetSts(1)[1]) is int


def test_velocities_are_those_of_the_axes() -> None:
    card = moving(3000.0, -4000.0)
    card.sleep(1000.0)
    assert card.GT_GetAtlVel(1) == (0, pytest.approx(0.6, rel=1e-9))
    assert card.GT_GetAtlVel(2) == (0, pytest.approx(-0.8, rel=1e-9))
    assert card.GT_EncVel(2) == (0, pytest.approx(-0.8, rel=1e-9))
    assert card.GT_GetAtlVel(3) == (0, 0.0)


def test_encoders_count_pulses_from_their_own_zero() -> None:
    card = moving(100.0)
    wait_idle(card)
    card.GT_ZeroPos(1)
    assert card.GT_EncPos(1) == (0, 100)
    assert card.GT_ClrEncPos(1) == 0
    assert card.GT_EncPos(1) == (0, 0)
    card.GT_LnXY(-30.0, 0.0)
    wait_idle(card)
    assert (card.GT_EncPos(1), card.GT_EncPos(2)) == ((0, -30), (0, 0))


def test_one_user_unit_is_as_many_pulses_as_said() -> None:
    card = opened()
    assert card.GT_MapCnt(1, 10.0) == 0
    card.GT_LnXY(100.0, 0.0)
    wait_idle(card)
    assert card.GT_GetAtlPos(1) == (0, 1000)
    assert card.GT_GetPrfPnt()[1][0] == pytest.approx(100.0)
    assert card.GT_MapCnt(1, -1.0) == Code.PARAMETER
    assert card.GT_MapCnt(1, 0.0) == Code.PARAMETER


def test_backlash_is_kept_and_moves_nothing() -> None:
    card = opened()
    assert card.GT_SetBacklash(2, 15) == 0
    assert card.backlash(2) == 15
    card.GT_LnXY(0.0, 10.0)
    wait_idle(card)
    assert card.places == [[0, 10, 0, 0]]


def test_a_reset_ends_motion_with_zeros_where_the_axes_are() -> None:
    card = moving(10_000.0)
    card.sleep(500.0)
    card.GT_Reset()
    assert card.GT_GetCrdSts() == (0, IDLE)
    assert card.GT_GetPrfPnt() == (0, (0.0, 0.0, 0.0, 0.0))
    assert card.GT_GetAtlPos(1) == (0, 0)
    assert card.GT_EncPos(1) == (0, 0)
    assert 300 < card.places[0][0] < 500
    card.GT_LnXY(1.0, 0.0)
    wait_idle(card)
    assert card.GT_GetAtlPos(1) == (0, 1)


def test_closing_does_not_stop_motion() -> None:
    card = moving(1000.0)
    assert card.GT_Close() == 0
    card.sleep(10_000.0)
    card.GT_Open()
    assert card.GT_GetAtlPos(1) == (0, 1000)
    assert card.GT_GetCrdSts() == (0, IDLE)


def test_the_drive_alarm_is_cleared_by_its_reset_alone() -> None:
    card = opened()
    card._state.axes[0].latched = int(AxisSts.ALARM | AxisSts.FINISHED)  # no drive gives one here
    assert word(card, 1) == AxisSts.ALARM | AxisSts.FINISHED | AxisSts.LIMITS_ON
    assert card.GT_DrvRst(1) == 0
    assert word(card, 1) == AxisSts.FINISHED | AxisSts.LIMITS_ON
