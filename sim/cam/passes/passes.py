"""The passes over a figure: where each of them begins, and which way it runs."""

import numpy as np

from controller.offset.sections import Side
from parser.geometry.curves import Curves, curves_between
from parser.toolpath import Point
from sim.cam.model import Figure, FigureCut, PassCut, Thread
from sim.cam.passes.beside import beside
from sim.cam.passes.turned import begun_at, run_back
from sim.setup.making import Making


def figure_cut(figure: Figure, thread: Thread, passes_um: tuple[float, ...], making: Making) -> FigureCut:
    """How a figure is cut; CannotCutError where the wire does not fit."""
    side = Side.LEFT
    is_ccw = (figure.kind == "hole") == (side is Side.LEFT)
    passes = []
    for number, by_um in enumerate(passes_um):
        is_back = making.returning == "back" and number % 2 == 1
        way = begun_at(beside(figure, by_um, making.corners), thread.entry.place_um)
        along = way if is_ccw != is_back else run_back(way)
        start = Point(*along.start_um[0].tolist())
        end = Point(*along.end_um[-1].tolist())
        passes.append(PassCut(by_um, is_back, _line(thread.place_um, start), along, _line(end, thread.place_um)))
    return FigureCut(figure, thread, side, is_ccw, tuple(passes))


def _line(start: Point, end: Point) -> Curves:
    """A line, none where it has no length."""
    rows = np.array([[start, end]], dtype=np.float64)
    rows = rows[np.hypot(*(rows[:, 1] - rows[:, 0]).T) > 1e-6]
    return curves_between(rows[:, 0], rows[:, 1], np.full((len(rows), 2), np.nan), np.zeros(len(rows)))
