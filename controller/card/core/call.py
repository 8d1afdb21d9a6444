"""How a function of the card is called, and the codes with which it answers (docs/card.md).

Return codes and status bits of the card, as its programs and headers give them (docs/card.md).

How a function of the card is called: it passes time, checks its arguments as C types, answers with a code.

A body is written for the good case: it returns nothing, or the values of its out-parameters, and raises `Refused` where
the card says no. `gt` makes the answer of it: the code, or the code and the values, zeros where it was refused.
"""

import functools
import math
import operator
from collections.abc import Callable
from enum import IntEnum, IntFlag
from inspect import Parameter, signature
from typing import Annotated, Any, NamedTuple, TypeAlias, get_type_hints


class Code(IntEnum):
    """What a call returns. Grade A: headers and programs agree."""

    OK = 0
    COMMAND = 1  # not executable now, or the list is full
    RADIUS = 2  # radius or chord 0
    LENGTH = 3  # line of no length, or too long
    SPEED = 4  # velocity or acceleration ≤ 0
    CHORD = 5  # chord longer than the diameter
    MAP = 6  # no solution of the map
    PARAMETER = 7
    CLOSED = -1  # no communication: the card is not open
    VERSION = -2


LIST_FULL = 0x8000
"""`GT_GetCmdSts` after a push on a full list; grade B."""


class CrdSts(IntFlag):
    """Bits of `GT_GetCrdSts`. Grade A, `ABNORMAL` grade C."""

    IDLE = 1 << 0
    ABNORMAL = 1 << 9
    LIST_EMPTY = 1 << 13


class AxisSts(IntFlag):
    """Bits of `GT_GetSts`; bits 12 and 13 hold the axis number less one."""

    FINISHED = 1 << 0
    ALARM = 1 << 1
    CAPTURED = 1 << 3
    MOTION_ERROR = 1 << 4
    POSITIVE_LIMIT = 1 << 5
    NEGATIVE_LIMIT = 1 << 6
    HOST_ERROR = 1 << 7
    ENABLED = 1 << 9
    MOVING = 1 << 10
    LIMITS_ON = 1 << 11
    HOME_ARMED = 1 << 14
    INDEX_ARMED = 1 << 15


LATCHED = (
    AxisSts.FINISHED
    | AxisSts.ALARM
    | AxisSts.CAPTURED
    | AxisSts.MOTION_ERROR
    | AxisSts.POSITIVE_LIMIT
    | AxisSts.NEGATIVE_LIMIT
    | AxisSts.HOST_ERROR
)
"""Bits that stay until they are cleared; the others follow the axis."""


class Refused(Exception):  # noqa: N818 - a refusal is an answer of the card, no error of the program
    """A call that the card does not take; `code` is what it returns, and nothing has changed."""

    def __init__(self, code: Code, command_status: int = 0) -> None:
        super().__init__(code.name)
        self.code = code
        self.command_status = command_status


Reader: TypeAlias = Callable[[Any], Any]
"""Gives an argument as its C type holds it."""


def _read_double(value: Any) -> float:
    try:
        if math.isfinite(value):
            return float(value)
    except (TypeError, OverflowError):
        pass
    raise Refused(Code.PARAMETER)


def _reader_of_whole(low: int, high: int) -> Callable[[Any], int]:
    def read(value: Any) -> int:
        try:
            if low <= (whole := operator.index(value)) <= high:
                return int(whole)
        except TypeError:
            pass
        raise Refused(Code.PARAMETER)

    return read


def _read_as_given(value: Any) -> Any:
    return value


class CType(NamedTuple):
    """A C type of the library's header: its name, and the whole numbers it holds; None where it is a double."""

    name: str
    low: int | None = None
    high: int | None = None

    @property
    def reader(self) -> Reader:
        """Gives a number as int or float. Refused with 7 unless it is a finite one, or a whole one in the bounds."""
        return _read_double if self.low is None or self.high is None else _reader_of_whole(self.low, self.high)


UShort = Annotated[int, CType("unsigned short", 0, 0xFFFF)]
Short = Annotated[int, CType("short", -0x8000, 0x7FFF)]
Char = Annotated[int, CType("char", -0x80, 0xFF)]
Int = Annotated[int, CType("int", -0x8000_0000, 0x7FFF_FFFF)]
Long = Annotated[int, CType("long", -0x8000_0000, 0x7FFF_FFFF)]  # 32 bit in the library; grade A
ULong = Annotated[int, CType("unsigned long", 0, 0xFFFF_FFFF)]
Double = Annotated[float, CType("double")]


ADDRESSED = ("axis", "Axis", "AxisNum")
"""Names of a first parameter that is the number of an axis."""


class Function(NamedTuple):
    """A function of the card: its body, the readers of its arguments, and what `gt` was told.

    `of_axis` tells whether it is addressed to an axis by number.
    """

    body: Callable[..., Any]
    readers: list[Reader]
    zeros: tuple[Any, ...]
    when_closed: bool
    of_axis: bool


def gt(*, zeros: tuple[Any, ...] = (), when_closed: bool = False) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Decorator of a function of the card.

    Parameters
    ----------
    zeros
        Values of the out-parameters where the call is refused; empty where there are none.
    when_closed
        Whether the function answers while the card is not open.
    """

    def wrap(body: Callable[..., Any]) -> Callable[..., Any]:
        hints = get_type_hints(body, include_extras=True)
        parameters = [p for p in signature(body).parameters.values() if p.name != "self"]
        readers = [_reader_of(hints[p.name]) for p in parameters]
        of_axis = bool(parameters) and parameters[0].name in ADDRESSED
        function = Function(body, readers, zeros, when_closed, of_axis)

        @functools.wraps(body)
        def call(self: Any, *args: Any, **named: Any) -> Any:
            given = _bound(parameters, args, named) if named or len(args) != len(parameters) else args
            return self._called(function, given)

        return call

    return wrap


def _reader_of(hint: Any) -> Reader:
    """Reader of a parameter's C type; where it has none, what is given is taken."""
    c_types = (meta for meta in getattr(hint, "__metadata__", ()) if isinstance(meta, CType))
    return next((c_type.reader for c_type in c_types), _read_as_given)


def _bound(parameters: list[Parameter], args: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
    """Arguments in order, with defaults. TypeError where one is missing or unknown."""
    values = list(args)
    for parameter in parameters[len(args) :]:
        if parameter.name in named:
            values.append(named.pop(parameter.name))
        elif parameter.default is not Parameter.empty:
            values.append(parameter.default)
        else:
            raise TypeError(f"{parameter.name} is missing")
    if named:
        raise TypeError(f"unknown arguments: {', '.join(named)}")
    if len(args) > len(parameters):
        raise TypeError(f"{len(parameters)} arguments at most, not {len(args)}")
    return tuple(values)


def read_arguments(readers: list[Reader], given: tuple[Any, ...]) -> list[Any]:
    """Arguments as their C types hold them. Refused with 7 where one does not fit."""
    return [read(value) for read, value in zip(readers, given, strict=True)]
