"""Text to lines: the commands and words of each, in which buffer they stand, and what could not be read.

Commands and words as the manuals of Turbo PMAC and Power PMAC have them (docs/pmac.md §2); no letter case, no blanks.
"""

import re
from enum import Enum
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Ints
from parser.text.encoding import narrow
from parser.text.lines import LineIndex
from parser.text.source import Span

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)"
_VALUE = rf"(?:{_NUMBER}|\([ \t]*{_NUMBER}[ \t]*\))"
_NESTED = r"\((?:[^()\r\n]|\((?:[^()\r\n]|\([^()\r\n]*\))*\))*\)"
"""Parentheses with others in them, three deep."""
_TOKEN = re.compile(
    rf"""
    (?P<OPEN>OPEN[ \t]+PROG[ \t]*(?P<number>\d+))
    |(?P<OTHER>OPEN[ \t]+(?:PLCC?|FORWARD|INVERSE|ROTARY|ROT|BINARY|TRAJECTORY|COMP)\b[^\r\n]*)
    |(?P<ONLINE>CLOSE|CLEAR|UNDEFINE(?:[ \t]+ALL)?|&[ \t]*\d+|\#[ \t]*\d+[ \t]*->[^\r\n]*
        |B\d+[ \t]*R(?![ \t]*[-+.\d(]))
    |(?P<SETTING>(?:I[ \t]*\d+|COORD\[\d+\]\.[A-Z]+)[ \t]*=[ \t]*{_NUMBER})
    |(?P<AXES>(?:ABS|INC|FRAX)[ \t]*\([^()\r\n]*\))
    |(?P<MODE>RAPID|LINEAR|CIRCLE[12]|ABS|INC|FRAX|PSET|STOP|RETURN|RET)
    |(?P<NORMAL>NORMAL(?=[ \t]*[IJK]))
    |(?P<TIMED>(?:DWELL|DELAY|TA|TS|TM)[ \t]*{_VALUE})
    |(?P<LABEL>N[ \t]*\d+[ \t]*:?)
    |(?P<BESIDE>(?:SPLINE[12]?|PVT|TM)(?:[ \t]*(?:{_NUMBER}|{_NESTED}))?(?![A-Z])
        |(?:IF|WHILE|AND|OR)[ \t]*{_NESTED}|(?:ELSE|ENDIF|ENDI|ENDWHILE|ENDW|WAIT)(?![A-Z])
        |(?:GOTO|GOSUB|CALL|READ|PRELUDE)(?![A-Z])[ \t]*(?:[\d.]+|{_NESTED})?
        |[IPQM][ \t]*(?:\d+|{_NESTED})[ \t]*=(?!=)[^\r\n]*)
    |(?P<MUTE>(?:CMD|SEND|SENDP|SENDS|SENDR|DISPLAY|DISP)[A-Z0-9]*[ \t]*(?:[\d., \t]*"[^"\r\n]*")
        |(?:ENABLE|DISABLE)[ \t]+PLCC?[ \t]*[\d.,]+|(?:BLOCKSTART|BLOCKSTOP|BSTART|BSTOP)(?![A-Z]))
    |(?P<WORD>[A-Z][ \t]*{_VALUE})
    |(?P<SUM>(?:DWELL|DELAY|TA|TS|[A-Z])[ \t]*{_NESTED})
    |(?P<UNKNOWN>[A-Z_]{{2,}}[ \t]*[\d.]*(?:[ \t]*{_NESTED})?)
    """,
    re.VERBOSE | re.IGNORECASE | re.ASCII,
)
_REMARK = re.compile(r";[^\r\n]*|//[^\r\n]*")
_LINE = re.compile(r"[^\r\n]+")
_SPACES = re.compile(r"[ \t]+")
_LARGEST = 1e9  # ten kilometres in the finest unit, the hour in µs: no table, no time and no label is beyond
_NAMED = re.compile(rf"([A-Z]+)\(?({_NUMBER})\)?", re.ASCII)

Kind = Enum("Kind", ["ONLINE", "SETTING", "AXES", "MODE", "NORMAL", "TIMED", "LABEL", "BESIDE", "MUTE", "WORD"])
"""What a piece of a line is: an online command or a setting, a command with axes or without, a time, a word; what is
not simulated and may move the wire, and what moves nothing."""


