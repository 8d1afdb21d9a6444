"""Which stretches of a path run over one edge: those that lie in like boxes and run beside one another."""

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.geometry.extents import extents
from parser.shape.beside import BESIDE_UM, Stretches, run_beside
from parser.toolpath import Toolpath

_BOX_UM = 2.0 * BESIDE_UM
"""Sides of boxes about passes over one edge lie this near each other: at a sharp corner farther than the passes do."""
_BOX_SHARE = 0.4  # of the box: no pass takes more of a small one
_LEAST_SHARE = 0.6  # of a pass that runs beside another one; corners are rounded in one and not in the other
_LEAST_SENSE = 0.8  # all of a pass runs one way
_MOST_LIKE = 8  # stretches whose boxes one is held against: the latest before it that begin near
_MOST_HELD = 2  # of these, stretches that one is held against itself
_CELLS = 1 << 31  # more cells than any path has across


def edges_of(toolpath: Toolpath, stretches: Stretches) -> Ints:
    """Which edge each stretch (k,) runs over: the number of the first stretch over it."""
    one, other = _alike(toolpath, stretches)
    beside = run_beside(toolpath, stretches, one, other)
    back = run_beside(toolpath, stretches, other, one)
    share = np.minimum(beside.share, back.share)
    mates = (share >= _LEAST_SHARE) & (np.abs(beside.sense) >= _LEAST_SENSE)
    edge = list(range(len(stretches.first)))
    for early, late in zip(one[mates].tolist(), other[mates].tolist(), strict=True):
        here, there = _root(edge, early), _root(edge, late)
        edge[max(here, there)] = min(here, there)
    return np.array([_root(edge, number) for number in range(len(edge))], dtype=np.int64)


def _root(edge: list[int], number: int) -> int:
    while edge[number] != number:
        edge[number] = edge[edge[number]]
        number = edge[number]
    return number


def _alike(toolpath: Toolpath, stretches: Stretches) -> tuple[Ints, Ints]:
    """Pairs (m,) of stretches in boxes that are alike, the earlier one first."""
    low, high = _boxes(toolpath, stretches)
    most_off = np.minimum(_BOX_UM, _BOX_SHARE * (high - low).max(axis=1, initial=0.0))
    k = len(stretches.first)
    found = [np.empty(0, dtype=np.int64)]
    # Corners within half a cell of each other share a cell of one of four grids that lie half a cell apart.
    for shift in np.ndindex(2, 2):
        cell = np.floor(low / (2.0 * _BOX_UM) + np.array(shift) / 2.0).astype(np.int64)
        key = cell[:, 0] * _CELLS + cell[:, 1]
        order = np.argsort(key, kind="stable")
        for step in range(1, min(_MOST_LIKE, k - 1) + 1):
            one, other = order[:-step], order[step:]
            off = np.maximum(np.abs(low[one] - low[other]), np.abs(high[one] - high[other])).max(axis=1)
            alike = (key[one] == key[other]) & (off <= np.maximum(most_off[one], most_off[other]))
            found.append(one[alike] * k + other[alike])
    pairs, _ = np.unique(np.concatenate(found), return_index=True)
    one, other = pairs // k, pairs % k
    # The latest before each are enough: passes follow each other.
    order = np.lexsort((-one, other))
    first = np.searchsorted(other[order], other[order])
    kept = order[np.arange(len(order)) - first < _MOST_HELD]
    return one[kept], other[kept]


def _boxes(toolpath: Toolpath, stretches: Stretches) -> tuple[Floats, Floats]:
    """Lowest and highest places (k, 2) of stretches."""
    low, high = extents(toolpath)
    # Every other one of these ranges lies between two stretches.
    edges = np.stack([stretches.first, np.minimum(stretches.last + 1, len(toolpath))], axis=1).reshape(-1)
    low, high = np.append(low, low[-1:], axis=0), np.append(high, high[-1:], axis=0)
    return np.minimum.reduceat(low, edges)[::2], np.maximum.reduceat(high, edges)[::2]
