"""When pieces come free: the first place of the wire at which their kerf parts them from the frame.

Whether a piece is parted is asked in a box round it, with the kerf that lies there. What the kerf closes in within the
box is free. What reaches the border of the box, or the frame, is not free as far as the box tells.

When each of the parts of a cut comes free: each is asked in a box of its own, to take as long as it is large.

A box tells when the kerf closes round a part, and what the part was one with just before. Was that the frame, or
another part round which the kerf closed later, then that is when it comes free. Was it a part round which the kerf had
closed before, then both came free together. Else it is asked again in a larger box, in the end in all of the stock.

A part that lies alone in a hole of the frame, or of a part that other contours cut, came free by its own kerf: no
larger box is needed to tell.
"""

import heapq
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from sim.cut.kerf.swept import Box, Swept, SweptContours
from sim.cut.kerf.ways import last_beside
from sim.cut.regions import Region, difference, union_all

_FEW = 64  # stretches near a box of which each is looked at; of more, regions of several are there already
_SPARED = 0.1  # offsets: a wire that reaches less deep into a piece only takes off what an earlier cut left on it


class FreeMoment(NamedTuple):
    """When a piece comes free.

    Attributes
    ----------
    contour
        Index of the contour.
    at
        Index of the place on the wire's way through it.
    piece_um
        The piece at that moment; what is cut later may still take from it.
    """

    contour: int
    at: int
    piece_um: shapely.Polygon


class Closing(NamedTuple):
    """When the kerf closes round a piece within a box, and what the piece was one with in there just before."""

    moment: FreeMoment
    hung_um: Region


class FreeQuestion(NamedTuple):
    """The question whether a piece is closed in within a box.

    Attributes
    ----------
    box
        Lowest x and y, highest x and y, µm.
    stock_um
        What there is of piece and frame within the box.
    border_um
        The border of the box, as far as the stock goes on behind it.
    piece, frame
        A point in the piece, and one in the frame.
    """

    box: Box
    stock_um: Region
    border_um: Region
    piece: shapely.Point
    frame: shapely.Point

    @property
    def is_whole(self) -> bool:
        """Whether the box holds all of the stock, so that the answer is final."""
        return bool(self.border_um.is_empty)

    def part_left(self, part_um: Region, kerf_um: Region) -> shapely.Polygon:
        """What a kerf leaves of a part round the point of the piece; empty where it has taken that."""
        parts = np.array(parted(part_um, kerf_um), dtype=np.object_)
        held_polygons: list[shapely.Polygon] = parts[shapely.contains(parts, self.piece)].tolist()
        return held_polygons[0] if held_polygons else shapely.Polygon()

    def is_free(self, part: shapely.Polygon) -> bool:
        """Whether such a part is closed in."""
        if part.is_empty:
            return False
        return not (part.contains(self.frame) or part.intersects(self.border_um))


def question_of(stock_um: shapely.Polygon, box: Box, piece: shapely.Point, frame: shapely.Point) -> FreeQuestion:
    """The question within a box, or within all of the stock where the box holds it."""
    square = shapely.box(*box)
    if square.contains(stock_um):
        return FreeQuestion(box, stock_um, shapely.LineString(), piece, frame)
    within = shapely.intersection(stock_um, square)
    return FreeQuestion(box, within, shapely.intersection(square.exterior, stock_um), piece, frame)


def parted(stock_um: Region, kerf_um: Region) -> list[shapely.Polygon]:
    """Parts of a stock, µm, that a kerf leaves, each a polygon; none where it leaves nothing."""
    parts: list[shapely.Polygon] = shapely.get_parts(difference(stock_um, kerf_um)).tolist()
    return parts


def closing_of(question: FreeQuestion, cut: SweptContours, contours: list[int]) -> Closing | None:
    """The first moment at which the kerfs of some contours, in the order they are cut, answer the question with yes."""
    part = question.part_left(question.stock_um, shapely.Polygon())
    for contour in contours:
        near = _near(question.box, cut, contour)
        after = _part_round(question, part, near.within(0, len(near.stretch)))
        if question.is_free(after):
            return _within(question, part, near, FreeMoment(contour, -1, after))
        part = after
    return None


class _Near(NamedTuple):
    """Stretches of a contour, among which are all that come near a box.

    Attributes
    ----------
    swept
        Of the contour.
    stretch
        Their indices.
    within
        What is swept on some of them, from a first to one past the last of `stretch`, as far as it comes near the box.
    """

    swept: Swept
    stretch: Sequence[int]
    within: Callable[[int, int], list[Region]]


def _near(box: Box, cut: SweptContours, contour: int) -> _Near:
    """Where few come near the box, these alone; else all of the contour, of which several are joined already."""
    swept = cut.swept[contour]
    near = swept.stretches_near(box)
    if len(near) > _FEW:
        return _Near(swept, range(len(swept.is_band)), lambda low, past: swept.near(low, past, box))
    regions = cut.stretches(contour, near)
    return _Near(swept, near.tolist(), lambda low, past: regions[low:past])


