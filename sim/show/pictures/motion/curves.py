"""Curves of a panel: X as an area with a line, Y hatched with a dashed line, so that a grey print tells them apart."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from parser.geometry.curves import Floats, total_before
from parser.told.step_words import Axis
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import Chart, draw_band, draw_line
from sim.show.draw.paints import Paint
from sim.show.draw.simplify import CHORD_PX, simplify
from sim.table.record.bins import Envelope

MEAN_WIDTH: Final = 2.4
HATCH_WIDTH: Final = 1.2


def draw_envelope(canvas: Canvas, chart: Chart, t: Floats, envelope: Envelope, axes: Sequence[Axis]) -> None:
    """Draw an envelope of axes over the borders (b + 1,) of its bins, in the unit of the X axis; means above all."""
    for axis in axes:
        ends = np.stack([envelope.low[:, axis], envelope.high[:, axis]], axis=1)
        if axis is Axis.X:
            draw_band(canvas, chart, np.repeat(t, 2)[1:-1], np.repeat(ends, 2, axis=0), Paint.X_PALE)
        else:
            _draw_hatch(canvas, chart, t, ends)
    for axis in axes:
        mean = _mean_line(t, envelope.mean[:, axis])
        if axis is Axis.X:
            draw_line(canvas, chart, mean, Paint.X, MEAN_WIDTH)
        else:
            _draw_dashes(canvas, chart, mean)


def _mean_line(t: Floats, mean: Floats) -> Floats:
    """Points from the middle of a bin to that of the next, and to both ends."""
    middle = np.concatenate([t[:1], (t[:-1] + t[1:]) / 2.0, t[-1:]])
    return np.stack([middle, np.concatenate([mean[:1], mean, mean[-1:]])], axis=1)


def _draw_hatch(canvas: Canvas, chart: Chart, t: Floats, ends: Floats) -> None:
    """Draw a band (b, 2) as upright strokes, one in each column of pixels `style.HATCH` wide.

    A stroke reaches from the lowest to the highest value of its column, and stands where the band is widest.
    """
    column = np.floor((chart.x_px(t[:-1]) - chart.frame.left) / (style.HATCH * chart.unit))
    first = np.flatnonzero(np.diff(column, prepend=-1.0))
    low, high = np.minimum.reduceat(ends[:, 0], first), np.maximum.reduceat(ends[:, 1], first)
    widest = np.lexsort((np.rint(chart.y_px(ends[:, 1]) - chart.y_px(ends[:, 0])), column))[first]
    x = chart.x_px((t[widest] + t[widest + 1]) / 2.0)
    strokes = np.stack([np.stack([x, chart.y_px(end)], axis=1) for end in (low, high)], axis=1)
    with canvas.clipped(chart.frame):
        for stroke in strokes[low < high]:
            canvas.polyline(stroke, Paint.Y, HATCH_WIDTH * chart.unit)


def _draw_dashes(canvas: Canvas, chart: Chart, values: Floats) -> None:
    """Draw a line through points (n, 2) in dashes that go on from chord to chord."""
    points = simplify(chart.to_px(values), CHORD_PX)
    along = total_before(np.hypot(*np.diff(points, axis=0).T))
    begins = np.arange(0.0, along[-1], (style.DASH + style.DASH_GAP) * chart.unit)
    cuts = np.stack([begins, np.minimum(begins + style.DASH * chart.unit, along[-1])], axis=1)
    at = np.union1d(along, cuts)
    line = np.stack([np.interp(at, along, column) for column in points.T], axis=1)
    with canvas.clipped(chart.frame):
        for first, last in np.searchsorted(at, cuts).tolist():
            canvas.polyline(line[first : last + 1], Paint.Y, MEAN_WIDTH * chart.unit)
