"""Limits of motion: in each row, and at the junction of two rows, by the rule of the controller.

Limits of motion: what the machine, the feed and the path's form allow in each row and at each border of rows.

Junctions: how fast the border between two rows may be passed, by the rule of the controller.

The turn is the angle between the direction of leaving one row and of entering the next, 0 straight on, π back. Rows
without length have no direction: the rows around them meet, at the border behind the first of the two.

The path: lines and arcs as columns that tell place, direction and bend at any length along them.

Along a row of curvature κ ≥ 0, from its start with unit tangent T and unit normal N (toward the centre of the arc):
``p(s) = start + T sin(κs) / κ + N (1 − cos(κs)) / κ``, and ``start + T s`` where κ = 0 (Frenet, plane curve).
"""

import math
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from controller.motion.planner import RowLimits
from parser.geometry.curves import Curves, Floats, Ints, total_before
from parser.toolpath import Toolpath


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """n rows of a path in d axes, each from where the one before it ends, up to the rounding of their source.

    Attributes
    ----------
    start_um
        (n, d) float64.
    tangent, normal
        (n, d) float64, unit direction at the start, and unit direction from there to the centre; 0 on rows without
        length, and the normal on lines.
    curvature
        (n,) float64, 1 / radius, 1/µm; 0 on lines.
    length_um
        (n,) float64, ≥ 0.
    """

    start_um: Floats
    tangent: Floats
    normal: Floats
    curvature: Floats
    length_um: Floats

    def __len__(self) -> int:
        return len(self.length_um)

    @property
    def before_um(self) -> Floats:
        """(n + 1,) path length before each row and at the end."""
        return total_before(self.length_um)

    @property
    def leaving(self) -> Floats:
        """(n, d) unit direction at the end of each row."""
        leaving = self.tangent.copy()
        bends = np.flatnonzero(self.curvature)
        leaving[bends] = self.direction(bends, self.length_um[bends])
        return leaving

    def place(self, row: Ints, s_um: Floats) -> Floats:
        """Places (m, d) µm at lengths (m,) from the starts of rows (m,)."""
        bend = self.curvature[row]
        angle = bend * s_um
        radius = np.divide(1.0, bend, out=np.zeros_like(bend), where=bend > 0.0)
        forward = np.where(bend > 0.0, np.sin(angle) * radius, s_um)
        # 1 − cos, without loss for small angles
        aside = 2.0 * np.sin(angle / 2.0) ** 2 * radius
        return self.start_um[row] + self.tangent[row] * forward[:, None] + self.normal[row] * aside[:, None]

    def direction(self, row: Ints, s_um: Floats) -> Floats:
        """Unit tangents (m, d) at lengths (m,) from the starts of rows (m,)."""
        angle = (self.curvature[row] * s_um)[:, None]
        return self.tangent[row] * np.cos(angle) + self.normal[row] * np.sin(angle)

    def bend(self, row: Ints, s_um: Floats) -> Floats:
        """Curvature vectors (m, d), 1/µm, at lengths (m,) from the starts of rows (m,): toward the centre."""
        angle = (self.curvature[row] * s_um)[:, None]
        toward = self.normal[row] * np.cos(angle) - self.tangent[row] * np.sin(angle)
        return toward * self.curvature[row][:, None]

    def rest(self, s_um: float) -> "Path":
        """The path without the first `s_um` of its first row."""
        first, at = np.zeros(1, dtype=np.int64), np.array([s_um])
        bend = self.curvature[:1]
        tangent = self.direction(first, at)
        normal = np.where(bend[:, None] > 0.0, self.bend(first, at) / np.maximum(bend, 1e-300)[:, None], 0.0)
        return Path(
            start_um=np.concatenate([self.place(first, at), self.start_um[1:]]),
            tangent=np.concatenate([tangent, self.tangent[1:]]),
            normal=np.concatenate([normal, self.normal[1:]]),
            curvature=self.curvature,
            length_um=np.concatenate([np.maximum(self.length_um[:1] - s_um, 0.0), self.length_um[1:]]),
        )


def path_of(toolpath: Curves) -> Path:
    """Path of a toolpath, or of other curves, in X and Y, program coordinates."""
    length = toolpath.length_um
    arc = np.abs(toolpath.sweep_rad) > 0.0
    radius = np.where(arc, toolpath.radius_um, 1.0)
    moves = (length > 0.0)[:, None]
    angle = np.where(arc, toolpath.start_angle_rad, 0.0)
    outward = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    turned = np.stack([-outward[:, 1], outward[:, 0]], axis=1) * np.sign(toolpath.sweep_rad)[:, None]
    straight = (toolpath.end_um - toolpath.start_um) / np.where(length > 0.0, length, 1.0)[:, None]
    return Path(
        start_um=toolpath.start_um,
        tangent=np.where(arc[:, None], turned, straight) * moves,
        normal=np.where(arc[:, None], -outward, 0.0) * moves,
        curvature=np.where(arc & (length > 0.0), 1.0 / radius, 0.0),
        length_um=length,
    )


