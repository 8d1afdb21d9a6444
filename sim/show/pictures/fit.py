"""The picture of a fit: what was measured and what the model has, and below it what the model leaves.

Of a circle over the direction, of a corner along the way; of a piece size by size, each with its interval.
"""

from typing import Final, NamedTuple

import numpy as np

from parser.findings.catalogue import Language
from parser.geometry.curves import Bools, Floats, Ints
from sim.measure.fit.circle import CircleFit
from sim.measure.fit.corner import CornerFit
from sim.measure.fit.parameters import FittedRows
from sim.measure.fit.piece import PieceFit
from sim.show.draw import style
from sim.show.draw.canvas import Canvas, dashes_along
from sim.show.draw.chart import (
    AxisRange,
    Chart,
    draw_band,
    draw_chart,
    draw_level,
    draw_line,
    in_cells,
    range_of,
    tick_texts,
)
from sim.show.draw.layout import Box
from sim.show.draw.legend import DrawSample, Entry, draw_header, draw_legend, elide, in_rows, middle, stroke
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import Paint
from sim.show.texts import Words

FIT: Final = "fit"
"""Name of the picture."""
_UPPER, _LOWER, _APART = 0.34, 0.17, 0.05  # of the width: both frames, and the room above the lower one
_ROW: Final = 44.0  # of a size
_NAMES: Final = 250.0  # room for the names of features
_DOT, _RING_WIDTH, _MODEL_WIDTH, _BAR_WIDTH = 3.4, 1.4, 2.4, 3.0
_MOST_DOTS: Final = 500
"""More places of a quarter are drawn as a band from the lowest to the highest in each column."""
_TURNS_DEG: Final = np.array([90.0, 180.0, 270.0])
"""Directions in which an axis turns round: the model jumps there."""
_ROOM: Final = 0.08  # free of an axis at both ends


class FitSubject(NamedTuple):
    """A fit as those who write pictures ask for it; `file` is the name of what was measured."""

    fit: CircleFit | CornerFit | PieceFit
    file: str

    def title_in(self, _language: Language) -> str:
        """What was measured."""
        return self.file

    def least_px(self, _name: str) -> int:
        """As all pictures."""
        return style.LEAST_WIDTH

    def draw(self, _name: str, sheet: Sheet[AnyCanvas]) -> AnyCanvas:
        """The page, drawn."""
        return draw_fit(sheet, self)


def draw_fit(sheet: Sheet[AnyCanvas], subject: FitSubject) -> AnyCanvas:
    """Draw a fit. The same one gives the same picture."""
    fit = subject.fit
    return _draw_sizes(sheet, subject, fit) if isinstance(fit, PieceFit) else _draw_places(sheet, subject, fit)


def _draw_places(sheet: Sheet[AnyCanvas], subject: FitSubject, fit: CircleFit | CornerFit) -> AnyCanvas:
    """Two charts over the direction or the way: the places with the model, and what it leaves."""
    unit, say, rows, is_circle = sheet.unit, sheet.say, fit.rows, isinstance(fit, CircleFit)
    charts = _charts(sheet, rows, is_circle=is_circle)
    legend = in_rows(_entries(rows, say), sheet.width_px, unit)
    frame, size = charts[1].frame, style.TICK * unit
    below = frame.bottom + 3.4 * size
    canvas = sheet.page(round(below + legend.foot))
    _head(canvas, subject, say, unit)
    for chart, name in zip(charts, ("fit.axis-off", "fit.axis-left"), strict=True):
        draw_chart(canvas, chart, y_name=say(name), x_values=chart is charts[1])
        draw_level(canvas, chart, 0.0, Paint.FRAME, style.IDEAL_WIDTH)
    for chart, value in zip(charts, (rows.off_um, rows.off_um - rows.model_um), strict=True):
        for chosen, kind in _groups(rows):
            for part in _parts(rows.at, chosen, is_circle=is_circle):
                _draw_dots(canvas, chart, np.column_stack([rows.at[part], value[part]]), kind)
    for is_back in (False, True):
        for part in _parts(rows.at, rows.is_used & (rows.is_back == is_back), is_circle=is_circle):
            line = np.column_stack([rows.at[part], rows.model_um[part]])
            _draw_model(canvas, charts[0], line, is_dashed=is_back)
    across = say("fit.axis-direction" if is_circle else "fit.axis-way")
    canvas.text((frame.right, frame.bottom + 2.1 * size), across, size, Paint.GREY, align=1.0)
    draw_legend(canvas, legend, 0.0, below)
    return canvas


