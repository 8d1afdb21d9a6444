"""Numbers of the blocks beside the path: none covers another, and where there are many, some stand for all."""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import along
from sim.show.draw.labels import Anchors, number_stride, place_numbers
from sim.show.draw.layout import Box, View
from sim.show.draw.paints import Paint
from sim.show.pictures.cut.subject import Board
from sim.show.words import Words

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
