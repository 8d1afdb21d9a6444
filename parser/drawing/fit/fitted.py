"""Curves that were fitted, and how far off they are."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Ints, curves_between

FLATTEST_UM = 1e7
"""Arcs of larger radii are lines: controllers count 7 digits of µm (10 m)."""


class Fitted(NamedTuple):
    """Lines and arcs (n,), which of the curves fitted each is of (n,), and a proved bound of how far off they are."""

    curves: Curves
    of: Ints
    max_um: float


def no_curves() -> Curves:
    """Curves of nothing, to which parts are joined."""
    nowhere = np.empty((0, 2))
    return curves_between(nowhere, nowhere, nowhere, np.empty(0))
