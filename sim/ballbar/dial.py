"""The dial of a polar plot: deviation from the nominal circle, magnified, in the direction where it lies."""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.ballbar.turn import Sense
from sim.draw import style
from sim.draw.canvas import Canvas
from sim.draw.layout import box_around
from sim.draw.simplify import simplify
from sim.draw.style import Colour

COLOURS: Final[dict[Sense, Colour]] = {1: (0, 104, 168), -1: (213, 94, 0)}
"""Blue and vermilion of Okabe and Ito; in grey the clockwise curve is told by its dashes."""
PALE: Final[dict[Sense, Colour]] = {1: (196, 221, 238), -1: (250, 218, 192)}
CURVE_WIDTH: Final = 3.2
BAND_WIDTH: Final = 1.8
DASH_RAD: Final = np.radians(3.5)
GAP_RAD: Final = np.radians(2.0)
SOLID_RAD: Final = (np.radians(-3.0), np.radians(8.0))
"""Around a reversal, in the sense of travel, no curve is dashed: no gap hides a step or a spike."""

CENTER: Final = (572.0, 638.0)
NOMINAL: Final = 240.0
RING: Final = 54.0
RINGS: Final = 2
"""Rings inside and outside of the nominal circle."""
RIM: Final = NOMINAL + (RINGS + 0.3) * RING
LEAST_RING_UM: Final = 0.1
RING_SIZES: Final = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
VALUES_RAD: Final = (np.radians(67.5), np.radians(247.5))
AXIS_WIDTH: Final = 1.2
NOMINAL_WIDTH: Final = 2.0
ZONE_WIDTH: Final = 1.8
ZONE_DASHES: Final = 120
ARROW: Final = 30.0
ARROWS_RAD: Final = np.radians([135.0, 315.0])
ARROWS_APART_RAD: Final = np.radians(6.0)
CHORD_PX: Final = 0.15


class Dial(NamedTuple):
    """Scale of the dial.

    Attributes
    ----------
    unit
        Factor on the sizes of this module and of `sim.draw.style`.
    ring_um
        Deviation from one ring to the next.
    """

    unit: float
    ring_um: float

    @property
    def px_per_um(self) -> float:
        """Scale of deviations."""
        return RING * self.unit / self.ring_um

    def magnification(self, radius_um: float) -> float:
        """How many times larger deviations are drawn than the circle."""
        return self.px_per_um / (NOMINAL * self.unit / radius_um)

    def to_px(self, angle_rad: Floats, off_um: Floats) -> Floats:
        """Places (n, 2) px of deviations (n,) in directions (n,)."""
        return self.at(angle_rad, NOMINAL * self.unit + off_um * self.px_per_um)

    def at(self, angle_rad: Floats, radius_px: Floats | float) -> Floats:
        """Places (n, 2) px at distances from the dial's centre."""
        unit = np.stack([np.cos(angle_rad), -np.sin(angle_rad)], axis=-1)
        return np.asarray(self.center + unit * np.asarray(radius_px)[..., None], dtype=np.float64)

    def ring_px(self, ring: int) -> float:
        """Radius of a ring, counted outward from the nominal circle."""
        return (NOMINAL + ring * RING) * self.unit

    @property
    def center(self) -> Floats:
        """Centre (2,) px."""
        return np.array(CENTER) * self.unit


def dial_for(most_um: float, unit: float) -> Dial:
    """Dial on which deviations up to `most_um` have room."""
    wanted = max(most_um / RINGS, LEAST_RING_UM)
    power = 10.0 ** math.floor(math.log10(wanted))
    return Dial(unit, next(size * power for size in RING_SIZES if size * power >= wanted * (1.0 - 1e-9)))


def draw_rings(canvas: Canvas, dial: Dial) -> None:
    """Draw the nominal circle, rings, the two axes, and their halves."""
    unit = dial.unit
    for eighth in range(8):
        line = dial.at(np.full(2, eighth * np.pi / 4.0), np.array([NOMINAL - RINGS * RING, RIM]) * unit)
        canvas.polyline(line, style.GRID if eighth % 2 else style.FRAME, AXIS_WIDTH * unit)
    for ring in range(-RINGS, RINGS + 1):
        canvas.ring(dial.center, dial.ring_px(ring), style.FRAME, AXIS_WIDTH * unit)
    canvas.ring(dial.center, dial.ring_px(0), style.INK, NOMINAL_WIDTH * unit)


def draw_ring_values(canvas: Canvas, dial: Dial) -> None:
    """Write the deviation beside each ring, µm."""
    size = style.NUMBER * dial.unit
    for angle in VALUES_RAD:
        for ring in range(-RINGS, RINGS + 1):
            x, y = dial.at(np.array(angle), dial.ring_px(ring)).tolist()
            text = _value_text(ring, dial.ring_um)
            plate = box_around(np.array([x, y]), canvas.text_width(text, size) + 0.4 * size, 1.1 * size)
            canvas.box(plate, style.WHITE, style.WHITE, 0.0)
            canvas.text((x, y), text, size, style.GREY, align=0.5)


def _value_text(ring: int, ring_um: float) -> str:
    value = f"{ring * ring_um:+.6g}".replace("-", "−") if ring else "0"
    return f"{value} µm" if ring == RINGS else value


def draw_zone_edge(canvas: Canvas, dial: Dial, off_um: float) -> None:
    """Draw one of the two circles that hold both paths, in dashes."""
    for start in (np.arange(ZONE_DASHES) * (2.0 * np.pi / ZONE_DASHES)).tolist():
        angle = start + np.linspace(0.0, np.pi / ZONE_DASHES, 5)
        canvas.polyline(dial.to_px(angle, np.full(5, off_um)), style.END, ZONE_WIDTH * dial.unit)


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
