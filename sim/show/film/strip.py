"""The strip of the run at the foot of a frame: how far it is, its blocks, and what happens on the way."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.toolpath import Stop
from sim.cut.pieces.pieces import Piece
from sim.run.course import Course, Event
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box
from sim.show.draw.paints import Paint
from sim.show.draw.tones import paint_of_pass
from sim.show.pictures.cut.flags import SEVERITY_PAINTS

BAR: Final = (30.0, 48.0)
"""Top and foot of the bar, from the strip's top on."""
MARK: Final = 8.0
BORDERS_APART: Final = 4.0
COMING: Final = 6.0
"""Height of the tones of passes that are still to come."""


def bar_of(strip: Box, unit: float) -> Box:
    """The bar in a strip, on whole pixels."""
    return strip._replace(top=strip.top + round(BAR[0] * unit), bottom=strip.top + round(BAR[1] * unit))


def draw_strip(canvas: Canvas, course: Course, strip: Box, unit: float, *, done: bool) -> None:
    """Draw the strip as it is where the run is `done`, or where it is still to come."""
    bar = bar_of(strip, unit)
    canvas.box(bar, Paint.KERF if done else Paint.GRID, Paint.FRAME, style.GRID_WIDTH * unit)
    _draw_passes(canvas, course, bar if done else bar._replace(top=bar.bottom - COMING * unit))
    for x in _borders_px(course, bar, BORDERS_APART * unit).tolist():
        canvas.polyline(np.array([[x, bar.top], [x, bar.bottom]]), Paint.FRAME, style.GRID_WIDTH * unit)
    for happening in reversed(course.happenings):
        _draw_mark(canvas, happening.what, x_px(happening.t_s, course, bar), bar, unit)


def paint_of(event: Event) -> Paint | None:
    """What a film shows something that happens in; None where it does not: findings tell of losses, too."""
    match event:
        case Finding():
            return SEVERITY_PAINTS[event.severity]
        case Piece():
            return Paint.SLUG_EDGE
        case Stop(kind="pause"):
            return Paint.PAUSE
        case _:
            return None


def x_px(t_s: float, course: Course, bar: Box) -> float:
    """Where a moment lies on a bar."""
    return bar.left + t_s / max(course.duration_s, 1e-12) * (bar.right - bar.left)


def _borders_px(course: Course, bar: Box, apart: float) -> Floats:
    """Where blocks begin on a bar; of those nearer together than `apart` one."""
    begins_s = course.border_s[:-1]
    x = bar.left + begins_s[begins_s <= course.duration_s] / max(course.duration_s, 1e-12) * (bar.right - bar.left)
    kept = np.diff(np.floor((x - bar.left) / apart), prepend=0.0) > 0
    return np.asarray(x[kept], dtype=np.float64)


def _draw_passes(canvas: Canvas, course: Course, band: Box) -> None:
    """Draw the passes in their tones, where any edge is cut more than once."""
    for one, _ in course.passes:
        begin, end = (x_px(float(course.border_s[row]), course, band) for row in (one.first, one.last + 1))
        if begin < band.right:
            paint = paint_of_pass(one.number)
            canvas.box(band._replace(left=begin, right=min(end, band.right)), paint, paint, 0.0)


def _draw_mark(canvas: Canvas, event: Event, x: float, bar: Box, unit: float) -> None:
    """A triangle over the bar for a finding, a square for a pause, a disc under it for a piece that comes free."""
    size, paint = MARK * unit, paint_of(event)
    if paint is None:
        return
    if isinstance(event, Piece):
        canvas.disc(np.array([x, bar.bottom + size]), 0.6 * size, paint)
    elif isinstance(event, Stop):
        canvas.polygon(_around(x, bar.top - size, 0.6 * size), paint)
    else:
        top = bar.top - 2.0 * size
        canvas.polygon(np.array([[x - size, top], [x + size, top], [x, bar.top - 0.3 * size]]), paint)


def _around(x: float, y: float, half: float) -> Floats:
    corners: Sequence[tuple[float, float]] = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
    return np.array([x, y]) + half * np.array(corners)
