"""What an offset path does to the part: gouges that it cuts, and material that it leaves.

Gouges: where the wire's path comes nearer to a contour than the offset, and so cuts into it.

Where a path comes closest to the curves near it, each pair in closed form.

What a path leaves: material between the contour and the kerf, where blocks have no place on the path.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.shifted import Side
from controller.offset.slices import groups
from parser.geometry.along import along_um, directions, headings_along, places_at, to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import by_xy, curves_meet, distance_to_curves
from parser.geometry.near import near_curves, near_places, nearest_um
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.toolpath import Point


class Approaches(NamedTuple):
    """Places of a path and the curves that they lie near, k of them in no order.

    Attributes
    ----------
    path_row, row
        (k,) row of the path, row of the curve.
    place_um
        (k, 2) on the path.
    distance_um
        (k,) from the curve.
    """

    path_row: Ints
    row: Ints
    place_um: Floats
    distance_um: Floats

    def take(self, at: Ints) -> "Approaches":
        """Those at the indices `at`."""
        return Approaches(self.path_row[at], self.row[at], self.place_um[at], self.distance_um[at])


def approaches(curves: Curves, path: Curves, below_um: float) -> Approaches:
    """Wherever the distance between a row of the path and a curve is extreme, and below a limit.

    The distance is extreme at the ends of either, where the two cross, and where they have a normal in common.
    """
    near = near_curves(curves, path, below_um)
    return approaches_of(curves, path, near.other, near.row, below_um)


def approaches_of(curves: Curves, path: Curves, own: Ints, row: Ints, below_um: float) -> Approaches:
    """As `approaches`, of rows `own` (m,) of the path and rows `row` (m,) of the curves, pair by pair."""
    found = [(own, row, places_at(path, own, share * path.length_um[own])) for share in (0.0, 1.0)]
    feet = [along_um(path, own, end[row]) for end in (curves.start_um, curves.end_um)]
    # Where the two run parallel every place is extreme: the middle one stands for all.
    found += [(own, row, places_at(path, own, along)) for along in (*feet, 0.5 * (feet[0] + feet[1]))]
    found += [_crossings(curves, path, own, row), *_common_normals(curves, path, own, row)]
    path_row, row, place = (np.concatenate(column) for column in zip(*found, strict=True))
    distance, _ = distance_to_curves(curves, row, place[:, 0], place[:, 1])
    close = np.flatnonzero(distance < below_um)
    return Approaches(path_row, row, place, distance).take(close)


_Places = tuple[Ints, Ints, Floats]  # rows of the path and of the curves, and places on the path


def _nearest_places(path: Curves, own: Ints, place_um: Floats) -> Floats:
    """Places of the path's rows that are nearest to the places (k, 2)."""
    return places_at(path, own, along_um(path, own, place_um))


def _crossings(curves: Curves, path: Curves, own: Ints, row: Ints) -> _Places:
    """Where rows of the path cross curves. A crossing beyond a row's end is moved to the end, a true place as well."""
    meets = curves_meet(joined([path.picked(slice(None)), curves.picked(slice(None))]), own, len(path) + row, 0.0)
    return meets.early, meets.late - len(path), _nearest_places(path, meets.early, meets.place_um)


def _common_normals(curves: Curves, path: Curves, own: Ints, row: Ints) -> tuple[_Places, ...]:
    """Places whose normal is the curve's too: on a line beside the curve's centre, on an arc both ways from its own."""
    on_line = np.flatnonzero(~path.is_arc[own] & curves.is_arc[row])
    a, b = own[on_line], row[on_line]
    made = [(a, b, _nearest_places(path, a, curves.center_um[b]))]
    on_arc = np.flatnonzero(path.is_arc[own])
    a, b = own[on_arc], row[on_arc]
    way = np.where(curves.is_arc[b][:, None], curves.center_um[b] - path.center_um[a], _across(curves, b))
    length = np.hypot(way[:, 0], way[:, 1])
    way *= (path.radius_um[a] / np.where(length > 0.0, length, np.inf))[:, None]
    made += [(a, b, _nearest_places(path, a, path.center_um[a] + sign * way)) for sign in (1.0, -1.0)]
    return tuple(made)


def _across(curves: Curves, row: Ints) -> Floats:
    return to_left(np.stack(by_xy(curves, row), axis=1))


TOLERANCE_UM = 0.05
"""Less is no fault: a twentieth of a step, and far more than rounding makes of places that should be one."""
_JOINT_UM = 1e-3  # a place this near to an end of a curve lies at its joint with the next one
_EQUAL_UM = 1e-6  # depths this near are one: far above the rounding of places
_WALL_COS = np.cos(np.pi / 4.0)  # blocks that turn by less from one to the next are one wall


