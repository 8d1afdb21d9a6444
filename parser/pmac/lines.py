"""Text to lines: the commands and words of each, in which buffer they stand, and what could not be read.

Commands and words as the manuals of Turbo PMAC and Power PMAC have them (docs/pmac.md §2); no letter case, no blanks.
"""

import math
import re
from enum import IntEnum
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Ints
from parser.pmac.expressions import (
    NotAnExpressionError,
    Parsed,
    Values,
    Worked,
    combined,
    indexed,
    parse_parenthesised,
    parse_sum,
)
from parser.pmac.macros import Expanded, Online, expanded
from parser.text.encoding import narrow
from parser.text.source import LineIndex, Span

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)"
_VALUE = rf"(?:{_NUMBER}|\([ \t]*{_NUMBER}[ \t]*\))"
_NESTED = r"\((?:[^()\r\n]|\((?:[^()\r\n]|\([^()\r\n]*\))*\))*\)"
"""Parentheses with others in them, three deep."""
_TOKEN = re.compile(
    rf"""
    (?P<OPEN>OPEN[ \t]+PROG[ \t]*(?P<number>\d+))
    |(?P<OTHER>OPEN[ \t]+(?:PLCC?|FORWARD|INVERSE|ROTARY|ROT|BINARY|TRAJECTORY|COMP)\b[^\r\n]*)
    |(?P<ONLINE>CLOSE|CLEAR|UNDEFINE(?:[ \t]+ALL)?|&[ \t]*\d+|\#[ \t]*\d+[ \t]*->[^\r\n]*|M[ \t]*\d+[ \t]*->[^\r\n]*
        |B[ \t]*\d+[ \t]*R(?![ \t]*[-+.\d(]))
    |(?P<SETTING>COORD\[\d+\]\.[A-Z]+[ \t]*=[ \t]*{_NUMBER})
    |(?P<AXES>(?:ABS|INC|FRAX)[ \t]*\([^()\r\n]*\))
    |(?P<MODE>RAPID|LINEAR|CIRCLE[12]|ABS|INC|FRAX|PSET|STOP|RETURN|RET)
    |(?P<NORMAL>NORMAL(?=[ \t]*[IJK]))
    |(?P<TIMED>(?:DWELL|DELAY|TA|TS|TM)[ \t]*{_VALUE})
    |(?P<LABEL>N[ \t]*\d+[ \t]*:?)
    |(?P<BESIDE>(?:SPLINE[12]?|PVT|PRELUDE[01]?)(?:[ \t]*(?:{_NUMBER}|{_NESTED}))?(?![A-Z])
        |(?:HOMEZ?|ADIS|AROT|IDIS|IROT|TINIT|TSEL|CC[0-4]|CCR)(?![A-Z])[ \t]*(?:[\d.,]+|{_NESTED})?)
    |(?P<TEST>(?:IF|WHILE|AND|OR)[ \t]*(?=\())
    |(?P<FLOW>(?:ELSE|ENDIF|ENDI|ENDWHILE|ENDW)(?![A-Z])|[{{}}])
    |(?P<CALL>(?:GOTO|GOSUB|CALL)[ \t]*{_VALUE})
    |(?P<READ>READ[ \t]*\([A-Z, \t]*\))
    |(?P<ASSIGN>[IPQM][ \t]*\d+[ \t]*(?P<by>[-+*/&|^]?)==?)
    |(?P<MUTE>(?:CMD|COMMAND|SEND|DISPLAY|DISP)[A-Z0-9]*[\d., \t]*"[^"\r\n]*"(?:[ \t]*,[ \t]*[A-Z0-9.]+)*
        |(?:ENABLE|DISABLE)[ \t]+PLCC?[ \t]*[\d.,]+|(?:BLOCKSTART|BLOCKSTOP|BSTART|BSTOP|WAIT|LOCK|UNLOCK)(?![A-Z]))
    |(?P<WORD>[A-Z][ \t]*{_VALUE})
    |(?P<SUM>(?:DWELL|DELAY|TA|TS|TM|GOTO|GOSUB|CALL|[A-Z])[ \t]*(?=\())
    |(?P<UNKNOWN>[A-Z_]{{2,}}[ \t]*[\d.]*(?:[ \t]*{_NESTED})?)
    """,
    re.VERBOSE | re.IGNORECASE | re.ASCII,
)
_INDEXED = re.compile(r"[ \t]*([-+*/&|^]?)==?")
_REMARK = re.compile(r";[^\r\n]*|//[^\r\n]*")
_LINE = re.compile(r"[^\r\n]+")
_SPACES = re.compile(r"[ \t]+")
_LARGEST = 1e9  # ten kilometres in the finest unit, the hour in µs: no table, no time and no label is beyond
_NAMED = re.compile(rf"([A-Z]+)\(?({_NUMBER})\)?", re.ASCII)
_VARIABLE = re.compile(r"([IPQM])0*(\d+)[-+*/&|^]?==?")
_ELEMENT = re.compile(r"COORD\[\d+\]\.", re.IGNORECASE)

