"""The way of the wire's centre beside a contour, all round it."""

import numpy as np

from controller.offset.reach import reach
from controller.offset.sections import Side
from parser.geometry.curves import Curves
from parser.toolpath import Point
from sim.cam.model import CannotCutError, Figure, Refusal
from sim.setup.making import Corners


def beside(figure: Figure, by_um: float, corners: Corners) -> Curves:
    """Closed way (m,) counter-clockwise at an offset from the contour of a figure, in the waste.

    CannotCutError where the wire does not fit in, or where what it reaches falls apart.
    """
    if by_um <= 0.0:
        return figure.contour
    loops = reach(figure.contour, by_um, Side.LEFT if figure.runs_inside else Side.RIGHT).loops
    if len(loops) != 1:
        places = tuple(Point(*loop.curves.start_um[0].tolist()) for loop in loops)
        why = "falls-apart" if loops else "too-small"
        raise CannotCutError(Refusal(why, places or (Point(*figure.contour.start_um[0].tolist()),)))
    curves = loops[0].curves
    return curves.picked(np.flatnonzero(curves.length_um > 0.0))
