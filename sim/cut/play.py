"""How far a piece that is free can move in its opening, and whether it pinches the wire.

When outlines that move come into touch, exact between polygons.

When two polygons come into touch, a corner of one meets a side of the other. Where it meets the side is known in closed
form, for a shift and for a turn. A physics engine would let them overlap a little first.
"""

import math
from typing import Final, NamedTuple

import numpy as np
import shapely
from shapely import ops
from shapely.geometry.base import BaseGeometry

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Floats, Ints
from parser.toolpath import Point
from sim.cut.pieces.pieces import Piece, Pieces
from sim.cut.walls import SIMPLER_UM, Room, Walls, room_of, walls_of


class Sides(NamedTuple):
    """Sides of outlines, from (m, 2) to (m, 2) µm; each start is a corner."""

    start: Floats
    end: Floats


class Contact(NamedTuple):
    """How far something moves until it touches, µm or rad, and where; infinite and NaN where nothing is in the way."""

    by: float
    place_um: Point


class _First(NamedTuple):
    """How far the first corner is from a side, and which corner."""

    by: float
    corner: Floats


def sides_of(lines_um: BaseGeometry) -> Sides:
    """All sides of lines and rings."""
    points, line = shapely.get_coordinates(shapely.get_parts(lines_um), return_index=True)
    same = np.flatnonzero((line[1:] == line[:-1]) & (points[1:] != points[:-1]).any(axis=1))
    return Sides(points[same], points[same + 1])


def shifted_until(moving: Sides, standing: Sides, toward_rad: Floats) -> list[Contact]:
    """How far `moving` shifts in each of some directions (d,) until it touches `standing`."""
    u = np.stack([np.cos(toward_rad), np.sin(toward_rad)], axis=1)
    there, back = _first_ahead(moving, standing, u), _first_ahead(standing, moving, -u)
    contacts = []
    for ahead, behind, way in zip(there, back, u, strict=True):
        if behind.by < ahead.by:
            contacts.append(_touch(behind.by, behind.corner))
        else:
            contacts.append(_touch(ahead.by, ahead.corner + np.where(np.isfinite(ahead.by), ahead.by, np.nan) * way))
    return contacts


def turned_until(moving: Sides, standing: Sides, about_um: Floats, sense: int) -> Contact:
    """Angle by which `moving` turns about a place until it touches `standing`; a sense of +1 is counter-clockwise."""
    there, back = _first_round(moving, standing, about_um, sense), _first_round(standing, moving, about_um, -sense)
    if back.by < there.by:
        return _touch(back.by, back.corner)
    angle = sense * there.by if np.isfinite(there.by) else np.nan
    turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return _touch(there.by, about_um + turned @ (there.corner - about_um))


def _touch(by: float, place: Floats) -> Contact:
    return Contact(by, Point(*place.tolist()))


def _first_ahead(of: Sides, sides: Sides, u: Floats) -> list[_First]:
    """The first corner to meet a side as all shift in each of the directions u (d, 2)."""
    seen = np.stack([u, np.stack([-u[:, 1], u[:, 0]], axis=1)], axis=2)  # along u, and across it
    by, at = np.empty(len(u)), np.empty(len(u), dtype=np.int64)
    _find_first_ahead(of.start @ seen, sides.start @ seen, sides.end @ seen, by, at)
    found = zip(by.tolist(), at.tolist(), strict=True)
    return [_First(way, of.start[corner] if corner >= 0 else np.full(2, np.nan)) for way, corner in found]


def _first_round(of: Sides, sides: Sides, about_um: Floats, sense: int) -> _First:
    """The first corner to meet a side as all turn about a place."""
    by, at = _round(of.start - about_um, sides.start - about_um, sides.end - sides.start, float(sense))
    return _First(by, of.start[at] if at >= 0 else np.full(2, np.nan))


@loop_part("Tuple((f8, i8))(f8[:,::1], f8[:,::1], f8[:,::1])")
def _ahead(corner: Floats, start: Floats, end: Floats) -> tuple[float, int]:
    """The shortest way along the first axis from a corner (c, 2) to a side (m, 2), and which corner; inf and −1."""
    least, first = np.inf, -1
    for c in range(corner.shape[0]):
        level = corner[c, 1]
        for s in range(start.shape[0]):
            # Few sides cross the level of a corner. A side along it crosses none, but it ends at sides that do.
            if (start[s, 1] <= level) != (end[s, 1] <= level):
                share = (level - start[s, 1]) / (end[s, 1] - start[s, 1])
                ahead = start[s, 0] + share * (end[s, 0] - start[s, 0]) - corner[c, 0]
                if 0.0 <= ahead < least:
                    least, first = ahead, c
    return least, first


@compiled("void(f8[:,:,::1], f8[:,:,::1], f8[:,:,::1], f8[::1], i8[::1])")
def _find_first_ahead(corner: Floats, start: Floats, end: Floats, by: Floats, at: Ints) -> None:
    """Fill in what `_ahead` gives in each of d directions, as corners (d, c, 2) and sides (d, m, 2) are seen there."""
    for each in range(corner.shape[0]):
        by[each], at[each] = _ahead(corner[each], start[each], end[each])


