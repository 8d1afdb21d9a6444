"""Random drawings as CADs save them, as DXF files in some unit, and which contours they hold, as polygons in mm.

Truth comes from the shapes by which they are made: sampled and put into shapely here, never read back. A contour is
drawn as one polyline, as lines and arcs in any order and sense, with gaps and doubled edges, or in a block that is
turned, mirrored or stretched. About it stand a frame with a title block, texts, centre lines, free strokes, and pairs
of parts with an edge in common, which nobody cuts.
"""

import cmath
import math
import random
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import ezdxf
import shapely
from ezdxf.document import Drawing as Document

UNITS_MM = {1: 25.4, 4: 1.0, 5: 10.0, 13: 0.001}
"""Units that sheets are drawn in, by $INSUNITS: inch, mm, cm and µm."""
MM = 4
GAP_MM = 0.008
"""Ends of lines that are drawn apart lie so near at most: within the usual gap of 10 µm."""
CELL_MM = 32.0
_FRAME_MM = 420.0, 297.0
_FINE = 720  # places on a turn: lines between them lie 0.01 % of the radius off


class Side(NamedTuple):
    """A line from one place to another, or an arc about a centre that turns by an angle; places are x + iy."""

    start: complex
    end: complex
    center: complex | None = None
    turn: float = 0.0

    def placed(self, move: Callable[[complex], complex], sense: float) -> "Side":
        """The side where places are moved; `sense` is −1 where that mirrors."""
        center = None if self.center is None else move(self.center)
        return Side(move(self.start), move(self.end), center, sense * self.turn)

    @property
    def places(self) -> list[complex]:
        """Places from its start on, without its end."""
        if self.center is None:
            return [self.start]
        number = max(math.ceil(abs(self.turn) / (2.0 * math.pi) * _FINE), 1)
        return [
            self.center + (self.start - self.center) * cmath.exp(1j * self.turn * k / number) for k in range(number)
        ]


class Shape(NamedTuple):
    """A contour: its sides one behind the other; a circle is one arc of a turn."""

    sides: list[Side]

    @property
    def polygon(self) -> shapely.Polygon:
        """What it encloses."""
        return shapely.Polygon([(z.real, z.imag) for side in self.sides for z in side.places])


class Sheet(NamedTuple):
    """A drawing: its file, the contours that are to be cut, and those that are to be left, by why."""

    path: Path
    parts: list[list[shapely.Polygon]]  # of each part its outline and its holes
    left: list[str]


def circle(center: complex, radius: float) -> Shape:
    return Shape([Side(center + radius, center + radius, center, 2.0 * math.pi)])


def polygon(places: list[complex]) -> Shape:
    return Shape([Side(*pair) for pair in zip(places, [*places[1:], places[0]], strict=True)])


def shape(rng: random.Random, center: complex, radius: float) -> Shape:
    """Any shape within a circle, counter-clockwise."""
    turned = cmath.exp(1j * rng.uniform(0.0, 2.0 * math.pi))
    kind = rng.choice(["circle", "rectangle", "regular", "slot", "rounded", "corner"])
    if kind == "circle":
        return circle(center, radius)
    if kind == "regular":
        number = rng.randrange(3, 9)
        return polygon([center + radius * turned * cmath.exp(2j * math.pi * k / number) for k in range(number)])
    half = radius * complex(0.8, rng.uniform(0.4, 0.6))
    if kind == "rectangle":
        return polygon([center + turned * z for z in (-half, half.conjugate(), half, -half.conjugate())])
    if kind == "corner":
        a, b = half.real, half.imag
        way = (-a - 1j * b, a - 1j * b, a, 0.2 * a, 0.2 * a + 1j * b, -a + 1j * b)
        return polygon([center + turned * z for z in way])
    round_ = half.imag if kind == "slot" else rng.uniform(0.3, 0.7) * half.imag
    return Shape([side.placed(lambda z: center + turned * z, 1.0) for side in _rounded(half, round_)])


