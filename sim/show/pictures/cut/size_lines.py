"""Sizes drawn as on a drawing: lines with arrows outside of the part, and leaders to radii."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.toolpath import Toolpath
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import along
from sim.show.draw.layout import Box, Margins, Page, box_around
from sim.show.draw.paints import Paint
from sim.show.pictures.cut.sizes import CutSizes, Round, length_text
from sim.show.pictures.cut.subject import Board

MOST_ROUNDS: Final = 6
_ROUND_AT: Final = (0.62, 0.38, 0.75, 0.25, 0.5, 0.87, 0.13)
_MOST_ARCS: Final = 5  # of one radius, that may bear it
_LEAST_ROUND: Final = 14.0  # px; smaller ones are not seen as round


class Extents(NamedTuple):
    """Lines of width and height: the box that they measure and that of the path, both (2, 2) µm, and their sides.

    `sides` (2,) is 0 where the height stands to the left and the width below, 1 to the right and above.
    """

    box_um: Floats
    path_um: Floats
    sides: tuple[int, int]

    def margins(self) -> Margins:
        """Free border inside the frame, with room for the lines."""
        left, right = (style.PAD, style.SIZE_PAD)[:: 1 if self.sides[0] else -1]
        bottom, top = (style.PAD, style.SIZE_PAD)[:: 1 if self.sides[1] else -1]
        return Margins(left, top, right, bottom)

    def lines(self, page: Page) -> tuple[Floats, Floats]:
        """The lines (2, 2) px, each from the lower to the higher coordinate."""
        (left, bottom), (right, top) = page.view.to_px(self.box_um)
        ends = page.view.to_px(self.path_um)
        offset, level = float(ends[self.sides[0], 0]), float(ends[self.sides[1], 1])
        offset += (2 * self.sides[0] - 1) * style.SIZE_AWAY * page.unit
        level -= (2 * self.sides[1] - 1) * style.SIZE_AWAY * page.unit
        return np.array([[left, level], [right, level]]), np.array([[offset, bottom], [offset, top]])


def extents_of(sizes: CutSizes, path_um: Floats) -> Extents | None:
    """Lines outside the whole path, each on the side that the measured box is nearer to; None where there is no box."""
    if sizes.box_um is None:
        return None
    gap = np.abs(path_um - sizes.box_um)
    right, above = bool(gap[1, 0] <= 2.0 * gap[0, 0]), bool(2.0 * gap[1, 1] < gap[0, 1])
    return Extents(sizes.box_um, path_um, (int(right), int(above)))


def draw_extents(board: Board, sizes: CutSizes, extents: Extents) -> None:
    """Draw width and height of what is kept."""
    page = board.page
    corner = page.view.to_px(extents.box_um)[extents.sides, (0, 1)]
    for axis, line in enumerate(extents.lines(page)):
        length = length_text(float(extents.box_um[1, axis] - extents.box_um[0, axis]))
        text = board.say("cut.path_size", size=length) if sizes.of_path else length
        _draw_limits(board.canvas, page.unit, line, float(corner[1 - axis]))
        board.room.block(_draw_size(board.canvas, page.unit, line, text))


def _draw_limits(canvas: Canvas, unit: float, line: Floats, from_px: float) -> None:
    """Draw the two lines that lead from the part to the line of a size."""
    across = 1 if line[0, 1] == line[1, 1] else 0
    gap = np.sign(line[0, across] - from_px) * style.SIZE_GAP * unit
    for end in line:
        limit = np.stack([end, end])
        limit[0, across] = from_px + gap
        limit[1, across] += gap
        canvas.polyline(limit, Paint.SIZE, 0.7 * style.SIZE_WIDTH * unit)


def _draw_size(canvas: Canvas, unit: float, line: Floats, text: str) -> Box:
    """Draw a line with arrows at both ends and its text in the middle, beyond it where it is short; the text's box."""
    size, arrow = style.SIZE * unit, style.SIZE_ARROW * unit
    length = float(np.abs(line[1] - line[0]).max())
    ahead = (line[1] - line[0]) / length
    wide = canvas.text_width(text, size) + size / 2
    needed = float(np.abs(ahead) @ (wide, 1.2 * size))
    fits = length >= needed + 2.6 * arrow
    half = ahead * needed / 2
    middle = line.mean(axis=0) if fits else line[1] + ahead * 2.0 * arrow + half
    inner = [[line[0], middle - half], [middle + half, line[1]]]
    outer = [line, [line[0], line[0] - 1.9 * arrow * ahead], [line[1], line[1] + 1.9 * arrow * ahead]]
    for stroke in inner if fits else outer:
        canvas.polyline(np.asarray(stroke), Paint.SIZE, style.SIZE_WIDTH * unit)
    for end, way in ((line[0], -ahead), (line[1], ahead)):
        canvas.arrow(end, way if fits else -way, arrow, Paint.SIZE)
    box = box_around(middle, wide, 1.2 * size)
    canvas.box(box, Paint.PAGE, Paint.PAGE, 0.0)
    canvas.text((float(middle[0]), float(middle[1])), text, size, Paint.SIZE, align=0.5)
    return box


def draw_rounds(board: Board, sizes: CutSizes) -> None:
    """Draw the largest radii and diameters, each at one of its arcs, where there is room off the path."""
    for round_ in sizes.rounds[:MOST_ROUNDS]:
        if round_.radius_um * board.page.view.px_per_um >= _LEAST_ROUND * board.page.unit:
            _draw_round(board, round_, sizes.path)


def _draw_round(board: Board, round_: Round, path: Toolpath) -> None:
    canvas, page = board.canvas, board.page
    size, unit = style.SIZE * page.unit, page.unit
    wide = canvas.text_width(round_.text, size) + size / 2
    for arc, outward in _leaders(page, round_, path):
        reach = style.LEADER * unit + float(np.abs(outward) @ (wide, 1.2 * size)) / 2
        box = board.room.take_clear([box_around(arc + outward * reach, wide, 1.2 * size)])
        if box:
            canvas.arrow(arc, -outward, style.SIZE_ARROW * unit, Paint.SIZE)
            canvas.polyline(np.stack([arc, arc + outward * style.LEADER * unit]), Paint.SIZE, style.SIZE_WIDTH * unit)
            middle = ((box.left + box.right) / 2, (box.top + box.bottom) / 2)
            canvas.text(middle, round_.text, size, Paint.SIZE, align=0.5)
            return


def _leaders(page: Page, round_: Round, path: Toolpath) -> Iterator[tuple[Floats, Floats]]:
    """Where a leader may touch the edge that an arc makes, and which way it goes from there: into what is kept first.

    The edge of a hole lies outside of its path, that of a boss inside.
    """
    longest = round_.rows[np.argsort(-np.abs(path.sweep_rad[round_.rows]), kind="stable")][:_MOST_ARCS]
    center = path.center_um[longest]
    side = 1.0 if round_.radius_um > float(path.radius_um[longest[0]]) else -1.0
    for way in (side, -side):
        for share in _ROUND_AT:
            points, _ = along(path, longest, np.full(len(longest), share))
            outward = (points - center) / path.radius_um[longest, None]
            edge = page.view.to_px(center + round_.radius_um * outward)
            yield from zip(edge, way * outward * (1.0, -1.0), strict=True)
