"""Limits of motion: what the machine, the feed and the path's form allow in each row and at each border of rows."""

import math
from typing import NamedTuple

import numpy as np

from controller.motion.junctions import Junction, Path, Through, junction_speeds, path_of, turns
from controller.motion.planner import RowLimits
from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath

CENTRIPETAL_SHARE = math.sqrt(0.75)
"""Of the acceleration, what an arc may take to bend the path, so that half is left along it: 1² = ¾ + ½² (LinuxCNC,
src/emc/tp/blendmath.h, BLEND_ACC_RATIO_NORMAL and _TANGENTIAL)."""

BENT_FOR_NOTHING = 1e-9
"""Square of the share of the acceleration below which a bend costs nothing: the vector grows by half of this, and a
list is not cluttered with accelerations that differ in their tenth digit."""


class Feeds(NamedTuple):
    """How fast the path is run: µm/s for cuts, the same for all rows or (n,) one for each, and for jumps, above 0."""

    cut_um_s: float | Floats
    jump_um_s: float


class MotionLimits(NamedTuple):
    """What a machine and its controller keep to.

    Attributes
    ----------
    acceleration_um_s2
        Longest acceleration vector, above 0.
    axis_speed_um_s, axis_acceleration_um_s2
        Highest speed and acceleration of each axis of the path, above 0.
    start_speed_um_s
        What the table may start and stop with at once; no border need be passed more slowly.
    junction
        How fast the border between two rows may be passed.
    corner_angle_rad
        A turn of more than this is a corner. The default lets curves drawn in chords pass: within 1 µm of the curve,
        chords turn by less than 5° on radii above 1.05 mm.
    corner_wait_s
        Time to stand still at each corner.
    jerk_um_s3
        Highest jerk along the path, above 0.
    """

    acceleration_um_s2: float
    axis_speed_um_s: tuple[float, ...] = (math.inf, math.inf)
    axis_acceleration_um_s2: tuple[float, ...] = (math.inf, math.inf)
    start_speed_um_s: float = 0.0
    junction: Junction = Through()
    corner_angle_rad: float = math.radians(5.0)
    corner_wait_s: float = 0.0
    jerk_um_s3: float = math.inf


def row_limits(toolpath: Toolpath, feeds: Feeds, limits: MotionLimits) -> RowLimits:
    """Limits of a toolpath's rows; it rests at the ends of its runs."""
    feed = np.where(toolpath.is_jump, feeds.jump_um_s, feeds.cut_um_s)
    return path_limits(path_of(toolpath), feed, run_starts(toolpath), limits)


def path_limits(path: Path, feed_um_s: Floats, rests: Ints, limits: MotionLimits) -> RowLimits:
    """Limits of n rows run at feeds (n,), at rest before the rows `rests` and at both ends."""
    whole = _longest_accelerations(path, limits)
    speed = _speed_caps(path, feed_um_s, whole, limits)
    border = np.full(len(path) + 1, limits.start_speed_um_s)
    wait = np.zeros(len(path) + 1)
    passed = junction_speeds(path, limits.junction, limits.corner_angle_rad, whole)
    border[1:-1] = np.maximum(passed, limits.start_speed_um_s)
    if limits.corner_wait_s > 0.0:
        corners = np.flatnonzero(turns(path) > limits.corner_angle_rad) + 1
        border[corners], wait[corners] = limits.start_speed_um_s, limits.corner_wait_s
    border[rests] = limits.start_speed_um_s
    return RowLimits(path.length_um, speed, _left_along(whole, speed**2 * path.curvature), border, wait)


def run_starts(toolpath: Toolpath) -> Ints:
    """First rows of the path runs: after each pause, and where cutting turns to jumping or back; (r,) int64."""
    n = len(toolpath)
    switches = np.flatnonzero(np.diff(toolpath.is_jump)) + 1
    stops = [stop.after for stop in toolpath.stops]
    starts = np.unique(np.concatenate([[0], switches, np.array(stops, dtype=np.int64)]))
    return starts[starts < n]


def _longest_accelerations(path: Path, limits: MotionLimits) -> Floats:
    """Longest acceleration vector (n,) µm/s² in each row, whatever its direction in the row's line or plane."""
    # A unit vector in the plane of an arc has this at most in an axis; on a line, where the normal is 0, just this.
    along = np.full(len(path), limits.acceleration_um_s2)
    if min(limits.axis_acceleration_um_s2) == np.inf:
        return along
    return _least(along, limits.axis_acceleration_um_s2, np.hypot(path.tangent, path.normal))


def _speed_caps(path: Path, feed_um_s: Floats, acceleration: Floats, limits: MotionLimits) -> Floats:
    """Highest speed (n,) µm/s: of the feed, of each axis, and of the bend."""
    speed = feed_um_s.copy()
    if min(limits.axis_speed_um_s) < np.inf:
        speed = _least(speed, limits.axis_speed_um_s, _most_of_directions(path))
    bends = np.flatnonzero(path.curvature)
    bend_sq = CENTRIPETAL_SHARE * acceleration[bends] / path.curvature[bends]
    speed[bends] = np.minimum(speed[bends], np.sqrt(bend_sq))
    return speed


def _left_along(whole: Floats, bending: Floats) -> Floats:
    """Acceleration (n,) left along the path when the bend has its part; all, where it takes less than a billionth."""
    share_sq = (bending / whole) ** 2
    return whole * np.where(share_sq < BENT_FOR_NOTHING, 1.0, np.sqrt(np.maximum(1.0 - share_sq, 0.0)))


def _most_of_directions(path: Path) -> Floats:
    """Largest absolute component (n, d) of the direction in each axis, over each whole row."""
    most: Floats = np.maximum(np.abs(path.tangent), np.abs(path.leaving))
    bends = np.flatnonzero(path.curvature)
    tangent, normal = path.tangent[bends], path.normal[bends]
    # T cos φ + N sin φ is largest at φ = atan2(N, T), and every half turn from there.
    to_crest = np.mod(np.arctan2(normal, tangent), np.pi)
    crosses = to_crest < (path.curvature[bends] * path.length_um[bends])[:, None]
    most[bends] = np.where(crosses, np.hypot(tangent, normal), most[bends])
    return most


def _least(along: Floats, of_axes: tuple[float, ...], share: Floats) -> Floats:
    """The least of a limit along the path (n,) and those of axes, where the path has a share (n, d) in them."""
    axes = np.broadcast_to(of_axes, share.shape)
    in_path = np.divide(axes, share, out=np.full_like(share, np.inf), where=share > 0.0)
    least: Floats = np.minimum(along, in_path.min(axis=1, initial=np.inf))
    return least
