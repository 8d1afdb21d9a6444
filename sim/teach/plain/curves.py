"""Blocks to curves: exact geometry of each, from where the one before ended, and distances to it, µm and rad."""

import math
from typing import NamedTuple

from sim.teach.plain.blocks import Block

_SIGN_X = [0, 1, -1, -1, 1]
_SIGN_Y = [0, 1, 1, -1, -1]
_PARTS_OF_ARC = 24
_PARTS_OF_LINE = 8


class Point(NamedTuple):
    """A place, µm."""

    x: float
    y: float


class Curve(NamedTuple):
    """A line, or an arc about a centre; a line has turn 0 and its start as its centre.

    Attributes
    ----------
    turn
        0 for a line, 1 counter-clockwise, −1 clockwise.
    start, end, centre
        µm.
    radius
        µm.
    start_rad, sweep_rad
        Angle at which it begins, and by which it turns, positive counter-clockwise.
    """

    turn: int
    start: Point
    end: Point
    centre: Point
    radius: float
    start_rad: float
    sweep_rad: float


def line_to(start: Point, end: Point) -> Curve:
    """A line."""
    return Curve(0, start, end, start, 0.0, 0.0, 0.0)


def arc_to(start: Point, centre: Point, sweep_rad: float) -> Curve:
    """An arc from its start on."""
    x, y = start.x - centre.x, start.y - centre.y
    radius, start_rad = math.sqrt(x * x + y * y), math.atan2(y, x)
    angle = start_rad + sweep_rad
    end = Point(centre.x + radius * math.cos(angle), centre.y + radius * math.sin(angle))
    return Curve(1 if sweep_rad > 0.0 else -1, start, end, centre, radius, start_rad, sweep_rad)


def decoded(blocks: list[Block], start: Point) -> list[Curve]:
    """Curves of blocks from a start on; a block that no controller can count out makes no way."""
    curves: list[Curve] = []
    place = start
    for block in blocks:
        curve = curve_of(block, place)
        curves.append(curve)
        place = curve.end
    return curves


def is_endless(block: Block) -> bool:
    """Whether a controller would never count a block out (3B201, 3B202): no radius, or nothing on the counted axis."""
    if block.turn != 0:
        return block.x * block.x + block.y * block.y <= 1
    named = with_axis_named(block)
    return (named.x if named.axis == 0 else named.y) == 0 and named.count_um > 0


def with_axis_named(block: Block) -> Block:
    """A block; a line without X and Y gets the axis that its digit names."""
    if block.turn != 0 or block.x > 0 or block.y > 0:
        return block
    on_x = block.quadrant % 2 == 1
    return Block(1 if on_x else 0, 0 if on_x else 1, block.count_um, block.axis, 0, block.quadrant, block.line)


def curve_of(block: Block, start: Point) -> Curve:
    """The curve of a block from its start; J decides where it ends."""
    if is_endless(block):
        return line_to(start, start)
    return _line_of(with_axis_named(block), start) if block.turn == 0 else _arc_of(block, start)


def _line_of(block: Block, start: Point) -> Curve:
    """A line: J along the counted axis, the ratio X:Y across it."""
    counted = block.x if block.axis == 0 else block.y
    other = block.y if block.axis == 0 else block.x
    along = block.count_um if counted > 0 else 0
    across = block.count_um * other / counted if counted > 0 else 0.0
    by_x = along if block.axis == 0 else across
    by_y = across if block.axis == 0 else along
    return line_to(start, Point(start.x + _SIGN_X[block.quadrant] * by_x, start.y + _SIGN_Y[block.quadrant] * by_y))


