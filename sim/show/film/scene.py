"""The plot of a run in one view, at any moment: ground, kerf in the tone of the last pass, wire.

The plot of a frame: work, clamps and pieces, and the path over them, as it is before the wire and behind it.

Which pass went over each pixel of the plot last: worked out once for a view, as the map of the cut is.

Where things stand on a frame: title, plot, read-outs and the strip of the run.

A drawing surface that may begin with a part of a frame.
"""

from collections.abc import Iterable, Sequence
from typing import Final, Literal, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.curves import CurveKind, Curves, Floats, Ints
from sim.measure.compare.starts import laid_loops
from sim.run.course import Course, Moment
from sim.setup.scenario import Scenario
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import CHORD_PX, cut_runs, flatten, simplify
from sim.show.draw.layout import Box, Page, View
from sim.show.draw.legend import draw_axes, draw_frame
from sim.show.draw.raster import Raster
from sim.show.draw.silent_pygame import pygame
from sim.show.draw.style import TONES, Paint, Theme, tone_number
from sim.show.film.cut_map import FULL, NEVER, CutMap, Discs, Levels, Span, discs_of
from sim.show.pictures.cut.marks import draw_start
from sim.show.pictures.cut.subject import Bodies, draw_bodies

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


def draw_path(canvas: Canvas, page: Page, course: Course, drawing: Iterable[Floats]) -> None:
    """Draw the lines of the `drawing`, the ideal path, its jumps and its start; of a leaning wire both contours.

    Near by, the way of the wire and the single steps show too.
    """
    toolpath, view, unit, room = course.run.toolpath, page.view, page.unit, page.inside
    points_um, row = flatten(toolpath, CHORD_PX / view.px_per_um)
    with canvas.clipped(room):
        for loop in drawing:
            _draw_run(canvas, loop, page, Paint.DRAWING, style.CONTOUR_WIDTH)
        for face, paint in zip(faces_of(course), (Paint.BOTTOM, Paint.TOP), strict=False):  # none of an upright wire
            places_um, of = flatten(face, CHORD_PX / view.px_per_um)
            for run in cut_runs(places_um, of, face.kind == CurveKind.JUMP):
                _draw_run(canvas, run, page, paint, style.ACTUAL_WIDTH)
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


def faces_of(course: Course) -> tuple[Curves, ...]:
    """The contours at the bottom and the top of the work that a leaning wire cuts; none of an upright one."""
    cut = course.run.tilted
    return () if cut is None else cut.path.faces


def drawing_um(course: Course, view: View) -> list[Floats]:
    """Lines (k, 2) of the drawing that the cut is held against, as it lies on the part: one to each of its loops."""
    found = course.run.comparison
    loops = [] if found is None else laid_loops(found.drawing, found.placement)
    return [flatten(loop, CHORD_PX / view.px_per_um)[0] for loop in loops]


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


Pixels = NDArray[np.uint8]
"""(h, w, 3) red, green and blue."""


class Plate(Raster):
    """A page that is drawn on again and again."""

    def clear(self) -> None:
        """Make the page empty again."""
        self.box(Box(0.0, 0.0, self.width_px, self.height_px), Paint.PAGE, Paint.PAGE, 0.0)

    def lay(self, pixels: Pixels) -> None:
        """Cover the page with pixels (h, w, 3) of its size."""
        below = pygame.image.frombuffer(np.ascontiguousarray(pixels).data, (self.width_px, self.height_px), "RGB")
        self._surface.blit(pygame.transform.scale_by(below, self._scale), (0, 0))

    def pixels(self) -> Pixels:
        """The page as pixels, in an array of their own."""
        return np.array(self.image())


def plate_over(pixels: Pixels, theme: Theme) -> Plate:
    """A page that begins with pixels (h, w, 3)."""
    tall, wide = pixels.shape[:2]
    plate = Plate(wide, tall, theme)
    plate.lay(pixels)
    return plate


