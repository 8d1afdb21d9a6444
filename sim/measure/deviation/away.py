"""How far places lie from the ideal path, for millions of steps and samples: compiled.

`parser.geometry.distance` tells the same of lines and arcs by whole arrays, for rooms that load no compiled loops.
"""

import math
from typing import Final

import numpy as np

from controller.compiled.loops import compiled
from parser.geometry.curves import Curves, Floats

FROM_X: Final = 0
FROM_Y: Final = 1
TO_X: Final = 2
TO_Y: Final = 3
# Of lines; without length they have no direction, and any will do.
TANGENT_X: Final = 4
TANGENT_Y: Final = 5
LENGTH: Final = 6
# Of arcs; the sense is +1 counter-clockwise, −1 clockwise, and 0 on lines.
CENTER_X: Final = 4
CENTER_Y: Final = 5
RADIUS: Final = 6
START_ANGLE: Final = 7
SWEEP: Final = 8
SENSE: Final = 9


def blocks_of(curves: Curves) -> Floats:
    """The n curves as rows (n, 10) of µm and rad, for `away_from_block`."""
    arc = curves.is_arc
    by = curves.end_um - curves.start_um
    length = np.hypot(by[:, 0], by[:, 1])
    inverse = 1.0 / np.where(length > 0.0, length, 1.0)
    blocks = np.zeros((len(curves), 10))
    blocks[:, FROM_X : FROM_Y + 1], blocks[:, TO_X : TO_Y + 1] = curves.start_um, curves.end_um
    blocks[:, TANGENT_X] = np.where(length > 0.0, by[:, 0] * inverse, 1.0)
    blocks[:, TANGENT_Y], blocks[:, LENGTH] = by[:, 1] * inverse, length
    blocks[arc, CENTER_X : CENTER_Y + 1] = curves.center_um[arc]
    blocks[arc, RADIUS], blocks[arc, START_ANGLE] = curves.radius_um[arc], curves.start_angle_rad[arc]
    blocks[arc, SWEEP], blocks[arc, SENSE] = np.abs(curves.sweep_rad[arc]), np.sign(curves.sweep_rad[arc])
    return blocks


@compiled("Tuple((f8, i8))(f8[:, ::1], i8, f8, f8)")
def _away_from_line(lines: Floats, row: int, x: float, y: float) -> tuple[float, int]:
    """As `away_from_block`."""
    dx, dy = x - lines[row, FROM_X], y - lines[row, FROM_Y]
    along = dx * lines[row, TANGENT_X] + dy * lines[row, TANGENT_Y]
    across = dx * lines[row, TANGENT_Y] - dy * lines[row, TANGENT_X]
    if along < 0.0:
        return math.sqrt(across * across + along * along), -1
    past = along - lines[row, LENGTH]
    if past > 0.0:
        return math.sqrt(across * across + past * past), 1
    return abs(across), 0


@compiled("Tuple((f8, i8))(f8[:, ::1], i8, f8, f8)")
def _away_from_arc(arcs: Floats, row: int, x: float, y: float) -> tuple[float, int]:
    """As `away_from_block`. Outside of the sweep, the half of the open sector nearer the end is past it."""
    dx, dy, sweep = x - arcs[row, CENTER_X], y - arcs[row, CENTER_Y], arcs[row, SWEEP]
    turned = ((math.atan2(dy, dx) - arcs[row, START_ANGLE]) * arcs[row, SENSE]) % (2.0 * math.pi)
    if turned <= sweep:
        return abs(math.sqrt(dx * dx + dy * dy) - arcs[row, RADIUS]), 0
    if turned - sweep < 2.0 * math.pi - turned:
        dx, dy, beyond = x - arcs[row, TO_X], y - arcs[row, TO_Y], 1
    else:
        dx, dy, beyond = x - arcs[row, FROM_X], y - arcs[row, FROM_Y], -1
    return math.sqrt(dx * dx + dy * dy), beyond


@compiled("Tuple((f8, i8))(f8[:, ::1], i8, f8, f8)")
def away_from_block(blocks: Floats, row: int, x: float, y: float) -> tuple[float, int]:
    """Distance µm of a place from a block, its ends included, and −1, 0, +1: before, beside, past the block."""
    if blocks[row, SENSE] != 0.0:
        return _away_from_arc(blocks, row, x, y)
    return _away_from_line(blocks, row, x, y)


@compiled("f8(f8[:, ::1], i8, f8, f8)")
def away_from_path(blocks: Floats, row: int, x: float, y: float) -> float:
    """Distance µm of a place that belongs to a block; past an end the neighbour there counts where it is nearer."""
    away, beyond = away_from_block(blocks, row, x, y)
    neighbour = row + beyond
    if beyond != 0 and 0 <= neighbour < len(blocks):
        return min(away, away_from_block(blocks, neighbour, x, y)[0])
    return away


@compiled("f8(f8[:, ::1], i8, f8, f8)")
def side_of_block(blocks: Floats, row: int, x: float, y: float) -> float:
    """+1 left of a block in its direction and on it, −1 right of it."""
    if blocks[row, SENSE] != 0.0:
        dx, dy = x - blocks[row, CENTER_X], y - blocks[row, CENTER_Y]
        outside = math.sqrt(dx * dx + dy * dy) > blocks[row, RADIUS]
        return -1.0 if outside == (blocks[row, SENSE] > 0.0) else 1.0
    dx, dy = x - blocks[row, FROM_X], y - blocks[row, FROM_Y]
    by_x, by_y = blocks[row, TO_X] - blocks[row, FROM_X], blocks[row, TO_Y] - blocks[row, FROM_Y]
    return -1.0 if dx * by_y > dy * by_x else 1.0
