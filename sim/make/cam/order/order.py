"""The order of figures: as it is asked for, else deepest first, and by the shortest way between thread points.

Nearest places, as compiled loops over places in order of X: those of each, and the way from nearest to nearest.

What must be cut before what: figures by how deep they lie, and by the ranks of their layers.

The shortest way through places that could be found, without a way back.

Which figure lies directly around each one.
"""

import math
from collections.abc import Sequence

import numpy as np

from controller.compiled.loops import compiled
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints, extents, is_inside
from sim.make.cam.model import CannotCutError, Figure, Refusal, Thread
from sim.make.cam.order.shorter import shortened
from sim.setup.making import Making

_PLACES = 8  # of a contour that say within which others it lies; some of them may lie on one that touches it


def around(figures: Sequence[Figure]) -> tuple[int, ...]:
    """Index of the figure directly around each one, −1 where there is none: of a hole the outline of its part."""
    outlines = {figure.part: at for at, figure in enumerate(figures) if figure.kind == "outline"}
    found = [outlines.get(figure.part, -1) if figure.kind == "hole" else -1 for figure in figures]
    islands = np.array(
        [at for at, each_figure in enumerate(figures) if each_figure.kind == "outline" and each_figure.depth],
        dtype=np.int64,
    )
    if len(islands):
        spread = np.stack([_spread(figures[at]) for at in islands.tolist()])
        depth = np.array([figures[at].depth for at in islands.tolist()])
        for at, figure in enumerate(figures):
            if figure.kind == "hole":
                which = np.flatnonzero(depth == figure.depth + 1)
                for island in islands[which[_lie_within(figure, spread[which])]].tolist():
                    found[island] = at
    return tuple(found)


def _spread(figure: Figure) -> Floats:
    """Places (`_PLACES`, 2) along a contour."""
    length = np.linspace(0.0, 1.0, _PLACES, endpoint=False) * figure.contour.length_um.sum()
    before = figure.contour.before_um
    row = np.clip(np.searchsorted(before, length, side="right") - 1, 0, len(figure.contour) - 1)
    return places(figure.contour, row, (length - before[row]) / figure.contour.length_um[row])


def _lie_within(figure: Figure, spread_um: Floats) -> list[bool]:
    """Whether contours with places (k, m, 2) lie within a figure: those that lie in its box are looked at."""
    low, high = (edge(ends, axis=0) for edge, ends in zip((np.min, np.max), extents(figure.contour), strict=True))
    within = [False] * len(spread_um)
    in_box = ((spread_um >= low) & (spread_um <= high)).all(axis=2).mean(axis=1) > 0.5
    for at in np.flatnonzero(in_box).tolist():
        within[at] = bool(is_inside(figure.contour, spread_um[at]).mean() > 0.5)
    return within


@compiled("i8[:,::1](f8[:,::1], i8)")
def neighbours(place: Floats, number: int) -> Ints:
    """The (n, k) nearest other places of each of n in order of X, nearest first; k is less than n.

    From each place the search goes to both sides, no farther in X than the farthest of those that were found.
    """
    n = place.shape[0]
    found = np.full((n, number), -1, dtype=np.int64)
    square = np.full(number, np.inf)
    for at in range(n):
        square[:] = np.inf
        for step in (-1, 1):
            other = at + step
            while 0 <= other < n and (place[other, 0] - place[at, 0]) ** 2 < square[number - 1]:
                off = (place[other, 0] - place[at, 0]) ** 2 + (place[other, 1] - place[at, 1]) ** 2
                slot = number - 1
                if off < square[slot]:
                    while slot > 0 and square[slot - 1] > off:
                        square[slot], found[at, slot] = square[slot - 1], found[at, slot - 1]
                        slot -= 1
                    square[slot], found[at, slot] = off, other
                other += step
    return found


@compiled("i8[::1](f8[:,::1], i8)")
def from_nearest_to_nearest(place: Floats, first: int) -> Ints:
    """Order (n,) from one of the places (n, 2), which are in order of X, each time to the nearest one that is left."""
    n = place.shape[0]
    before, after = np.arange(-1, n - 1), np.arange(1, n + 1)
    order = np.empty(n, dtype=np.int64)
    at = first
    for number in range(n):
        order[number] = at
        left, right = before[at], after[at]
        if left >= 0:
            after[left] = right
        if right < n:
            before[right] = left
        square, nearest = np.inf, at
        while left >= 0 and (place[left, 0] - place[at, 0]) ** 2 < square:
            off = (place[left, 0] - place[at, 0]) ** 2 + (place[left, 1] - place[at, 1]) ** 2
            if off < square:
                square, nearest = off, left
            left = before[left]
        while right < n and (place[right, 0] - place[at, 0]) ** 2 < square:
            off = (place[right, 0] - place[at, 0]) ** 2 + (place[right, 1] - place[at, 1]) ** 2
            if off < square:
                square, nearest = off, right
            right = after[right]
        at = nearest
    return order


