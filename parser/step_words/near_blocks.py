"""One line and one arc of a path told in the whole µm about it: those that run nearest to what is drawn.

Where the steps of an arc end, beside where its words say that it ends.

A controller counts whole steps, point by point (docs/3b.md §3). On the count axis it goes from extreme to extreme of
whole µm; on the other axis it stands where its last counted step finds it. Both are told here for many arcs that end
in the same quadrant; `controller.stepping` walks any arc (tests hold the two together).
"""

import math
from typing import NamedTuple

import numpy as np

from parser.controller_words import Axis
from parser.geometry.curves import Floats
from parser.step_words.chained import OneBlock, Place, line_of, to_bisector, told_arc_of
from parser.step_words.looked_at import LookedAt
from parser.step_words.words import MOST_SHIFT


def steps_off_um(start: Floats, end: Floats, radii: int, turn: float, counted: int) -> Floats:
    """(k, 2) by how much the steps of arcs end beside their decoded ends, µm.

    Parameters
    ----------
    start, end
        (k, 2) whole µm from the centre, and where the words end, near enough on the axis that is not counted.
    radii
        By how many radii arcs go on their count axis, beside whole µm, as in `LookedAt`.
    turn, counted
        +1 counter-clockwise or −1 clockwise; count axis, 0 for X and 1 for Y.
    """
    square = (start * start).sum(axis=1)
    to, free = end[:, counted], 1 - counted
    extreme = np.ceil(np.sqrt(np.maximum(square - 1.0, 0.0)))
    stepped = np.rint(to + radii * (extreme - np.sqrt(square)))
    side = np.sign(end[:, free])
    # The last counted step is made where F asks for it: before it, away from the centre within the circle, toward it
    # on the circle or outside of it.
    before = stepped - (turn if counted else -turn) * side
    least = np.ceil(np.sqrt(np.maximum(square - before * before, 0.0)))
    off = np.empty_like(end)
    off[:, counted] = stepped - to
    off[:, free] = side * (least - (np.abs(stepped) > np.abs(before)) - np.sqrt(np.maximum(square - to * to, 0.0)))
    return off


_HELD, _FREE_UM = 3.0, 0.2
"""How much more than the way there it counts that a place is missed which has to be met, beyond so much."""
_END, _SLIDE = 2.0, 0.2
"""The same of an end, aside of what it ends and what begins there; and along both, which moves neither aside."""
_UNLIKE = 0.1
"""By how much, from one attempt to the next, an arc may cost more that is taken for a change."""
_TURN = 0.6180339887  # multiples of the golden section are spread evenly
_STEPPED, _FAR_UM = 0.5, 4.0
"""What it costs that steps end beside their words: so much by the square of µm, and beyond so many no more for each."""
_NEAR_UM, _SPARED_UM = 1.0, 0.2
"""No candidate is taken for its steps that lies farther off than this, or than the nearest one and so much more."""
_AT_END_UM = 0.25  # by which centres that lie beside each other move the end of an arc across, however short it is


class _Choice(NamedTuple):
    """What is tried for an arc, the likeliest first.

    Attributes
    ----------
    about
        (k, 2) steps to places about the whole place nearest to its centre.
    farther_um
        (k,) by how much farther it counts: what makes the likelier of two that are as good.
    counted_um
        (k,) by how much more it counts, so that it ends ahead or behind.
    """

    about: Floats
    farther_um: Floats
    counted_um: Floats


def _choice(reach: int, counted: int) -> _Choice:
    steps, more = np.arange(-reach, reach + 1), np.arange(-counted, counted + 1)
    x, y, more = (axis.reshape(-1) for axis in np.meshgrid(steps, steps, more))
    far = np.hypot(x, y) + np.abs(more)
    order = np.argsort(far, kind="stable")
    about = np.column_stack([x, y])[order].astype(np.float64)
    return _Choice(about, 1e-3 * far[order], more[order].astype(np.float64))


_FREE, _HELD_THERE = _choice(3, 1), _choice(7, 0)
"""Of an arc that ends anywhere, and of one that decides how near a path comes to where it was before."""


class Aim(NamedTuple):
    """Where a block is to end.

    `is_known`: at that very place, where the path was before. `pins`: axes on which it is to end whole µm from others.
    `stepped`: by how much the steps so far end beside where their words do. `center`: that of an arc that is run back.
    """

    end: Place
    is_known: bool
    pins: tuple[tuple[int, float], ...] = ()
    stepped: Place = (0.0, 0.0)
    center: Place | None = None


class Near(NamedTuple):
    """Words of a block, how far aside of the drawn one it lies, µm, and by how much the steps up to its end are off.

    `center`: of an arc, as it is told.
    """

    block: OneBlock
    aside_um: float
    stepped: Place
    center: Place | None = None


