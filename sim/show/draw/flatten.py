"""Paths as points for pictures: arcs become chords, and of a trace fewer points that show the same line.

The toolpath as points: arcs become chords, all of them at once in numpy.

Fewer points for the same line: a trace has one for each pulse, a picture only so many pixels.
"""

from dataclasses import replace
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

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


CHORD_PX: Final = 0.15
"""How far a drawn line may leave the true one."""


def simplify(points: Floats, tolerance: float) -> Floats:
    """Leave out points that nobody could see.

    Stretches of 2, 4, 8 … chords become one wherever it stays close to their points, so the cost is n log n with no
    loop over points.

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
    points = _thin(points, tolerance * 2 / 3)
    place = np.ascontiguousarray(points).view(np.complex128)[:, 0]
    keep = np.ones(len(points), dtype=np.bool_)
    size = 2
    while size < len(points):
        flat = _distance(place, size).max(axis=0) <= tolerance / 3
        keep[: size * len(flat)].reshape(-1, size)[flat, 1:] = False
        size *= 2
    return points[keep]


def _thin(points: Floats, step: float) -> Floats:
    """Keep one point for each `step` of travel, and both ends."""
    travel = np.cumsum(np.hypot(*np.diff(points, axis=0).T))
    mark = np.floor(np.concatenate([[0.0], travel]) / step)
    keep = np.concatenate([[True], mark[1:] != mark[:-1]])
    keep[-1] = True
    return np.asarray(points[keep], dtype=np.float64)


def _distance(place: NDArray[np.complex128], size: int) -> Floats:
    """Distance (k, m) of the k inner places of each of m stretches of `size` chords from the chord of the stretch.

    Places are x + iy: a half as many calls as with two columns. What is left at the end makes no stretch.
    """
    whole = (len(place) - 1) // size * size
    first = place[:whole:size]
    chord = place[size : whole + 1 : size] - first
    inner = np.ascontiguousarray(place[:whole].reshape(-1, size)[:, 1:].T) - first
    square = np.maximum((chord * chord.conj()).real, np.finfo(np.float64).tiny)
    share = np.clip((inner * chord.conj()).real / square, 0.0, 1.0)
    return np.asarray(np.abs(inner - share * chord), dtype=np.float64)
