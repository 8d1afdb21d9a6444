"""The way of single blocks through compensation, to be looked at: their ends moved aside, and how each is joined.

Compensation works in stages: where the contour ends, where the end lies moved aside, and how the block goes on from the
one before it (docs/iso.md §8). The whole path, in which blocks may also vanish, is that of `compensate`.
"""

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from controller.offset.joints import SHARPEST_RAD
from parser.controller_words import Compensation
from parser.geometry.along import directions, to_left
from parser.geometry.curves import Curves, Floats

_TANGENT_RAD = 1e-3
"""Blocks that turn less are tangent: whole µm make as much of it between blocks of some mm."""
_BACK_RAD = np.pi - 1e-6  # straight back the wire goes round the end


class JointKind(StrEnum):
    """How a block goes on from the one before it.

    NONE: neither has an offset. SET_UP and CANCEL: it leads from the contour to the offset path, or back. NORMAL: the
    first block behind the set-up begins on its own normal. SHORTENED: on the inner side of the corner both end where
    they meet. LENGTHENED and INSERTED: on the outer side, up to 90° and beyond.
    """

    NONE = "none"
    SET_UP = "set-up"
    NORMAL = "normal"
    TANGENT = "tangent"
    SHORTENED = "shortened"
    LENGTHENED = "lengthened"
    INSERTED = "inserted"
    CANCEL = "cancel"


class AsideEnds(NamedTuple):
    """Ends (n, 2) of blocks moved aside, each by itself, to the left (P′) and to the right (P″); NaN without offset."""

    left_um: Floats
    right_um: Floats


def aside_ends(curves: Curves, compensation: Compensation) -> AsideEnds:
    """Ends of n blocks moved aside by the offset in force, across the way in which each arrives."""
    aside = to_left(directions(curves).arriving) * np.abs(compensation.left_um)[:, None]
    aside[compensation.side == 0] = np.nan
    return AsideEnds(curves.end_um + aside, curves.end_um - aside)


def joint_kinds(curves: Curves, compensation: Compensation) -> tuple[JointKind, ...]:
    """How each of n blocks goes on from the one before it."""
    turn = _turns_rad(curves)
    size = np.abs(turn)
    known = np.where(np.isnan(compensation.left_um), compensation.side, compensation.left_um)
    is_inner = (turn * np.roll(known, 1) > 0.0) & (size < _BACK_RAD)
    sharpest = 0.0 if compensation.rules.outer == "arc" else SHARPEST_RAD
    sides = np.concatenate([[False, False], compensation.side != 0])
    earlier, before, here = sides[:-2], sides[1:-1], sides[2:]
    is_on_normal = ~earlier & (compensation.rules.startup == "next-normal")
    kinds = {
        JointKind.CANCEL: ~here & before,
        JointKind.NONE: ~here,
        JointKind.SET_UP: ~before,
        JointKind.NORMAL: is_on_normal,
        JointKind.TANGENT: size <= _TANGENT_RAD,
        JointKind.SHORTENED: is_inner,
        JointKind.LENGTHENED: size <= sharpest,
    }
    return tuple(map(JointKind, np.select(list(kinds.values()), list(kinds), JointKind.INSERTED).tolist()))


def _turns_rad(curves: Curves) -> Floats:
    """Angle (n,) by which the path turns before each of n blocks, positive to the left; before the first of no use."""
    ways = directions(curves)
    (x, y), (to_x, to_y) = np.roll(ways.arriving, 1, axis=0).T, ways.leaving.T
    turn: Floats = np.arctan2(x * to_y - y * to_x, x * to_x + y * to_y)
    return turn