def _part_round(question: FreeQuestion, part: shapely.Polygon, kerfs: list[Region]) -> shapely.Polygon:
    return question.part_left(part, union_all(kerfs)) if kerfs else part


def _within(question: FreeQuestion, hung: shapely.Polygon, near: _Near, whole: FreeMoment) -> Closing:
    """The moment on the wire's way whose whole kerf frees the piece: halves the stretches, then the places of one."""
    low, high, piece = 0, len(near.stretch), whole.piece_um
    while high - low > 1:
        middle = low + (1 << ((high - low - 1).bit_length() - 1))  # as the tree of the regions is halved
        after = _part_round(question, hung, near.within(low, middle))
        if question.is_free(after):
            high, piece = middle, after
        else:
            low, hung = middle, after
    swept, stretch = near.swept, near.stretch[low]
    first, past = swept.border[stretch : stretch + 2].tolist()
    reaching = first + _reaching(swept.way.place_um[first:past], hung.bounds, swept.offset_um)
    before, since = hung, int(reaching[0])
    low, high = since - 1, int(reaching[-1])
    while high - low > 1:
        at = (low + high) // 2
        after = question.part_left(before, swept.up_to(stretch, at, since))
        if question.is_free(after):
            high, piece = at, after
        else:
            low, hung = at, after
    return Closing(FreeMoment(whole.contour, high, piece), hung)


def _reaching(place_um: Floats, box: Box, offset_um: float) -> Ints:
    """Indices of the places (m, 2) whose discs come near a box; of the first where none does."""
    x, y = place_um.T
    near_x = (x >= box[0] - offset_um) & (x <= box[2] + offset_um)
    near = np.flatnonzero(near_x & (y >= box[1] - offset_um) & (y <= box[3] + offset_um))
    return near if len(near) else np.zeros(1, dtype=np.int64)


class Rest(NamedTuple):
    """What the wire sweeps on a contour from one of the places of its way on, by its index."""

    swept: Swept
    first: int


def cut_on_um(piece_um: shapely.Polygon, rests: Iterable[Rest], offset_um: float) -> float:
    """How far the wire goes on in a piece, not counting where it runs along its own kerf again."""
    shapely.prepare(piece_um)
    inside = [(rest, _inside(piece_um, rest, offset_um)) for rest in rests]
    length = np.concatenate([_lengths_um(rest, at) for rest, at in inside])
    place = np.concatenate([rest.swept.way.place_um[at] for rest, at in inside])
    return float(length[~_again(place, np.cumsum(length), offset_um)].sum())


def _inside(piece_um: shapely.Polygon, rest: Rest, offset_um: float) -> Ints:
    """Indices of the places from which the wire cuts in a piece."""
    reach = (1.0 - _SPARED) * offset_um
    swept = rest.swept
    stretch = swept.stretches_near(piece_um.bounds)
    # Most stretches near a piece run beside it: then no place of them needs a look.
    chord, off_um = swept.chords_of(stretch)
    runs_in = shapely.dwithin(piece_um, shapely.linestrings(chord), reach + off_um)  # type: ignore[call-overload]
    stretch = stretch[runs_in]
    near = swept.places_of(stretch)
    near = near[near >= rest.first]
    low_x, low_y, high_x, high_y = piece_um.bounds
    x, y = swept.way.place_um[near].T
    is_near = (x >= low_x - reach) & (x <= high_x + reach) & (y >= low_y - reach) & (y <= high_y + reach)
    near = near[is_near]
    inside: Ints = near[shapely.dwithin(piece_um, shapely.points(swept.way.place_um[near]), reach)]
    return inside


def _lengths_um(rest: Rest, at: Ints) -> Floats:
    """How far it is to each of some places of a rest from the one before."""
    along = rest.swept.way.along_um
    lengths: Floats = along[at] - along[np.maximum(at - 1, rest.first)]
    return lengths


def _again(place_um: Floats, along_um: Floats, offset_um: float) -> NDArray[np.bool_]:
    """Whether the way was at each of the places (m, 2) before: more than an offset earlier by its length (m,)."""
    if not len(along_um) or along_um[-1] - along_um[0] <= offset_um:
        return np.zeros(len(place_um), dtype=np.bool_)
    reach = _SPARED * offset_um
    earliest = len(place_um) - 1 - last_beside(place_um[::-1], place_um, reach, reach)  # seen backwards it is the last
    again: NDArray[np.bool_] = along_um - along_um[earliest] > offset_um
    return again


_BESIDE = 4.0  # offsets from a part to the border of its box: the kerf beside it, and something of what lies behind


class Cutting(NamedTuple):
    """What is cut.

    Attributes
    ----------
    stock_um, frame_um
        The stock, and what of it stays.
    parts_um
        What else is left of it, p parts.
    contours
        (p,) of each: indices of the contours whose kerfs have a share in its outer edge, in order.
    cut
        What the wire swept on each contour.
    offset_um
        Half the width that the wire cuts.
    """

    stock_um: shapely.Polygon
    frame_um: shapely.Polygon
    parts_um: list[shapely.Polygon]
    contours: list[list[int]]
    cut: SweptContours
    offset_um: float


