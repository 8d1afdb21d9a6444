"""Paths as points for pictures: arcs become chords, and of a trace fewer points that show the same line.

The toolpath as points: arcs become chords, all of them at once in numpy.

Fewer points for the same line: a trace has one for each pulse, a picture only so many pixels.
"""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Final

import numpy as np

from controller.compiled.loops import compiled, loop_part
from parser.geometry.along import headings, places
from parser.geometry.curves import Bools, Curves, Floats, Ints, box_of, extents


def bounds_um(toolpath: Curves) -> Floats:
    """Give the smallest box around all blocks, jumps included.

    Parameters
    ----------
    toolpath
        At least one block.

    Returns
    -------
    (2, 2) float64, µm: lowest and highest (x, y).
    """
    return box_of(np.concatenate(extents(toolpath)))


def flatten(toolpath: Curves, tolerance_um: float) -> tuple[Floats, Ints]:
    """Follow the toolpath by straight chords.

    Parameters
    ----------
    toolpath
        At least one block.
    tolerance_um
        The furthest a chord may leave its arc; above 0.

    Returns
    -------
    points_um
        (m, 2) float64, from the first block's start to the last one's end.
    row
        (m,) int64, the row that leads to each point; 0 for the first point.
    """
    toolpath = _unwound(toolpath)
    count = _chords(toolpath, tolerance_um)
    row = np.repeat(np.arange(len(toolpath)), count)
    step = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count) + 1
    points = along(toolpath, row, step / count[row])[0]
    last = np.cumsum(count) - 1
    points[last] = toolpath.end_um  # the program's own numbers, without the rounding of sin and cos
    return np.concatenate([toolpath.start_um[:1], points]), np.concatenate([row[:1], row])


def _unwound(toolpath: Curves) -> Curves:
    """Draw the same with no arc over two turns: a wrong count length can ask for millions of them."""
    size = np.abs(toolpath.sweep_rad)
    turns = np.maximum(np.floor(size / (2 * np.pi)) - 1, 0)
    return replace(toolpath, sweep_rad=np.sign(toolpath.sweep_rad) * (size - turns * 2 * np.pi))


def _chords(toolpath: Curves, tolerance_um: float) -> Ints:
    """Chords of each block, (n,): the sagitta r (1 − cos(φ/2)) of a chord of angle φ stays below the tolerance."""
    count = np.ones(len(toolpath), dtype=np.int64)
    arc = toolpath.is_arc
    ratio = np.minimum(tolerance_um / np.maximum(toolpath.radius_um[arc], tolerance_um), 1.0)
    count[arc] = np.maximum(np.ceil(np.abs(toolpath.sweep_rad[arc]) / (2 * np.arccos(1 - ratio))), 1)
    return count


def along(toolpath: Curves, row: Ints, fraction: Floats) -> tuple[Floats, Floats]:
    """Give places inside blocks and the direction of travel there.

    Parameters
    ----------
    toolpath
        Of n blocks.
    row
        (m,) int64, rows of the toolpath.
    fraction
        (m,) float64, 0 at the block's start, 1 at its end.

    Returns
    -------
    points_um
        (m, 2) float64.
    direction
        (m, 2) float64 of length 1; along +X in a block of no length.
    """
    heading = headings(toolpath, row, fraction)
    moves = np.hypot(heading[:, 0], heading[:, 1]) > 0.0
    return places(toolpath, row, fraction), np.where(moves[:, None], heading, (1.0, 0.0))


def cut_runs(points_um: Floats, row: Ints, is_jump: Bools) -> list[Floats]:
    """Split a path where the wire jumps.

    Parameters
    ----------
    points_um
        (m, 2) float64, a flattened toolpath or a trace.
    row
        (m,) int64, the row that leads to each point.
    is_jump
        (n,) bool, by row.

    Returns
    -------
    The stretches where the wire cuts, each (k, 2) with k ≥ 1, in order.
    """
    air = is_jump[row]
    change = np.flatnonzero(air[1:] != air[:-1]) + 1
    edges = [0, *change.tolist(), len(row)]
    # A stretch starts where the jump before it ends, which is the last point of that jump.
    return [points_um[max(a - 1, 0) : b] for a, b in pairwise(edges) if not air[a]]


_TINY: Final = float(np.finfo(np.float64).tiny)
CHORD_PX: Final = 0.15
"""How far a drawn line may leave the true one."""


def simplify(points: Floats, tolerance: float) -> Floats:
    """Leave out points that nobody could see.

    Stretches of 2, 4, 8 … chords become one wherever it stays close to their points, so the cost is n log n.

    Parameters
    ----------
    points
        (n, 2) float64, n ≥ 1.
    tolerance
        The furthest the new line may be from any point, same unit as `points`.

    Returns
    -------
    (k, 2) float64, 1 ≤ k ≤ n, with the first and the last point.
    """
    points = np.array(points, dtype=np.float64)  # a copy: a loop takes no column that is read-only or strided
    stays = np.empty(len(points), dtype=np.bool_)
    thinned = points[: _thin(points, tolerance * 2 / 3)]
    _straighten(thinned, tolerance / 3, stays)
    return thinned[stays[: len(thinned)]]


@compiled("i8(f8[:, ::1], f8)", is_core=True)
def _thin(points: Floats, step: float) -> int:
    """Move one point for each `step` of travel, and both ends, to the front; how many these are."""
    travel, mark, number = 0.0, 0.0, 1
    last_x, last_y = points[0, 0], points[0, 1]
    for at in range(1, len(points)):
        x, y = points[at, 0], points[at, 1]
        travel += math.hypot(x - last_x, y - last_y)
        last_x, last_y = x, y
        now = math.floor(travel / step)
        if now != mark or at == len(points) - 1:
            points[number, 0], points[number, 1] = x, y
            number += 1
        mark = now
    return number


@compiled("void(f8[:, ::1], f8, b1[::1])", is_core=True)
def _straighten(points: Floats, tolerance: float, stays: Bools) -> None:
    """Tell which of n points stay, where a line that leaves the others out comes as near to each as a tolerance."""
    stays[:] = True
    size = 2
    while size < len(points):
        for first in range(0, len(points) - size, size):
            if _is_straight(points, first, size, tolerance):
                stays[first + 1 : first + size] = False
        size *= 2


@loop_part("b1(f8[:, ::1], i8, i8, f8)", is_core=True)
def _is_straight(points: Floats, first: int, size: int, tolerance: float) -> bool:
    """Whether the inner points of a stretch of `size` chords lie as near to its chord as a tolerance."""
    x, y = points[first, 0], points[first, 1]
    by_x, by_y = points[first + size, 0] - x, points[first + size, 1] - y
    square = max(by_x * by_x + by_y * by_y, _TINY)
    for at in range(first + 1, first + size):
        inner_x, inner_y = points[at, 0] - x, points[at, 1] - y
        share = min(max((inner_x * by_x + inner_y * by_y) / square, 0.0), 1.0)
        if math.hypot(inner_x - share * by_x, inner_y - share * by_y) > tolerance:
            return False
    return True
