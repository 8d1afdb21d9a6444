"""The edges of the kerf beside each block: how far it reaches to the left and to the right of the ideal path.

It is measured at stations on the path, along the normal of each. The wire removes a disc about each of its places; the
kerf reaches to where the normal leaves the farthest of these discs. Only the discs of the block itself count: at an
inner corner the neighbouring block cuts on beyond this block's edge.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.compiled.loops import compiled
from parser.geometry.along import directions, headings, headings_along, places_at, to_left
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.near import reach_um
from sim.cut.kerf.ways import WireWay

_SPACING_UM = 20.0  # a fifth of the usual offset: discs smooth the edge over more than that
_WHOLE = 0.05  # of a station: directions of programs in whole µm are off by so much
_FEWEST_ON_ARC = 8  # stretches: a circle is found from the edge beside an arc, however short
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


def edges_of(curves: Curves, cut: NDArray[np.bool_], ways: tuple[WireWay, ...], offset_um: float) -> Edges:
    """Edges beside the rows that are `cut` (n,), by where the wire went."""
    stations = _stations(curves, np.flatnonzero(cut))
    left, right = np.where(np.isinf(reaches := _reaches(curves, stations, ways, offset_um)), np.nan, reaches)
    return Edges(
        stations.row, stations.place_um, stations.left, left, right, _inner(stations, _margins(curves, cut, offset_um))
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


def _reaches(curves: Curves, stations: _Stations, ways: tuple[WireWay, ...], offset_um: float) -> Floats:
    """How far (2, m) the discs of each station's own block reach to the left and to the right; −inf where none is."""
    reaches = np.full((2, len(stations.row)), -np.inf)
    if not ways:
        return reaches
    row, place = (
        np.concatenate(column) for column in zip(*((wire_way.row, wire_way.place_um) for wire_way in ways), strict=True)
    )
    nearest = np.rint(_along_um(curves, row, place) / stations.spacing_um[row]).astype(np.int64)
    low, past = stations.first[row], stations.first[row] + stations.number[row]
    # A block with more than the fewest stations has them more than half the usual spacing apart: no disc meets more.
    most = max(int(np.ceil(2.0 * offset_um / _SPACING_UM)) + 1, _FEWEST_ON_ARC)
    met = np.stack([np.maximum(low + nearest - most, low), np.minimum(low + nearest + most + 1, past)], axis=1)
    _raise_to_discs(place, met, np.hstack([stations.place_um, stations.left]), offset_um, reaches)
    return reaches


@compiled("void(f8[:,::1], i8[:,::1], f8[:,::1], f8, f8[:,::1])")
def _raise_to_discs(place: Floats, met: Ints, station: Floats, offset: float, reaches: Floats) -> None:
    """Raise the reaches (2, m) to where the normals of the stations leave the discs about the places (p, 2).

    Each disc counts at the stations from `met` (p, 2) on, one past the last; `station` (m, 4) are places and normals.
    """
    for p in range(place.shape[0]):
        for at in range(met[p, 0], met[p, 1]):
            out_x, out_y = place[p, 0] - station[at, 0], place[p, 1] - station[at, 1]
            aside = out_x * station[at, 3] - out_y * station[at, 2]
            if abs(aside) <= offset:
                half = np.sqrt(offset * offset - aside * aside)
                along = out_x * station[at, 2] + out_y * station[at, 3]
                reaches[0, at] = max(reaches[0, at], half + along)
                reaches[1, at] = max(reaches[1, at], half - along)


def _along_um(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    """Distances (m,) of places (m, 2) along their blocks: projected on a line, or by angle about an arc's centre."""
    heading = headings(curves, row, np.zeros(len(row)))
    out = np.where(curves.is_arc[row][:, None], place_um - curves.center_um[row], place_um - curves.start_um[row])
    sweep = curves.sweep_rad[row]
    turned = (np.arctan2(out[:, 1], out[:, 0]) - curves.start_angle_rad[row]) * np.sign(sweep)
    reach = np.minimum(np.abs(sweep), 2.0 * np.pi)
    # An angle outside the arc is counted from the nearer end.
    before = -0.5 * (2.0 * np.pi - reach)
    angle = np.mod(turned - before, 2.0 * np.pi) + before
    return np.where(curves.is_arc[row], angle * curves.radius_um[row], (out * heading).sum(axis=1))


def _margins(curves: Curves, cut: NDArray[np.bool_], offset_um: float) -> Floats:
    """How far (n, 2) µm corners shape the edges beside the rows, from their starts and from their ends."""
    way = directions(curves)
    into, out_of = way.arriving[:-1], way.leaving[1:]
    cosine = (into * out_of).sum(axis=1)
    sine = np.abs(into[:, 0] * out_of[:, 1] - into[:, 1] * out_of[:, 0])
    joined = cut[:-1] & cut[1:] & (cosine > 0.0)
    margins = np.full((len(curves), 2), offset_um)
    # tan(θ/2) = sin θ / (1 + cos θ)
    between = np.where(joined, offset_um * sine / (1.0 + np.maximum(cosine, 0.0)), offset_um)
    margins[1:, 0], margins[:-1, 1] = between, between
    return margins


def _inner(stations: _Stations, margins_um: Floats) -> NDArray[np.bool_]:
    row = stations.row
    after = np.arange(len(row)) - stations.first[row]
    before = stations.number[row] - 1 - after
    # In whole stations: of an even number of stations, both middle ones count.
    most = (stations.number[row] - 1) // 2
    needed = np.minimum(np.ceil(margins_um[row] / stations.spacing_um[row, None] - _WHOLE), most[:, None])
    inner: NDArray[np.bool_] = (after >= needed[:, 0]) & (before >= needed[:, 1])
    return inner
