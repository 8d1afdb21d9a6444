"""Deviation by share of the path: over how much of the cut wire and steps are off by how much."""

from typing import Final

import numpy as np

from parser.geometry.curves import Bools, Floats
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import AxisRange, Chart, draw_band, tick_texts
from sim.show.draw.layout import Box
from sim.show.draw.legend import Entry, dashes, draw_at_foot, in_rows, stroke, swatch
from sim.show.draw.paints import Paint
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.deviation.frame import range_shown, titled, tolerance_text, um
from sim.show.pictures.deviation.samples import Samples
from sim.show.texts import Words

HEIGHT: Final = 0.5
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
    legend = in_rows(_entries(say, samples), sheet.width_px, unit)
    canvas = titled(sheet, samples, say("deviation.histogram"), HEIGHT * sheet.width_px + legend.foot)
    size = style.TICK * unit
    foot = HEIGHT * sheet.width_px - 3.0 * size
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
    """Share (k,) of the path cut on which deviations (n,) lie in each of k bins; 0 where nothing was cut."""
    weight = path_of_each(samples.along_um, samples.cutting)
    length, _ = np.histogram(off_um, bins=bins, weights=weight)
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


def _entries(say: Words, samples: Samples) -> list[Entry]:
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
