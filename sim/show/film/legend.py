"""What the marks of a frame mean, below its read-outs."""

from typing import Final

import numpy as np

from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box
from sim.show.draw.legend import Entry, LegendSizes, across, draw_legend, in_columns, middle, stroke
from sim.show.draw.paints import Paint
from sim.show.draw.tones import TONES
from sim.show.film.marks import draw_commanded, draw_wire
from sim.show.words import Words

SIZES: Final = LegendSizes(row=38.0, sample=44.0, text=0.9 * style.TEXT)


def draw_film_legend(canvas: Canvas, box: Box, unit: float, entries: list[Entry]) -> None:
    """Write a legend at the foot of a box; nothing where it does not fit."""
    legend = in_columns(entries, 1, box.right - box.left, unit, SIZES)
    top = box.bottom - legend.height
    if top >= box.top:
        draw_legend(canvas, legend, box.left, top)


def film_entries(say: Words, passes: int, *, wider: bool, pieces: bool) -> list[Entry]:
    """What a frame shows: the kerf, `wider` than it is where it would not show, and maybe `pieces` that come free.

    `passes` is how many there are over one edge at most.
    """
    return [
        Entry(_wire, say("film.wire")),
        Entry(_commanded, say("film.commanded")),
        _kerf(say, passes, wider=wider),
        Entry(stroke(Paint.GREY, style.IDEAL_WIDTH), say("film.ideal")),
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
