"""Marks on the path: where it starts, pauses and ends, and which way it runs.

Numbers of the blocks beside the path: none covers another, and where there are many, some stand for all.
"""

from itertools import product
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.toolpath import Stop, Toolpath
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import along
from sim.show.draw.labels import Anchors, number_stride, place_numbers
from sim.show.draw.layout import Box, View, box_around
from sim.show.draw.paints import Paint
from sim.show.pictures.cut.subject import Board
from sim.show.texts import Words

NUMBERS_AT: Final = (0.5, 0.4, 0.6, 0.3, 0.7)
"""Where along a block its number may stand, best first."""


class Numbers(NamedTuple):
    """Every how manyth block shows its number, and whether all of these do."""

    stride: int
    complete: bool

    def text(self, say: Words) -> str:
        """What the numbers are, such as ``every 100th block number``."""
        key = f"cut.numbers_{self.stride}" if self.stride <= 2 else "cut.numbers"
        numbers = say(key, stride=self.stride)
        return numbers if self.complete else say("cut.numbers_fit", numbers=numbers)


def draw_numbers(board: Board, toolpath: Toolpath, kerf_px: float) -> Numbers:
    """Draw block numbers beside a kerf of a drawn width, as the listing has them."""
    canvas, page = board.canvas, board.page
    stride = number_stride(int(toolpath.source.block.max()))
    row = _rows(toolpath, stride)
    texts = [toolpath.source.names.of_row(at) for at in row.tolist()]
    sizes = np.array([number_size(canvas, text, page.unit) for text in texts]).reshape(-1, 2)
    anchors = [_anchors(page.view, toolpath, row, share) for share in NUMBERS_AT]
    gap = style.NUMBER_GAP * page.unit
    places = place_numbers(anchors, sizes, gap + min(kerf_px / 2, gap), board.room)
    for text, box in zip(texts, places, strict=True):
        if box:
            draw_number(canvas, box, text, page.unit)
    return Numbers(stride, all(places))


def draw_number(canvas: Canvas, box: Box, number: str, unit: float) -> None:
    """Draw a block number in its box."""
    canvas.box(box, Paint.PAGE, Paint.FRAME, unit)
    middle = ((box.left + box.right) / 2, (box.top + box.bottom) / 2)
    canvas.text(middle, number, style.NUMBER * unit, Paint.INK, align=0.5)


def number_size(canvas: Canvas, number: str, unit: float) -> tuple[float, float]:
    """Width and height of the box of a block number, px."""
    text = canvas.text_width(number, style.NUMBER * unit)
    return text + 2 * style.NUMBER_INSET * unit, 1.25 * style.NUMBER * unit


def _rows(toolpath: Toolpath, stride: int) -> Ints:
    """The longest row of every `stride`-th block of the program, the longest of all first."""
    row = np.argsort(-toolpath.length_um, kind="stable")
    block = toolpath.source.block[row]
    first = np.sort(np.unique(block, return_index=True)[1])
    rows: Ints = row[first[block[first] % stride == 0]]
    return rows


def _anchors(view: View, toolpath: Toolpath, row: Ints, share: float) -> Anchors:
    points, heading = along(toolpath, row, np.full(len(row), share))
    ways: Floats = heading * (1.0, -1.0)
    return Anchors(view.to_px(points), np.stack([-ways[:, 1], ways[:, 0]], axis=1))


ARROW_AT: Final = 2 / 3
"""Past the middle, so that the arrows of a way out and back on one line stand apart."""

_MOST_PAUSES: Final = 60


def draw_ends(board: Board, toolpath: Toolpath) -> None:
    """Draw the hollow circle of the start and the cross of the end."""
    canvas, page = board.canvas, board.page
    start, end = page.view.to_px(np.stack([toolpath.start_um[0], toolpath.end_um[-1]]))
    reach = 2 * (style.CROSS + style.MARK_WIDTH) * page.unit
    for marker in (start, end):
        board.room.block(box_around(marker, reach, reach))
    draw_start(canvas, start, page.unit)
    draw_end(canvas, end, page.unit)


def draw_start(canvas: Canvas, center: Floats, unit: float) -> None:
    """Draw the hollow circle of a start at `center`, (2,) px."""
    canvas.ring(center, style.MARK * unit, Paint.START, style.MARK_WIDTH * unit)