Kind = IntEnum(
    "Kind",
    "ONLINE SETTING AXES MODE NORMAL TIMED LABEL BESIDE MUTE WORD ASSIGN TEST FLOW CALL READ",
)
"""What a piece of a line is: an online command or a setting, a command with axes or without, a time, a word; what is
not simulated and may move the wire, and what moves nothing; a variable that gets a value, a condition, what begins or
ends a branch, a jump or a call, and the words that a routine takes from the line that calls it."""


NAMED_ELSEWHERE = "?"
"""Name of a piece that another file may explain."""
_WITH_SUMS = frozenset({"ASSIGN", "TEST", "SUM"})
_WITH_NUMBER = frozenset({Kind.TIMED, Kind.WORD, Kind.LABEL, Kind.CALL})


class Piece(NamedTuple):
    """One command or word.

    Attributes
    ----------
    kind
        What it is.
    name
        In capitals without blanks: ``CIRCLE1``, ``X``, ``P10``, ``ABS(X,Y)``; the letter alone of a variable whose
        number is a sum.
    value
        Number behind it; NaN where there is none, or a sum.
    span
        Where it stands.
    worked
        The sum or the condition behind it; None where there is none.
    numbered
        The sum that is the number of a variable; None where that is written.
    """

    kind: Kind
    name: str
    value: float
    span: Span
    worked: Worked | None = None
    numbered: Worked | None = None


class Line(NamedTuple):
    """One line with commands or words; `span` without remarks, `line` from 1."""

    pieces: tuple[Piece, ...]
    span: Span
    line: int


class Buffer(NamedTuple):
    """One ``OPEN PROG``: its number, where it stands, its lines, and whether it is cleared at first, and closed."""

    number: int
    span: Span
    lines: tuple[Line, ...]
    is_cleared: bool
    is_closed: bool


class Text(NamedTuple):
    """All that was read of one text.

    Attributes
    ----------
    lines
        Places in it.
    buffers
        In order.
    settings
        Values of I variables and elements that hold for the whole program, by their names in capitals.
    values
        Values that the variables have when the program starts.
    started
        Number of the program that the text starts by ``B1 R``; None where it starts none.
    unread
        Pieces that are nothing of the language, and words outside of buffers.
    remarks
        (m, 2) int64, first character and one past the last.
    is_power
        Whether it is written for Power PMAC: it sets elements by name, or its remarks begin with ``//``.
    """

    lines: LineIndex
    buffers: tuple[Buffer, ...]
    settings: dict[str, float]
    values: Values
    started: int | None
    unread: tuple[Span, ...]
    remarks: Ints
    is_power: bool


class _Opened:
    """The buffer that lines go to while the text is read."""

    def __init__(self, number: int, span: Span) -> None:
        self.number, self.span, self.lines = number, span, list[Line]()
        self.is_cleared = self.has_words = False

    def closed(self, *, by_close: bool) -> Buffer:
        return Buffer(self.number, self.span, tuple(self.lines), self.is_cleared, by_close)


