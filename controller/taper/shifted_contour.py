"""A contour moved aside block by block, each block by a distance of its own, and none of them lost.

The two planes of a tilted wire are matched block by block. So, other than in the compensation of an offset, no block
vanishes here: one that turns over stays, and is found by the share of its distance at which it comes to nothing.

Corners follow the rule of a Chinese control (EDM_NC, g5152.cpp, 2014): offset lines are extended to where they meet;
beyond a turn of 145° an arc goes round the corner. With constant taper an arc goes round each outer corner.
"""

from typing import Final, Literal, NamedTuple

import numpy as np

from parser.geometry.along import directions, to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between

Corner = Literal["sharp", "cone"]
"""``sharp``: both planes keep the corner. ``cone``: an arc goes round it in the outer plane."""

SHARPEST_RAD: Final = np.radians(145.0)
SMOOTH_RAD: Final = 1e-3
"""Blocks that turn less are tangent: whole µm make as much of it between blocks of some mm."""
_BACK_RAD: Final = np.pi - 1e-6
_ROUNDS, _MET_UM = 40, 1e-7
_FARTHEST: Final = 50.0
"""Blocks that meet farther from their corner than so many distances run side by side: no corner."""


class ShiftedContour(NamedTuple):
    """A contour of n rows moved aside.

    Attributes
    ----------
    curves
        (n,) the rows.
    bridge
        (n,) what leads from the end of each row to the start of the next one: an arc, a line, or no length at all.
    bridged
        (n,) whether there is such a thing.
    vanish
        (n,) the share of its distance at which a row comes to nothing; infinite where it never does.
    """

    curves: Curves
    bridge: Curves
    bridged: Bools
    vanish: Floats


class Joints(NamedTuple):
    """k pairs of rows that follow each other along a contour: the row before, and the row behind."""

    early: Ints
    late: Ints


def shifted_contour(path: Curves, left_um: Floats, joints: Joints, tilts: Bools, corner: Corner) -> ShiftedContour:
    """The rows moved to the left by distances (n,) µm, negative ones to the right.

    `joints` are joined as corners; rows with a distance end square to their own ends elsewhere. Rows that tilt (n,)
    run straight from where the row before ends to where the row behind begins.
    """
    normal_in, normal_out = (to_left(way) for way in directions(path))
    start = path.start_um + left_um[:, None] * normal_in
    end = path.end_um + left_um[:, None] * normal_out
    sweep = np.zeros(len(path))
    if len(joints.early):
        met, turn = _joined(path, left_um, joints, corner)
        meets = ~np.isnan(met[:, 0])
        end[joints.early[meets]] = met[meets]
        start[joints.late[meets]] = met[meets]
        round_ = ~meets & (np.abs(turn) > SMOOTH_RAD)
        sweep[joints.early[round_]] = turn[round_]
    follows = np.append(np.arange(1, len(path)), len(path) - 1)
    follows[joints.early] = joints.late
    _tilt(start, end, follows, tilts)
    curves, vanish = _between(path, left_um, start, end, tilts)
    gap = np.hypot(*(start[follows] - end).T)
    bridged = gap > _MET_UM
    bridged[-1:] &= bool(len(joints.early)) and len(path) - 1 in joints.early
    bridge = curves_between(end, np.where(bridged[:, None], start[follows], end), path.end_um, sweep * bridged)
    return ShiftedContour(curves, bridge, bridged, vanish)


def _joined(path: Curves, left_um: Floats, joints: Joints, corner: Corner) -> tuple[Floats, Floats]:
    """Where the rows of each joint meet (k, 2), NaN where they do not; and the turn (k,) at their corner."""
    early, late = joints
    arriving, leaving = directions(path).arriving[early], directions(path).leaving[late]
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    turn = np.arctan2(cross, (arriving * leaving).sum(axis=1))
    before, behind = left_um[early], left_um[late]
    place = 0.5 * (path.end_um[early] + path.start_um[late])
    met = np.full((len(early), 2), np.nan)
    smooth = (np.abs(turn) <= SMOOTH_RAD) & (np.abs(before - behind) <= _MET_UM)
    middle = place + 0.5 * before[:, None] * to_left(arriving + leaving)
    met[smooth] = middle[smooth]
    is_outer = (before + behind) * turn < 0.0
    goes_round = is_outer & ((np.abs(turn) > SHARPEST_RAD) | (corner == "cone"))
    meets = np.flatnonzero((np.abs(turn) > SMOOTH_RAD) & (np.abs(turn) < _BACK_RAD) & ~goes_round)
    met[meets] = _met(path, Joints(early[meets], late[meets]), left_um, place[meets])
    return met, turn


