"""IGES to a document: curves of the plane, exactly, as the standard has them (IGES 5.3, ANS US PRO/IPO-100-1996).

A file has lines of 80 columns; column 73 names the section. The directory has two lines an entity, the parameters are
free, by the delimiters that the global section names. Levels are layers. What is hidden, noted, or not of the plane is
told and not read.
"""

import cmath
import math
import re
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any, Final, NamedTuple

import numpy as np

from parser.drawing.model import UNITS, Unit
from parser.drawing.plots.source import MOST_WAYS, Sheet, Source, arc_places
from parser.findings.catalogue import Remark
from parser.findings.errors import DrawingError

_UNIT_FLAGS: Final = {1: 1, 2: 4, 4: 2, 6: 6, 8: 9, 9: 13, 10: 5, 11: 8}
"""Units of `UNITS` by the flag of the global section; 3 says that the name stands behind it."""
_UNIT_NAMES: Final = {"IN": 1, "INCH": 1, "MM": 4, "FT": 2, "M": 6, "MIL": 9, "UM": 13, "CM": 5, "UIN": 8}
_COLORS: Final = {1: 7, 2: 1, 3: 3, 4: 5, 5: 2, 6: 6, 7: 4, 8: 7}
"""AutoCAD's index of the colours that the standard numbers."""
_FONTS: Final = {2: "DASHED", 3: "PHANTOM", 4: "CENTER", 5: "DOT"}
_UNPLACED: Final = {"01", "03"}  # physically dependent: what others are made of
_DEEPEST: Final = 20
_SAME: Final = 1e-9
_FLAT: Final = 1e-6  # of the file's unit: CAD systems write places of one plane with as much rounding
_NAMES: Final = {128: "surface", 144: "trimmed surface", 186: "solid", 212: "note", 106: "points", 104: "conic"}
_HOLLERITH: Final = re.compile(r"\s*(\d+)H")


class _Entry(NamedTuple):
    """An entity of the directory: its type and form, its status, and how it is drawn and placed."""

    kind: int
    form: int
    transform: int
    status: str
    level: int
    font: int
    color: int
    values: list[str]


class _Frame(NamedTuple):
    """Where an entity lies: its places z are moved to turn · z + shift, or turn · z̄ + shift where it is mirrored."""

    turn: complex = 1.0 + 0.0j
    shift: complex = 0.0j
    is_mirrored: bool = False

    def at(self, place: complex) -> complex:
        """A place."""
        return self.way(place) + self.shift

    def way(self, by: complex) -> complex:
        """A way."""
        return self.turn * (by.conjugate() if self.is_mirrored else by)

    def of(self, inner: "_Frame") -> "_Frame":
        """The frame of what lies in another frame, which lies in this one."""
        return _Frame(self.way(inner.turn), self.at(inner.shift), self.is_mirrored != inner.is_mirrored)


class _NotReadError(Exception):
    """Raised where an entity is none of the plane, or of a form that nobody reads."""


def iges_source(text: str) -> Source:
    """The document of an IGES file. DrawingError where it has no directory, or a damaged one."""
    try:
        sections = _sections(text)
        first, ends = _delimiters(sections["G"])
        header = _split("".join(sections["G"]), first, ends)
        entries = _entries(sections, first, ends)
    except (ValueError, LookupError) as error:
        raise DrawingError("iges-damaged", why=type(error).__name__) from None
    pen = _Pen(entries)
    for number in entries:
        pen.draw(number)
    notes = list(pen.notes())
    unit = _unit(header)
    if unit is None:
        notes.append(Remark("no-iges-unit"))
    return Source(pen.sheet.document, "IGES", unit or UNITS[4], tuple(notes))


def _sections(text: str) -> dict[str, list[str]]:
    """The first 72 columns of the lines of each section, in order."""
    found: dict[str, list[str]] = {}
    for line in text.splitlines():
        if len(line) > 72 and line[72] in "SGDPT":
            found.setdefault(line[72], []).append(line[:72])
    return found