_NEAR = 10  # neighbours of a place that are looked at; with more, ways get hardly shorter
_STARTS = 1000  # places of all the ways that are tried, so that small drawings are searched well and large ones fast


def route(place_um: Floats, bound: int | None = None) -> Ints:
    """Order (n,) of places (n, 2) in which the way through them is short; it begins at the place `bound`, if any.

    From several first places the way goes to the nearest one each time, and is made shorter from there. The shortest
    is taken; it is as long whatever the order in which the places are given.
    """
    number = len(place_um)
    if number < 3 and (bound is None or number < 2):
        return np.lexsort(place_um.T[::-1])
    by_x = np.lexsort(place_um.T[::-1])
    place = np.ascontiguousarray(place_um[by_x])
    first = -1 if bound is None else int(np.flatnonzero(by_x == bound)[0])
    near = neighbours(place, min(_NEAR, number - 1))
    tries = max(min(_STARTS // number, number), 1)
    starts = np.unique(np.linspace(0, number - 1, tries).astype(np.int64)) if tries > 1 else np.array([max(first, 0)])
    tried = (_begun(from_nearest_to_nearest(place, start), first) for start in starts.tolist())
    ways = [shortened(place, near, order, first) for order in tried]
    shortest: Ints = by_x[min(ways, key=lambda way: travel_um(place[way]))]
    return shortest


def _begun(order: Ints, first: int) -> Ints:
    """The order with one place at its head; as it is where that is −1."""
    return order if first < 0 else np.append(first, order[order != first])


def travel_um(place_um: Floats) -> float:
    """Length of the way through places (n, 2) in order."""
    by = np.diff(place_um, axis=0)
    return float(np.hypot(by[:, 0], by[:, 1]).sum())


def levels(figures: Sequence[Figure], around: Sequence[int], making: Making) -> tuple[Ints, ...]:
    """Indices of figures that may be cut in any order, level after level.

    The deepest come first, so that a part falls only once its holes are cut, and islands before the pocket in which
    they stand. Layers with a rank come before that, the lowest first, and those without one last; but a figure waits
    for all that lies within it.
    """
    ranks = {wish.layer.casefold(): wish.rank for wish in making.layers if wish.rank is not None}
    rank = [float(ranks.get(figure.layer.casefold(), math.inf)) for figure in figures]
    for at in sorted(range(len(figures)), key=lambda each: -figures[each].depth):
        if around[at] >= 0:
            rank[around[at]] = max(rank[around[at]], rank[at])
    keys = [(rank[at], -figure.depth) for at, figure in enumerate(figures)]
    return tuple(np.array([at for at, key in enumerate(keys) if key == each_key]) for each_key in sorted(set(keys)))


def in_order(figures: Sequence[Figure], threads: Sequence[Thread], making: Making) -> tuple[int, ...]:
    """Indices of the figures as they are cut.

    CannotCutError where the order that is asked for does not name each figure once, ``order-incomplete``, or would cut
    out what has still to be cut within, ``order-falls``.
    """
    outer = around(figures)
    if making.order:
        return _wished_order(figures, outer, making.order)
    place = np.array([thread.place_um for thread in threads], dtype=np.float64).reshape(-1, 2)
    order: list[int] = []
    for level in levels(figures, outer, making):
        if order:
            # The way goes on from where the level before it ends.
            from_there = route(np.concatenate([place[order[-1:]], place[level]]), 0)[1:] - 1
            order += level[from_there].tolist()
        else:
            order += level[route(place[level])].tolist()
    return tuple(order)


def _wished_order(figures: Sequence[Figure], outer: Sequence[int], wanted: tuple[int, ...]) -> tuple[int, ...]:
    """The order of the numbers that are asked for."""
    index = {figure.number: at for at, figure in enumerate(figures)}
    if sorted(wanted) != sorted(index):
        missing, unknown = sorted(set(index) - set(wanted)), sorted(set(wanted) - set(index))
        twice = sorted({number for number in wanted if wanted.count(number) > 1})
        values = (("all", str(len(index))), ("wrong", ", ".join(map(str, [*missing, *unknown, *twice][:20]))))
        raise CannotCutError(Refusal("order-incomplete", (), values))
    order = tuple(index[number] for number in wanted)
    when = {at: number for number, at in enumerate(order)}
    for at in order:
        if outer[at] >= 0 and when[outer[at]] < when[at]:
            values = (("number", str(figures[at].number)), ("around", str(figures[outer[at]].number)))
            raise CannotCutError(Refusal("order-falls", (), values))
    return order
