"""What the marks of a frame mean, below its read-outs."""

from typing import Final

import numpy as np

from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box
from sim.show.draw.legend import Entry, LegendSizes, draw_legend, in_columns, middle, stroke
from sim.show.draw.paints import Paint
from sim.show.film.marks import draw_commanded, draw_wire
from sim.show.words.pictures import Words

SIZES: Final = LegendSizes(row=38.0, sample=44.0, text=0.9 * style.TEXT)


def draw_film_legend(canvas: Canvas, box: Box, unit: float, entries: list[Entry]) -> None:
    """Write a legend at the foot of a box; nothing where it does not fit."""
    legend = in_columns(entries, 1, box.right - box.left, unit, SIZES)
    top = box.bottom - legend.height
    if top >= box.top:
        draw_legend(canvas, legend, box.left, top)


def film_entries(say: Words, *, wider: bool, pieces: bool) -> list[Entry]:
    """What a frame shows: the kerf, `wider` than it is where it would not show, and maybe `pieces` that come free."""
    return [
        Entry(_wire, say("film_wire")),
        Entry(_commanded, say("film_commanded")),
        Entry(stroke(Paint.KERF, 2.0 * style.KERF_WIDTH_MIN), say("film_kerf_wider" if wider else "film_kerf")),
        Entry(stroke(Paint.GREY, style.IDEAL_WIDTH), say("film_ideal")),
        *([Entry(_piece, say("film_free_piece"))] if pieces else []),
    ]


def _wire(canvas: Canvas, box: Box, unit: float) -> None:
    draw_wire(canvas, middle(box), 0.0, unit)


def _commanded(canvas: Canvas, box: Box, unit: float) -> None:
    draw_commanded(canvas, middle(box), 0.8 * unit)


def _piece(canvas: Canvas, box: Box, unit: float) -> None:
    half = 0.3 * SIZES.row * unit
    corners = middle(box) + half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    canvas.polygon(corners, Paint.SLUG)
    canvas.polyline(np.concatenate([corners, corners[:1]]), Paint.SLUG_EDGE, style.GRID_WIDTH * unit)
