"""A plotter file to a document: what its pens draw, as lines and arcs.

CAMs of small wire-cut shops take such files (PLT). Pens are layers, ``PEN 1`` and on, and colours of the same numbers.
Instructions that say how thick, how fast or in which order something is drawn say nothing of its form. Fills, wedges
and the like are no contours: they are told.
"""

import cmath
import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final, NamedTuple

from parser.drawing.model import Unit
from parser.drawing.plots.hpgl import Instruction, encoded, instructions
from parser.drawing.plots.source import Sheet, Source, arc_places
from parser.findings.catalogue import Remark
from parser.findings.errors import DrawingError
from parser.text.encoding import printable

PLOT_UNIT: Final = Unit("plot unit", 25.0)
"""1/40 mm, as HPGL has it; 1016 to the inch."""
_FULL: Final = 2.0 * math.pi
_SAME_RAD: Final = 1e-9
_SETS: Final = {
    "VS", "FS", "PW", "WU", "UL", "AC", "CF", "FT", "LA", "MC", "MG", "NP", "NR", "OW", "PG", "PP", "PS", "RF", "SV",
    "TD", "TR", "VN", "WZ", "CO", "CT", "LO", "SI", "SR", "SA", "SD", "SS", "SL", "DI", "DR", "DV", "CP", "ES", "IW",
    "EC", "BP", "CR", "DL", "AF", "AH", "AS", "ST", "KY", "NL", "OA", "OC", "OD", "OE", "OF", "OG", "OH", "OI", "OK",
    "OL", "OP", "OS", "OT", "OM", "QL",
}  # fmt: skip
"""Instructions that draw nothing, and do not say where what is drawn stands."""
_MOVES: Final = {"PU", "PD", "PA", "PR", "AA", "AR", "AT", "RT", "CI", "EA", "ER", "BZ", "BR"}


class _Scale(NamedTuple):
    """What user units come to in plot units: origin of both, and plot units in one."""

    user: complex
    plot: complex
    x: float
    y: float

    def of(self, place: complex) -> complex:
        """A place in plot units."""
        by = place - self.user
        return self.plot + complex(by.real * self.x, by.imag * self.y)


_AS_IT_IS: Final = _Scale(0j, 0j, 1.0, 1.0)


def plot_source(text: str) -> Source:
    """The document of a plot. DrawingError where an instruction lacks numbers, or there is no end to them."""
    plotter = _Plotter()
    for instruction in instructions(text):
        plotter.do(instruction)
    plotter.lift()
    notes = [] if plotter.has_parts else [Remark("whole-plot-units", {"off": 0.5 * PLOT_UNIT.um})]
    if plotter.passed_over:
        listed = ", ".join(f"{number} {name}" for name, number in sorted(plotter.passed_over.items()))
        notes.append(Remark("plot-passed-over", {"instructions": listed}))
    return Source(plotter.sheet.document, "HPGL", PLOT_UNIT, tuple(notes))


