"""The shortest way through places that could be found, without a way back."""

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.cam.order.nearest import from_nearest_to_nearest, neighbours
from sim.cam.order.shorter import shortened

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
