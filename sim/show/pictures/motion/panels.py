"""Panels of the motion picture, in units for people, and the events on their time axis.

Events on the time axis: borders of blocks with their numbers, passes, pauses, and what the drives lost.

Panels: what each shows of a run's history, in units for people, with its levels, and over which range.
"""

import math
from collections.abc import Iterable, Mapping
from typing import Final, NamedTuple

import numpy as np

from parser.controller_words import Axis
from parser.findings.findings import telling
from parser.geometry.curves import Floats, Ints
from parser.units import mm
from sim.base.units import in_figures
from sim.run.course import passes_of, stops_of
from sim.run.dryrun import DryRun
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import AxisRange, Chart, range_of
from sim.show.draw.layout import MOST_NUMBERS, Box, number_stride
from sim.show.draw.letters import text_width
from sim.show.draw.style import Paint, paint_of_pass
from sim.show.texts import Words
from sim.table.history import Envelope, History
from sim.table.losses import LossKind, Lost, Quantity

ROW: Final = 30.0
"""Height of a row of numbers or signs."""
BAND: Final = 26.0
"""Height of the tones of passes, in a row."""
TICK: Final = 9.0
LINE_WIDTH: Final = 1.5
PAUSE: Final = "‖"
"""Sign of a pause, as two bars are in the picture of the cut: one dialect writes D, others M00, M01 or M20."""
_NAMES: Final[Mapping[LossKind, str]] = {"lost-steps": "motion.lost", "trip": "motion.trip"}


class TimeMark(NamedTuple):
    """What happened at a time: the key of its name, its sign, and what it is drawn in."""

    t_s: float
    name: str
    sign: str
    paint: Paint


class _Label(NamedTuple):
    """A text that is centred on a place of the time axis, px."""

    x: float
    text: str
    paint: Paint


def marks_of(run: DryRun) -> list[TimeMark]:
    """Losses of a run, with the codes of their findings and the axes, and pauses."""
    pauses = [
        TimeMark(stop.t_s, "motion.pause", PAUSE, Paint.PAUSE) for stop in stops_of(run) if stop.what.kind == "pause"
    ]
    codes = {fact.kind: finding.code for finding, fact in telling(run.findings, Lost)}
    losses = [
        TimeMark(loss.t_s, _NAMES[loss.kind], f"{codes[loss.kind]} {loss.axis.name}", Paint.ERROR)
        for loss in run.losses
    ]
    until_s = run.history.t_s[-1]
    return [mark for mark in (*losses, *pauses) if mark.t_s <= until_s]


def draw_blocks(canvas: Canvas, chart: Chart, run: DryRun, unit_s: float) -> None:
    """Draw ticks at borders of blocks and numbers between, above a chart whose X axis counts `unit_s`.

    Of many blocks only every 2nd, 5th, 10th … has them. Of numbers that would overlap, the roundest is written, and
    of those that are as round the one of the longest block.
    """
    stride, top, unit = number_stride(len(run.toolpath)), chart.frame.top, chart.unit
    borders = chart.x_px(run.border_s / unit_s)
    for x in borders[::stride].tolist():
        canvas.polyline(np.array([[x, top - TICK * unit], [x, top]]), Paint.GREY, LINE_WIDTH * unit)
    rows = np.arange(stride - 1, len(run.toolpath), stride)
    round_by = sum((rows + 1) % (times * stride) == 0 for times in (2, 5, 10)) if stride > 1 else np.zeros(len(rows))
    best = rows[np.lexsort((-run.block_time_s[rows], -round_by))]
    middle = (borders[best] + borders[best + 1]) / 2.0
    name = run.block_names.of_row
    labels = [_Label(x, name(row), Paint.GREY) for x, row in zip(middle.tolist(), best.tolist(), strict=True)]
    _draw_labels(canvas, chart, labels, top - (TICK + 0.5 * ROW) * unit)


def draw_passes(canvas: Canvas, chart: Chart, run: DryRun, unit_s: float) -> None:
    """Draw the passes in their tones above the numbers of blocks, each with its own number where that has room."""
    foot, size = chart.frame.top - (TICK + ROW) * chart.unit, style.NUMBER * chart.unit
    borders = chart.x_px(run.border_s / unit_s)
    for each, _ in passes_of(run):
        left, right = borders[[each.first, each.last + 1]].tolist()
        draw_pass(canvas, Box(left, foot - BAND * chart.unit, right, foot), each.number, size)


def draw_pass(canvas: Canvas, box: Box, number: int, size: float) -> None:
    """Draw a pass as a box in its tone, with its number where that has room."""
    paint, text = paint_of_pass(number), str(number)
    canvas.box(box, paint, paint, 0.0)
    if text_width(text, size) < box.right - box.left:
        middle = ((box.left + box.right) / 2.0, (box.top + box.bottom) / 2.0)
        canvas.text(middle, text, size, Paint.INK, align=0.5)


def draw_marks(canvas: Canvas, charts: list[Chart], marks: list[TimeMark], unit_s: float, y: float) -> None:
    """Draw a line through all charts at each mark, and its sign at the height `y` as far as there is room.

    Of two in one place the first one shows.
    """
    unit = charts[0].unit
    x = charts[0].x_px(np.array([mark.t_s for mark in marks]) / unit_s).tolist()
    lines = {round(at): mark.paint for at, mark in reversed(list(zip(x, marks, strict=True)))}
    for at, paint in lines.items():
        for frame in (chart.frame for chart in charts):
            line = np.array([[at, frame.top], [at, frame.bottom]], dtype=np.float64)
            canvas.dashed(line, paint, LINE_WIDTH * unit, 0.5 * style.DASH * unit, 0.5 * style.DASH_GAP * unit)
    labels = [_Label(at, mark.sign, mark.paint) for at, mark in zip(x, marks, strict=True)]
    _draw_labels(canvas, charts[0], labels, y)


