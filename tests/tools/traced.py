"""Traces made straight from toolpaths, as of a table that follows them exactly or strays as it is told."""

import math
from collections.abc import Callable

import numpy as np
from paths import Pen

from parser.geometry.curves import Floats
from parser.shape.contours import Contour, find_contours
from parser.toolpath import Toolpath
from sim.cut.kerf.swept import Kerf, kerf_of
from sim.cut.pieces.pieces import Material, Pieces, pieces_of
from sim.setup.obstacles import Outline
from sim.table.trace import Trace

F = 100.0
"""Offset of the kerfs."""
STEEL = Material(thickness_mm=40.0, density_g_cm3=7.85)

Stray = Callable[[Floats, Floats], Floats]
"""Where the wire is (m, 2) instead of at ideal places (m, 2), in the rows (m,)."""


def exactly(place_um: Floats, row: Floats) -> Floats:
    return place_um


def trace_of(path: Toolpath, spacing_um: float = 5.0, stray: Stray = exactly) -> Trace:
    """Samples along all blocks, 1 ms apart, each block's last one at its end."""
    places, rows = [path.start_um[:1]], [np.zeros(1, dtype=np.int64)]
    for block in path:
        share = np.arange(1, max(math.ceil(block.length_um / spacing_um), 1) + 1) / max(
            math.ceil(block.length_um / spacing_um), 1
        )
        if block.center_um is None:
            place = np.array(block.start_um) + share[:, None] * np.subtract(block.end_um, block.start_um)
        else:
            angle = block.start_angle_rad + share * block.sweep_rad
            unit = np.stack([np.cos(angle), np.sin(angle)], axis=1)
            place = np.array(block.center_um) + block.radius_um * unit
        places.append(place)
        rows.append(np.full(len(place), block.number - 1))
    row = np.concatenate(rows)
    wire = stray(np.concatenate(places), row)
    return Trace(1e-3 * np.arange(len(row)), wire, wire, wire, row)


def contours_of(path: Toolpath) -> tuple[Contour, ...]:
    return find_contours(path, np.concatenate([path.start_um[:1], path.end_um]))


def kerf_along(path: Toolpath, trace: Trace | None = None, offset_um: float = F) -> Kerf:
    return kerf_of(path, trace or trace_of(path), contours_of(path), np.full(len(path), offset_um))


def pieces_along(path: Toolpath, work_um: Outline | None = None, stray: Stray = exactly) -> Pieces:
    return pieces_of(kerf_along(path, trace_of(path, stray=stray)), work_um, STEEL)


def square(pen: Pen, side: float) -> Pen:
    """A square to the upper right of where the pen stands, counter-clockwise."""
    x, y = pen.x, pen.y
    return pen.to(x + side, y).to(x + side, y + side).to(x, y + side).to(x, y)
