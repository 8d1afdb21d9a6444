"""The numbers of a SPLINE, looked at before a curve is made of them: what is wrong with one is said."""

from typing import cast

import numpy as np
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.spline import Spline as DXFSpline

from parser.drawing.dxf.forms import Spline, wrong

_FEWEST_FIT = 2


def spline_of(entity: DXFEntity) -> Spline:
    """The B-spline of a SPLINE, by control points or through fit points. WrongNumbersError where it has none."""
    drawn = cast("DXFSpline", entity)
    _refuse_wrong(drawn)
    tool = drawn.construction_tool()
    control = np.array([tuple(point) for point in tool.control_points])
    weight = np.array(tool.weights() or np.ones(len(control)), dtype=np.float64)
    return Spline(control, weight, np.array(tool.knots(), dtype=np.float64), tool.order - 1)


def _refuse_wrong(drawn: DXFSpline) -> None:
    """A B-spline of degree p has as many weights as points, and p + 1 knots more, none below the one before."""
    points, degree, knots, weights = len(drawn.control_points), drawn.dxf.degree, drawn.knots, drawn.weights
    if not points:
        if len(drawn.fit_points) < _FEWEST_FIT:
            raise wrong(drawn, "spline-without-points")
        return
    if degree < 1:
        raise wrong(drawn, "spline-degree", degree=degree)
    if points <= degree:
        raise wrong(drawn, "spline-points", points=points, degree=degree, expected=degree + 1)
    expected = points + degree + 1
    if len(knots) not in (0, expected):
        raise wrong(drawn, "spline-knots", knots=len(knots), points=points, degree=degree, expected=expected)
    if len(weights) not in (0, points):
        raise wrong(drawn, "spline-weights", weights=len(weights), points=points)
    falls = np.flatnonzero(np.diff(np.array(knots)) < 0.0)
    if len(falls):
        raise wrong(drawn, "spline-knots-fall", number=int(falls[0]) + 2, knots=len(knots))
