"""Borders of blocks over the length of the path, and the numbers of the blocks in a strip above the chart."""

from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from parser.toolpath import Toolpath
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import Chart
from sim.show.draw.labels import number_stride
from sim.show.draw.layout import Box
from sim.show.draw.paints import Paint

LEAST_APART: Final = 12.0
"""Of borders that are closer together than this in the mean only some show."""
BORDER_WIDTH: Final = 1.5
APART: Final = 8.0
"""From number to number, at least."""


def all_show(chart: Chart, toolpath: Toolpath) -> bool:
    """Whether there is room for all borders; else those at the ends of the numbered blocks show."""
    return len(toolpath) * LEAST_APART * chart.unit <= chart.frame.right - chart.frame.left


def draw_borders(canvas: Canvas, chart: Chart, toolpath: Toolpath, height: float) -> None:
    """Draw borders down the chart, jumps as bars in a strip of a height above it, and numbers of blocks there."""
    x = chart.x_px(mm(toolpath.before_um))
    top, unit = chart.frame.top - height, chart.unit
    for row in np.flatnonzero(toolpath.is_jump).tolist():
        box = Box(float(x[row]), top + 0.8 * height, float(x[row + 1]), top + 0.95 * height)
        canvas.box(box, Paint.JUMP, Paint.JUMP, 0.0)
    shown = numbers(canvas, x, unit)
    borders = x[1:-1] if all_show(chart, toolpath) else x[[row + 1 for row, _ in shown]]
    for at in borders.tolist():
        line = np.array([[at, chart.frame.top - 0.2 * height], [at, chart.frame.bottom]])
        canvas.polyline(line, Paint.FRAME, BORDER_WIDTH * unit)
    for row, at in shown:
        canvas.text((at, top + 0.42 * height), str(row + 1), style.NUMBER * unit, Paint.INK, align=0.5)


def numbers(canvas: Canvas, x: Floats, unit: float) -> list[tuple[int, float]]:
    """Rows whose numbers show, and where, px, between borders `x` (n + 1,): long blocks first, none over another."""
    blocks = len(x) - 1
    stride = number_stride(blocks)
    rows = np.arange(stride - 1, blocks, stride)
    wide = np.array([canvas.text_width(str(row + 1), style.NUMBER * unit) + APART * unit for row in rows.tolist()])
    middle = np.clip((x[rows] + x[rows + 1]) / 2.0, x[0] + wide / 2.0, x[-1] - wide / 2.0)
    taken: list[int] = []
    for at in np.argsort(x[rows] - x[rows + 1], kind="stable").tolist():
        if all(abs(middle[at] - middle[other]) >= (wide[at] + wide[other]) / 2.0 for other in taken):
            taken.append(at)
    return [(int(rows[at]), float(middle[at])) for at in sorted(taken)]
