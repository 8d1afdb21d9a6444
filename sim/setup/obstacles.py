"""Things in the way: outlines of clamps, of the workpiece and of the wire arm, as scenario and machine files give them.

Clamps and workpiece lie in the program's coordinates, where the wire's centre moves; the arm lies round the wire.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from parser.toolpath import Point
from parser.units import from_mm
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import Name, ValueKind, in_mm, pair_schema
from sim.setup.toml.reader import PLACE_MM, Bound, number, tables

Outline = tuple[Point, ...]
"""Corners of a simple polygon, µm, counter-clockwise; the last side leads back to the first corner."""

POINTS = Bound(3, 100)
APART_UM = 1.0
"""Sides of one outline come no nearer to each other than a step; what does is a slip of the pen."""


class Clamp(NamedTuple):
    """A clamp or fixture beside the path, in the program's coordinates."""

    name: str
    outline_um: Outline


class OutlineMm(ValueKind):
    """An outline, its corners in mm."""

    name = "outline"
    unit = "mm"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> Outline:
        """Its corners, µm."""
        return read_outline(table, where, key)

    def written(self, value: Any) -> list[list[float]]:
        """A list of its corners."""
        return [[in_mm(corner.x), in_mm(corner.y)] for corner in value]

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"type": "array", "minItems": 3, "items": pair_schema(PLACE_MM)}


CLAMPS = Section(
    "clamps",
    (Key("name", Name(), default=None), Key("outline_mm", OutlineMm(), "outline_um")),
    fills="clamps",
    form="list",
)
ARM = Section("arm", (Key("outline_mm", OutlineMm(), "arm_um"),))


def read_clamps(scenario: Mapping[str, Any], where: str) -> tuple[Clamp, ...]:
    """Tables ``[[clamps]]`` of a scenario, none where they are left out. SettingsError names file, clamp and key."""
    return tuple(
        _clamp(table, at, f"{where}: {CLAMPS.header} {at}")
        for at, table in enumerate(tables(scenario, "clamps", where), start=1)
    )


def _clamp(table: Mapping[str, Any], at: int, where: str) -> Clamp:
    value = CLAMPS.read(table, where)
    return Clamp(name=value.pop("name") or f"clamp {at}", **value)


def read_outline(table: Mapping[str, Any], where: str, key: str = "outline_mm") -> Outline:
    """Outline of a key. SettingsError where it is missing or no simple polygon."""
    if key not in table:
        raise SettingsError("key-missing", where=where, key=key)
    where, value = f"{where}: {key}", table[key]
    if not isinstance(value, list) or not all(isinstance(point, list) and len(point) == 2 for point in value):
        raise SettingsError("no-list-of-points", where=where, found=value)
    number(len(value), POINTS, f"{where}: the number of points")
    corners = from_mm(np.array([_place(point, f"{where}: point {at}") for at, point in enumerate(value, start=1)]))
    _refuse_tangled(corners, where)
    if _area_um2(corners) < 0.0:
        corners = corners[::-1]
    return tuple(Point(x, y) for x, y in corners.tolist())


def _place(point: list[object], where: str) -> tuple[float, float]:
    x, y = (number(value, PLACE_MM, f"{where}: {axis}") for value, axis in zip(point, "xy", strict=True))
    return x, y


def _area_um2(corners: Floats) -> float:
    """Area of a polygon (n, 2), negative where it runs clockwise; taken from its first corner to lose no digits."""
    x, y = (corners - corners[0]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0


def _refuse_tangled(corners: Floats, where: str) -> None:
    """SettingsError where sides of a polygon (n, 2) cross, touch or fold back."""
    if (corners[0] == corners[-1]).all():
        raise SettingsError("outline-closed-twice", where=where)
    for side, point in np.argwhere(_distances_um(corners) < APART_UM).tolist():
        raise SettingsError("outline-touches-itself", where=where, point=point + 1, side=side + 1, apart_um=APART_UM)
    for this, other in np.argwhere(_crossings(corners)).tolist():
        raise SettingsError("outline-crosses-itself", where=where, one=this + 1, other=other + 1)


def _distances_um(corners: Floats) -> Floats:
    """Distance (n, n) of each corner (column) from each side (row); infinite from the two sides that it ends."""
    side = np.roll(corners, -1, axis=0) - corners
    to = corners[None, :] - corners[:, None]
    square = np.maximum((side**2).sum(axis=1), np.finfo(np.float64).tiny)
    share = np.clip((to * side[:, None]).sum(axis=2) / square[:, None], 0.0, 1.0)
    off = to - share[..., None] * side[:, None]
    distance: Floats = np.hypot(off[..., 0], off[..., 1])
    own = np.eye(len(corners), dtype=np.bool_)
    distance[own | np.roll(own, 1, axis=1)] = np.inf
    return distance


def _crossings(corners: Floats) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Whether side and side (n, n) cross: each has its ends on both hands of the other."""
    side = np.roll(corners, -1, axis=0) - corners
    to = corners[None, :] - corners[:, None]
    hand = np.sign(side[:, None, 0] * to[..., 1] - side[:, None, 1] * to[..., 0])
    apart = hand * np.roll(hand, -1, axis=1) < 0.0
    return np.logical_and(apart, apart.T)
