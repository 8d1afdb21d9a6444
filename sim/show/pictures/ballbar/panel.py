"""The panel beside the dial: what the lines are, and the test in figures."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from sim.show.circular_test import Row
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.dial import NOMINAL_WIDTH
from sim.show.draw.legend import Entry, LegendSizes, dashes, draw_legend, in_columns, stroke
from sim.show.draw.paints import Paint
from sim.show.pictures.ballbar.dial import COLOURS, CURVE_WIDTH, ZONE_WIDTH

LEFT: Final = 1145.0
TOP: Final = 160.0
ROW: Final = 35.0
TEXT: Final = 20.0
SIZES: Final = LegendSizes(row=ROW, text=TEXT)
SAMPLES: Final = (
    stroke(COLOURS[1], CURVE_WIDTH),
    dashes(COLOURS[-1], CURVE_WIDTH, 16.0, 9.6),
    stroke(Paint.INK, NOMINAL_WIDTH),
    dashes(Paint.END, ZONE_WIDTH, 8.0, 4.8),
)
"""Counter-clockwise and clockwise curve, nominal circle and zone."""


class FiguresPanel:
    """Rows from top to bottom, in a column from `LEFT` to the edge of the page."""

    def __init__(self, canvas: Canvas, unit: float, width_px: int) -> None:
        self._canvas = canvas
        self._unit = unit
        self._right = width_px - style.EDGE * unit
        self._y = TOP * unit

    def legend(self, names: Sequence[str]) -> None:
        """Samples of the two curves, the nominal circle and the zone, with their names."""
        left, unit = LEFT * self._unit, self._unit
        entries = [Entry(sample, name) for sample, name in zip(SAMPLES, names, strict=True)]
        legend = in_columns(entries, 1, self._right - left, unit, SIZES)
        draw_legend(self._canvas, legend, left, self._y - ROW * unit / 2.0)
        self._down(legend.rows)

    def table(self, title: str, rows: Sequence[Row]) -> None:
        """A title, a line below it, and rows with their values at the right edge."""
        left = LEFT * self._unit
        self._down(0.6)
        self._text(left, title, Paint.INK)
        self._down(0.55)
        line = np.array([[left, self._y], [self._right, self._y]])
        self._canvas.polyline(line, Paint.FRAME, style.GRID_WIDTH)
        self._down(0.6)
        for row in rows:
            self._text(left, row.name, Paint.GREY)
            self._text(self._right, row.value, Paint.INK, align=1.0)
            self._down()

    def _down(self, rows: float = 1.0) -> None:
        self._y += rows * ROW * self._unit

    def _text(self, x: float, text: str, paint: Paint, align: float = 0.0) -> None:
        self._canvas.text((x, self._y), text, TEXT * self._unit, paint, align=align)
