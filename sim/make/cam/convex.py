"""Offsets in closed form: contours that turn one way, joint by joint.

How far curves lie from a contour, all along: in closed form, without samples.

The offset of a contour that turns one way, joint by joint: circles, slots, rectangles, most of what is punched.

Outside of such a contour each curve moves outward as long as it is, with an arc about each corner: no place comes
nearer to another curve. Within it neighbours are shortened to where they meet. If something is left of each curve,
then what they make turns one way too, by one turn. It is the boundary of all places that are the offset away from the
contour, since a convex region is what lies on the inner side of all its tangents, and these are those of the contour,
moved inward. (At a corner the disc about it touches both neighbours, and bends more than either: it crosses neither.)

Where the neighbours of a corner meet when they are prolonged or shortened, and curves ended there.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from controller.offset.reach import OffsetLoop
from controller.offset.shifted import turned_rad
from parser.geometry.along import directions, to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import distance_to_curves, feet, prolonged_meet
from parser.geometry.near import near_curves


class Met(NamedTuple):
    """Where k pairs of curves meet.

    Attributes
    ----------
    place_um
        (k, 2), NaN where they do not.
    on_um, before_um
        (k,) how far the early one runs on behind its end to there, and the late one before its start; negative where
        they are shortened.
    """

    place_um: Floats
    on_um: Floats
    before_um: Floats

    def take(self, at: Bools) -> "Met":
        """Those that are True."""
        return Met(self.place_um[at], self.on_um[at], self.before_um[at])


def met_near(curves: Curves, early: Ints, late: Ints, near_um: Floats) -> Met:
    """Where pairs of rows (k,) meet, prolonged by less than half a turn, nearest to places (k, 2)."""
    places = prolonged_meet(curves, early, late).place_um
    off = np.hypot(*np.moveaxis(places - near_um[:, None], 2, 0))
    second = off[:, 1] < np.where(np.isnan(off[:, 0]), np.inf, off[:, 0])
    place = np.where(second[:, None], places[:, 1], places[:, 0])
    return Met(place, _behind_ends(curves, early, place), _before_starts(curves, late, place))


def with_ends(curves: Curves, start_um: Floats, end_um: Floats) -> Curves:
    """The curves (n,) from and to places (n, 2) on them, or on what they are prolonged to by less than half a turn.

    Arcs keep their circles: a place beside one is taken at its angle.
    """
    by = end_um - start_um
    length = np.hypot(by[:, 0], by[:, 1])
    begin, sweep = curves.start_angle_rad.copy(), curves.sweep_rad.copy()
    arc = np.flatnonzero(curves.is_arc)
    if len(arc):
        sense = np.sign(sweep[arc])
        early = turned_rad(curves, arc, begin[arc], start_um[arc]) * sense
        late = turned_rad(curves, arc, begin[arc] + sweep[arc], end_um[arc]) * sense
        begin[arc] += early
        sweep[arc] += late - early
        length[arc] = curves.radius_um[arc] * np.abs(sweep[arc])
    return replace(curves, start_um=start_um, end_um=end_um, start_angle_rad=begin, sweep_rad=sweep, length_um=length)


def _behind_ends(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    along = _along_chords(curves, row, place_um - curves.end_um[row])
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    at_end = curves.start_angle_rad[on] + curves.sweep_rad[on]
    along[arc] = turned_rad(curves, on, at_end, place_um[arc]) * curves.radius_um[on]
    return along


def _before_starts(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    along = _along_chords(curves, row, curves.start_um[row] - place_um)
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    along[arc] = -turned_rad(curves, on, curves.start_angle_rad[on], place_um[arc]) * curves.radius_um[on]
    return along


def _along_chords(curves: Curves, row: Ints, way_um: Floats) -> Floats:
    chord = curves.end_um[row] - curves.start_um[row]
    length = np.hypot(chord[:, 0], chord[:, 1])
    along: Floats = (way_um * chord).sum(axis=1) / np.where(length > 0.0, length, 1.0)
    return along


_SAME_UM = 1e-3
"""What files lose by printing decimals: ends so near are one. A turn that parts them no farther is none."""
_LEFT_UM = 1e-2  # what is at least left of each curve; of less, the general way decides
_TURN_RAD = 2.0 * np.pi + 1e-2  # a contour that turns more runs round twice
_BACK_RAD = np.pi - 1e-3  # a corner that turns more runs back along itself


def beside_convex(contour: Curves, by_um: float, is_inside: bool) -> OffsetLoop | None:
    """The loop at an offset of a closed counter-clockwise contour, within or outside of it.

    None where the contour does not turn one way, or the offset uses up one of its curves.
    """
    moved_um = by_um if is_inside else -by_um
    if len(contour) == 1:
        return _circle(contour, moved_um)
    if (contour.sweep_rad < 0.0).any():
        return None
    leaving, arriving = directions(contour)
    leaving_next = _next(leaving)
    cross = arriving[:, 0] * leaving_next[:, 1] - arriving[:, 1] * leaving_next[:, 0]
    kink = np.arctan2(cross, (arriving * leaving_next).sum(axis=1))
    gap = contour.end_um - _next(contour.start_um)
    if kink.min() * by_um < -_SAME_UM or kink.max() > _BACK_RAD or np.abs(gap).max() > _SAME_UM:
        return None
    radius = contour.radius_um - moved_um
    if contour.sweep_rad.sum() + kink.sum() > _TURN_RAD or np.fmin.reduce(radius, initial=np.inf) < _LEFT_UM:
        return None
    shifted = Curves(
        contour.kind,
        contour.start_um + moved_um * to_left(leaving),
        contour.end_um + moved_um * to_left(arriving),
        contour.center_um,
        radius,
        contour.start_angle_rad,
        contour.sweep_rad,
        np.where(contour.is_arc, radius * contour.sweep_rad, contour.length_um),
    )
    corner = np.flatnonzero(kink * by_um > _SAME_UM)
    if not is_inside:
        return _with_arcs(shifted, contour, corner, kink)
    return _shortened(shifted, corner)


def _circle(contour: Curves, moved_um: float) -> OffsetLoop | None:
    radius = contour.radius_um - moved_um
    if radius[0] < _LEFT_UM:
        return None
    start = contour.center_um + (radius / contour.radius_um)[:, None] * (contour.start_um - contour.center_um)
    circle = replace(contour, start_um=start, end_um=start, radius_um=radius, length_um=radius * contour.sweep_rad)
    return OffsetLoop(circle, np.array([0]), np.array([False]))


def _next(rows: Floats) -> Floats:
    return np.concatenate([rows[1:], rows[:1]])


def _with_arcs(shifted: Curves, contour: Curves, corner: Ints, kink: Floats) -> OffsetLoop:
    """Curves moved outward, welded where they are tangent, with an arc about each corner."""
    rows = np.arange(len(shifted))
    is_corner = np.zeros(len(shifted), dtype=np.bool_)
    is_corner[corner] = True
    welded = _welded(shifted, ~is_corner)
    if not len(corner):
        return OffsetLoop(welded, rows, is_corner)
    arcs = curves_between(welded.end_um[corner], _next(welded.start_um)[corner], contour.end_um[corner], kink[corner])
    order = np.argsort(np.concatenate([2 * rows, 2 * corner + 1]), kind="stable")
    is_arc = np.repeat([False, True], [len(rows), len(corner)])
    return OffsetLoop(joined([welded, arcs]).picked(order), np.concatenate([rows, corner])[order], is_arc[order])


def _shortened(shifted: Curves, corner: Ints) -> OffsetLoop | None:
    """Curves moved inward and shortened to where neighbours meet; None where nothing is left of one."""
    rows, none = np.arange(len(shifted)), np.zeros(len(shifted), dtype=np.bool_)
    end = 0.5 * (shifted.end_um + _next(shifted.start_um))
    if len(corner):
        behind = (corner + 1) % len(shifted)
        met = met_near(shifted, corner, behind, end[corner])
        if not ((met.on_um < 0.0) & (met.before_um < 0.0)).all():
            return None
        less = np.zeros(len(shifted))
        np.add.at(less, corner, -met.on_um)
        np.add.at(less, behind, -met.before_um)
        if (shifted.length_um - less < _LEFT_UM).any():
            return None
        end[corner] = met.place_um
    return OffsetLoop(with_ends(shifted, np.roll(end, 1, axis=0), end), rows, none)


def _welded(shifted: Curves, is_tangent: Bools) -> Curves:
    """Curves whose ends at tangent joints are made one."""
    begun = _next(shifted.start_um)
    middle = 0.5 * (shifted.end_um + begun)
    end = np.where(is_tangent[:, None], middle, shifted.end_um)
    start = np.roll(np.where(is_tangent[:, None], middle, begun), 1, axis=0)
    return with_ends(shifted, start, end)


_FEW = 4096  # pairs
_FAR = 1e6  # times the way between two centres: from there, the far side of an arc is the near one


def clearance_um(contour: Curves, curves: Curves, within_um: float) -> Floats:
    """(m,) µm least distance of curves from those of a contour that they do not cross; ∞ for some that lie farther.

    Two curves that do not cross are nearest at an end of one of them, or on a line through the centre of one and across
    the other, or through the centres of both.
    """
    this, other = _pairs(contour, curves, within_um)
    away = np.minimum.reduce(
        [
            _away(contour, other, curves.start_um[this]),
            _away(contour, other, curves.end_um[this]),
            _away(curves, this, contour.start_um[other]),
            _away(curves, this, contour.end_um[other]),
        ]
    )
    arc = np.flatnonzero(contour.is_arc[other])
    away[arc] = np.minimum(away[arc], _across(contour, other[arc], curves, this[arc]))
    arc = np.flatnonzero(curves.is_arc[this])
    away[arc] = np.minimum(away[arc], _across(curves, this[arc], contour, other[arc]))
    result = np.full(len(curves), np.inf)
    np.minimum.at(result, this, away)
    return result


def _pairs(contour: Curves, curves: Curves, within_um: float) -> tuple[Ints, Ints]:
    """Rows of curves and rows of the contour that may be near each other: of small ones all, which is faster."""
    if len(contour) * len(curves) <= _FEW:
        return np.repeat(np.arange(len(curves)), len(contour)), np.tile(np.arange(len(contour)), len(curves))
    near = near_curves(contour, curves, within_um)
    return near.other, near.row


def _across(arcs: Curves, arc: Ints, curves: Curves, row: Ints) -> Floats:
    """Distances (k,) of arcs from those places of the rows `row` that are nearest to their centres, and farthest."""
    center = arcs.center_um[arc]
    away = _away(arcs, arc, feet(curves, row, center).place_um)
    both = np.flatnonzero(curves.is_arc[row])
    own = curves.center_um[row[both]]
    far = feet(curves, row[both], own + _FAR * (own - center[both])).place_um
    away[both] = np.minimum(away[both], _away(arcs, arc[both], far))
    return away


def _away(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    return distance_to_curves(curves, row, place_um[:, 0], place_um[:, 1])[0]
