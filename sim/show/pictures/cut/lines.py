"""What is stroked: the kerf, the path, the contour it is made from, where the wire was, and jumps."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats, Ints
from parser.toolpath import Toolpath
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import bounds_um, cut_runs, flatten
from sim.show.draw.layout import View
from sim.show.draw.paints import TONES, Paint, paint_of_pass, tone_number
from sim.show.draw.simplify import CHORD_PX, simplify
from sim.show.pictures.cut.subject import Cut

_LEAD = len(TONES) + 1


class Band(NamedTuple):
    """A stretch (k, 2) px that the kerf lies around, and the paint of the kerf there."""

    way: Floats
    paint: Paint


class Lines(NamedTuple):
    """Lines on the page, px: stretches (k, 2) and jumps, each (2, 2).

    Without a trace `actual` is empty and the kerf follows the path. Of its bands the later lie on top.
    """

    ideal: list[Floats]
    actual: list[Floats]
    contour: list[Floats]
    jumps: list[Floats]
    kerf: list[Band]


def path_bounds_um(cut: Cut) -> Floats:
    """Box around path, contour and kerf, (2, 2)."""
    boxes = [bounds_um(toolpath) for toolpath in (cut.toolpath, cut.contour) if toolpath is not None]
    if cut.trace is not None:
        boxes.append(np.stack([cut.trace.wire_um.min(axis=0), cut.trace.wire_um.max(axis=0)]))
    low, high = np.min([box[0] for box in boxes], axis=0), np.max([box[1] for box in boxes], axis=0)
    return np.asarray(np.stack([low, high]) + cut.kerf_um / 2 * np.array([[-1.0], [1.0]]), dtype=np.float64)


def shown_bounds_um(cut: Cut) -> Floats:
    """Box around the path and the bodies near it, (2, 2), at least four kerfs and 0.1 mm wide."""
    box = path_bounds_um(cut)
    missing = max(4 * cut.kerf_um, 100.0) - float((box[1] - box[0]).max())
    return cut.bodies.around(box + max(missing / 2, 0.0) * np.array([[-1.0, 0.0], [1.0, 0.0]]))


def lines_of(cut: Cut, view: View) -> Lines:
    """The lines of a cut in a view."""
    toolpath, trace = cut.toolpath, cut.trace
    jumps = np.stack([toolpath.start_um, toolpath.end_um], axis=1)[toolpath.is_jump]
    ideal = _path_px(toolpath, view)
    return Lines(
        ideal=ideal,
        actual=[] if trace is None else _runs_px(trace.wire_um, trace.row, toolpath.is_jump, view),
        contour=[] if cut.contour is None else _path_px(cut.contour, view),
        jumps=list(view.to_px(jumps)),
        kerf=_bands(cut, view),
    )


def _bands(cut: Cut, view: View) -> list[Band]:
    """The kerf in the tones of the passes that took it off: leads below, and each pass over those that came later."""
    toolpath = cut.toolpath
    if not cut.kerf_um:
        return []
    if cut.trace is None:
        points, row = flatten(toolpath, CHORD_PX / view.px_per_um)
    else:
        points, row = cut.trace.wire_um, cut.trace.row
    tone = _tones(cut)
    return [
        Band(run, _paint(number, cut))
        for number in sorted(set(tone.tolist()) - {0}, reverse=True)
        for run in _runs_px(points, row, tone != number, view)
    ]


def _paint(number: int, cut: Cut) -> Paint:
    """Paint of the kerf on rows of a tone's number: that of leads where the picture tells them apart."""
    if number == _LEAD:
        return Paint.KERF if cut.leads is None else Paint.LEAD
    return paint_of_pass(number)


def _tones(cut: Cut) -> Ints:
    """Number of the pass whose tone each row (n,) has; `_LEAD` for leads that show, 0 for jumps."""
    numbers = np.ones(len(cut.toolpath), dtype=np.int64)
    if cut.passes is not None:
        own = np.array([*(tone_number(pass_.number) for pass_ in cut.passes.passes), _LEAD])
        numbers = own[cut.passes.of_row]  # the last for the rows of no pass, −1
    if cut.leads is not None:
        numbers[cut.leads] = _LEAD
    return np.where(cut.toolpath.is_jump, 0, numbers)


def _path_px(toolpath: Toolpath, view: View) -> list[Floats]:
    return _runs_px(*flatten(toolpath, CHORD_PX / view.px_per_um), toolpath.is_jump, view)


def _runs_px(points_um: Floats, row: Ints, left_out: Bools, view: View) -> list[Floats]:
    return [simplify(view.to_px(run), CHORD_PX) for run in cut_runs(points_um, row, left_out)]


def draw_kerf(canvas: Canvas, lines: Lines, kerf_px: float) -> None:
    """Draw the kerf, `kerf_px` wide, which lies below all lines."""
    for band in lines.kerf:
        canvas.polyline(band.way, band.paint, kerf_px)


def draw_lines(canvas: Canvas, unit: float, lines: Lines) -> None:
    """Draw all lines but the kerf."""
    strokes = (
        (lines.contour, Paint.CONTOUR, style.CONTOUR_WIDTH * unit),
        (lines.actual, Paint.ACTUAL, style.ACTUAL_WIDTH * unit),
        (lines.ideal, Paint.IDEAL, style.IDEAL_WIDTH * unit),
    )
    for runs, paint, width in strokes:
        for run in runs:
            canvas.polyline(run, paint, width)
    for jump in lines.jumps:
        canvas.dashed(jump, Paint.JUMP, style.JUMP_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit)
