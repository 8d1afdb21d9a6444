"""One line and one arc of a path told in the whole µm about it: those that run nearest to what is drawn."""

import math
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.told.step_words import Axis
from parser.words.nearest.looked_at import LookedAt
from parser.words.one_arc import OneBlock, Place, line_of, to_bisector, told_arc_of
from parser.words.telling import MOST_SHIFT

_HELD, _FREE_UM = 3.0, 0.2
"""How much more than the way there it counts that a place is missed which has to be met, beyond so much."""
_END, _SLIDE = 2.0, 0.2
"""The same of an end, aside of what it ends and what begins there; and along both, which moves neither aside."""
_UNLIKE = 0.1
"""By how much, from one attempt to the next, an arc may cost more that is taken for a change."""
_TURN = 0.6180339887  # multiples of the golden section are spread evenly


def _centers(reach: int) -> tuple[Floats, Floats]:
    """Steps (k, 2) to whole places about one, the nearest first, and what makes the nearer of two that are as good."""
    steps = np.arange(-reach, reach + 1)
    about = np.stack(np.meshgrid(steps, steps), axis=2).reshape(-1, 2)
    far = np.hypot(*about.T)
    order = np.argsort(far, kind="stable")
    return about[order].astype(np.float64), 1e-3 * far[order]


_NEAR, _WIDE = _centers(3), _centers(7)
"""Arcs that decide how near a path comes to where it was before have more to choose from."""


class Aim(NamedTuple):
    """Where a block is to end.

    `is_known`: at that very place, where the path was before. `pins`: axes on which it is to end whole µm from others.
    """

    end: Place
    is_known: bool
    pins: tuple[tuple[int, float], ...] = ()


def line_to(path: LookedAt, row: int, begin: Place, aim: Aim) -> OneBlock:
    """Words of a line: to the whole µm about its end that lie least aside of it, and of what follows."""
    x, y = aim.end[0] - begin[0], aim.end[1] - begin[1]
    if aim.is_known:
        return line_of((x, y))
    (ax, ay), (bx, by) = path.across[row], path.across_next[row]
    best, least = (x, y), math.inf
    for i in (math.floor(x), math.ceil(x)):
        for j in (math.floor(y), math.ceil(y)):
            u, v = i - x, j - y
            cost = max(abs(ax * u + ay * v), abs(bx * u + by * v)) + _SLIDE * math.hypot(u, v)
            if cost < least:
                best, least = (float(i), float(j)), cost
    return line_of(best)


def arc_to(path: LookedAt, row: int, begin: Place, aim: Aim, attempt: int) -> tuple[OneBlock, float]:
    """Words of an arc, of those about whole places near the centre that it should have the nearest; and how far off.

    Candidates are arcs that begin at whole µm from their centres. Each is held against the drawn arc along eight ways
    out of its centre; its end lies where the count axis allows, and on the candidate.
    """
    at, end = path.at[row], aim.end
    (x, y), radius, sweep = path.center[at], path.radius[at], path.sweep[at]
    out, by = (begin[0] - x, begin[1] - y), (end[0] - begin[0], end[1] - begin[1])
    shift = to_bisector(out, (out[0] + by[0], out[1] + by[1]), by, sweep)
    if math.hypot(*shift) > MOST_SHIFT * radius:
        return line_of(by), 0.0
    about, farther = _WIDE if aim.is_known or aim.pins else _NEAR
    start = about + np.array([round(out[0] - shift[0]), round(out[1] - shift[1])])
    off = _off(start, out, path.ways[at], radius)
    miss = _miss(path, row, start, by, off[:, -1] + radius - math.hypot(end[0] - x, end[1] - y))
    aside = np.abs(off[:, :-1]).max(axis=1)
    cost = _unlike(farther, attempt) + np.maximum(aside, _cost_of_end(path, row, aim, miss))
    best = int(np.argmin(cost))
    by = by[0] + float(miss[best, 0]), by[1] + float(miss[best, 1])
    told = told_arc_of((float(start[best, 0]), float(start[best, 1])), by, sweep, Axis(path.counted[row]))
    return told, float(aside[best])


def _unlike(cost: Floats, attempt: int) -> Floats:
    """What candidates cost beside how near they are: another one of those that are nearly as near at each attempt."""
    return cost + _UNLIKE * attempt * (np.arange(len(cost)) * _TURN * attempt % 1.0) if attempt else cost


def _off(start: Floats, out: Place, ways: Floats, radius: float) -> Floats:
    """(k, 8) how far outside of the drawn arc candidates pass ways from its centre.

    On the way u the candidate about m lies at ρ u with |ρ u − m|² = |out − m|².
    """
    moved = np.array(out) - start
    along = moved @ ways.T
    square = out[0] * out[0] + out[1] * out[1] - 2.0 * (moved @ np.array(out))
    off: Floats = along + np.sqrt(np.maximum(along * along + square[:, None], 0.0)) - radius
    return off


def _miss(path: LookedAt, row: int, start: Floats, by: Place, beside: Floats) -> Floats:
    """(k, 2) by how much candidates miss their end, `by` from their start: across it they lie `beside` (k,) outside."""
    counted, free = path.counted[row], 1 - path.counted[row]
    across = path.across[row]
    miss = np.empty_like(start)
    miss[:, counted] = _from_whole(path.radii[row] * np.hypot(start[:, 0], start[:, 1]) - by[counted])
    miss[:, free] = (beside - across[counted] * miss[:, counted]) / across[free]
    return miss


def _cost_of_end(path: LookedAt, row: int, aim: Aim, miss: Floats) -> Floats:
    """(k,) what it costs that candidates miss their end by (k, 2)."""
    if aim.is_known:
        return _held(np.hypot(miss[:, 0], miss[:, 1]))
    aside = np.maximum(np.abs(miss @ path.across[row]), np.abs(miss @ path.across_next[row]))
    cost: Floats = _END * aside + _SLIDE * np.hypot(miss[:, 0], miss[:, 1])
    for axis, whole in aim.pins:
        cost = np.maximum(cost, _held(np.abs(_from_whole(aim.end[axis] - whole + miss[:, axis]))))
    return cost


def _held(far: Floats) -> Floats:
    return far + _HELD * np.maximum(far - _FREE_UM, 0.0)


def _from_whole(number: Floats) -> Floats:
    return number - np.rint(number)