def _rounded(half: complex, radius: float) -> Iterator[Side]:
    """A rectangle with round corners; a slot where nothing is left of its short sides."""
    a, b = half.real - radius, half.imag - radius
    corners = [complex(a, -b), complex(a, b), complex(-a, b), complex(-a, -b)]
    for at, corner in enumerate(corners):
        out = -1j * 1j**at
        start, end = corner + radius * out, corner + radius * out * 1j
        yield Side(start, end, corner, 0.5 * math.pi)
        onward = corners[(at + 1) % 4] + radius * out * 1j
        if abs(onward - end) > 1e-9:
            yield Side(end, onward)


def sheet(folder: Path, seed: int) -> Sheet:
    """A random sheet."""
    rng = random.Random(seed)
    version = rng.choice(["R12", "R2000", "R2010", "R2018"])
    units = rng.choice(list(UNITS_MM)) if version != "R12" else MM  # of R12 no file names a unit
    document = ezdxf.new(version, units=units)
    pen = _Pen(rng, document, 1.0 / UNITS_MM[units])
    parts: list[list[shapely.Polygon]] = []
    left: list[str] = []
    for column in range(rng.randrange(1, 4)):
        for row in range(rng.randrange(1, 3)):
            center = complex(60.0 + CELL_MM * column, 60.0 + CELL_MM * row)
            if rng.random() < 0.1:
                pen.common_edge(center)
                left += ["shared-edge"] * 2
            else:
                parts += list(_nest(rng, pen, center))
    pen.clutter()
    if parts and rng.random() < 0.3:
        pen.frame()
        left.append("frame")
    path = folder / f"sheet-{seed}.dxf"
    document.saveas(path)
    return Sheet(path, parts, left)


def _nest(rng: random.Random, pen: "_Pen", center: complex) -> Iterator[list[shapely.Polygon]]:
    """A part with holes round its middle, in one of which another part may stand."""
    outline = circle(center, 14.0) if rng.random() < 0.3 else polygon([center + 14.0 * z for z in _SQUARE])
    holes = []
    if rng.random() < 0.3:
        hole = circle(center, 8.5)
        inner, core = shape(rng, center, 5.5), circle(center, 1.2)
        is_cored = rng.random() < 0.5 and inner.polygon.buffer(-1.0).contains(core.polygon)
        for each in (hole, inner, *[core] * is_cored):
            pen.draw(each)
        yield [inner.polygon, *[core.polygon] * is_cored]
        holes.append(hole)
    else:
        places = [center + 6.0 * cmath.exp(2j * math.pi * (k / 3.0 + 0.1)) for k in range(rng.randrange(4))]
        holes = [shape(rng, place, rng.uniform(1.5, 4.0)) for place in places]
        for each in holes:
            pen.draw(each)
    pen.draw(outline)
    yield [outline.polygon, *(hole.polygon for hole in holes)]


_SQUARE = (-1.0 - 1.0j, 1.0 - 1.0j, 1.0 + 1.0j, -1.0 + 1.0j)