def _draw_labels(canvas: Canvas, chart: Chart, labels: list[_Label], y: float) -> None:
    """Write those labels that find room beside one another within the width of a chart; earlier ones choose first."""
    size = style.NUMBER * chart.unit
    taken: list[tuple[float, float]] = []
    for label in labels[:MOST_NUMBERS]:
        half = text_width(label.text, size) / 2.0
        x = min(max(label.x, chart.frame.left + half), chart.frame.right - half)
        begin, end = x - half - 0.4 * size, x + half + 0.4 * size
        if all(end <= left or right <= begin for left, right in taken):
            taken.append((begin, end))
            canvas.text((x, y), label.text, size, label.paint, align=0.5)


ROOM: Final = 0.08
"""Share of its range that a panel leaves free at either side."""
REACH: Final = 0.3
"""Share of the range by which a panel grows to show a level."""
_MOST_FEEDS = 3


class Level(NamedTuple):
    """A magnitude that a panel shows on both sides of 0.

    Attributes
    ----------
    key
        Of its text.
    value
        In the unit of the panel.
    axes
        Whose it is, such as ``X, Y``; empty where it is that of the path.
    paint
        What it is drawn in.
    """

    key: str
    value: float
    axes: str
    paint: Paint

    def text(self, say: Words) -> str:
        """What it is, with three figures of its value."""
        return say(self.key, value=in_figures(self.value), axes=self.axes)


class Panel(NamedTuple):
    """What a panel shows: the key of its name, an envelope and levels in its unit, and the least range."""

    name: str
    envelope: Envelope
    levels: list[Level]
    least: float

    @property
    def range(self) -> AxisRange:
        """From the lowest to the highest, and to levels just outside."""
        shown_range = range_of(self.envelope.low, self.envelope.high, least=self.least)
        reach, levels = shown_range.wider(REACH), np.array([level.value for level in self.levels])
        both = np.concatenate([levels, -levels])
        near = both[(both >= reach.low) & (both <= reach.high)]
        return range_of(np.array(shown_range), near).wider(ROOM)


def panels_of(run: DryRun, most: int) -> tuple[Floats, list[Panel]]:
    """Times (b + 1,) s of up to `most` bins, and the panels from above, with those bins."""
    motor = run.scenario.machine.table.motor
    history = run.history
    t_s, pooled = _pooled(history, most)
    lag = limit_levels(run, "lag", "motion.pull_out" if motor.kind == "stepper" else "motion.servo_limit")
    speed = [*feed_levels(run), *limit_levels(run, "speed", "motion.speed_limit", mm(1.0))]
    return t_s, [
        Panel("motion.velocity", _in_mm(pooled[0]), speed, least=0.01),
        Panel("motion.acceleration", _in_mm(pooled[1]), [], least=1.0),
        Panel("motion.error", pooled[2], lag, least=1.0),
        Panel("motion.force", pooled[3], limit_levels(run, "force", "motion.force_limit"), least=1.0),
    ]


def _in_mm(envelope: Envelope) -> Envelope:
    return Envelope._make(mm(column) for column in envelope)


def _pooled(history: History, most: int) -> tuple[Floats, list[Envelope]]:
    """The history in no more than `most` bins, none too narrow to be seen: nothing that is short gets lost."""
    bins = len(history.t_s) - 1
    first = np.unique(np.arange(min(most, bins)) * bins // min(most, bins))
    t_s = np.append(history.t_s[first], history.t_s[-1])
    series = (history.velocity_um_s, history.acceleration_um_s2, history.following_error_um, history.force_n)
    return t_s, [_pool(envelope, first, np.diff(history.t_s)) for envelope in series]


def _pool(envelope: Envelope, first: Ints, width_s: Floats) -> Envelope:
    area = np.add.reduceat(envelope.mean * width_s[:, None], first, axis=0)
    return Envelope(
        low=np.minimum.reduceat(envelope.low, first, axis=0),
        high=np.maximum.reduceat(envelope.high, first, axis=0),
        mean=area / np.add.reduceat(width_s, first)[:, None],
    )


def feed_levels(run: DryRun) -> list[Level]:
    """Feeds of cuts and of jumps, mm/s, as far as there are any; of many passes the lowest and the highest."""
    if run.feeds is None:
        return []
    jumps = run.toolpath.is_jump
    cut = np.unique(np.broadcast_to(run.feeds.cut_um_s, len(jumps))[~jumps])
    if len(cut) > _MOST_FEEDS:
        cut = cut[[0, -1]]
    jump = [run.feeds.jump_um_s] if jumps.any() else []
    levels = [("motion.cut_feed", cut.tolist()), ("motion.jump_feed", jump)]
    return [Level(key, mm(feed), "", Paint.GREY) for key, feeds in levels for feed in feeds]


def limit_levels(run: DryRun, quantity: Quantity, key: str, scale: float = 1.0) -> list[Level]:
    """Limits of both axes at the moments when the axes came nearest to them, times `scale`; equal ones as one level."""
    limits = [(peak.limit * scale, peak.axis) for peak in run.peaks if peak.quantity == quantity]
    finite = [(in_figures(value), value, axis) for value, axis in limits if math.isfinite(value)]
    same = {figures: value for figures, value, _ in finite}
    return [
        Level(key, value, _axes(axis for of, _, axis in finite if of == figures), Paint.ERROR)
        for figures, value in same.items()
    ]


def _axes(axes: Iterable[Axis]) -> str:
    return ", ".join(axis.name for axis in sorted(axes))