def _met(path: Curves, joints: Joints, left_um: Floats, corner_um: Floats) -> Floats:
    """Where offset rows (k,), prolonged, meet nearest their corner (k, 2), by Newton's method; NaN where they do not.

    A place lies on an offset row where its distance to the left of the row is the offset.
    """
    early, late = joints
    before_um, behind_um, place = left_um[early], left_um[late], corner_um.copy()
    for _ in range(_ROUNDS):
        off, across = _left_of(path, early, place)
        other, otherwise = _left_of(path, late, place)
        by, other_by = before_um - off, behind_um - other
        det = across[:, 0] * otherwise[:, 1] - across[:, 1] * otherwise[:, 0]
        det = np.where(np.abs(det) < 1e-12, np.nan, det)
        step = np.stack(
            [by * otherwise[:, 1] - other_by * across[:, 1], other_by * across[:, 0] - by * otherwise[:, 0]], axis=1
        )
        step /= det[:, None]
        place += step
        if not (np.abs(step) > 1e-10).any():
            break
    farthest = _FARTHEST * np.maximum(np.maximum(np.abs(before_um), np.abs(behind_um)), 1.0)
    lost = ~(np.hypot(*step.T) <= _MET_UM) | ~(np.hypot(*(place - corner_um).T) <= farthest)
    place[lost] = np.nan
    return place


def _left_of(path: Curves, row: Ints, place_um: Floats) -> tuple[Floats, Floats]:
    """How far (k,) places lie to the left of rows, prolonged, and in which direction (k, 2) that grows."""
    way = path.end_um[row] - path.start_um[row]
    length = np.hypot(*way.T)
    across = to_left(way / np.where(length > 0.0, length, 1.0)[:, None])
    off = ((place_um - path.start_um[row]) * across).sum(axis=1)
    arc = np.flatnonzero(path.is_arc[row])
    on = row[arc]
    out = place_um[arc] - path.center_um[on]
    far = np.hypot(*out.T)
    turn = np.sign(path.sweep_rad[on])
    off[arc] = turn * (path.radius_um[on] - far)
    across[arc] = -turn[:, None] * out / np.where(far > 0.0, far, 1.0)[:, None]
    return off, across


def _tilt(start: Floats, end: Floats, follows: Ints, tilts: Bools) -> None:
    """Let rows that tilt lead from the end of the row before, its corner included, to the start of the row behind."""
    rows = np.flatnonzero(tilts)
    before, behind = rows[rows > 0], rows[rows < len(tilts) - 1]
    closes = follows[before - 1] != before
    start[before] = np.where(closes[:, None], start[follows[before - 1]], end[before - 1])
    end[behind] = start[behind + 1]


def _between(path: Curves, left_um: Floats, start: Floats, end: Floats, tilts: Bools) -> tuple[Curves, Floats]:
    """Rows between new ends, and the share of their distances at which they come to nothing."""
    arc = path.is_arc & ~tilts
    turn = np.sign(path.sweep_rad)
    radius = path.radius_um - turn * left_um
    angles = [np.arctan2(*(place - path.center_um).T[::-1]) for place in (start, end)]
    flips = np.where(radius < 0.0, np.pi, 0.0)
    first, last = (
        _wrapped(angle + flips - own)
        for angle, own in zip(angles, (path.start_angle_rad, path.start_angle_rad + path.sweep_rad), strict=True)
    )
    sweep = np.where(arc, path.sweep_rad + last - first, 0.0)
    made = curves_between(start, end, path.center_um, np.nan_to_num(sweep))
    way, new_way = path.end_um - path.start_um, end - start
    length = np.hypot(*way.T)
    along = (new_way * way).sum(axis=1) / np.where(length > 0.0, length, 1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        by_line = np.where((along < 0.0) & (length > 0.0), length / (length - along), np.inf)
        by_radius = np.where(radius <= 0.0, np.abs(path.radius_um / left_um), np.inf)
        lost_sweep = np.where(sweep * turn < 0.0, np.abs(path.sweep_rad) / np.abs(path.sweep_rad - sweep), np.inf)
    vanish = np.where(arc, np.fmin(by_radius, lost_sweep), by_line)
    return made, np.where(tilts, np.inf, vanish)


def _wrapped(angle_rad: Floats) -> Floats:
    """Angles from −π to π."""
    wrapped: Floats = np.mod(angle_rad + np.pi, 2.0 * np.pi) - np.pi
    return wrapped