class Piece(NamedTuple):
    """One command or word.

    Attributes
    ----------
    kind
        What it is.
    name
        In capitals without blanks: ``CIRCLE1``, ``X``, ``I5113``, ``ABS(X,Y)``.
    value
        Number behind it; NaN where there is none.
    span
        Where it stands.
    """

    kind: Kind
    name: str
    value: float
    span: Span


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
    unread
        Pieces that are nothing of the language, and words outside of buffers.
    beside
        Pieces of motion programs that are not simulated: variables, sums, jumps and calls, splines.
    remarks
        (m, 2) int64, first character and one past the last.
    is_power
        Whether it is written for Power PMAC: it sets elements by name, or its remarks begin with ``//``.
    """

    lines: LineIndex
    buffers: tuple[Buffer, ...]
    settings: dict[str, float]
    unread: tuple[Span, ...]
    beside: tuple[Piece, ...]
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

    def __init__(self) -> None:
        self.buffers: list[Buffer] = []
        self.settings: dict[str, float] = {}
        self.unread: list[Span] = []
        self.beside: list[Piece] = []
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

    def take(self, piece: Piece, kept: list[Piece]) -> None:
        """A piece: a command to the card itself is done at once, all others are of the buffer that is open.

        A setting in a buffer is made when it runs: it holds for the whole program in front of its first word alone.
        """
        if piece.kind is Kind.SETTING and self.opened is not None and self.opened.has_words:
            return
        if piece.kind in {Kind.BESIDE, Kind.MUTE}:  # outside of a program they are for the card itself
            if piece.kind is Kind.BESIDE and self.opened is not None:
                self.beside.append(piece)
            return
        if piece.kind is Kind.SETTING:
            self.settings[piece.name] = piece.value
        elif piece.kind is Kind.ONLINE:
            self._online(piece)
        elif self.opened is None:
            self.outside.append(piece.span)
        else:
            self.opened.has_words |= piece.kind is Kind.WORD
            kept.append(piece)

    def _online(self, piece: Piece) -> None:
        if piece.name == "CLOSE":
            self.close(by_close=True)
            self.is_other = False
        elif piece.name == "CLEAR" and self.opened is not None:
            self.opened.is_cleared = True
            self.opened.lines.clear()


def read_lines(text: str) -> Text:
    """Read a whole text."""
    folded = narrow(text)
    lines = LineIndex(folded)
    found = [match.span() for match in _REMARK.finditer(folded)]
    slashed = any(folded.startswith("//", first) for first, _ in found)
    bare = _REMARK.sub(lambda remark: " " * len(remark[0]), folded)
    reading = _Reading()
    for line in _LINE.finditer(bare):
        if not line[0].isspace():
            _take_line(reading, bare, line.span(), lines)
    reading.close(by_close=False)
    is_power = slashed or any("." in name for name in reading.settings)
    remarks = np.array(found, dtype=np.int64).reshape(-1, 2)
    buffers, unread, beside = tuple(reading.buffers), tuple(reading.unread), tuple(reading.beside)
    return Text(lines, buffers, reading.settings, unread, beside, remarks, is_power)


def _take_line(reading: _Reading, bare: str, span: Span, lines: LineIndex) -> None:
    """One line of a text without remarks."""
    at, past = span
    reading.begin_line(at)
    kept: list[Piece] = []
    for match in _TOKEN.finditer(bare, *span):
        _leave(reading, bare, (at, match.start()))
        at = match.end()
        if match["OPEN"]:
            reading.open(int(match["number"][-9:]), match.span())
        elif match["OTHER"]:
            reading.close(by_close=False)
            reading.is_other = True
        elif match["UNKNOWN"]:
            reading.leave(match.span())
        else:
            _take(reading, _piece(match), kept)
    _leave(reading, bare, (at, past))
    reading.end_line()
    if kept and reading.opened is not None:
        reading.opened.lines.append(Line(tuple(kept), (kept[0].span[0], kept[-1].span[1]), lines.line(span[0])))


def _take(reading: _Reading, piece: Piece, kept: list[Piece]) -> None:
    """A piece that was read; one with a number beyond any that is meant is not."""
    if abs(piece.value) > _LARGEST:  # NaN, of a piece without a number, is not
        reading.unread.append(piece.span)
    else:
        reading.take(piece, kept)


def _leave(reading: _Reading, bare: str, span: Span) -> None:
    """What stands between pieces is nothing of the language, unless it is blank."""
    left = bare[slice(*span)]
    if left and not left.isspace():
        first = span[0] + len(left) - len(left.lstrip())
        reading.leave((first, first + len(left.strip())))


def _piece(match: re.Match[str]) -> Piece:
    kind = Kind.BESIDE if match.lastgroup == "SUM" else Kind[match.lastgroup or "WORD"]
    name = _SPACES.sub("", match[0]).upper()
    if kind is Kind.SETTING:
        name, value = name.split("=")
        return Piece(kind, name, float(value), match.span())
    named = _NAMED.fullmatch(name.rstrip(":")) if kind in {Kind.TIMED, Kind.WORD, Kind.LABEL} else None
    return Piece(kind, named[1] if named else name, float(named[2]) if named else float("nan"), match.span())
