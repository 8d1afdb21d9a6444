"""What is written beside the plot: the block that runs, place, feed, deviation and times."""

from typing import NamedTuple

from parser.findings.catalogue import instant, page
from parser.findings.findings import Finding
from parser.toolpath import Stop, Toolpath
from parser.units import mm, mm_text
from sim.cut.pieces.pieces import Piece
from sim.run.course import Course, Event, Moment
from sim.show.draw.paints import Paint
from sim.show.film.strip import paint_of
from sim.show.words import Words
from sim.show.words.phrases import counted_pass

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
        told(course, moment.t_s, speed, say),
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


def told(course: Course, t_s: float, speed: float, say: Words) -> Line:
    """What happened last, or that the run is over; empty where nothing did of late."""
    if t_s >= course.duration_s:
        ended = course.run.ended
        if ended is not None:
            return Line("", say(f"film.ended_{ended.cause}", axis=ended.axis.name), Paint.ERROR)
        return Line("", say("film.end"))
    late = (one for one in course.happenings if t_s - _TOLD_S * speed <= one.t_s <= t_s)
    shown = [(one, paint) for one in late if (paint := paint_of(one.what)) is not None]
    if not shown:
        return Line("", "")
    last, paint = max(shown, key=lambda pair: pair[0].t_s)  # of what falls together the first: a finding
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
