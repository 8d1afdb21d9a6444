"""Things that hang together, directly or through others."""

import numpy as np

from parser.geometry.curves import Floats, Ints

# Mixes x and y of a cell; sums wrap round.
_HASH = np.array([-7046029254386353131, 7809847782465536322])


def groups(count: int, one: Ints, other: Ints) -> Ints:
    """(count,) the least number in the group of each of 0 … count − 1, where the pairs (k,) hang together."""
    least = np.arange(count)
    while True:
        lower = least.copy()
        np.minimum.at(lower, one, least[other])
        np.minimum.at(lower, other, least[one])
        np.minimum.at(lower, least, lower)  # the whole group so far moves with any of its members
        lower = lower[lower]
        if np.array_equal(lower, least):
            return least
        least = lower


def same_places(place_um: Floats, within_um: float) -> Ints:
    """(m,) for each of the places (m, 2) the least index of those that are one with it, directly or through others.

    Two places within the distance are one. Two places three times as far apart are one only through others.
    """
    cells = np.floor(place_um / within_um - 0.5).astype(np.int64) @ _HASH
    cells = np.add.outer(cells, np.array([0, _HASH[0], _HASH[1], _HASH[0] + _HASH[1]])).ravel()
    order = np.argsort(cells)
    same = np.flatnonzero(cells[order[1:]] == cells[order[:-1]])
    one, other = order[same] // 4, order[same + 1] // 4
    # Two cells of one hash are found out by their distance.
    near = np.abs(place_um[one] - place_um[other]).max(axis=1) <= 2.0 * within_um
    return groups(len(place_um), one[near], other[near])