class Gouge(NamedTuple):
    """One place where a path cuts into a contour.

    Attributes
    ----------
    path_row, row
        Row of the path that cuts deepest, row of the contour that it cuts into.
    place_um
        On the contour, beside the place of the path that cuts deepest.
    depth_um
        How far the kerf's edge lies beyond the contour: the offset less the distance of the path from the contour. Once
        the path has crossed to the other side, and while no other wall is nearer, it is the offset plus the distance,
        up to twice the offset.
    """

    path_row: int
    row: int
    place_um: Point
    depth_um: float


def gouges(
    contour: Curves, path: Curves, offset_um: float, side: Side, tolerance_um: float = TOLERANCE_UM
) -> tuple[Gouge, ...]:
    """Where a path of the wire's centre on a side of a contour cuts into it by more than a tolerance, along the path.

    What is cut without a break, along the path and along one wall of the contour, makes one gouge.
    """
    close = approaches(contour, path, offset_um - tolerance_um)
    if not len(close.row):
        return ()
    along = along_um(contour, close.row, close.place_um)
    place = places_at(contour, close.row, along)
    depth = offset_um - np.where(_is_across(contour, close, place, side), -1.0, 1.0) * close.distance_um
    pair, of = np.unique(close.path_row * len(contour) + close.row, return_inverse=True)
    at_joint = np.minimum(along, contour.length_um[close.row] - along) < _JOINT_UM
    cut = _Cut(pair, _deepest(depth, of, len(pair)), _deepest(depth[~at_joint], of[~at_joint], len(pair)))
    group = _groups(contour, path, cut, offset_um, tolerance_um)[of]
    keys = (close.row, close.path_row, cut.is_corner[of], -path.length_um[close.path_row], -np.round(depth / _EQUAL_UM))
    order = np.lexsort((*keys, group))
    worst = order[np.diff(group[order], prepend=-1) > 0]
    worst = worst[np.lexsort((close.row[worst], close.path_row[worst]))]
    columns = (column[worst].tolist() for column in (close.path_row, close.row, place, depth))
    return tuple(Gouge(path_row, row, Point(*at), deep) for path_row, row, at, deep in zip(*columns, strict=True))


class _Cut(NamedTuple):
    """Pairs (k,) of rows, in order, as path row × rows of the contour + row.

    How deep each cuts µm, and how deep aside from the ends of the contour's row.
    """

    pair: Ints
    depth_um: Floats
    inner_um: Floats

    @property
    def is_corner(self) -> NDArray[np.bool_]:
        """(k,) True where the contour's row is cut deepest at one of its ends."""
        corner: NDArray[np.bool_] = self.depth_um > self.inner_um + _EQUAL_UM
        return corner


def _deepest(depth_um: Floats, of: Ints, pairs: int) -> Floats:
    result = np.zeros(pairs)
    np.maximum.at(result, of, depth_um)
    return result


def _is_across(contour: Curves, close: Approaches, place_um: Floats, side: Side) -> NDArray[np.bool_]:
    """(k,) True where the path lies on the other side of the curve, and no other curve of the contour is nearer."""
    way = _ways(contour, close.row, along_um(contour, close.row, place_um))
    by = close.place_um - place_um
    is_next = close.distance_um <= nearest_um(contour, close.place_um, float(close.distance_um.max())) + _EQUAL_UM
    across: NDArray[np.bool_] = side * (way[:, 0] * by[:, 1] - way[:, 1] * by[:, 0]) < 0.0
    return is_next & across


def _ways(contour: Curves, row: Ints, length_um: Floats) -> Floats:
    """Directions (k, 2) of a contour, at a joint midway between those of both blocks; not of unit length."""
    whole = contour.length_um[row]
    way = headings_along(contour, row, length_um)
    leaving, arriving = directions(contour)
    gap = contour.start_um - np.roll(contour.end_um, 1, axis=0)
    joined = np.hypot(gap[:, 0], gap[:, 1]) <= CLOSED_WITHIN_UM
    after = (row + 1) % len(contour)
    way += np.where(((length_um < _JOINT_UM) & joined[row])[:, None], arriving[row - 1], 0.0)
    return way + np.where(((length_um > whole - _JOINT_UM) & joined[after])[:, None], leaving[after], 0.0)


