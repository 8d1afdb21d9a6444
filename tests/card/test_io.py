"""Inputs and outputs, the servo settings, several cards, and what is only recorded."""

import math
from dataclasses import fields
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller import GECard
from controller.card.core.call import Code
from controller.card.core.settings import CardSettings, Switches

NUMBERS = [key for key in fields(CardSettings) if type(key.default) in (int, float)]


def opened(**settings: object) -> GECard:
    card = GECard(CardSettings(**settings))  # type: ignore[arg-type]
    assert card.GT_Open() == 0
    return card


def test_outputs_start_at_1_and_act_at_once_while_a_list_is_open() -> None:
    card = opened()
    assert card.GT_GetExOpt() == (0, 0xFFFF)
    assert card.GT_StrtList() == 0
    assert card.GT_ExOpt(0x00F0) == 0
    assert card.GT_GetExOpt() == (0, 0x00F0)


@given(st.lists(st.tuples(st.integers(0, 15), st.integers(0, 1))))
def test_single_outputs_change_no_other(changes: list[tuple[int, int]]) -> None:
    card, levels = opened(), [1] * 16
    for bit, level in changes:
        assert card.GT_ExOptBit(bit, level) == 0
        levels[bit] = level
    assert card.GT_GetExOpt() == (0, sum(level << bit for bit, level in enumerate(levels)))


@pytest.mark.parametrize(("bit", "level"), [(16, 0), (0, 2), (-1, 0)])
def test_an_output_that_is_none_is_refused(bit: int, level: int) -> None:
    card = opened()
    assert card.GT_ExOptBit(bit, level) == Code.PARAMETER
    assert card.GT_GetExOpt() == (0, 0xFFFF)


def test_an_open_input_reads_1_and_others_what_they_are_given() -> None:
    card = opened()
    assert card.GT_ExInpt() == (0, 0xFFFF)
    card.set_input(3, 0)
    assert card.GT_ExInpt() == (0, 0xFFF7)
    card.set_input(3, 1)
    assert card.GT_ExInpt() == (0, 0xFFFF)


@pytest.mark.parametrize(("bit", "level"), [(16, 0), (-1, 0), (0, 2)])
def test_an_input_that_is_none_is_an_error_of_the_program(bit: int, level: int) -> None:
    with pytest.raises(ValueError, match="0 to 15"):
        opened().set_input(bit, level)


def test_the_probe_captures_the_places_of_all_axes_once() -> None:
    card = opened()
    card.set_input(15, 0)
    assert card.GT_GetSts(1)[1] & 1 << 3 == 0, "not armed"
    card.set_input(15, 1)
    card.GT_CaptProb()
    card.set_input(15, 0)
    assert all(card.GT_GetSts(axis)[1] & 1 << 3 for axis in (1, 2, 3, 4))
    card.GT_ClrSts(1)
    card.set_input(15, 1)
    card.set_input(15, 0)
    assert card.GT_GetSts(1)[1] & 1 << 3 == 0


SERVO = [
    ("Kp", 1.5),
    ("Ki", 0.25),
    ("Kd", -2.0),
    ("Kvff", 3.5),
    ("Kaff", 0.5),
    ("ILmt", 7),
    ("MtrLmt", 9),
    ("MtrBias", -5),
]


@pytest.mark.parametrize(("name", "value"), SERVO)
def test_servo_settings_are_told_as_set_and_loaded_by_an_update(name: str, value: float) -> None:
    card = opened()
    assert getattr(card, f"GT_Set{name}")(2, value) == 0
    assert getattr(card, f"GT_Get{name}")(2) == (0, value)
    assert getattr(card, f"GT_Get{name}")(1) == (0, 0)
    assert dict(card.servo(2)) == {}
    assert card.GT_Update(1) == 0
    assert dict(card.servo(2)) == {}
    assert card.GT_Update(2) == 0
    assert dict(card.servo(2)) == {name: value}


def test_several_axes_are_loaded_by_a_mask() -> None:
    card = opened()
    for axis in (1, 2, 3, 4):
        card.GT_SetKp(axis, float(axis))
    assert card.GT_MltiUpdt(0b1010) == 0
    assert [dict(card.servo(axis)) for axis in (1, 2, 3, 4)] == [{}, {"Kp": 2.0}, {}, {"Kp": 4.0}]
    assert card.GT_MltiUpdt(0b10000) == Code.PARAMETER


def test_cards_are_apart() -> None:
    card = opened(cards=2)
    assert card.GT_GetCurrentCardNo() == 0
    assert card.GT_ExOpt(1) == 0
    assert card.GT_SwitchtoCardNo(1) == 0
    assert card.GT_GetCurrentCardNo() == 1
    assert card.GT_GetExOpt() == (-1, 0), "the second card is not open"
    assert card.GT_Open() == 0
    assert card.GT_GetExOpt() == (0, 0xFFFF)
    assert card.GT_SwitchtoCardNo(2) == Code.PARAMETER
    assert card.GT_GetCurrentCardNo() == 1


def test_without_an_open_card_there_is_no_current_one() -> None:
    card = GECard(CardSettings(cards=2))
    assert card.GT_GetCurrentCardNo() == -1


