"""The header that CAXA writes over a program (docs/3b.md §2): read and kept."""

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from parser.dialect.reader import HeaderValue
from parser.units import UM_PER_MM, from_mm

_FLAGS = re.IGNORECASE | re.ASCII
_VALUE = r"\s*[=:]?\s*"
_MM = r"([-+]?\d{1,12}(?:\.\d{0,12})?)"
_NAME = re.compile(rf"\bName{_VALUE}([^,;\r\n]*)", _FLAGS)
_VERSION = re.compile(r"\bVersion\s*[=:]?\s*([^\s,;]+)", _FLAGS)
_CORNER = re.compile(rf"\bCo(?:nn?|rn)er\s*R{_VALUE}{_MM}", _FLAGS)
_OFFSET = re.compile(rf"\bOffset\s*F{_VALUE}{_MM}", _FLAGS)
_LENGTH = re.compile(rf"\bLength{_VALUE}{_MM}", _FLAGS)


class HeaderLength(NamedTuple):
    """A path length as the header gives it.

    `um` with half of its last printed digit, `half_digit_um`, and its span of characters.
    """

    um: float
    half_digit_um: float
    span: tuple[int, int]


class Header(NamedTuple):
    """What the header lines say; lengths µm, None or empty where they do not say it.

    `offset_span` are the characters of the offset.
    """

    version: str = ""
    name: str = ""
    corner_radius_um: float | None = None
    offset_um: float | None = None
    lengths: tuple[HeaderLength, ...] = ()
    offset_span: tuple[int, int] | None = None

    @property
    def values(self) -> Mapping[str, HeaderValue]:
        """What it says, by the keys of the report."""
        return {
            "version": self.version,
            "name": self.name,
            "corner_radius_um": self.corner_radius_um,
            "offset_um": self.offset_um,
            "lengths_um": tuple(length.um for length in self.lengths),
        }


def read_header(text: str, spans: Sequence[tuple[int, int]], more_lengths: Sequence[HeaderLength]) -> Header:
    """Header of the header lines at `spans`; the first line that gives a value counts. `more_lengths` join its own."""
    rows = [text[first:past] for first, past in spans]
    lengths = [length for span in spans for length in read_length(text, span)]
    return Header(
        version=_first(_VERSION, rows),
        name=_first(_NAME, rows).strip(),
        corner_radius_um=_first_um(_CORNER, rows),
        offset_um=_first_um(_OFFSET, rows),
        lengths=tuple(sorted([*lengths, *more_lengths], key=lambda length: length.span)),
        offset_span=next((match.span() for span in spans if (match := _OFFSET.search(text, *span))), None),
    )


def read_length(text: str, span: tuple[int, int]) -> list[HeaderLength]:
    """The length that a header line or a start node gives, if it gives one."""
    match = _LENGTH.search(text, *span)
    if not match:
        return []
    decimals = len(match[1].partition(".")[2])
    return [HeaderLength(from_mm(float(match[1])), UM_PER_MM / 2.0 / 10.0**decimals, match.span())]


def _first(pattern: re.Pattern[str], rows: Sequence[str]) -> str:
    return next((match[1] for row in rows if (match := pattern.search(row))), "")


def _first_um(pattern: re.Pattern[str], rows: Sequence[str]) -> float | None:
    digits = _first(pattern, rows)
    return from_mm(float(digits)) if digits else None