WIDE: Final = 1.15
"""Width over height from which on the read-outs stand beside the plot, else below it."""
PANEL: Final = 400.0
PANEL_ROWS: Final = 6.5  # of the read-outs below a plot
HEAD: Final = 66.0
STRIP: Final = 74.0
AXIS: Final = 44.0
SHAPE: Final = (1600.0, 900.0)
"""Sizes of `sim.show.draw.style` are those of a frame like this."""


class Layout(NamedTuple):
    """Boxes of a frame, px, with the factor on all sizes; `is_wide` where the read-outs stand beside the plot."""

    width_px: int
    height_px: int
    unit: float
    head: Box
    plot: Box
    panel: Box
    strip: Box
    is_wide: bool


def layout_for(width_px: int, height_px: int) -> Layout:
    """Layout of a frame, px."""
    is_wide = width_px >= WIDE * height_px
    wide, tall = SHAPE if is_wide else (0.6 * SHAPE[0], 0.6 * SHAPE[0])
    unit = max(min(width_px / wide, height_px / tall), style.LEAST_UNIT)
    edge, head, strip = style.EDGE * unit, HEAD * unit, STRIP * unit
    bottom = height_px - strip
    left = style.LEFT * unit
    if is_wide:
        panel = Box(width_px - edge - PANEL * unit, head, width_px - edge, bottom)
        plot = Box(left, head, panel.left - edge, bottom - AXIS * unit)
    else:
        panel = Box(edge, bottom - PANEL_ROWS * style.LEGEND_ROW * unit, width_px - edge, bottom)
        plot = Box(left, head, width_px - edge, panel.top - AXIS * unit)
    return Layout(
        width_px,
        height_px,
        unit,
        head=_whole(Box(edge, 0.0, width_px - edge, head)),
        plot=_whole(plot),
        panel=_whole(panel),
        strip=_whole(Box(edge, bottom, width_px - edge, height_px)),
        is_wide=is_wide,
    )


def _whole(box: Box) -> Box:
    """The box with its sides on whole pixels."""
    return Box(*(float(round(side)) for side in box))


class PassMap:
    """The discs of a plot by their tones, from 1; of passes with a later tone the later one lies on top.

    `tone` (k,) int64 is that of each disc.
    """

    def __init__(self, discs: Discs, tone: Ints, plot: Box) -> None:
        self._discs, self._plot = discs, plot
        later = sorted(set(tone.tolist()) - {1})
        self._first = [(each, self._drawn(np.flatnonzero(tone == each))) for each in later]

    def tones(self, front: int, span: Span) -> Ints:
        """Tone (h, w) of each pixel of a span once so many discs are cut."""
        found = np.ones((span.bottom - span.top, span.right - span.left), dtype=np.int64)
        for tone, first in self._first:
            found[first[span.of] < front] = tone
        return found

    def _drawn(self, numbers: Ints) -> NDArray[np.uint32]:
        """Number (h, w) of the first disc over each pixel, those too that a disc only touches."""
        plot = self._plot
        surface = pygame.Surface((round(plot.right - plot.left), round(plot.bottom - plot.top)), depth=32)
        surface.fill(NEVER)
        places = np.rint(self._discs.centers[numbers] - (plot.left, plot.top)).astype(np.int64).tolist()
        radius = (np.rint(self._discs.radius[numbers]).astype(np.int64) + 1).tolist()
        for number, place, own in zip(numbers.tolist()[::-1], places[::-1], radius[::-1], strict=True):
            pygame.draw.circle(surface, number, place, own)
        return np.ascontiguousarray(pygame.surfarray.pixels2d(surface).T)


FALL_S: Final = 0.7
"""So long a piece that came free lies grey before it is gone, in seconds of the film."""

TIP_MOST_PX: Final = 150.0
"""Up to this radius the kerf reaches the wire in every frame; a wider one grows disc by disc.

Its front is then far from the wire, mostly outside the plot.
"""
NOTHING: Final = Span(0, 0, 0, 0)


