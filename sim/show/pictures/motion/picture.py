"""The picture of a run's motion: four panels over one time axis.

The legend below the panels: the curves of both axes, and the signs on the time axis.

Curves of a panel: X as an area with a line, Y between two thin lines with a dashed one, so that a grey print tells them
apart.
"""

from collections.abc import Sequence
from functools import partial
from typing import Final, NamedTuple

import numpy as np

from parser.controller_words import Axis
from parser.geometry.curves import Floats, total_before
from sim.run.dryrun import DryRun
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import AxisRange, Chart, draw_band, draw_chart, draw_level, draw_line
from sim.show.draw.flatten import CHORD_PX, simplify
from sim.show.draw.layout import Box, number_stride
from sim.show.draw.legend import Entry, Legend, LegendSizes, draw_header, draw_legend, in_rows, middle
from sim.show.draw.letters import text_width
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import Paint
from sim.show.pictures.motion.panels import (
    BAND,
    ROW,
    TICK,
    Level,
    Panel,
    TimeMark,
    draw_blocks,
    draw_marks,
    draw_pass,
    draw_passes,
    marks_of,
    panels_of,
)
from sim.show.texts import Words
from sim.show.texts.phrases import lasting, machine_name
from sim.table.history import Envelope

MEAN_WIDTH: Final = 2.4
EDGE_WIDTH: Final = 1.2
COLUMN: Final = 12.0
"""Width of the columns of pixels in which edges are steps."""


def draw_envelope(canvas: Canvas, chart: Chart, t: Floats, envelope: Envelope, axes: Sequence[Axis]) -> None:
    """Draw an envelope of axes over the borders (b + 1,) of its bins, in the unit of the X axis; means above all."""
    for axis in axes:
        ends = np.stack([envelope.low[:, axis], envelope.high[:, axis]], axis=1)
        if axis is Axis.X:
            draw_band(canvas, chart, np.repeat(t, 2)[1:-1], np.repeat(ends, 2, axis=0), Paint.X_PALE)
        else:
            _draw_edges(canvas, chart, t, ends)
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


def _draw_edges(canvas: Canvas, chart: Chart, t: Floats, ends: Floats) -> None:
    """Draw a band (b, 2) by its lower and its upper edge, each as steps of columns of pixels `COLUMN` wide.

    A step stands at the lowest or the highest value of its column: what comes and goes from bin to bin, as single steps
    of a motor do, is one line, and what lasts for one bin shows.
    """
    column = np.floor((chart.x_px(t[:-1]) - chart.frame.left) / (COLUMN * chart.unit))
    first = np.flatnonzero(np.diff(column, prepend=-1.0))
    border = np.repeat(np.append(t[first], t[-1]), 2)[1:-1]
    for edge in (np.minimum.reduceat(ends[:, 0], first), np.maximum.reduceat(ends[:, 1], first)):
        draw_line(canvas, chart, np.stack([border, np.repeat(edge, 2)], axis=1), Paint.Y, EDGE_WIDTH)


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


SIZES: Final = LegendSizes(apart=40.0)
CURVE_HEIGHT: Final = 0.72
"""Height of the sample of a curve, of its row."""


def legend_of(run: DryRun, marks: list[TimeMark], say: Words, width_px: int, unit: float) -> Legend:
    """The legend on a page of a width."""
    stride = number_stride(len(run.toolpath))
    number = say({1: "motion.number", 2: "motion.number_2"}.get(stride, "motion.number_every"), stride=stride)
    entries = [
        *(Entry(partial(_draw_curve, axis), say("motion.axis", axis=axis.name)) for axis in (Axis.X, Axis.Y)),
        Entry(partial(_draw_sign, "12", Paint.GREY), number),
        *([Entry(_draw_pass, say("motion.pass"))] if run.has_trims else []),
        *(Entry(partial(_draw_sign, *looks), say(name), _share(looks[0], unit)) for name, looks in _kinds(marks)),
    ]
    return in_rows(entries, width_px, unit, SIZES)


def _share(sign: str, unit: float) -> float:
    """Width of the sample of a sign, of the usual one: no less than that."""
    return max(1.0, text_width(sign, style.NUMBER * unit) / (SIZES.sample * unit))


