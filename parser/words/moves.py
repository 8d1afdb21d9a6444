"""Words to moves: what each block does from where it starts, exactly, the count length J deciding where it ends."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.told.step_words import Axis, StepWords
from parser.words.arcs import arc_ends

# (X, Y) of a line that leaves both out and so runs along the axis its digit names (`BBB40000GXL1`).
_AXIS_OF_LABEL = np.array([[0, 0], [1, 0], [0, 1], [1, 0], [0, 1]], dtype=np.int64)


class Moves(NamedTuple):
    """What each block does relative to its own start; (n,) or (n, 2) float64, µm and rad, NaN where a line has none."""

    by_um: Floats
    center_um: Floats
    radius_um: Floats
    start_angle_rad: Floats
    sweep_rad: Floats
    length_um: Floats


def moves(words: StepWords) -> Moves:
    """What each block does relative to its own start."""
    is_arc = (words.turn != 0) & ~words.is_endless
    n = len(is_arc)
    signs = words.signs
    by = np.where(words.is_endless[:, None], 0.0, _line_by(words) * signs)
    center = np.full((n, 2), np.nan)
    radius, angle, sweep = np.full(n, np.nan), np.full(n, np.nan), np.zeros(n)
    start = (np.stack([words.x_um, words.y_um], axis=1) * signs)[is_arc]
    arcs = arc_ends(start, words.count_um[is_arc], words.count_axis[is_arc], words.turn[is_arc])
    by[is_arc] = arcs.end_um - arcs.start_um
    center[is_arc] = -arcs.start_um
    radius[is_arc], angle[is_arc], sweep[is_arc] = arcs.radius_um, arcs.start_angle_rad, arcs.sweep_rad
    length = np.hypot(by[:, 0], by[:, 1])
    length[is_arc] = arcs.radius_um * np.abs(arcs.sweep_rad)
    return Moves(by, center, radius, angle, sweep, length)


def _line_by(words: StepWords) -> Floats:
    """(n, 2) absolute displacement of every row read as a line: J along the counted axis, the ratio X:Y across it."""
    on_x = words.count_axis == Axis.X
    counted = np.where(on_x, words.x_um, words.y_um)
    other = np.where(on_x, words.y_um, words.x_um)
    finite = counted > 0
    along = np.where(finite, words.count_um, 0).astype(np.float64)
    across = words.count_um * other / np.where(finite, counted, 1) * finite
    return np.stack([np.where(on_x, along, across), np.where(on_x, across, along)], axis=1)


def with_axes_named(words: StepWords) -> StepWords:
    """Words as the controller reads them: a line without X and Y gets the axis its digit names."""
    bare = (words.turn == 0) & (words.x_um == 0) & (words.y_um == 0)
    named = _AXIS_OF_LABEL[words.quadrant]
    return replace(words, x_um=np.where(bare, named[:, 0], words.x_um), y_um=np.where(bare, named[:, 1], words.y_um))
