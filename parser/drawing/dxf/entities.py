"""DXF entities, and the forms that they are read into, each in the coordinates that its file gives it in.

Lines and arcs of ellipses in space, as rows of numbers that any map of a block keeps: what entities are read into.

An arc of an ellipse or a circle is ``center + major·cos t + minor·sin t`` for t from `BEGIN` over `SWEEP`; major and
minor are conjugate half-axes. A map moves the centre and turns and stretches the half-axes, and t stays.

Where an entity is, of whatever kind, so that people find it in the drawing.

The numbers of a SPLINE, looked at before a curve is made of them: what is wrong with one is said.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, cast

import numpy as np
from ezdxf.entities.boundary_paths import LineEdge, PolylinePath
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.hatch import Hatch
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.entities.polyline import Polyline
from ezdxf.entities.spline import Spline as DXFSpline
from ezdxf.math import OCS, Matrix44, Vec3
from numpy.typing import NDArray

from parser.findings.catalogue import Remark
from parser.geometry.curves import Floats
from parser.text.encoding import printable

START, END, CENTER, MAJOR, MINOR = (slice(at, at + 3) for at in range(0, 15, 3))
BEGIN, SWEEP = 15, 16
COLUMNS = 17
_STRAIGHT = 1e-12  # a bulge over 10 km of chord is then 0.005 µm; R = chord / (4 bulge) overflows far below
_FULL_WITHIN_RAD = 1e-6  # files print angles to six digits and more


class Spline(NamedTuple):
    """A B-spline: control points (c, 3), their weights (c,), knots (c + degree + 1,)."""

    control: Floats
    weight: Floats
    knot: Floats
    degree: int


class ReadEntity(NamedTuple):
    """What an entity holds: forms (k, 17) in its own coordinates, and the map from these to its block, if any."""

    forms: Floats | Spline
    own: Floats | None = None


class WrongNumbersError(Exception):
    """Raised with a `Remark` on what is wrong with the numbers of an entity."""

    def __init__(self, remark: Remark) -> None:
        super().__init__(remark.name)
        self.remark = remark


def wrong(entity: DXFEntity, name: str, **values: int) -> WrongNumbersError:
    """What is wrong with an entity, told by its kind and handle."""
    return WrongNumbersError(
        Remark(name, {"entity": printable(f"{entity.dxftype()} {entity.dxf.get('handle', '')}".strip()), **values})
    )


def line_forms(place: Floats) -> Floats:
    """Lines (k, 17) from each of places (k + 1, 3) to the next."""
    forms = np.full((max(len(place) - 1, 0), COLUMNS), np.nan)
    forms[:, START], forms[:, END], forms[:, SWEEP] = place[:-1], place[1:], 0.0
    return forms


def ellipse_form(center: Floats, major: Floats, minor: Floats, begin_rad: float, end_rad: float) -> Floats:
    """The arc (1, 17) of an ellipse from one angle counter-clockwise to the other; all round where they are one."""
    sweep = (end_rad - begin_rad) % (2.0 * math.pi)
    sweep = sweep if _FULL_WITHIN_RAD < sweep < 2.0 * math.pi - _FULL_WITHIN_RAD else 2.0 * math.pi
    begin = center + major * math.cos(begin_rad) + minor * math.sin(begin_rad)
    last = begin_rad + sweep
    end = begin if sweep == 2.0 * math.pi else center + major * math.cos(last) + minor * math.sin(last)
    return np.concatenate([begin, end, center, major, minor, (begin_rad, sweep)])[None, :]


def circle_form(center: Floats, radius: float, begin_rad: float, end_rad: float) -> Floats:
    """The arc (1, 17) of a circle in the plane of X and Y."""
    return ellipse_form(center, np.array([radius, 0.0, 0.0]), np.array([0.0, radius, 0.0]), begin_rad, end_rad)


def polyline_forms(place: Floats, bulge: Floats, closed: bool) -> Floats:
    """Lines and arcs (k, 17) between places (n, 3); a closed polyline runs back to its first place.

    The bulge (n,) of a segment is the tangent of a quarter of the angle that it turns, positive counter-clockwise
    (DXF reference, LWPOLYLINE, group code 42).
    """
    if closed:
        place = np.concatenate([place, place[:1]])
    forms = line_forms(place)
    bulge = bulge[: len(forms)]
    chord = forms[:, END] - forms[:, START]
    curved = ~(np.abs(bulge) <= _STRAIGHT) & chord[:, :2].any(axis=1)
    _bend(forms, chord, bulge, curved)
    return forms


def _bend(forms: Floats, chord: Floats, bulge: Floats, curved: NDArray[np.bool_]) -> None:
    """Make arcs of the lines that are curved: half the chord is R·sin(2·atan b), which is R·2b / (1 + b²)."""
    bulge, chord = bulge[curved], chord[curved]
    across = np.stack([-chord[:, 1], chord[:, 0], np.zeros(len(chord))], axis=1)
    center = 0.5 * (forms[curved, START] + forms[curved, END]) + across * ((1.0 - bulge**2) / (4.0 * bulge))[:, None]
    radius = np.hypot(chord[:, 0], chord[:, 1]) * (1.0 + bulge**2) / (4.0 * np.abs(bulge))
    out = forms[curved, START] - center
    forms[curved, CENTER] = center
    forms[curved, MAJOR] = radius[:, None] * (1.0, 0.0, 0.0)
    forms[curved, MINOR] = radius[:, None] * (0.0, 1.0, 0.0)
    forms[curved, BEGIN] = np.arctan2(out[:, 1], out[:, 0])
    forms[curved, SWEEP] = 4.0 * np.arctan(bulge)


def scaled(factor: float) -> Floats:
    """The map that multiplies all lengths."""
    return np.vstack([factor * np.eye(3), np.zeros(3)])


def of_insert(matrix: Matrix44) -> Floats:
    """The map from a block to where an INSERT places it."""
    return np.array(list(matrix)).reshape(4, 4)[:, :3]


def of_extrusion(extrusion: Vec3) -> Floats | None:
    """The map from the coordinates of an entity with an extrusion to the world's; None where they are the same.

    The axes are as the DXF reference's arbitrary axis algorithm has them.
    """
    system = OCS(extrusion)
    if not system.transform:
        return None
    return np.array([*(tuple(axis) for axis in (system.ux, system.uy, system.uz)), (0.0, 0.0, 0.0)])


def behind(inner: Floats, outer: Floats) -> Floats:
    """The map that goes by `inner` first and by `outer` then."""
    return np.vstack([inner[:3] @ outer[:3], inner[3] @ outer[:3] + outer[3]])


# The attributes that tell of a place, the first one that an entity has.
_PLACES = ("insert", "location", "start", "center", "defpoint", "vtx0", "insert_point")
# Kinds whose places are given in their own coordinates, by the DXF reference; those of the others are the world's.
_OWN = frozenset(
    (
        "TEXT",
        "ATTDEF",
        "ATTRIB",
        "SHAPE",
        "INSERT",
        "SOLID",
        "TRACE",
        "CIRCLE",
        "ARC",
        "LWPOLYLINE",
        "POLYLINE",
        "HATCH",
    )
)


def place_of(entity: DXFEntity, place: Floats) -> tuple[float, float] | None:
    """A place on an entity, or at its centre, in µm by its map (4, 3); None where it has none that is a number."""
    try:
        at = _place(entity)
        own = of_extrusion(Vec3(entity.dxf.get("extrusion", (0, 0, 1)))) if entity.dxftype() in _OWN else None
        at = np.array(tuple(Vec3(at))) if own is None else np.array(tuple(Vec3(at))) @ own[:3]
        x, y, _ = (at @ place[:3] + place[3]).tolist()
    except Exception:  # damaged numbers, or none
        return None
    return (x, y) if np.isfinite((x, y)).all() else None


def _place(entity: DXFEntity) -> Any:
    first = _FIRST.get(entity.dxftype())
    if first is not None:
        return first(entity)
    return next(entity.dxf.get(name) for name in _PLACES if entity.dxf.hasattr(name))


def _of_hatch(entity: DXFEntity) -> Any:
    path: Any = cast("Hatch", entity).paths.paths[0]
    if isinstance(path, PolylinePath):
        return path.vertices[0][:2]
    edge = path.edges[0]
    return edge.start if isinstance(edge, LineEdge) else edge.center


_FIRST: Mapping[str, Callable[[Any], Any]] = {
    "LWPOLYLINE": lambda entity: entity.lwpoints.values[:2],
    "POLYLINE": lambda entity: entity.vertices[0].dxf.location,
    "SPLINE": lambda entity: (entity.control_points if len(entity.control_points) else entity.fit_points)[0],
    "LEADER": lambda entity: entity.vertices[0],
    "HATCH": _of_hatch,
    "MESH": lambda entity: entity.vertices[0],
    "MLINE": lambda entity: entity.vertices[0].location,
}


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
    return _um_place(_number_of(entity, "center", 10)), abs(_number_of(entity, "radius", 40))


def _ellipse(entity: DXFEntity) -> ReadEntity:
    major, normal = Vec3(_number_of(entity, "major_axis", 11)), Vec3(entity.dxf.extrusion).normalize()
    minor = normal.cross(major) * _number_of(entity, "ratio", 40)
    place = _um_place(_number_of(entity, "center", 10))
    return ReadEntity(
        ellipse_form(place, _um_place(major), _um_place(minor), entity.dxf.start_param, entity.dxf.end_param)
    )


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


def _um_place(point: Vec3) -> Floats:
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
