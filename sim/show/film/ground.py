"""The plot of a frame: work, clamps and pieces, and the path over them, as it is before the wire and behind it."""

from collections.abc import Iterable
from typing import Final, Literal, NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats
from sim.run.course import Course
from sim.setup.scenario import Scenario
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import cut_runs, flatten
from sim.show.draw.layout import Box, Page, View
from sim.show.draw.legend import draw_axes, draw_frame
from sim.show.draw.paints import Paint
from sim.show.draw.simplify import CHORD_PX, simplify
from sim.show.pictures.cut.marks import draw_start
from sim.show.pictures.cut.outlines import Bodies, draw_bodies

STEPS_FROM: Final = 2.0
"""Pixels to the µm from which on the single steps show."""
TRACE_FROM: Final = 0.5
"""Pixels to the µm from which on the way of the wire shows beside the ideal path."""

INTO_KERF: Final = 1.9
"""Offsets by which outlines are grown; the kerf that then lies over their borders is two wide."""
PLAIN_UM: Final = 2.0
"""Before that, outlines lose their finer detail: they may have a corner to each step, and the kerf hides the border."""

Fate = Literal["held", "free", "gone"]


class PieceDrawn(NamedTuple):
    """A piece as it is drawn: into the kerf round it, with what is still to be cut in it; and what has become of it."""

    outline_um: shapely.Polygon
    fate: Fate


def outlines_um(course: Course) -> list[shapely.Polygon]:
    """Outlines of the pieces of a run with the kerf round them."""
    grown_um = INTO_KERF * course.run.scenario.wire.reach_um
    plain = [shapely.simplify(piece.what.outline_um, PLAIN_UM) for piece in course.pieces]
    return [shapely.buffer(outline, grown_um, quad_segs=4) for outline in plain]


def draw_ground(canvas: Canvas, page: Page, scenario: Scenario, pieces: Iterable[PieceDrawn]) -> None:
    """Draw the plot before the wire comes, with the pieces as far as they are free."""
    draw_frame(canvas, page)
    if scenario.work_um is None:  # a plate without end
        canvas.box(page.inside, Paint.WORK, Paint.WORK, 0.0)
    draw_bodies(canvas, page, Bodies(scenario.work_um, [clamp.outline_um for clamp in scenario.clamps]))
    with canvas.clipped(page.inside):
        for outline, fate in pieces:
            if fate != "held":
                _draw_outline(canvas, page, outline, Paint.SLUG if fate == "free" else Paint.PAGE)
    draw_axes(canvas, page)


def draw_behind(canvas: Canvas, page: Page, paint: Paint) -> None:
    """Draw the plot as if all of it were kerf of one tone."""
    canvas.box(page.inside, paint, paint, 0.0)
    if page.view.px_per_um >= TRACE_FROM:  # at smaller scales the grid looks like cracks in the kerf
        draw_axes(canvas, page)


def draw_path(canvas: Canvas, page: Page, course: Course) -> None:
    """Draw the ideal path, its jumps and its start; near by, the way of the wire and the single steps too."""
    toolpath, view, unit, room = course.run.toolpath, page.view, page.unit, page.inside
    points_um, row = flatten(toolpath, CHORD_PX / view.px_per_um)
    with canvas.clipped(room):
        for run in cut_runs(points_um, row, toolpath.is_jump):
            _draw_run(canvas, run, page, Paint.GREY, style.IDEAL_WIDTH)
        for jump in np.stack([toolpath.start_um, toolpath.end_um], axis=1)[toolpath.is_jump]:
            for near in near_runs(view.to_px(jump), room):
                canvas.dashed(
                    _within(near, room), Paint.JUMP, style.JUMP_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit
                )
        if view.px_per_um >= TRACE_FROM:
            _draw_run(canvas, course.trace.wire_um, page, Paint.ACTUAL, style.IDEAL_WIDTH)
        if view.px_per_um >= STEPS_FROM:
            _draw_steps(canvas, page, course)
        draw_start(canvas, view.to_px(toolpath.start_um[0]), unit)


def _draw_run(canvas: Canvas, points_um: Floats, page: Page, paint: Paint, width: float) -> None:
    if len(points_um) > 1:
        for run in near_runs(page.view.to_px(points_um), page.plot):
            canvas.polyline(simplify(run, CHORD_PX), paint, width * page.unit)


def near_runs(points: Floats, box: Box) -> list[Floats]:
    """Stretches of a line (n, 2) px whose chords may meet a box, each (k, 2) with k ≥ 2."""
    low, high = np.minimum(points[:-1], points[1:]), np.maximum(points[:-1], points[1:])
    meets = ((high >= (box.left, box.top)) & (low <= (box.right, box.bottom))).all(axis=1)
    edges = np.flatnonzero(np.diff(meets, prepend=False, append=False))
    return [points[first : past + 1] for first, past in edges.reshape(-1, 2).tolist()]


def _draw_steps(canvas: Canvas, page: Page, course: Course) -> None:
    """Draw the staircase of the steps that lie in the plot."""
    low, high = page.view.range_um(page.plot)
    x, y = np.asarray(course.steps.x_um), np.asarray(course.steps.y_um)
    near = (x >= low[0]) & (x <= high[0]) & (y >= low[1]) & (y <= high[1])
    edges = np.flatnonzero(np.diff(near, prepend=False, append=False))
    for first, past in edges.reshape(-1, 2).tolist():
        stairs = page.view.to_px(np.stack([x[first:past], y[first:past]], axis=1).astype(np.float64))
        canvas.polyline(stairs, Paint.CONTOUR, style.JUMP_WIDTH * page.unit)


def _draw_outline(canvas: Canvas, page: Page, whole: shapely.Polygon, paint: Paint) -> None:
    for outline in _near_outlines(whole, page.view, page.plot):
        rings = [page.view.to_px(np.asarray(ring.coords)[:-1, :2]) for ring in (outline.exterior, *outline.interiors)]
        canvas.region(rings, paint)


def _near_outlines(whole: shapely.Polygon, view: View, plot: Box) -> list[shapely.Polygon]:
    """The part of an outline that lies in or near a plot, as polygons."""
    low, high = view.range_um(plot)
    margin = 2.0 / view.px_per_um
    part = shapely.clip_by_rect(whole, *(low - margin).tolist(), *(high + margin).tolist())
    simple = shapely.simplify(part, CHORD_PX / view.px_per_um)
    return [
        each_part
        for each_part in shapely.get_parts(simple)
        if isinstance(each_part, shapely.Polygon) and not each_part.is_empty
    ]


def _within(line: Floats, box: Box) -> Floats:
    """The part of a straight line (2, 2) within a box, so that no one counts dashes far away from it."""
    (x, y), by = line[0], line[1] - line[0]
    first, last = 0.0, 1.0
    for start, along, low, high in ((x, by[0], box.left, box.right), (y, by[1], box.top, box.bottom)):
        if along:
            near, far = sorted(((low - start) / along, (high - start) / along))
            first, last = max(first, near), min(last, far)
    return np.stack([line[0] + max(first, 0.0) * by, line[0] + max(last, first) * by])