class _Pen:
    """Draws into a document, its numbers being mm times a scale."""

    def __init__(self, rng: random.Random, document: Document, scale: float) -> None:
        self._rng, self._document, self._scale = rng, document, scale
        self._space = document.modelspace()
        self._blocks = 0

    def draw(self, contour: Shape) -> None:
        """A contour in any way."""
        is_round = any(side.center is not None for side in contour.sides)
        way = self._rng.choice(["whole", "loose", "block"] + ["stretched"] * (not is_round))
        if way in {"whole", "loose"}:
            self._add(self._space, contour, is_loose=way == "loose")
            return
        self._blocks += 1
        block = self._document.blocks.new(f"B{self._blocks}")
        turn = self._rng.choice([0.0, 90.0, self._rng.uniform(0.0, 360.0)])
        x = self._rng.choice([1.0, -1.0, 2.5])
        y = abs(x) * self._rng.choice([1.0, -1.0]) * (0.5 if way == "stretched" else 1.0)
        at = complex(self._rng.uniform(-50.0, 50.0), 20.0)
        by = cmath.exp(1j * math.radians(turn))

        def own(place: complex) -> complex:
            flat = (place - at) / by
            return complex(flat.real / x, flat.imag / y)

        sense = math.copysign(1.0, x * y)
        inner = Shape([side.placed(own, sense) for side in contour.sides])
        self._add(block, inner, is_loose=self._rng.random() < 0.5, gap_mm=GAP_MM / abs(x))
        place = (at.real * self._scale, at.imag * self._scale)
        how = {"rotation": turn, "xscale": x, "yscale": y, "zscale": 1.0}
        self._space.add_blockref(f"B{self._blocks}", place, dxfattribs=how)

    def _add(self, space: object, contour: Shape, *, is_loose: bool, gap_mm: float = GAP_MM) -> None:
        sides, is_plain = contour.sides, self._document.dxfversion > "AC1009"
        if len(sides) == 1:
            self._circle(space, sides[0], is_halved=is_loose)
        elif is_loose:
            drawn = [*sides, *([self._rng.choice(sides)] if self._rng.random() < 0.3 else [])]
            self._rng.shuffle(drawn)
            for side in drawn:
                self._alone(space, side, gap_mm)
        else:
            rows = [(*self._xy(side.start), math.tan(0.25 * side.turn)) for side in sides]
            add = space.add_lwpolyline if is_plain else space.add_polyline2d  # type: ignore[attr-defined]
            add(rows, format="xyb", close=True)

    def _circle(self, space: object, side: Side, *, is_halved: bool) -> None:
        assert side.center is not None
        center, radius = self._xy(side.center), self._scale * abs(side.start - side.center)
        if is_halved:
            for first in (0.0, 180.0):
                space.add_arc(center, radius, first, first + 180.0)  # type: ignore[attr-defined]
        else:
            space.add_circle(center, radius)  # type: ignore[attr-defined]

    def _alone(self, space: object, side: Side, gap_mm: float) -> None:
        """A side alone, from either end; a line may stop short of the next one by less than the gap."""
        if side.center is None:
            start, end = side.start, side.end
            if self._rng.random() < 0.3:
                end -= self._rng.uniform(0.0, gap_mm) * (end - start) / abs(end - start)
            pair = (start, end) if self._rng.random() < 0.5 else (end, start)
            space.add_line(*map(self._xy, pair))  # type: ignore[attr-defined]
            return
        first, last = (math.degrees(cmath.phase(place - side.center)) for place in (side.start, side.end))
        pair = (first, last) if side.turn > 0.0 else (last, first)
        radius = self._scale * abs(side.start - side.center)
        space.add_arc(self._xy(side.center), radius, *pair)  # type: ignore[attr-defined]

    def common_edge(self, center: complex) -> None:
        """Two rectangles with a side in common, which both of them draw."""
        for at in (-1.0, 1.0):
            middle = center + 6.0 * at
            self._add(self._space, polygon([middle + 6.0 * z.real + 9.0j * z.imag for z in _SQUARE]), is_loose=False)

    def clutter(self) -> None:
        """What no contour is: texts, centre lines, strokes that lie free."""
        for _ in range(self._rng.randrange(3)):
            place = self._xy(complex(self._rng.uniform(40.0, 140.0), 30.0))
            self._space.add_text("R5 Ø3", height=2.5 * self._scale, dxfattribs={"insert": place})
        if self._rng.random() < 0.5:
            ends = [self._xy(complex(x, 61.3)) for x in (35.0, 160.0)]
            self._document.linetypes.add("CENTER", [2.0, 1.25, -0.25, 0.25, -0.25]) if (
                "CENTER" not in self._document.linetypes
            ) else None
            self._space.add_line(*ends, dxfattribs={"linetype": "CENTER"})
        if self._rng.random() < 0.3:
            self._space.add_line(self._xy(20.0 + 20.0j), self._xy(35.0 + 24.0j))

    def frame(self) -> None:
        """The frame of a sheet of A3 about all, with a title in it."""
        wide, tall = _FRAME_MM
        corners = [0j, complex(wide), complex(wide, tall), 1j * tall]
        self._add(self._space, polygon([z - complex(20.0, 5.0) for z in corners]), is_loose=False)
        self._space.add_text("PART 1", height=5 * self._scale, dxfattribs={"insert": self._xy(300.0 + 2.0j)})

    def _xy(self, place: complex) -> tuple[float, float]:
        return place.real * self._scale, place.imag * self._scale
