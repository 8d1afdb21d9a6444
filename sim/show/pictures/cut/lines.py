"""What is stroked: the kerf, the path, the contour it is made from, where the wire was, and jumps.

Where a cut is off its drawing: strips between the edge and the drawing, filled by what is wrong there. A strip that
would be too thin to be seen is drawn so many times as wide, and its legend says how many.
"""

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints, box_of
from sim.show.draw import style
from sim.show.draw.canvas import Canvas, dashes_along
from sim.show.draw.flatten import CHORD_PX, bounds_um, cut_runs, flatten, simplify
from sim.show.draw.layout import Page, View, nice_below
from sim.show.draw.legend import Entry, stroke
from sim.show.draw.style import TONES, Paint, paint_of_pass, tone_number
from sim.show.pictures.cut.subject import Cut
from sim.show.texts import Words

if TYPE_CHECKING:  # of a path no pieces and no comparison are known, and their rooms take long to load
    from sim.measure.compare.result import Strips

_LEAD = len(TONES) + 1


class Band(NamedTuple):
    """A stretch (k, 2) px that the kerf lies around, and the paint of the kerf there."""

    way: Floats
    paint: Paint


class Line(NamedTuple):
    """A stretch (k, 2) px of the path or of the wire's way, and the number of the tone of its pass; 1 for leads."""

    way: Floats
    tone: int


class Lines(NamedTuple):
    """Lines on the page, px: stretches (k, 2) and jumps, each (2, 2).

    Without a trace `actual` is empty and the kerf follows the path. Of its bands the later lie on top. `faces` are the
    ways of a wire that leans at bottom and top, none of an upright one.
    """

    ideal: list[Line]
    actual: list[Line]
    contour: list[Floats]
    jumps: list[Floats]
    kerf: list[Band]
    faces: tuple[list[Floats], list[Floats]]


def path_bounds_um(cut: Cut) -> Floats:
    """Box around path, contour and kerf, (2, 2)."""
    boxes = [bounds_um(curves) for curves in (cut.toolpath, cut.contour, *(cut.faces or ())) if curves is not None]
    if cut.trace is not None:
        boxes.append(box_of(cut.trace.wire_um))
    return box_of(np.concatenate(boxes)) + cut.kerf_um / 2 * np.array([[-1.0], [1.0]])


def shown_bounds_um(cut: Cut) -> Floats:
    """Box around the path and the bodies near it, (2, 2), at least four kerfs and 0.1 mm wide."""
    box = path_bounds_um(cut)
    missing = max(4 * cut.kerf_um, 100.0) - float((box[1] - box[0]).max())
    return cut.bodies.around(box + max(missing / 2, 0.0) * np.array([[-1.0, 0.0], [1.0, 0.0]]))


