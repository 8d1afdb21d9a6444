"""Deviation on the path: whiskers across it, magnified, as long as the wire is off there."""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import CHORD_PX, bounds_um, cut_runs, flatten, simplify
from sim.show.draw.layout import Box, Page, centred, nice_below
from sim.show.draw.legend import Entry, draw_at_foot, draw_axes, draw_frame, in_rows, stroke
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import Paint
from sim.show.pictures.deviation.frame import Samples, mark_place, titled, tolerance_text, um
from sim.show.pictures.deviation.worst import worst_of
from sim.show.texts import Words

SHARE: Final = 0.06
"""Length of the longest whisker, at most, as a share of the plot's longer side."""
APART: Final = 6.0
"""From whisker to whisker along the path: the worst of each such stretch shows."""
ROOM: Final = 0.09
"""Free border of the plot, as a share of its longer side: whiskers have room in it."""
FEW: Final = 0.7
"""Where samples are on average at least this share of `APART` from each other, each has its whisker."""
WIDTH: Final = 2.0
LEAST_UM: Final = 0.01
LONGEST: Final = 1e6
"""Magnification that is as long to write as any: it tells how many rows the legend takes."""
LEAST_SIDE_UM: Final = 100.0


class _Whiskers(NamedTuple):
    """Whiskers that show: sample, foot µm (k, 2), tip µm (k, 2)."""

    at: Ints
    foot_um: Floats
    tip_um: Floats


def draw_whiskers(sheet: Sheet[AnyCanvas], samples: Samples) -> AnyCanvas:
    """Draw the path with the wire's deviation across it.

    ValueError where the sheet is narrower than 600 px.
    """
    say, unit = sheet.say, sheet.unit
    bounds = _bounds_um(samples)
    legend_px = in_rows(_entries(say, samples, unit, LONGEST, 1.0), sheet.width_px, unit).foot
    page = _page(bounds, sheet.width_px, unit, legend_px)
    times = magnification(samples, page)
    legend = in_rows(_entries(say, samples, unit, times, page.view.px_per_um), sheet.width_px, unit)
    canvas = titled(sheet, samples, say("deviation.whiskers"), page.height_px)
    draw_frame(canvas, page)
    draw_axes(canvas, page)
    whiskers = _whiskers(samples, page, times)
    _draw(canvas, page, samples, whiskers)
    _mark_worst(canvas, page, samples, whiskers, say)
    draw_at_foot(canvas, legend)
    return canvas


def magnification(samples: Samples, page: Page) -> float:
    """How many times longer deviations are drawn than the part: a round number, 1 or more."""
    longer = max(page.plot.right - page.plot.left, page.plot.bottom - page.plot.top)
    return max(nice_below(SHARE * longer / (max(samples.max_um, LEAST_UM) * page.view.px_per_um)), 1.0)


def _bounds_um(samples: Samples) -> Floats:
    """Box (2, 2) around the path, `LEAST_SIDE_UM` wide at least."""
    box = bounds_um(samples.run.toolpath)
    missing = max(LEAST_SIDE_UM - float((box[1] - box[0]).max()), 0.0) / 2.0
    return np.asarray(box + np.array([[-missing], [missing]]), dtype=np.float64)


def _page(bounds: Floats, width_px: int, unit: float, legend_px: float) -> Page:
    """Lay out the plot with room for the longest whisker on every side, and for the legend below it."""
    left, right, top = style.LEFT * unit, width_px - style.EDGE * unit, style.HEAD * unit
    foot = legend_px + 1.8 * style.TICK * unit
    wide, tall = np.maximum(bounds[1] - bounds[0], 1e-9).tolist()
    low, high = (share * width_px - top - foot for share in style.HEIGHT_RANGE)
    height = min(max((right - left) * tall / wide, low), high)
    plot = Box(left, top, right, top + height)
    room = ROOM * max(right - left, height)
    scale = min((right - left - 2.0 * room) / wide, (height - 2.0 * room) / tall)
    return Page(width_px, round(plot.bottom + foot), unit, plot, centred(bounds.mean(axis=0), scale, plot))