def _kinds(marks: list[TimeMark]) -> list[tuple[str, tuple[str, Paint]]]:
    """Kinds of marks by their names, each with the sign and the paint of the first."""
    first = {mark.name: mark for mark in reversed(marks)}
    return [(name, (first[name].sign, first[name].paint)) for name in sorted(first)]


def _draw_curve(axis: Axis, canvas: Canvas, box: Box, unit: float) -> None:
    free = (1.0 - CURVE_HEIGHT) / 2.0 * (box.bottom - box.top)
    frame = box._replace(top=box.top + free, bottom=box.bottom - free)
    chart = Chart(frame, AxisRange(0.0, 1.0), AxisRange(-1.0, 1.0), unit)
    ones = np.ones((1, 2))
    draw_envelope(canvas, chart, np.array([0.0, 1.0]), Envelope(-ones, ones, 0.0 * ones), [axis])


def _draw_pass(canvas: Canvas, box: Box, unit: float) -> None:
    free = (box.bottom - box.top - BAND * unit) / 2.0
    draw_pass(canvas, box._replace(top=box.top + free, bottom=box.bottom - free), 1, style.NUMBER * unit)


def _draw_sign(text: str, paint: Paint, canvas: Canvas, box: Box, unit: float) -> None:
    x, y = middle(box).tolist()
    canvas.text((x, y), text, style.NUMBER * unit, paint, align=0.5)


HEIGHT: Final = 0.13
"""Height of a panel over the width of the picture."""
LEAST_HEIGHT: Final = 150.0
NAME_ROW: Final = 40.0
TIME_ROWS: Final = 84.0
BIN: Final = 2.0
"""Width of the narrowest bin."""
LEVEL_WIDTH: Final = 1.6
SAMPLE: Final = 49.0
"""Length of a level's sample beside its text: three dashes."""
_TIMES: Final = ((7200.0, 3600.0, "motion.time_h"), (120.0, 60.0, "motion.time_min"), (0.0, 1.0, "motion.time_s"))


class _Layout(NamedTuple):
    """Where things stand on the page, px from the top.

    Attributes
    ----------
    frames, names
        Frames of the panels, and the middle of the row with the name of each.
    signs, legend, height
        Middle of the row with the signs of marks, top of the legend, height of the page.
    """

    frames: list[Box]
    names: list[float]
    signs: float
    legend: float
    height: int


class _Time(NamedTuple):
    """The time axis: how long it is and the unit that it counts, both in s, and the key of its name."""

    whole_s: float
    unit_s: float
    name: str


def draw_motion(sheet: Sheet[AnyCanvas], run: DryRun) -> AnyCanvas:
    """Draw velocity, acceleration, following error and force of both axes over the time of a run."""
    unit, say = sheet.unit, sheet.say
    marks = marks_of(run)
    legend = legend_of(run, marks, say, sheet.width_px, unit)
    layout = _layout(sheet, run.has_trims + bool(marks), legend.foot)
    canvas = sheet.page(layout.height)
    draw_header(canvas, unit, run.scenario.title_in(say.language), _note(run, say))
    time = _time_of(run)
    charts = _draw_panels(canvas, layout, run, time, sheet)
    draw_blocks(canvas, charts[0], run, time.unit_s)
    draw_passes(canvas, charts[0], run, time.unit_s)
    draw_marks(canvas, charts, marks, time.unit_s, layout.signs)
    frame, size = charts[-1].frame, style.TICK * unit
    canvas.text((frame.right, frame.bottom + 2.1 * size), say(time.name), size, Paint.GREY, align=1.0)
    draw_legend(canvas, legend, 0.0, layout.legend)
    return canvas


def _layout(sheet: Sheet[AnyCanvas], rows: int, legend_px: float) -> _Layout:
    """Lay out a page with so many rows above the one with the numbers of blocks, the signs in the uppermost."""
    unit = sheet.unit
    above = (TICK + ROW + ROW * rows) * unit
    height, name = max(HEIGHT * sheet.width_px, LEAST_HEIGHT * unit), NAME_ROW * unit
    first = style.HEAD * unit + name + above
    tops = [first, *(first + number * (height + name) for number in range(1, 4))]
    frames = [Box(style.LEFT * unit, top, sheet.width_px - style.EDGE * unit, top + height) for top in tops]
    names = [top - 0.5 * name - above * (top == first) for top in tops]
    legend = frames[-1].bottom + TIME_ROWS * unit
    return _Layout(frames, names, first - (TICK + (0.5 + rows) * ROW) * unit, legend, round(legend + legend_px))


