"""Arcs of moves, by a centre or by a radius; what no arc can be made of, and what the card cuts as a spiral."""

import math
from typing import NamedTuple

from parser.pmac.state import Move

SPIRAL_UM = 1.0
"""Radii at start and end that differ by more are a spiral that was not meant: whole µm would not explain it."""
_HAIR_UM = 1e-6


class Arc(NamedTuple):
    """Centre, µm, and signed sweep, rad, of a move that is an arc; 0 where it is none.

    `wrong` is why it is none, or what the card makes of it: ``center-at-end``, ``no-center``, ``radius-short``,
    ``radius-full``, ``radius-zero``, ``spiral``; empty for a sound arc. `start_um`, `end_um` are the radii as told.
    """

    center: tuple[float, float]
    sweep: float
    wrong: str = ""
    start_um: float = math.nan
    end_um: float = math.nan


def arc_of(move: Move) -> Arc:
    """The arc of a move with a motion of 2 or 3."""
    turn = 1.0 if move.motion == 3 else -1.0
    if move.center is not None:
        return _about(move.start, move.end, move.center, turn)
    if move.radius is None:
        return Arc(move.start, 0.0, "no-center")
    return _of_radius(move.start, move.end, move.radius, turn)


def _about(start: tuple[float, float], end: tuple[float, float], center: tuple[float, float], turn: float) -> Arc:
    """About a centre; it is moved to the bisector of start and end, that both lie on the circle."""
    at_start, at_end = math.dist(start, center), math.dist(end, center)
    if not at_start or not at_end:
        return Arc(center, 0.0, "center-at-end", at_start, at_end)
    wrong = "spiral" if abs(at_end - at_start) > SPIRAL_UM + _HAIR_UM else ""
    chord = math.dist(start, end)
    if not chord:
        return Arc(center, turn * 2.0 * math.pi, wrong, at_start, at_end)
    written = _sweep(start, end, center, turn)
    along = ((end[0] - start[0]) / chord, (end[1] - start[1]) / chord)
    middle = ((start[0] + end[0]) / 2.0 - center[0], (start[1] + end[1]) / 2.0 - center[1])
    aside = middle[0] * along[0] + middle[1] * along[1]
    moved = (center[0] + aside * along[0], center[1] + aside * along[1])
    sweep = _sweep(start, end, moved, turn)
    turns = abs(sweep - written) > math.pi
    if turns or (abs(written) > math.pi and abs(aside) > 2.0 * abs(at_end - at_start)):
        return Arc(center, written, wrong, at_start, at_end)
    return Arc(moved, sweep, wrong, at_start, at_end)


def _of_radius(start: tuple[float, float], end: tuple[float, float], radius: float, turn: float) -> Arc:
    """Of a radius: up to a half turn where it is positive, at least one where it is negative."""
    chord, size = math.dist(start, end), abs(radius)
    if not size or not chord:
        return Arc(start, 0.0, "radius-full" if size else "radius-zero", size, chord)
    if chord > 2.0 * size + SPIRAL_UM:
        return Arc(start, 0.0, "radius-short", size, chord)
    height = math.sqrt(max(size**2 - (chord / 2.0) ** 2, 0.0)) * turn * math.copysign(1.0, radius)
    normal = (-(end[1] - start[1]) / chord, (end[0] - start[0]) / chord)
    center = ((start[0] + end[0]) / 2.0 + height * normal[0], (start[1] + end[1]) / 2.0 + height * normal[1])
    minor = 2.0 * math.asin(min(chord / 2.0 / size, 1.0))
    return Arc(center, turn * (minor if radius > 0.0 else 2.0 * math.pi - minor), "", size, size)


def _sweep(start: tuple[float, float], end: tuple[float, float], center: tuple[float, float], turn: float) -> float:
    """Signed angle from start to end about a centre, more than 0 and up to a full turn."""
    out, back = (start[0] - center[0], start[1] - center[1]), (end[0] - center[0], end[1] - center[1])
    angle = math.atan2((out[0] * back[1] - out[1] * back[0]) * turn, out[0] * back[0] + out[1] * back[1])
    return turn * (angle if angle > 0.0 else angle + 2.0 * math.pi)
