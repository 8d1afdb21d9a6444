"""Deviation along the path: that of wire and steps over the length of the path, with block borders and tolerance."""

from typing import Final

import numpy as np

from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import Chart, Range, draw_band, draw_chart, draw_line
from sim.show.draw.layout import Box
from sim.show.draw.paints import Paint
from sim.show.draw.pixel_columns import columns_of, stretches
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.deviation.borders import all_show, draw_borders
from sim.show.pictures.deviation.frame import (
    Entry,
    draw_legend,
    legend_of,
    mark_place,
    stroke,
    swatch,
    titled,
    tolerance_text,
    um,
    write_names,
)
from sim.show.pictures.deviation.samples import Samples
from sim.show.pictures.deviation.scale import range_shown
from sim.show.words import Words

HEIGHT: Final = 0.52
"""Of the page, over its width."""
STRIP: Final = 44.0
"""Height of the strip of block numbers."""
WIRE_WIDTH: Final = 2.2
STEPS_WIDTH: Final = 1.0
BORDER_WIDTH: Final = 1.5


def draw_along(sheet: Sheet[AnyCanvas], samples: Samples) -> AnyCanvas:
    """Draw the deviation of wire and steps over the length of the path.

    ValueError where the sheet is narrower than 600 px.
    """
    say, unit = sheet.say, sheet.unit
    foot = HEIGHT * sheet.width_px - 1.8 * style.TICK * unit
    frame = Box(style.LEFT * unit, (style.HEAD + STRIP) * unit, sheet.width_px - style.EDGE * unit, foot)
    chart = _chart(samples, frame, unit)
    legend = legend_of(_entries(say, samples, chart), sheet.width_px, unit)
    canvas = titled(sheet, samples, say("deviation.along"), HEIGHT * sheet.width_px + legend.height)
    tolerance = Range(-samples.tolerance_um, samples.tolerance_um)
    draw_chart(canvas, chart, tolerance=tolerance)
    draw_borders(canvas, chart, samples.run.toolpath, STRIP * unit)
    write_names(canvas, chart, say("common.path_length"), say("deviation.um"))
    for stretch in stretches(np.flatnonzero(samples.cutting)):
        _draw_stretch(canvas, chart, samples, stretch)
    _mark_worst(canvas, chart, samples, say)
    draw_legend(canvas, legend)
    return canvas


def _entries(say: Words, samples: Samples, chart: Chart) -> list[Entry]:
    unit, toolpath = chart.unit, samples.run.toolpath
    border = "deviation.border" if all_show(chart, toolpath) else "deviation.some_borders"
    jump = Entry(stroke(Paint.JUMP, 0.15 * STRIP * unit), say("deviation.jump"))
    wire = swatch(Paint.ACTUAL_PALE, Paint.ACTUAL, WIRE_WIDTH * unit)
    return [
        Entry(wire, say("deviation.wire_band")),
        Entry(swatch(Paint.STEPS_PALE, Paint.STEPS, STEPS_WIDTH * unit), say("deviation.steps_band")),
        Entry(swatch(Paint.BAND, Paint.BAND_EDGE, style.GRID_WIDTH * unit), tolerance_text(say, samples)),
        Entry(stroke(Paint.FRAME, BORDER_WIDTH * unit), say(border)),
        *[jump] * bool(toolpath.is_jump.any()),
    ]


def _chart(samples: Samples, frame: Box, unit: float) -> Chart:
    length = mm(float(samples.run.toolpath.length_um.sum()))
    x = Range(0.0, length) if length > 0.0 else Range(0.0, 1.0)
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
    text = say("deviation.largest", most=um(samples.wire_um[at], signed=True), block=samples.where(at).block)
    mark_place(canvas, chart.frame, place, text, chart.unit)
