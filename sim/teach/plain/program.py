"""Marks of a program against its drawing: what of it is right, part by part, and where it is not."""

import math
from typing import NamedTuple

from sim.teach.plain.blocks import Block, Listing, read_listing
from sim.teach.plain.curves import (
    Curve,
    Point,
    area_of,
    decoded,
    distance,
    distance_to,
    is_endless,
    length_of,
    points_on,
    with_axis_named,
)
from sim.teach.plain.stepping import motion_quadrant
from sim.teach.plain.tasks import arc_axis, line_axis

PARTS = ["reads", "closes", "shape", "offset", "thread", "direction", "count", "end"]
"""Parts of the mark of a program."""
_ROUNDED_APART = 3
"""µm by which J and X, Y of an arc may be rounded apart."""
_MOST_LEADS = 2


class Variant(NamedTuple):
    """A way round a drawing: ``right``, ``no-offset`` or ``wrong-side``, its curves in the order of cutting, µm."""

    name: str
    curves: list[Curve]


class Target(NamedTuple):
    """What a program is to cut.

    Attributes
    ----------
    thread
        Where the wire is threaded, µm.
    turn
        1 counter-clockwise, −1 clockwise, 0 either way.
    within_um
        How far a path may lie off.
    variants
        Ways round the drawing, the right ones first.
    """

    thread: Point
    turn: int
    within_um: float
    variants: list[Variant]


class Written(NamedTuple):
    """A program as it was read.

    Attributes
    ----------
    curves
        What is cut, µm.
    is_read
        Whether all of it could be read, and something is cut.
    words_fit
        1 where J, G and Z of all blocks go by the rules, 0 where not, −1 in a language that has no such words.
    wrong_block
        The first block whose words do not, from 1; 0 where there is none.
    ends
        Whether it ends as a machine needs it, with nothing behind that.
    """

    curves: list[Curve]
    is_read: bool
    words_fit: int
    wrong_block: int
    ends: bool


class ProgramMark(NamedTuple):
    """What of a program is right.

    Attributes
    ----------
    reads, closes, shape, offset, thread, direction, counts, end
        Each right or not; `counts` is 1, 0, or −1 in a language without count lengths.
    fits
        The variant that the path comes nearest to; empty where nothing closes.
    off_um
        How far it lies off that, at the most, once its middle lies on that of the drawing; where that is near enough,
        about how far.
    moved_um
        How far its middle lies beside that of the drawing.
    at
        Where it lies off most.
    at_block, wrong_block
        The block there, and the first block whose words do not go by the rules, from 1; 0 where there is none.
    """

    reads: bool
    closes: bool
    shape: bool
    offset: bool
    thread: bool
    direction: bool
    counts: int
    end: bool
    fits: str
    off_um: float
    moved_um: float
    at: Point
    at_block: int
    wrong_block: int


def written_of(text: str, thread: Point) -> Written:
    """A program in 3B, threaded at a place."""
    listing = read_listing(text)
    curves = decoded(listing.blocks, thread)
    wrong = first_wrong(listing.blocks, curves)
    is_read = len(listing.unread) == 0 and len(listing.blocks) > 0
    return Written(curves, is_read, 1 if wrong == 0 else 0, wrong, _ends(listing))


def _ends(listing: Listing) -> bool:
    """Whether ``DD`` stands behind the last block, and nothing behind that."""
    if len(listing.marks) == 0 or listing.behind_end > 0:
        return False
    last = listing.marks[len(listing.marks) - 1]
    return last.is_end and last.after == len(listing.blocks)


def first_wrong(blocks: list[Block], curves: list[Curve]) -> int:
    """The first block, from 1, whose count length, count direction or quadrant goes against the rules; 0 if none."""
    for number in range(len(blocks)):
        block, curve = with_axis_named(blocks[number]), curves[number]
        fits = line_fits(block) if block.turn == 0 else arc_fits(block, curve)
        if is_endless(block) or block.count_um == 0 or not fits:
            return number + 1
    return 0


def line_fits(block: Block) -> bool:
    """Whether a line goes by the rules; where X and Y are reduced J carries the length, elsewhere it is the longer."""
    longer = max(block.x, block.y)
    is_reduced = block.count_um > longer and (longer < 1000 or block.count_um % longer == 0)
    axes = [1, 3] if block.y == 0 else [2, 4]
    on_axis = block.x == 0 or block.y == 0
    if on_axis and block.quadrant not in axes:
        return False
    near = max(block.x, block.y) - min(block.x, block.y) <= 1
    fits_axis = near or block.axis == line_axis(block.x, block.y, block.quadrant)
    return fits_axis and (abs(block.count_um - longer) <= 1 or is_reduced)


def arc_fits(block: Block, curve: Curve) -> bool:
    """Whether an arc goes by the rules; near 45° either count direction will do."""
    end_x, end_y = curve.end.x - curve.centre.x, curve.end.y - curve.centre.y
    near = abs(abs(end_x) - abs(end_y)) <= _ROUNDED_APART
    start_x, start_y = curve.start.x - curve.centre.x, curve.start.y - curve.centre.y
    is_once = block.count_um <= 4.0 * curve.radius + 4.0
    on_axis = block.x == 0 or block.y == 0
    fits_sense = not on_axis or motion_quadrant(block.turn, start_x, start_y) == block.quadrant
    return is_once and fits_sense and (near or block.axis == arc_axis(end_x, end_y))


class _Loop(NamedTuple):
    """The blocks of a program that go round: from the first, from 0, to before the last; nothing where both are 0."""

    first: int
    past: int


