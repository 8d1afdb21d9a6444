"""What the reader could not read: damaged blocks with the first field that is wrong, and other text."""

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from parser.findings.findings import DamagedBlock, Finding
from parser.geometry.curves import Ints
from parser.text.source import LineIndex
from parser.threeb.tokens import FLAGS, LABEL

_INKED_LINE = re.compile(r"[^\s\0-\x1f][^\r\n]*")
# A damaged block reaches from its first B to the first B behind other letters than those between numbers.
_PIECE = re.compile(rf"{LABEL}B(?:[^BGLNSR\r\n]*+B)*+[^BGLNSR\r\n]*+[^B\r\n]*+", FLAGS)
_LABEL = re.compile(LABEL, FLAGS)
_BLOCK_WORD = re.compile(r"B\s*\d|G\s*[XYZ]|\b(?:L|NR|SR)\s*\d", FLAGS)
_NUMBER = re.compile(r"[ \t]*(\d*)[ \t]*", FLAGS)
_WORD = re.compile(r"[ \t]*([^\sB]+|B)?", FLAGS)
_OF_NUMBER = re.compile(r"[^BG]*?(?=[ \t]*(?:[BG]|$))", FLAGS)
_AXIS = re.compile(r"[ \t]*G[ \t]*[XY]", FLAGS)
_TO_AXIS = re.compile(r"[ \t]*(G?[ \t]*[^\sLNSR]?)", FLAGS)
_TO_SENSE = re.compile(r"[ \t]*(?:DD?[ \t]*(?=[LNS]))?((?:[LNSR]+[ \t]*)?[^\s]*)", FLAGS)

_OF_AXIS_AND_SENSE = re.compile(
    r"(?:DD?[ \t]*)?G[ \t]*[XY][ \t]*(?:DD?[ \t]*)?(?:L|[NS][ \t]*R)[ \t]*[1-4](?!\d)", FLAGS
)

_FIELDS = ("field-x", "field-y", "field-count", "field-radius")
_LONGEST_SHOWN = 40


class Unread(NamedTuple):
    """A piece of text that is left out of the path.

    Attributes
    ----------
    span
        Characters to point at: of a damaged block the field that is wrong.
    after
        How many whole blocks stand before it.
    is_block
        Whether a block stood there.
    values
        Of the finding.
    """

    span: tuple[int, int]
    after: int
    is_block: bool
    values: dict[str, str]

    def finding(self, lines: LineIndex) -> Finding:
        """Finding 3B106 of a damaged block, 3B101 of other text."""
        if self.is_block:
            return lines.finding("3B106", self.span, 0, **self.values).with_fact(DamagedBlock())
        return lines.finding("3B101", self.span, 0, **self.values)


def unread(text: str, gaps: Sequence[tuple[int, int]], block_starts: Ints) -> tuple[Unread, ...]:
    """What is damaged in the stretches `gaps` of a text whose whole blocks start at `block_starts`, in order."""
    found = [damage for first, past in gaps for damage in _in_gap(text, first, past)]
    after = np.searchsorted(block_starts, [damage.span[0] for damage in found])
    return tuple(damage._replace(after=int(n)) for damage, n in zip(found, after, strict=True))


def _in_gap(text: str, first: int, past: int) -> Iterator[Unread]:
    for line in _INKED_LINE.finditer(text, first, past):
        at = line.start()
        for piece in _PIECE.finditer(text, *line.span()):
            if not _BLOCK_WORD.search(piece[0]):
                continue
            yield from _other_text(text, at, piece.start())
            whole = _OF_AXIS_AND_SENSE.search(piece[0])
            at = piece.start() + whole.end() if whole else piece.end()
            yield _damaged_block(piece.start(), text[piece.start() : at])
        yield from _other_text(text, at, line.end())


def _other_text(text: str, first: int, past: int) -> Iterator[Unread]:
    inked = _INKED_LINE.search(text, first, past)
    if not inked:
        return
    excerpt = inked[0].rstrip()
    span = inked.start(), inked.start() + len(excerpt)
    if _BLOCK_WORD.search(excerpt):
        yield _wrong(span[0], excerpt, (0, len(excerpt)), "field-b", "wanted-b")
    else:
        yield Unread(span, 0, is_block=False, values={"text": _shortened(excerpt)})


def _damaged_block(base: int, piece: str) -> Unread:
    """The first field of a damaged block, at `base` of the text, that is not what a block has there."""
    at = _met(_LABEL, piece, 0).end()
    for number, field in enumerate(_FIELDS):
        if piece[at : at + 1] not in ("B", "b"):
            if number == 3:
                break  # 3B: the fourth number is 4B's alone
            return _wrong(base, piece, _word_at(piece, at), "field-b", "wanted-b")
        digits = _met(_NUMBER, piece, at + 1)
        at = digits.end()
        if number < 2 and at == len(piece):
            return _wrong(base, piece, (at, at), "field-b", "wanted-b")
        if number < 3 and piece[at : at + 1].isdigit() and piece.upper().count("B") < 3:
            return _wrong(base, piece, _word_at(piece, at), "field-b", "wanted-b")
        if not _ends_number(piece[at:], number):
            return _wrong(base, piece, (digits.start(1), _met(_OF_NUMBER, piece, at).end()), field, "wanted-number")
        if number == 3 and _OF_AXIS_AND_SENSE.match(piece, at):
            return _wrong(base, piece, digits.span(1), field, "wanted-radius")
    return _damaged_end(base, piece, at)


def _damaged_end(base: int, piece: str, at: int) -> Unread:
    """Behind the numbers: the axis or the sense with its quadrant is wrong."""
    axis = _AXIS.match(piece, at)
    if not axis:
        return _wrong(base, piece, _met(_TO_AXIS, piece, at).span(1), "field-axis", "wanted-axis")
    return _wrong(base, piece, _met(_TO_SENSE, piece, axis.end()).span(1), "field-sense", "wanted-sense")


def _ends_number(rest: str, number: int) -> bool:
    """Whether what follows the number (0 to 3) of a block does not belong to it.

    From J on other letters are a later field without its G, unless the G still comes.
    """
    return rest[:1] in ("B", "b", "G", "g") or (number >= 2 and not _AXIS.search(rest) and not rest[:1].isdigit())


def _met(pattern: re.Pattern[str], piece: str, at: int) -> re.Match[str]:
    """What a pattern that fits any text, if only the empty one, matches at a place of a piece."""
    return next(pattern.finditer(piece, at))


def _word_at(piece: str, at: int) -> tuple[int, int]:
    word = _met(_WORD, piece, at)
    return word.span(1) if word[1] else (at, at)


def _wrong(base: int, piece: str, span: tuple[int, int], field: str, wanted: str) -> Unread:
    found = piece[slice(*span)].strip()
    values = {"field": field, "found": _shortened(found) or "nothing", "wanted": wanted}
    return Unread((base + span[0], base + max(span[1], span[0])), 0, is_block=True, values=values)


def _shortened(text: str) -> str:
    return text if len(text) <= _LONGEST_SHOWN else text[:_LONGEST_SHOWN] + "…"
