"""Ellipses to arcs."""

from parser.drawing.fit.fitted import Fitted
from parser.geometry.curves import Floats


def arcs_of_ellipses(forms: Floats, tolerance_um: float) -> Fitted:
    """Arcs for placed arcs of ellipses (k, 17) within a tolerance of them, each from end to end."""
    raise NotImplementedError