def lines_of(cut: Cut, view: View) -> Lines:
    """The lines of a cut in a view."""
    toolpath, trace = cut.toolpath, cut.trace
    jumps = np.stack([toolpath.start_um, toolpath.end_um], axis=1)[toolpath.is_jump]
    tone = _tones(cut)
    tone[tone == _LEAD] = 1
    return Lines(
        ideal=_lines_px(*flatten(toolpath, CHORD_PX / view.px_per_um), tone, view),
        actual=[] if trace is None else _lines_px(trace.wire_um, trace.row, tone, view),
        contour=[] if cut.contour is None else _path_px(cut.contour, view),
        jumps=list(view.to_px(jumps)),
        kerf=_bands(cut, view),
        faces=([], []) if cut.faces is None else (_path_px(cut.faces[0], view), _path_px(cut.faces[1], view)),
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


def _lines_px(points_um: Floats, row: Ints, tone: Ints, view: View) -> list[Line]:
    """Lines of each tone, those of the rough cuts first; on jumps the tone is 0."""
    tones = sorted(set(tone.tolist()) - {0})
    return [Line(run, each) for each in tones for run in _runs_px(points_um, row, tone != each, view)]


def _path_px(path: Curves, view: View) -> list[Floats]:
    return _runs_px(*flatten(path, CHORD_PX / view.px_per_um), path.kind == CurveKind.JUMP, view)


def _runs_px(points_um: Floats, row: Ints, left_out: Bools, view: View) -> list[Floats]:
    return [simplify(view.to_px(run), CHORD_PX) for run in cut_runs(points_um, row, left_out)]


def draw_kerf(canvas: Canvas, lines: Lines, kerf_px: float) -> None:
    """Draw the kerf, `kerf_px` wide, which lies below all lines."""
    for band in lines.kerf:
        canvas.polyline(band.way, band.paint, kerf_px)


def draw_lines(canvas: Canvas, unit: float, lines: Lines) -> None:
    """Draw all lines but the kerf."""
    for run in lines.contour:
        canvas.polyline(run, Paint.CONTOUR, style.CONTOUR_WIDTH * unit)
    bottom, top = lines.faces
    for run in bottom:
        canvas.dashed(run, Paint.BOTTOM, style.ACTUAL_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit)
    for run in top:
        canvas.polyline(run, Paint.TOP, style.ACTUAL_WIDTH * unit)
    for line in lines.actual:
        draw_line(canvas, line, Paint.ACTUAL, style.ACTUAL_WIDTH, unit)
    for line in lines.ideal:
        draw_line(canvas, line, Paint.IDEAL, style.IDEAL_WIDTH, unit)
    for jump in lines.jumps:
        canvas.dashed(jump, Paint.JUMP, style.JUMP_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit)


def draw_line(canvas: Canvas, line: Line, paint: Paint, width: float, unit: float) -> None:
    """Draw a line of a width in units, by the dashes of its pass.

    Steps of a way that are narrower than the line would put its dashes out of step with those of the path.
    """
    dash = style.PASS_DASHES[line.tone - 1]
    if dash is None:
        runs: Iterable[Floats] = [line.way]
    else:
        runs = dashes_along(simplify(line.way, 0.5 * width * unit), dash[0] * unit, dash[1] * unit)
    for run in runs:
        canvas.polyline(run, paint, width * unit)


_SEEN: Final = 7.0
"""Units that the widest strip is drawn wide, at least."""
_PAINTS: Final = {-1: Paint.OVERCUT, 1: Paint.LEFT_OVER}


def times_wider(strips: "Strips", page: Page) -> int:
    """How many times as wide as they are the strips are drawn, to be seen."""
    wanted = _SEEN * page.unit / max(strips.widest_um * page.view.px_per_um, 1e-9)
    return 1 if wanted <= 1.0 else int(np.ceil(nice_below(2.0 * wanted)))


def draw_off(canvas: Canvas, page: Page, strips: "Strips") -> None:
    """Fill the strips, and draw the drawing beside them."""
    rings = list(_strips_px(strips, page.view, times_wider(strips, page)))
    for side, ring in rings:
        canvas.polygon(ring, _PAINTS[side])
    # A viewer blends the borders of strips with what lies beneath: without this there are seams between them.
    for side, ring in rings:
        canvas.polyline(ring[[0, -1]], _PAINTS[side], style.GRID_WIDTH * page.unit)
    for loop in strips.drawn:
        points, _ = flatten(loop, CHORD_PX / page.view.px_per_um)
        line = simplify(page.view.to_px(points), CHORD_PX)
        canvas.polyline(line, Paint.DRAWING, style.CONTOUR_WIDTH * page.unit)


def _strips_px(strips: "Strips", view: View, times: int) -> Iterator[tuple[int, Floats]]:
    """The side of each strip, and its outline on the page."""
    edge = view.to_px(strips.foot_um + times * (strips.edge_um - strips.foot_um))
    foot = view.to_px(strips.foot_um)
    first = np.flatnonzero(np.diff(strips.strip, prepend=-1))
    for low, past in zip(first.tolist(), [*first[1:].tolist(), len(strips.strip)], strict=True):
        yield int(strips.side[low]), np.concatenate([edge[low:past], foot[low:past][::-1]])


def off_entries(strips: "Strips | None", page: Page, say: Words) -> Iterator[Entry]:
    """What a legend says of them."""
    if strips is None:
        return
    times = times_wider(strips, page)
    wider = say("cut.times", times=times) if times > 1 else ""
    for side, key in ((-1, "cut.overcut"), (1, "cut.left-over")):
        if (strips.side == side).any():
            yield Entry(stroke(_PAINTS[side], 4.0 * style.CONTOUR_WIDTH), say(key) + wider)
    yield Entry(stroke(Paint.DRAWING, style.CONTOUR_WIDTH), say("cut.drawing"))
