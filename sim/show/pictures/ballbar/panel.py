"""The panel beside the dial: what the lines are, and the test in figures."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from sim.run.ballbar.rows import Row
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.dial import NOMINAL_WIDTH
from sim.show.draw.paints import Paint
from sim.show.pictures.ballbar.dial import COLOURS, CURVE_WIDTH, ZONE_WIDTH

LEFT: Final = 1145.0
TOP: Final = 160.0
ROW: Final = 35.0
TEXT: Final = 20.0
_SAMPLES: Final[tuple[tuple[Paint, float, float], ...]] = (
    (COLOURS[1], CURVE_WIDTH, 0.0),
    (COLOURS[-1], CURVE_WIDTH, 16.0),
    (Paint.INK, NOMINAL_WIDTH, 0.0),
    (Paint.END, ZONE_WIDTH, 8.0),
)
"""Paint, width and dash of counter-clockwise and clockwise curve, nominal circle and zone; a dash of 0 is a line."""


class Panel:
    """Rows from top to bottom, in a column from `LEFT` to the edge of the page."""

    def __init__(self, canvas: Canvas, unit: float, width_px: int) -> None:
        self._canvas = canvas
        self._unit = unit
        self._right = width_px - style.EDGE * unit
        self._y = TOP * unit

    def legend(self, names: Sequence[str]) -> None:
        """Samples of the two curves, the nominal circle and the zone, with their names."""
        left, unit = LEFT * self._unit, self._unit
        for (paint, width, dash), name in zip(_SAMPLES, names, strict=True):
            line = np.array([[left, self._y], [left + style.SAMPLE * unit, self._y]])
            self._stroke(line, paint, width * unit, dash * unit)
            self._text(left + (style.SAMPLE + style.LEGEND_GAP) * unit, name, Paint.INK)
            self._down()

    def table(self, title: str, rows: Sequence[Row]) -> None:
        """A title, a line below it, and rows with their values at the right edge."""
        left = LEFT * self._unit
        self._down(0.6)
        self._text(left, title, Paint.INK)
        self._down(0.55)
        self._stroke(np.array([[left, self._y], [self._right, self._y]]), Paint.FRAME, style.GRID_WIDTH, 0.0)
        self._down(0.6)
        for row in rows:
            self._text(left, row.name, Paint.GREY)
            self._text(self._right, row.value, Paint.INK, align=1.0)
            self._down()

    def _down(self, rows: float = 1.0) -> None:
        self._y += rows * ROW * self._unit

    def _text(self, x: float, text: str, paint: Paint, align: float = 0.0) -> None:
        self._canvas.text((x, self._y), text, TEXT * self._unit, paint, align=align)

    def _stroke(self, line: Floats, paint: Paint, width: float, dash: float) -> None:
        if dash:
            self._canvas.dashed(line, paint, width, dash, 0.6 * dash)
        else:
            self._canvas.polyline(line, paint, width)
