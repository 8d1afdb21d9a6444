"""The travel of the table: its border where it lies in the plot, and the whole table, small, in the head."""

import numpy as np

from parser.geometry.curves import Floats
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box, Page, View
from sim.show.draw.paints import Paint
from sim.show.draw.simplify import simplify
from sim.show.words.pictures import Words


def draw_border(canvas: Canvas, page: Page, travel_um: Floats) -> None:
    """Draw the border of the travel as far as it lies in the plot."""
    corners = _corners(page.view.to_px(travel_um))
    near = Box(page.plot.left - 99, page.plot.top - 99, page.plot.right + 99, page.plot.bottom + 99)
    limits = np.clip(corners, [near.left, near.top], [near.right, near.bottom])
    with canvas.clipped(page.plot):
        canvas.dashed(limits, Paint.TRAVEL, 1.5 * style.JUMP_WIDTH * page.unit, 30 * page.unit, 12 * page.unit)


def shows_border(page: Page, travel_um: Floats) -> bool:
    """Whether any of the border lies in the plot."""
    low, high = page.view.range_um(page.plot)
    apart = (travel_um[0] >= high).any() or (travel_um[1] <= low).any()
    return not apart and not ((travel_um[0] < low).all() and (travel_um[1] > high).all())


def draw_table(canvas: Canvas, page: Page, say: Words, travel_um: Floats, runs_px: list[Floats]) -> float:
    """Draw the table with the path on it into the right of the head, with its size; the width of both, px.

    `runs_px` are stretches of the path, (k, 2) px of the plot.
    """
    unit, size = page.unit, style.NOTE * page.unit
    points = np.concatenate([travel_um, *(page.view.to_um(run) for run in runs_px)])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = style.TABLE * unit / float((high - low).max())
    right, top = page.width_px - style.EDGE * unit, (style.HEAD - style.TABLE) / 2 * unit
    view = View(scale, right - float(high[0]) * scale, top + float(high[1]) * scale)
    corners = _corners(view.to_px(travel_um))
    canvas.polyline(corners, Paint.TRAVEL, style.SIZE_WIDTH * unit)
    for run in runs_px:
        canvas.polyline(simplify(view.to_px(page.view.to_um(run)), 0.2), Paint.IDEAL, unit)
    start = view.to_px(page.view.to_um(runs_px[0][0])) if runs_px else corners[0]
    canvas.disc(start, 0.2 * style.MARK * unit, Paint.START)
    x_mm, y_mm = mm(travel_um[1] - travel_um[0]).tolist()
    text = say("cut_travel", x=f"{x_mm:g}", y=f"{y_mm:g}")
    left = right - float((high - low)[0]) * scale - style.LEGEND_GAP * unit
    canvas.text((left, 0.72 * style.HEAD * unit), text, size, Paint.GREY, align=1.0)
    return page.width_px - style.EDGE * unit - left + canvas.text_width(text, size) + style.LEGEND_GAP * unit


def _corners(box_px: Floats) -> Floats:
    """Border (5, 2) of a box that two corners (2, 2) span."""
    (left, bottom), (right, top) = box_px
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]])
