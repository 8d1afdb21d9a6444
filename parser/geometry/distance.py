"""Distances and crossings of lines and arcs, in closed form, ends included."""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import along_um
from parser.geometry.curves import CurveKind, Curves, Floats, Ints, total_before


class Feet(NamedTuple):
    """The nearest places (m, 2) of curves to other places, and the angle (m,) of their radii, rad; 0 on lines.

    Along one arc the angle runs on as its sweep does, without a jump of a turn.
    """

    place_um: Floats
    angle_rad: Floats


def lengths_to(curves: Curves, place_um: Floats) -> Floats:
    """(k,) how far µm along a chain of n curves its places lie that are nearest to others (k, 2)."""
    n, k = len(curves), len(place_um)
    x, y = np.repeat(place_um, n, axis=0).T
    off, _ = distance_to_curves(curves, np.tile(np.arange(n), k), x, y)
    row = off.reshape(k, n).argmin(axis=1)
    lengths: Floats = total_before(curves.length_um)[row] + along_um(curves, row, place_um)
    return lengths


def angles(curves: Curves, row: Ints, fraction: Floats) -> Floats:
    """Angles (m,) of the radii at `fraction` (m,) of the curves' length, rad; 0 on lines."""
    return np.where(curves.is_arc[row], curves.start_angle_rad[row] + fraction * curves.sweep_rad[row], 0.0)


def feet(curves: Curves, row: Ints, place_um: Floats) -> Feet:
    """Feet of places (m, 2) on the curves `row` (m,), ends included."""
    foot, angle = np.empty_like(place_um), np.zeros(len(row))
    arc = curves.is_arc[row]
    line, on_arc = np.flatnonzero(~arc), np.flatnonzero(arc)
    foot[line] = _on_lines(curves, row[line], place_um[line])
    angle[on_arc] = _on_arcs(curves, row[on_arc], place_um[on_arc])
    foot[on_arc] = _on_circle(curves, row[on_arc], angle[on_arc])
    return Feet(foot, angle)


def _on_circle(curves: Curves, row: Ints, angle: Floats) -> Floats:
    out = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    place: Floats = curves.center_um[row] + curves.radius_um[row][:, None] * out
    return place


def _on_lines(curves: Curves, row: Ints, place: Floats) -> Floats:
    start = curves.start_um.take(row, axis=0)
    by = curves.end_um.take(row, axis=0) - start
    square = _dot(by, by)
    share = _dot(place - start, by) / np.where(square > 0.0, square, 1.0)
    foot: Floats = start + np.clip(share, 0.0, 1.0)[:, None] * by
    return foot


def _dot(this: Floats, other: Floats) -> Floats:
    dot: Floats = this[:, 0] * other[:, 0] + this[:, 1] * other[:, 1]
    return dot


def _on_arcs(curves: Curves, row: Ints, place: Floats) -> Floats:
    """Angles of the feet on arcs; outside the sweep that of the nearer end."""
    out = place - curves.center_um[row]
    sweep, start = curves.sweep_rad[row], curves.start_angle_rad[row]
    reach = np.abs(sweep)
    turned = np.mod((np.arctan2(out[:, 1], out[:, 0]) - start) * np.sign(sweep), 2.0 * np.pi)
    nearer_end = np.where(turned - reach < 2.0 * np.pi - turned, reach, 0.0)
    angle: Floats = start + np.sign(sweep) * np.where(turned > reach, nearer_end, turned)
    return angle


