"""Instructions of plotter files, HPGL and its second version, one by one (HP, HPGL/2 reference, 1993).

The way of a pen in the signs of PE: differences in base 64 or 32, so that long curves are short.
"""

import re
from collections.abc import Iterator
from typing import Final, Literal, NamedTuple

_INSTRUCTION: Final = re.compile(r"\s*([A-Za-z]{2})([^A-Za-z;]*);?")
_ESCAPE: Final = re.compile(r"\x1b(?:%-?\d*[A-Z]|\.[A-Z@(-/](?:[\d;]*:)?|.)")
_NUMBER: Final = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)")
_LABEL_ENDS: Final = "\x03"


class Instruction(NamedTuple):
    """Two letters, and what stands behind them; of a label nothing."""

    name: str
    values: str

    @property
    def numbers(self) -> list[float]:
        """The numbers behind it."""
        return [float(each) for each in _NUMBER.findall(self.values)]


def instructions(text: str) -> Iterator[Instruction]:
    """The instructions of a plot, in their order."""
    text, at, ends = _ESCAPE.sub("", text), 0, _LABEL_ENDS
    while found := _INSTRUCTION.search(text, at):
        name, behind = found[1].upper(), found.start(2)
        at = found.end()
        if name == "LB":
            at = _past(text, ends, behind)
            yield Instruction(name, "")
        elif name == "PE":
            at = _past(text, ";", behind)
            yield Instruction(name, text[behind:at].rstrip(";"))
        elif name == "DT":
            sign = text[behind : behind + 1]
            ends, at = (_LABEL_ENDS, at) if sign in ("", ";") else (sign, max(at, behind + 1))
        else:
            yield Instruction(name, found[2])


def _past(text: str, sign: str, at: int) -> int:
    """Behind a sign, or at the end."""
    found = text.find(sign, at)
    return len(text) if found < 0 else found + len(sign)


class Encoded(NamedTuple):
    """A step of PE: the pen goes to a place, or by so much, in user units, or another pen is taken.

    `is_up` says whether it goes there lifted, `is_place` whether the place is one of its own.
    """

    kind: Literal["move", "pen"]
    x: float
    y: float = 0.0
    is_up: bool = False
    is_place: bool = False


_HIGH, _LOW = 191, 63  # in base 64 signs from 191 on end a number, others begin at 63
_BASE_32, _LOWEST_END_32 = 32, 95


def encoded(values: str) -> Iterator[Encoded]:
    """The steps of a PE. ValueError where its signs are none, or end within a number.

    ``<`` lifts the pen for the next place, ``=`` says that this is none of a difference, ``:`` takes a pen, ``>`` sets
    how many binary places numbers have, ``7`` changes to base 32.
    """
    codes = [ord(sign) for sign in values if not sign.isspace()]
    base, places, at = 64, 0, 0
    is_up = is_place = False
    while at < len(codes):
        sign = chr(codes[at])
        if sign in "<=7":
            at += 1
            is_up, is_place = is_up or sign == "<", is_place or sign == "="
            base = _BASE_32 if sign == "7" else base
        elif sign in ":>":
            number, at = _number(codes, at + 1, base)
            if sign == ">":
                places = number
            else:
                yield Encoded("pen", number)
        else:
            x, at = _number(codes, at, base)
            y, at = _number(codes, at, base)
            yield Encoded("move", x / 2**places, y / 2**places, is_up, is_place)
            is_up = is_place = False


def _number(codes: list[int], at: int, base: int) -> tuple[int, int]:
    """A number from a sign on, and where it ends; its last digit is the highest, its lowest bit the sign."""
    value, unit = 0, 1
    least_end = _LOWEST_END_32 if base == _BASE_32 else _HIGH
    while at < len(codes):
        code, at = codes[at], at + 1
        if not _LOW <= code < least_end + base or unit > 1 << 60:
            break
        is_last = code >= least_end
        value += unit * (code - (least_end if is_last else _LOW))
        unit *= base
        if is_last:
            return (-(value >> 1) if value & 1 else value >> 1), at
    raise ValueError
