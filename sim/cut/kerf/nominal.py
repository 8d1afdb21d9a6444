"""The nominal kerf: what a wire on the ideal path would remove, as rectangles and sectors of rings."""

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.curves import Curves, Floats, curves_between, joined
from parser.geometry.directions import directions, to_left
from sim.cut.regions import Region, Regions, union_all

_CHORD_UM = 0.01
_CHORDS = 16  # of a sector
_SEAL = 16  # corners of the polygon over each joint: rounding may leave a gap between two shapes that abut


def nominal_region(curves: Curves, cut: NDArray[np.bool_], offset_um: float) -> Region:
    """Union of the kerfs along the rows that are `cut` (n,), with an offset on both sides and round all ends."""
    curves, cut = curves.picked(curves.length_um > 0.0), cut[curves.length_um > 0.0]
    lines, arcs = curves.picked(cut & ~curves.is_arc), curves.picked(cut & curves.is_arc)
    tight = arcs.picked(arcs.radius_um < offset_um)
    round_ends = _along_arcs(joined([_corners(curves, cut), _discs(tight.start_um), _discs(tight.end_um)]), offset_um)
    angle = np.arange(_SEAL) * (2.0 * np.pi / _SEAL)
    seals = _filled(
        _on_circles(curves.end_um[cut], np.full(int(cut.sum()), offset_um), np.tile(angle, (int(cut.sum()), 1)))
    )
    return union_all(np.concatenate([seals, round_ends, _along_lines(lines, offset_um), _along_arcs(arcs, offset_um)]))


def _discs(place_um: Floats) -> Curves:
    """Full discs about places (m, 2), the ends of arcs tighter than the offset: they reach beyond the centre."""
    turn = np.full(len(place_um), 2.0 * np.pi)
    return replace(curves_between(place_um, place_um, place_um, turn), start_angle_rad=np.zeros(len(place_um)))


def _corners(curves: Curves, cut: NDArray[np.bool_]) -> Curves:
    """Arcs of radius 0 for the turns of the wire between blocks, and for the round start and end of each cut."""
    ways = directions(curves)
    meet = cut[1:] & cut[:-1]
    arriving, leaving = ways.arriving[:-1][meet], ways.leaving[1:][meet]
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    turn = np.arctan2(cross, (arriving * leaving).sum(axis=1))
    begins, ends = cut & ~np.append(False, meet), cut & ~np.append(meet, False)
    half = np.full(int(begins.sum()), np.pi)
    place = np.concatenate([curves.start_um[1:][meet], curves.start_um[begins], curves.end_um[ends]])
    toward = np.concatenate([arriving, -ways.leaving[begins], ways.arriving[ends]])
    sweep = np.concatenate([turn, half, half])
    # The sector lies on the outer side: on the right of a turn to the left.
    across = np.arctan2(toward[:, 1], toward[:, 0]) - np.copysign(0.5 * np.pi, sweep)
    return replace(curves_between(place, place, place, sweep), start_angle_rad=across).picked(sweep != 0.0)


def _along_lines(lines: Curves, offset_um: float) -> Regions:
    by = (lines.end_um - lines.start_um) * (offset_um / lines.length_um)[:, None]
    left = to_left(by)
    corners = [lines.start_um + left, lines.start_um - left, lines.end_um - left, lines.end_um + left]
    return _filled(np.stack(corners, axis=1))


def _along_arcs(arcs: Curves, offset_um: float) -> Regions:
    """Sectors of rings, several to an arc, so that chords stay near their circles."""
    outer, sweep = arcs.radius_um + offset_um, np.clip(arcs.sweep_rad, -2.0 * np.pi, 2.0 * np.pi)
    widest = 2.0 * _CHORDS * np.arccos(1.0 - np.minimum(_CHORD_UM / outer, 0.5))
    number = np.ceil(np.abs(sweep) / np.minimum(widest, 0.5 * np.pi)).astype(np.int64)
    row = np.repeat(np.arange(len(arcs)), number)
    nth = np.arange(len(row)) - (np.cumsum(number) - number)[row]
    share = (nth[:, None] + np.linspace(0.0, 1.0, _CHORDS + 1)) / number[row][:, None]
    angle = arcs.start_angle_rad[row][:, None] + share * sweep[row][:, None]
    inner = np.maximum(arcs.radius_um - offset_um, 0.0)
    center = arcs.center_um[row]
    border = [_on_circles(center, outer[row], angle), _on_circles(center, inner[row], angle[:, ::-1])]
    return _filled(np.concatenate(border, axis=1))


def _on_circles(center: Floats, radius: Floats, angle_rad: Floats) -> Floats:
    unit = np.stack([np.cos(angle_rad), np.sin(angle_rad)], axis=-1)
    places: Floats = center[:, None, :] + radius[:, None, None] * unit
    return places


def _filled(border_um: Floats) -> Regions:
    """Polygons (n,) with the corners `border_um` (n, k, 2)."""
    polygons: Regions = np.asarray(shapely.polygons(border_um))
    return polygons
