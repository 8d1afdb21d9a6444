"""Two hundred drawings, each with one thing that drawings of shops have, and what is in them: the truth of a program.

Run as a script it writes them, with ``truth.json``, into ``tests/drawings``. The truth is worked out here from the
shapes, by shapely, and never read back: each contour that is to be cut by its middle and its area in mm, whether it is
an outline or a hole, and why other curves are left. Numbers come from a seed of the drawing's own number.
"""

import json
import math
import random
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import ezdxf
import shapely
from ezdxf.document import Drawing as Document
from ezdxf.layouts import BaseLayout
from places import ROOT
from random_sheets import Shape, Side, circle, polygon, shape

FOLDER = ROOT / "tests" / "drawings"
OF_EACH = 8
_SQUARE = (-1.0 - 1.0j, 1.0 - 1.0j, 1.0 + 1.0j, -1.0 + 1.0j)


class Constructed(NamedTuple):
    """A drawing: what is to be cut, outlines each with its holes, why curves are left, and options of the command."""

    document: Document
    parts: list[list[shapely.Polygon]]
    left: list[str]
    options: dict[str, Any]


class Canvas(NamedTuple):
    """Where a drawing is made, and what of it is known."""

    rng: random.Random
    document: Document
    parts: list[list[shapely.Polygon]]
    left: list[str]
    options: dict[str, Any]

    @property
    def space(self) -> BaseLayout:
        """Its model space."""
        return self.document.modelspace()

    def add(self, contour: Shape, *, into: BaseLayout | None = None, scale: float = 1.0, layer: str = "0") -> None:
        """A contour as a closed polyline, or a circle."""
        space, how = self.space if into is None else into, {"layer": layer}
        if len(contour.sides) == 1:
            side = contour.sides[0]
            assert side.center is not None
            space.add_circle(_xy(side.center, scale), scale * abs(side.start - side.center), dxfattribs=how)
            return
        rows = [(*_xy(side.start, scale), math.tan(0.25 * side.turn)) for side in contour.sides]
        is_old = self.document.dxfversion <= "AC1009"
        draw = space.add_polyline2d if is_old else space.add_lwpolyline
        draw(rows, format="xyb", close=True, dxfattribs=how)

    def loose(self, sides: list[Side]) -> None:
        """Sides one by one, in any order and from either end."""
        for side in self.rng.sample(sides, len(sides)):
            if side.center is None:
                ends = [_xy(side.start), _xy(side.end)]
                self.space.add_line(*(ends if self.rng.random() < 0.5 else ends[::-1]))
                continue
            first, last = (
                math.degrees(math.atan2((z - side.center).imag, (z - side.center).real)) for z in (side.start, side.end)
            )
            pair = (first, last) if side.turn > 0.0 else (last, first)
            self.space.add_arc(_xy(side.center), abs(side.start - side.center), *pair)

    def cut(self, outline: Shape, *holes: Shape, scale_mm: float = 1.0) -> None:
        """Say that a part is to be cut."""
        grown = [shapely.affinity.scale(each.polygon, scale_mm, scale_mm, origin=(0, 0)) for each in (outline, *holes)]
        self.parts.append(grown)


def _xy(place: complex, scale: float = 1.0) -> tuple[float, float]:
    return scale * place.real, scale * place.imag


def _plate(canvas: Canvas, at: complex = 40.0 + 30.0j) -> tuple[Shape, list[Shape]]:
    """A plate with one to three holes of any shape."""
    half = complex(canvas.rng.uniform(16.0, 24.0), canvas.rng.uniform(9.0, 13.0))
    outline = polygon([at + complex(z.real * half.real, z.imag * half.imag) for z in _SQUARE])
    number = canvas.rng.randrange(1, 4)
    places = [at + half.real * (0.62 * (k - 0.5 * (number - 1))) for k in range(number)]
    return outline, [shape(canvas.rng, place, canvas.rng.uniform(2.0, 4.0)) for place in places]


def plain(canvas: Canvas) -> None:
    outline, holes = _plate(canvas)
    for each in (outline, *holes):
        canvas.add(each)
    canvas.cut(outline, *holes)


def one_by_one(canvas: Canvas) -> None:
    """Lines and arcs in no order."""
    outline, holes = _plate(canvas)
    canvas.loose([side for each in (outline, *holes) if len(each.sides) > 1 for side in each.sides])
    for each in holes:
        if len(each.sides) == 1:
            canvas.add(each)
    canvas.cut(outline, *holes)


def _gapped(canvas: Canvas, gap_mm: float) -> None:
    """A quadrangle whose lines stop short of its corners; a sound hole in it."""
    outline, hole = polygon([30.0 + 20.0j + 15.0 * z for z in _SQUARE]), circle(30.0 + 20.0j, 4.0)
    for side in outline.sides:
        way = (side.end - side.start) / abs(side.end - side.start)
        canvas.space.add_line(_xy(side.start), _xy(side.end - gap_mm * way))
    canvas.add(hole)
    canvas.cut(outline, hole)


