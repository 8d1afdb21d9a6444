"""The polar plot of a circular test.

The panel beside the dial: what the lines are, and the test in figures.

What lies on the dial of a circular test: the paths of both directions, the zone that holds them, the reversals.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from PIL import Image

from parser.findings.catalogue import Language
from parser.geometry.curves import Floats
from sim.run.ballbar.circle import Ballbar, Measured
from sim.run.ballbar.figures import NAMES, Reversal, Sense
from sim.show.ballbar_rows import Row, figure_rows, part_rows, setup_rows, um
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import NOMINAL_WIDTH, RIM, Dial, draw_ring_values, draw_rings, ring_for
from sim.show.draw.flatten import CHORD_PX, simplify
from sim.show.draw.legend import Entry, LegendSizes, dashes, draw_header, draw_legend, in_columns, stroke
from sim.show.draw.raster import Raster
from sim.show.draw.style import Paint
from sim.show.texts import Words

COLOURS: Final[dict[Sense, Paint]] = {1: Paint.CCW, -1: Paint.CW}
"""Blue and vermilion of Okabe and Ito; in grey the clockwise curve is told by its dashes."""
PALE: Final[dict[Sense, Paint]] = {1: Paint.CCW_PALE, -1: Paint.CW_PALE}
CURVE_WIDTH: Final = 3.2
BAND_WIDTH: Final = 1.8
DASH_RAD: Final = np.radians(3.5)
GAP_RAD: Final = np.radians(2.0)
SOLID_RAD: Final = (np.radians(-3.0), np.radians(8.0))
"""Around a reversal, in the sense of travel, no curve is dashed: no gap hides a step or a spike."""
ZONE_WIDTH: Final = 1.8
ZONE_DASHES: Final = 120
ARROW: Final = 30.0
ARROWS_RAD: Final = np.radians([135.0, 315.0])
ARROWS_APART_RAD: Final = np.radians(6.0)
LINE: Final = 27.0
GAP: Final = 14.0
SPIKE: Final = 8.0
SPIKE_WIDTH: Final = 2.5
ColouredLines = list[tuple[str, Paint]]


def draw_zone_edge(canvas: Canvas, dial: Dial, off_um: float) -> None:
    """Draw one of the two circles that hold both paths, in dashes."""
    for start in (np.arange(ZONE_DASHES) * (2.0 * np.pi / ZONE_DASHES)).tolist():
        angle = start + np.linspace(0.0, np.pi / ZONE_DASHES, 5)
        canvas.polyline(dial.to_px(angle, np.full(5, off_um)), Paint.END, ZONE_WIDTH * dial.unit)


def draw_band(canvas: Canvas, dial: Dial, sense: Sense, angle_rad: Floats, ends_um: Floats) -> None:
    """Fill the band between two deviations (n, 2) in directions (n,), close together, by a zigzag."""
    zigzag = dial.to_px(np.repeat(angle_rad, 2), ends_um.ravel())
    canvas.polyline(zigzag, PALE[sense], BAND_WIDTH * dial.unit)


def draw_curve(canvas: Canvas, dial: Dial, sense: Sense, angle_rad: Floats, off_um: Floats) -> None:
    """Draw a path by its directions, rising from 0, and deviations, (n,) each, with two arrows.

    The clockwise one is dashed.
    """
    angle_rad = np.append(angle_rad, angle_rad[0] + 2.0 * np.pi)
    points = dial.to_px(angle_rad, np.append(off_um, off_um[0]))
    for run in [points] if sense == 1 else _dashes(points, angle_rad, sense):
        canvas.polyline(simplify(run, CHORD_PX), COLOURS[sense], CURVE_WIDTH * dial.unit)
    for at in (ARROWS_RAD + sense * ARROWS_APART_RAD).tolist():
        place = points[int(np.argmin(np.abs(angle_rad - at)))]
        ahead = sense * np.array([-np.sin(at), -np.cos(at)])
        size = ARROW * dial.unit
        canvas.arrow(place + ahead * size / 2.0, ahead, size, COLOURS[sense])


def _dashes(points: Floats, angle_rad: Floats, sense: Sense) -> list[Floats]:
    """Stretches of a curve between its gaps, which lie in fixed directions."""
    past = np.mod(sense * angle_rad - SOLID_RAD[0], np.pi / 2.0) + SOLID_RAD[0]
    inked = (np.mod(angle_rad, DASH_RAD + GAP_RAD) < DASH_RAD) | (past < SOLID_RAD[1])
    borders = np.flatnonzero(np.diff(inked)) + 1
    drawn = inked[np.concatenate([[0], borders])]
    return [run for run, is_drawn in zip(np.split(points, borders), drawn, strict=True) if is_drawn]


def write_reversals(canvas: Canvas, dial: Dial, reversals: tuple[Reversal, ...], say: Words) -> None:
    """Write at each end of the axes what the eight reversals do there."""
    for quarter in range(4):
        here = (reversals[quarter], reversals[4 + quarter])
        lines = _figure_lines(here, say) if quarter % 2 == 0 else _above(here, say)
        _write(canvas, dial, quarter, [(_name(here[0], say), Paint.INK), *lines])


def mark_spike(canvas: Canvas, place_px: Floats, reversal: Reversal, unit: float) -> None:
    """Ring the top of a spike."""
    canvas.ring(place_px, SPIKE * unit, COLOURS[reversal.sense], SPIKE_WIDTH * unit)


def _name(reversal: Reversal, say: Words) -> str:
    return say("ballbar.reverses", side=reversal.side.replace("-", "−"), axis=reversal.axis.name)


def _figure_lines(here: tuple[Reversal, ...], say: Words) -> ColouredLines:
    """Short lines, a figure each."""
    return [(text, COLOURS[reversal.sense]) for reversal in here for text in _texts(reversal, say)]


def _above(here: tuple[Reversal, ...], say: Words) -> ColouredLines:
    """A line for each direction."""
    return [(", ".join(_texts(reversal, say)), COLOURS[reversal.sense]) for reversal in here]


def _texts(reversal: Reversal, say: Words) -> list[str]:
    direction = say(f"ballbar.short-{NAMES[reversal.sense]}")
    step = say("ballbar.step", direction=direction, length=um(reversal.step_um))
    spike = say("ballbar.spike", length=um(reversal.spike_um))
    return [step] + [spike] * (reversal.spike_deg is not None)


def _write(canvas: Canvas, dial: Dial, quarter: int, lines: ColouredLines) -> None:
    """Write lines outward of the rim: beside it in the middle of their height, else above or below it."""
    unit = dial.unit
    x, y = dial.at(np.array(quarter * np.pi / 2.0), (RIM + GAP) * unit).tolist()
    share, align = ((0.5, 0.0), (1.0, 0.5), (0.5, 1.0), (0.0, 0.5))[quarter]
    top = y - share * (len(lines) - 1) * LINE * unit
    for row, (text, paint) in enumerate(lines):
        canvas.text((x, top + row * LINE * unit), text, style.NUMBER * unit, paint, align=align)


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
