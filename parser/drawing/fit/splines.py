"""Splines to arcs."""

from parser.drawing.dxf.forms import Spline
from parser.drawing.fit.fitted import Fitted


def arcs_of_spline(spline: Spline, tolerance_um: float) -> Fitted:
    """Lines and arcs for a placed spline within a tolerance of it, from end to end; its corners stay corners."""
    raise NotImplementedError