def draw_end(canvas: Canvas, center: Floats, unit: float) -> None:
    """Draw the cross of an end at `center`, (2,) px."""
    arm = style.CROSS * unit * np.array([1.0, 1.0]) / np.sqrt(2)
    for mirror in ((1.0, 1.0), (1.0, -1.0)):
        canvas.polyline(np.stack([center - arm * mirror, center + arm * mirror]), Paint.END, style.MARK_WIDTH * unit)


def pauses(toolpath: Toolpath) -> list[Stop]:
    """Pauses between blocks, without the end."""
    return [stop for stop in toolpath.stops if stop.kind == "pause"]


def draw_pauses(board: Board, toolpath: Toolpath, *, numbers: bool) -> int:
    """Draw the two bars of each pause, beside the path where it stands, with the block that it follows; how many."""
    canvas, unit = board.canvas, board.page.unit
    corners = board.page.view.to_px(np.concatenate([toolpath.start_um[:1], toolpath.end_um]))
    drawn = 0
    for stop in pauses(toolpath)[:_MOST_PAUSES]:
        number = toolpath.source.names.at(stop.after) if stop.after and numbers else ""
        size = _pause_size(canvas, number, unit)
        corner = corners[min(stop.after, len(toolpath))]
        box = board.room.take(_boxes_beside(corner, size, unit))
        if box:
            drawn += 1
            nearest = np.clip(corner, [box.left, box.top], [box.right, box.bottom])
            canvas.polyline(np.stack([corner, nearest]), Paint.PAUSE, style.SIZE_WIDTH * unit)
            canvas.disc(corner, 2.5 * style.SIZE_WIDTH * unit, Paint.PAUSE)
            draw_pause(canvas, box, number, unit)
    return drawn


def draw_pause(canvas: Canvas, box: Box, number: str, unit: float) -> None:
    """Draw the bars of a pause in a box, and a number behind them."""
    canvas.box(box, Paint.PAGE, Paint.PAUSE, 1.5 * unit)
    side = style.PAUSE * unit
    middle, tall = (box.top + box.bottom) / 2, 0.22 * side
    for share in (0.36, 0.64):
        x = box.left + share * side
        canvas.polyline(np.array([[x, middle - tall], [x, middle + tall]]), Paint.PAUSE, 4.0 * unit)
    canvas.text((box.left + side, middle), number, style.NUMBER * unit, Paint.PAUSE)


def _pause_size(canvas: Canvas, number: str, unit: float) -> tuple[float, float]:
    text = canvas.text_width(number, style.NUMBER * unit) + style.NUMBER_INSET * unit if number else 0.0
    return style.PAUSE * unit + text, style.PAUSE * unit


def _boxes_beside(corner: Floats, size: tuple[float, float], unit: float) -> list[Box]:
    """Boxes about a corner of the path, off its marks."""
    sides = ((1, -1), (-1, -1), (1, 1), (-1, 1), (0, -1), (0, 1), (1, 0), (-1, 0))
    ways = product((1.0, 2.2), sides)
    gap = style.MARK * unit
    return [box_around(corner + np.array(side) * (np.array(size) / 2 + more * gap), *size) for more, side in ways]


def draw_arrows(board: Board, toolpath: Toolpath) -> None:
    """Draw arrow heads along the path where they are not in the way."""
    page = board.page
    size = style.ARROW * page.unit
    row = _arrow_rows(toolpath.length_um * page.view.px_per_um, page.unit)
    points, heading = along(toolpath, row, np.full(len(row), ARROW_AT))
    centers, ways = page.view.to_px(points), heading * (1.0, -1.0)
    for center, ahead, jump in zip(centers, ways, toolpath.is_jump[row], strict=True):
        if board.room.take([box_around(center, size, size)]):
            board.canvas.arrow(center + ahead * size / 2, ahead, size, Paint.JUMP if jump else Paint.IDEAL)


def _arrow_rows(length_px: Floats, unit: float) -> Ints:
    """Every long block, and one short block in each stretch of travel."""
    travel = np.cumsum(length_px)
    spacing = max(style.ARROW_SPACING * unit, float(travel[-1]) / 60)
    passed = np.diff(np.floor(travel / spacing), prepend=0.0) > 0
    return np.flatnonzero(passed | (length_px >= style.ARROW_BLOCK_MIN * unit))