def small_gaps(canvas: Canvas) -> None:
    """Within the usual 10 µm."""
    _gapped(canvas, canvas.rng.uniform(0.001, 0.009))


def wide_gaps(canvas: Canvas) -> None:
    """As wide as a user says."""
    gap_mm = canvas.rng.uniform(0.02, 0.08)
    _gapped(canvas, gap_mm)
    canvas.options["gap_um"] = 1.2e3 * gap_mm


def doubled(canvas: Canvas) -> None:
    """Edges drawn twice, whole or in part."""
    outline, holes = _plate(canvas)
    for each in (outline, *holes):
        canvas.add(each)
    for side in canvas.rng.sample(outline.sides, 2):
        share = canvas.rng.choice([1.0, 0.5])
        canvas.space.add_line(_xy(side.start), _xy(side.start + share * (side.end - side.start)))
    canvas.cut(outline, *holes)
    canvas.left.extend(["drawn-twice"] * 2)


def title_frame(canvas: Canvas) -> None:
    """A frame of A4 with a title."""
    outline, holes = _plate(canvas, 140.0 + 110.0j)
    for each in (outline, *holes):
        canvas.add(each)
    canvas.add(polygon([10.0 + 10.0j, 287.0 + 10.0j, 287.0 + 200.0j, 10.0 + 200.0j]))
    for text, at in (("PART 7", (200.0, 20.0)), ("Cr12", (200.0, 30.0))):
        canvas.space.add_text(text, height=4.0, dxfattribs={"insert": at})
    canvas.cut(outline, *holes)
    canvas.left.extend(["frame", "text"])


def nest(canvas: Canvas) -> None:
    """Parts beside each other."""
    for column in range(canvas.rng.randrange(2, 5)):
        middle = complex(20.0 + 30.0 * column, 20.0)
        outline, hole = circle(middle, 11.0), shape(canvas.rng, middle, 5.0)
        for each in (outline, hole):
            canvas.add(each)
        canvas.cut(outline, hole)


def part_in_part(canvas: Canvas) -> None:
    """A part in the hole of another one, with a hole of its own."""
    middle, radius = 40.0 + 40.0j, canvas.rng.uniform(18.0, 26.0)
    outer = polygon([middle + radius * z for z in _SQUARE])
    hole, inner, core = (circle(middle, share * radius) for share in (0.8, 0.55, 0.2))
    for each in (outer, hole, inner, core):
        canvas.add(each)
    canvas.cut(outer, hole)
    canvas.cut(inner, core)


def ellipse(canvas: Canvas) -> None:
    """An ellipse as CAD has it, in a plate."""
    middle, long, ratio = 30.0 + 30.0j, canvas.rng.uniform(6.0, 10.0), canvas.rng.uniform(0.4, 0.9)
    turned = canvas.rng.uniform(0.0, math.pi)
    outline = polygon([middle + 18.0 * z for z in _SQUARE])
    canvas.add(outline)
    major = (long * math.cos(turned), long * math.sin(turned), 0.0)
    canvas.space.add_ellipse(_xy(middle), major, ratio)
    hole = shapely.affinity.rotate(
        shapely.affinity.scale(circle(middle, 1.0).polygon, long, ratio * long), turned, use_radians=True
    )
    canvas.parts.append([outline.polygon, hole])


def spline(canvas: Canvas) -> None:
    """A closed spline through places, as drawn by hand, beside a sound part."""
    middle, number = 30.0 + 30.0j, canvas.rng.randrange(7, 12)
    places = [
        middle + canvas.rng.uniform(9.0, 12.0) * complex(math.cos(angle), math.sin(angle))
        for angle in (2.0 * math.pi * k / number for k in range(number))
    ]
    curve = canvas.space.add_spline(degree=3)
    curve.set_closed([(*_xy(place), 0.0) for place in places], degree=3)
    seen = [(point.x, point.y) for point in curve.construction_tool().approximate(4000)]
    canvas.parts.append([shapely.Polygon(seen)])


def halves(canvas: Canvas) -> None:
    """Circles as two arcs, or as four."""
    middle, number = 30.0 + 30.0j, canvas.rng.choice([2, 4])
    outline, hole = circle(middle, 14.0), circle(middle, canvas.rng.uniform(3.0, 9.0))
    for each in (outline, hole):
        radius = abs(each.sides[0].start - middle)
        for k in range(number):
            canvas.space.add_arc(_xy(middle), radius, 360.0 * k / number, 360.0 * (k + 1) / number)
    canvas.cut(outline, hole)


