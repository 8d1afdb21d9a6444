"""Joints of a contour: how likely they are with a block written otherwise."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.threeb.mend.likelihood import joint
from parser.threeb.mend.mends import moves_of, word_table
from parser.toolpath import Toolpath
from parser.words.moves import Moves


class Ring(NamedTuple):
    """A contour as it should close: from `end` back to the start of `begin`; `rows` (n,) may be at fault.

    `is_led` tells that it closes where a lead-out ends on a lead-in, which is no joint.
    """

    rows: Ints
    begin: int
    end: int
    gap_um: Floats
    points: int = 0
    is_led: bool = False


def joint_points(toolpath: Toolpath, ring: Ring, row: Ints, made: Moves) -> Ints:
    """(k,) points of the joints of a ring that the rows touch, if they moved so, and of the one that closes it."""
    before = np.where(row == ring.begin, ring.end, row - 1)
    after = np.where(row == ring.end, ring.begin, row + 1)
    was = moves_of(word_table(toolpath, np.concatenate([before, after, [ring.end, ring.begin]])))
    arriving, leaving = _directions(was, 1.0), _directions(was, 0.0)
    own_leaving, own_arriving = _directions(made, 0.0), _directions(made, 1.0)
    k = len(row)
    slack = 1.0 / np.maximum(was.length_um, 1.0)
    own = 1.0 / np.maximum(made.length_um, 1.0)
    entering = joint(arriving[:k], own_leaving, slack[:k] + own)
    exiting = joint(own_arriving, leaving[k:-2], slack[k:-2] + own)
    at_begin, at_end = row == ring.begin, row == ring.end
    if ring.is_led:
        return np.where(at_begin, 0, entering) + np.where(at_end, 0, exiting)
    closing = joint(arriving[-2:-1], leaving[-1:], slack[-2:-1] + slack[-1:])
    return entering + exiting + np.where(at_begin | at_end, 0, closing)


def _directions(made: Moves, fraction: float) -> Floats:
    """(n, 2) directions at a fraction of each block's length; (0, 0) where it has none."""
    angle = made.start_angle_rad + fraction * made.sweep_rad
    tangent = np.stack([-np.sin(angle), np.cos(angle)], axis=1) * np.sign(made.sweep_rad)[:, None]
    chord = made.by_um / np.where(made.length_um > 0.0, made.length_um, 1.0)[:, None]
    return np.where(np.isnan(made.radius_um)[:, None], chord, tangent)
