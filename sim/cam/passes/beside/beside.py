"""The way of the wire's centre beside a contour, all round it."""

import numpy as np

from controller.offset.reach import OffsetLoop, reach
from controller.offset.sections import Side
from parser.geometry.curves import Curves
from parser.toolpath import Point
from sim.cam.model import CannotCutError, Figure, Refusal
from sim.cam.passes.beside.convex import beside_convex
from sim.cam.passes.beside.corners import with_corners
from sim.cam.passes.beside.narrow import mouths
from sim.cam.passes.beside.short import without_short
from sim.setup.making import Corners


def beside(figure: Figure, by_um: float, corners: Corners) -> Curves:
    """Closed way (m,) counter-clockwise at an offset from the contour of a figure, in the waste.

    It is the true offset, but for sharp outside corners, and for 0.3 µm where pieces too short for whole µm are mended.
    CannotCutError where the wire does not fit in, or where a slot or a neck is narrower than the wire.
    """
    contour = figure.contour
    if by_um <= 0.0:
        return contour
    loop = beside_convex(contour, by_um, figure.runs_inside)
    if loop is not None:
        return without_short(with_corners(loop, by_um, corners, None))
    return without_short(with_corners(_reached(figure, by_um), by_um, corners, contour))


def _reached(figure: Figure, by_um: float) -> OffsetLoop:
    """The one loop that the wire reaches. CannotCutError where there is none, or more, or it leaves out a slot."""
    side = Side.LEFT if figure.runs_inside else Side.RIGHT
    loops = reach(figure.contour, by_um, side).loops
    values = (("figure", str(figure.number)), ("offset_mm", _mm(by_um)), ("kerf_mm", _mm(2.0 * by_um)))
    if not loops:
        raise CannotCutError(Refusal("too-small", (Point(*figure.contour.start_um[0].tolist()),), values))
    narrow = sorted(mouths(figure.contour, loops, by_um, figure.runs_inside), key=lambda mouth: mouth.wide_um)
    places = tuple(mouth.place_um for mouth in narrow)
    if narrow:
        why = "narrow-neck" if len(loops) > 1 else "narrow-slot"
        raise CannotCutError(Refusal(why, places, (*values, ("width_mm", _mm(narrow[0].wide_um)))))
    if len(loops) > 1:
        starts = tuple(Point(*loop.curves.start_um[0].tolist()) for loop in loops)
        raise CannotCutError(Refusal("falls-apart", starts, values))
    (loop,) = loops
    kept = np.flatnonzero(loop.curves.length_um > 0.0)
    return OffsetLoop(loop.curves.picked(kept), loop.source_row[kept], loop.corner[kept])


def _mm(length_um: float) -> str:
    return f"{round(length_um, 1) / 1000.0:g}"