def blocks(canvas: Canvas) -> None:
    """An array of blocks, each a ring, turned and mirrored as they come."""
    block = canvas.document.blocks.new("RING")
    outline, hole = circle(0j, 8.0), polygon([4.0 * z for z in _SQUARE])
    for each in (outline, hole):
        canvas.add(each, into=block)
    turn = canvas.rng.choice([0.0, 90.0, 33.0])
    how = {"rotation": turn, "xscale": canvas.rng.choice([1.0, -1.0]), "yscale": 1.0, "zscale": 1.0}
    for column in range(canvas.rng.randrange(2, 4)):
        at = complex(20.0 + 25.0 * column, 20.0)
        canvas.space.add_blockref("RING", _xy(at), dxfattribs=how)
        moved = [
            shapely.affinity.translate(shapely.affinity.rotate(each.polygon, turn, origin=(0, 0)), *_xy(at))
            for each in (outline, hole)
        ]
        canvas.parts.append(moved)


def in_inches(canvas: Canvas) -> None:
    """In inches, as the file says, or as the user does."""
    is_named = canvas.rng.random() < 0.5
    canvas.document.header["$INSUNITS"] = 1 if is_named else 0
    if not is_named:
        canvas.options["unit"] = "inch"
    outline, holes = polygon([1.0 + 1.0j + 0.7 * z for z in _SQUARE]), [circle(1.0 + 1.0j, 0.2)]
    for each in (outline, *holes):
        canvas.add(each)
    canvas.cut(outline, *holes, scale_mm=25.4)


def in_centimetres(canvas: Canvas) -> None:
    canvas.document.header["$INSUNITS"] = 5
    outline, holes = polygon([3.0 + 3.0j + 1.6 * z for z in _SQUARE]), [circle(3.0 + 3.0j, 0.5)]
    for each in (outline, *holes):
        canvas.add(each)
    canvas.cut(outline, *holes, scale_mm=10.0)


def open_chain(canvas: Canvas) -> None:
    """A sound part beside a stroke that closes nothing."""
    outline, holes = _plate(canvas)
    for each in (outline, *holes):
        canvas.add(each)
    at = complex(80.0, canvas.rng.uniform(10.0, 40.0))
    canvas.space.add_line(_xy(at), _xy(at + 9.0))
    canvas.cut(outline, *holes)
    canvas.left.append("open")


def figure_of_eight(canvas: Canvas) -> None:
    """A contour that crosses itself, beside a sound part."""
    outline = circle(70.0 + 20.0j, 9.0)
    canvas.add(outline)
    by = canvas.rng.uniform(8.0, 12.0)
    canvas.add(polygon([20.0 + 20.0j + by * z for z in (-1.0 - 1.0j, 1.0 + 1.0j, 1.0 - 1.0j, -1.0 + 1.0j)]))
    canvas.cut(outline)
    canvas.left.append("crosses-itself")


def too_small(canvas: Canvas) -> None:
    """A hole that no wire fits into."""
    outline, hole = polygon([30.0 + 20.0j + 12.0 * z for z in _SQUARE]), circle(24.0 + 20.0j, 4.0)
    for each in (outline, hole, circle(36.0 + 20.0j, canvas.rng.uniform(0.03, 0.09))):
        canvas.add(each)
    canvas.cut(outline, hole)
    canvas.left.append("too-small")


def centre_lines(canvas: Canvas) -> None:
    """A dashed line through all, and a layer that is switched off."""
    outline, holes = _plate(canvas)
    for each in (outline, *holes):
        canvas.add(each)
    canvas.document.linetypes.add("CENTER", [2.0, 1.25, -0.25, 0.25, -0.25])
    canvas.space.add_line((0.0, 30.0), (90.0, 30.0), dxfattribs={"linetype": "CENTER"})
    canvas.document.layers.add("OLD").off()
    canvas.add(circle(20.0 + 80.0j, 7.0), layer="OLD")
    canvas.cut(outline, *holes)
    canvas.left.extend(["broken-line", "off"])


def odd_vertices(canvas: Canvas) -> None:
    """A polyline that repeats its first place, has places on its sides and two at one place."""
    middle, by = 30.0 + 30.0j, canvas.rng.uniform(10.0, 16.0)
    corners = [middle + by * z for z in _SQUARE]
    rows = []
    for here, there in zip(corners, [*corners[1:], corners[0]], strict=True):
        rows += [here, here, here + 0.4 * (there - here)]
    canvas.space.add_lwpolyline([_xy(place) for place in [*rows, rows[0]]], close=True)
    canvas.cut(polygon(corners))


