"""The drawings of scenarios that are made of a drawing alone; ``python tests/tools/example_drawings.py`` writes them.

The gear is m 1, z 24, 20°: involutes as splines, root fillets, a bore. The plate has round corners and three holes. The
logo is a rosette with five petals and a window, in which a leaf stands: closed cubic B-splines throughout. Round on
square has a drawing of its top as well.
"""

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import ezdxf
from ezdxf.entities import DXFGraphic
from ezdxf.layouts import Modelspace
from ezdxf.lldxf.tagwriter import TagCollector
from ezdxf.math import fit_points_to_cad_cv

MODULE, TEETH, PRESSURE = 1.0, 24, math.radians(20.0)
ADDENDUM, DEDENDUM = 1.0, 1.25
FILLET = 0.25
BORE = 4.0
_FIT_POINTS = 9

Place = tuple[float, float]


def involute_angle(radius: float) -> float:
    """Half the angle that a tooth takes at a radius, rad; mm.

    At the pitch circle it is π/2z, and it falls by what the involute of the base circle turns: inv α = tan α − α.
    """
    base = 0.5 * MODULE * TEETH * math.cos(PRESSURE)
    at = math.acos(min(base / radius, 1.0))
    return math.pi / (2 * TEETH) + (math.tan(PRESSURE) - PRESSURE) - (math.tan(at) - at)


def gear(space: Modelspace) -> None:
    """Teeth counter-clockwise, and the bore."""
    pitch = 0.5 * MODULE * TEETH
    base, tip, root = pitch * math.cos(PRESSURE), pitch + ADDENDUM * MODULE, pitch - DEDENDUM * MODULE
    foot, lean = math.sqrt((root + FILLET) ** 2 - FILLET**2), math.asin(FILLET / (root + FILLET))
    widest, narrowest = involute_angle(base), involute_angle(tip)
    radii = [base + (tip - base) * (step / (_FIT_POINTS - 1)) ** 2 for step in range(_FIT_POINTS)]
    for tooth in range(TEETH):
        middle, after = 2.0 * math.pi * tooth / TEETH, 2.0 * math.pi * (tooth + 1) / TEETH
        for side in (-1, 1):
            edge = middle + side * widest
            space.add_line(polar(foot, edge), polar(base, edge))
            flank = [polar(radius, middle + side * involute_angle(radius)) for radius in radii]
            curve = fit_points_to_cad_cv(flank)
            space.add_spline().apply_construction_tool(curve)
            heel = edge + side * lean
            turn = (heel + math.pi, edge - 0.5 * math.pi) if side == 1 else (edge + 0.5 * math.pi, heel + math.pi)
            space.add_arc(polar(root + FILLET, heel), FILLET, math.degrees(turn[0]), math.degrees(turn[1]))
        space.add_arc((0, 0), tip, math.degrees(middle - narrowest), math.degrees(middle + narrowest))
        ends = middle + widest + lean, after - widest - lean
        space.add_arc((0, 0), root, math.degrees(ends[0]), math.degrees(ends[1]))
    space.add_circle((0, 0), BORE)


def plate(space: Modelspace) -> None:
    """24 × 16 mm with corners R 2, holes R 2, 2 and 3; its name, which is not cut."""
    width, height, corner = 24.0, 16.0, 2.0
    bulge = math.tan(math.pi / 8)
    corners = [(corner, 0.0), (width, corner), (width - corner, height), (0.0, height - corner)]
    starts = [(width - corner, 0.0), (width, height - corner), (corner, height), (0.0, corner)]
    points = [
        (*place, by) for pair in zip(corners, starts, strict=True) for place, by in zip(pair, (0.0, bulge), strict=True)
    ]
    space.add_lwpolyline(points, format="xyb", close=True)
    for x, y, radius in ((5.0, 5.0, 2.0), (19.0, 5.0, 2.0), (12.0, 10.0, 3.0)):
        space.add_circle((x, y), radius)
    space.add_text("PLATE", height=2.0).set_placement((2.0, -5.0))


def logo(space: Modelspace) -> None:
    """A rosette of five lobes, a petal in each, and a window with a leaf."""
    closed(space, [polar(15.5 if at % 2 else 8.8, math.pi * at / 5) for at in range(10)])
    for petal in range(5):
        ahead = 2.0 * math.pi * (petal + 0.5) / 5
        closed(space, list(_petal(ahead)))
    closed(space, [polar(5.6, math.pi * at / 4) for at in range(8)])
    leaf = (0.0, -3.4), (1.6, -1.2), (2.4, 0.6), (0.6, 2.0), (0.0, 4.0), (-1.2, 1.8), (-2.2, 0.2), (-1.8, -1.8)
    closed(space, [*leaf])


def _petal(ahead: float) -> Iterator[Place]:
    for along, across in ((6.4, 0.0), (8.0, -2.0), (10.4, -2.0), (12.4, 0.0), (10.4, 2.0), (8.0, 2.0)):
        yield (
            along * math.cos(ahead) - across * math.sin(ahead),
            along * math.sin(ahead) + across * math.cos(ahead),
        )


def closed(space: Modelspace, points: list[Place]) -> None:
    """A closed cubic B-spline of control points."""
    space.add_spline().set_closed([(x, y, 0.0) for x, y in points], degree=3)


def polar(radius: float, angle: float) -> Place:
    """A place in mm."""
    return radius * math.cos(angle), radius * math.sin(angle)


def square(space: Modelspace) -> None:
    """10 mm wide, about the origin."""
    space.add_lwpolyline([(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)], close=True)


def circle(space: Modelspace) -> None:
    """4 mm of radius, about the origin."""
    space.add_circle((0.0, 0.0), 4.0)


Draw = Callable[[Modelspace], None]
DRAWINGS: dict[str, Draw] = {"gear": gear, "plate": plate, "logo": logo, "taper-two-drawings": square}
TOPS: dict[str, Draw] = {"taper-two-drawings": circle}
"""Drawings of the top of the work, in ``top.dxf``."""


def drawing_text(draw: Draw) -> str:
    """A drawing as a scenario holds it: group codes of the sections that carry the drawing, and no date."""
    document = ezdxf.new("R2000")
    draw(document.modelspace())
    lines = ["0", "SECTION", "2", "HEADER", "9", "$ACADVER", "1", "AC1015", "9", "$INSUNITS", "70", "4", "0", "ENDSEC"]
    lines += ["0", "SECTION", "2", "ENTITIES"]
    for entity in document.modelspace():
        lines += _tags(entity)
    return "\n".join([*lines, "0", "ENDSEC", "0", "EOF", ""])


def _tags(entity: DXFGraphic) -> list[str]:
    tags = TagCollector.dxftags(entity, dxfversion="AC1015")
    kept = [tag for tag in tags if tag.code not in {5, 330}]
    return [text for tag in kept for text in _lines(tag.code, tag.value)]


def _lines(code: int, value: object) -> Iterator[str]:
    """Group code and value of a tag; of a point each coordinate."""
    values = value if isinstance(value, tuple | list) else (value,)
    for at, one in enumerate(values):
        yield str(code + 10 * at)
        yield f"{round(one, 9) + 0.0:.9g}" if isinstance(one, float) else str(one)


if __name__ == "__main__":
    scenarios = Path(__file__).parents[2] / "scenarios"
    for file, drawings in (("drawing.dxf", DRAWINGS), ("top.dxf", TOPS)):
        for name, draw in drawings.items():
            (scenarios / name).mkdir(exist_ok=True)
            (scenarios / name / file).write_text(drawing_text(draw), "ascii", newline="\n")
