"""When each of the parts of a cut comes free: each is asked in a box of its own, to take as long as it is large.

A box tells when the kerf closes round a part, and what the part was one with just before. Was that the frame, or
another part round which the kerf closed later, then that is when it comes free. Was it a part round which the kerf had
closed before, then both came free together. Else it is asked again in a larger box, in the end in all of the stock.

A part that lies alone in a hole of the frame, or of a part that other contours cut, came free by its own kerf: no
larger box is needed to tell.
"""

import heapq
from typing import NamedTuple

import numpy as np
import shapely

from sim.cut.kerf.swept import Box, Swept
from sim.cut.pieces.frees import Closing, FreeMoment, FreeQuestion, closing_of, question_of

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
    swept
        What the wire swept on each contour.
    offset_um
        Half the width that the wire cuts.
    """

    stock_um: shapely.Polygon
    frame_um: shapely.Polygon
    parts_um: list[shapely.Polygon]
    contours: list[list[int]]
    swept: tuple[Swept, ...]
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
        if neighbour not in parts or cutting.contours[neighbour] != cutting.contours[part]:
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
    box = _grown(before.box, max(high_x - low_x, high_y - low_y))
    return _boxed_part(cutting, part, question_of(cutting.stock_um, box, before.piece, before.frame))


def _boxed_part(cutting: Cutting, part: int, question: FreeQuestion) -> _BoxedPart | None:
    closing = closing_of(question, cutting.swept, cutting.contours[part], cutting.offset_um)
    if closing is not None:
        return _BoxedPart(part, question, closing)
    return None if question.is_whole else _asked_again(cutting, part, question)


def _grown(box: Box, by_um: float) -> Box:
    low_x, low_y, high_x, high_y = np.array(box).tolist()
    return low_x - by_um, low_y - by_um, high_x + by_um, high_y + by_um
