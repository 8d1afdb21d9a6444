"""What the marks of a frame mean, below its read-outs."""

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box
from sim.show.draw.paints import Paint
from sim.show.film.marks import draw_commanded, draw_wire
from sim.show.words import Words

ROW: Final = 38.0
SAMPLE: Final = 44.0


class _Entry(NamedTuple):
    """A sample drawn about a place, and its text."""

    draw: Callable[[Floats], None]
    text: str


class Shown(NamedTuple):
    """What a plot shows: whether the kerf is drawn wider than it is, and whether pieces come free."""

    wider: bool
    pieces: bool


def draw_legend(canvas: Canvas, box: Box, unit: float, say: Words, shown: Shown) -> None:
    """Write the legend at the foot of a box; nothing where it does not fit."""
    row, entries = ROW * unit, _entries(canvas, unit, say, shown)
    top = box.bottom - len(entries) * row
    if top < box.top:
        return
    for number, entry in enumerate(entries):
        y = top + (number + 0.5) * row
        entry.draw(np.array([box.left + SAMPLE * unit / 2, y]))
        at = (box.left + (SAMPLE + style.LEGEND_GAP) * unit, y)
        canvas.text(at, entry.text, 0.9 * style.TEXT * unit, Paint.INK)


def _entries(canvas: Canvas, unit: float, say: Words, shown: Shown) -> list[_Entry]:
    def across(paint: Paint, width: float) -> Callable[[Floats], None]:
        reach = np.array([[-SAMPLE / 2, 0.0], [SAMPLE / 2, 0.0]]) * unit
        return lambda center: canvas.polyline(center + reach, paint, width * unit)

    def piece(center: Floats) -> None:
        half = 0.3 * ROW * unit
        corners = center + half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
        canvas.polygon(corners, Paint.SLUG)
        canvas.polyline(np.concatenate([corners, corners[:1]]), Paint.SLUG_EDGE, style.GRID_WIDTH * unit)

    return [
        _Entry(lambda center: draw_wire(canvas, center, 0.0, unit), say("film.wire")),
        _Entry(lambda center: draw_commanded(canvas, center, 0.8 * unit), say("film.commanded")),
        _Entry(across(Paint.KERF, 2.0 * style.KERF_WIDTH_MIN), say("film.kerf_wider" if shown.wider else "film.kerf")),
        _Entry(across(Paint.GREY, style.IDEAL_WIDTH), say("film.ideal")),
        *([_Entry(piece, say("film.free_piece"))] if shown.pieces else []),
    ]
