"""Where an entity is, of whatever kind, so that people find it in the drawing."""

from collections.abc import Callable, Mapping
from typing import Any, cast

import numpy as np
from ezdxf.entities.boundary_paths import LineEdge, PolylinePath
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.hatch import Hatch
from ezdxf.math import Vec3

from parser.drawing.dxf.forms import of_extrusion
from parser.geometry.curves import Floats

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
