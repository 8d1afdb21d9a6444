"""Moves to toolpath: one row a move."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import fields

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Floats, Ints, curves_between
from parser.pmac.arcs import Arc
from parser.pmac.state import Move
from parser.text.source import Field, Source, Span
from parser.toolpath import Stop, Toolpath

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
