"""One line that holds more than well-formed words: skipped, titles, assignments, functions, macros, what is no word."""

import re
from typing import NamedTuple

from parser.iso.listing.listing import Assignment, Form, Statement

LARGEST = 1e15
"""Numbers beyond it, either way, are held at it: they are out of the range of any word."""

_NUMBER = r"(?:[-+][ \t]*)?(?:\d+\.?\d*|\.\d+)"
_TERM = rf"(?:{_NUMBER}|[A-Za-z][ \t]*\d+)"
_WORD = re.compile(rf"([A-Za-z])[ \t]*({_NUMBER})", re.ASCII)
_PIECE = re.compile(r"[A-Za-z]{3,}[-+.\d]*|[A-Za-z][ \t]*(?:[-+.\d][-+.\d \t]*)?|[^A-Za-z \t]+(?:[ \t]+[^A-Za-z \t]+)*")
_SKIP = re.compile(r"/\d?[ \t]*", re.ASCII)
_BLOCK_NUMBER = re.compile(r"([Nn])[ \t]*(\d+)[ \t]*(?=[A-Za-z])", re.ASCII)
_REGISTER = re.compile(
    rf"([HDhd])[ \t]*(\d+)[ \t]*=[ \t]*({_TERM}(?:[ \t]*(?:\+[ \t]*|(?=-)){_TERM})*)[ \t]*", re.ASCII
)
_TERMS = re.compile(rf"({_NUMBER})|([A-Za-z])[ \t]*(\d+)", re.ASCII)
_SETTING = re.compile(r"[A-CE-GI-Za-ce-gi-z][ \t]*\d*[ \t]*=.*", re.ASCII)
_FUNCTION = re.compile(r"[A-Za-z]{2,}\d*[ \t]*\([^()]*\)", re.ASCII)
_MACRO = re.compile(
    r"[\[\]]|\A#|(?<![A-Z])[A-Z][ \t]*[-+]?[ \t]*#|\b(?:GOTO|DO|END)[ \t]*\d|\b(?:IF|WHILE)\b", re.IGNORECASE
)
_FEED = re.compile(r"F[ \t]*#[ \t]*\d+(?![\w.])", re.ASCII | re.IGNORECASE)
_TEXT = re.compile(r"[^\W\d_]{3,}|[^\x00-\x7f]")
_MOVING = re.compile(r"[GXY][ \t]*[-+]?[ \t]*\.?\d", re.IGNORECASE)


class OddWord(NamedTuple):
    """A word of an odd line: as a row of `parser.iso.listing.Words`, but for its block."""

    letter: int
    value: float
    decimals: int
    first: int
    past: int


class Bad(NamedTuple):
    """A piece that is no word: the code of its finding, and its span."""

    code: str
    span: tuple[int, int]


class OddLine(NamedTuple):
    """What an odd line holds; the blocks of assignments and statements are not known here, and are 0.

    Attributes
    ----------
    span
        First character, and one past the last, without blanks at its ends.
    is_title
        Whether it is text without remark signs: no block.
    is_skipped
        Whether it begins with ``/``.
    words, assignments, statements, bad
        In the order of the line.
    """

    span: tuple[int, int]
    is_title: bool = False
    is_skipped: bool = False
    words: tuple[OddWord, ...] = ()
    assignments: tuple[Assignment, ...] = ()
    statements: tuple[Statement, ...] = ()
    bad: tuple[Bad, ...] = ()

    @property
    def is_damaged(self) -> bool:
        """Whether its motion is not known."""
        return bool(self.bad) or any(statement.form is Form.MACRO for statement in self.statements)


def odd_line(line: str, at: int, *, may_be_title: bool) -> OddLine:
    """What a line holds that is not blank; its first character stands at `at` of the text (docs/iso.md §1)."""
    feeds = [found.span() for found in _FEED.finditer(line)]
    if not feeds:
        return _odd_line(line, at, may_be_title=may_be_title)
    read = _odd_line(_FEED.sub(lambda found: " " * len(found[0]), line), at, may_be_title=False)
    stated = (Statement(Form.FEED, 0, (at + first, at + past)) for first, past in feeds)
    return read._replace(span=(at, at + len(line)), statements=(*read.statements, *stated))


