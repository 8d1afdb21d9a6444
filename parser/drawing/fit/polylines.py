"""Dense polylines to arcs through their vertices."""

from parser.drawing.fit.fitted import Fitted
from parser.geometry.curves import Curves


def arcs_of_lines(curves: Curves, tolerance_um: float, *, is_closed: bool) -> Fitted:
    """A loop (n,) in running order, runs of short lines in it replaced by arcs that lie within a tolerance of them.

    `of` is the row of the first line that each is of.
    """
    raise NotImplementedError