def _charts(sheet: Sheet[AnyCanvas], rows: FittedRows, *, is_circle: bool) -> tuple[Chart, Chart]:
    """The chart of what was measured, and the one of what the model leaves below it."""
    unit, width = sheet.unit, sheet.width_px
    left, right, top = style.LEFT * unit, width - style.EDGE * unit, style.HEAD * unit
    upper = Box(left, top, right, top + _UPPER * width)
    lower = Box(left, upper.bottom + _APART * width, right, upper.bottom + (_APART + _LOWER) * width)
    across = AxisRange(0.0, 360.0) if is_circle else range_of(rows.at)
    off_um, model_um = rows.off_um[rows.is_used], rows.model_um[rows.is_used]
    ranges = (range_of(off_um, model_um, least=0.5), range_of(off_um - model_um, least=0.5))
    return Chart(upper, across, ranges[0].wider(_ROOM), unit), Chart(lower, across, ranges[1].wider(_ROOM), unit)


def _head(canvas: Canvas, subject: FitSubject, say: Words, unit: float) -> None:
    """What was measured, of how many places, what is left, and what speaks against the model."""
    fit = subject.fit
    note = say("fit.picture-note", file=subject.file, places=f"{fit.places:,}", rest=f"{fit.residual_um:.3g}")
    if fit.lack:
        note += " · " + say(f"fit.lack-{fit.lack}")
    draw_header(canvas, unit, say(f"fit.picture-{_kind(fit)}"), note)


def _kind(fit: CircleFit | CornerFit | PieceFit) -> str:
    if isinstance(fit, PieceFit):
        return "piece"
    return "circle" if isinstance(fit, CircleFit) else "corner"


class _Kind(NamedTuple):
    """How places that belong together are drawn, as dots or rings, many of them as a band; and their name."""

    name: str
    paint: Paint
    band: Paint
    is_ring: bool = False


_CCW, _CW = _Kind("measured-ccw", Paint.CCW, Paint.CCW_PALE), _Kind("measured-cw", Paint.CW, Paint.CW_PALE, True)
_OUT: Final = _Kind("measured-out", Paint.FRAME, Paint.GRID)


def _groups(rows: FittedRows) -> list[tuple[Bools, _Kind]]:
    """Places of each direction, and those that were left out; those that are run one way alone need no name of it."""
    one_way = _CCW._replace(name="measured")
    groups = [
        (rows.is_used & ~rows.is_back, _CCW if rows.is_back.any() else one_way),
        (rows.is_used & rows.is_back, _CW),
        (~rows.is_used, _OUT),
    ]
    return [group for group in groups if group[0].any()]


def _parts(at: Floats, chosen: Bools, *, is_circle: bool) -> list[Ints]:
    """Chosen rows in the order of the axis; on a circle parted where one of its axes turns round."""
    order = np.flatnonzero(chosen)
    order = order[np.argsort(at[order], kind="stable")]
    parts = np.split(order, np.searchsorted(at[order], _TURNS_DEG)) if is_circle else [order]
    return [part for part in parts if len(part)]


def _entries(rows: FittedRows, say: Words) -> list[Entry]:
    """What dots and lines are."""
    found = [Entry(_dot(kind), say(f"fit.drawn-{kind.name}")) for _, kind in _groups(rows)]
    model = "fit.drawn-model-both" if rows.is_back.any() else "fit.drawn-model"
    return [*found, Entry(stroke(Paint.INK, _MODEL_WIDTH), say(model))]


def _dot(kind: _Kind) -> DrawSample:
    return lambda canvas, box, unit: _draw_dot(canvas, middle(box), 1.6 * unit, kind)


def _draw_dot(canvas: Canvas, place: Floats, unit: float, kind: _Kind) -> None:
    if kind.is_ring:
        canvas.ring(place, _DOT * unit, kind.paint, _RING_WIDTH * unit)
    else:
        canvas.disc(place, _DOT * unit, kind.paint)


def _draw_dots(canvas: Canvas, chart: Chart, places: Floats, kind: _Kind) -> None:
    """Draw places (n, 2) in the order of the axis; many of them as a band in columns of pixels."""
    if len(places) <= _MOST_DOTS:
        with canvas.clipped(chart.frame):
            for place in chart.to_px(places):
                _draw_dot(canvas, place, chart.unit, kind)
        return
    at, value = places.T
    cell = np.floor(chart.x_px(at) / (2.0 * chart.unit)).astype(np.int64)
    columns = in_cells(cell, at, value)
    draw_band(canvas, chart, columns.x, columns.ends, kind.band)