def _odd_line(line: str, at: int, *, may_be_title: bool) -> OddLine:
    span = at, at + len(line)
    if _MACRO.search(line):
        return OddLine(span, statements=(Statement(Form.MACRO, 0, span),))
    if _FUNCTION.fullmatch(line):
        return OddLine(span, statements=(Statement(Form.FUNCTION, 0, span),))
    if "=" not in line and _TEXT.search(line) and not _MOVING.search(line):
        return OddLine(span, is_title=True) if may_be_title else OddLine(span, bad=(Bad("ISO101", span),))
    skip = _SKIP.match(line)
    since = skip.end() if skip else 0
    read = _set(line, at, since) or _two_planes(line, at, since) or _words(line, at, since)
    return read._replace(span=span, is_skipped=skip is not None)


def _set(line: str, at: int, since: int) -> OddLine | None:
    """A line that sets registers, or something else; None where it sets nothing."""
    if "=" not in line:
        return None
    numbered = _BLOCK_NUMBER.match(line, since)
    words = (_word(numbered, at),) if numbered else ()
    since = numbered.end() if numbered else since
    if _SETTING.fullmatch(line, since):
        return OddLine((at, at), words=words, statements=(Statement(Form.SETTING, 0, (at + since, at + len(line))),))
    assignments: list[Assignment] = []
    while since < len(line):
        register = _REGISTER.match(line, since)
        if not register:
            return OddLine((at, at), words=words, bad=(Bad("ISO102", (at + since, at + len(line))),))
        assignments.append(_assignment(register, at))
        since = register.end()
    return OddLine((at, at), words=words, assignments=tuple(assignments))


def _assignment(register: re.Match[str], at: int) -> Assignment:
    terms = tuple(
        _number(number) if number else _name(letter, digits) for number, letter, digits in _TERMS.findall(register[3])
    )
    return Assignment(0, _name(register[1], register[2]), terms, (at + register.start(), at + register.end(3)))


def _two_planes(line: str, at: int, since: int) -> OddLine | None:
    """Upper contour, colon, lower contour; None where there are no words on both sides."""
    colon = line.find(":")
    if colon < 0 or not (_WORD.search(line, since, colon) and _WORD.search(line, colon)):
        return None
    numbered = _BLOCK_NUMBER.match(line, since)
    lower = _words(line, at, colon + 1)
    first = numbered.end() if numbered else since
    return lower._replace(
        words=(*((_word(numbered, at),) if numbered else ()), *lower.words),
        statements=(Statement(Form.TWO_PLANES, 0, (at + first, at + colon + 1)),),
    )


def _words(line: str, at: int, since: int) -> OddLine:
    words: list[OddWord] = []
    bad: list[Bad] = []
    for piece in _PIECE.finditer(line, since):
        past = piece.start() + len(piece[0].rstrip(" \t"))
        word = _WORD.fullmatch(line, piece.start(), past)
        if word:
            words.append(_word(word, at))
        else:
            is_letter = piece[0][0].isascii() and piece[0][0].isalpha() and not _TEXT.match(piece[0])
            bad.append(Bad("ISO102" if is_letter else "ISO101", (at + piece.start(), at + past)))
    return OddLine((at, at), words=tuple(words), bad=tuple(bad))


def _word(match: re.Match[str], at: int) -> OddWord:
    return OddWord(ord(match[1].upper()), *_number(match[2]), at + match.start(1), at + match.end(2))


def _number(figure: str) -> tuple[float, int]:
    """A number as written, and the digits behind its point, −1 without a point."""
    figure = figure.replace(" ", "").replace("\t", "")
    value = max(-LARGEST, min(float(figure), LARGEST)) + 0.0
    return value, len(figure) - figure.index(".") - 1 if "." in figure else -1


def _name(letter: str, digits: str) -> str:
    """Of a register, without leading zeros."""
    return f"{letter.upper()}{digits.lstrip('0') or '0'}"