def _groups(contour: Curves, path: Curves, cut: _Cut, offset_um: float, tolerance_um: float) -> Ints:
    """(k,) the gouge that each pair of rows belongs to.

    Two rows of the path that follow each other make one gouge in a row of the contour if the joint between them cuts
    into it as well. Two rows of the contour that follow each other are cut in one gouge by a row of the path if it cuts
    into their joint, and if they make one wall, or one of them is cut at this joint and by this row alone.
    """
    rows, below = len(contour), offset_um - tolerance_um
    own, row = np.divmod(cut.pair, rows)
    on, _ = distance_to_curves(contour, row, path.end_um[own, 0], path.end_um[own, 1])
    along_path = _links(cut.pair, cut.pair + rows, on < below)
    alone = cut.is_corner.copy()
    alone[np.concatenate(along_path)] = False
    distance_um, _ = distance_to_curves(path, own, contour.end_um[row, 0], contour.end_um[row, 1])
    after = (row + 1) % rows
    this, other = _links(cut.pair, own * rows + after, distance_um < below)
    leaving, arriving = directions(contour)
    linked = (arriving[row] * leaving[after]).sum(axis=1)[this] > _WALL_COS
    for which in (this, other):
        at_joint = np.abs(np.abs(cut.depth_um[which] - offset_um) - distance_um[this]) <= _EQUAL_UM
        linked |= alone[which] & at_joint
    return groups(len(own), np.append(along_path[0], this[linked]), np.append(along_path[1], other[linked]))


def _links(pair: Ints, wanted: Ints, linked: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """Indices of the linked pairs whose `wanted` neighbour is a pair as well, and of these neighbours."""
    at = np.minimum(np.searchsorted(pair, wanted), len(pair) - 1)
    found = np.flatnonzero(linked & (pair[at] == wanted))
    return found, at[found]


_WITHIN_UM = 0.01  # a hundredth of a step


class _Stretches(NamedTuple):
    """Stretches (m,) of rows, from a length along each to another; pairs (p,) of a stretch and a curve near it."""

    of: Ints
    first_um: Floats
    last_um: Floats
    pair: Ints
    curve: Ints


def uncut_um(contour: Curves, path: Curves, offset_um: float, rows: Ints) -> Floats:
    """Material (k,) µm left at the rows (k,) of a contour: how far at most each lies from the kerf, within 0.01 µm.

    The kerf is what lies within the offset of the path. Where the path has no row with length, the wire stands at
    the begin of the contour (`compensate`).
    """
    most = np.zeros(len(rows))
    if not len(rows):
        return most
    if not path.length_um.any():
        path = _standing(contour)
    on = _whole(contour, path, offset_um, rows)
    while len(on.of):
        half = 0.5 * (on.last_um - on.first_um)
        middle = places_at(contour, rows[on.of], on.first_um + half)
        away, _ = distance_to_curves(path, on.curve, middle[on.pair, 0], middle[on.pair, 1])
        nearest = np.full(len(on.of), np.inf)
        np.minimum.at(nearest, on.pair, away)
        left = nearest - offset_um
        np.maximum.at(most, on.of, left)
        # Distances change by no more than the way between two places.
        may_be_nearest = away <= nearest[on.pair] + 2.0 * half[on.pair]
        on = _halved(on, left + half > most[on.of] + _WITHIN_UM, may_be_nearest)
    return most


def _standing(contour: Curves) -> Curves:
    """The begin of a contour, as a line so short that no figure tells it from a place; curves have length."""
    place = contour.start_um[:1]
    return curves_between(place, place + np.array([0.1 * _WITHIN_UM, 0.0]), np.full((1, 2), np.nan), np.zeros(1))


def _whole(contour: Curves, path: Curves, offset_um: float, rows: Ints) -> _Stretches:
    """The rows as one stretch each."""
    length = contour.length_um[rows]
    middle = places_at(contour, rows, 0.5 * length)
    reach = float((_distance_um(path, middle, 2.0 * offset_um) + length).max())
    near = near_places(path, middle, reach)
    return _Stretches(np.arange(len(rows)), np.zeros(len(rows)), length, near.other, near.row)


def _halved(on: _Stretches, is_open: Bools, may_be_nearest: Bools) -> _Stretches:
    """Both halves of the open stretches, with the curves that may still be the nearest to them."""
    open_ = np.flatnonzero(is_open)
    number = np.full(len(on.of), -1)
    number[open_] = np.arange(len(open_))
    kept_rows = np.flatnonzero(is_open[on.pair] & may_be_nearest)
    pair, curve = number[on.pair[kept_rows]], on.curve[kept_rows]
    of, first, last = on.of[open_], on.first_um[open_], on.last_um[open_]
    middle = 0.5 * (first + last)
    return _Stretches(
        of=np.tile(of, 2),
        first_um=np.concatenate([first, middle]),
        last_um=np.concatenate([middle, last]),
        pair=np.concatenate([pair, pair + len(of)]),
        curve=np.tile(curve, 2),
    )


def _distance_um(path: Curves, place_um: Floats, within_um: float) -> Floats:
    """Distances (m,) of places from the path, looked for farther and farther away."""
    result = nearest_um(path, place_um, within_um)
    far = np.flatnonzero(result > within_um)
    if len(far):
        result[far] = _distance_um(path, place_um[far], 4.0 * within_um)
    return result
