"""Moves to toolpath: one row a move.

Arcs of moves, by a centre or by a radius; what no arc can be made of, and what the card cuts as a spiral.
"""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Floats, Ints, curves_between
from parser.pmac.state import Move
from parser.text.source import Field, Source, Span
from parser.toolpath import Stop, Toolpath

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


_NUMBER = r"[ \t]*[-+(]?[ \t]*[-+]?[\d.]+"
_FIELDS: Mapping[Field, re.Pattern[str]] = {
    Field.X: re.compile(f"X{_NUMBER}", re.IGNORECASE),
    Field.Y: re.compile(f"Y{_NUMBER}", re.IGNORECASE),
    Field.SENSE: re.compile(r"CIRCLE[12]|G[ \t]*0*[23](?![\d.])", re.IGNORECASE),
}


def path_of(text: str, moves: Sequence[Move], arcs: Mapping[int, Arc], stops: Sequence[Stop]) -> Toolpath:
    """Toolpath of moves; `arcs` are those of them that are such, by their rows. A move that no arc fits is a line."""
    curves = _curves(moves, arcs)
    centers = np.full((len(moves), 2), np.nan)
    for row, move in enumerate(moves):
        if move.center is not None:
            centers[row] = move.center
    spans = np.array([move.at.span for move in moves], dtype=np.int64).reshape(-1, 2)
    return Toolpath(
        **{field.name: getattr(curves, field.name) for field in fields(Curves)},
        printed_end_um=np.full((len(moves), 2), np.nan),
        words=None,
        source=Source(
            text,
            _blocks(moves),
            spans,
            np.array([move.at.line for move in moves], dtype=np.int64),
            tuple(move.label for move in moves),
            fields_of,
        ),
        stops=tuple(stops),
        told_center_um=centers,
    )


def fields_of(block: str) -> dict[Field, Span]:
    """Where the words of a line stand that say one of these."""
    found = {field: word.search(block) for field, word in _FIELDS.items()}
    return {field: match.span() for field, match in found.items() if match}


def _blocks(moves: Sequence[Move]) -> Ints:
    """(n,) numbers of the lines that move, from 1, in the order of the text: loops and calls run them many times."""
    return np.unique([move.at.span[0] for move in moves], return_inverse=True)[1].astype(np.int64) + 1


def _curves(moves: Sequence[Move], arcs: Mapping[int, Arc]) -> Curves:
    start = np.array([move.start for move in moves], dtype=np.float64).reshape(-1, 2)
    end = np.array([move.end for move in moves], dtype=np.float64).reshape(-1, 2)
    center, sweep = np.full(start.shape, np.nan), np.zeros(len(moves))
    for row, arc in arcs.items():
        center[row], sweep[row] = arc.center, arc.sweep
    curves = curves_between(start, end, center, sweep)
    curves.kind[[row for row, move in enumerate(moves) if move.motion == 0]] = CurveKind.JUMP
    _between_radii(curves, end)
    return curves


def _between_radii(curves: Curves, end: Floats) -> None:
    """Arcs whose centre stays where it is told have the mean of their radii at both ends."""
    arc = np.flatnonzero(curves.kind == CurveKind.ARC)
    back = end[arc] - curves.center_um[arc]
    curves.radius_um[arc] = (curves.radius_um[arc] + np.hypot(back[:, 0], back[:, 1])) / 2.0
    curves.length_um[arc] = curves.radius_um[arc] * np.abs(curves.sweep_rad[arc])
