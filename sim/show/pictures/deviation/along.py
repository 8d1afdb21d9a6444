"""Deviation over the length of the path, and by the share of the path.

Deviation along the path: that of wire and steps over the length of the path, with block borders and tolerance.

Deviation by share of the path: over how much of the cut wire and steps are off by how much.
"""

from typing import Final

import numpy as np

from parser.geometry.curves import Bools, Floats
from parser.toolpath import Toolpath
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import AxisRange, Chart, columns_of, draw_band, draw_chart, draw_line, stretches, tick_texts
from sim.show.draw.layout import Box, number_stride
from sim.show.draw.legend import Entry, dashes, draw_at_foot, in_rows, stroke, swatch
from sim.show.draw.letters import text_width
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import Paint
from sim.show.pictures.deviation.frame import Samples, mark_place, range_shown, titled, tolerance_text, um, write_names
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
    shown_numbers = numbers(x, names, unit)
    borders = x[1:-1] if all_show(chart, toolpath) else x[[row + 1 for row, _ in shown_numbers]]
    for at in borders.tolist():
        line = np.array([[at, chart.frame.top - 0.2 * height], [at, chart.frame.bottom]])
        canvas.polyline(line, Paint.FRAME, BORDER_WIDTH * unit)
    for row, at in shown_numbers:
        canvas.text((at, top + 0.42 * height), names[row], style.NUMBER * unit, Paint.INK, align=0.5)


def numbers(x: Floats, names: list[str], unit: float) -> list[tuple[int, float]]:
    """Rows whose numbers show, each with the middle of its number, px; `x` (n + 1,) px are the borders of the blocks.

    `names` has for each row the number as the listing has it.

    No number covers another: that of the longer block stays.
    """
    blocks = len(x) - 1
    stride = number_stride(blocks)
    rows = np.arange(stride - 1, blocks, stride)
    wide = np.array([text_width(names[row], style.NUMBER * unit) + APART * unit for row in rows.tolist()])
    middle = np.clip((x[rows] + x[rows + 1]) / 2.0, x[0] + wide / 2.0, x[-1] - wide / 2.0)
    taken: list[int] = []
    for at in np.argsort(x[rows] - x[rows + 1], kind="stable").tolist():
        if all(abs(middle[at] - middle[other]) >= (wide[at] + wide[other]) / 2.0 for other in taken):
            taken.append(at)
    return [(int(rows[at]), float(middle[at])) for at in sorted(taken)]


HISTOGRAM_HEIGHT: Final = 0.5
"""Of the page, over its width."""
BINS: Final = 80
LOWEST: Final = 1e-5
"""Share of the path at the foot of the scale: 1 mm of 100 m."""
HIGHEST_FOOT: Final = -2.0
"""The scale of shares begins at the power of ten below the least one, but no higher than here, at 1 %."""
EDGE_WIDTH: Final = 2.2


def draw_histogram(sheet: Sheet[AnyCanvas], samples: Samples) -> AnyCanvas:
    """Draw how much of the path was cut at each deviation, on a logarithmic scale.

    ValueError where the sheet is narrower than 600 px.
    """
    say, unit = sheet.say, sheet.unit
    legend = in_rows(_histogram_entries(say, samples), sheet.width_px, unit)
    canvas = titled(sheet, samples, say("deviation.histogram"), HISTOGRAM_HEIGHT * sheet.width_px + legend.foot)
    size = style.TICK * unit
    foot = HISTOGRAM_HEIGHT * sheet.width_px - 3.0 * size
    frame = Box(1.1 * style.LEFT * unit, style.HEAD * unit + 1.4 * size, sheet.width_px - style.EDGE * unit, foot)
    bins = bins_of(samples)
    wire, steps = (shares(samples, off, bins) for off in (samples.wire_um, samples.steps_um))
    chart = Chart(frame, AxisRange(float(bins[0]), float(bins[-1])), _scale(wire, steps), unit)
    _draw_frame(canvas, chart, samples.tolerance_um)
    canvas.text((frame.left, frame.top - 0.9 * size), say("deviation.share"), size, Paint.GREY)
    canvas.text((frame.right, frame.bottom + 2.0 * size), say("deviation.value"), size, Paint.GREY, align=1.0)
    _draw_bars(canvas, chart, bins, wire)
    canvas.polyline(chart.to_px(_outline(chart, bins, steps)), Paint.STEPS, EDGE_WIDTH * unit)
    _draw_limits(canvas, chart, samples)
    draw_at_foot(canvas, legend)
    return canvas


def bins_of(samples: Samples) -> Floats:
    """Borders (`BINS` + 1,) µm of the bins, 0 in the middle of one, all deviations of the cut inside."""
    span = range_shown(samples).wider(0.05)
    width = (span.high - span.low) / (BINS - 1)
    first = np.floor(span.low / width - 0.5) + 0.5
    return np.asarray((first + np.arange(BINS + 1)) * width, dtype=np.float64)


