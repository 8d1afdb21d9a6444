"""Leads that cut into the part are found as deep as shapely says; leads through the waste, and slits, are not told."""

import math
import random
from itertools import pairwise

import numpy as np
import shapely
from depth import cases

from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

Place = tuple[int, int]


def text_of(places: list[Place]) -> str:
    """Lines from place to place, µm."""
    blocks = []
    for (x0, y0), (x1, y1) in pairwise(places):
        x, y = x1 - x0, y1 - y0
        quadrant = 1 if x > 0 and y >= 0 else 2 if x <= 0 and y > 0 else 3 if x < 0 else 4
        axis = "X" if abs(x) > abs(y) or (abs(x) == abs(y) and quadrant in (2, 4)) else "Y"
        blocks.append(f"B{abs(x)}B{abs(y)}B{max(abs(x), abs(y))}G{axis}L{quadrant}")
    return "\n".join([*blocks, "DD", ""])


def gouges(text: str) -> dict[int, float]:
    """Depths by block."""
    result = check_file(Job("part.3b", text.encode(), CheckSettings()))
    return {found.block: found.values["by"] for found in result.findings if found.code == "3B321"}


def star(rng: random.Random) -> shapely.Polygon:
    """A figure about (0, 0) with corners that point inwards, none of its sides short."""
    number = rng.randint(4, 9)
    corners = []
    for at in range(number):
        angle, radius = 2.0 * math.pi * (at + rng.uniform(0.1, 0.7)) / number, rng.uniform(2500.0, 9000.0)
        corners.append((radius * math.cos(angle), radius * math.sin(angle)))
    return shapely.Polygon(corners)


def ring(shape: shapely.Polygon, by_um: float) -> list[Place] | None:
    """Corners of the path beside a figure in whole µm, counter-clockwise; None where it is no simple one."""
    path = shape.buffer(by_um, join_style="mitre", mitre_limit=20.0)
    if path.geom_type != "Polygon" or path.interiors:
        return None
    corners = [(round(x), round(y)) for x, y in shapely.geometry.polygon.orient(path).exterior.coords[:-1]]
    return corners if shapely.LinearRing(corners).is_simple else None


def begun_at(corners: list[Place], at: int) -> list[Place]:
    return [*corners[at:], *corners[:at], corners[at]]


def depth_um(final: shapely.Polygon, line: list[Place], *, is_punch: bool) -> float:
    """How far a line runs on the part's side of the last pass, by places 1 µm apart."""
    way = shapely.LineString(line)
    places = shapely.line_interpolate_point(way, np.arange(0.0, way.length, 1.0))
    inside = shapely.contains(final, places)
    away = shapely.distance(final.exterior, places)
    return float(np.where(inside == is_punch, away, -away).max())


def test_leads_of_trims_from_anywhere_cut_as_deep_into_the_part_as_shapely_says() -> None:
    tried = deep = 0
    for number in cases(15, 4000):
        rng = random.Random(f"gouges {number}")
        shape, is_punch = star(rng), rng.random() < 0.6
        sign = 1.0 if is_punch else -1.0
        rough, trim = ring(shape, 160.0 * sign), ring(shape, 100.0 * sign)
        angle = rng.uniform(0.0, 6.28)
        hole = (round(12000 * math.cos(angle)), round(12000 * math.sin(angle))) if is_punch else (0, 0)
        if not rough or not trim or (not is_punch and not shapely.Polygon(trim).contains(shapely.Point(hole))):
            continue
        first, other = (begun_at(corners, rng.randrange(len(corners))) for corners in (rough, trim))
        final = shapely.Polygon(trim)
        if depth_um(final, [hole, first[0]], is_punch=is_punch) > -1.0:
            continue  # the first lead tells where the waste lies
        places = [hole, *first, hole, *other, hole]
        leads = (1, len(first) + 1, len(first) + 2, len(places) - 1)
        found = gouges(text_of(places))
        assert found.keys() <= set(leads), text_of(places)
        tried += 1
        for block in leads:
            wanted = depth_um(final, places[block - 1 : block + 1], is_punch=is_punch)
            if wanted > 6.0:
                deep += 1
                assert abs(found.get(block, 0.0) - wanted) < 2.0, (block, wanted, text_of(places))
            elif wanted < 4.0:
                assert block not in found, (block, wanted, text_of(places))
    assert tried > len(cases(15, 4000)) // 3
    assert deep > tried // 5


def test_a_slit_from_the_edge_into_the_part_and_back_is_meant() -> None:
    square = [(0, 0), (0, 5000), (-5000, 5000), (-5000, -5000), (5000, -5000), (5000, 5000), (0, 5000)]
    assert gouges(text_of([(0, 9000), *square[1:], (0, 2000), (0, 5000), (0, 9000)])) == {}


def test_a_slit_that_is_left_by_its_own_way_on_to_the_start_hole_is_meant() -> None:
    square = [(0, 0), (0, 5000), (-5000, 5000), (-5000, -5000), (5000, -5000), (5000, 5000), (0, 5000)]
    assert gouges(text_of([(0, 9000), *square[1:], (0, 2000), (0, 9000)])) == {}


def test_edges_are_known_by_their_numbers_where_an_edge_has_no_pass() -> None:
    """A subprogram that is torn off leaves passes over edge 1 alone: it was a fault of the check."""
    text = "H0=1\nG41G1Y0\nH0Y0M98P1\nG40G1X0\nN1;\nG0 Y1;\nG03 X-10I-1"
    assert check_file(Job("part.iso", text.encode(), CheckSettings())).outcome == "fail"
