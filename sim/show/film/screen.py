"""A frame of a film or of the window: the plot at a moment, with read-outs beside it and the strip below."""

from typing import NamedTuple

import numpy as np
from PIL import Image

from parser.findings.catalogue import Language
from parser.geometry.curves import Floats
from sim.run.course import Course, Moment
from sim.show.draw import style
from sim.show.draw.flatten import bounds_um
from sim.show.draw.furniture import elide
from sim.show.draw.layout import Box, View, fitted
from sim.show.draw.paints import THEMES, Paint, ThemeName
from sim.show.film.ground import PieceDrawn, outlines_um
from sim.show.film.layout import layout_for
from sim.show.film.legend import draw_film_legend, film_entries
from sim.show.film.marks import draw_commanded, draw_wire, reach
from sim.show.film.panel import ReadoutPanel
from sim.show.film.plate import Pixels, Plate, plate_over
from sim.show.film.readout import read_out
from sim.show.film.scene import Scene, fate
from sim.show.film.strip import bar_of, draw_strip, x_px
from sim.show.pictures.cut.outlines import Bodies
from sim.show.words import Words

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

    def frame(self, t_s: float, view: View, speed: float, *, settled: bool = True) -> Pixels:
        """The frame of a moment, (h, w, 3); the array is the caller's.

        Past the end of the run, pieces go on to fall. `speed` is seconds of the run in each second of the film. While
        the view moves, not `settled`, the plot of the last view is shown enlarged or shifted.
        """
        if self._scene is None or (settled and self._scene.view != view):
            self._scene = Scene(self._course, self.layout, view, self._theme)
        moment = self._course.at(t_s)
        fates = (fate(piece.t_s, t_s, speed) for piece in self._course.pieces)
        plot = self._scene.at(moment, list(map(PieceDrawn, self._outlines_um, fates)))
        self._panel.show(read_out(self._course, moment, speed, self._say), self._page)
        frame = self._page.copy()
        frame[self._top : plot.shape[0], : plot.shape[1]] = plot[self._top :]
        if self._scene.view != view:
            self._move(frame, self._scene.view, view)
        self._mark(frame, moment, view)
        self._draw_strip(frame, moment.t_s)
        return frame

    def _furniture(self) -> Pixels:
        """The frame with its title and legend alone."""
        look, layout, unit = self._look, self.layout, self.layout.unit
        canvas = Plate(look.width_px, look.height_px, self._theme)
        head, size = layout.head, style.TITLE * unit
        title = elide(canvas, self._course.run.scenario.title, size, head.right - head.left)
        canvas.text((head.left, 0.42 * (head.top + head.bottom)), title, size, Paint.INK)
        if layout.beside:
            box = layout.panel._replace(top=self._panel.foot)
            kerf_px = self._course.run.scenario.wire.kerf_um * self.whole.px_per_um
            wider = kerf_px < style.KERF_WIDTH_MIN * unit
            passes = max((among for _, among in self._course.passes), default=1)
            entries = film_entries(self._say, passes, wider=wider, pieces=bool(self._course.pieces))
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

    def _move(self, frame: Pixels, was: View, now: View) -> None:
        """Show the plot of another view as it would lie in this one."""
        left, top, right, bottom = (round(side) for side in self.layout.plot)
        shown = Image.fromarray(frame[top:bottom, left:right])
        scale = was.px_per_um / now.px_per_um
        x, y = was.x_px - left - (now.x_px - left) * scale, was.y_px - top - (now.y_px - top) * scale
        matrix = (scale, 0.0, x, 0.0, scale, y)
        moved = shown.transform(shown.size, Image.Transform.AFFINE, matrix, fillcolor=self._theme[Paint.PAGE])
        frame[top:bottom, left:right] = np.asarray(moved)


def _bounds_um(course: Course) -> Floats:
    """Box (2, 2) around all that the plot is to show."""
    scenario, half = course.run.scenario, course.run.scenario.wire.kerf_um / 2.0
    wire = course.trace.wire_um
    box = bounds_um(course.run.toolpath)
    box = np.stack([np.minimum(box[0], wire.min(axis=0)) - half, np.maximum(box[1], wire.max(axis=0)) + half])
    missing = max(LEAST_UM - float((box[1] - box[0]).max()), 0.0)
    box = box + np.array([[-missing / 2.0], [missing / 2.0]])
    return Bodies(scenario.work_um, [clamp.outline_um for clamp in scenario.clamps]).around(box)


def _around(places: Floats, reach: float) -> Box:
    """Box about places (n, 2), on whole pixels."""
    low, high = np.floor(places.min(axis=0) - reach).tolist(), np.ceil(places.max(axis=0) + reach).tolist()
    return Box(*low, *high)


def _met(box: Box, plot: Box) -> Box | None:
    """What two boxes share; None where that is nothing."""
    shared = Box(
        max(box.left, plot.left), max(box.top, plot.top), min(box.right, plot.right), min(box.bottom, plot.bottom)
    )
    return shared if shared.left < shared.right and shared.top < shared.bottom else None
