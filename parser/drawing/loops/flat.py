"""Closed loops that are no contour of any wire: dots, and lines there and back."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, Literal, NamedTuple

import numpy as np

from parser.drawing.loops.chain import Run, signed_areas
from parser.drawing.model import BESIDE_UM, DrawnLoop, running
from parser.geometry.along import places
from parser.geometry.curves import Curves, Ints
from parser.geometry.extents import extents

WhyFlat = Literal["dot", "no-width"]
DOT_UM: Final = 10.0
"""What is no larger is left of drawing, and no contour of any wire."""
_SHARES: Final = np.linspace(0.0, 1.0, 9)[:-1]  # of each curve, at which a loop is looked on how far it lies off a line


class Flat(NamedTuple):
    """A loop that is no contour: its first row, why, ``dot`` or ``no-width``, and where it begins, µm."""

    row: int
    why: WhyFlat
    place_um: tuple[float, float]


class Contours(NamedTuple):
    """Curves (n,), the number of the entity of each, loops of them, and the loops that are none of these."""

    curves: Curves
    entity: Ints
    loops: tuple[DrawnLoop, ...]
    flat: tuple[Flat, ...]


def without_flat(curves: Curves, entity: Ints, loops: Sequence[DrawnLoop]) -> Contours:
    """Curves (n,) and their loops without closed loops of no width; these stay where a drawing has nothing else."""
    why = dict(flat_loops(curves, loops))
    if not 0 < len(why) < len(loops):
        return Contours(curves, entity, tuple(loops), ())
    starts = [(int(loop.row[0]), curves.start_um[loop.row[0]].tolist()) for loop in loops]
    flat = tuple(Flat(starts[at][0], why[at], (starts[at][1][0], starts[at][1][1])) for at in why)
    left = [loop for at, loop in enumerate(loops) if at not in why]
    rows = np.sort(np.concatenate([loop.row for loop in left]))
    renumbered = tuple(replace(loop, row=np.searchsorted(rows, loop.row)) for loop in left)
    return Contours(curves.picked(rows), entity[rows], renumbered, flat)


def flat_loops(curves: Curves, loops: Sequence[DrawnLoop]) -> list[tuple[int, WhyFlat]]:
    """Numbers of closed loops that are no larger than 10 µm, ``dot``, or lie within 1 µm of a line, ``no-width``."""
    closed = [at for at, loop in enumerate(loops) if loop.closed]
    if not closed:
        return []
    number = np.array([len(loops[at].row) for at in closed])
    first = np.cumsum(number) - number
    row = np.concatenate([loops[at].row for at in closed])
    backwards = np.concatenate([loops[at].backwards for at in closed])
    run = Run(row, backwards, np.repeat(np.arange(len(closed)), number), np.ones(len(closed), dtype=np.bool_))
    ran = running(curves, row, backwards)
    low, high = extents(ran)
    size = (np.maximum.reduceat(high, first) - np.minimum.reduceat(low, first)).max(axis=1)
    slender = np.abs(signed_areas(curves, run)) <= BESIDE_UM * (np.add.reduceat(ran.length_um, first) + size)
    found: list[tuple[int, WhyFlat]] = []
    for each in np.flatnonzero((size <= DOT_UM) | slender).tolist():
        if size[each] <= DOT_UM:
            found.append((closed[each], "dot"))
        elif _is_straight(ran.picked(slice(first[each], first[each] + number[each]))):
            found.append((closed[each], "no-width"))
    return found


def _is_straight(ring: Curves) -> bool:
    """Whether a loop lies along a line; one that encloses nothing may be a figure eight."""
    row = np.repeat(np.arange(len(ring)), len(_SHARES))
    place = places(ring, row, np.tile(_SHARES, len(ring)))
    _, _, ways = np.linalg.svd(place - place.mean(axis=0), full_matrices=False)
    return bool(np.ptp(place @ ways[1]) <= BESIDE_UM)
