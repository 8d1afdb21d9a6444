"""Along lines and arcs: places by the share of them or by length, and directions there.

Where a depth is largest along lines and arcs, for depths that change no faster than one goes along them.

Directions of travel along blocks, as unit vectors; (0, 0) along a block of length 0.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats, Ints

_BACK_RAD = np.radians(0.2)  # besides what whole µm leave open of the angle of a block
_SAME_CENTER_UM = 5.0  # of two arcs along one circle: centres in whole µm, from ends that are some µm off


class Directions(NamedTuple):
    """Directions (n, 2) at the start and at the end of each block."""

    leaving: Floats
    arriving: Floats


def directions(curves: Curves) -> Directions:
    """Directions at the ends of all n blocks."""
    leaving = _along_chords(curves.end_um - curves.start_um)
    arriving = leaving.copy()
    arc = np.flatnonzero(curves.is_arc)
    leaving[arc] = _across_radii(curves, arc, curves.start_angle_rad[arc])
    arriving[arc] = _across_radii(curves, arc, curves.start_angle_rad[arc] + curves.sweep_rad[arc])
    return Directions(leaving, arriving)


def runs_back_over(curves: Curves, this: Ints, other: Ints) -> Bools:
    """(k,) whether rows `other` run back over the rows `one`: the opposite way along the same line or circle."""
    way, length = directions(curves), np.maximum(curves.length_um, 1.0)
    arriving, leaving = way.arriving[this], way.leaving[other]
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    angle = np.pi - np.abs(np.arctan2(cross, (arriving * leaving).sum(axis=1)))
    arcs, lines = curves.is_arc[this] & curves.is_arc[other], ~curves.is_arc[this] & ~curves.is_arc[other]
    off = np.hypot(*(np.nan_to_num(curves.center_um[other]) - np.nan_to_num(curves.center_um[this])).T)
    opposite: Bools = (lines | (arcs & (off <= _SAME_CENTER_UM))) & (
        angle <= _BACK_RAD + 1.0 / length[this] + 1.0 / length[other]
    )
    return opposite


def headings(curves: Curves, row: Ints, fraction: Floats) -> Floats:
    """Directions (m, 2) in the blocks `row` (m,) at `fraction` (m,) of their length, 0 at the start, 1 at the end."""
    heading, arc = _along_lines(curves, row)
    on = row[arc]
    heading[arc] = _across_radii(curves, on, curves.start_angle_rad[on] + fraction[arc] * curves.sweep_rad[on])
    return heading


def headings_at(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    """Directions (m, 2) of the blocks `row` (m,) where they pass places (m, 2) that lie on them."""
    heading, arc = _along_lines(curves, row)
    on = row[arc]
    radial = place_um[arc] - curves.center_um[on]
    heading[arc] = _across_radii(curves, on, np.arctan2(radial[:, 1], radial[:, 0]))
    return heading


def to_left(way: Floats) -> Floats:
    """Ways (k, 2) a quarter turn to the left of others, as long as they are."""
    return np.stack([-way[:, 1], way[:, 0]], axis=1)


def _along_lines(curves: Curves, row: Ints) -> tuple[Floats, Ints]:
    """Directions (m, 2) along the chords of rows (m,), and which of these are arcs, which run across their radii."""
    by = curves.end_um.take(row, axis=0) - curves.start_um.take(row, axis=0)
    return _along_chords(by), np.flatnonzero(curves.is_arc[row])


def _along_chords(by_um: Floats) -> Floats:
    """Directions (m, 2) along ways (m, 2)."""
    length = np.hypot(by_um[:, 0], by_um[:, 1])
    heading: Floats = by_um / np.where(length > 0.0, length, 1.0)[:, None]
    return heading


def _across_radii(curves: Curves, arc: Ints, angle_rad: Floats) -> Floats:
    """Directions (m, 2) in which the arcs `arc` (m,) pass places at angles (m,) from their centres."""
    turn = np.sign(curves.sweep_rad[arc])
    return np.stack([-np.sin(angle_rad) * turn, np.cos(angle_rad) * turn], axis=1)


_SAGITTA_UM = 0.05  # of the chords of an outline


def places(curves: Curves, row: Ints, fraction: Floats) -> Floats:
    """Places (m, 2) on the curves of the rows `row` (m,), at fractions (m,) of their length."""
    start = curves.start_um.take(row, axis=0)
    place = start + fraction[:, None] * (curves.end_um.take(row, axis=0) - start)
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    angle = curves.start_angle_rad[on] + fraction[arc] * curves.sweep_rad[on]
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    place[arc] = curves.center_um[on] + curves.radius_um[on][:, None] * way
    return place


def places_at(curves: Curves, row: Ints, length_um: Floats) -> Floats:
    """Places (m, 2) on the curves of the rows `row`, a length (m,) behind their starts."""
    return places(curves, row, _share(curves, row, length_um))


def headings_along(curves: Curves, row: Ints, length_um: Floats) -> Floats:
    """Directions (m, 2) of the curves of the rows `row`, a length (m,) behind their starts."""
    return headings(curves, row, _share(curves, row, length_um))


def _share(curves: Curves, row: Ints, length_um: Floats) -> Floats:
    whole = curves.length_um[row]
    return length_um / np.where(whole > 0.0, whole, 1.0)


def along_um(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    """Lengths (m,) µm from the starts of the curves of the rows `row` to the places on them nearest to (m, 2)."""
    out = place_um - np.where(curves.is_arc[row][:, None], curves.center_um[row], curves.start_um[row])
    by = curves.end_um[row] - curves.start_um[row]
    length = curves.length_um[row]
    result: Floats = np.clip((out * by).sum(axis=1) / np.where(length > 0.0, length, 1.0), 0.0, length)
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    turned = (np.arctan2(out[arc, 1], out[arc, 0]) - curves.start_angle_rad[on]) * np.sign(curves.sweep_rad[on])
    turned, reach = np.mod(turned, 2.0 * np.pi), np.abs(curves.sweep_rad[on])
    # In the open sector the nearer end counts.
    turned = np.where(turned - reach >= np.pi - 0.5 * reach, 0.0, np.minimum(turned, reach))
    result[arc] = turned * curves.radius_um[on]
    return result


def outline(curves: Curves) -> Floats:
    """Places (m, 2) along a closed chain of curves, on arcs so many that their chords lie 0.05 µm off at most."""
    return corners(curves, _SAGITTA_UM)[0]


def corners(curves: Curves, sagitta_um: float) -> tuple[Floats, Ints]:
    """Places (m, 2) along curves from the start of each on, so that chords lie no farther off; and their rows (m,)."""
    radius = np.where(curves.is_arc, curves.radius_um, 1.0)
    step = np.sqrt(8.0 * sagitta_um / np.maximum(radius, sagitta_um))
    parts = np.maximum(np.ceil(np.abs(curves.sweep_rad) / step), 1.0).astype(np.int64)
    parts[curves.is_arc] = np.maximum(parts[curves.is_arc], 3)
    row = np.repeat(np.arange(len(curves)), parts)
    at = np.arange(len(row)) - (np.cumsum(parts) - parts)[row]
    return places(curves, row, at / parts[row]), row


_MOST_STRETCHES = 4096
"""Stretches looked at in one go, or four a curve. A curve that runs beside an edge for long would be cut into µm."""


class Deepest(NamedTuple):
    """The largest depth (m,) µm along each curve, and its place (m, 2)."""

    depth_um: Floats
    place_um: Floats


def deepest(curves: Curves, depth_of: Callable[[Ints, Floats], Floats], least_um: float, right_to_um: float) -> Deepest:
    """The largest depth along each of m curves, where it is more than `least_um`, right to `right_to_um`.

    `depth_of` gives the depths at places (k, 2) of the curves `row` (k,). Between two places it is no larger than half
    of both depths and of the way between them, together: stretches that cannot beat what is known are left alone. Where
    more than `_MOST_STRETCHES` could, what is found is right to half of their length.
    """
    row = np.arange(len(curves))
    begin, end = np.zeros(len(row)), np.ones(len(row))
    at_begin, at_end = (depth_of(row, places(curves, row, share)) for share in (begin, end))
    best, fraction = np.maximum(at_begin, at_end), np.where(at_end > at_begin, 1.0, 0.0)
    most = max(_MOST_STRETCHES, 4 * len(curves))
    while 0 < len(row) <= most:
        bound = 0.5 * (at_begin + at_end + curves.length_um[row] * (end - begin))
        deep = np.flatnonzero(bound > np.maximum(best[row], least_um) + right_to_um)
        row = row[deep]
        begin, end, at_begin, at_end = (column[deep] for column in (begin, end, at_begin, at_end))
        middle = 0.5 * (begin + end)
        depth = depth_of(row, places(curves, row, middle))
        order = np.argsort(depth, kind="stable")  # the deepest is entered last
        order = order[depth[order] > best[row[order]]]
        best[row[order]], fraction[row[order]] = depth[order], middle[order]
        row, begin, end = np.tile(row, 2), np.append(begin, middle), np.append(middle, end)
        at_begin, at_end = np.append(at_begin, depth), np.append(depth, at_end)
    return Deepest(best, places(curves, np.arange(len(curves)), fraction))
