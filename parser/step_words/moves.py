"""Words to moves: what each block does from where it starts, exactly, the count length J deciding where it ends.

Arcs from 3B words: count length and counted axis give the end in closed form, any number of quadrants and turns.

The counted coordinate of a point that runs round a circle of radius R is a triangle wave of period 4R in the length
counted off. Adding J to its phase and folding back gives the end; no walk from quadrant to quadrant.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.controller_words.step_words import Axis, StepWords
from parser.geometry.curves import Floats, Ints


class ArcEnds(NamedTuple):
    """Arcs in their own centre's frame: (n,) and (n, 2) float64, µm and rad."""

    start_um: Floats
    end_um: Floats
    radius_um: Floats
    start_angle_rad: Floats
    sweep_rad: Floats


def arc_ends(start_um: Ints, count_um: Ints, count_axis: Ints, turn: Ints) -> ArcEnds:
    """Exact ends of n arcs.

    Parameters
    ----------
    start_um
        (n, 2) int64, start relative to the centre, signed, not (0, 0).
    count_um, count_axis, turn
        (n,) count length J, counted axis G (0 X, 1 Y), +1 counter-clockwise or −1 clockwise.

    Notes
    -----
    The radius is ``sqrt(X² + Y²)``, never rounded: with it the arc of the Qt paper ends where the paper prints it.
    """
    x, y = start_um[:, 0].astype(np.float64), start_um[:, 1].astype(np.float64)
    radius = np.sqrt((start_um.astype(np.int64) ** 2).sum(axis=1).astype(np.float64))
    on_x = count_axis == Axis.X
    # Turned and mirrored so that every arc runs counter-clockwise and counts along its cosine.
    mirror = turn.astype(np.float64)
    cosine, sine = np.where(on_x, x, y), np.where(on_x, y, -x) * mirror
    phase = _phase(cosine, sine, radius)
    turns, rest = np.divmod(phase + count_um, 4.0 * radius)
    rest = np.clip(rest, 0.0, 4.0 * radius)
    end_cosine, end_sine = _fold(rest, radius)
    sweep = _angle(end_cosine, end_sine) + 2.0 * np.pi * turns - _angle(cosine, sine)
    end_sine = end_sine * mirror
    end = np.stack([np.where(on_x, end_cosine, -end_sine), np.where(on_x, end_sine, end_cosine)], axis=1)
    return ArcEnds(np.stack([x, y], axis=1), end, radius, np.arctan2(y, x), sweep * mirror)


def _phase(cosine: Floats, sine: Floats, radius: Floats) -> Floats:
    """Length counted off since angle 0. ``R − x`` is taken as ``y² / (R + x)`` where the difference would cancel."""
    near = np.where(cosine > 0.0, sine**2 / (radius + np.abs(cosine)), radius - cosine)
    return np.where(sine >= 0.0, near, 4.0 * radius - near)


def _fold(rest: Floats, radius: Floats) -> tuple[Floats, Floats]:
    """Cosine and sine coordinate at a phase in [0, 4R]."""
    upper = rest <= 2.0 * radius
    cosine = np.where(upper, radius - rest, rest - 3.0 * radius)
    square = np.where(upper, rest * (2.0 * radius - rest), (4.0 * radius - rest) * (rest - 2.0 * radius))
    return cosine, np.where(upper, 1.0, -1.0) * np.sqrt(np.maximum(square, 0.0))


def _angle(cosine: Floats, sine: Floats) -> Floats:
    """Angle in [0, 2π)."""
    angle = np.arctan2(sine, cosine)
    return np.where(angle < 0.0, angle + 2.0 * np.pi, angle)


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
