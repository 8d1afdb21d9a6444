"""Toolpaths that tell of their own compensation, and what is said of the paths that controllers make of them."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from paths import Pen

from parser.controller_words import Compensation, CompensationRules
from parser.geometry.curves import CurveKind, Curves
from parser.toolpath import Toolpath

TEXTBOOK = CompensationRules()
LINUXCNC = CompensationRules(outer="arc", startup="own-normal", too_small="alarm", change_on="alarm")


class To(NamedTuple):
    """A move in mm to a place: a line, or an arc about a centre, counter-clockwise with turn +1."""

    x: float
    y: float
    cx: float = math.nan
    cy: float = math.nan
    turn: int = 0


def drawn_mm(start: tuple[float, float], moves: Sequence[To]) -> Pen:
    """The moves from a start; an arc that ends where it starts is a full circle."""
    pen = Pen(1000.0 * start[0], 1000.0 * start[1])
    for move in moves:
        x, y, cx, cy = (1000.0 * value for value in move[:4])
        if not move.turn:
            pen.to(x, y)
        elif math.dist((x, y), (pen.x, pen.y)) < 1e-6:
            pen.arc(cx, cy, move.turn * 2.0 * math.pi)
        else:
            pen.arc_to(x, y, cx, cy, move.turn)
    return pen


def told(
    path: Toolpath, side: int | Sequence[int], by_um: float | Sequence[float], rules: CompensationRules = TEXTBOOK
) -> Toolpath:
    """A toolpath with compensation: side and offset of all rows, or one for each."""
    n = len(path)
    sides = np.broadcast_to(np.asarray(side, dtype=np.int64), n).copy()
    by = np.broadcast_to(np.asarray(by_um, dtype=np.float64), n).copy()
    register = tuple("D1" if one else "" for one in sides.tolist())
    return replace(path, words=None, compensation=Compensation(sides, by, register, rules))


def moves_mm(curves: Curves) -> list[To]:
    """Each row as a move in mm, jumps as lines."""
    made = []
    for kind, end, center, sweep in zip(
        curves.kind.tolist(), curves.end_um.tolist(), curves.center_um.tolist(), curves.sweep_rad.tolist(), strict=True
    ):
        x, y, cx, cy = (0.001 * value for value in (*end, *center))
        made.append(To(x, y, cx, cy, round(math.copysign(1, sweep))) if kind == CurveKind.ARC else To(x, y))
    return made


def area_mm2(curves: Curves) -> float:
    """Area that a closed path goes round, positive counter-clockwise: its polygon, and the segments on its arcs."""
    (x, y), (u, v) = curves.start_um.T, curves.end_um.T
    sweep = curves.sweep_rad
    segments = np.where(curves.is_arc, 0.5 * np.nan_to_num(curves.radius_um) ** 2 * (sweep - np.sin(sweep)), 0.0)
    return float((0.5 * (x * v - u * y) + segments).sum()) * 1e-6