def _delimiters(lines: list[str]) -> tuple[str, str]:
    """What parts parameters, and what ends a record: the first two parameters of the global section."""
    head = "".join(lines)
    first = head[2] if head.startswith("1H") else ","
    rest = head[4:] if head.startswith("1H") else head[1:]
    return first, rest[2] if rest.startswith("1H") else ";"


def _split(record: str, parts: str, ends: str) -> list[str]:
    """Parameters of a record up to its end; strings may hold the delimiters, and say how long they are."""
    found, at = list[str](), 0
    while at < len(record):
        string = _HOLLERITH.match(record, at)
        if string:
            past = string.end() + int(string[1])
            found.append(record[string.end() : past])
            at = past
            while at < len(record) and record[at] not in parts + ends:
                at += 1
        else:
            past = min((each for each in (record.find(parts, at), record.find(ends, at)) if each >= 0), default=-1)
            past = len(record) if past < 0 else past
            found.append(record[at:past].strip())
            at = past
        if at >= len(record) or record[at] == ends:
            break
        at += 1
    return found


def _entries(sections: dict[str, list[str]], parts: str, ends: str) -> dict[int, _Entry]:
    """The entities by the numbers of their first lines in the directory."""
    records: dict[int, list[str]] = {}
    for line in sections.get("P", []):
        records.setdefault(int(line[64:72]), []).append(line[:64])
    lines = sections["D"]
    found: dict[int, _Entry] = {}
    for at in range(0, len(lines) - 1, 2):
        upper, lower = ([line[begin : begin + 8] for begin in range(0, 72, 8)] for line in lines[at : at + 2])
        status = upper[8].replace(" ", "0").rjust(8, "0")
        numbers = [
            int(text) if text.strip() else 0 for text in (upper[0], lower[4], upper[6], upper[4], upper[3], lower[2])
        ]
        kind, form, transform, level, font, color = numbers
        values = _split("".join(records.get(at + 1, [])), parts, ends)
        found[at + 1] = _Entry(kind, form, transform, status, level, font, color, values[1:])
    return found


def _unit(header: list[str]) -> Unit | None:
    """The unit that the header names; None where it names none that is known."""
    flag = header[13] if len(header) > 13 else ""
    name = header[14].strip().upper() if len(header) > 14 else ""
    code = _UNIT_FLAGS.get(int(flag) if flag.isdigit() else 0) or _UNIT_NAMES.get(name)
    return UNITS[code] if code else None


def _number(text: str) -> float:
    """A number as Fortran writes it: D may stand for E, and nothing for 0. ValueError for none, or one without end."""
    value = float(text.upper().replace("D", "E")) if text else 0.0
    if not math.isfinite(value):
        raise ValueError
    return value