def _time_of(run: DryRun) -> _Time:
    whole_s = float(max(run.plan.duration_s, run.history.t_s[-1]))
    unit_s, name = next((unit_s, name) for least_s, unit_s, name in _TIMES if whole_s >= least_s)
    return _Time(whole_s, unit_s, name)


def _note(run: DryRun, say: Words) -> str:
    count = len(run.toolpath)
    blocks = say("motion.blocks_one") if count == 1 else say("motion.blocks", count=count)
    return say("motion.note", blocks=blocks, time=lasting(run.ran_s), machine=machine_name(run.scenario.machine))


def _draw_panels(canvas: Canvas, layout: _Layout, run: DryRun, time: _Time, sheet: Sheet[AnyCanvas]) -> list[Chart]:
    """Draw all panels; the charts in their frames."""
    frame, across = layout.frames[0], AxisRange(0.0, time.whole_s / time.unit_s)
    t_s, panels = panels_of(run, round((frame.right - frame.left) / (BIN * sheet.unit)))
    charts = [Chart(frame, across, panel.range, sheet.unit) for frame, panel in zip(layout.frames, panels, strict=True)]
    for chart, panel, name in zip(charts, panels, layout.names, strict=True):
        draw_chart(canvas, chart, x_values=chart is charts[-1])
        if run.ended:
            _draw_standing(canvas, chart, t_s[-1] / time.unit_s, sheet.say)
        draw_envelope(canvas, chart, t_s / time.unit_s, panel.envelope, (Axis.X, Axis.Y))
        for level in panel.levels:
            draw_level(canvas, chart, level.value, level.paint, LEVEL_WIDTH)
            draw_level(canvas, chart, -level.value, level.paint, LEVEL_WIDTH)
        _draw_name(canvas, chart, panel, sheet.say, name)
    return charts


def _draw_standing(canvas: Canvas, chart: Chart, since: float, say: Words) -> None:
    """Shade a panel from the time on at which the machine stood still."""
    frame, size = chart.frame, style.TEXT * chart.unit
    left = float(chart.x_px(since))
    canvas.box(frame._replace(left=left), Paint.GRID, Paint.FRAME, style.GRID_WIDTH * chart.unit)
    text = say("motion.stands")
    if text_width(text, size) < frame.right - left:
        middle = (left + frame.right) / 2.0, (frame.top + frame.bottom) / 2.0
        canvas.text(middle, text, size, Paint.GREY, align=0.5)


class _LevelText(NamedTuple):
    """A level beside the name of its panel: its text, its width with a sample, and whether it shows at all."""

    level: Level
    text: str
    width: float
    inside: bool


def _level_text(chart: Chart, level: Level, say: Words) -> _LevelText:
    size = style.TICK * chart.unit
    inside = any(chart.y.low <= value <= chart.y.high for value in (level.value, -level.value))
    text = level.text(say) if inside else say("motion.outside", limit=level.text(say))
    return _LevelText(level, text, text_width(text, size) + (SAMPLE * chart.unit + 0.4 * size) * inside, inside)


def _draw_name(canvas: Canvas, chart: Chart, panel: Panel, say: Words, y: float) -> None:
    """Write the name of a panel, and its levels at the right where there is room for all of them."""
    frame, unit, size = chart.frame, chart.unit, style.TICK * chart.unit
    name = say(panel.name)
    canvas.text((frame.left, y), name, size, Paint.INK)
    told_levels = [_level_text(chart, level, say) for level in panel.levels]
    left = frame.right + size - sum(each.width + size for each in told_levels)
    if left < frame.left + text_width(name, size) + size:
        return
    for each in told_levels:
        canvas.text((left + each.width, y), each.text, size, Paint.GREY, align=1.0)
        if each.inside:
            line = np.array([[left, y], [left + SAMPLE * unit, y]])
            canvas.dashed(line, each.level.paint, LEVEL_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit)
        left += each.width + size
