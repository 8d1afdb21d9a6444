"""A slow, plain interpreter of ISO: one block at a time with its state in hand, to prove the array code against.

It takes programs as `random_iso` writes them: every word known, integers µm, numbers with a point mm, I J from the
start until G90.1, all calls found.
"""

import cmath
import math
import re
from dataclasses import dataclass, field
from typing import NamedTuple

LINE, ARC, JUMP = 0, 1, 2
MM_PER_INCH = 25.4


Arc = tuple[complex | None, float]
"""Centre and sweep; none of an arc that nothing makes one."""


class PlainRow(NamedTuple):
    kind: int
    start: complex
    end: complex
    center: complex | None
    sweep: float
    side: int
    by: float
    register: str
    line: int
    label: str


@dataclass
class PlainIso:
    """State of the controller, and what it did so far; places are complex numbers in µm."""

    lines: list[str]
    registers: dict[str, float] = field(default_factory=dict)
    rows: list[PlainRow] = field(default_factory=list)
    stops: list[tuple[str, int, int]] = field(default_factory=list)
    motion: int | None = None
    absolute: bool = True
    absolute_centers: bool = False
    inch: bool = False
    side: int = 0
    register: str = ""
    name: complex = 0j  # what the place of the wire is called
    shift: complex = 0j  # what is to be added to such names
    begun: bool = False
    stopped: bool = False
    ended: bool = False

    def run(self, line: int = 0) -> None:
        """From a line, counted from 0, up to the return, the end code, or the end of the text."""
        while line < len(self.lines) and not self.ended:
            words = _words(self.lines[line])
            self._obey(line, words)
            if words.get("M") == "98":
                for _ in range(int(words.get("L", "1"))):
                    if not self.ended:
                        self.run(self._label(int(words["P"])))
            if words.get("M") == "99":
                return
            line += 1

    def _label(self, number: int) -> int:
        end = next(at for at, text in enumerate(self.lines) if "M02" in text)
        return next(at for at, text in enumerate(self.lines) if at > end and _words(text).get("N") == f"{number:04}")

    def _obey(self, line: int, words: dict[str, str]) -> None:
        text = self.lines[line]
        if "=" in text:
            name, value = text.split("=")
            terms = [part.strip() for part in value.split("+")]
            self.registers[_register(name)] = sum(self._term(term) for term in terms)
            return
        codes = [float(code) for code in re.findall(r"G([\d.]+)", text)]
        self._take(codes, words)
        if 92.0 in codes:
            self._name_place(line, words)
        elif 4.0 not in codes:
            self._move(line, words)
        if words.get("M") in {"00", "01", "21", "02"}:
            kind = "end" if words["M"] == "02" else "pause"
            self.stops.append((kind, len(self.rows), line + 1))
            self.stopped, self.ended = True, kind == "end"

    def _take(self, codes: list[float], words: dict[str, str]) -> None:
        for code in codes:
            if code in {0.0, 1.0, 2.0, 3.0}:
                self.motion = int(code)
            self.absolute = {90.0: True, 91.0: False}.get(code, self.absolute)
            self.absolute_centers = {90.1: True, 91.1: False}.get(code, self.absolute_centers)
            self.inch = {20.0: True, 21.0: False}.get(code, self.inch)
            self.side = {40.0: 0, 41.0: 1, 42.0: -1}.get(code, self.side)
        for letter in "DH":
            if letter in words:
                self.register = f"{letter}{int(words[letter])}"

    def _name_place(self, line: int, words: dict[str, str]) -> None:
        x, y = self._um(words.get("X")), self._um(words.get("Y"))
        if x is None and y is None:
            x = y = 0.0
        named = complex(self.name.real if x is None else x, self.name.imag if y is None else y)
        here = self._here
        self.name = named
        if not self.begun:
            self.begun = True
        elif self.stopped:
            if self._here != here:
                self._add(line, words, JUMP, here, (None, 0.0))
        else:
            self.shift = _exact(here - named)

    def _move(self, line: int, words: dict[str, str]) -> None:
        x, y = self._um(words.get("X")), self._um(words.get("Y"))
        has_center = "I" in words or "J" in words
        if self.motion is None or (x is None and y is None and not (has_center and self.motion >= 2)):
            return
        start = self._here
        if self.absolute:
            self.name = complex(self.name.real if x is None else x, self.name.imag if y is None else y)
        else:
            self.name = _exact(self.name + complex(x or 0.0, y or 0.0))
        self.begun, self.stopped = True, False
        arc: Arc = (None, 0.0) if self.motion < 2 else self._arc(start, words)
        kind = JUMP if self.motion == 0 else LINE if arc[0] is None else ARC
        self._add(line, words, kind, start, arc)

    def _add(self, line: int, words: dict[str, str], kind: int, start: complex, arc: Arc) -> None:
        by = self.registers.get(self.register, math.nan) if self.side else 0.0
        end = self._here
        label = f"N{int(words['N'])}" if "N" in words else ""
        self.rows.append(PlainRow(kind, start, end, *arc, self.side, by, self.register, line + 1, label))

    def _arc(self, start: complex, words: dict[str, str]) -> Arc:
        end = self._here
        if "R" in words:
            return self._arc_of_radius(start, end, self._um(words["R"]) or 0.0)
        if not {"I", "J"} & set(words) or (self.absolute_centers and not {"I", "J"} <= set(words)):
            return None, 0.0
        by = complex(self._um(words.get("I")) or 0.0, self._um(words.get("J")) or 0.0)
        center = _exact(by + (self.shift if self.absolute_centers else start))
        if center in (start, end):
            return None, 0.0
        if start == end:
            return center, self._turn * math.tau
        way = (end - start) / abs(end - start)
        middle = (start + end) / 2
        fitted = middle + way * 1j * ((center - middle) / way).imag
        written, sweep = self._sweep(start, end, center), self._sweep(start, end, fitted)
        differ = abs(abs(start - center) - abs(end - center))
        if abs(written - sweep) > math.pi or (written > math.pi and abs(fitted - center) > 2 * differ):
            return center, self._turn * written
        return fitted, self._turn * sweep

    def _arc_of_radius(self, start: complex, end: complex, radius: float) -> Arc:
        chord = abs(end - start)
        if not chord or not radius or chord > 2 * abs(radius) + 2 * math.sqrt(2):
            return None, 0.0
        half = math.asin(min(1.0, chord / 2 / abs(radius)))
        sweep = 2 * half if radius > 0 else math.tau - 2 * half
        to_center = math.sqrt(max(radius**2 - chord**2 / 4, 0.0)) * (1 if radius > 0 else -1)
        return (start + end) / 2 + (end - start) / chord * 1j * self._turn * to_center, self._turn * sweep

    def _sweep(self, start: complex, end: complex, center: complex) -> float:
        turned = (cmath.phase((end - center) / (start - center)) * self._turn) % math.tau
        return turned or math.tau

    @property
    def _here(self) -> complex:
        return _exact(self.name + self.shift)

    @property
    def _turn(self) -> int:
        return 1 if self.motion == 3 else -1

    def _term(self, text: str) -> float:
        return self.registers[_register(text)] if text[0].isalpha() else self._um(text) or 0.0

    def _um(self, written: str | None) -> float | None:
        if written is None:
            return None
        least = 0.1 * MM_PER_INCH if self.inch else 1.0  # an integer counts 0.0001 inch, or 0.001 mm
        whole = 1000.0 * MM_PER_INCH if self.inch else 1000.0
        return round(float(written) * (whole if "." in written else least), 6)


def _exact(place: complex) -> complex:
    return complex(round(place.real, 6), round(place.imag, 6))


def _words(text: str) -> dict[str, str]:
    return {} if "=" in text else dict(re.findall(r"([A-Z])([-+]?[\d.]+)", text))


def _register(text: str) -> str:
    text = text.strip()
    return f"{text[0]}{int(text[1:])}"
