"""Curves that were fitted, and how far off they are."""

from typing import NamedTuple

from parser.geometry.curves import Curves, Ints


class Fitted(NamedTuple):
    """Lines and arcs (n,), which of the curves fitted each is of (n,), and a proved bound of how far off they are."""

    curves: Curves
    of: Ints
    max_um: float
