"""The hook of the library: told the name and the code of each call, and able to call the card itself."""

import pytest

from controller import GECard
from controller.card.calls.base import Logged
from controller.card.core.call import LIST_FULL, Code
from controller.card.core.settings import CardSettings


def test_it_is_told_of_each_call_from_then_on() -> None:
    card, told = GECard(), []
    card.GT_Open()
    assert card.GT_HookCommand(lambda name, code: told.append((name, code))) == 0
    card.GT_SetSynVel(-1.0)
    card.GT_GetSts(1)
    card.GT_GetCurrentCardNo()
    card.GT_AxisOn(9)
    card.sleep(1.0)
    assert told == [("GT_SetSynVel", 4), ("GT_GetSts", 0), ("GT_GetCurrentCardNo", 0), ("GT_AxisOn", 7)]
    assert card.GT_HookCommand(None) == 0
    card.GT_GetSts(1)
    assert told[4:] == [("GT_HookCommand", 0)]


def test_it_asks_the_card_why_a_call_was_refused_and_is_not_told_of_that() -> None:
    calls: list[Logged] = []
    card = GECard(CardSettings(capacity=1), on_call=calls.append)
    card.GT_Open()
    why = []
    card.GT_HookCommand(lambda name, code: why.append(card.GT_GetCmdSts()) if code else None)
    card.GT_StrtList()
    assert [card.GT_LnXY(x, 0.0) for x in (10.0, 20.0)] == [0, Code.COMMAND]
    assert why == [(0, LIST_FULL)]
    assert [call.name for call in calls[-2:]] == ["GT_LnXY", "GT_GetCmdSts"], "in the order in which they were made"


def test_it_outlives_a_reset_and_what_it_raises_reaches_the_program() -> None:
    card = GECard()
    card.GT_Open()

    def fails(name: str, code: int) -> None:
        raise RuntimeError(name)

    card.GT_HookCommand(fails)
    for call in (card.GT_Reset, card.GT_GetCmdSts):
        with pytest.raises(RuntimeError, match=call.__name__):
            call()


def test_what_cannot_be_called_is_refused() -> None:
    card = GECard()
    card.GT_Open()
    assert card.GT_HookCommand(1) == Code.PARAMETER
