"""The order of figures: as it is asked for, else deepest first, and by the shortest way between thread points.

Nearest places, as compiled loops over places in order of X: those of each, and the way from nearest to nearest.

What must be cut before what: figures by how deep they lie, and by the ranks of their layers.

The shortest way through places that could be found, without a way back.

Which figure lies directly around each one.

Shorter ways through places, as compiled loops: parts of a way are run backwards (2-opt) or moved (Or-opt).

A way has a place without a position at its head, as if it were closed there: it is as near as can be to all others, so
both ends are free; where the way must begin at a place, that one is bound to it.
"""

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.compiled.loops import compiled, loop_part
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints, extents, is_inside
from sim.make.cam.model import CannotCutError, Figure, Refusal, Thread
from sim.setup.making import Making

LONGEST_MOVED: Final = 3
"""Places that Or-opt moves in one go (Or 1976)."""
_GAIN_UM: Final = 1e-3  # less is rounding
_BOUND_UM: Final = 1e15  # so far is no drawing: what would undo the bond gains nothing
_LOOKS: Final = 100  # at each place, at most; ways of 100,000 places took 4


class Walk(NamedTuple):
    """A way through n places, as it is made shorter.

    Attributes
    ----------
    x, y
        (n,) where the places lie, µm.
    near
        (n × k,) the k places nearest to each, nearest first.
    bound
        The place at which the way must begin; −1 for any.
    way
        (n + 1,) the places in order, behind the head, which is n.
    at
        (n + 1,) position of each in `way`.
    is_open
        (n + 1,) 1 for places from which a change may still make the way shorter.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    near: NDArray[np.int64]
    bound: int
    way: NDArray[np.int64]
    at: NDArray[np.int64]
    is_open: NDArray[np.int64]


def shortened(place_um: Floats, near: Ints, order: Ints, bound: int) -> Ints:
    """The order (n,) of places (n, 2) made shorter, until nothing near a place makes it so; never longer than it was.

    `near` (n, k) are the nearest other places of each, nearest first; `bound` the place that it must begin at, −1 for
    any.
    """
    way = np.append(len(order), order)
    at = np.empty_like(way)
    at[way] = np.arange(len(way))
    x, y = np.ascontiguousarray(place_um[:, 0]), np.ascontiguousarray(place_um[:, 1])
    walk = Walk(x, y, np.ascontiguousarray(near).ravel(), bound, way, at, np.ones_like(way))
    _shorten(walk, near.shape[1], _LOOKS * len(order))
    # Seen from the head both ends are alike, and the way may have come to run back from its bound end.
    shorter: Ints = walk.way[1:] if bound in (-1, walk.way[1]) else walk.way[:0:-1]
    return shorter


@loop_part("f8(Walk, i8, i8)", Walk)
def _apart(walk: Walk, this: int, other: int) -> float:
    """Distance µm of two places; none from the head, and a bond between that and the place that is bound to it."""
    head = len(walk.x)
    if head in (this, other):
        return -_BOUND_UM if walk.bound in (this, other) else 0.0
    return float(np.hypot(walk.x[this] - walk.x[other], walk.y[this] - walk.y[other]))


@loop_part("void(Walk, i8, i8)", Walk)
def _run_back(walk: Walk, low: int, high: int) -> None:
    """Run the places from one position to another backwards."""
    while low < high:
        this, other = walk.way[low], walk.way[high]
        walk.way[low], walk.way[high] = other, this
        walk.at[other], walk.at[this] = low, high
        low, high = low + 1, high - 1


@loop_part("b1(Walk, i8, i8, i8)", Walk)
def _turned(walk: Walk, near: int, number: int, step: int) -> bool:
    """Run a part of the way backwards, if that is shorter, so that `one` comes to stand beside one of those near it."""
    past = len(walk.way)
    neighbour = walk.way[(walk.at[number] + step) % past]
    old = _apart(walk, number, neighbour)
    for k in range(number * near, number * near + near):
        other = walk.near[k]
        new = _apart(walk, number, other)
        if new >= old:
            return False
        behind = walk.way[(walk.at[other] + step) % past]
        if old + _apart(walk, other, behind) - new - _apart(walk, neighbour, behind) > _GAIN_UM:
            low, high = min(walk.at[number], walk.at[other]), max(walk.at[number], walk.at[other])
            _run_back(walk, low + (step > 0), high - (step < 0))
            for end in (number, neighbour, other, behind):
                walk.is_open[end] = 1
            return True
    return False


@loop_part("void(Walk, i8, i8, i8, b1)", Walk)
def _put(walk: Walk, low: int, high: int, behind: int, is_back: bool) -> None:
    """Put the places from one position to another behind that at a third one, backwards or not."""
    if behind > high:
        _run_back(walk, low, behind)
        first = low + behind - high
        _run_back(walk, low, first - 1)
        last = behind
    else:
        _run_back(walk, behind + 1, high)
        first, last = behind + 1, behind + 1 + high - low
        _run_back(walk, last + 1, high)
    if not is_back:
        _run_back(walk, first, last)


@loop_part("b1(Walk, i8, i8, i8)", Walk)
def _moved(walk: Walk, near: int, each_number: int, number: int) -> bool:
    """Move places, if that is shorter, so that `one` comes to stand beside one of those near it.

    They are as many as `number` from `one` on, back from it where that is negative.
    """
    past, step = len(walk.way), 1 if number > 0 else -1
    last = walk.at[each_number] + number - step
    if not 1 <= last < past:
        return False
    low, high = min(walk.at[each_number], last), max(walk.at[each_number], last)
    end, before, behind = walk.way[last], walk.way[(walk.at[each_number] - step) % past], walk.way[(last + step) % past]
    saved = _apart(walk, before, each_number) + _apart(walk, end, behind) - _apart(walk, before, behind)
    for k in range(2 * each_number * near, 2 * (each_number * near + near)):
        other, side = walk.near[k // 2], 1 - 2 * (k % 2)
        new, to = _apart(walk, each_number, other), (walk.at[other] + side) % past
        if new >= saved:
            return False
        beyond = walk.way[to]
        gain = saved + _apart(walk, other, beyond) - new - _apart(walk, end, beyond)
        if gain > _GAIN_UM and not low <= walk.at[other] <= high and not low <= to <= high:
            # `one` comes first where the other stands before it.
            _put(walk, low, high, walk.at[other] if side > 0 else walk.at[other] - 1, side != step)
            for touched in (each_number, end, before, behind, other, beyond):
                walk.is_open[touched] = 1
            return True
    return False


@compiled("void(Walk, i8, i8)", Walk)
def _shorten(walk: Walk, near: int, looks: int) -> None:
    """Look at all places until none can be changed, at most so often."""
    is_changed = True
    while is_changed and looks > 0:
        is_changed = False
        for each in range(len(walk.x)):
            if not walk.is_open[each]:
                continue
            looks -= 1
            done = _turned(walk, near, each, 1) or _turned(walk, near, each, -1)
            for number in range(1, LONGEST_MOVED + 1):
                done = done or _moved(walk, near, each, number) or _moved(walk, near, each, -number)
            walk.is_open[each] = 1 if done else 0
            is_changed = is_changed or done


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


def neighbours(place: Floats, number: int) -> Ints:
    """The (n, k) nearest other places of each of n in order of X, nearest first; k is less than n."""
    found = np.full((len(place), number), -1, dtype=np.int64)
    _find_neighbours(place, found, np.empty(number))
    return found


@compiled("void(f8[:,::1], i8[:,::1], f8[::1])")
def _find_neighbours(place: Floats, found: Ints, square: Floats) -> None:
    """Fill in the nearest (n, k) to each of n places in order of X; `square` (k,) is room for their distances.

    From each place the search goes to both sides, no farther in X than the farthest of those that were found.
    """
    n, number = found.shape
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


def from_nearest_to_nearest(place: Floats, first: int) -> Ints:
    """Order (n,) from one of the places (n, 2), which are in order of X, each time to the nearest one that is left."""
    n = len(place)
    order = np.empty(n, dtype=np.int64)
    _go_on_to_the_nearest(place, first, np.arange(-1, n - 1), np.arange(1, n + 1), order)
    return order


@compiled("void(f8[:,::1], i8, i8[::1], i8[::1], i8[::1])")
def _go_on_to_the_nearest(place: Floats, first: int, before: Ints, after: Ints, order: Ints) -> None:
    """Fill in the order (n,) of places (n, 2); of those that are left, `before` and `after` (n,) are beside each."""
    n, at = place.shape[0], first
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
