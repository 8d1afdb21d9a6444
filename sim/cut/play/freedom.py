"""How far a piece that is free can move in its opening, and whether it pinches the wire."""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import affinity, ops
from shapely.geometry.base import BaseGeometry

from parser.geometry.curves import Floats
from parser.toolpath import Point
from sim.cut.pieces.pieces import Pieces
from sim.cut.play.touching import Sides, shifted_until, sides_of, turned_until
from sim.cut.regions import union_all

_DIRECTIONS = 16
_COARSE_UM = 0.5  # outlines are simplified by this, then by twice as much, until few corners are left
_CORNERS = 1000
_COARSEST_UM = 8.0


class Shift(NamedTuple):
    """How far a piece shifts in a direction until it touches, and where; infinite where nothing is in the way."""

    toward_deg: float
    by_um: float
    touches_um: Point


class Turn(NamedTuple):
    """How far a piece turns about its centre of gravity until it touches, and where; infinite where nothing does.

    `by_deg` is positive counter-clockwise.
    """

    by_deg: float
    touches_um: Point


class Pinch(NamedTuple):
    """What a free piece may do to the wire that stands where it freed the piece.

    Attributes
    ----------
    wall_um
        The place on the walls round the piece that is nearest to the wire.
    width_um
        From there to the piece as it was cut.
    narrowest_um
        The same after the shift or the turn that narrows it most.
    pinches
        Whether the wire is wider than that.
    after_um
        How far the piece must come toward the wall to hold the wire.
    """

    wall_um: Point
    width_um: float
    narrowest_um: float
    pinches: bool
    after_um: float


class Play(NamedTuple):
    """How a free piece can move: shifts in 16 directions, turns to both sides, and whether it pinches the wire.

    The outlines it is measured on lie within `exact_to_um` of the real ones.
    """

    shifts: tuple[Shift, ...]
    turns: tuple[Turn, Turn]
    pinch: Pinch
    exact_to_um: float


def plays_of(pieces: Pieces, wire_radius_um: float) -> tuple[Play, ...]:
    """Play of each piece when it comes free, between the frame and the pieces that come free later.

    Holes in a piece are filled: what came free inside it moves with it.
    """
    if not pieces.freed:
        return ()
    rooms = _rooms(pieces)
    filled = [shapely.Polygon(piece.outline_um.exterior) for piece in pieces.freed]
    return tuple(
        play_between(outline, _walls(rooms, outline, piece.freed.t_s), piece.freed.wire_um, wire_radius_um)
        for piece, outline in zip(pieces.freed, filled, strict=True)
    )


def play_between(outline_um: shapely.Polygon, walls_um: BaseGeometry, wire_um: Point, wire_radius_um: float) -> Play:
    """Play of an outline without holes between walls, which are lines, with a wire beside it."""
    (edge, from_edge), (walls, from_walls) = _coarse(outline_um.exterior), _coarse(walls_um)
    scene = _Scene(edge, sides_of(edge), walls, sides_of(walls), outline_um.centroid)
    shifts = tuple(_shift(scene, angle) for angle in np.arange(_DIRECTIONS) * (360.0 / _DIRECTIONS))
    turns = _turn(scene, 1), _turn(scene, -1)
    return Play(shifts, turns, _pinch(scene, wire_um, wire_radius_um, shifts, turns), from_edge + from_walls)


class _Rooms(NamedTuple):
    """The rings of frame and pieces, each filled, in a tree; and the time (r,) until which each of them stands, s."""

    tree: shapely.STRtree
    until_s: Floats


def _rooms(pieces: Pieces) -> _Rooms:
    frame = pieces.frame
    standing = frame.openings_um if frame.outline_um is None else (frame.outline_um,)
    rings, of = shapely.get_rings([*standing, *(piece.outline_um for piece in pieces.freed)], return_index=True)
    until = np.array([*(np.inf for _ in standing), *(piece.freed.t_s for piece in pieces.freed)])
    return _Rooms(shapely.STRtree(list(map(shapely.Polygon, rings))), until[of])


def _walls(rooms: _Rooms, filled: shapely.Polygon, t_s: float) -> BaseGeometry:
    """Rings that still stand round an outline after a time: in the smallest ring that holds it, or all if none does."""
    polygons = rooms.tree.geometries
    holding = rooms.tree.query(filled, predicate="within")
    holding = holding[rooms.until_s[holding] > t_s]
    opening = min(polygons[holding].tolist(), key=lambda one: one.area, default=None)
    near = np.arange(len(polygons)) if opening is None else rooms.tree.query(opening, predicate="intersects")
    walls = polygons[near[rooms.until_s[near] > t_s]]
    walls = walls[~shapely.contains(filled, walls) & ~shapely.contains_properly(walls, opening)]
    return union_all(shapely.boundary(walls))


class _Scene(NamedTuple):
    """The piece's edge and the walls, as lines and as their sides; the centre of gravity that the piece turns about."""

    edge: BaseGeometry
    moving: Sides
    walls: BaseGeometry
    standing: Sides
    about: shapely.Point


def _coarse(lines_um: BaseGeometry) -> tuple[BaseGeometry, float]:
    """Lines with fewer corners, and how far they are from the real ones."""
    tolerance, lines = _COARSE_UM, shapely.simplify(lines_um, _COARSE_UM)
    while shapely.get_num_coordinates(lines) > _CORNERS and tolerance < _COARSEST_UM:
        tolerance *= 2.0
        lines = shapely.simplify(lines_um, tolerance)
    return lines, tolerance


def _shift(scene: _Scene, toward_deg: float) -> Shift:
    touch = shifted_until(scene.moving, scene.standing, np.radians(toward_deg))
    return Shift(toward_deg, touch.by, touch.place_um)


def _turn(scene: _Scene, sense: int) -> Turn:
    about = np.array([scene.about.x, scene.about.y])
    touch = turned_until(scene.moving, scene.standing, about, sense)
    return Turn(sense * float(np.degrees(touch.by)), touch.place_um)


def _pinch(
    scene: _Scene, wire_um: Point, wire_radius_um: float, shifts: tuple[Shift, ...], turns: tuple[Turn, Turn]
) -> Pinch:
    wall = ops.nearest_points(shapely.Point(wire_um), scene.walls)[1]
    beside = ops.nearest_points(wall, scene.edge)[1]
    straight = _shift(scene, float(np.degrees(np.arctan2(wall.y - beside.y, wall.x - beside.x))))
    poses = [_shifted(scene.edge, shift) for shift in (*shifts, straight) if np.isfinite(shift.by_um)]
    poses += [affinity.rotate(scene.edge, turn.by_deg, scene.about) for turn in turns if np.isfinite(turn.by_deg)]
    width = scene.edge.distance(wall)
    narrowest = min([width, *(pose.distance(wall) for pose in poses)])
    return Pinch(
        wall_um=Point(wall.x, wall.y),
        width_um=width,
        narrowest_um=narrowest,
        pinches=narrowest < 2.0 * wire_radius_um,
        after_um=max(width - 2.0 * wire_radius_um, 0.0),
    )


def _shifted(edge: BaseGeometry, shift: Shift) -> BaseGeometry:
    angle = np.radians(shift.toward_deg)
    return affinity.translate(edge, shift.by_um * np.cos(angle), shift.by_um * np.sin(angle))