class _Reading:
    """What is known of a text up to a line."""

    def __init__(self, values: Values) -> None:
        self.buffers: list[Buffer] = []
        self.settings: dict[str, float] = {}
        self.online = Online(values)
        self.unread: list[Span] = []
        self.opened: _Opened | None = None
        self.is_other = False  # another buffer is open, whose text is no motion program
        self.line_begin = 0
        self.outside: list[Span] = []
        self.is_online = False  # the line outside of a program says something to the card itself

    def open(self, number: int, span: Span) -> None:
        self.close(by_close=False)
        self.is_other = False
        self.opened = _Opened(number, span)

    def close(self, *, by_close: bool) -> None:
        if self.opened is not None:
            self.buffers.append(self.opened.closed(by_close=by_close))
        self.opened = None

    def leave(self, span: Span) -> None:
        """Something that is nothing of the language; outside of a program it is for the card itself.

        Of one line it is one: what follows in a line that was not understood says nothing for itself.
        """
        self.is_online |= self.opened is None
        if self.opened is not None and not (self.unread and self.unread[-1][0] >= self.line_begin):
            self.unread.append(span)

    def begin_line(self, at: int) -> None:
        self.line_begin, self.outside, self.is_online = at, [], self.is_other

    def end_line(self) -> None:
        """Words outside of a program, of a line that holds nothing else, are those of a program without its OPEN."""
        if not self.is_online:
            self.unread += self.outside

    def take(self, piece: Piece, kept_pieces: list[Piece]) -> None:
        """A piece: a command to the card itself is done at once, all others are of the buffer that is open.

        An element in a buffer is set when it runs: it holds for the whole program in front of its first word alone.
        """
        if piece.kind is Kind.SETTING:
            if self.opened is None or not self.opened.has_words:
                self.settings[piece.name] = piece.value
        elif piece.kind is Kind.ONLINE:
            self._online(piece)
        elif self.opened is not None:
            self.opened.has_words |= piece.kind is Kind.WORD
            kept_pieces.append(piece)
        elif piece.kind is Kind.ASSIGN:
            self.is_online = True
            self.online.assign(piece.name, piece.worked, in_another=self.is_other)
        elif piece.kind in {Kind.WORD, Kind.MODE, Kind.AXES, Kind.NORMAL, Kind.TIMED, Kind.LABEL}:
            self.outside.append(piece.span)

    def _online(self, piece: Piece) -> None:
        if piece.name == "CLOSE":
            self.close(by_close=True)
            self.is_other = False
        elif piece.name == "CLEAR":
            if self.opened is not None:
                self.opened.is_cleared = True
                self.opened.lines.clear()
        else:
            self.online.command(piece.name)


def read_lines(text: str) -> Text:
    """Read a whole text."""
    folded = narrow(text)
    lines = LineIndex(folded)
    found = [match.span() for match in _REMARK.finditer(folded)]
    slashed = any(folded.startswith("//", first) for first, _ in found)
    bare = expanded(_REMARK.sub(lambda remark: " " * len(remark[0]), folded))
    is_power = slashed or bool(_ELEMENT.search(bare.text))
    reading = _Reading(Values(degrees=not is_power))
    for line in _LINE.finditer(bare.text):
        if not line[0].isspace():
            _take_line(reading, bare, line.span(), lines)
    reading.close(by_close=False)
    remarks = np.array(found, dtype=np.int64).reshape(-1, 2)
    values, started = reading.online.at_start(), reading.online.started
    buffers, unread = tuple(reading.buffers), tuple(reading.unread)
    settings = values.of("I") | reading.settings
    return Text(lines, buffers, settings, values, started, unread, remarks, is_power)


def _take_line(reading: _Reading, bare: Expanded, span: Span, lines: LineIndex) -> None:
    """One line of a text without remarks."""
    (at, past), text = span, bare.text
    reading.begin_line(bare.span(*span)[0])
    kept_pieces: list[Piece] = []
    while match := _TOKEN.search(text, at, past):
        _leave(reading, bare, (at, match.start()))
        at, place = match.end(), bare.span(*match.span())
        group = match.lastgroup
        if group == "OPEN":
            reading.open(int(match["number"][-9:]), place)
        elif group == "OTHER":
            reading.close(by_close=False)
            reading.is_other = True
        elif group == "UNKNOWN":
            _name(reading, bare, place, kept_pieces)
        elif group in _WITH_SUMS:
            try:
                piece, at = _piece_with_sum(match, bare, past)
            except NotAnExpressionError:
                _name(reading, bare, bare.span(match.start(), past), kept_pieces)
                break
            _take(reading, piece, kept_pieces)
        else:
            _take(reading, _piece(match, place), kept_pieces)
    else:
        _leave(reading, bare, (at, past))
    reading.end_line()
    if kept_pieces and reading.opened is not None:
        place = (kept_pieces[0].span[0], kept_pieces[-1].span[1])
        reading.opened.lines.append(Line(tuple(kept_pieces), place, lines.line(bare.span(*span)[0])))


