"""Points and circles of a drawing, which may be thread points."""

from collections.abc import Sequence

import numpy as np
from ezdxf.math import Vec3

from parser.drawing.dxf.blocks import Placed
from parser.drawing.dxf.forms import behind, of_extrusion
from parser.drawing.model import Mark
from parser.drawing.plane.flat import FARTHEST_UM
from parser.geometry.curves import Floats
from parser.text.encoding import printable

_AT = {"POINT": "location", "CIRCLE": "center"}


def marks_of(placed: Sequence[Placed]) -> tuple[Mark, ...]:
    """Marks in file order, of all layers; circles that are stretched by their block count by their width in X."""
    found = [one for one in placed if one.entity.dxftype() in _AT]
    centers, radii = np.full((len(found), 3), np.nan), np.zeros((len(found), 3))
    maps: list[Floats] = []
    which, known = np.zeros(len(found), dtype=np.int64), dict[tuple[int, bytes], int]()
    for row, one in enumerate(found):
        try:
            centers[row], radii[row, 0], own = _numbers(one)
        except Exception:  # damaged numbers; the entity is told of where it is read  # noqa: S112
            continue
        key = (id(one.place), b"" if own is None else own.tobytes())
        if key not in known:
            known[key] = len(maps)
            maps.append(one.place if own is None else behind(own, one.place))
        which[row] = known[key]
    return _marks(found, centers, radii, np.array(maps).reshape(-1, 4, 3)[which] if maps else np.zeros((0, 4, 3)))


def _numbers(placed: Placed) -> tuple[tuple[float, float, float], float, Floats | None]:
    """Centre and radius of a mark, and the map from its own coordinates, if any."""
    kind, dxf = placed.entity.dxftype(), placed.entity.dxf
    x, y, z = dxf.get(_AT[kind])
    if kind == "POINT":
        return (x, y, z), 0.0, None
    return (x, y, z), abs(dxf.radius), of_extrusion(Vec3(dxf.extrusion))


def _marks(found: Sequence[Placed], centers: Floats, radii: Floats, maps: Floats) -> tuple[Mark, ...]:
    places = np.einsum("ki,kij->kj", centers, maps[:, :3]) + maps[:, 3] if len(maps) else centers
    radius = np.hypot(*np.einsum("ki,kij->kj", radii, maps[:, :3])[:, :2].T) if len(maps) else radii[:, 0]
    near = np.flatnonzero((np.abs(places[:, :2]) <= FARTHEST_UM).all(axis=1))
    columns = zip(places[near].tolist(), radius[near].tolist(), near.tolist(), strict=True)
    return tuple(Mark((x, y), printable(found[row].layer), r_um) for (x, y, _), r_um, row in columns)
