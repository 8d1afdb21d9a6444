"""Nearest places, as compiled loops over places in order of X: those of each, and the way from nearest to nearest."""

import numpy as np

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats, Ints


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