class _Off(NamedTuple):
    """How far a path lies off a variant, µm, where, and on which curve, from 0."""

    off_um: float
    at: Point
    number: int


class _Box(NamedTuple):
    """Lowest and highest places, µm."""

    low_x: float
    low_y: float
    high_x: float
    high_y: float


def program_mark(target: Target, written: Written) -> ProgramMark:
    """Mark of a program against what it is to cut; what does not close has no shape, offset or direction."""
    loop = _loop_in(written.curves, target)
    if loop.past == 0:
        return ProgramMark(
            written.is_read, False, False, False, False, False,
            written.words_fit, written.ends, "", 0.0, 0.0, target.thread, 0, written.wrong_block,
        )  # fmt: skip
    curves = written.curves[loop.first : loop.past]
    best = _Off(math.inf, target.thread, 0)
    fits, moved = "", Point(0.0, 0.0)
    for variant in target.variants:
        by = _moved_by(curves, variant.curves)
        off = _off_of(curves, variant.curves, by, target.within_um)
        if off.off_um < best.off_um:
            best, fits, moved = off, variant.name, by
            if off.off_um <= target.within_um:
                break
    moved_um = math.sqrt(moved.x * moved.x + moved.y * moved.y)
    is_shape = best.off_um <= target.within_um
    back_um = distance(written.curves[len(written.curves) - 1].end, target.thread)
    turn = 1 if area_of(curves) > 0.0 else -1
    return ProgramMark(
        reads=written.is_read,
        closes=True,
        shape=is_shape,
        offset=is_shape and fits == "right",
        thread=is_shape and moved_um <= target.within_um and back_um <= target.within_um,
        direction=target.turn in {0, turn},
        counts=written.words_fit,
        end=written.ends,
        fits=fits,
        off_um=best.off_um,
        moved_um=moved_um,
        at=best.at,
        at_block=loop.first + best.number + 1,
        wrong_block=written.wrong_block,
    )


def _loop_in(curves: list[Curve], target: Target) -> _Loop:
    """The shortest way in a path that ends where it began, past at most two leads, and is half the drawing long."""
    least = 0.0
    for curve in target.variants[0].curves:
        least += 0.5 * length_of(curve)
    best, found = math.inf, _Loop(0, 0)
    for first in range(min(_MOST_LEADS + 1, len(curves))):
        length = 0.0
        for number in range(first, len(curves)):
            length += length_of(curves[number])
            closes = distance(curves[first].start, curves[number].end) <= target.within_um
            if closes and least <= length < best:
                best, found = length, _Loop(first, number + 1)
    return found


def _box_of(curves: list[Curve]) -> _Box:
    """The box of curves, by their places."""
    low_x, low_y, high_x, high_y = math.inf, math.inf, -math.inf, -math.inf
    for curve in curves:
        for point in points_on(curve):
            low_x, high_x = min(low_x, point.x), max(high_x, point.x)
            low_y, high_y = min(low_y, point.y), max(high_y, point.y)
    return _Box(low_x, low_y, high_x, high_y)


def _moved_by(curves: list[Curve], others: list[Curve]) -> Point:
    """How far the middle of the box of curves lies beside that of others."""
    box, other = _box_of(curves), _box_of(others)
    x = box.low_x + box.high_x - other.low_x - other.high_x
    y = box.low_y + box.high_y - other.low_y - other.high_y
    return Point(x / 2.0, y / 2.0)


def _off_of(curves: list[Curve], others: list[Curve], by: Point, within_um: float) -> _Off:
    """How far curves lie off others that are moved by so much, either from the other."""
    worst, at, at_number, near = 0.0, Point(0.0, 0.0), 0, 0
    for number in range(len(curves)):
        for point in points_on(curves[number]):
            nearest = _nearest(others, Point(point.x - by.x, point.y - by.y), near, within_um)
            near = nearest.number
            if nearest.off_um > worst:
                worst, at, at_number = nearest.off_um, point, number
    near = 0
    for other in others:
        for point in points_on(other):
            back = _nearest(curves, Point(point.x + by.x, point.y + by.y), near, within_um)
            near = back.number
            if back.off_um > worst:
                worst, at, at_number = back.off_um, back.at, back.number
    return _Off(worst, at, at_number)


def _nearest(curves: list[Curve], place: Point, begin: int, within_um: float) -> _Off:
    """The nearest of curves to a place, and how far it is; the first one, from `begin` on, that is near enough."""
    least, nearest = math.inf, 0
    for count in range(len(curves)):
        number = (begin + count) % len(curves)
        off_um = distance_to(curves[number], place)
        if off_um < least:
            least, nearest = off_um, number
            if off_um <= within_um:
                break
    return _Off(least, place, nearest)


def parts_of(mark: ProgramMark) -> list[int]:
    """Parts of a mark in the order of `PARTS`: 1 right, 0 not, −1 where there is no such thing in the language."""
    rights = [mark.reads, mark.closes, mark.shape, mark.offset, mark.thread, mark.direction]
    parts: list[int] = [1 if is_right else 0 for is_right in rights]
    parts.append(mark.counts)
    parts.append(1 if mark.end else 0)
    return parts


def program_share(mark: ProgramMark, weights: list[float]) -> float:
    """Share of a program that is right, its parts weighed as in `PARTS`; one that the language lacks has none."""
    parts = parts_of(mark)
    right, whole = 0.0, 0.0
    for number in range(len(parts)):
        if parts[number] >= 0:
            whole += weights[number]
            right += weights[number] * parts[number]
    return right / whole if whole > 0.0 else 0.0