class Scene:
    """Pictures of the plot before and behind the wire, mixed by what is cut.

    Parameters
    ----------
    course
        The run.
    layout
        Where the plot stands on the frame.
    view
        What it shows.
    theme
        Colours.
    """

    def __init__(self, course: Course, layout: Layout, view: View, theme: Theme) -> None:
        unit = layout.unit
        wide = round(layout.plot.right + style.EDGE * unit / 2)
        self._page = Page(wide, round(layout.plot.bottom + AXIS * unit), unit, layout.plot, view)
        self._course, self._theme = course, theme
        run = course.run
        self._drawing = drawing_um(course, view)
        reach_um = run.reach_um
        self._radius: Floats = np.maximum(reach_um * view.px_per_um, 0.5 * style.KERF_WIDTH_MIN * unit)  # (n,) by row
        discs = discs_of(course.trace, run.toolpath.is_jump, view, layout.plot, self._radius)
        self._map = CutMap(discs, layout.plot)
        tones = np.minimum(course.numbers_at(discs.t_s), len(TONES))
        self._passes = PassMap(discs, tones, layout.plot)
        left, top, right, bottom = (round(side) for side in layout.plot)
        self._plot = (slice(top, bottom), slice(left, right))
        self._behind = np.stack([self._all_cut(paint) for paint in TONES[: int(tones.max(initial=1))]])
        self._pieces: Sequence[PieceDrawn] | None = None
        self._before = self._image = np.empty((0, 0, 3), dtype=np.uint8)
        self._front, self._tip = 0, NOTHING

    @property
    def view(self) -> View:
        """What the plot shows."""
        return self._page.view

    def at(self, moment: Moment, pieces: Sequence[PieceDrawn]) -> Pixels:
        """The plot with its axes, from the corner of the frame on, at a moment, with the pieces as they are then.

        The array changes with the next call.
        """
        if pieces != self._pieces:
            self._begin(pieces)
        front = self._map.front(moment.t_s)
        for span in (self._map.changed(self._front, front), self._tip):
            self._mix(span, self._map.levels(front, span), self._passes.tones(front, span))
        self._front, self._tip = front, NOTHING
        radius = float(self._radius[moment.row])
        if moment.cuts and radius <= TIP_MOST_PX:
            self._tip, levels = self._map.tip(self.view.to_px(moment.wire_um), radius)
            number = moment.running.pass_.number if moment.running else 1
            tones = np.where(levels > 0, tone_number(number), self._passes.tones(front, self._tip))
            self._mix(self._tip, np.maximum(self._map.levels(front, self._tip), levels), tones)
        return self._image

    def _all_cut(self, paint: Paint) -> Pixels:
        """The plot as if all of it were kerf of one tone, with the path."""
        canvas = Plate(self._page.width_px, self._page.height_px, self._theme)
        draw_behind(canvas, self._page, paint)
        draw_path(canvas, self._page, self._course, self._drawing)
        return canvas.pixels()[self._plot]

    def _begin(self, pieces: Sequence[PieceDrawn]) -> None:
        """Begin anew with a plot that is not cut."""
        canvas = Plate(self._page.width_px, self._page.height_px, self._theme)
        draw_ground(canvas, self._page, self._course.run.scenario, pieces)
        draw_path(canvas, self._page, self._course, self._drawing)
        self._pieces, self._before = pieces, canvas.pixels()
        self._image = self._before.copy()
        self._front, self._tip = 0, NOTHING

    def _mix(self, span: Span, levels: Levels, tones: Ints) -> None:
        """Show a span as far as it is cut, in the tones (h, w) of its pixels."""
        plot = span.of
        image, before = self._image[self._plot][plot], self._before[self._plot][plot]
        image[...] = before
        cut = levels > 0
        share = levels[cut].astype(np.uint16)[:, None]
        behind = self._behind[(slice(None), *plot)][tones[cut] - 1, *np.nonzero(cut)]
        image[cut] = (before[cut] * (FULL - share) + behind * share) // FULL


def fate(freed_s: float, t_s: float, speed: float) -> Fate:
    """What has become of a piece that comes free at `freed_s`; `speed` is seconds of the run to one of the film."""
    if t_s < freed_s:
        return "held"
    return "free" if t_s < freed_s + FALL_S * speed else "gone"