class _Plotter:
    """The pen, and what it has drawn."""

    def __init__(self) -> None:
        self.sheet = Sheet()
        self.passed_over = Counter[str]()
        self.has_parts = False
        self._begin()
        self._pen = 1
        self._way: list[complex] = []
        self._bulges: list[float] = []
        self._does: Mapping[str, Callable[[list[float]], None]] = {
            "PU": self._up, "PD": self._down, "PA": self._absolute, "PR": self._relative,
            "AA": self._arc, "AR": self._arc_by, "AT": self._arc_through, "RT": self._arc_through_by,
            "CI": self._circle, "EA": self._rectangle, "ER": self._rectangle_by, "BZ": self._bezier,
            "BR": self._bezier_by, "SC": self._scale, "IP": self._corners, "LT": self._line_type, "SP": self._select,
            "PM": self._polygon, "EP": self._edge, "IN": self._anew, "DF": self._anew,
        }  # fmt: skip

    def _begin(self) -> None:
        self._at, self._is_down, self._is_relative, self._is_broken = 0j, False, False, False
        self._to_plot = _AS_IT_IS
        self._p1: complex | None = None
        self._p2: complex | None = None
        self._is_polygon, self._edges = False, list[tuple[list[complex], list[float]]]()

    def do(self, instruction: Instruction) -> None:
        """Follow one instruction. DrawingError where its numbers are too few, or none."""
        name, values = instruction
        try:
            if name == "PE":
                self._encoded(values)
            elif name in self._does:
                numbers = instruction.numbers
                if not all(map(math.isfinite, numbers)):
                    raise ValueError
                self.has_parts |= name in _MOVES and any(not number.is_integer() for number in numbers)
                self._does[name](numbers)
            elif name == "LB":
                self.sheet.text(self._at, **self._how())
            elif name not in _SETS:
                self.passed_over[name] += 1
        except DrawingError:
            raise
        except (IndexError, ValueError, ZeroDivisionError, OverflowError):
            raise DrawingError("plot-instruction", name=name, found=printable(values.strip()[:40])) from None

    def _anew(self, _numbers: list[float]) -> None:
        self.lift()
        self._begin()

    def lift(self) -> None:
        """End the way that the pen draws."""
        if len(self._way) > 1:
            if self._is_polygon:
                self._edges.append(_ring(self._way, self._bulges))
            else:
                self.sheet.way(self._way, self._bulges, **self._how())
        self._way, self._bulges = [], []

    def _how(self) -> dict[str, Any]:
        how = {"layer": f"PEN {self._pen}", "color": min(max(self._pen, 1), 255)}
        return {**how, "linetype": "DASHED"} if self._is_broken else how

    def _go(self, place: complex, bulge: float = 0.0) -> None:
        """Move to a place in plot units, along an arc where it has a bulge."""
        if self._is_down:
            if not self._way:
                self._way = [self._at]
            if place != self._at or bulge:
                self._way.append(place)
                self._bulges.append(bulge)
        self._at = place

    def _places(self, numbers: list[float], *, by: bool) -> Iterator[complex]:
        """Places in plot units, of pairs of numbers, each by the one before it where they are relative."""
        for x, y in zip(numbers[::2], numbers[1::2], strict=True):
            yield self._place(complex(x, y), by=by)

    def _place(self, place: complex, *, by: bool) -> complex:
        scale = self._to_plot
        return self._at + complex(place.real * scale.x, place.imag * scale.y) if by else scale.of(place)

    def _moves(self, numbers: list[float]) -> None:
        for place in self._places(numbers, by=self._is_relative):
            self._go(place)

    def _up(self, numbers: list[float]) -> None:
        self.lift()
        self._is_down = False
        self._moves(numbers)

    def _down(self, numbers: list[float]) -> None:
        self._is_down = True
        self._moves(numbers)

    def _absolute(self, numbers: list[float]) -> None:
        self._is_relative = False
        self._moves(numbers)

    def _relative(self, numbers: list[float]) -> None:
        self._is_relative = True
        self._moves(numbers)

    def _arc(self, numbers: list[float]) -> None:
        self._about(self._place(complex(*numbers[:2]), by=False), math.radians(numbers[2]))

    def _arc_by(self, numbers: list[float]) -> None:
        self._about(self._place(complex(*numbers[:2]), by=True), math.radians(numbers[2]))

    def _about(self, center: complex, sweep: float) -> None:
        """An arc about a centre, by so many radians; a whole turn ends where it began."""
        sweep = math.copysign(min(abs(sweep), _FULL), sweep)
        is_whole = abs(sweep) > _FULL - _SAME_RAD
        end = self._at if is_whole else center + (self._at - center) * cmath.exp(1j * sweep)
        for place, bulge in arc_places(self._at, center, sweep, end):
            self._go(place, bulge)

    def _arc_through(self, numbers: list[float]) -> None:
        self._through(*(self._place(complex(*numbers[at : at + 2]), by=False) for at in (0, 2)))

    def _arc_through_by(self, numbers: list[float]) -> None:
        self._through(*(self._place(complex(*numbers[at : at + 2]), by=True) for at in (0, 2)))

    def _through(self, middle: complex, end: complex) -> None:
        """The arc from where the pen is through a place to another one; a line where they lie on one."""
        this, other = middle - self._at, end - self._at
        cross = (this.conjugate() * other).imag
        if abs(cross) <= 1e-9 * abs(this) * abs(other):
            self._go(end)
            return
        center = self._at + 1j * (this * abs(other) ** 2 - other * abs(this) ** 2) / (2.0 * cross)
        turned = cmath.phase((self._at - center).conjugate() * (end - center))
        self._about(center, turned % _FULL if cross > 0.0 else turned % _FULL - _FULL)
        self._at = end

    def _circle(self, numbers: list[float]) -> None:
        radius = abs(numbers[0]) * abs(self._to_plot.x)
        self.lift()
        self.sheet.circle(self._at, radius, **self._how())

    def _rectangle(self, numbers: list[float]) -> None:
        self._frame(self._place(complex(*numbers[:2]), by=False))

    def _rectangle_by(self, numbers: list[float]) -> None:
        self._frame(self._place(complex(*numbers[:2]), by=True))

    def _frame(self, far: complex) -> None:
        self.lift()
        at = self._at
        corners = [at, complex(far.real, at.imag), far, complex(at.real, far.imag), at]
        self.sheet.way(corners, [0.0] * 4, **self._how())

    def _bezier(self, numbers: list[float]) -> None:
        self._curves(numbers, by=False)

    def _bezier_by(self, numbers: list[float]) -> None:
        self._curves(numbers, by=True)

    def _curves(self, numbers: list[float], *, by: bool) -> None:
        if len(numbers) % 6 or not numbers:
            raise ValueError
        self.lift()
        for at in range(0, len(numbers), 6):
            places = [self._at, *self._places(numbers[at : at + 6], by=by)]
            if self._is_down:
                self.sheet.bezier(places, **self._how())
            self._at = places[-1]

    def _scale(self, numbers: list[float]) -> None:
        """User units: between the corners P1 and P2, or as plot units in one."""
        if not numbers:
            self._to_plot = _AS_IT_IS
            return
        self.has_parts = True  # whole user units are no whole plot units
        low_x, high_x, low_y, high_y = numbers[:4]
        kind = int(numbers[4]) if len(numbers) > 4 else 0
        if kind == 2:
            self._to_plot = _Scale(complex(low_x, low_y), self._p1 or 0j, high_x, high_y)
            return
        if self._p1 is None or self._p2 is None:
            raise DrawingError("plot-scale-unknown")
        size = self._p2 - self._p1
        x, y = size.real / (high_x - low_x), size.imag / (high_y - low_y)
        if kind == 1:
            x = y = min(abs(x), abs(y))
        self._to_plot = _Scale(complex(low_x, low_y), self._p1, x, y)

    def _corners(self, numbers: list[float]) -> None:
        self._p1, self._p2 = (complex(*numbers[:2]), complex(*numbers[2:4])) if numbers else (None, None)

    def _line_type(self, numbers: list[float]) -> None:
        self.lift()
        self._is_broken = bool(numbers)

    def _select(self, numbers: list[float]) -> None:
        self.lift()
        self._pen = int(numbers[0]) if numbers else 0

    def _polygon(self, numbers: list[float]) -> None:
        """What is drawn from here on is the edge of a polygon, until that ends."""
        kind = int(numbers[0]) if numbers else 0
        self.lift()
        if kind == 0:
            self._edges = []
        self._is_polygon = kind != 2

    def _edge(self, _numbers: list[float]) -> None:
        for places, bulges in self._edges:
            self.sheet.way(places, bulges, **self._how())

    def _encoded(self, values: str) -> None:
        """A way in the signs of PE, which leaves places as they were given before."""
        for step in encoded(values):
            if step.kind == "pen":
                self._select([step.x])
                continue
            self.has_parts |= not (step.x.is_integer() and step.y.is_integer())
            if step.is_up:
                self.lift()
            self._is_down = not step.is_up
            self._go(self._place(complex(step.x, step.y), by=not step.is_place))
        self._is_down = True


def _ring(places: list[complex], bulges: list[float]) -> tuple[list[complex], list[float]]:
    """A way of a polygon, which ends where it begins."""
    return (places, bulges) if places[0] == places[-1] else ([*places, places[0]], [*bulges, 0.0])