def _name(reading: _Reading, bare: Expanded, span: Span, kept_pieces: list[Piece]) -> None:
    """What is nothing of the language: a name, where a file that is included may say what it stands for."""
    if bare.left and reading.opened is not None:
        kept_pieces.append(Piece(Kind.BESIDE, NAMED_ELSEWHERE, math.nan, span))
    else:
        reading.leave(span)


def _take(reading: _Reading, piece: Piece, kept_pieces: list[Piece]) -> None:
    """A piece that was read; one with a number beyond any that is meant is not."""
    if abs(piece.value) > _LARGEST:  # NaN, of a piece without a number, is not
        reading.unread.append(piece.span)
    else:
        reading.take(piece, kept_pieces)


def _leave(reading: _Reading, bare: Expanded, span: Span) -> None:
    """What stands between pieces is nothing of the language, unless it is blank."""
    left = bare.text[slice(*span)]
    if left and not left.isspace():
        first = span[0] + len(left) - len(left.lstrip())
        reading.leave(bare.span(first, first + len(left.strip())))


def _piece(match: re.Match[str], place: Span) -> Piece:
    """The piece that a match is by itself."""
    name = _SPACES.sub("", match[0]).upper()
    kind = Kind[match.lastgroup or "WORD"]
    if kind is Kind.SETTING:
        name, value = name.split("=")
        return Piece(kind, name, float(value), place)
    named = _NAMED.fullmatch(name.rstrip(":")) if kind in _WITH_NUMBER else None
    return Piece(kind, named[1] if named else name, float(named[2]) if named else math.nan, place)


def _piece_with_sum(match: re.Match[str], bare: Expanded, past: int) -> tuple[Piece, int]:
    """The piece that begins with a match, with its sum; and the place behind it. NotAnExpressionError without one."""
    name = _SPACES.sub("", match[0]).upper()
    text, at = bare.text, match.end()
    if match["ASSIGN"]:
        variable = _VARIABLE.sub(r"\1\2", name)
        worked, at = _assigned(text, at, past, match["by"], lambda values: values.value(variable))
        return Piece(Kind.ASSIGN, variable, math.nan, bare.span(match.start(), at), worked), at
    if match["TEST"]:
        worked, at = parse_parenthesised(text, at, past, condition=True)
        return Piece(Kind.TEST, name, math.nan, bare.span(match.start(), at), worked), at
    worked, at = parse_parenthesised(text, at, past)
    return _with_sum(name, worked, (match.start(), at), bare, past)


def _with_sum(name: str, worked: Worked, span: Span, bare: Expanded, past: int) -> tuple[Piece, int]:
    """A word whose number is a sum, or a variable whose number is one and that gets a value."""
    first, at = span
    given = _INDEXED.match(bare.text, at, past) if name in "IPQM" else None
    if given:
        result, at = _assigned(
            bare.text, given.end(), past, given[1], lambda values: values.value(indexed(name, worked(values)))
        )
        return Piece(Kind.ASSIGN, name, math.nan, bare.span(first, at), result, worked), at
    kind = Kind.CALL if name in {"GOTO", "GOSUB", "CALL"} else Kind.TIMED if len(name) > 1 else Kind.WORD
    return Piece(kind, name, math.nan, bare.span(first, at), worked), at


def _assigned(text: str, at: int, past: int, by: str, old: Worked) -> Parsed:
    """The sum behind ``=``; behind ``+=`` that with the value before."""
    worked, at = parse_sum(text, at, past)
    return Parsed(combined(by, old, worked) if by else worked, at)