@compiled("Tuple((f8, i8))(f8[:,::1], f8[:,::1], f8[:,::1], f8)")
def _round(corner: Floats, start: Floats, by: Floats, sense: float) -> tuple[float, int]:
    """The least angle about (0, 0) from a corner (c, 2) to a side (m, 2), and which corner; inf and −1.

    A side meets the circle of a corner where its own distance from (0, 0) is the radius: at up to two places.
    """
    least, first = np.inf, -1
    for s in range(start.shape[0]):
        x, y, by_x, by_y = start[s, 0], start[s, 1], by[s, 0], by[s, 1]
        square = by_x * by_x + by_y * by_y
        foot = -(x * by_x + y * by_y) / square
        inside = min(max(foot, 0.0), 1.0)
        nearest = (x + inside * by_x) ** 2 + (y + inside * by_y) ** 2
        farthest = max(x * x + y * y, (x + by_x) ** 2 + (y + by_y) ** 2)
        apart = (x + foot * by_x) ** 2 + (y + foot * by_y) ** 2
        for c in range(corner.shape[0]):
            radius = corner[c, 0] ** 2 + corner[c, 1] ** 2
            if nearest <= radius <= farthest:
                half = np.sqrt(max(radius - apart, 0.0) / square)
                angle = np.arctan2(corner[c, 1], corner[c, 0])
                for share in (foot - half, foot + half):
                    if 0.0 <= share <= 1.0:
                        there = np.arctan2(y + share * by_y, x + share * by_x)
                        turn = np.mod(sense * (there - angle), 2.0 * np.pi)
                        if turn < least:
                            least, first = turn, c
    return least, first


_TOWARD_DEG: Final = np.linspace(0.0, 360.0, 16, endpoint=False)
_CORNERS = 1000  # an outline with more is simplified by twice as much, and so on
_COARSEST_UM = 8.0
_NEAR_UM = 1000.0  # walls are looked at in a box so much larger than the piece, then farther on its ways
_FARTHER = 4.0  # times
_STANDING = 0.9  # of the pieces: once fewer stand than that, those that have gone are no longer looked through


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
    walls, plays, standing = walls_of(pieces), list[Play](), len(pieces.freed)
    for piece in pieces.freed:
        left = len(pieces.freed) - len(plays)
        if left < _STANDING * standing:
            walls, standing = walls.since(piece.freed.t_s), left
        plays.append(_play(walls, piece, wire_radius_um))
    return tuple(plays)


def _play(walls: Walls, piece: Piece, wire_radius_um: float) -> Play:
    """Play of one piece: between the walls near it, and as far as it meets none of these, between those on its way.

    No corner leaves its circle about the centre of gravity in a turn, and the room holds all of them.
    """
    outline, wire = shapely.Polygon(piece.outline_um.exterior), piece.freed.wire_um
    room = room_of(walls, outline, wire, piece.freed.t_s)
    scene, far_um = _scene_near(room, outline, wire)
    shifts, exact_to_um = _shifts(scene, _TOWARD_DEG), scene.exact_to_um
    while math.isfinite(far_um):
        free = [at for at, shift in enumerate(shifts) if shift.by_um + exact_to_um >= far_um]
        if not free:
            break
        far_um *= _FARTHER
        ahead, is_all = room.ahead(_TOWARD_DEG[free], far_um)
        farther = scene.between(*_coarse(ahead, SIMPLER_UM))
        exact_to_um = max(exact_to_um, farther.exact_to_um)
        found = dict(zip(free, _shifts(farther, _TOWARD_DEG[free]), strict=True))
        shifts = tuple(found.get(at, shift) for at, shift in enumerate(shifts))
        far_um = math.inf if is_all else far_um
    return _play_of(scene, shifts, exact_to_um, wire, wire_radius_um)


def _scene_near(room: Room, outline: shapely.Polygon, wire_um: Point) -> tuple["_Scene", float]:
    """A piece between the walls near it, among which is the one nearest to the wire; how far off they are looked for.

    That is infinite where there are no others.
    """
    edge, far_um = _coarse(outline.exterior), _NEAR_UM
    while True:
        near, is_all = room.within(far_um)
        if is_all or not near.is_empty:
            scene = _scene_of(edge, _coarse(near, SIMPLER_UM), outline)
            if is_all or shapely.distance(scene.walls, shapely.Point(wire_um)) + scene.exact_to_um < far_um:
                return scene, math.inf if is_all else far_um
        far_um *= _FARTHER


def play_between(
    outline_um: shapely.Polygon, walls_um: BaseGeometry, wire_um: Point, wire_radius_um: float, walls_to_um: float = 0.0
) -> Play:
    """Play of an outline without holes between walls, with a wire beside it.

    The walls are lines, which lie within `walls_to_um` of the real ones.
    """
    scene = _scene_of(_coarse(outline_um.exterior), _coarse(walls_um, walls_to_um), outline_um)
    return _play_of(scene, _shifts(scene, _TOWARD_DEG), scene.exact_to_um, wire_um, wire_radius_um)