def _arc_of(block: Block, start: Point) -> Curve:
    """An arc: its counted coordinate is a triangle wave of period 4R in the length counted off."""
    x, y = _SIGN_X[block.quadrant] * block.x, _SIGN_Y[block.quadrant] * block.y
    radius = math.sqrt(x * x + y * y)
    cosine = x if block.axis == 0 else y
    sine = (y if block.axis == 0 else -x) * block.turn
    near = sine * sine / (radius + cosine) if cosine > 0 else radius - cosine
    phase = (near if sine >= 0 else 4.0 * radius - near) + block.count_um
    turns = math.floor(phase / (4.0 * radius))
    rest = phase - turns * 4.0 * radius
    is_upper = rest <= 2.0 * radius
    end_cosine = radius - rest if is_upper else rest - 3.0 * radius
    square = rest * (2.0 * radius - rest) if is_upper else (4.0 * radius - rest) * (rest - 2.0 * radius)
    end_sine = math.sqrt(max(square, 0.0)) * (1.0 if is_upper else -1.0)
    sweep = _angle(end_cosine, end_sine) + 2.0 * math.pi * turns - _angle(cosine, sine)
    end_x = end_cosine if block.axis == 0 else -end_sine * block.turn
    end_y = end_sine * block.turn if block.axis == 0 else end_cosine
    end = Point(start.x + end_x - x, start.y + end_y - y)
    centre = Point(start.x - x, start.y - y)
    return Curve(block.turn, start, end, centre, radius, math.atan2(y, x), sweep * block.turn)


def _angle(cosine: float, sine: float) -> float:
    """Angle from 0 up to 2π."""
    angle = math.atan2(sine, cosine)
    return angle + 2.0 * math.pi if angle < 0.0 else angle


def length_of(curve: Curve) -> float:
    """Length of a curve, µm."""
    if curve.turn == 0:
        return distance(curve.start, curve.end)
    return curve.radius * abs(curve.sweep_rad)


def distance(place: Point, other: Point) -> float:
    """Distance of two places, µm."""
    x, y = place.x - other.x, place.y - other.y
    return math.sqrt(x * x + y * y)


def point_on(curve: Curve, share: float) -> Point:
    """The place at a share of a curve, 0 to 1."""
    if share >= 1.0:
        return curve.end
    if curve.turn == 0:
        x, y = curve.end.x - curve.start.x, curve.end.y - curve.start.y
        return Point(curve.start.x + share * x, curve.start.y + share * y)
    angle = curve.start_rad + share * curve.sweep_rad
    return Point(curve.centre.x + curve.radius * math.cos(angle), curve.centre.y + curve.radius * math.sin(angle))


def points_on(curve: Curve) -> list[Point]:
    """Places along a curve, its start and its end among them: 25 on an arc, 9 on a line."""
    parts = _PARTS_OF_LINE if curve.turn == 0 else _PARTS_OF_ARC
    return [point_on(curve, number / parts) for number in range(parts + 1)]


def distance_to(curve: Curve, place: Point) -> float:
    """Distance of a place from a curve, µm."""
    ends = min(distance(curve.start, place), distance(curve.end, place))
    if curve.turn == 0:
        return min(ends, _distance_to_line(curve, place))
    x, y = place.x - curve.centre.x, place.y - curve.centre.y
    turned = (math.atan2(y, x) - curve.start_rad) * curve.turn
    turned -= 2.0 * math.pi * math.floor(turned / (2.0 * math.pi))
    if turned <= abs(curve.sweep_rad):
        return abs(math.sqrt(x * x + y * y) - curve.radius)
    return ends


def _distance_to_line(curve: Curve, place: Point) -> float:
    """Distance from where the foot of a place lies on a line, or infinity where it lies past an end."""
    by_x, by_y = curve.end.x - curve.start.x, curve.end.y - curve.start.y
    x, y = place.x - curve.start.x, place.y - curve.start.y
    square = by_x * by_x + by_y * by_y
    along = x * by_x + y * by_y
    if square <= 0.0 or along < 0.0 or along > square:
        return math.inf
    return abs(x * by_y - y * by_x) / math.sqrt(square)


def area_of(curves: list[Curve]) -> float:
    """Signed area that a loop of curves encloses, µm², positive counter-clockwise; arcs as 24 chords."""
    twice = 0.0
    for curve in curves:
        points = points_on(curve)
        for number in range(len(points) - 1):
            first, last = points[number], points[number + 1]
            twice += first.x * last.y - last.x * first.y
    return twice / 2.0
