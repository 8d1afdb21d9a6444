"""The edges of the kerf beside each block, and the nominal kerf of a wire on the ideal path.

The edges are how far the kerf reaches to the left and to the right of the ideal path. It is measured at stations on the
path, along the normal of each. The wire removes a disc about each of its places; the kerf reaches to where the normal
leaves the farthest of these discs. Only the discs of the block itself count: at an inner corner the neighbouring block
cuts on beyond this block's edge.

The nominal kerf is what a wire on the ideal path would remove, as shapes along the blocks and sectors at corners.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from controller.compiled.loops import compiled
from parser.geometry.along import directions, headings, headings_along, places_at, to_left
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.geometry.near import reach_um
from sim.cut.kerf.ways import WireWay
from sim.cut.regions import Region, Regions, union_all

_SPACING_UM = 20.0  # a fifth of the usual offset: discs smooth the edge over more than that
_WHOLE = 0.05  # of a station: directions of programs in whole µm are off by so much
_FEWEST_ON_ARC = 8  # stretches: a circle is found from the edge beside an arc, however short
_TOGETHER = 1 << 16  # places of the wire
_MOST_STATIONS = 20_000  # in a block, 400 mm: longer ones have them farther apart


class Edges(NamedTuple):
    """The kerf at m stations along the blocks.

    Attributes
    ----------
    row
        (m,) int64, never falling.
    place_um, left
        (m, 2) float64, the station on the ideal path, and the unit normal to the left of it.
    left_um, right_um
        (m,) float64, how far the kerf reaches to both sides; NaN where no disc of the block comes.
    inner
        (m,) bool, True on stations where no corner shapes the edge. Beside a corner that turns by θ that is from
        offset · tan(θ/2) on, where the edges of both blocks meet, and from one offset on at most and at the end of a
        cut; a block that goes on along its tangent has all. One too short for that has its middle stations.
    """

    row: Ints
    place_um: Floats
    left: Floats
    left_um: Floats
    right_um: Floats
    inner: NDArray[np.bool_]


class Range(NamedTuple):
    """Mean, least and greatest, each (n,) float64 µm by row; NaN where the wire did not cut."""

    mean_um: Floats
    min_um: Floats
    max_um: Floats


class _Stations(NamedTuple):
    """Row (m,), place and left normal (m, 2) of each station; by row (n,): first station, number and spacing."""

    row: Ints
    place_um: Floats
    left: Floats
    first: Ints
    number: Ints
    spacing_um: Floats


def edges_of(curves: Curves, cut: NDArray[np.bool_], ways: tuple[WireWay, ...], wire_um: Floats) -> Edges:
    """Edges beside the rows that are `cut` (n,), by where the wire went, and its reach in each (n,)."""
    stations = _stations(curves, np.flatnonzero(cut))
    left, right = np.where(np.isinf(reaches := _reaches(curves, stations, ways, wire_um)), np.nan, reaches)
    return Edges(
        stations.row, stations.place_um, stations.left, left, right, _inner(stations, _margins(curves, cut, wire_um))
    )


def ranges(edges: Edges, value_um: Floats, rows: int) -> Range:
    """Range of values (m,) at the inner stations of each of n rows."""
    counted = edges.inner & ~np.isnan(value_um)
    row, value = edges.row[counted], value_um[counted]
    mean, low, high = np.full((3, rows), np.nan)
    first = np.flatnonzero(np.diff(row, prepend=-1))
    if len(first):
        at = row[first]
        mean[at] = np.add.reduceat(value, first) / np.diff(first, append=len(row))
        low[at], high[at] = np.minimum.reduceat(value, first), np.maximum.reduceat(value, first)
    return Range(mean, low, high)


def _stations(curves: Curves, rows: Ints) -> _Stations:
    length = reach_um(curves)  # a second turn runs where the first one ran
    number, spacing = np.zeros(len(curves), dtype=np.int64), np.ones(len(curves))
    fewest = np.where(curves.is_arc[rows], _FEWEST_ON_ARC, 1.0)
    number[rows] = np.clip(np.ceil(length[rows] / _SPACING_UM), fewest, _MOST_STATIONS).astype(np.int64) + 1
    spacing[rows] = np.maximum(length[rows], 1e-9) / (number[rows] - 1)
    first = np.cumsum(number) - number
    row = np.repeat(np.arange(len(curves)), number)
    along = (np.arange(len(row)) - first[row]) * spacing[row]
    heading = headings_along(curves, row, along)
    return _Stations(row, places_at(curves, row, along), to_left(heading), first, number, spacing)


def _reaches(curves: Curves, stations: _Stations, ways: tuple[WireWay, ...], wire_um: Floats) -> Floats:
    """How far (2, m) the discs of each station's own block reach to the left and to the right; −inf where none is."""
    reaches, station = np.full((2, len(stations.row)), -np.inf), np.hstack([stations.place_um, stations.left])
    # A block with more than the fewest stations has them more than half the usual spacing apart: no disc meets more.
    most = max(int(np.ceil(2.0 * float(wire_um.max()) / _SPACING_UM)) + 1, _FEWEST_ON_ARC)
    for row, place in _places(ways):
        nearest = np.rint(_along_um(curves, row, place) / stations.spacing_um[row]).astype(np.int64)
        low, past = stations.first[row], stations.first[row] + stations.number[row]
        met = np.stack([np.maximum(low + nearest - most, low), np.minimum(low + nearest + most + 1, past)], axis=1)
        _raise_to_discs(place, met, station, wire_um[row], reaches)
    return reaches


