"""What moves on the plot: the wire where it is, and the place that the steps have asked for."""

from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.paints import Paint

THE_WIRE: Final = Paint.JUMP
"""The colour of the wire, which the page has too (`--wire` of replay.css)."""
WIRE: Final = 5.0
"""Least radius of the wire's mark, so that it can be seen."""
RING_MOST: Final = 130.0
"""The outline of a wire with a larger radius is not drawn."""
ARM: Final = (9.0, 19.0)
"""The arms of the cross begin and end so far from the commanded place: the wire's mark fits between them."""


def reach(radius: float, unit: float) -> float:
    """How far the marks reach from their places, px, about a wire of that radius, px."""
    ring = radius if radius <= RING_MOST * unit else 0.0
    return max(ring, ARM[1] * unit) + style.MARK_WIDTH * unit


def draw_wire(canvas: Canvas, center: Floats, radius: float, unit: float) -> None:
    """Mark the wire at a place (2,) px, with its true outline, `radius` px, where that shows."""
    canvas.disc(center, WIRE * unit, THE_WIRE)
    if WIRE * unit < radius <= RING_MOST * unit:
        canvas.ring(center, radius, THE_WIRE, style.JUMP_WIDTH * unit)


def draw_commanded(canvas: Canvas, center: Floats, unit: float) -> None:
    """Mark the commanded place (2,) px with a cross that is open in its middle."""
    for along in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
        arm = center + np.outer(ARM, along) * unit
        canvas.polyline(arm, Paint.INK, style.JUMP_WIDTH * unit)
