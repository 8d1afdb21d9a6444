"""Deviation along the path: that of wire and steps over the length of the path, with block borders and tolerance."""

from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from parser.toolpath import Toolpath
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import AxisRange, Chart, columns_of, draw_band, draw_chart, draw_line, stretches
from sim.show.draw.labels import number_stride
from sim.show.draw.layout import Box
from sim.show.draw.legend import Entry, draw_at_foot, in_rows, stroke, swatch
from sim.show.draw.paints import Paint
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.deviation.frame import mark_place, range_shown, titled, tolerance_text, um, write_names
from sim.show.pictures.deviation.samples import Samples
from sim.show.texts import Words

HEIGHT: Final = 0.52
"""Of the page, over its width."""
STRIP: Final = 44.0
"""Height of the strip of block numbers."""
WIRE_WIDTH: Final = 2.2
STEPS_WIDTH: Final = 1.0
BORDER_WIDTH: Final = 1.5
LEAST_APART: Final = 12.0
"""Where borders are closer together than this on average, only some show."""
APART: Final = 8.0
"""Least gap between two numbers."""


def draw_along(sheet: Sheet[AnyCanvas], samples: Samples) -> AnyCanvas:
    """Draw the deviation of wire and steps over the length of the path.

    ValueError where the sheet is narrower than 600 px.
    """
    say, unit = sheet.say, sheet.unit
    foot = HEIGHT * sheet.width_px - 1.8 * style.TICK * unit
    frame = Box(style.LEFT * unit, (style.HEAD + STRIP) * unit, sheet.width_px - style.EDGE * unit, foot)
    chart = _chart(samples, frame, unit)
    legend = in_rows(_entries(say, samples, chart), sheet.width_px, unit)
    canvas = titled(sheet, samples, say("deviation.along"), HEIGHT * sheet.width_px + legend.foot)
    tolerance = AxisRange(-samples.tolerance_um, samples.tolerance_um)
    draw_chart(canvas, chart, tolerance=tolerance)
    draw_borders(canvas, chart, samples.run.toolpath, STRIP * unit)
    write_names(canvas, chart, say("common.path_length"), say("deviation.um"))
    for stretch in stretches(np.flatnonzero(samples.cutting)):
        _draw_stretch(canvas, chart, samples, stretch)
    _mark_worst(canvas, chart, samples, say)
    draw_at_foot(canvas, legend)
    return canvas


def _entries(say: Words, samples: Samples, chart: Chart) -> list[Entry]:
    toolpath = samples.run.toolpath
    border = "deviation.border" if all_show(chart, toolpath) else "deviation.some_borders"
    jump = Entry(stroke(Paint.JUMP, 0.15 * STRIP), say("deviation.jump"))
    wire = swatch(Paint.ACTUAL_PALE, Paint.ACTUAL, WIRE_WIDTH)
    return [
        Entry(wire, say("deviation.wire_band")),
        Entry(swatch(Paint.STEPS_PALE, Paint.STEPS, STEPS_WIDTH), say("deviation.steps_band")),
        Entry(swatch(Paint.BAND, Paint.BAND_EDGE, style.GRID_WIDTH), tolerance_text(say, samples)),
        Entry(stroke(Paint.FRAME, BORDER_WIDTH), say(border)),
        *[jump] * bool(toolpath.is_jump.any()),
    ]


def _chart(samples: Samples, frame: Box, unit: float) -> Chart:
    length = mm(float(samples.run.toolpath.length_um.sum()))
    x = AxisRange(0.0, length) if length > 0.0 else AxisRange(0.0, 1.0)
    return Chart(frame, x, range_shown(samples).wider(0.14), unit)


def _draw_stretch(canvas: Canvas, chart: Chart, samples: Samples, stretch: slice) -> None:
    """Draw what was cut in one go: bands first, so that neither hides the edges of the other."""
    along = mm(samples.along_um[stretch])
    wire = columns_of(chart, along, samples.wire_um[stretch])
    steps = columns_of(chart, along, samples.steps_um[stretch])
    looks = ((wire, Paint.ACTUAL_PALE), (steps, Paint.STEPS_PALE))
    for columns, pale in looks:
        if len(columns.x) > 1:
            draw_band(canvas, chart, columns.x, columns.ends, pale)
    for columns, paint, width in ((steps, Paint.STEPS, STEPS_WIDTH), (wire, Paint.ACTUAL, WIRE_WIDTH)):
        for side in (0, 1):
            draw_line(canvas, chart, np.stack([columns.x, columns.ends[:, side]], axis=1), paint, width)


def _mark_worst(canvas: Canvas, chart: Chart, samples: Samples, say: Words) -> None:
    """Ring the wire's largest deviation and write it on the side where there is more room."""
    at = samples.worst
    if at is None:
        return
    place = chart.to_px(np.array([[mm(samples.along_um[at]), samples.wire_um[at]]]))[0]
    text = say("deviation.largest", most=um(samples.wire_um[at], signed=True), block=samples.block_name(at))
    mark_place(canvas, chart.frame, place, text, chart.unit)


def all_show(chart: Chart, toolpath: Toolpath) -> bool:
    """Whether there is room for all borders; where there is not, only numbered blocks have one, at their end."""
    return len(toolpath) * LEAST_APART * chart.unit <= chart.frame.right - chart.frame.left


def draw_borders(canvas: Canvas, chart: Chart, toolpath: Toolpath, height: float) -> None:
    """Draw borders down the chart, jumps as bars in a strip of a height above it, and numbers of blocks there."""
    x = chart.x_px(mm(toolpath.before_um))
    top, unit = chart.frame.top - height, chart.unit
    for row in np.flatnonzero(toolpath.is_jump).tolist():
        box = Box(float(x[row]), top + 0.8 * height, float(x[row + 1]), top + 0.95 * height)
        canvas.box(box, Paint.JUMP, Paint.JUMP, 0.0)
    names = toolpath.source.names.of_rows()
    shown_numbers = numbers(canvas, x, names, unit)
    borders = x[1:-1] if all_show(chart, toolpath) else x[[row + 1 for row, _ in shown_numbers]]
    for at in borders.tolist():
        line = np.array([[at, chart.frame.top - 0.2 * height], [at, chart.frame.bottom]])
        canvas.polyline(line, Paint.FRAME, BORDER_WIDTH * unit)
    for row, at in shown_numbers:
        canvas.text((at, top + 0.42 * height), names[row], style.NUMBER * unit, Paint.INK, align=0.5)


def numbers(canvas: Canvas, x: Floats, names: list[str], unit: float) -> list[tuple[int, float]]:
    """Rows whose numbers show, each with the middle of its number, px; `x` (n + 1,) px are the borders of the blocks.

    `names` has for each row the number as the listing has it.

    No number covers another: that of the longer block stays.
    """
    blocks = len(x) - 1
    stride = number_stride(blocks)
    rows = np.arange(stride - 1, blocks, stride)
    wide = np.array([canvas.text_width(names[row], style.NUMBER * unit) + APART * unit for row in rows.tolist()])
    middle = np.clip((x[rows] + x[rows + 1]) / 2.0, x[0] + wide / 2.0, x[-1] - wide / 2.0)
    taken: list[int] = []
    for at in np.argsort(x[rows] - x[rows + 1], kind="stable").tolist():
        if all(abs(middle[at] - middle[other]) >= (wide[at] + wide[other]) / 2.0 for other in taken):
            taken.append(at)
    return [(int(rows[at]), float(middle[at])) for at in sorted(taken)]
