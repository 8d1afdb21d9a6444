"""The nominal kerf: what a wire on the ideal path would remove, as shapes along the blocks and sectors at corners."""

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.along import directions, to_left
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from sim.cut.regions import Region, Regions, union_all

_CHORD_UM = 0.01
_CHORDS = 16  # of a sector
_SEAL = 8  # chords of half a disc ahead of each shape: rounding may leave a gap between two shapes that abut
_LEAST_RAD = 0.1  # of a sector: corners too near to each other come out of order by rounding


def nominal_region(curves: Curves, cut: NDArray[np.bool_], offset_um: float, boxes_um: Regions | None = None) -> Region:
    """Union of the kerfs along the rows that are `cut` (n,), with an offset on both sides and round all ends.

    Where boxes (b,) are given, it is whole within these alone: what does not reach into any is left out.
    """
    curves, cut = curves.picked(curves.length_um > 0.0), cut[curves.length_um > 0.0]
    turn = _turns(curves, cut)
    slight = np.where(np.abs(turn) <= _widest_rad(np.array(offset_um)), turn, 0.0)
    line, arc = cut & ~curves.is_arc, cut & curves.is_arc
    tight = curves.picked(arc & (np.nan_to_num(curves.radius_um) < offset_um))
    sharp = joined([_corners(curves, cut, turn - slight), _discs(tight.start_um), _discs(tight.end_um)])
    shapes = [
        _along_lines(curves.picked(line), slight[line], offset_um),
        _along_arcs(curves.picked(arc), slight[arc], offset_um),
        _fans(sharp, offset_um),
    ]
    return union_all(_reaching(np.concatenate(shapes), boxes_um))


def _reaching(shapes: Regions, boxes_um: Regions | None) -> Regions:
    if boxes_um is None:
        return shapes
    met: Regions = shapes[np.unique(shapely.STRtree(shapes).query(boxes_um)[1])]
    return met


def _discs(place_um: Floats) -> Curves:
    """Full discs about places (m, 2), the ends of arcs tighter than the offset: they reach beyond the centre."""
    turn = np.full(len(place_um), 2.0 * np.pi)
    return replace(curves_between(place_um, place_um, place_um, turn), start_angle_rad=np.zeros(len(place_um)))


def _turns(curves: Curves, cut: NDArray[np.bool_]) -> Floats:
    """How far the wire turns at the end of each row (n,) that is cut on into the next; else 0."""
    ways, turn = directions(curves), np.zeros(len(curves))
    meet = np.flatnonzero(cut[1:] & cut[:-1])
    arriving, leaving = ways.arriving[meet], ways.leaving[meet + 1]
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    turn[meet] = np.arctan2(cross, (arriving * leaving).sum(axis=1))
    return turn


def _corners(curves: Curves, cut: NDArray[np.bool_], turn_rad: Floats) -> Curves:
    """Arcs of radius 0 for the turns of the wire behind blocks (n,), and for the round start and end of each cut.

    A disc about the start reaches over the seam to the first block, as half discs do ahead of all blocks.
    """
    ways, turns = directions(curves), turn_rad != 0.0
    begins, ends = cut & ~np.append(False, cut)[:-1], cut & ~np.append(cut, False)[1:]
    whole, half = np.full(int(begins.sum()), 2.0 * np.pi), np.full(int(ends.sum()), np.pi)
    place = np.concatenate([curves.end_um[turns], curves.start_um[begins], curves.end_um[ends]])
    toward = np.concatenate([ways.arriving[turns], -ways.leaving[begins], ways.arriving[ends]])
    sweep = np.concatenate([turn_rad[turns], whole, half])
    # The sector lies on the outer side: on the right of a turn to the left.
    back = np.concatenate([np.copysign(0.5 * np.pi, turn_rad[turns]), 0.5 * whole, 0.5 * half])
    across = np.arctan2(toward[:, 1], toward[:, 0]) - back
    return replace(curves_between(place, place, place, sweep), start_angle_rad=across)


