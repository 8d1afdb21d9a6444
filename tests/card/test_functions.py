"""Every function of the library is on the card, as its header has it, and no argument makes one raise."""

import csv
import inspect
import math
import re
from typing import Any, NamedTuple

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from places import ROOT

from controller import GECard
from controller.card.core.call import Code
from controller.card.lookahead import TLookAheadMsg, TLookData

TABLE = ROOT / "controller" / "card" / "abi" / "ge-functions.csv"
IN_POINTERS = {"char", "CCommandHandle", "TLookData"}
ARRAYS = {"GT_GetPrfPnt": 4, "GT_GetSegPnt": 4, "GT_GetBrkPnt": 4}
ANSWERS_WHEN_CLOSED = {"GT_Open", "GT_SwitchtoCardNo"}
CODES = {int(code) for code in Code}


class Parameter(NamedTuple):
    kind: str
    pointer: bool
    name: str
    default: str | None

    @property
    def is_out(self) -> bool:
        return self.pointer and self.kind not in IN_POINTERS


class Function(NamedTuple):
    name: str
    parameters: tuple[Parameter, ...]

    @property
    def ins(self) -> list[Parameter]:
        return [parameter for parameter in self.parameters if not parameter.is_out]

    @property
    def outs(self) -> list[Parameter]:
        return [parameter for parameter in self.parameters if parameter.is_out]


def parameter_of(text: str) -> Parameter:
    found = re.fullmatch(r"\s*([\w ]+?)\s*(\*?)\s*(\w+)(?:=(.+))?\s*", text)
    assert found, text
    kind, star, name, default = found.groups()
    return Parameter(kind, bool(star), name, default)


def functions() -> list[Function]:
    with TABLE.open(encoding="utf-8") as file:
        return [
            Function(
                row["function"],
                () if row["args"] == "void" else tuple(parameter_of(text) for text in row["args"].split(",")),
            )
            for row in csv.DictReader(file)
        ]


ALL = functions()
each = pytest.mark.parametrize("function", ALL, ids=lambda function: function.name)


def values_of(function: Function, answer: Any) -> tuple[int, tuple[Any, ...]]:
    """Code and values of an answer, which has to have as many values as the function has out-parameters."""
    if not function.outs:
        assert type(answer) is int
        return answer, ()
    code, *values = answer
    assert type(code) is int
    assert len(values) == len(function.outs)
    for value, parameter in zip(values, function.outs, strict=True):
        if function.name in ARRAYS:
            assert isinstance(value, tuple)
            assert [type(entry) for entry in value] == [float] * ARRAYS[function.name]
        elif parameter.kind == "TLookAheadMsg":
            assert isinstance(value, TLookAheadMsg)
        else:
            assert type(value) is (float if parameter.kind == "double" else int)
    return code, tuple(values)


def plausible(parameter: Parameter) -> Any:
    if parameter.kind == "TLookData":
        return TLookData(1, 17, 0.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0)
    if parameter.kind in ("char", "CCommandHandle") and parameter.pointer:
        return "lookahead.txt" if parameter.kind == "char" else None
    known = {"Code": 1, "PlaneGroup": 17, "mode": 1, "dir": 1, "direction": 1, "angle": 90.0, "card": 0}
    return known.get(parameter.name, 1.5 if parameter.kind == "double" else 1)


def test_the_table_is_that_of_the_library() -> None:
    assert len(ALL) == len({function.name for function in ALL}) == 173


@each
def test_a_function_is_that_of_the_header(function: Function) -> None:
    """Names, defaults and types of its parameters; and it tells what it does."""
    body = getattr(GECard, function.name)
    assert inspect.getdoc(body)
    own = [*inspect.signature(body).parameters.values()][1:]
    assert [parameter.name for parameter in own] == [parameter.name for parameter in function.ins]
    defaults = [None if parameter.default is parameter.empty else str(parameter.default) for parameter in own]
    assert defaults == [parameter.default for parameter in function.ins]
    hints = inspect.get_annotations(body)
    for parameter in function.ins:
        hint = hints[parameter.name]
        if parameter.pointer:
            assert hint is {"char": str, "CCommandHandle": Any, "TLookData": TLookData}[parameter.kind]
        else:
            (kind,) = hint.__metadata__
            assert kind.name == parameter.kind
            assert hint.__origin__ is (float if parameter.kind == "double" else int)