def _places(ways: tuple[WireWay, ...]) -> Iterator[tuple[Ints, Floats]]:
    """Rows (p,) and places (p, 2) of the ways, some at a time: what is worked out of each takes ten times its room."""
    for way in ways:
        for low in range(0, len(way.row), _TOGETHER):
            yield way.row[low : low + _TOGETHER], way.place_um[low : low + _TOGETHER]


@compiled("void(f8[:,::1], i8[:,::1], f8[:,::1], f8[::1], f8[:,::1])")
def _raise_to_discs(place: Floats, met: Ints, station: Floats, radius: Floats, reaches: Floats) -> None:
    """Raise the reaches (2, m) to where the normals of the stations leave discs (p,) about the places (p, 2).

    Each disc counts at the stations from `met` (p, 2) on, one past the last; `station` (m, 4) are places and normals.
    """
    for p in range(place.shape[0]):
        for at in range(met[p, 0], met[p, 1]):
            out_x, out_y = place[p, 0] - station[at, 0], place[p, 1] - station[at, 1]
            aside = out_x * station[at, 3] - out_y * station[at, 2]
            if abs(aside) <= radius[p]:
                half = np.sqrt(radius[p] * radius[p] - aside * aside)
                along = out_x * station[at, 2] + out_y * station[at, 3]
                reaches[0, at] = max(reaches[0, at], half + along)
                reaches[1, at] = max(reaches[1, at], half - along)


def _along_um(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    """Distances (m,) of places (m, 2) along their blocks: projected on a line, or by angle about an arc's centre."""
    is_arc = curves.is_arc[row]
    along = np.empty(len(row))
    along[~is_arc] = _along_lines_um(curves, row[~is_arc], place_um[~is_arc])
    along[is_arc] = _along_arcs_um(curves, row[is_arc], place_um[is_arc])
    return along


def _along_lines_um(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    along: Floats = ((place_um - curves.start_um[row]) * headings(curves, row, np.zeros(len(row)))).sum(axis=1)
    return along


def _along_arcs_um(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    """An angle outside the arc is counted from the nearer end."""
    out, sweep = place_um - curves.center_um[row], curves.sweep_rad[row]
    turned = (np.arctan2(out[:, 1], out[:, 0]) - curves.start_angle_rad[row]) * np.sign(sweep)
    before = -0.5 * (2.0 * np.pi - np.minimum(np.abs(sweep), 2.0 * np.pi))
    along: Floats = (np.mod(turned - before, 2.0 * np.pi) + before) * curves.radius_um[row]
    return along


def _margins(curves: Curves, cut: NDArray[np.bool_], wire_um: Floats) -> Floats:
    """How far (n, 2) µm corners shape the edges beside the rows, from their starts and from their ends."""
    way = directions(curves)
    into, out_of = way.arriving[:-1], way.leaving[1:]
    cosine = (into * out_of).sum(axis=1)
    sine = np.abs(into[:, 0] * out_of[:, 1] - into[:, 1] * out_of[:, 0])
    joined = cut[:-1] & cut[1:] & (cosine > 0.0)
    # tan(θ/2) = sin θ / (1 + cos θ)
    between = np.where(joined, sine / (1.0 + np.maximum(cosine, 0.0)), 1.0)
    margins = np.ones((len(curves), 2))
    margins[1:, 0], margins[:-1, 1] = between, between
    return margins * wire_um[:, None]


def _inner(stations: _Stations, margins_um: Floats) -> NDArray[np.bool_]:
    row = stations.row
    after = np.arange(len(row)) - stations.first[row]
    before = stations.number[row] - 1 - after
    # In whole stations: of an even number of stations, both middle ones count.
    most = (stations.number[row] - 1) // 2
    needed = np.minimum(np.ceil(margins_um[row] / stations.spacing_um[row, None] - _WHOLE), most[:, None])
    inner: NDArray[np.bool_] = (after >= needed[:, 0]) & (before >= needed[:, 1])
    return inner


_CHORD_UM = 0.01
_CHORDS = 16  # of a sector
_SEAL = 8  # chords of half a disc ahead of each shape: rounding may leave a gap between two shapes that abut
_LEAST_RAD = 0.1  # of a sector: corners too near to each other come out of order by rounding


def nominal_region(curves: Curves, cut: NDArray[np.bool_], wire_um: Floats, boxes_um: Regions | None = None) -> Region:
    """Union of the kerfs along the rows that are `cut` (n,), with an offset (n,) on both sides and round all ends.

    Where boxes (b,) are given, it is whole within these alone: what does not reach into any is left out.
    """
    is_long = curves.length_um > 0.0
    curves, cut, wire_um = curves.picked(is_long), cut[is_long], wire_um[is_long]
    offsets = np.unique(wire_um[cut]).tolist()
    shapes = [np.empty(0, dtype=np.object_), *(_nominal(curves, cut & (wire_um == each), each) for each in offsets)]
    return union_all(_reaching(np.concatenate(shapes), boxes_um))


def _nominal(curves: Curves, cut: NDArray[np.bool_], offset_um: float) -> Regions:
    """Shapes (k,) that cover the kerf along the rows that are `cut` (n,), with one offset."""
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
    covering: Regions = np.concatenate(shapes)
    return covering


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
