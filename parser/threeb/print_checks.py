"""What a program prints beside its blocks: the header of CAXA, and findings about printed ends and lengths.

The header that CAXA writes over a program (docs/3b.md §2): read and kept.

Findings about figures that a program prints beside its blocks: their ends and their length.
"""

import math
import re
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.dialect.reader import HeaderValue
from parser.findings.findings import Finding, PrintedElsewhere, Value
from parser.geometry.curves import Floats, Ints, total_before
from parser.shape.contours import corners_at
from parser.text.encoding import narrow
from parser.text.source import LineIndex
from parser.toolpath import Toolpath
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


_HALF_DIGITS = 3.0
"""A printed end that is off by this many halves of its last digit is wrong: 2 µm, rounded to 1 µm, are 1.5 µm or more.

Sound ends, rounded to half a digit on both axes, lie within 2·sqrt(2) halves of one another."""
_FINEST_HALF_DIGIT_UM = 0.5  # blocks are whole µm
_ERROR_UM = 5.0
"""From here on the block is damaged. Ends that a CAM prints as drawn, not as its whole µm decode, lie some µm off."""
_ROUNDING_UM = 1e-6
_ADVICE = {True: "correct-print", False: "restore-block", None: "compare-print"}
"""Terms of what to do, by whether the printed end is wrong alone."""
_LONGEST_PRINT = 120
_PRINT = re.compile(r"[ \t]*;[ \t]*([-+]?\d*(?:\.(\d*))?[ \t]*,[ \t]*[-+]?\d*(?:\.(\d*))?)")
_LENGTH_UM_PER_BLOCK = 1.0  # words are rounded to 1 µm


def print_findings(toolpath: Toolpath, header: Header, lines: LineIndex, damaged: Ints) -> list[Finding]:
    """Printed ends that differ from the decoded ends (3B207, 3B213), header lengths from the decoded length (3B108).

    `damaged` are the characters (m,) at which blocks are missing: neither is judged by what these would have done.
    """
    missing = np.searchsorted(toolpath.source.span[:, 0], damaged)
    found = list(_misprinted(toolpath, lines, missing))
    return found if len(damaged) else [*found, *_wrong_lengths(toolpath, header, lines)]


class _Misprint(NamedTuple):
    """A row whose printed end lies off the decoded end.

    `is_far` tells whether it lies `_ERROR_UM` or more farther off than after the last that did. `is_alone` tells
    whether the printed ends behind it agree with those before it; None where there are none behind it.
    """

    row: int
    is_far: bool
    is_alone: bool | None


def _misprints(toolpath: Toolpath, missing: Ints) -> list[_Misprint]:
    """Rows at which the printed end begins to lie off the decoded end, or to lie off it by another way than before.

    Before the rows `missing` blocks are missing: the first printed end behind such a gap is not judged, and the next
    ones are compared with it. Where one printed end alone is wrong, the next ones are compared with those before it.
    """
    rows, off = _shifts(toolpath)
    if not _may_be_apart(off).any():
        return []
    gaps = np.searchsorted(missing, rows, side="right").tolist()
    shifts: list[list[float]] = off[1:].tolist()
    found: list[_Misprint] = []
    kept_shifts, base, gap = [0.0, 0.0], [0.0, 0.0], 0
    for at, row in enumerate(rows.tolist()):
        if gaps[at] != gap:
            kept_shifts = base = shifts[at]
            gap = gaps[at]
        elif _apart(toolpath, row, shifts[at], kept_shifts):
            is_far = math.dist(shifts[at], base) >= _ERROR_UM - _ROUNDING_UM
            is_alone = not _apart(toolpath, row, shifts[at + 1], kept_shifts) if at + 1 < len(rows) else None
            found.append(_Misprint(row, is_far, is_alone))
            if not is_alone:
                kept_shifts = shifts[at]
                base = kept_shifts if is_far else base
    return found


def is_misprint(toolpath: Toolpath, row: int) -> bool | None:
    """Whether the end printed beside a row is wrong, and not its block: then those before and after it agree.

    Of the last printed end a corner of its contour tells: where it lies on one, it is right. None where nothing tells.
    """
    rows, off = _shifts(toolpath)
    at = int(np.searchsorted(rows, row)) + 1
    if at + 1 < len(off):
        return not _apart(toolpath, row, off[at + 1].tolist(), off[at - 1].tolist())
    jumps = np.flatnonzero(toolpath.is_jump[:row])
    begin = int(jumps[-1]) + 1 if len(jumps) else 0
    closes = corners_at(toolpath, begin, row, toolpath.end_um[row] + off[at] - off[at - 1]).size > 0
    return False if closes else None


