"""Edges: where along a path an axis passes a place, in closed form.

On a row of curvature κ, with u = κ s, one coordinate is ``c + A sin(u − δ)``: c that of the centre, A = R hypot(T, N)
and δ = atan2(N, T) from the row's tangent and normal on that axis. It rises through a place q where
u = δ + asin((q − c) / A), and turns from falling to rising at u = δ − π/2.
"""

import math

import numpy as np

from controller.motion.path import Path
from parser.geometry.curves import Floats

_TURN = 2.0 * math.pi
_LEVEL = 1e-9
"""Direction cosines below this are rounding: the axis stands."""
_JOINT_UM = 1e-6
"""A place on the joint of two rows is looked for this far behind the first: rounding may leave a gap."""


def rises_through(path: Path, axis: int, place: float, sense: int) -> float:
    """Path length at which axis (from 0) first passes the place upward (`sense` 1) or downward (−1); else inf.

    A path that starts at the place passes it where it comes back to it from below.
    """
    start, tangent, centre, reach, lead = _columns(path, axis, sense)
    bent = path.curvature > 0.0
    way = sense * place - start
    level = np.abs(tangent) <= _LEVEL
    on_line = np.divide(way, tangent, out=np.full_like(way, np.inf), where=~level)
    sine = np.divide(sense * place - centre, reach, out=np.full_like(way, 2.0), where=reach > 0.0)
    at = np.mod(lead + np.arcsin(np.clip(sine, -1.0, 1.0)), _TURN)
    on_arc = np.where(np.abs(sine) < 1.0, at, np.inf) / np.where(bent, path.curvature, 1.0)
    along = np.where(bent, on_arc, np.where(tangent > _LEVEL, on_line, np.inf))
    return _first(path, np.where(along > 0.0, along, np.inf))


def heads_beyond(path: Path, axis: int, place: float, sense: int) -> float:
    """Path length at which axis (from 0) first goes on in `sense` at or beyond the place; else inf."""
    start, tangent, centre, reach, lead = _columns(path, axis, sense)
    bent = path.curvature > 0.0
    limit = sense * place
    at_start = np.where((start >= limit) & (tangent > _LEVEL), 0.0, np.inf)
    turns = np.mod(lead - math.pi / 2.0, _TURN) / np.where(bent, path.curvature, 1.0)
    turning = np.where(bent & (reach > 0.0) & (centre - reach >= limit), turns, np.inf)
    return min(_first(path, np.minimum(at_start, turning)), rises_through(path, axis, place, sense))


def heads_short(path: Path, axis: int, place: float, sense: int) -> float:
    """Path length at which axis (from 0) first goes on in `sense` short of the place, which it may never reach."""
    start, tangent, centre, reach, lead = _columns(path, axis, sense)
    bent = path.curvature > 0.0
    limit = sense * place
    at_start = np.where((start < limit) & (tangent > _LEVEL), 0.0, np.inf)
    turns = np.mod(lead - math.pi / 2.0, _TURN) / np.where(bent, path.curvature, 1.0)
    turning = np.where(bent & (reach > 0.0) & (centre - reach < limit), turns, np.inf)
    return _first(path, np.minimum(at_start, turning))


def _columns(path: Path, axis: int, sense: int) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """Start, tangent, centre, reach A and lead δ (n,) of an axis, turned so that `sense` is upward."""
    start, tangent, normal = (sense * column[:, axis] for column in (path.start_um, path.tangent, path.normal))
    radius = np.divide(1.0, path.curvature, out=np.zeros(len(path)), where=path.curvature > 0.0)
    return start, tangent, start + radius * normal, radius * np.hypot(tangent, normal), np.arctan2(normal, tangent)


def _first(path: Path, along: Floats) -> float:
    """The first of the lengths (n,) along each row that lies on its row, from the start of the path; else inf."""
    on_row = np.flatnonzero(along <= path.length_um + _JOINT_UM)
    if not len(on_row):
        return math.inf
    row = on_row[0]
    return float(path.before_um[row] + min(along[row], path.length_um[row]))
