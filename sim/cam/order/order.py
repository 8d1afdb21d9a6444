"""The order of figures: deepest first, outlines last, and by the shortest way between thread points."""

from collections.abc import Sequence

import numpy as np

from sim.cam.model import Figure, Thread
from sim.setup.making import Making


def in_order(figures: Sequence[Figure], threads: Sequence[Thread], making: Making) -> tuple[int, ...]:
    """Indices of the figures as they are cut. CannotCutError where the order that is asked for cannot be kept."""
    left = set(range(len(figures)))
    order: list[int] = []
    at = np.zeros(2)
    while left:
        deepest = max(figures[one].depth for one in left)
        ready = [one for one in left if figures[one].depth == deepest]
        nearest = min(ready, key=lambda one: (float(np.hypot(*(np.array(threads[one].place_um) - at))), one))
        at = np.array(threads[nearest].place_um)
        order.append(nearest)
        left.remove(nearest)
    return tuple(order)
