"""Damage that any file may take, and values that nobody expects."""

import codecs
import random
from collections.abc import Callable, Sequence
from typing import TypeVar

_Thing = TypeVar("_Thing")

NUMBERS = (
    *("", "0", "-0", "1", "2", "00", "-1", "3", "0.5", "400", "1e-300", "5e-324", "1e12", "1e15", "1e16", "1e300"),
    *("1e308", "-1e308", "1e309", "inf", "-inf", "nan", "999999999", "1000000000", "2147483647", "2147483648"),
    *(
        "-2147483649",
        "4294967296",
        "9223372036854775808",
        "-9223372036854775809",
        "9" * 40,
        "9" * 5000,
        "1" + "0" * 400,
    ),
    *("1.5", "１２", "٣", "1e9", "²", "0x10", "1_000", "+5", " 7 ", "1,5", "1.0.0", "--1", "1e", "."),
)
"""Numbers as texts: at the borders of what computers hold, and what only looks like a number."""
TEXTS = (
    *("", " ", "\t", "a", "加工", "é", "\U0001f600", "\u3000", "\ufeff", "\u2028", "\x85", "\0", "\x1b[31mred\x1b[0m"),
    *("\x1b]0;title\x07", "\x9b2J", "\u202eexe.3b", "\u2066x\u2069", "a\nb", "a\r\nb", "::error::x", "##[error]x"),
    *("##vso[task.complete result=Failed]", "\n::set-output name=a::b", "<script>alert(1)</script>", "</style>", "]]>"),
    *(
        "&amp;",
        '"',
        "'",
        "\\",
        "%s",
        "{}",
        "{0}",
        "{x:um}",
        "$HOME",
        "`id`",
        "../../x",
        "/",
        ".",
        "..",
        "CON",
        "-",
        "--",
    ),
    *("x" * 300, "x" * 70_000, "true", "null", "[bold]x[/bold]", "[/", "[link=file:///]x"),
)
"""Texts that mean something to a terminal, a CI system, a page, a format or a file system."""
_PIECES = (
    *(
        b"\0",
        b"\xff\xfe",
        b"\xfe\xff",
        codecs.BOM_UTF8,
        b"\x1a",
        b"\x80",
        b"\xed\xa0\x80",
        b"\r",
        b"\n",
        b"\t",
        b"\x0b",
    ),
    *(b"B", b"G", b"D", b"DD", b"//", b";", b"(", b")", b"\xa3\xc2", b"\xef\xbc\xa2", b"9" * 12, b" " * 40, b"\x1b[2J"),
)


def damaged(rng: random.Random, data: bytes, others: Sequence[bytes], times: Sequence[int] = (0, 1, 1, 2, 5)) -> bytes:
    """The data with a few changes of bytes; `others` are what pieces are taken from."""
    for _ in range(rng.choice(times)):
        data = rng.choice(_CHANGES)(rng, data, others)
    return data


def number_text(rng: random.Random) -> str:
    """A number that may be any."""
    if rng.random() < 0.5:
        return rng.choice(NUMBERS)
    value = rng.uniform(-1, 1) * 10.0 ** rng.uniform(-9, 12)
    return repr(value) if rng.random() < 0.5 else str(round(value))


def edited(rng: random.Random, things: Sequence[_Thing], other: Callable[[_Thing], _Thing]) -> list[_Thing]:
    """A list with one left out, doubled, moved, exchanged or made another; with its end or a stretch of it cut."""
    things = list(things)
    if not things:
        return things
    at, to = rng.randrange(len(things)), rng.randrange(len(things))
    low, past = min(at, to), max(at, to) + 1
    what = rng.random()
    if what < 0.5:
        things[at] = other(things[at])
    elif what < 0.6:
        del things[at]
    elif what < 0.7:
        things.insert(to, things[at])
    elif what < 0.8:
        things[at], things[to] = things[to], things[at]
    elif what < 0.87:
        things[past:past] = things[low:past]
    elif what < 0.94:
        del things[low:past]
    else:
        del things[at:]
    return things


def _flipped(rng: random.Random, data: bytes, _: Sequence[bytes]) -> bytes:
    if not data:
        return data
    at = rng.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << rng.randrange(8)]) + data[at + 1 :]


def _inserted(rng: random.Random, data: bytes, _: Sequence[bytes]) -> bytes:
    at = rng.randint(0, len(data))
    return data[:at] + rng.choice((*_PIECES, bytes([rng.randrange(256)]))) + data[at:]


def _deleted(rng: random.Random, data: bytes, _: Sequence[bytes]) -> bytes:
    at = rng.randint(0, len(data))
    return data[:at] + data[at + rng.choice((1, 1, 2, 10)) :]


def _spliced(rng: random.Random, data: bytes, others: Sequence[bytes]) -> bytes:
    other = rng.choice(others)
    return data[: rng.randint(0, len(data))] + other[rng.randint(0, len(other)) :]


def _doubled(rng: random.Random, data: bytes, _: Sequence[bytes]) -> bytes:
    first, past = sorted(rng.randint(0, len(data)) for _ in range(2))
    return data[:past] + data[first:past][:500] + data[past:]


def _truncated(rng: random.Random, data: bytes, _: Sequence[bytes]) -> bytes:
    return data[: rng.randint(0, len(data))]


_CHANGES: tuple[Callable[[random.Random, bytes, Sequence[bytes]], bytes], ...] = (
    *(_flipped, _inserted, _deleted),
    *(_spliced, _doubled, _truncated),
)
