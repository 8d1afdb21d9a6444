"""Shorter ways through places, as compiled loops: parts of a way are run backwards (2-opt) or moved (Or-opt).

A way has a place without a position at its head, as if it were closed there: it is as near as can be to all others, so
both ends are free; where the way must begin at a place, that one is bound to it.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats, Ints

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


@compiled("f8(Walk, i8, i8)", Walk)
def _apart(walk: Walk, this: int, other: int) -> float:
    """Distance µm of two places; none from the head, and a bond between that and the place that is bound to it."""
    head = len(walk.x)
    if head in (this, other):
        return -_BOUND_UM if walk.bound in (this, other) else 0.0
    return float(np.hypot(walk.x[this] - walk.x[other], walk.y[this] - walk.y[other]))


@compiled("void(Walk, i8, i8)", Walk)
def _run_back(walk: Walk, low: int, high: int) -> None:
    """Run the places from one position to another backwards."""
    while low < high:
        this, other = walk.way[low], walk.way[high]
        walk.way[low], walk.way[high] = other, this
        walk.at[other], walk.at[this] = low, high
        low, high = low + 1, high - 1


@compiled("b1(Walk, i8, i8, i8)", Walk)
def _turned(walk: Walk, near: int, number: int, step: int) -> bool:
    """Run a part of the way backwards, if that is shorter, so that `one` comes to stand beside one of those near it."""
    past = len(walk.way)
    beside = walk.way[(walk.at[number] + step) % past]
    old = _apart(walk, number, beside)
    for k in range(number * near, number * near + near):
        other = walk.near[k]
        new = _apart(walk, number, other)
        if new >= old:
            return False
        behind = walk.way[(walk.at[other] + step) % past]
        if old + _apart(walk, other, behind) - new - _apart(walk, beside, behind) > _GAIN_UM:
            low, high = min(walk.at[number], walk.at[other]), max(walk.at[number], walk.at[other])
            _run_back(walk, low + (step > 0), high - (step < 0))
            for end in (number, beside, other, behind):
                walk.is_open[end] = 1
            return True
    return False


@compiled("void(Walk, i8, i8, i8, b1)", Walk)
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


@compiled("b1(Walk, i8, i8, i8)", Walk)
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
