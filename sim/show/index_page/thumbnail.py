"""A path as a picture the size of a thumbnail: data of an SVG path, some hundred bytes, drawn in the page's colours."""

from typing import Final

import numpy as np

from parser.geometry.curves import Curves, Floats
from sim.show.draw.flatten import bounds_um, cut_runs, flatten
from sim.show.draw.path_data import path_data
from sim.show.draw.simplify import simplify

WIDTH, HEIGHT = 96, 72
"""Of the box that the picture fills, whole units; y points down."""
_EDGE: Final = 3.0  # units left free on each side
_OFF: Final = 0.4  # units that a drawn line may leave the true one; it is rounded to half of a unit beside
_MOST: Final = 600  # corners; a path of more is drawn coarser


def thumbnail(toolpath: Curves) -> str:
    """The cuts of a path as SVG path data in a box of `WIDTH` by `HEIGHT`, jumps left out.

    Lines are at most 0.9 of a unit off, of which there are 90 from side to side; of more than `_MOST` corners each
    coarser drawing is off by twice as much.
    """
    low, high = bounds_um(toolpath)
    room = np.array([WIDTH, HEIGHT]) - 2.0 * _EDGE
    unit_um = max(float(((high - low) / room).max()), 1e-6)
    middle = (low + high) / 2.0
    points, row = flatten(toolpath, _OFF / 2.0 * unit_um)
    runs = cut_runs(points, row, toolpath.kind == 2)
    off = _OFF / 2.0
    while True:
        lines = [_in_box(simplify((run - middle) / unit_um, off)) for run in runs]
        if sum(map(len, lines)) <= _MOST or off > WIDTH:
            return "".join(map(path_data, lines[:_MOST]))
        off *= 2.0


def _in_box(points: Floats) -> Floats:
    """Points in units of the box."""
    return np.asarray(points * (1.0, -1.0) + (WIDTH / 2.0, HEIGHT / 2.0), dtype=np.float64)