def test_the_card_has_no_function_that_the_library_lacks() -> None:
    assert {name for name in dir(GECard) if name.startswith("GT_")} == {function.name for function in ALL}


@each
def test_a_closed_card_answers_minus_1_and_zeros(function: Function) -> None:
    card = GECard()
    code, values = values_of(function, getattr(card, function.name)(*map(plausible, function.ins)))
    assert code == (0 if function.name in ANSWERS_WHEN_CLOSED else -1)
    flat = [entry for value in values for entry in (value if isinstance(value, tuple) else (value,))]
    assert not any(flat)


@each
def test_an_open_card_answers_a_documented_code_however_arguments_are_given(function: Function) -> None:
    card, named = GECard(), GECard()
    for each_card in (card, named):
        each_card.GT_Open()
    before, given = card.time_s, {parameter.name: plausible(parameter) for parameter in function.ins}
    answer = getattr(card, function.name)(*given.values())
    assert card.time_s > before
    assert getattr(named, function.name)(**given) == answer
    if function.name == "GT_GetCurrentCardNo":
        assert answer == 0
        return
    code, _ = values_of(function, answer)
    assert code in (Code.OK, Code.COMMAND, Code.RADIUS)


HOSTILE = st.one_of(
    st.sampled_from([0, 1, 2, 3, 4, 5, -1, 17, 0x7FFF, 0x8000, 0xFFFF, 1 << 31, -(1 << 31), 1 << 32, 10**400]),
    st.sampled_from([0.0, -0.0, 1e-300, 1.5, -2.5, 1e9, 1e300, math.inf, -math.inf, math.nan]),
    st.integers(),
    st.floats(),
    st.sampled_from([None, "1", b"1", (), (1, 2), [], object(), True]),
)
FITTING = st.one_of(st.integers(0, 4), st.floats(-1e4, 1e4), st.integers(-400, 400))


@settings(max_examples=25)
@given(st.data())
@pytest.mark.parametrize("arguments", [HOSTILE, FITTING], ids=["hostile", "fitting"])
def test_no_sequence_of_calls_raises(arguments: st.SearchStrategy[Any], data: st.DataObject) -> None:
    card = GECard()
    card.GT_Open()
    card.GT_SwitchLookaheadMode(1)
    card.GT_InitLookAheadEx(1.0, 1.0, 1.0, 3, 1.0)
    for function in data.draw(st.lists(st.sampled_from(ALL), min_size=10, max_size=60)):
        answer = getattr(card, function.name)(*(data.draw(arguments) for _ in function.ins))
        if function.name != "GT_GetCurrentCardNo":
            code, _ = values_of(function, answer)
            assert code in CODES


@each
def test_no_hostile_argument_raises(function: Function) -> None:
    card = GECard()
    card.GT_Open()
    for value in (0, -1, 5, 65536, 1 << 40, 10**400, 1.5, math.nan, math.inf, -1e300, None, "text", (1,), object()):
        answer = getattr(card, function.name)(*(value for _ in function.ins))
        if function.name != "GT_GetCurrentCardNo":
            code, _ = values_of(function, answer)
            assert code in CODES
    card.GT_Open()


@pytest.mark.parametrize("value", [math.nan, math.inf, "1", None, 1 << 32, -1, 0.5])
def test_what_fits_no_c_type_is_refused_and_changes_nothing(value: Any) -> None:
    card = GECard()
    card.GT_Open()
    card.GT_ExOpt(0x1234)
    assert card.GT_ExOpt(value) == Code.PARAMETER
    assert card.GT_GetExOpt() == (0, 0x1234)