def _play_of(
    scene: "_Scene", shifts: tuple[Shift, ...], exact_to_um: float, wire_um: Point, wire_radius_um: float
) -> Play:
    turns = _turn(scene, 1), _turn(scene, -1)
    return Play(shifts, turns, _pinch(scene, wire_um, wire_radius_um, shifts, turns), exact_to_um)


class _Coarse(NamedTuple):
    """Lines with fewer corners, and how far they are from the real ones, µm."""

    lines_um: BaseGeometry
    exact_to_um: float


class _Scene(NamedTuple):
    """The piece's edge and the walls, as lines and as their sides; the centre of gravity that the piece turns about.

    Edge and walls together lie within `exact_to_um` of the real ones.
    """

    edge: _Coarse
    moving: Sides
    walls: BaseGeometry
    standing: Sides
    about_um: Floats
    exact_to_um: float

    def between(self, walls_um: BaseGeometry, exact_to_um: float) -> "_Scene":
        """The same piece between other walls."""
        return self._replace(
            walls=walls_um, standing=sides_of(walls_um), exact_to_um=self.edge.exact_to_um + exact_to_um
        )


def _scene_of(edge: _Coarse, walls: _Coarse, outline_um: shapely.Polygon) -> _Scene:
    center = np.array(outline_um.centroid.coords[0])
    exact_to_um = edge.exact_to_um + walls.exact_to_um
    return _Scene(edge, sides_of(edge.lines_um), walls.lines_um, sides_of(walls.lines_um), center, exact_to_um)


def _coarse(lines_um: BaseGeometry, exact_to_um: float = 0.0) -> _Coarse:
    """Lines, which lie so far from the real ones, with fewer corners."""
    tolerance, lines = SIMPLER_UM, _simplified(lines_um, SIMPLER_UM - exact_to_um)
    while shapely.get_num_coordinates(lines) > _CORNERS and tolerance < _COARSEST_UM:
        tolerance *= 2.0
        lines = _simplified(lines_um, tolerance - exact_to_um)
    return _Coarse(lines, tolerance)


def _simplified(lines_um: BaseGeometry, by_um: float) -> BaseGeometry:
    """Lines simplified one by one: whether they cross each other then does not matter to what touches them."""
    lines: BaseGeometry = shapely.simplify(lines_um, by_um, preserve_topology=False)
    return lines


def _shifts(scene: _Scene, toward_deg: Floats) -> tuple[Shift, ...]:
    """How far the piece shifts in each of some directions (d,)."""
    touches = shifted_until(scene.moving, scene.standing, np.radians(toward_deg))
    found = zip(toward_deg.tolist(), touches, strict=True)
    return tuple(Shift(toward, touch.by, touch.place_um) for toward, touch in found)


def _turn(scene: _Scene, sense: int) -> Turn:
    touch = turned_until(scene.moving, scene.standing, scene.about_um, sense)
    return Turn(sense * float(np.degrees(touch.by)), touch.place_um)


def _pinch(
    scene: _Scene, wire_um: Point, wire_radius_um: float, shifts: tuple[Shift, ...], turns: tuple[Turn, Turn]
) -> Pinch:
    wall = ops.nearest_points(shapely.Point(wire_um), scene.walls)[1]
    wall_um = np.array([wall.x, wall.y])
    nearest = ops.nearest_points(wall, scene.edge.lines_um)[1]
    straight = _shifts(scene, np.array([math.degrees(math.atan2(wall.y - nearest.y, wall.x - nearest.x))]))
    seen = [_seen_after_shift(wall_um, shift) for shift in (*shifts, *straight) if np.isfinite(shift.by_um)]
    seen += [_seen_after_turn(wall_um, turn, scene.about_um) for turn in turns if np.isfinite(turn.by_deg)]
    width = scene.edge.lines_um.distance(wall)
    narrowest = float(shapely.distance(scene.edge.lines_um, shapely.points([wall_um, *seen])).min())
    return Pinch(
        wall_um=Point(wall.x, wall.y),
        width_um=width,
        narrowest_um=narrowest,
        pinches=narrowest < 2.0 * wire_radius_um,
        after_um=max(width - 2.0 * wire_radius_um, 0.0),
    )


def _seen_after_shift(place_um: Floats, shift: Shift) -> Floats:
    """Where a place is, seen from a piece that shifts: the piece stays, and the place moves back."""
    angle = np.radians(shift.toward_deg)
    seen: Floats = place_um - shift.by_um * np.array([np.cos(angle), np.sin(angle)])
    return seen


def _seen_after_turn(place_um: Floats, turn: Turn, about_um: Floats) -> Floats:
    """The same of a piece that turns about a place."""
    angle = np.radians(turn.by_deg)
    x, y = place_um - about_um
    back = np.array([np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x])
    seen: Floats = about_um + back
    return seen