def shares(samples: Samples, off_um: Floats, bins: Floats) -> Floats:
    """Share (k,) of the path cut on which deviations (n,) lie in each of k even bins; 0 where nothing was cut."""
    weight = path_of_each(samples.along_um, samples.cutting)
    # By their number and range: numpy sorts all deviations for bins that may be uneven.
    length, _ = np.histogram(off_um, bins=len(bins) - 1, range=(bins[0], bins[-1]), weights=weight)
    return np.asarray(length / max(float(weight.sum()), np.finfo(np.float64).tiny), dtype=np.float64)


def path_of_each(along_um: Floats, cutting: Bools) -> Floats:
    """Length (n,) of the path that each sample stands for: half the way to its neighbours in the cut."""
    step = np.diff(along_um) * (cutting[1:] & cutting[:-1])
    return np.asarray((np.append(step, 0.0) + np.append(0.0, step)) / 2.0, dtype=np.float64)


def _scale(*shares: Floats) -> AxisRange:
    """Powers of ten, from below the least share to the whole."""
    seen = np.concatenate(shares)
    least = float(seen[seen > 0.0].min(initial=0.1))
    return AxisRange(min(np.floor(np.log10(max(least, LOWEST))), HIGHEST_FOOT), 0.25)


def _draw_frame(canvas: Canvas, chart: Chart, tolerance_um: float) -> None:
    """Draw the frame, the tolerance as an upright band, and the grid: linear below, powers of ten at the side."""
    frame, unit, size = chart.frame, chart.unit, style.TICK * chart.unit
    canvas.box(frame, Paint.PAGE, Paint.FRAME, style.GRID_WIDTH * unit)
    ends = np.clip([-tolerance_um, tolerance_um], chart.x.low, chart.x.high)
    draw_band(canvas, chart, ends, np.broadcast_to(np.array(chart.y), (2, 2)), Paint.BAND)
    for value, text in tick_texts(chart.x, (frame.right - frame.left) / (1.5 * style.TICK_SPACING * unit)):
        x = float(chart.x_px(value))
        canvas.polyline(np.array([[x, frame.top], [x, frame.bottom]]), Paint.GRID, style.GRID_WIDTH * unit)
        canvas.text((x, frame.bottom + 0.8 * size), text, size, Paint.GREY, align=0.5)
    for power in range(int(np.ceil(chart.y.low)), 1):
        y = float(chart.y_px(float(power)))
        canvas.polyline(np.array([[frame.left, y], [frame.right, y]]), Paint.GRID, style.GRID_WIDTH * unit)
        canvas.text((frame.left - 0.4 * size, y), f"{100.0 * 10.0**power:g} %", size, Paint.GREY, align=1.0)


def _logarithm(chart: Chart, share: Floats) -> Floats:
    """Where shares (n,) lie on the scale; none at its foot."""
    least = 10.0**chart.y.low
    return np.asarray(np.log10(np.maximum(share, least)), dtype=np.float64)


def _outline(chart: Chart, bins: Floats, share: Floats) -> Floats:
    """Line (2k + 2, 2) around the bars of k bins."""
    top = np.repeat(_logarithm(chart, share), 2)
    return np.stack([np.repeat(bins, 2), np.concatenate([[chart.y.low], top, [chart.y.low]])], axis=1)


def _draw_bars(canvas: Canvas, chart: Chart, bins: Floats, share: Floats) -> None:
    outline = chart.to_px(_outline(chart, bins, share))
    canvas.polygon(outline, Paint.ACTUAL_PALE)
    canvas.polyline(outline, Paint.ACTUAL, EDGE_WIDTH * chart.unit)


def _draw_limits(canvas: Canvas, chart: Chart, samples: Samples) -> None:
    """Draw what 95 % of the wire's deviations keep to, and the largest."""
    at = samples.worst
    if at is None:
        return
    unit, frame = chart.unit, chart.frame
    limits = ((-samples.p95_um, Paint.INK), (samples.p95_um, Paint.INK), (float(samples.wire_um[at]), Paint.ERROR))
    for value, paint in limits:
        if chart.x.low <= value <= chart.x.high:
            x = float(chart.x_px(value))
            line = np.array([[x, frame.top], [x, frame.bottom]])
            canvas.dashed(line, paint, EDGE_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit)


def _histogram_entries(say: Words, samples: Samples) -> list[Entry]:
    wire = swatch(Paint.ACTUAL_PALE, Paint.ACTUAL, EDGE_WIDTH)
    tolerance = swatch(Paint.BAND, Paint.BAND_EDGE, style.GRID_WIDTH)
    p95 = say("deviation.p95_mark", p95=um(samples.p95_um))
    most = say("deviation.largest_mark", most=um(samples.max_um))
    return [
        Entry(wire, say("deviation.wire")),
        Entry(stroke(Paint.STEPS, EDGE_WIDTH), say("deviation.steps")),
        Entry(dashes(Paint.INK, EDGE_WIDTH), p95),
        Entry(dashes(Paint.ERROR, EDGE_WIDTH), most),
        Entry(tolerance, tolerance_text(say, samples)),
    ]