def _shifts(toolpath: Toolpath) -> tuple[Ints, Floats]:
    """Rows (m,) with printed ends, and how far (m + 1, 2) µm these lie off the decoded ones; (0, 0) for the start."""
    rows = np.flatnonzero(~np.isnan(toolpath.printed_end_um[:, 0]))
    return rows, np.concatenate([np.zeros((1, 2)), toolpath.printed_end_um[rows] - toolpath.end_um[rows]])


def _may_be_apart(off: Floats) -> NDArray[np.bool_]:
    may: NDArray[np.bool_] = np.hypot(off[:, 0], off[:, 1]) >= _HALF_DIGITS * _FINEST_HALF_DIGIT_UM - _ROUNDING_UM
    return may


def _apart(toolpath: Toolpath, row: int, this: Sequence[float], other: Sequence[float]) -> bool:
    """Whether two shifts differ by more than the rounding of the end printed beside a row."""
    off = math.hypot(this[0] - other[0], this[1] - other[1])
    if off < _HALF_DIGITS * _FINEST_HALF_DIGIT_UM - _ROUNDING_UM:
        return False
    return off >= _HALF_DIGITS * _half_digit_um(toolpath, row) - _ROUNDING_UM


def _half_digit_um(toolpath: Toolpath, row: int) -> float:
    """Half of the last digit to which the end beside a row is printed; of the coarser number of the two."""
    match = _print(toolpath, row)
    decimals = min(len(digits or "") for digits in match.groups()[1:]) if match else 3
    return max(UM_PER_MM / 2.0 / 10.0**decimals, _FINEST_HALF_DIGIT_UM)


def _print(toolpath: Toolpath, row: int) -> re.Match[str] | None:
    past = int(toolpath.source.span[row, 1])
    return _PRINT.match(narrow(toolpath.source.text[past : past + _LONGEST_PRINT]))


def _print_span(toolpath: Toolpath, row: int) -> tuple[int, int]:
    """Characters of the end printed beside a row; of its block where it is too long to be looked at."""
    first, past = toolpath.source.span[row].tolist()
    match = _print(toolpath, row)
    return (past + match.start(1), past + match.end(1)) if match else (first, past)


def print_change(toolpath: Toolpath, row: int) -> Floats:
    """(2,) µm from where the path leads, if it runs on from the last end printed before a row, to the row's own one.

    Where no end is printed before, the path runs on from where the program starts.
    """
    rows, off = _shifts(toolpath)
    at = int(np.searchsorted(rows, row)) + 1
    change: Floats = off[at] - off[at - 1]
    return change


def ends_as_printed(toolpath: Toolpath, row: int) -> bool:
    """Whether the path leads from the last printed end to the one printed beside a row; False where none is printed."""
    if np.isnan(toolpath.printed_end_um[row]).any():
        return False
    return not _apart(toolpath, row, print_change(toolpath, row).tolist(), (0.0, 0.0))


def _misprinted(toolpath: Toolpath, lines: LineIndex, missing: Ints) -> Iterator[Finding]:
    for row, is_far, is_alone in _misprints(toolpath, missing):
        (px, py), (x, y) = toolpath.printed_end_um[row].tolist(), toolpath.end_um[row].tolist()
        off = float(np.hypot(px - x, py - y))
        values: dict[str, Value] = {"px": px, "py": py, "x": x, "y": y, "off": off}
        span = _print_span(toolpath, row)
        if is_far:
            values["advice"] = _ADVICE[is_alone]
            yield lines.finding("3B207", span, row + 1, **values).with_fact(PrintedElsewhere())
        else:
            yield lines.finding("3B213", span, row + 1, **values)


def _wrong_lengths(toolpath: Toolpath, header: Header, lines: LineIndex) -> Iterator[Finding]:
    cut = np.where(toolpath.is_jump, 0.0, toolpath.length_um)
    runs = [total_before(column) for column in (cut, toolpath.length_um)]
    stops = [*(stop.after for stop in toolpath.stops), len(toolpath)]
    for length in header.lengths:
        after = int(np.searchsorted(toolpath.source.span[:, 0], length.span[0]))
        past = stops[min(bisect_right(stops, after), len(stops) - 1)]
        meant = _lengths(runs, after, past)
        off = np.abs(meant - length.um)
        if off.min() > length.half_digit_um + _LENGTH_UM_PER_BLOCK * len(toolpath):
            nearest = float(meant[np.argmin(off)])
            yield lines.finding("3B108", length.span, header=length.um, decoded=nearest)


def _lengths(runs: list[Floats], after: int, past: int) -> Floats:
    """Lengths that a header may mean, µm: of the cuts or of the whole way, in all, behind it, or in its own figure.

    `runs` are the cuts and the whole way, each as its length before each row and after the last.
    """
    meant = [(run[-1], run[-1] - run[after], run[past] - run[after]) for run in runs]
    return np.array(meant).ravel()
