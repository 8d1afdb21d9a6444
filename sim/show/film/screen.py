"""A frame of a film: the plot at a moment, with read-outs beside it and the strip below.

What the marks of a frame mean, below its read-outs.

The read-outs as pixels: a line is drawn anew only when its text has changed.

What moves on the plot: the wire where it is, and the place that the steps have asked for.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from parser.findings.catalogue import Language
from parser.geometry.curves import Floats, box_of
from sim.run.course import Course, Moment
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import bounds_um
from sim.show.draw.layout import Box, View, fitted
from sim.show.draw.legend import Entry, LegendSizes, across, draw_legend, elide, in_columns, middle, stroke
from sim.show.draw.letters import text_width
from sim.show.draw.style import (
    THEMES,
    TONES,
    Paint,
    Theme,
    ThemeName,
)
from sim.show.film.readout import Line, bar_of, draw_strip, read_out, x_px
from sim.show.film.scene import (
    Layout,
    PieceDrawn,
    Pixels,
    Plate,
    Scene,
    faces_of,
    fate,
    layout_for,
    outlines_um,
    plate_over,
)
from sim.show.pictures.cut.subject import Bodies
from sim.show.texts import Words

THE_WIRE: Final = Paint.JUMP
"""The colour of the wire, which the page has too (`--wire` of replay.css)."""
WIRE: Final = 5.0
"""Least radius of the wire's mark, so that it can be seen."""
RING_MOST: Final = 130.0
"""The outline of a wire with a larger radius is not drawn."""
ARM: Final = (9.0, 19.0)
"""The arms of the cross begin and end so far from the commanded place: the wire's mark fits between them."""


def reach(radius: float, unit: float) -> float:
    """How far the marks reach from their places, px, about a wire of that radius, px."""
    ring = radius if radius <= RING_MOST * unit else 0.0
    return max(ring, ARM[1] * unit) + style.MARK_WIDTH * unit


def draw_wire(canvas: Canvas, center: Floats, radius: float, unit: float) -> None:
    """Mark the wire at a place (2,) px, with its true outline, `radius` px, where that shows."""
    canvas.disc(center, WIRE * unit, THE_WIRE)
    if WIRE * unit < radius <= RING_MOST * unit:
        canvas.ring(center, radius, THE_WIRE, style.JUMP_WIDTH * unit)


def draw_commanded(canvas: Canvas, center: Floats, unit: float) -> None:
    """Mark the commanded place (2,) px with a cross that is open in its middle."""
    for along in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
        arm = center + np.outer(ARM, along) * unit
        canvas.polyline(arm, Paint.INK, style.JUMP_WIDTH * unit)


ROW: Final = 41.0
FIRST_CJK: Final = 0x2E80
LEADING: Final = 1.3
GAP: Final = 40.0
"""Between the two columns of read-outs below a plot."""


class ReadoutPanel:
    """The lines of a frame, in one column beside the plot or in two below it."""

    def __init__(self, layout: Layout, theme: Theme, lines: int) -> None:
        self._unit = layout.unit
        self._boxes = _boxes(layout, lines)
        self._shown: list[Line | None] = [None] * lines
        self._plates = [Plate(round(box.right - box.left), round(box.bottom - box.top), theme) for box in self._boxes]

    def show(self, lines: Sequence[Line], frame: Pixels) -> None:
        """Draw lines into a frame that holds those of the last time."""
        for at, line in enumerate(lines):
            if line != self._shown[at]:
                left, top, right, bottom = (round(side) for side in self._boxes[at])
                plate = self._plates[at]
                plate.clear()
                _draw_line(plate, line, self._unit)
                frame[top:bottom, left:right] = plate.pixels()
                self._shown[at] = line

    @property
    def foot(self) -> float:
        """Where the lowest line ends, px."""
        return max(box.bottom for box in self._boxes)


