"""The polar plot of a circular test.

The panel beside the dial: what the lines are, and the test in figures.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from PIL import Image

from parser.findings.catalogue import Language
from parser.geometry.curves import Floats
from sim.run.ballbar.circle import Ballbar, Measured
from sim.run.ballbar.parts import Reversal
from sim.run.ballbar.turn import Sense
from sim.show.circular_test import Row, figure_rows, part_rows, setup_rows, um
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.dial import NOMINAL_WIDTH, Dial, draw_ring_values, draw_rings, ring_for
from sim.show.draw.furniture import draw_header
from sim.show.draw.legend import Entry, LegendSizes, dashes, draw_legend, in_columns, stroke
from sim.show.draw.paints import Paint
from sim.show.draw.raster import Raster
from sim.show.pictures.ballbar.dial import (
    COLOURS,
    CURVE_WIDTH,
    ZONE_WIDTH,
    draw_band,
    draw_curve,
    draw_zone_edge,
    mark_spike,
    write_reversals,
)
from sim.show.words.words import Words

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


CELLS: Final = 1440
CELL_RAD: Final = np.asarray((np.arange(CELLS) + 0.5) * (2.0 * np.pi / CELLS), dtype=np.float64)
"""Quarters of a degree, over which the drawn curves are means, as a ball bar's filter makes them."""
ASPECT: Final = 0.72
"""Height over width."""
CENTER: Final = (572.0, 638.0)
"""Middle of the dial."""


def draw_ballbar(ballbar: Ballbar, measured: Measured, language: Language = "en", width_px: int = 1600) -> Image.Image:
    """Draw both paths about their common least-squares centre, deviations magnified, with figures and parts.

    The same test gives the same pixels. ValueError where the picture would be narrower than 600 px.
    """
    if width_px < style.LEAST_WIDTH:
        raise ValueError(f"a picture is at least {style.LEAST_WIDTH} px wide, not {width_px}")
    unit, say = width_px / style.BASE_WIDTH, Words(language)
    curves = [_curve(ballbar, measured, row) for row in (0, 1)]
    lowest = min(float(curve.ends_um.min()) for curve in curves)
    highest = max(float(curve.ends_um.max()) for curve in curves)
    dial = Dial(unit, ring_for(max(-lowest, highest)), (CENTER[0] * unit, CENTER[1] * unit), unit)
    canvas = Raster(width_px, round(ASPECT * width_px))
    _write_head(canvas, ballbar, measured, unit, say)
    for curve in curves:
        draw_band(canvas, dial, curve.sense, CELL_RAD, curve.ends_um)
    draw_rings(canvas, dial)
    for edge in (lowest, highest):
        draw_zone_edge(canvas, dial, edge)
    for curve in curves:
        draw_curve(canvas, dial, curve.sense, CELL_RAD, curve.mean_um)
    draw_ring_values(canvas, dial)
    _write_middle(canvas, dial, measured)
    write_reversals(canvas, dial, measured.parts.reversals, say)
    for reversal in measured.parts.reversals:
        _mark(canvas, dial, reversal, curves[0 if reversal.sense == 1 else 1])
    magnified = f"{dial.magnification(ballbar.test.radius_um):,.0f}"
    _write_panel(FiguresPanel(canvas, unit, width_px), measured, magnified, say)
    return canvas.image()


class _Curve(NamedTuple):
    """Deviations of a path about the common centre, in `CELLS` cells: mean (CELLS,), lowest and highest (CELLS, 2)."""

    sense: Sense
    mean_um: Floats
    ends_um: Floats


def _curve(ballbar: Ballbar, measured: Measured, row: int) -> _Curve:
    turn, center = ballbar.turns[row], np.array(measured.figures.center_um)
    about = replace(turn, points_um=turn.points_um - center)
    origin = np.zeros(2)
    mean = about.radii_on_grid(origin).reshape(CELLS, -1).mean(axis=1) - ballbar.test.radius_um
    cell = np.minimum(about.angles_rad() * (CELLS / (2.0 * np.pi)), CELLS - 1).astype(np.int64)
    off = about.radii_um(origin) - ballbar.test.radius_um
    ends = np.stack([mean, mean], axis=1)
    np.minimum.at(ends[:, 0], cell, off)
    np.maximum.at(ends[:, 1], cell, off)
    return _Curve(turn.sense, mean, ends)


def _write_head(canvas: Canvas, ballbar: Ballbar, measured: Measured, unit: float, say: Words) -> None:
    machine, *rest = setup_rows(ballbar, say)
    radius, feed = rest[0], rest[1]
    note = f"{machine.value} · R {radius.value} · {feed.value} · G(b) {um(measured.figures.circularity_um)}"
    draw_header(canvas, unit, say("ballbar.title"), note)


def _write_middle(canvas: Canvas, dial: Dial, measured: Measured) -> None:
    x, y = dial.center.tolist()
    unit = dial.unit
    canvas.text((x, y - 30.0 * unit), "G(b)", style.NOTE * unit, Paint.GREY, align=0.5)
    value = um(measured.figures.circularity_um)
    canvas.text((x, y + 16.0 * unit), value, style.TITLE * unit, Paint.INK, align=0.5)


def _mark(canvas: Canvas, dial: Dial, reversal: Reversal, curve: _Curve) -> None:
    """Ring the top of a spike, where there is one."""
    if reversal.spike_deg is not None:
        cell = min(int(reversal.spike_deg * (CELLS / 360.0)), CELLS - 1)
        place = dial.to_px(CELL_RAD[cell], curve.mean_um[cell])
        mark_spike(canvas, place, reversal, dial.unit)


def _write_panel(panel: FiguresPanel, measured: Measured, magnified: str, say: Words) -> None:
    panel.legend(
        [
            say("ballbar.curve-ccw"),
            say("ballbar.curve-cw"),
            say("ballbar.nominal", magnified=magnified),
            say("ballbar.zone"),
        ]
    )
    panel.table(say("ballbar.figures"), figure_rows(measured.figures, say))
    panel.table(say("ballbar.parts"), part_rows(measured.parts, measured.interpolation_um, say))