def _along_lines(lines: Curves, turn_rad: Floats, offset_um: float) -> Regions:
    left = to_left(lines.end_um - lines.start_um) * (offset_um / lines.length_um)[:, None]
    corners = np.stack([lines.start_um + left, lines.start_um - left, lines.end_um - left], axis=1)
    ahead = _ahead(lines.end_um, -left, np.ones(len(lines)), turn_rad)
    return _filled(np.concatenate([corners, ahead, (lines.end_um + left)[:, None]], axis=1))


def _along_arcs(arcs: Curves, turn_rad: Floats, offset_um: float) -> Regions:
    row, is_last, outer, inner = _sectors(arcs, offset_um)
    by = outer[:, -1] - arcs.center_um[row]
    across = by * (offset_um / np.hypot(by[:, 0], by[:, 1]))[:, None]
    end = arcs.center_um[row] + by * (arcs.radius_um / (arcs.radius_um + offset_um))[row][:, None]
    ahead = _ahead(end, across, np.sign(arcs.sweep_rad[row]), np.where(is_last, turn_rad[row], 0.0))
    return _filled(np.concatenate([outer, ahead, inner], axis=1))


def _fans(corners: Curves, offset_um: float) -> Regions:
    _, _, outer, inner = _sectors(corners, offset_um)
    return _filled(np.concatenate([outer, inner[:, :1]], axis=1))


def _sectors(arcs: Curves, offset_um: float) -> tuple[Ints, NDArray[np.bool_], Floats, Floats]:
    """Sectors of rings, several to an arc, so that chords stay near their circles.

    Returns arc (k,), whether it is its last one, outer border onward and inner border backward (k, c, 2).
    """
    outer, sweep = arcs.radius_um + offset_um, np.clip(arcs.sweep_rad, -2.0 * np.pi, 2.0 * np.pi)
    number = np.ceil(np.abs(sweep) / np.minimum(_widest_rad(outer), 0.5 * np.pi)).astype(np.int64)
    row = np.repeat(np.arange(len(arcs)), number)
    nth = np.arange(len(row)) - (np.cumsum(number) - number)[row]
    share = (nth[:, None] + np.linspace(0.0, 1.0, _CHORDS + 1)) / number[row][:, None]
    angle = arcs.start_angle_rad[row][:, None] + share * sweep[row][:, None]
    inner = np.maximum(arcs.radius_um - offset_um, 0.0)
    center = arcs.center_um[row]
    borders = _on_circles(center, outer[row], angle), _on_circles(center, inner[row], angle[:, ::-1])
    return row, nth == number[row] - 1, *borders


def _ahead(end_um: Floats, across_um: Floats, sense: Floats, turn_rad: Floats) -> Floats:
    """Corners (m, c, 2) on half discs ahead of ends (m, 2), from one side, `across_um` off, to the other.

    `sense` (m,) is +1 from right to left, −1 back. Where the wire turns, the outer side of the turn is smooth.
    """
    turn = turn_rad * sense
    smooth = np.maximum(np.abs(turn), _LEAST_RAD)[:, None] * np.linspace(0.0, 1.0, _CHORDS + 1)
    rest = np.linspace(smooth[:, -1], np.pi, _SEAL + 1, axis=1)[:, 1:]
    by = np.concatenate([smooth, rest], axis=1)
    by = np.where(turn[:, None] >= 0.0, by, np.pi - by[:, ::-1])
    begin = np.arctan2(across_um[:, 1], across_um[:, 0])
    angle = begin[:, None] + sense[:, None] * by[:, 1:-1]
    return _on_circles(end_um, np.hypot(across_um[:, 0], across_um[:, 1]), angle)


def _widest_rad(radius_um: Floats) -> Floats:
    """The widest sectors (m,) on circles of some radii (m,), so that the chords of each stay near its circle."""
    widest: Floats = 2.0 * _CHORDS * np.arccos(1.0 - np.minimum(_CHORD_UM / radius_um, 0.5))
    return widest


def _on_circles(center: Floats, radius: Floats, angle_rad: Floats) -> Floats:
    unit = np.stack([np.cos(angle_rad), np.sin(angle_rad)], axis=-1)
    places: Floats = center[:, None, :] + radius[:, None, None] * unit
    return places


def _filled(border_um: Floats) -> Regions:
    """Polygons (n,) with the corners `border_um` (n, k, 2)."""
    polygons: Regions = np.asarray(shapely.polygons(border_um))
    return polygons