def _boxes(layout: Layout, lines: int) -> list[Box]:
    """Boxes of the lines; below a plot the first two and the last take the whole width."""
    panel, row = layout.panel, ROW * layout.unit
    if layout.is_wide:
        boxes = [_row(panel, number, row) for number in range(lines)]
        return [*boxes[:-1], boxes[-1]._replace(bottom=boxes[-1].bottom + round(row))]
    row = (panel.bottom - panel.top) / ((lines - 2) // 2 + 3)
    middle, gap = (panel.left + panel.right) / 2, GAP * layout.unit / 2
    left, right = panel._replace(right=middle - gap), panel._replace(left=middle + gap)
    pairs = [_row((left, right)[number % 2], 2 + number // 2, row) for number in range(lines - 3)]
    last = 2 + (lines - 2) // 2
    return [_row(panel, 0, row), _row(panel, 1, row), *pairs, _row(panel, last, row)]


def _row(column: Box, number: int, row: float) -> Box:
    return Box(column.left, column.top + round(number * row), column.right, column.top + round((number + 1) * row))


def _draw_line(canvas: Canvas, line: Line, unit: float) -> None:
    row = min(ROW * unit, float(canvas.height_px))
    middle, size = row / 2, min(style.TEXT * unit, 0.72 * row)
    if not line.name:
        texts = _wrapped(canvas, line.value, size) if canvas.height_px > 1.5 * row else (line.value,)
        for number, text in enumerate(texts):
            place = (0.0, middle + number * size * LEADING)
            canvas.text(place, elide(text, size, canvas.width_px), size, line.paint)
        return
    canvas.text((0.0, middle), line.name, size, Paint.GREY)
    canvas.text((canvas.width_px, middle), line.value, size, line.paint, align=1.0)


def _wrapped(canvas: Canvas, text: str, size: float) -> tuple[str, ...]:
    """The text as one line where it fits, else as two, broken at a space or between Chinese characters."""
    if text_width(text, size) <= canvas.width_px:
        return (text,)
    breaks = [at for at in range(1, len(text)) if text[at - 1] == " " or ord(text[at - 1]) >= FIRST_CJK]
    fitting = [at for at in breaks if text_width(text[:at], size) <= canvas.width_px]
    return (text[: fitting[-1]].rstrip(), text[fitting[-1] :]) if fitting else (text,)


SIZES: Final = LegendSizes(row=38.0, sample=44.0, text=0.9 * style.TEXT)


def draw_film_legend(canvas: Canvas, box: Box, unit: float, entries: list[Entry]) -> None:
    """Write a legend at the foot of a box; nothing where it does not fit."""
    legend = in_columns(entries, 1, box.right - box.left, unit, SIZES)
    top = box.bottom - legend.height
    if top >= box.top:
        draw_legend(canvas, legend, box.left, top)


_FACES: Final = (("taper.upper-contour", Paint.TOP), ("taper.lower-contour", Paint.BOTTOM))


def film_entries(say: Words, passes: int, *, wider: bool, drawing: bool, pieces: bool) -> list[Entry]:
    """What a frame shows: the kerf, `wider` than it is where it would not show, and maybe a drawing and free `pieces`.

    `passes` is how many there are over one edge at most.
    """
    return [
        Entry(_wire, say("film.wire")),
        Entry(_commanded, say("film.commanded")),
        _kerf(say, passes, wider=wider),
        Entry(stroke(Paint.GREY, style.IDEAL_WIDTH), say("film.ideal")),
        *([Entry(stroke(Paint.DRAWING, style.CONTOUR_WIDTH), say("film.drawing"))] if drawing else []),
        *([Entry(_piece, say("film.free_piece"))] if pieces else []),
    ]


def _kerf(say: Words, passes: int, *, wider: bool) -> Entry:
    """The kerf, one stroke a tone; the tones of passes are explained by their order."""
    width = 2.0 * style.KERF_WIDTH_MIN
    if passes == 1:
        return Entry(stroke(Paint.KERF, width), say("film.kerf_wider" if wider else "film.kerf"))
    text = say("film.kerf_passes_wider" if wider else "film.kerf_passes", last=passes)

    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        paints = TONES[:passes]
        own = (box.right - box.left) / len(paints)
        for at, paint in enumerate(paints):
            part = box._replace(left=box.left + at * own, right=box.left + (at + 1) * own)
            canvas.polyline(across(part), paint, width * unit)

    return Entry(draw, text)


def _wire(canvas: Canvas, box: Box, unit: float) -> None:
    draw_wire(canvas, middle(box), 0.0, unit)


def _commanded(canvas: Canvas, box: Box, unit: float) -> None:
    draw_commanded(canvas, middle(box), 0.8 * unit)


def _piece(canvas: Canvas, box: Box, unit: float) -> None:
    """Two squares: the piece, and the hole that it leaves."""
    half = 0.25 * SIZES.row * unit
    square = half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    for side, paint in ((-1.2, Paint.SLUG), (1.2, Paint.PAGE)):
        corners = middle(box) + square + np.array([side * half, 0.0])
        canvas.polygon(corners, paint)
        canvas.polyline(np.concatenate([corners, corners[:1]]), Paint.SLUG_EDGE, style.GRID_WIDTH * unit)


LEAST_UM = 100.0
"""Narrowest path that fills the plot."""


class Look(NamedTuple):
    """Size of the frames, px, their colours and their language."""

    width_px: int
    height_px: int
    theme: ThemeName
    language: Language


class Screen:
    """Frames of a run, one after the other; those near in time take the least work."""

    def __init__(self, course: Course, look: Look) -> None:
        self.layout = layout_for(look.width_px, look.height_px)
        self.whole = fitted(_bounds_um(course), self.layout.plot, style.PAD * self.layout.unit / 2)
        self._course, self._look, self._outlines_um = course, look, outlines_um(course)
        self._theme, self._say = THEMES[look.theme], Words(look.language)
        first = read_out(course, course.at(0.0), 1.0, self._say)
        self._panel = ReadoutPanel(self.layout, self._theme, len(first))
        self._scene: Scene | None = None
        self._page = self._furniture()
        self._top = round(self.layout.head.bottom - style.TICK * self.layout.unit / 2)
        self._todo, self._done = (self._strip(done=done) for done in (False, True))

    def frame(self, t_s: float, view: View, speed: float) -> Pixels:
        """The frame of a moment, (h, w, 3); the array is the caller's.

        Past the end of the run, pieces go on to fall. `speed` is seconds of the run in each second of the film.
        """
        if self._scene is None or self._scene.view != view:
            self._scene = Scene(self._course, self.layout, view, self._theme)
        moment = self._course.at(t_s)
        fates = (fate(piece.t_s, t_s, speed) for piece in self._course.pieces)
        plot = self._scene.at(moment, list(map(PieceDrawn, self._outlines_um, fates)))
        self._panel.show(read_out(self._course, moment, speed, self._say), self._page)
        frame = self._page.copy()
        frame[self._top : plot.shape[0], : plot.shape[1]] = plot[self._top :]
        self._mark(frame, moment, view)
        self._draw_strip(frame, moment.t_s)
        return frame

    def _furniture(self) -> Pixels:
        """The frame with its title and legend alone."""
        look, layout, unit = self._look, self.layout, self.layout.unit
        canvas = Plate(look.width_px, look.height_px, self._theme)
        head, size = layout.head, style.TITLE * unit
        title = elide(self._course.run.scenario.title_in(look.language), size, head.right - head.left)
        canvas.text((head.left, 0.42 * (head.top + head.bottom)), title, size, Paint.INK)
        if layout.is_wide:
            box = layout.panel._replace(top=self._panel.foot)
            kerf_px = self._course.run.scenario.wire.kerf_um * self.whole.px_per_um
            wider = kerf_px < style.KERF_WIDTH_MIN * unit
            passes = max((among for _, among in self._course.passes), default=1)
            drawing, pieces = self._course.run.comparison is not None, bool(self._course.pieces)
            entries = film_entries(self._say, passes, wider=wider, drawing=drawing, pieces=pieces)
            if faces_of(self._course):
                entries += [Entry(stroke(paint, style.ACTUAL_WIDTH), self._say(name)) for name, paint in _FACES]
            draw_film_legend(canvas, box, unit, entries)
        return canvas.pixels()

    def _strip(self, *, done: bool) -> Pixels:
        """The rows of the strip, over the whole width of the frame."""
        strip = self.layout.strip
        own = Box(strip.left, 0.0, strip.right, strip.bottom - strip.top)
        canvas = Plate(self._look.width_px, round(own.bottom), self._theme)
        draw_strip(canvas, self._course, own, self.layout.unit, done=done)
        return canvas.pixels()

    def _draw_strip(self, frame: Pixels, t_s: float) -> None:
        """Put the strip together of what is done and what is to come, with the present between."""
        strip, unit = self.layout.strip, self.layout.unit
        bar, top = bar_of(strip, unit), round(strip.top)
        now = round(x_px(t_s, self._course, bar))
        frame[top:, :now] = self._done[:, :now]
        frame[top:, now:] = self._todo[:, now:]
        half, over = max(round(1.5 * unit), 1), round(6.0 * unit)
        frame[round(bar.top) - over : round(bar.bottom) + over, now - half : now + half] = self._theme[Paint.INK]

    def _mark(self, frame: Pixels, moment: Moment, view: View) -> None:
        """Mark the wire and the commanded place."""
        plot, unit = self.layout.plot, self.layout.unit
        wire, commanded = view.to_px(moment.wire_um), view.to_px(moment.commanded_um)
        radius = self._course.run.scenario.wire.radius_um * view.px_per_um
        box = _met(_around(np.stack([wire, commanded]), reach(radius, unit)), plot)
        if box is None:
            return
        left, top, right, bottom = (round(side) for side in box)
        canvas = plate_over(frame[top:bottom, left:right], self._theme)
        draw_wire(canvas, wire - (left, top), radius, unit)
        draw_commanded(canvas, commanded - (left, top), unit)
        frame[top:bottom, left:right] = canvas.pixels()


def _bounds_um(course: Course) -> Floats:
    """Box (2, 2) around all that the plot is to show."""
    scenario, half = course.run.scenario, course.run.scenario.wire.kerf_um / 2.0
    curves = (course.run.toolpath, *faces_of(course))
    box = box_of(np.concatenate([*map(bounds_um, curves), box_of(course.trace.wire_um)]))
    box = box + half * np.array([[-1.0], [1.0]])
    missing = max(LEAST_UM - float((box[1] - box[0]).max()), 0.0)
    box = box + np.array([[-missing / 2.0], [missing / 2.0]])
    return Bodies(scenario.work_um, [clamp.outline_um for clamp in scenario.clamps]).around(box)


def _around(places: Floats, reach: float) -> Box:
    """Box about places (n, 2), on whole pixels."""
    low, high = box_of(places)
    return Box(*np.floor(low - reach).tolist(), *np.ceil(high + reach).tolist())


def _met(box: Box, plot: Box) -> Box | None:
    """What two boxes share; None where that is nothing."""
    shared = Box(
        max(box.left, plot.left), max(box.top, plot.top), min(box.right, plot.right), min(box.bottom, plot.bottom)
    )
    return shared if shared.left < shared.right and shared.top < shared.bottom else None