def dense(canvas: Canvas) -> None:
    """A circle as a polyline of hundreds of places, as exported from a mesh."""
    radius, number = canvas.rng.uniform(6.0, 14.0), canvas.rng.randrange(300, 700)
    places = [
        30.0 + 30.0j + radius * complex(math.cos(angle), math.sin(angle))
        for angle in (2.0 * math.pi * k / number for k in range(number))
    ]
    canvas.space.add_lwpolyline([_xy(place) for place in places], close=True)
    canvas.cut(polygon(places))


def raised(canvas: Canvas) -> None:
    """Lines that lie at a height of their own each."""
    outline = polygon([30.0 + 20.0j + 12.0 * z for z in _SQUARE])
    for side in outline.sides:
        height = canvas.rng.uniform(-5.0, 5.0)
        canvas.space.add_line((*_xy(side.start), height), (*_xy(side.end), height))
    canvas.cut(outline)


def common_edge(canvas: Canvas) -> None:
    """Two parts that draw one side in common: left, and a third one is cut."""
    by = canvas.rng.uniform(8.0, 12.0)
    for at in (-1.0, 1.0):
        canvas.add(polygon([40.0 + 20.0j + at * by + complex(by * z.real, 9.0 * z.imag) for z in _SQUARE]))
    outline = circle(90.0 + 20.0j, 9.0)
    canvas.add(outline)
    canvas.cut(outline)
    canvas.left.extend(["shared-edge"] * 2)


def parted_by_a_kerf(canvas: Canvas) -> None:
    """Two parts that are a kerf apart: their neighbouring sides are cut at once where that is asked for."""
    canvas.options["common_edges"] = True
    by = canvas.rng.uniform(8.0, 12.0)
    for at in (-1.0, 1.0):
        middle = 40.0 + 20.0j + at * (by + 0.1)
        outline = polygon([middle + complex(by * z.real, 9.0 * z.imag) for z in _SQUARE])
        canvas.add(outline)
        canvas.cut(outline)


def picked(canvas: Canvas) -> None:
    """Two parts, of which one is asked for."""
    outline, holes = _plate(canvas)
    for each in (outline, *holes, circle(90.0 + 30.0j, 8.0)):
        canvas.add(each)
    canvas.options["pick"] = ["90,30"] if canvas.rng.random() < 0.5 else ["0,0..70,60"]
    if canvas.options["pick"] == ["90,30"]:
        canvas.cut(circle(90.0 + 30.0j, 8.0))
        canvas.left.extend(["not-picked"] * (1 + len(holes)))
    else:
        canvas.cut(outline, *holes)
        canvas.left.append("not-picked")


FAMILIES: tuple[Callable[[Canvas], None], ...] = (
    *(plain, one_by_one, small_gaps, wide_gaps, doubled, title_frame, nest, part_in_part, ellipse, spline, halves),
    *(blocks, in_inches, in_centimetres, open_chain, figure_of_eight, too_small, centre_lines, odd_vertices, dense),
    *(raised, common_edge, parted_by_a_kerf, picked, plain),
)
_NEW = {"ellipse", "spline", "in_inches", "in_centimetres", "odd_vertices", "dense"}
"""Families that R12 cannot hold."""


def constructed() -> Iterator[tuple[str, Constructed]]:
    """All drawings by their names."""
    number = 0
    for turn in range(OF_EACH):
        for family in FAMILIES:
            number += 1
            name = family.__name__.replace("_", "-")
            version = "R2000" if family.__name__ in _NEW or turn % 2 else "R12"
            document = ezdxf.new(version)
            document.header["$INSUNITS"] = 4
            canvas = Canvas(random.Random(1000 + number), document, [], [], {})
            family(canvas)
            yield f"{number:03}-{name}", Constructed(document, canvas.parts, sorted(canvas.left), canvas.options)


def _truth(drawing: Constructed) -> dict[str, Any]:
    contours = [
        {"kind": "hole" if at else "outline", "area_mm2": ring.area, "middle_mm": list(ring.centroid.coords[0])}
        for part in drawing.parts
        for at, ring in enumerate(part)
    ]
    rounded = [
        {**each, "area_mm2": round(each["area_mm2"], 4), "middle_mm": [round(value, 4) for value in each["middle_mm"]]}
        for each in contours
    ]
    return {"contours": rounded, "left": drawing.left, "options": drawing.options}


def main() -> None:
    """Write them all."""
    FOLDER.mkdir(exist_ok=True)
    for old in FOLDER.glob("*.dxf"):
        old.unlink()
    truth = {}
    for name, drawing in constructed():
        drawing.document.saveas(FOLDER / f"{name}.dxf")
        truth[name] = _truth(drawing)
    rows = [f"  {json.dumps(name)}: {json.dumps(each)}" for name, each in truth.items()]
    (FOLDER / "truth.json").write_text("{\n" + ",\n".join(rows) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