def test_a_card_is_selected_before_it_is_opened() -> None:
    card = GECard(CardSettings(cards=2))
    assert [card.GT_SwitchtoCardNo(number) for number in (0, 2, 1)] == [0, Code.PARAMETER, 0]
    assert card.GT_Open() == 0
    assert card.GT_GetCurrentCardNo() == 1


def test_opening_twice_and_after_closing_is_harmless() -> None:
    card = opened()
    card.GT_ExOpt(5)
    for call, code in ((card.GT_Open, 0), (card.GT_Close, 0), (card.GT_Close, -1), (card.GT_Open, 0)):
        assert call() == code
    assert card.GT_GetExOpt() == (0, 5)


@pytest.mark.parametrize("reset", ["GT_Reset", "GT_HardRst"])
def test_a_reset_is_as_power_on_but_leaves_the_world_alone(reset: str) -> None:
    card = opened()
    card.set_input(2, 0)
    card.GT_ExOpt(0)
    card.GT_SetKp(1, 2.0)
    card.GT_AxisOn(1)
    card.GT_MapCnt(1, 10.0)
    card.GT_LaserOutFrq(5.0)
    assert getattr(card, reset)() == 0
    assert (card.GT_GetExOpt(), card.GT_ExInpt(), card.GT_GetKp(1)) == ((0, 0xFFFF), (0, 0xFFFB), (0, 0.0))
    assert card.GT_GetSts(1) == (0, 1 << 11)
    assert not card.recorded


def test_recorded_functions_keep_their_last_good_call() -> None:
    card = opened()
    assert card.GT_LaserPrfCmd(0.5) == 0
    assert card.GT_LaserPrfCmd(0.75, 2) == 0
    assert card.GT_LaserPrfCmd(float("nan")) == Code.PARAMETER
    assert card.GT_RunGrdOp(5, 1) == Code.PARAMETER
    assert card.GT_GantryPrm(3) == 0
    assert dict(card.recorded) == {"GT_LaserPrfCmd": (0.75, 2), "GT_GantryPrm": (3, 0, 0)}


def test_fast_outputs_read_back() -> None:
    card = opened()
    assert card.GT_GetHSIOOpt() == (0, 0)
    card.GT_SetHSIOOpt(3)
    assert card.GT_GetHSIOOpt() == (0, 3)


def test_versions_are_told() -> None:
    card = opened()
    assert card.GT_GetDllVrsn() == card.GT_ChkVrsn() == card.GT_GetDSPVrsn() == (0, 0x0100)


def test_every_call_lets_time_pass_and_a_sleep_its_own() -> None:
    card = opened(call_s=1e-5)
    card.sleep(2.0)
    card.GT_GetExOpt()
    assert card.time_s == pytest.approx(2.02e-3, abs=1e-12)
    for ms in (-1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="a sleep takes"):
            card.sleep(ms)
    with pytest.raises(TypeError, match="a sleep takes a number of ms, not 'a'"):
        card.sleep("a")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "bad",
    [{"axes": 1}, {"axes": "4"}, {"cards": 17}, {"cards": True}, {"capacity": 1.5}, {"capacity": 2**31}]
    + [{"switches": (Switches(),) * 5}, {"call_s": 1.1}, {"pulse_limit_hz": 0.9}, {"servo_period_s": 1.1}]
    + [{key.name: value} for key in NUMBERS for value in (0, -1.0, math.nan, -math.inf, 1e300)]
    + [{key.name: math.inf} for key in NUMBERS if key.name != "jerk_pulse_ms3"],
    ids=str,
)
def test_settings_that_no_card_has_are_refused(bad: dict[str, Any]) -> None:
    (key,) = bad
    with pytest.raises(ValueError, match=rf"^{key} of a card (is|are) .* to .*, not "):
        CardSettings(**bad)


@pytest.mark.parametrize(
    "bad",
    [{"negative": math.nan}, {"positive": 1e10}, {"home": (1.0, 0.0)}, {"home": (0.0, math.nan)}]
    + [{"index_every": every} for every in (math.nan, math.inf, -1.0, 1e-300)],
    ids=str,
)
def test_switches_that_no_card_has_are_refused(bad: dict[str, Any]) -> None:
    (key,) = bad
    with pytest.raises(ValueError, match=rf"^{key} of a card .*, not "):
        Switches(**bad)


BOUNDS = {
    "capacity": (1, 2**31 - 1),
    "servo_period_s": (1e-5, 1.0),
    "pulse_limit_hz": (1.0, 1e12),
    "call_s": (1e-30, 1.0),
    "jerk_pulse_ms3": (1e-10, 1e9),
}


@pytest.mark.parametrize("end", [0, 1])
@pytest.mark.parametrize("key", [key.name for key in NUMBERS if key.name not in ("axes", "cards")])
def test_a_card_with_a_setting_at_its_bound_moves_and_stops(key: str, end: int) -> None:
    value = BOUNDS.get(key, (1e-7, 1e9))[end]
    card = opened(**{key: value})
    assert card.GT_LnXY(100.0, 30.0) == 0
    card.sleep(30.0)
    card.GT_StpMtn()
    card.sleep(1e3)
    card.GT_RestoreMtn()
    card.sleep(1e4)
    assert math.isfinite(card.GT_GetPrfPnt()[1][0])
