"""DXF entities to forms, each in the coordinates that its file gives it in."""

import math
from collections.abc import Callable, Mapping
from typing import cast

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
)
from parser.geometry.curves import Floats

_FRAME = 16  # flag of a vertex that is a control point of a fitted spline, and not on the polyline


def reader_of(entity: DXFEntity) -> Callable[[DXFEntity], ReadEntity] | None:
    """What reads an entity; None for entities that are no curves. The reader raises anything on damaged numbers."""
    if isinstance(entity, Polyline) and not (entity.is_2d_polyline or entity.is_3d_polyline):
        return None  # a mesh
    return _READERS.get(entity.dxftype())


def _line(entity: DXFEntity) -> ReadEntity:
    return ReadEntity(line_forms(np.array([tuple(entity.dxf.start), tuple(entity.dxf.end)])))


def _circle(entity: DXFEntity) -> ReadEntity:
    return ReadEntity(circle_form(_place(entity.dxf.center), abs(entity.dxf.radius), 0.0, 0.0), _own(entity))


def _arc(entity: DXFEntity) -> ReadEntity:
    begin, end = math.radians(entity.dxf.start_angle), math.radians(entity.dxf.end_angle)
    return ReadEntity(circle_form(_place(entity.dxf.center), abs(entity.dxf.radius), begin, end), _own(entity))


def _ellipse(entity: DXFEntity) -> ReadEntity:
    major, normal = Vec3(entity.dxf.major_axis), Vec3(entity.dxf.extrusion).normalize()
    minor = normal.cross(major) * entity.dxf.ratio
    place = _place(entity.dxf.center)
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
    tool = cast("DXFSpline", entity).construction_tool()
    control = np.array([tuple(point) for point in tool.control_points])
    weight = np.array(tool.weights() or np.ones(len(control)), dtype=np.float64)
    knot = np.array(tool.knots(), dtype=np.float64)
    if len(weight) != len(control) or len(knot) != len(control) + tool.order:
        raise ValueError(f"{len(control)} control points, {len(weight)} weights, {len(knot)} knots, order {tool.order}")
    if (np.diff(knot) < 0.0).any():
        raise ValueError("knots that decrease")
    return ReadEntity(Spline(control, weight, knot, tool.order - 1))


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
