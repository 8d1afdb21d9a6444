"""What is written beside the plot: the block that runs, place, feed, deviation and times.

The strip of the run at the foot of a frame: how far it is, its blocks, and what happens on the way.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from parser.findings.catalogue import instant, page
from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.toolpath import Stop, Toolpath
from parser.units import mm, mm_text
from sim.cut.pieces.pieces import Piece
from sim.run.course import Course, Event, Moment
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box
from sim.show.draw.style import Paint, paint_of_pass
from sim.show.pictures.cut.marks import SEVERITY_PAINTS
from sim.show.texts import Words
from sim.show.texts.phrases import counted_pass

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
    is_kept = np.diff(np.floor((x - bar.left) / apart), prepend=0.0) > 0
    return np.asarray(x[is_kept], dtype=np.float64)


def _draw_passes(canvas: Canvas, course: Course, band: Box) -> None:
    """Draw the passes in their tones, where any edge is cut more than once."""
    for each, _ in course.passes:
        begin, end = (x_px(float(course.border_s[row]), course, band) for row in (each.first, each.last + 1))
        if begin < band.right:
            paint = paint_of_pass(each.number)
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


_TOLD_S = 2.5
"""So long something that happened stays written, in seconds of the film."""


class Line(NamedTuple):
    """A line of the read-outs: a name at the left in grey, a value at the right; without a name it is one text."""

    name: str
    value: str
    paint: Paint = Paint.INK


def read_out(course: Course, moment: Moment, speed: float, say: Words) -> list[Line]:
    """Lines of a moment, always as many; `speed` is seconds of the run in each second of the film."""
    x, y = (f"{mm_text(place)} mm".replace("-", "−") for place in moment.wire_um)
    feed = say("film.feed_value", value=f"{mm(moment.feed_um_s) * 60.0:.2f}")
    toolpath = course.run.toolpath
    first, past = toolpath.source.span[moment.row].tolist()
    return [
        Line("", _block(toolpath, moment.row, say)),
        Line("", toolpath.source.text[first:past], Paint.GREY),
        *_running(course, moment, say),
        Line(say("film.actual_x"), x),
        Line(say("film.actual_y"), y),
        Line(say("film.feed"), feed if moment.cuts else f"{say('film.jump')} {feed}"),
        Line(say("film.deviation"), f"{moment.deviation_um:.2f} µm" if moment.cuts else "–"),
        Line(say("film.elapsed"), instant(moment.t_s)),
        Line(say("film.remaining"), instant(max(course.duration_s - moment.t_s, 0.0))),
        Line(say("film.speed"), f"× {_speed(speed)}"),
        last_event(course, moment.t_s, speed, say),
    ]


def _block(toolpath: Toolpath, row: int, say: Words) -> str:
    """Which block runs: its label where it has one, and its place in the run."""
    label, place = toolpath.source.names.label(row), {"number": f"{row + 1:,}", "count": f"{len(toolpath):,}"}
    return say("film.labelled_block", label=label, **place) if label else say("film.block", **place)


def _running(course: Course, moment: Moment, say: Words) -> list[Line]:
    """The pass that runs; no line where every edge is cut once."""
    if not course.passes:
        return []
    running = moment.running
    name = "–" if running is None else getattr(counted_pass(*running), say.language)
    return [Line(say("film.pass"), name)]


def last_event(course: Course, t_s: float, speed: float, say: Words) -> Line:
    """What happened last, or that the run is over; empty where nothing did of late."""
    if t_s >= course.duration_s:
        ended = course.run.ended
        if ended is not None:
            return Line("", say(f"film.ended_{ended.cause}", axis=ended.axis.name), Paint.ERROR)
        return Line("", say("film.end"))
    late = (happening for happening in course.happenings if t_s - _TOLD_S * speed <= happening.t_s <= t_s)
    shown_late = [(each, paint) for each in late if (paint := paint_of(each.what)) is not None]
    if not shown_late:
        return Line("", "")
    last, paint = max(shown_late, key=lambda pair: pair[0].t_s)  # of what falls together the first: a finding
    return Line("", _named(last.what, course, say), paint)


def _named(event: Event, course: Course, say: Words) -> str:
    """Words for something that a film shows."""
    match event:
        case Finding():
            return say("film.finding", code=event.code, title=page(event.code, say.language).title)
        case Piece():
            return say(f"film.free_{event.kind}")
        case Stop(after=0):
            return say("film.pause_first")
        case Stop():  # it is over when its text shows: the wire is threaded in no time of the plan
            return say("film.pause", block=course.run.block_names.at(event.after))
        case _:
            return ""


def _speed(speed: float) -> str:
    """Speed with three digits, such as ``0.01``, ``12.5`` or ``1,840``."""
    return f"{speed:,.0f}" if speed >= 100.0 else f"{speed:.3g}"