def _draw_model(canvas: Canvas, chart: Chart, line: Floats, *, is_dashed: bool) -> None:
    """Draw the model along a line (n, 2), dashed for the way back."""
    if len(line) < 2:
        return
    if not is_dashed:
        draw_line(canvas, chart, line, Paint.INK, _MODEL_WIDTH)
        return
    with canvas.clipped(chart.frame):
        for dash in dashes_along(chart.to_px(line), style.DASH * chart.unit, style.DASH_GAP * chart.unit):
            canvas.polyline(dash, Paint.INK, _MODEL_WIDTH * chart.unit)


def _draw_sizes(sheet: Sheet[AnyCanvas], subject: FitSubject, fit: PieceFit) -> AnyCanvas:
    """A row for each size: what it is off with its interval, and what the model has."""
    unit, say, rows, number = sheet.unit, sheet.say, fit.rows, len(fit.names)
    entries = [Entry(_dot(_CCW), say("fit.drawn-size")), Entry(_tick(), say("fit.drawn-model"))]
    legend = in_rows(entries, sheet.width_px, unit)
    top, size = style.HEAD * unit, style.TICK * unit
    frame = Box(_NAMES * unit, top, sheet.width_px - style.EDGE * unit, top + (number + 0.6) * _ROW * unit)
    below = frame.bottom + 3.4 * size
    canvas = sheet.page(round(below + legend.foot))
    _head(canvas, subject, say, unit)
    across = range_of(rows.off_um - fit.within_um, rows.off_um + fit.within_um, rows.model_um, np.zeros(1), least=1.0)
    chart = Chart(frame, across.wider(_ROOM), AxisRange(number - 0.2, -0.8), unit)
    _draw_grid(canvas, chart)
    for at, name in enumerate(fit.names):
        off, within, model = float(rows.off_um[at]), float(fit.within_um[at]), float(rows.model_um[at])
        _draw_size(canvas, chart, at, name, (off - within, off, off + within, model))
    canvas.text((frame.right, frame.bottom + 2.1 * size), say("fit.axis-off"), size, Paint.GREY, align=1.0)
    draw_legend(canvas, legend, 0.0, below)
    return canvas


def _draw_size(canvas: Canvas, chart: Chart, at: int, name: str, ends: tuple[float, float, float, float]) -> None:
    """A row by its number: its name, the least, middle and most that it is off, and what the model has."""
    unit, size, y = chart.unit, style.TEXT * chart.unit, float(chart.y_px(float(at)))
    left = chart.frame.left - 0.6 * size
    canvas.text((left, y), elide(name, size, left - style.EDGE * unit), size, Paint.INK, align=1.0)
    least, middle_x, most, model = (float(chart.x_px(end)) for end in ends)
    canvas.polyline(np.array([[least, y], [most, y]]), Paint.CCW_PALE, 2.4 * _BAR_WIDTH * unit)
    canvas.disc(np.array([middle_x, y]), 1.8 * _DOT * unit, Paint.CCW)
    half = 0.34 * _ROW * unit
    canvas.polyline(np.array([[model, y - half], [model, y + half]]), Paint.INK, _BAR_WIDTH * unit)


def _tick() -> DrawSample:
    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        x, y = middle(box).tolist()
        half = 0.36 * (box.bottom - box.top)
        canvas.polyline(np.array([[x, y - half], [x, y + half]]), Paint.INK, _BAR_WIDTH * unit)

    return draw


def _draw_grid(canvas: Canvas, chart: Chart) -> None:
    """The frame of sizes with a scale below it; rows have names of their own."""
    frame, unit, size = chart.frame, chart.unit, style.TICK * chart.unit
    canvas.box(frame, Paint.PAGE, Paint.FRAME, style.GRID_WIDTH * unit)
    for value, text in tick_texts(chart.x, (frame.right - frame.left) / (1.5 * style.TICK_SPACING * unit)):
        x = float(chart.x_px(value))
        line = np.array([[x, frame.top], [x, frame.bottom]])
        canvas.polyline(line, Paint.FRAME if value == 0.0 else Paint.GRID, style.GRID_WIDTH * unit)
        canvas.text((x, frame.bottom + 0.8 * size), text, size, Paint.GREY, align=0.5)
