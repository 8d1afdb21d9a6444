"""Curves to loops: first the curves that an entity runs through in one go, then end to end from entity to entity.

Chains that pass a place twice, parted there: two loops that touch are two, no figure eight.

Closed loops that are no contour of any wire: dots, and lines there and back.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.drawing.loops.joints import Ends, joints, near
from parser.drawing.loops.once import Strings, strings_of
from parser.drawing.model import BESIDE_UM, SAME_WITHIN_UM, DrawnLoop, running
from parser.geometry.along import directions, places
from parser.geometry.arrangement import merged, place_labels
from parser.geometry.curves import Bools, Curves, Floats, Ints, extents


class Run(NamedTuple):
    """Chains of curves.

    Attributes
    ----------
    row, backwards
        (n,) rows in running order, and whether each is run backwards.
    of
        (n,) number of the chain of each, never decreasing.
    closed
        (l,) whether the chains close.
    """

    row: Ints
    backwards: Bools
    of: Ints
    closed: Bools


def parted(curves: Curves, run: Run, branch_um: Floats, gap_um: float) -> Run:
    """The chains, those parted that pass a place twice, in the order of the first of their rows.

    Places are one within `SAME_WITHIN_UM`; at the branches (b, 2), where more than two ends meet, within the gap. A
    chain stays whole where a part of it would have no area: it runs there and back, and nobody knows what it is about.
    """
    ran = running(curves, run.row, run.backwards)
    first = np.flatnonzero(np.diff(run.of, prepend=-1))
    past = np.append(first[1:], len(run.of))
    place = _numbers(np.concatenate([ran.start_um, ran.end_um[past - 1]]), branch_um, gap_um)
    start, end = place[: len(run.of)], np.where(run.closed, place[first], place[len(run.of) :])
    loose = np.flatnonzero(~run.closed)
    stop, chain = np.append(start, end[loose]), np.append(run.of, loose)
    key, number = np.unique(chain * (int(place.max()) + 1) + stop, return_counts=True)
    twice = set((key[number > 1] // (int(place.max()) + 1)).tolist())
    if not twice:
        return run
    parts: list[_Part] = []
    for index, (low, high) in enumerate(zip(first.tolist(), past.tolist(), strict=True)):
        whole = _Part(np.arange(low, high), bool(run.closed[index]))
        parts += _parts(curves, run, whole, [*start[low:high].tolist(), int(end[index])]) if index in twice else [whole]
    parts.sort(key=lambda part: int(run.row[part.at].min()))
    return _joined(run, parts)


class _Part(NamedTuple):
    """Where in a run the rows (k,) of a part of a chain stand, and whether it closes."""

    at: Ints
    closed: bool


def _numbers(place_um: Floats, branch_um: Floats, gap_um: float) -> Ints:
    """Numbers (k,) from 0 of places (k, 2), those at branches (b, 2) within the gap the same."""
    label = place_labels(np.concatenate([place_um, branch_um]), SAME_WITHIN_UM)
    pair, _ = near(branch_um, max(gap_um, SAME_WITHIN_UM))
    by = np.hypot(*(branch_um[pair[:, 0]] - branch_um[pair[:, 1]]).T)
    at_branch = label[len(place_um) :]
    return merged(label, at_branch[pair[by <= gap_um]])[: len(place_um)]


def _parts(curves: Curves, run: Run, whole: _Part, place: list[int]) -> list[_Part]:
    """Parts of a chain that passes places (m + 1,), each of which passes no place twice; what is open comes last."""
    parts, way, depth = [], [], {place[0]: 0}
    passed = [place[0]]
    for at, number in zip(whole.at.tolist(), place[1:], strict=True):
        way.append(at)
        if number in depth:
            begin = depth[number]
            parts.append(_Part(np.array(way[begin:], dtype=np.int64), closed=True))
            for gone in passed[begin + 1 :]:
                del depth[gone]
            del way[begin:], passed[begin + 1 :]
        else:
            passed.append(number)
            depth[number] = len(way)
    if way:
        parts.append(_Part(np.array(way, dtype=np.int64), closed=False))
    made = _joined(run, parts)
    length = np.bincount(made.of, curves.length_um[made.row])
    flat = made.closed & (2.0 * np.abs(signed_areas(curves, made)) <= BESIDE_UM * length)
    return [whole] if flat.any() else parts


def _joined(run: Run, parts: list[_Part]) -> Run:
    at = np.concatenate([part.at for part in parts])
    of = np.repeat(np.arange(len(parts)), [len(part.at) for part in parts])
    return Run(run.row[at], run.backwards[at], of, np.array([part.closed for part in parts]))


def signed_areas(curves: Curves, run: Run) -> Floats:
    """Signed areas (l,) µm² of chains, arcs included; open ones closed by a line."""
    ran = running(curves, run.row, run.backwards)
    origin = ran.start_um[np.flatnonzero(np.diff(run.of, prepend=-1))][run.of]
    start, end = ran.start_um - origin, ran.end_um - origin
    segment = np.where(ran.is_arc, ran.radius_um**2 * (ran.sweep_rad - np.sin(ran.sweep_rad)), 0.0)
    area = np.bincount(run.of, 0.5 * (start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0] + segment))
    return area.astype(np.float64)


class Chained(NamedTuple):
    """Loops, and places (b, 2) µm where more than two ends meet."""

    loops: tuple[DrawnLoop, ...]
    branches_um: Floats


def chain(curves: Curves, entity: Ints, gap_um: float) -> Chained:
    """Loops of curves (n,) whose ends lie within `gap_um`; entities are numbers (n,) that do not decrease."""
    strings = strings_of(curves, entity)
    ends = _ends(curves, strings)
    partner = np.full(len(ends.place_um), -1, dtype=np.int64)
    itself = np.flatnonzero(strings.closed)
    partner[2 * itself], partner[2 * itself + 1] = 2 * itself + 1, 2 * itself
    branches = []
    for within_um in sorted({SAME_WITHIN_UM, max(gap_um, SAME_WITHIN_UM)}):
        made = joints(ends, np.flatnonzero(partner < 0), within_um)
        partner[made.pair[:, 0]], partner[made.pair[:, 1]] = made.pair[:, 1], made.pair[:, 0]
        branches.append(made.branch)
    places = ends.place_um[np.unique(np.concatenate(branches))]
    run = parted(curves, _run(strings, _ways(partner), partner), places, gap_um)
    return Chained(_loops(curves, run), np.unique(np.round(places, -1), axis=0))


def _ends(curves: Curves, strings: Strings) -> Ends:
    along = directions(curves)
    run = curves.before_um
    place = np.stack([curves.start_um[strings.first], curves.end_um[strings.last]], axis=1)
    out = np.stack([-along.leaving[strings.first], along.arriving[strings.last]], axis=1)
    length = np.repeat(run[strings.last + 1] - run[strings.first], 2)
    return Ends(place.reshape(-1, 2), out.reshape(-1, 2), length)


def _ways(partner: Ints) -> list[list[int]]:
    """Ends by which each loop enters its strings, in running order; open ones from a loose end."""
    to = partner.tolist()
    seen = [False] * (len(to) // 2)
    loose = [end for end in range(len(to)) if to[end] < 0]
    ways = (_way(to, seen, end) for end in (*loose, *range(0, len(to), 2)))
    return sorted((way for way in ways if way), key=lambda way: min(end // 2 for end in way))


def _way(to: list[int], seen: list[bool], end: int) -> list[int]:
    way = []
    while end >= 0 and not seen[end // 2]:
        seen[end // 2] = True
        way.append(end)
        end = to[end ^ 1]
    return way


def _run(strings: Strings, ways: list[list[int]], partner: Ints) -> Run:
    """Rows in the order in which the ways pass them."""
    entry = np.array([end for way in ways for end in way], dtype=np.int64)
    string, back = entry // 2, entry % 2 == 1
    number = strings.last[string] - strings.first[string] + 1
    of_string = np.repeat(np.arange(len(string)), number)
    at = np.arange(len(of_string)) - (np.cumsum(number) - number)[of_string]
    row = np.where(back[of_string], strings.last[string][of_string] - at, strings.first[string][of_string] + at)
    of = np.repeat(np.arange(len(ways)), [len(way) for way in ways])[of_string]
    begin = np.array([way[0] for way in ways], dtype=np.int64)
    return Run(row, back[of_string], of, partner[begin] >= 0)


def _loops(curves: Curves, run: Run) -> tuple[DrawnLoop, ...]:
    """Loops of rows, closed ones counter-clockwise from their leftmost place, open ones as their first row runs."""
    closed = run.closed
    first = np.flatnonzero(np.diff(run.of, prepend=-1))
    past = np.append(first[1:], len(run.of))
    turned = _turned(run, first, past, np.where(closed, signed_areas(curves, run) < 0.0, _runs_back(run)))
    ran = running(curves, turned.row, turned.backwards)
    gap = np.hypot(*(ran.start_um - np.roll(ran.end_um, 1, axis=0)).T)
    gap[first] = np.where(closed, np.hypot(*(ran.start_um[first] - ran.end_um[past - 1]).T), 0.0)
    widest = np.maximum.reduceat(np.where(gap > SAME_WITHIN_UM, gap, 0.0), first)
    begin = np.where(closed, _leftmost(ran.start_um, run.of), first)
    at = np.arange(len(run.of))
    order = first[run.of] + (at + (begin - 2 * first)[run.of]) % (past - first)[run.of]
    rows, backs = np.split(turned.row[order], first[1:]), np.split(turned.backwards[order], first[1:])
    columns = zip(rows, backs, closed.tolist(), widest.tolist(), strict=True)
    return tuple(DrawnLoop(row, back, whole, gap_um) for row, back, whole, gap_um in columns)


def _turned(run: Run, first: Ints, past: Ints, turn: NDArray[np.bool_]) -> Run:
    """The run with some loops run through the other way."""
    at, whether = np.arange(len(run.of)), turn[run.of]
    other = np.where(whether, (first + past - 1)[run.of] - at, at)
    return run._replace(row=run.row[other], backwards=run.backwards[other] ^ whether)


def _runs_back(run: Run) -> NDArray[np.bool_]:
    """Whether loops (l,) run through the earliest of their rows from its end."""
    order = np.lexsort([run.row, run.of])
    back: NDArray[np.bool_] = run.backwards[order[np.flatnonzero(np.diff(run.of[order], prepend=-1))]]
    return back


def _leftmost(start: Floats, of: Ints) -> Ints:
    """Which place (l,) of each loop has the least x, and of these the least y."""
    order = np.lexsort([start[:, 1], start[:, 0], of])
    leftmost: Ints = order[np.flatnonzero(np.diff(of[order], prepend=-1))]
    return leftmost


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
