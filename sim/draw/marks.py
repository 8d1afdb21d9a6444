"""Marks on the path: where it starts and ends, which way it runs, and the blocks' numbers."""

from typing import Final

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath
from sim.draw import style
from sim.draw.canvas import Canvas
from sim.draw.flatten import along
from sim.draw.labels import Anchors, Room, number_stride, place_numbers
from sim.draw.layout import Box, Page, View, box_around

ARROW_AT: Final = 2 / 3
"""Past the middle, so that the arrows of a way out and back on one line stand apart."""

NUMBERS_AT: Final = (0.5, 0.4, 0.6, 0.3, 0.7)
"""Where along a block its number may stand, best first."""


def draw_marks(canvas: Canvas, page: Page, toolpath: Toolpath, room: Room, kerf_px: float) -> str:
    """Draw the markers, arrows and block numbers of a path.

    Parameters
    ----------
    canvas, page
        Where to draw.
    toolpath
        At least one block.
    room
        What is free for them.
    kerf_px
        Width of the drawn kerf.

    Returns
    -------
    What the numbers are, for the legend, such as ``every 100th block number``.
    """
    unit = page.unit
    start, end = page.view.to_px(np.stack([toolpath.start_um[0], toolpath.end_um[-1]]))
    reach = 2 * (style.CROSS + style.MARK_WIDTH) * unit
    for marker in (start, end):
        room.block(box_around(marker, reach, reach))
    _draw_arrows(canvas, page, toolpath, room)
    draw_start(canvas, start, unit)
    draw_end(canvas, end, unit)
    return _draw_numbers(canvas, page, toolpath, room, min(kerf_px / 2, style.NUMBER_GAP * unit))


def draw_start(canvas: Canvas, center: Floats, unit: float) -> None:
    """Draw the hollow circle of a start at `center`, (2,) px."""
    canvas.ring(center, style.MARK * unit, style.START, style.MARK_WIDTH * unit)


def draw_end(canvas: Canvas, center: Floats, unit: float) -> None:
    """Draw the cross of an end at `center`, (2,) px."""
    arm = style.CROSS * unit * np.array([1.0, 1.0]) / np.sqrt(2)
    for mirror in ((1.0, 1.0), (1.0, -1.0)):
        canvas.polyline(np.stack([center - arm * mirror, center + arm * mirror]), style.END, style.MARK_WIDTH * unit)


def draw_number(canvas: Canvas, box: Box, number: str, unit: float) -> None:
    """Draw a block number in its box."""
    canvas.box(box, style.WHITE, style.FRAME, unit)
    middle = ((box.left + box.right) / 2, (box.top + box.bottom) / 2)
    canvas.text(middle, number, style.NUMBER * unit, style.INK, align=0.5)


def number_size(canvas: Canvas, number: str, unit: float) -> tuple[float, float]:
    """Width and height of the box of a block number, px."""
    text = canvas.text_width(number, style.NUMBER * unit)
    return text + 2 * style.NUMBER_INSET * unit, 1.25 * style.NUMBER * unit


def _on_page(view: View, toolpath: Toolpath, row: Ints, share: float) -> tuple[Floats, Floats]:
    """Places in blocks and directions of travel there, both (n, 2) on the page."""
    points, heading = along(toolpath, row, np.full(len(row), share))
    return view.to_px(points), heading * (1.0, -1.0)


def _draw_arrows(canvas: Canvas, page: Page, toolpath: Toolpath, room: Room) -> None:
    size = style.ARROW * page.unit
    row = _arrow_rows(toolpath.length_um * page.view.px_per_um, page.unit)
    centers, heading = _on_page(page.view, toolpath, row, ARROW_AT)
    for center, ahead, jump in zip(centers, heading, toolpath.is_jump[row], strict=True):
        if room.take([box_around(center, size, size)]):
            canvas.arrow(center + ahead * size / 2, ahead, size, style.JUMP if jump else style.IDEAL)


def _arrow_rows(length_px: Floats, unit: float) -> Ints:
    """Every long block, and one short block in each stretch of travel."""
    travel = np.cumsum(length_px)
    spacing = max(style.ARROW_SPACING * unit, float(travel[-1]) / 60)
    passed = np.diff(np.floor(travel / spacing), prepend=0.0) > 0
    return np.flatnonzero(passed | (length_px >= style.ARROW_BLOCK_MIN * unit))


def _draw_numbers(canvas: Canvas, page: Page, toolpath: Toolpath, room: Room, inset: float) -> str:
    stride = number_stride(len(toolpath))
    row = np.arange(stride - 1, len(toolpath), stride)
    row = row[np.argsort(-toolpath.length_um[row], kind="stable")]
    texts = [str(number) for number in row + 1]
    sizes = np.array([number_size(canvas, text, page.unit) for text in texts])
    anchors = [_anchors(page.view, toolpath, row, share) for share in NUMBERS_AT]
    places = place_numbers(anchors, sizes, style.NUMBER_GAP * page.unit + inset, room)
    for text, box in zip(texts, places, strict=True):
        if box:
            draw_number(canvas, box, text, page.unit)
    return _numbers_text(stride, all(places))


def _anchors(view: View, toolpath: Toolpath, row: Ints, share: float) -> Anchors:
    points, heading = _on_page(view, toolpath, row, share)
    return Anchors(points, np.stack([-heading[:, 1], heading[:, 0]], axis=1))


def _numbers_text(stride: int, complete: bool) -> str:
    every = {1: "", 2: "every 2nd "}.get(stride, f"every {stride}th ")
    return f"{every}block number{'' if complete else ' that fits'}"