def _whiskers(samples: Samples, page: Page, times: float) -> _Whiskers:
    """The whiskers that show, in the order of the path."""
    at = _worst_samples(samples, APART * page.unit / page.view.px_per_um)
    place, foot = samples.trace.wire_um[at], samples.foot_um[at]
    tip = foot + times * (place - foot)
    seen = _uncovered(samples, at, page.view.to_px(np.stack([foot, tip], axis=1)) / (WIDTH * page.unit))
    return _Whiskers(at[seen], foot[seen], tip[seen])


def _uncovered(samples: Samples, at: Ints, lines: Floats) -> Ints:
    """Which whiskers no worse one covers, rising; `lines` are their ends (k, 2, 2), in widths of a whisker.

    Whiskers lie on each other where a path runs over itself.
    """
    worst_first = np.argsort(-np.abs(samples.wire_um[at]), kind="stable")
    cells = np.rint(lines[worst_first]).astype(np.int64).reshape(len(at), 4)
    _, first = np.unique(cells, axis=0, return_index=True)
    return np.sort(worst_first[first])


def _worst_samples(samples: Samples, apart_um: float) -> Ints:
    """The worst sample in each stretch of the cut, and in each block that is no shorter than that.

    Where there are few samples all of them: one of the two in a stretch, and none in the next, would look like gaps.
    """
    cut = np.flatnonzero(samples.cutting)
    if float(samples.along_um[-1]) >= FEW * apart_um * len(samples):
        return cut
    stretch = np.floor(samples.along_um[cut] / apart_um).astype(np.int64)
    row = samples.trace.row[cut]
    worst_of_row = worst_of(samples, cut, row)
    long = samples.run.toolpath.length_um[samples.trace.row[worst_of_row]] >= apart_um
    return np.union1d(worst_of(samples, cut, stretch), worst_of_row[long])


def _draw(canvas: Canvas, page: Page, samples: Samples, whiskers: _Whiskers) -> None:
    toolpath = samples.run.toolpath
    points_um, row = flatten(toolpath, CHORD_PX / page.view.px_per_um)
    with canvas.clipped(page.plot):
        for run in cut_runs(points_um, row, toolpath.is_jump):
            canvas.polyline(simplify(page.view.to_px(run), CHORD_PX), Paint.IDEAL, style.IDEAL_WIDTH * page.unit)
        lines = page.view.to_px(np.stack([whiskers.foot_um, whiskers.tip_um], axis=1))
        outside = np.abs(samples.wire_um[whiskers.at]) > samples.tolerance_um
        for line, is_outside in zip(lines, outside.tolist(), strict=True):
            canvas.polyline(line, Paint.ERROR if is_outside else Paint.ACTUAL, WIDTH * page.unit)


def _mark_worst(canvas: Canvas, page: Page, samples: Samples, whiskers: _Whiskers, say: Words) -> None:
    """Ring the tip of the longest whisker and write beside it, on the side where there is more room."""
    worst = samples.worst
    if worst is None:
        return
    tip = page.view.to_px(whiskers.tip_um[np.searchsorted(whiskers.at, worst)])
    text = say("deviation.largest", most=um(samples.wire_um[worst], signed=True), block=samples.block_name(worst))
    mark_place(canvas, page.plot, tip, text, page.unit)


def _entries(say: Words, samples: Samples, unit: float, times: float, px_per_um: float) -> list[Entry]:
    """Entries of the legend; the sample of the scale is as long as a whisker of that size."""
    size_um = nice_below(style.SAMPLE * unit / (times * px_per_um))
    scale_px = size_um * times * px_per_um

    def scale(canvas: Canvas, box: Box, unit: float) -> None:
        y, tick = (box.top + box.bottom) / 2.0, 0.2 * style.LEGEND_ROW * unit
        line = np.array([[box.right - scale_px, y], [box.right, y]])
        canvas.polyline(line, Paint.INK, WIDTH * unit)
        for end in line:
            canvas.polyline(end + np.array([[0.0, -tick], [0.0, tick]]), Paint.INK, WIDTH * unit)

    return [
        Entry(scale, say("deviation.magnified", size=f"{size_um:g}", times=f"{times:,.0f}")),
        Entry(stroke(Paint.IDEAL, style.IDEAL_WIDTH), say("deviation.ideal")),
        Entry(stroke(Paint.ACTUAL, WIDTH), say("deviation.inside")),
        Entry(stroke(Paint.ERROR, WIDTH), say("deviation.outside", tolerance=tolerance_text(say, samples))),
    ]