STRAIGHT_RAD = 1e-12
"""A turn of less is rounding: a line cut in two turns by some 10⁻¹⁶, by more the longer the way from the origin."""


class Through(NamedTuple):
    """Full speed through every junction."""


class SlowAt(NamedTuple):
    """No more than a speed at corners."""

    speed_um_s: float


class StopEach(NamedTuple):
    """Every block ends at rest."""


class JunctionDeviation(NamedTuple):
    """As fast as a circle that touches both directions and leaves the corner by `deviation_um` could be run.

    ``v² = a δ sin(θ/2) / (1 − sin(θ/2))`` with θ between the two rows, π − turn (S. Jeon, "Improving Grbl: Cornering
    Algorithm", 2011; grbl, planner.c).
    """

    deviation_um: float


class CornerTime(NamedTuple):
    """As fast as an acceleration can turn the velocity within a time: ``2 v sin(turn/2) ≤ A T``."""

    time_s: float
    acceleration_um_s2: float


Junction: TypeAlias = Through | SlowAt | StopEach | JunctionDeviation | CornerTime


def junction_speeds(path: Path, rule: Junction, corner_angle_rad: float, acceleration_um_s2: Floats) -> Floats:
    """Highest speed (n − 1,) µm/s at each border inside a path of n rows; inf where nothing limits.

    A turn of more than `corner_angle_rad` is a corner, to the rules that know corners; `acceleration_um_s2` (n,) is
    that of each row, to the rule that takes it from there.
    """
    if isinstance(rule, Through):
        return np.full(max(len(path) - 1, 0), np.inf)
    turn = turns(path)
    match rule:
        case SlowAt(speed_um_s=speed):
            return np.where(turn > corner_angle_rad, speed, np.inf)
        case JunctionDeviation(deviation_um=deviation):
            return _deviation_speeds(turn, deviation, _at_meetings(path, acceleration_um_s2))
        case CornerTime(time_s=time, acceleration_um_s2=acceleration):
            return _over(acceleration * time, 2.0 * np.sin(turn / 2.0))
    # What remains is the rule to stop at each block, whatever the turn.
    return np.zeros_like(turn)


def turns(path: Path) -> Floats:
    """Turn (n − 1,) rad, 0 to π, at each border inside a path of n rows; 0 where it is no more than rounding."""
    before, after = _meetings(path)
    leaving, entering = path.leaving[before], path.tangent[after]
    turn = np.zeros(max(len(path) - 1, 0))
    # Exact for small angles and near π, where the arc cosine of the dot product is not (W. Kahan, 2006).
    turn[before] = 2.0 * np.arctan2(_norm(leaving - entering), _norm(leaving + entering))
    turn[turn < STRAIGHT_RAD] = 0.0
    return turn


def _deviation_speeds(turn: Floats, deviation_um: float, acceleration: Floats) -> Floats:
    # sin(θ/2) = cos(turn/2), and 1 − cos(turn/2) = 2 sin²(turn/4) without loss.
    radius = _over(deviation_um * np.cos(turn / 2.0), 2.0 * np.sin(turn / 4.0) ** 2)
    speeds: Floats = np.sqrt(acceleration * radius)
    return speeds


def _meetings(path: Path) -> tuple[Ints, Ints]:
    """Rows with length, each but the last, and the row with length after it."""
    moving = np.flatnonzero(path.length_um > 0.0)
    return moving[:-1], moving[1:]


def _at_meetings(path: Path, acceleration: Floats) -> Floats:
    """The less of the accelerations of the two rows that meet at each border; 1 where none do."""
    before, after = _meetings(path)
    least = np.ones(max(len(path) - 1, 0))
    least[before] = np.minimum(acceleration[before], acceleration[after])
    return least


def _over(dividend: float | Floats, divisor: Floats) -> Floats:
    return np.divide(dividend, divisor, out=np.full_like(divisor, np.inf), where=divisor > 0.0)


def _norm(vectors: Floats) -> Floats:
    norm: Floats = np.sqrt(np.sum(vectors * vectors, axis=1))
    return norm


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
    wait = corner_waits_s(path, limits)
    passed = junction_speeds(path, limits.junction, limits.corner_angle_rad, whole)
    border[1:-1] = np.maximum(passed, limits.start_speed_um_s)
    border[wait > 0.0] = limits.start_speed_um_s
    border[rests] = limits.start_speed_um_s
    return RowLimits(path.length_um, speed, _left_along(whole, speed**2 * path.curvature), border, wait)


def corner_waits_s(path: Path, limits: MotionLimits) -> Floats:
    """How long n rows are waited for at their borders (n + 1,) s: at corners, where there is a wait at all."""
    wait = np.zeros(len(path) + 1)
    if limits.corner_wait_s > 0.0:
        wait[np.flatnonzero(turns(path) > limits.corner_angle_rad) + 1] = limits.corner_wait_s
    return wait


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
