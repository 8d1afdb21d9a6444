"""Offset paths of closed contours: curves moved aside, joined where they meet, or by an arc round an outer corner."""

import math

from drawings import Arc, Line, Place
from sound_cam import Move, drawn_sweep
from sound_shapes import Shape, heading, unit

_LONGEST_MITER = math.radians(100.0)


def offset(shape: Shape, by: float, round_corners: bool) -> Shape | None:
    """The path `by` µm to the right of a contour, to its outside; None where the contour has no such path."""
    starts = [shape.start, *(move.to for move in shape.moves)]
    n = len(shape.moves)
    arcs = [(start, move) for start, move in zip(starts, shape.moves, strict=False) if isinstance(move, Arc)]
    if any(math.dist(start, arc.center) + by * arc.turn < 2.0 for start, arc in arcs):
        return None
    joints: list[list[Place]] = []
    for k in range(n):
        before = starts[k - 1] if k else starts[n - 1]
        joint = _joint((before, starts[k]), (shape.moves[k - 1], shape.moves[k]), by, round_corners)
        if joint is None:
            return None
        joints.append(joint)
    moves: list[Move] = []
    for k, move in enumerate(shape.moves):
        leave, arrive = joints[k][-1], joints[(k + 1) % n][0]
        made = Line(arrive) if isinstance(move, Line) else move._replace(to=arrive)
        if not _same_way(starts[k], move, leave, made):
            return None
        moves.append(made)
        if len(joints[(k + 1) % n]) > 1:
            moves.append(Arc(joints[(k + 1) % n][1], starts[k + 1], 1 if by > 0 else -1))
    return shape._replace(start=joints[0][-1], moves=moves)


def _joint(starts: tuple[Place, Place], moves: tuple[Move, Move], by: float, round_corners: bool) -> list[Place] | None:
    """Where the offset of two moves meets: one place, or the ends of the arc round an outer corner."""
    (before, at), (one, other) = starts, moves
    u, v = heading(before, one, True), heading(at, other, False)
    turn = math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
    a, b = (at[0] + u[1] * by, at[1] - u[0] * by), (at[0] + v[1] * by, at[1] - v[0] * by)
    if abs(turn) < 1e-6:
        return [a]
    if turn * by > 0.0 and (round_corners or abs(turn) > _LONGEST_MITER):
        return [a, b]
    places = _meet((a, u, one), (b, v, other))
    return [min(places, key=lambda p: math.dist(p, at))] if places else None


def _meet(first: tuple[Place, Place, Move], second: tuple[Place, Place, Move]) -> list[Place]:
    """Where two curves meet, each through a place in a direction, of the kind of a move."""
    (a, u, one), (b, v, other) = first, second
    if isinstance(one, Line) and isinstance(other, Line):
        cross = u[0] * v[1] - u[1] * v[0]
        t = ((b[0] - a[0]) * v[1] - (b[1] - a[1]) * v[0]) / cross
        return [(a[0] + t * u[0], a[1] + t * u[1])]
    if isinstance(one, Line):
        return _line_meets(a, u, other.center, math.dist(b, other.center))
    if isinstance(other, Line):
        return _line_meets(b, v, one.center, math.dist(a, one.center))
    return _circles_meet(one.center, math.dist(a, one.center), other.center, math.dist(b, other.center))


def _line_meets(a: Place, u: Place, center: Place, radius: float) -> list[Place]:
    along = (center[0] - a[0]) * u[0] + (center[1] - a[1]) * u[1]
    foot = a[0] + along * u[0], a[1] + along * u[1]
    square = radius**2 - math.dist(foot, center) ** 2
    return [(foot[0] + s * u[0], foot[1] + s * u[1]) for s in _roots(square)]


def _circles_meet(a: Place, p: float, b: Place, q: float) -> list[Place]:
    d = math.dist(a, b)
    if d < 1e-6:
        return []
    along = (d * d + p * p - q * q) / (2 * d)
    u = unit(a, b)
    foot = a[0] + along * u[0], a[1] + along * u[1]
    return [(foot[0] - s * u[1], foot[1] + s * u[0]) for s in _roots(p * p - along * along)]


def _roots(square: float) -> list[float]:
    return [] if square < 0.0 else [math.sqrt(square), -math.sqrt(square)]


def _same_way(start: Place, move: Move, leave: Place, made: Move) -> bool:
    """Whether a move still runs its way after the offset: it has not vanished between its neighbours."""
    if isinstance(move, Line) or isinstance(made, Line):
        u, by = unit(start, move.to), (made.to[0] - leave[0], made.to[1] - leave[1])
        return by[0] * u[0] + by[1] * u[1] > 2.0
    return abs(drawn_sweep(start, move) - drawn_sweep(leave, made)) < math.pi / 2
