"""DXF entities to forms, each in the coordinates that its file gives it in.

The numbers of a SPLINE, looked at before a curve is made of them: what is wrong with one is said.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, cast

import numpy as np
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.entities.polyline import Polyline
from ezdxf.entities.spline import Spline as DXFSpline
from ezdxf.math import Vec3

from parser.drawing.dxf.forms import (
    ReadEntity,
    Spline,
    circle_form,
    ellipse_form,
    line_forms,
    of_extrusion,
    polyline_forms,
    wrong,
)
from parser.geometry.curves import Floats

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


_FRAME = 16  # flag of a vertex that is a control point of a fitted spline, and not on the polyline


def reader_of(entity: DXFEntity) -> Callable[[DXFEntity], ReadEntity] | None:
    """What reads an entity; None for entities that are no curves.

    The reader raises WrongNumbersError where it can tell what is wrong, and anything on damaged numbers.
    """
    if isinstance(entity, Polyline) and not (entity.is_2d_polyline or entity.is_3d_polyline):
        return None  # a mesh
    return _READERS.get(entity.dxftype())


def _line(entity: DXFEntity) -> ReadEntity:
    return ReadEntity(
        line_forms(np.array([tuple(_number_of(entity, "start", 10)), tuple(_number_of(entity, "end", 11))]))
    )


def _circle(entity: DXFEntity) -> ReadEntity:
    return ReadEntity(circle_form(*_center_radius(entity), 0.0, 0.0), _own(entity))


def _arc(entity: DXFEntity) -> ReadEntity:
    begin, end = (math.radians(_number_of(entity, *of)) for of in (("start_angle", 50), ("end_angle", 51)))
    return ReadEntity(circle_form(*_center_radius(entity), begin, end), _own(entity))


def _center_radius(entity: DXFEntity) -> tuple[Floats, float]:
    return _place(_number_of(entity, "center", 10)), abs(_number_of(entity, "radius", 40))


def _ellipse(entity: DXFEntity) -> ReadEntity:
    major, normal = Vec3(_number_of(entity, "major_axis", 11)), Vec3(entity.dxf.extrusion).normalize()
    minor = normal.cross(major) * _number_of(entity, "ratio", 40)
    place = _place(_number_of(entity, "center", 10))
    return ReadEntity(ellipse_form(place, _place(major), _place(minor), entity.dxf.start_param, entity.dxf.end_param))


def _lwpolyline(entity: DXFEntity) -> ReadEntity:
    polyline = cast("LWPolyline", entity)
    vertex = np.array(polyline.lwpoints.values, dtype=np.float64).reshape(-1, 5)  # x, y, two widths, bulge
    height = np.full(len(vertex), float(polyline.dxf.elevation))
    return ReadEntity(
        polyline_forms(np.column_stack([vertex[:, :2], height]), vertex[:, 4], polyline.closed), _own(entity)
    )


def _polyline(entity: DXFEntity) -> ReadEntity:
    polyline = cast("Polyline", entity)
    vertices = [vertex for vertex in polyline.vertices if not vertex.dxf.flags & _FRAME]
    place = np.array([tuple(vertex.dxf.location) for vertex in vertices]).reshape(-1, 3)
    if polyline.is_3d_polyline:
        return ReadEntity(polyline_forms(place, np.zeros(len(place)), polyline.is_closed))
    place[:, 2] = Vec3(polyline.dxf.elevation).z
    bulge = np.array([float(vertex.dxf.bulge) for vertex in vertices])
    return ReadEntity(polyline_forms(place, bulge, polyline.is_closed), _own(entity))


def _spline(entity: DXFEntity) -> ReadEntity:
    return ReadEntity(spline_of(entity))


def _number_of(entity: DXFEntity, name: str, code: int) -> Any:
    """A number or a place of an entity. WrongNumbersError without it: the library takes a radius of none for 1."""
    given = entity.dxf.get(name)
    if given is None:
        raise wrong(entity, "number-missing", code=code)
    return given


def _place(point: Vec3) -> Floats:
    return np.array(tuple(point))


def _own(entity: DXFEntity) -> Floats | None:
    return of_extrusion(Vec3(entity.dxf.extrusion))


_READERS: Mapping[str, Callable[[DXFEntity], ReadEntity]] = {
    "LINE": _line,
    "CIRCLE": _circle,
    "ARC": _arc,
    "ELLIPSE": _ellipse,
    "LWPOLYLINE": _lwpolyline,
    "POLYLINE": _polyline,
    "SPLINE": _spline,
}
