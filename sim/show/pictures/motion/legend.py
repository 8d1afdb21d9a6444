"""The legend below the panels, in as many rows as it takes."""

from collections.abc import Callable
from functools import partial
from typing import Final, NamedTuple

import numpy as np

from parser.toolpath import Axis
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import Chart, Range
from sim.show.draw.layout import Box
from sim.show.draw.letters import Letters
from sim.show.draw.paints import Paint
from sim.show.pictures.motion.curves import draw_envelope
from sim.show.pictures.motion.events import Mark
from sim.show.words import Words
from sim.table.record.bins import Envelope

BETWEEN: Final = 40.0
"""From one entry to the next."""


class Entry(NamedTuple):
    """What draws a sample into a box, its text, and the widths of these, px."""

    draw: Callable[[Canvas, Box], None]
    text: str
    sample: float
    wide: float

    def width(self, unit: float) -> float:
        """Width of all of it."""
        return self.sample + style.LEGEND_GAP * unit + self.wide


def legend_rows(marks: list[Mark], stride: int, say: Words, width_px: int, unit: float) -> list[list[Entry]]:
    """Entries of a legend by the rows that they stand in on a page of a width."""
    letters = Letters()

    def entry(draw: Callable[[Canvas, Box], None], text: str, sign: str = "") -> Entry:
        sample = max(style.SAMPLE * unit, letters.width(sign, style.NUMBER * unit))
        return Entry(draw, text, sample, letters.width(text, style.TEXT * unit))

    number = say("motion.number") if stride == 1 else say("motion.number_every", stride=stride)
    entries = [
        *(entry(partial(_axis, axis, unit), say("motion.axis", axis=axis.name)) for axis in (Axis.X, Axis.Y)),
        entry(partial(_sign, "12", Paint.GREY, unit), number),
        *(entry(partial(_sign, sign, paint, unit), say(name), sign) for name, sign, paint in _kinds(marks)),
    ]
    return _rows(entries, width_px - 2.0 * style.EDGE * unit, unit)


def _kinds(marks: list[Mark]) -> list[tuple[str, str, Paint]]:
    """Kinds of marks by their names, each with the sign of the first."""
    first = {mark.name: mark for mark in reversed(marks)}
    return [(name, first[name].sign, first[name].paint) for name in sorted(first)]


def _rows(entries: list[Entry], room: float, unit: float) -> list[list[Entry]]:
    rows: list[list[Entry]] = [[]]
    left = 0.0
    for entry in entries:
        if rows[-1] and left + entry.width(unit) > room:
            rows.append([])
            left = 0.0
        rows[-1].append(entry)
        left += entry.width(unit) + BETWEEN * unit
    return rows


def draw_legend(canvas: Canvas, rows: list[list[Entry]], top: float, unit: float) -> None:
    """Draw the rows from `top` on."""
    half = 0.36 * style.LEGEND_ROW * unit
    for number, row in enumerate(rows):
        left, middle = style.EDGE * unit, top + (number + 0.5) * style.LEGEND_ROW * unit
        for entry in row:
            right = left + entry.sample
            entry.draw(canvas, Box(left, middle - half, right, middle + half))
            canvas.text((right + style.LEGEND_GAP * unit, middle), entry.text, style.TEXT * unit, Paint.INK)
            left += entry.width(unit) + BETWEEN * unit


def _axis(axis: Axis, unit: float, canvas: Canvas, box: Box) -> None:
    chart = Chart(box, Range(0.0, 1.0), Range(-1.0, 1.0), unit)
    ones = np.ones((1, 2))
    draw_envelope(canvas, chart, np.array([0.0, 1.0]), Envelope(-ones, ones, 0.0 * ones), [axis])


def _sign(text: str, paint: Paint, unit: float, canvas: Canvas, box: Box) -> None:
    middle = (box.left + box.right) / 2.0, (box.top + box.bottom) / 2.0
    canvas.text(middle, text, style.NUMBER * unit, paint, align=0.5)