def line_to(path: LookedAt, row: int, begin: Place, aim: Aim, attempt: int) -> Near:
    """Words of a line: to the whole µm about its end that lie least aside of it, and of what follows.

    At each attempt others of them are tried: where the arcs behind it can end only 2 µm from each other, a line that
    ends 1 µm elsewhere is what lets them meet a place.
    """
    x, y = aim.end[0] - begin[0], aim.end[1] - begin[1]
    if aim.is_known:
        return Near(line_of((x, y)), 0.0, aim.stepped)
    (ax, ay), (bx, by) = path.across[row], path.across_next[row]
    best, least, tried = (x, y), math.inf, 4 * row
    for i in (math.floor(x), math.ceil(x)):
        for j in (math.floor(y), math.ceil(y)):
            u, v = i - x, j - y
            cost = max(abs(ax * u + ay * v), abs(bx * u + by * v)) + _SLIDE * math.hypot(u, v)
            tried += 1
            cost += _UNLIKE * attempt * (tried * _TURN * attempt % 1.0)
            if cost < least:
                best, least = (float(i), float(j)), cost
    return Near(line_of(best), 0.0, aim.stepped)


def arc_to(path: LookedAt, row: int, begin: Place, aim: Aim, attempt: int) -> Near:
    """Words of an arc, of those about whole places near the centre that it should have the nearest.

    Candidates are arcs that begin at whole µm from their centres. Each is held against the drawn arc along eight ways
    out of its centre; its end lies where the count axis allows, and on the candidate. Its steps end beside that: of
    candidates that lie about as near, one is taken whose steps make good what those before were off. An arc that is
    run back is told about the centre that it had ahead: another one would look like a fault.
    """
    at, end = path.at[row], aim.end
    (x, y), radius, sweep = path.center[at], path.radius[at], path.sweep[at]
    out, by = (begin[0] - x, begin[1] - y), (end[0] - begin[0], end[1] - begin[1])
    shift = to_bisector(out, (out[0] + by[0], out[1] + by[1]), by, sweep)
    if math.hypot(*shift) > MOST_SHIFT * radius:
        return Near(line_of(by), 0.0, aim.stepped)
    is_held = aim.is_known or bool(aim.pins)
    choice = _HELD_THERE if is_held else _FREE
    apart = 1.0 if is_held else max(1.0, round(_AT_END_UM / abs(sweep)))
    center_x, center_y = aim.center or (begin[0] - out[0] + shift[0], begin[1] - out[1] + shift[1])
    start = apart * choice.about + np.array([round(begin[0] - center_x), round(begin[1] - center_y)])
    off = _off(start, out, path.ways[at], radius)
    off_center = off[:, -1] + radius - math.hypot(end[0] - x, end[1] - y)
    turn, counted = math.copysign(1.0, sweep), path.counted[row]
    whole = _from_whole(path.radii[row] * np.hypot(start[:, 0], start[:, 1]) - by[counted])
    miss = _miss(path, row, whole + choice.counted_um, off_center)
    aside = np.abs(off[:, :-1]).max(axis=1)
    steps = aim.stepped + steps_off_um(start, start + by + miss, path.radii[row], turn, counted)
    cost = _unlike(choice.farther_um, attempt) + np.maximum(aside, _cost_of_end(path, row, aim, miss))
    is_near = cost <= max(_NEAR_UM, cost.min() + _SPARED_UM)
    best = int(np.argmin(np.where(is_near, cost + _cost_of_steps(steps), np.inf)))
    by = by[0] + float(miss[best, 0]), by[1] + float(miss[best, 1])
    words = told_arc_of((float(start[best, 0]), float(start[best, 1])), by, sweep, Axis(counted))
    if not words.turn:
        return Near(words, float(aside[best]), aim.stepped)
    (stepped_x, stepped_y), (start_x, start_y) = steps[best].tolist(), start[best].tolist()
    return Near(words, float(aside[best]), (stepped_x, stepped_y), (begin[0] - start_x, begin[1] - start_y))


def _cost_of_steps(off: Floats) -> Floats:
    """(k,) what it costs that steps end beside their words by (k, 2)."""
    far = np.hypot(off[:, 0], off[:, 1])
    cost: Floats = _STEPPED * far * np.minimum(far, _FAR_UM)
    return cost


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


def _miss(path: LookedAt, row: int, counted_um: Floats, beside_um: Floats) -> Floats:
    """(k, 2) by how much candidates miss their end: (k,) on the count axis; across they lie (k,) outside of it."""
    counted, free = path.counted[row], 1 - path.counted[row]
    across = path.across[row]
    miss = np.empty((len(counted_um), 2))
    miss[:, counted] = counted_um
    miss[:, free] = (beside_um - across[counted] * counted_um) / across[free]
    return miss


def _cost_of_end(path: LookedAt, row: int, aim: Aim, miss: Floats) -> Floats:
    """(k,) what it costs that candidates miss their end by (k, 2)."""
    if aim.is_known:
        return _bounded(np.hypot(miss[:, 0], miss[:, 1]))
    aside = np.maximum(np.abs(miss @ path.across[row]), np.abs(miss @ path.across_next[row]))
    cost: Floats = _END * aside + _SLIDE * np.hypot(miss[:, 0], miss[:, 1])
    for axis, whole in aim.pins:
        cost = np.maximum(cost, _bounded(np.abs(_from_whole(aim.end[axis] - whole + miss[:, axis]))))
    return cost


def _bounded(far: Floats) -> Floats:
    return far + _HELD * np.maximum(far - _FREE_UM, 0.0)


def _from_whole(number: Floats) -> Floats:
    return number - np.rint(number)