def distance_to_curves(curves: Curves, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    """Distances (m,) µm of positions from the curves of the rows `row`, and −1, 0, +1: before, on, past the curve."""
    result, beyond = np.empty(len(row)), np.empty(len(row), dtype=np.int64)
    arc = curves.kind[row] == CurveKind.ARC
    for which, measure in ((np.flatnonzero(~arc), _from_lines), (np.flatnonzero(arc), _from_arcs)):
        if len(which):
            result[which], beyond[which] = measure(curves, row[which], x[which], y[which])
    return result, beyond


def _from_lines(curves: Curves, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    by_x = curves.end_um[:, 0][row] - curves.start_um[:, 0][row]
    by_y = curves.end_um[:, 1][row] - curves.start_um[:, 1][row]
    length = np.hypot(by_x, by_y)
    inverse = 1.0 / np.where(length > 0.0, length, 1.0)
    # A line without length has no direction: any will do.
    ux, uy = np.where(length > 0.0, by_x * inverse, 1.0), by_y * inverse
    dx, dy = x - curves.start_um[:, 0][row], y - curves.start_um[:, 1][row]
    along = dx * ux + dy * uy
    across = dx * uy - dy * ux
    excess = along - np.clip(along, 0.0, length)
    return np.hypot(across, excess), np.sign(excess).astype(np.int64)


def _from_arcs(curves: Curves, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    dx, dy = x - curves.center_um[:, 0][row], y - curves.center_um[:, 1][row]
    sweep = curves.sweep_rad[row]
    reach = np.abs(sweep)
    turned = np.mod((np.arctan2(dy, dx) - curves.start_angle_rad[row]) * np.sign(sweep), 2.0 * np.pi)
    result = np.abs(np.hypot(dx, dy) - curves.radius_um[row])
    # Outside the sweep, the half of the open sector nearer the end is past it.
    open_ = turned > reach
    past_end = turned - reach < 2.0 * np.pi - turned
    beyond = np.where(open_, np.where(past_end, 1, -1), 0)
    end = np.where(past_end[:, None], curves.end_um[row], curves.start_um[row])
    return np.where(open_, np.hypot(x - end[:, 0], y - end[:, 1]), result), beyond


class Prolonged(NamedTuple):
    """Where k pairs of curves meet, lines and circles prolonged.

    Attributes
    ----------
    place_um
        (k, 2, 2) float64, up to two places a pair; NaN where there is none. Lines meet in the first alone.
    overlap_um
        (k,) float64, how far the two run through each other at their lens, negative by how far they miss each other;
        infinite for lines that meet, −infinite for parallel ones.
    """

    place_um: Floats
    overlap_um: Floats


def prolonged_meet(curves: Curves, early: Ints, late: Ints) -> Prolonged:
    """Where the curves of pairs of rows (k,) meet when they are prolonged."""
    place, overlap = np.full((len(early), 2, 2), np.nan), np.full(len(early), -np.inf)
    arcs = curves.is_arc[early].astype(np.int64) + curves.is_arc[late]
    for number, meet in enumerate((_lines, _line_and_arc, _arcs)):
        which = np.flatnonzero(arcs == number)
        if len(which):
            place[which], overlap[which] = meet(curves, early[which], late[which])
    return Prolonged(place, overlap)


class Meets(NamedTuple):
    """Places (k, 2) where the curves of two rows (k,), lines as long as they are and whole circles, meet."""

    early: Ints
    late: Ints
    place_um: Floats

    def take(self, at: Ints) -> "Meets":
        """Those at the indices `at`."""
        return Meets(self.early[at], self.late[at], self.place_um.take(at, axis=0))


def curves_meet(curves: Curves, early: Ints, late: Ints, clear_um: float) -> Meets:
    """Places where lines meet within both, and where lines and circles run `clear_um` and more through each other."""
    lines = ~curves.is_arc[early] & ~curves.is_arc[late]
    # Most pairs of lines that are near each other do not meet, and end here.
    met = np.flatnonzero(~lines)
    met = np.concatenate([np.flatnonzero(lines)[_within_both(curves, early[lines], late[lines])], met])
    early, late = early[met], late[met]
    place, overlap = prolonged_meet(curves, early, late)
    pair, which = np.nonzero((overlap > clear_um)[:, None] & ~np.isnan(place[:, :, 0]))
    return Meets(early[pair], late[pair], place[pair, which])


def by_xy(curves: Curves, row: Ints) -> tuple[Floats, Floats]:
    """Ways (k,) µm in X and in Y from the start to the end of rows (k,)."""
    start, end = curves.start_um, curves.end_um
    return end[:, 0][row] - start[:, 0][row], end[:, 1][row] - start[:, 1][row]


def _shares(curves: Curves, early: Ints, late: Ints) -> tuple[Floats, Floats]:
    """Where prolonged lines meet, as shares (k,) of the way along the one and the other; NaN for parallel ones."""
    ax, ay = by_xy(curves, early)
    bx, by = by_xy(curves, late)
    gap_x = curves.start_um[late, 0] - curves.start_um[early, 0]
    gap_y = curves.start_um[late, 1] - curves.start_um[early, 1]
    cross = ax * by - ay * bx
    inverse = 1.0 / np.where(cross == 0.0, np.nan, cross)
    return (gap_x * by - gap_y * bx) * inverse, (gap_x * ay - gap_y * ax) * inverse


def _within_both(curves: Curves, early: Ints, late: Ints) -> Ints:
    on_a, on_b = _shares(curves, early, late)
    return np.flatnonzero((on_a > 0.0) & (on_a < 1.0) & (on_b > 0.0) & (on_b < 1.0))


def _lines(curves: Curves, early: Ints, late: Ints) -> tuple[Floats, Floats]:
    share, _ = _shares(curves, early, late)
    start = curves.start_um[early]
    place = start + share[:, None] * (curves.end_um[early] - start)
    return np.stack([place, np.full_like(place, np.nan)], axis=1), np.where(np.isnan(share), -np.inf, np.inf)


def _line_and_arc(curves: Curves, early: Ints, late: Ints) -> tuple[Floats, Floats]:
    early_is_arc = curves.is_arc[early]
    line, arc = np.where(early_is_arc, late, early), np.where(early_is_arc, early, late)
    by_x, by_y = by_xy(curves, line)
    length = np.hypot(by_x, by_y)
    length[length == 0.0] = np.nan
    way_x, way_y = by_x / length, by_y / length
    x, y = curves.start_um[:, 0][line], curves.start_um[:, 1][line]
    to_x, to_y = curves.center_um[:, 0][arc] - x, curves.center_um[:, 1][arc] - y
    radius = curves.radius_um[arc]
    off = np.abs(way_x * to_y - way_y * to_x)
    along = way_x * to_x + way_y * to_y
    foot = x + way_x * along, y + way_y * along
    return _both(foot, (way_x, way_y), (radius - off) * (radius + off)), radius - off


def _arcs(curves: Curves, early: Ints, late: Ints) -> tuple[Floats, Floats]:
    # Seen from the centre of the smaller circle, rounding moves the places least.
    early_is_small = curves.radius_um[early] <= curves.radius_um[late]
    small, large = np.where(early_is_small, early, late), np.where(early_is_small, late, early)
    x, y = curves.center_um[:, 0][small], curves.center_um[:, 1][small]
    by_x, by_y = curves.center_um[:, 0][large] - x, curves.center_um[:, 1][large] - y
    between = np.hypot(by_x, by_y)
    a, b = curves.radius_um[small], curves.radius_um[large]
    apart = np.where(between > 0.0, between, np.nan)
    way_x, way_y = by_x / apart, by_y / apart
    along = 0.5 * (between + (a - b) * (a + b) / apart)
    middle = x + way_x * along, y + way_y * along
    place = _both(middle, (-way_y, way_x), (a - along) * (a + along))
    return place, np.minimum(a + b - between, between - np.abs(a - b))


def _both(middle: tuple[Floats, Floats], way: tuple[Floats, Floats], square: Floats) -> Floats:
    """Places (k, 2, 2) on both sides of a middle, √square along a way; NaN where the square is negative."""
    half = np.sqrt(np.where(square >= 0.0, square, np.nan))
    places = np.empty((len(half), 2, 2))
    for axis in (0, 1):
        by = way[axis] * half
        places[:, 0, axis], places[:, 1, axis] = middle[axis] - by, middle[axis] + by
    return places
