"""The dial of a polar plot: deviation from the nominal circle, magnified, in the direction where it lies."""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import box_around
from sim.show.draw.paints import Paint

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


class Dial(NamedTuple):
    """Scale of the dial.

    Attributes
    ----------
    unit
        Factor on the sizes of texts and lines.
    ring_um
        Deviation from one ring to the next.
    middle
        Place of its centre, px.
    size
        Factor on the sizes of this module, px.
    """

    unit: float
    ring_um: float
    middle: tuple[float, float]
    size: float

    @property
    def px_per_um(self) -> float:
        """Scale of deviations."""
        return RING * self.size / self.ring_um

    def magnification(self, radius_um: float) -> float:
        """How many times larger deviations are drawn than the circle."""
        return self.px_per_um / (NOMINAL * self.size / radius_um)

    def to_px(self, angle_rad: Floats, off_um: Floats) -> Floats:
        """Places (n, 2) px of deviations (n,) in directions (n,)."""
        return self.at(angle_rad, NOMINAL * self.size + off_um * self.px_per_um)

    def at(self, angle_rad: Floats, radius_px: Floats | float) -> Floats:
        """Places (n, 2) px at distances from the dial's centre."""
        unit = np.stack([np.cos(angle_rad), -np.sin(angle_rad)], axis=-1)
        return np.asarray(self.center + unit * np.asarray(radius_px)[..., None], dtype=np.float64)

    def ring_px(self, ring: int) -> float:
        """Radius of a ring, counted outward from the nominal circle."""
        return (NOMINAL + ring * RING) * self.size

    @property
    def center(self) -> Floats:
        """Centre (2,) px."""
        return np.array(self.middle)


def ring_for(most_um: float) -> float:
    """Deviation from ring to ring, µm, a round one, where deviations up to `most_um` have room."""
    wanted = max(most_um / RINGS, LEAST_RING_UM)
    power = 10.0 ** math.floor(math.log10(wanted))
    return next(size * power for size in RING_SIZES if size * power >= wanted * (1.0 - 1e-9))


def draw_rings(canvas: Canvas, dial: Dial) -> None:
    """Draw the nominal circle, rings, the two axes, and their halves."""
    unit = dial.unit
    for eighth in range(8):
        line = dial.at(np.full(2, eighth * np.pi / 4.0), np.array([NOMINAL - RINGS * RING, RIM]) * dial.size)
        canvas.polyline(line, Paint.GRID if eighth % 2 else Paint.FRAME, AXIS_WIDTH * unit)
    for ring in range(-RINGS, RINGS + 1):
        canvas.ring(dial.center, dial.ring_px(ring), Paint.FRAME, AXIS_WIDTH * unit)
    canvas.ring(dial.center, dial.ring_px(0), Paint.INK, NOMINAL_WIDTH * unit)


def draw_ring_values(canvas: Canvas, dial: Dial) -> None:
    """Write the deviation beside each ring, µm."""
    size = style.NUMBER * dial.unit
    for angle in VALUES_RAD:
        for ring in range(-RINGS, RINGS + 1):
            x, y = dial.at(np.array(angle), dial.ring_px(ring)).tolist()
            text = _value_text(ring, dial.ring_um)
            plate = box_around(np.array([x, y]), canvas.text_width(text, size) + 0.4 * size, 1.1 * size)
            canvas.box(plate, Paint.PAGE, Paint.PAGE, 0.0)
            canvas.text((x, y), text, size, Paint.GREY, align=0.5)


def _value_text(ring: int, ring_um: float) -> str:
    value = f"{ring * ring_um:+.6g}".replace("-", "−") if ring else "0"
    return f"{value} µm" if ring == RINGS else value