class _BoxedPart(NamedTuple):
    """A part in a box, and when the kerf closes round it in there."""

    part: int
    question: FreeQuestion
    closing: Closing

    @property
    def when(self) -> tuple[int, int]:
        """Contour, and place on the wire's way through it."""
        return self.closing.moment.contour, self.closing.moment.at


def moments_of(cutting: Cutting) -> list[FreeMoment | None]:
    """When each of the parts comes free; None where the contours with a share in its outer edge do not free it."""
    shapely.prepare(cutting.frame_um)
    tree, clamped = shapely.STRtree(cutting.parts_um), shapely.point_on_surface(cutting.frame_um)
    asked_range = {
        each.part: each for part in range(len(cutting.parts_um)) if (each := _first_asked(cutting, part, clamped))
    }
    alone = _alone(cutting)
    freed_with: dict[int, int] = {}
    # Those that close last come first: what they may have hung on is settled then.
    todo = [_in_turn(each) for each in asked_range.values()]
    heapq.heapify(todo)
    while todo:
        part = heapq.heappop(todo)[-1]
        other = part if part in alone else _came_free_with(cutting, tree, asked_range, freed_with, part)
        if other is not None:
            freed_with[part] = other
        elif (again := _asked_again(cutting, part, asked_range[part].question)) is not None:
            asked_range[part] = again
            heapq.heappush(todo, _in_turn(again))
    moments = {part: asked_range[_last(freed_with, part)].closing.moment for part in freed_with}
    return [moments.get(part) for part in range(len(cutting.parts_um))]


def _in_turn(boxed_part: _BoxedPart) -> tuple[int, int, int]:
    contour, at = boxed_part.when
    return -contour, -at, boxed_part.part


def _came_free_with(
    cutting: Cutting, tree: shapely.STRtree, parts: dict[int, _BoxedPart], freed_with: dict[int, int], part: int
) -> int | None:
    """The part that a part came free with, itself where that was when the kerf closed round it; None is not known."""
    boxed = parts[part]
    hung = boxed.closing.hung_um
    if boxed.question.is_whole or cutting.frame_um.intersects(hung):
        return part
    for neighbour in tree.query(hung, predicate="intersects").tolist():
        if neighbour == part or neighbour not in parts or cutting.contours[neighbour] != cutting.contours[part]:
            continue
        other = _last(freed_with, neighbour)
        if parts[other].when != boxed.when:
            return part if parts[other].when > boxed.when else other
    return None


def _alone(cutting: Cutting) -> set[int]:
    """Parts that lie alone in a hole of the frame, or of a part that other contours cut; no others lie in them."""
    rings = [(ring, [-1]) for ring in cutting.frame_um.interiors]
    told_parts = zip(cutting.parts_um, cutting.contours, strict=True)
    rings += [(ring, contours) for part, contours in told_parts for ring in part.interiors]
    if not rings:
        return set()
    inner = shapely.STRtree(shapely.point_on_surface(cutting.parts_um))
    hole, part = inner.query(shapely.polygons([ring for ring, _ in rings]), predicate="contains")
    is_alone = np.bincount(hole, minlength=len(rings))[hole] == 1
    pairs = zip(hole[is_alone].tolist(), part[is_alone].tolist(), strict=True)
    return {at for of, at in pairs if rings[of][1] != cutting.contours[at]}


def _last(freed_with: dict[int, int], part: int) -> int:
    """The part that a part came free with in the end."""
    while freed_with.get(part, part) != part:
        part = freed_with[part]
    return part


def _first_asked(cutting: Cutting, part: int, point: shapely.Point) -> _BoxedPart | None:
    outline = cutting.parts_um[part]
    box = _grown(outline.bounds, _BESIDE * cutting.offset_um)
    question = question_of(cutting.stock_um, box, outline.representative_point(), point)
    return _boxed_part(cutting, part, question)


def _asked_again(cutting: Cutting, part: int, before: FreeQuestion) -> _BoxedPart | None:
    low_x, low_y, high_x, high_y = before.box
    box = _grown(before.box, 0.5 * max(high_x - low_x, high_y - low_y))
    return _boxed_part(cutting, part, question_of(cutting.stock_um, box, before.piece, before.frame))


def _boxed_part(cutting: Cutting, part: int, question: FreeQuestion) -> _BoxedPart | None:
    closing = closing_of(question, cutting.cut, cutting.contours[part])
    if closing is not None:
        return _BoxedPart(part, question, closing)
    return None if question.is_whole else _asked_again(cutting, part, question)


def _grown(box: Box, by_um: float) -> Box:
    low_x, low_y, high_x, high_y = np.array(box).tolist()
    return low_x - by_um, low_y - by_um, high_x + by_um, high_y + by_um
