"""Tasks whose numbers a seed chooses: a block to be written, a block whose end is to be found, a step to be named."""

from typing import NamedTuple

from sim.teach.plain.blocks import Block
from sim.teach.plain.curves import Point
from sim.teach.plain.stepping import motion_quadrant

SHAPES = ["axis", "slope", "diagonal", "quarter", "arc", "circle"]
"""Lines along an axis, sloping and at 45°; arcs in one quadrant, through several, and full circles."""
_MODULUS = 2147483647
_LATTICE_X = [65, 63, 60, 56, 52, 39, 33, 25, 16]
_LATTICE_Y = [0, 16, 25, 33, 39, 52, 56, 60, 63]
"""All places of a quarter of a circle of radius 65 that lie on whole numbers, counter-clockwise from +X."""
_PER_QUARTER = 9


class Task(NamedTuple):
    """A curve with the block that cuts it; places are whole µm.

    Attributes
    ----------
    shape
        One of `SHAPES`.
    start, end, centre
        Where it begins and ends, and its centre; that of a line is its start.
    block
        The block as the trade writes it.
    """

    shape: str
    start: Point
    end: Point
    centre: Point
    block: Block


def seed_of(text: str) -> int:
    """A seed of a text, from 1 to 2³¹ − 2: the same text, the same seed."""
    seed = 17
    for character in text:
        seed = (seed * 31 + ord(character)) % (_MODULUS - 1)
    return seed + 1


def seed_of_task(seed: int, number: int) -> int:
    """The seed of a part, numbered from 0, of what has a seed itself: of an exercise of a sitting, or of its task."""
    return seed_of(f"{seed} {number}")


def next_seed(seed: int) -> int:
    """The next number of the generator of Park and Miller (multiplier 48271), from 1 to 2³¹ − 2."""
    return seed * 48271 % _MODULUS


def chosen(seed: int, low: int, high: int) -> int:
    """A whole number from low to high by a seed. Its low digits are worn by the modulus, so the high ones decide."""
    return low + seed * (high - low + 1) // _MODULUS


def task_of(shape: str, seed: int) -> Task:
    """A task of a shape by a seed."""
    first = next_seed(next_seed(seed))
    second = next_seed(first)
    start = Point(100 * chosen(first, -200, 200), 100 * chosen(second, -200, 200))
    if shape in {"axis", "slope", "diagonal"}:
        return _line_task(shape, start, second)
    return _arc_task(shape, start, second)


def _line_task(shape: str, start: Point, seed: int) -> Task:
    first = next_seed(seed)
    second = next_seed(first)
    third = next_seed(second)
    long, short = 100 * chosen(first, 60, 400), 100 * chosen(second, 5, 50)
    quadrant = chosen(third, 1, 4)
    x, y = long, short
    if shape == "diagonal":
        y = long
    if shape == "axis":
        x, y = (long, 0) if quadrant % 2 == 1 else (0, long)
    if shape == "slope" and next_seed(third) % 2 == 0:
        x, y = short, long
    block = Block(x, y, max(x, y), line_axis(x, y, quadrant), 0, quadrant, 1)
    end = Point(start.x + (x if quadrant in {1, 4} else -x), start.y + (y if quadrant in {1, 2} else -y))
    return Task(shape, start, end, start, block)


def line_axis(x: int, y: int, quadrant: int) -> int:
    """Count direction of a line by the rule of the trade: the longer one; at 45° GY in quadrants 1 and 3, else GX."""
    if x == y:
        return 1 if quadrant % 2 == 1 else 0
    return 0 if x > y else 1


def arc_axis(end_x: float, end_y: float) -> int:
    """Count direction of an arc by where it ends, from the centre: nearer the X axis GY, nearer the Y axis GX."""
    return 1 if abs(end_x) > abs(end_y) else 0


def _lattice(number: int) -> Point:
    """A place on the circle of radius 65 by its number, counter-clockwise from +X; 36 make it whole."""
    quarter, within = number // _PER_QUARTER % 4, number % _PER_QUARTER
    x, y = _LATTICE_X[within], _LATTICE_Y[within]
    if quarter == 0:
        return Point(x, y)
    if quarter == 1:
        return Point(-y, x)
    return Point(-x, -y) if quarter == 2 else Point(y, -x)


def _arc_task(shape: str, start: Point, seed: int) -> Task:
    first = next_seed(seed)
    second = next_seed(first)
    third = next_seed(second)
    fourth = next_seed(third)
    turn = 1 if chosen(first, 0, 1) == 1 else -1
    unit = 20 * chosen(second, 2, 20)
    number, places = _arc_places(shape, third, fourth)
    begins = _lattice(number)
    count_x, count_y = 0.0, 0.0
    ends = begins
    for place in range(1, places + 1):
        following = _lattice(number + 36 + turn * place)
        count_x += abs(following.x - ends.x)
        count_y += abs(following.y - ends.y)
        ends = following
    axis = arc_axis(ends.x, ends.y)
    count = int(unit * (count_x if axis == 0 else count_y))
    quadrant = motion_quadrant(turn, begins.x, begins.y)
    block = Block(int(unit * abs(begins.x)), int(unit * abs(begins.y)), count, axis, turn, quadrant, 1)
    centre = Point(start.x - unit * begins.x, start.y - unit * begins.y)
    return Task(shape, start, Point(centre.x + unit * ends.x, centre.y + unit * ends.y), centre, block)


def _arc_places(shape: str, seed: int, other: int) -> tuple[int, int]:
    """The place where an arc begins, and how many places it goes on."""
    if shape == "circle":
        return _PER_QUARTER * chosen(seed, 0, 3), 4 * _PER_QUARTER
    if shape == "quarter":
        return _PER_QUARTER * chosen(seed, 0, 3) + 4, chosen(other, 2, 4)
    return chosen(seed, 0, 35), chosen(other, 11, 30)