class _Pen:
    """Draws entities into a sheet, each where it lies; and counts those that it does not."""

    def __init__(self, entries: dict[int, _Entry]) -> None:
        self.sheet = Sheet()
        self._entries, self._passed_over = entries, Counter[str]()
        self._placed = 0
        self._draw_as: dict[int, Callable[[_Entry, _Frame, dict[str, Any]], None]] = {
            100: self._arc,
            104: self._conic,
            106: self._points,
            110: self._line,
            112: self._cubics,
            116: self._point,
            126: self._spline,
        }

    def draw(self, number: int) -> None:
        """An entity that stands by itself, or one whole thing: others are drawn where they are placed."""
        entry = self._entries[number]
        if entry.status[2:4] not in _UNPLACED and entry.kind not in {0, 124, 308, 314, 404, 406, 410}:
            self._place(number, _Frame(), 0)

    def notes(self) -> Iterator[Remark]:
        """What is to be said of entities that are not read."""
        if self._passed_over:
            listed = ", ".join(f"{number} × {name}" for name, number in sorted(self._passed_over.items()))
            yield Remark("iges-passed-over", {"entities": listed})

    def _place(self, number: int, frame: _Frame, deep: int) -> None:
        entry = self._entries.get(number)
        self._placed += 1
        if self._placed > 4 * MOST_WAYS or deep > _DEEPEST:
            raise DrawingError("plot-too-long", most=MOST_WAYS)
        if entry is None:
            return
        if entry.status[:2] == "01" or entry.status[4:6] == "01" or 200 <= entry.kind < 300:
            self._passed_over["hidden" if entry.status[:2] == "01" else "note"] += 1
            return
        try:
            own = frame.of(self._frame(entry.transform, 0))
            if entry.kind in {102, 402}:
                for each in entry.values[1:]:
                    self._place(int(each), own, deep + 1)
            elif entry.kind == 408:
                self._place_block(entry, own, deep)
            elif entry.kind in self._draw_as:
                self._draw_as[entry.kind](entry, own, _look(entry))
            else:
                raise _NotReadError
        except (_NotReadError, ValueError, LookupError, ArithmeticError, np.linalg.LinAlgError):
            self._passed_over[_NAMES.get(entry.kind, f"entity {entry.kind}")] += 1

    def _place_block(self, entry: _Entry, frame: _Frame, deep: int) -> None:
        """A subfigure where it is placed, of its size."""
        x, y, _, size = (_number(text) for text in (*entry.values[1:4], (entry.values + ["1"] * 5)[4] or "1"))
        own = frame.of(_Frame(complex(size), complex(x, y)))
        block = self._entries.get(int(entry.values[0]))
        if block is None or block.kind != 308:
            raise _NotReadError
        for each in block.values[3 : 3 + int(block.values[2])]:
            self._place(int(each), own, deep + 1)

    def _frame(self, number: int, deep: int) -> _Frame:
        """A transformation, which may lie in another one. _NotReadError where it tilts the plane."""
        if not number:
            return _Frame()
        entry = self._entries.get(number)
        if entry is None or entry.kind != 124 or deep > _DEEPEST:
            raise _NotReadError
        rows = np.array([_number(text) for text in entry.values[:12]]).reshape(3, 4)
        turn = complex(rows[0, 0], rows[1, 0])
        across = complex(rows[0, 1], rows[1, 1])
        is_mirrored = bool((turn.conjugate() * across).imag < 0.0)
        tilt = np.abs([*rows[:2, 2], *rows[2, :2]]).max()
        if tilt > 1e-6 or abs(across - turn * (-1j if is_mirrored else 1j)) > 1e-6:
            raise _NotReadError
        own = _Frame(turn, complex(rows[0, 3], rows[1, 3]), is_mirrored)
        return self._frame(entry.transform, deep + 1).of(own) if entry.transform else own

    def _line(self, entry: _Entry, frame: _Frame, look: dict[str, Any]) -> None:
        x1, y1, z1, x2, y2, z2 = (_number(text) for text in entry.values[:6])
        if entry.form or abs(z2 - z1) > _FLAT:
            raise _NotReadError  # without an end, or not of the plane
        self.sheet.line(frame.at(complex(x1, y1)), frame.at(complex(x2, y2)), **look)

    def _arc(self, entry: _Entry, frame: _Frame, look: dict[str, Any]) -> None:
        """Counter-clockwise from one place to another about a centre; a circle where both are one."""
        numbers = [_number(text) for text in entry.values[1:7]]
        center, start, end = (complex(*numbers[at : at + 2]) for at in (0, 2, 4))
        if abs(end - start) <= _SAME * abs(start - center):
            self.sheet.circle(frame.at(center), abs(frame.turn) * abs(start - center), **look)
            return
        sweep = cmath.phase((end - center) / (start - center)) % (2.0 * math.pi)
        center, start, end = frame.at(center), frame.at(start), frame.at(end)
        sweep = -sweep if frame.is_mirrored else sweep
        places, bulges = zip(*arc_places(start, center, sweep, end), strict=True)
        self.sheet.way([start, *places], [*bulges], **look)

    def _conic(self, entry: _Entry, frame: _Frame, look: dict[str, Any]) -> None:
        """An ellipse A x² + B x y + C y² + D x + E y + F = 0, counter-clockwise from one place to another."""
        a, b, c, d, e, f, _, *places = (_number(text) for text in entry.values[:11])
        form = np.array([[a, 0.5 * b], [0.5 * b, c]])
        if np.linalg.det(form) <= 0.0:
            raise _NotReadError  # a parabola or a hyperbola
        middle = np.linalg.solve(form, [-0.5 * d, -0.5 * e])
        sizes, axes = np.linalg.eigh(form)
        halves = np.sqrt(-(f + 0.5 * (d * middle[0] + e * middle[1])) / sizes)
        if not np.isfinite(halves).all() or not halves.all():
            raise _NotReadError
        longer = int(np.argmax(halves))
        center, major = complex(*middle), complex(*axes[:, longer]) * halves[longer]
        ratio = float(halves[1 - longer] / halves[longer])
        first, last = (
            cmath.phase(complex(by.real, by.imag / ratio))
            for by in ((complex(*places[at : at + 2]) - center) / major for at in (0, 2))
        )
        last = last if last > first + _SAME else last + 2.0 * math.pi
        params = (-last, -first) if frame.is_mirrored else (first, last)
        self.sheet.ellipse(frame.at(center), frame.way(major), ratio, params, **look)

    def _points(self, entry: _Entry, frame: _Frame, look: dict[str, Any]) -> None:
        """A line from place to place: of forms 11 to 13 and 63; others are points, or signs of a draughtsman."""
        if entry.form not in {11, 12, 13, 63}:
            raise _NotReadError
        kind, number = int(entry.values[0]), int(entry.values[1])
        step, begin = {1: (2, 3), 2: (3, 2), 3: (6, 2)}[kind]
        rows = np.array([_number(text) for text in entry.values[begin : begin + step * number]]).reshape(number, step)
        if step > 2 and np.ptp(rows[:, 2]) > _FLAT:
            raise _NotReadError
        places = [frame.at(complex(x, y)) for x, y in rows[:, :2].tolist()]
        self.sheet.way(places, [0.0] * (number - 1), **look)

    def _point(self, entry: _Entry, frame: _Frame, look: dict[str, Any]) -> None:
        x, y = (_number(text) for text in entry.values[:2])
        self.sheet.point(frame.at(complex(x, y)), **look)

    def _cubics(self, entry: _Entry, frame: _Frame, look: dict[str, Any]) -> None:
        """Cubics one behind the other, each by the coefficients of its parameter from 0 on."""
        number = int(entry.values[3])
        knots = [_number(text) for text in entry.values[4 : 5 + number]]
        for at in range(number):
            begin = 5 + number + 12 * at
            rows = np.array([_number(text) for text in entry.values[begin : begin + 12]]).reshape(3, 4)
            if np.abs(rows[2, 1:]).max() > _FLAT:
                raise _NotReadError
            a, b, c, d = (complex(x, y) for x, y in (rows[:2] * (knots[at + 1] - knots[at]) ** np.arange(4)).T.tolist())
            places = [a, a + b / 3.0, a + (2.0 * b + c) / 3.0, a + b + c + d]
            self.sheet.bezier([frame.at(place) for place in places], **look)

    def _spline(self, entry: _Entry, frame: _Frame, look: dict[str, Any]) -> None:
        """A rational B-spline, all of it."""
        last, degree = int(entry.values[0]), int(entry.values[1])
        if not 1 <= degree <= 10 or not degree <= last < MOST_WAYS:
            raise _NotReadError
        number = last + 1
        values = [_number(text) for text in entry.values[6 : 6 + (number + degree + 1) + 4 * number + 2]]
        knots, values = values[: number + degree + 1], values[number + degree + 1 :]
        weights, values = values[:number], values[number:]
        places, (low, high) = np.array(values[: 3 * number]).reshape(number, 3), values[3 * number : 3 * number + 2]
        slack = 1e-6 * (knots[-1] - knots[0])
        if np.ptp(places[:, 2]) > _FLAT or abs(low - knots[degree]) > slack or abs(high - knots[number]) > slack:
            raise _NotReadError  # not of the plane, or a part of it
        self.sheet.spline(degree, knots, weights, [frame.at(complex(x, y)) for x, y in places[:, :2].tolist()], **look)


def _look(entry: _Entry) -> dict[str, Any]:
    """Layer, colour and linetype of an entity."""
    look: dict[str, Any] = {"layer": f"LEVEL {entry.level}" if entry.level > 0 else "0"}
    if entry.color in _COLORS:
        look["color"] = _COLORS[entry.color]
    if entry.font in _FONTS:
        look["linetype"] = _FONTS[entry.font]
    return look
