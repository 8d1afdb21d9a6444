"""What lies on the dial of a circular test: the paths of both directions, the zone that holds them, the reversals."""

from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from sim.run.ballbar.parts import Reversal
from sim.run.ballbar.turn import NAMES, Sense
from sim.show.circular_test import um
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.dial import RIM, Dial
from sim.show.draw.paints import Paint
from sim.show.draw.simplify import CHORD_PX, simplify
from sim.show.words.words import Words

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
        lines = _beside(here, say) if quarter % 2 == 0 else _above(here, say)
        _write(canvas, dial, quarter, [(_name(here[0], say), Paint.INK), *lines])


def mark_spike(canvas: Canvas, place_px: Floats, reversal: Reversal, unit: float) -> None:
    """Ring the top of a spike."""
    canvas.ring(place_px, SPIKE * unit, COLOURS[reversal.sense], SPIKE_WIDTH * unit)


def _name(reversal: Reversal, say: Words) -> str:
    return say("ballbar.reverses", side=reversal.side.replace("-", "−"), axis=reversal.axis.name)


def _beside(here: tuple[Reversal, ...], say: Words) -> ColouredLines:
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
