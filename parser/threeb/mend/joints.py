"""Joints of a contour: how likely they are with a block written otherwise."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from parser.threeb.mend.likelihood import joint
from parser.threeb.mend.mends import moves_of, word_table
from parser.toolpath import Toolpath
from parser.words.moves import Moves


class Rings(NamedTuple):
    """Contours as they should close: (k,) or one of all: from row `end` back to the start of row `begin`.

    `is_led` tells that one closes where a lead-out ends on a lead-in, which is no joint.
    """

    begin: Ints | int
    end: Ints | int
    is_led: NDArray[np.bool_] | bool


def joint_points(toolpath: Toolpath, rings: Rings, row: Ints, made: Moves) -> Ints:
    """(k,) points of the joints of rings that the rows touch, if they moved so, and of the one that closes each."""
    k = len(row)
    begin, end = np.broadcast_to(rings.begin, k), np.broadcast_to(rings.end, k)
    at_begin, at_end = row == begin, row == end
    before, after = np.where(at_begin, end, row - 1), np.where(at_end, begin, row + 1)
    was = moves_of(word_table(toolpath, np.concatenate([before, after, end, begin])))
    arriving, leaving = _directions(was, 1.0), _directions(was, 0.0)
    own_leaving, own_arriving = _directions(made, 0.0), _directions(made, 1.0)
    slack = 1.0 / np.maximum(was.length_um, 1.0)
    own = 1.0 / np.maximum(made.length_um, 1.0)
    entering = joint(arriving[:k], own_leaving, slack[:k] + own)
    exiting = joint(own_arriving, leaving[k : 2 * k], slack[k : 2 * k] + own)
    closing = joint(arriving[2 * k : 3 * k], leaving[3 * k :], slack[2 * k : 3 * k] + slack[3 * k :])
    led = np.where(at_begin, 0, entering) + np.where(at_end, 0, exiting)
    return np.where(rings.is_led, led, entering + exiting + np.where(at_begin | at_end, 0, closing))


def _directions(made: Moves, fraction: float) -> Floats:
    """(n, 2) directions at a fraction of each block's length; (0, 0) where it has none."""
    angle = made.start_angle_rad + fraction * made.sweep_rad
    tangent = np.stack([-np.sin(angle), np.cos(angle)], axis=1) * np.sign(made.sweep_rad)[:, None]
    chord = made.by_um / np.where(made.length_um > 0.0, made.length_um, 1.0)[:, None]
    return np.where(np.isnan(made.radius_um)[:, None], chord, tangent)
