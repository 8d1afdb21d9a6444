"""Words of a path whose blocks all end as near as whole µm let them; the border type is `Chained`.

Words of a path that is meant as it stands: of all whole µm about it, those that run nearest to it.

`parser.step_words.chained` writes again what was a program before, as its CAM wrote it. Here the curves are no rounding
of anybody's: each block begins at the decoded end of the last; of the centres in whole µm about the one that an arc
should have that one is taken whose arc lies nearest; and where the path comes to a place again, the program does too.
"""

import math
from collections import ChainMap
from collections.abc import MutableMapping
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from parser.controller_words import StepWords
from parser.geometry.curves import Bools, Curves
from parser.step_words.chained import Chained, OneBlock, Place
from parser.step_words.looked_at import LookedAt, looked_at
from parser.step_words.near_blocks import Aim, arc_to, line_to

_ATTEMPTS, _TAIL = 24, 40
"""How often the rows before a place are told until they meet it, and how many rows of them."""
_CLOSED_UM, _ASIDE_UM = 0.5, 1.5
"""How far a path may end from where it was, and how far aside of it an arc may lie to bring it there."""
_NEAR_UM = 1.2
"""How far aside of what is drawn any block may lie before the rows are told otherwise."""
_COLUMNS = "x_um", "y_um", "count_um", "count_axis", "quadrant", "turn"


class _Begun(NamedTuple):
    """Where rows begin, and by how much the steps before end beside that."""

    at: Place
    stepped: Place


class _Visited(NamedTuple):
    """Where a path was: ends by the numbers of their places, and centres of arcs by those of both their ends."""

    ends: MutableMapping[int, Place]
    centers: MutableMapping[tuple[int, int], Place]


class _Chain(NamedTuple):
    """Blocks of some rows, and where they end.

    `missed`: by how much they miss places where the path was before, or lie aside of it to meet them, at most; by what
    is wished 1 or less. `aside`: the same of how far any of them lies aside of what is drawn. `stepped`: by how much
    the steps end beside the last end. `seen`: what they add to it.
    """

    blocks: list[OneBlock]
    ends: list[Place]
    missed: float
    aside: float
    stepped: Place
    seen: _Visited


def nearest_words(curves: Curves, is_placed: Bools) -> Chained:
    """Words of n curves; jumps are told as lines, and rows that are placed end at the very place.

    How near: docs/program.md.
    """
    if not len(curves):
        return Chained(_words([]), np.zeros((0, 2)))
    path = looked_at(curves, is_placed)
    x, y = curves.start_um[0].tolist()
    ends: list[Place] = [(x, y)]
    seen = _Visited({path.again.first: ends[0]}, {})
    blocks: list[OneBlock] = []
    stepped: Place = (0.0, 0.0)
    for first, past in pairwise(_stretches(path)):
        words = _closing(path, range(first, past), _Begun(ends[-1], stepped), seen)
        seen.ends.update(words.seen.ends)
        seen.centers.update(words.seen.centers)
        blocks += words.blocks
        ends += words.ends
        stepped = words.stepped
    return Chained(_words(blocks), np.array(ends[1:]))


def _stretches(path: LookedAt) -> list[int]:
    """Rows at which stretches begin that are told by themselves: up to a place that is met, the last rows once more."""
    closing = path.again.closing
    tails = [past - _TAIL for before, past in pairwise([0, *closing]) if past - before > _TAIL]
    return sorted({0, *closing, *tails, len(path.end)})


def _closing(path: LookedAt, rows: range, begin: _Begun, seen: _Visited) -> _Chain:
    """Some rows told so that they come near enough to where the path was before, or as near as may be.

    And so that none of them lies far aside, where that is to be had as well.
    """
    best = _chained(path, rows, begin, seen, 0)
    for attempt in range(1, _ATTEMPTS if len(rows) <= _TAIL else 1):
        if max(best.missed, best.aside) <= 1.0:
            break
        best = min(
            best, _chained(path, rows, begin, seen, attempt), key=lambda each: (max(each.missed, 1.0), each.aside)
        )
    return best


def _chained(path: LookedAt, rows: range, begin: _Begun, seen: _Visited, attempt: int) -> _Chain:
    """Some rows told one from the end of the other."""
    new = _Visited({}, {})
    known, centers = ChainMap(new.ends, seen.ends), ChainMap(new.centers, seen.centers)
    blocks: list[OneBlock] = []
    ends: list[Place] = []
    (at, off), missed, aside = begin, 0.0, 0.0
    for row in rows:
        place, before = path.again.place[row], path.again.place[row - 1] if row else path.again.first
        pins = tuple((pin.axis, known[pin.place][pin.axis]) for pin in path.again.pinned.get(row, ()))
        aim = Aim(known.get(place, path.end[row]), place in known, pins, off, centers.get((place, before)))
        if path.is_arc[row]:
            block, aside_um, off, center = arc_to(path, row, at, aim, attempt)
        else:
            block, aside_um, off, center = line_to(path, row, at, aim, attempt)
        at = aim.end if path.is_placed[row] else (at[0] + block.by_um[0], at[1] + block.by_um[1])
        if aim.is_known:
            missed = max(missed, math.dist(at, aim.end) / _CLOSED_UM)
        if aim.is_known or pins:
            missed = max(missed, aside_um / _ASIDE_UM)
        across_x, across_y = path.across[row]
        end_um = abs((at[0] - path.end[row][0]) * across_x + (at[1] - path.end[row][1]) * across_y)
        aside = max(aside, aside_um / _NEAR_UM, end_um / _NEAR_UM)
        known.setdefault(place, at)
        if center is not None:
            new.centers[before, place] = center
        blocks.append(block)
        ends.append(at)
    return _Chain(blocks, ends, missed, aside, off, new)


def _words(blocks: list[OneBlock]) -> StepWords:
    none, n = np.int64(0), len(blocks)
    columns = {name: np.array([getattr(one_block, name) for one_block in blocks], dtype=np.int64) for name in _COLUMNS}
    return StepWords(**columns, radius_um=np.full(n, none - 1), curve=np.full(n, none))
