"""Bands: the union of the discs about the places of a straight stretch of the wire's way, as a polygon.

Across the way, every line through the union meets it in one piece: where the places lie so nearly on a line that each
disc overlaps the next on every such line, it runs from the lowest border of the discs that it meets to the highest. A
disc of radius r about a place (u, v) along and across the way reaches from v − √(r² − (s − u)²) to v + √(…) at s. So a
band is known in closed form, as a star is, and may be as long as the way is straight: a straight block of 30 mm takes
some ten bands where it takes 160 stars, and the union of few regions is made in a tenth of the time.

At its ends, two discs side by side leave a notch that a band fills: of places no farther apart than 2 µm across the way
it is (1 µm)² / 2r deep, 0.005 µm of a wire that cuts 0.2 mm wide.
"""

from typing import Final

import numpy as np
import shapely

from controller.compiled.loops import compiled
from parser.geometry.curves import Bools, Floats, Ints
from sim.cut.kerf.stars import SIMPLER_UM, thin
from sim.cut.kerf.ways import spacing_um
from sim.cut.regions import Regions

_ACROSS_UM: Final = 2.0
_BACK_UM: Final = 1.0
"""How far the wire may go back along a stretch: a step."""
_IN_A_NOTCH: Final = 7
"""Stations that are added between two, so that a notch is known as well as the scallops between discs."""


def are_straight(place_um: Floats, first: Ints) -> Bools:
    """Which stretches (s,) of a way can be bands; `first` (s,) are the indices of places (m, 2) at which they begin."""
    last = np.append(first[1:], len(place_um)) - 1
    own = np.repeat(np.arange(len(first)), last - first + 1)
    by = place_um[last] - place_um[first]
    length = np.hypot(by[:, 0], by[:, 1])
    toward = by / np.where(length > 0.0, length, 1.0)[:, None]
    out = place_um - place_um[first][own]
    along = (out * toward[own]).sum(axis=1)
    across = toward[own, 0] * out[:, 1] - toward[own, 1] * out[:, 0]
    spread = np.maximum.reduceat(across, first) - np.minimum.reduceat(across, first)
    apart = own * (2.0 * (float(length.max()) + _BACK_UM))  # each stretch lies ahead of those before it
    back = np.maximum.reduceat(np.maximum.accumulate(along + apart) - (along + apart), first)
    is_straight: Bools = (length > 0.0) & (spread <= _ACROSS_UM) & (back <= _BACK_UM)
    return is_straight


def bands(place_um: Floats, bounds: Ints, offset_um: float) -> Regions:
    """Union of the discs of each of s stretches, (s,), which must be straight (`are_straight`).

    `bounds` (s, 2) are the indices of the places (m, 2) at which they begin, and one past their last.
    """
    places, spacing = np.ascontiguousarray(place_um), spacing_um(offset_um)
    rings = [_band(places[low:high], offset_um, spacing) for low, high in bounds.tolist()]
    made: Regions = np.empty(len(bounds), dtype=np.object_)
    made[:] = [shapely.Polygon(ring) for ring in rings]
    return made


@compiled("Tuple((f8, f8))(f8[:,::1], i8, i8, f8, f8)")
def _section(way: Floats, low: int, high: int, offset: float, at: float) -> tuple[float, float]:
    """Lowest and highest border at a place along the way, of the discs about some places (u, v)."""
    lowest, highest = np.inf, -np.inf
    for p in range(low, high):
        ahead = at - way[p, 0]
        square = offset * offset - ahead * ahead
        if square >= 0.0:
            half = np.sqrt(square)
            lowest, highest = min(lowest, way[p, 1] - half), max(highest, way[p, 1] + half)
    return lowest, highest


@compiled("f8[:,::1](f8[:,::1], f8[::1], f8, f8)")
def _sections(way: Floats, stations: Floats, offset: float, window: float) -> Floats:
    """Lowest and highest border (k, 2) at stations in order, of discs about places (u, v) that go back by a step.

    Between the ends of the way no disc farther off than `window` is the highest or lowest.
    """
    m = way.shape[0]
    begin, end = way[:, 0].min(), way[:, 0].max()
    border = np.empty((len(stations), 2))
    low = 0
    for k in range(len(stations)):
        at = stations[k]
        is_between = begin <= at <= end
        reach = window if is_between else offset
        while is_between and low < m - 1 and way[low, 0] < at - reach - _BACK_UM:
            low += 1
        high = low
        while high < m and way[high, 0] <= at + reach + _BACK_UM:
            high += 1
        border[k, 0], border[k, 1] = _section(way, 0 if at < begin else low, high, offset, at)
    return border


@compiled("f8[::1](f8[:,::1], f8[::1], f8, f8)")
def _with_notches(way: Floats, stations: Floats, offset: float, window: float) -> Floats:
    """Stations, and more of them where the border between two leaves their chord by more than even discs do.

    There it has a notch between discs that lie apart, as those between them are lower.
    """
    gaps = stations[1:] - stations[:-1]
    border = _sections(way, stations, offset, window)
    off = np.zeros(len(gaps))
    for share in (0.25, 0.5, 0.75):
        between = _sections(way, stations[:-1] + share * gaps, offset, window)
        for k in range(len(gaps)):
            for side in range(2):
                chord = border[k, side] + share * (border[k + 1, side] - border[k, side])
                off[k] = max(off[k], abs(between[k, side] - chord))
    found = np.empty(len(stations) + _IN_A_NOTCH * len(gaps))
    made = 0
    for k in range(len(stations)):
        found[made] = stations[k]
        made += 1
        if k < len(gaps) and off[k] > gaps[k] * gaps[k] / (8.0 * offset) + 0.5 * SIMPLER_UM:
            for part in range(1, _IN_A_NOTCH + 1):
                found[made] = stations[k] + gaps[k] * part / (_IN_A_NOTCH + 1)
                made += 1
    return found[:made].copy()


@compiled("f8[:,::1](f8[:,::1], f8, f8)")
def _band(place: Floats, offset: float, spacing: float) -> Floats:
    """Corners (k, 2) of the band of the places (m, 2) of one stretch; places along it lie so far apart at most."""
    m = place.shape[0]
    by_x, by_y = place[m - 1, 0] - place[0, 0], place[m - 1, 1] - place[0, 1]
    length = np.sqrt(by_x * by_x + by_y * by_y)
    toward_x, toward_y = by_x / length, by_y / length
    way = np.empty((m, 2))
    for p in range(m):
        out_x, out_y = place[p, 0] - place[0, 0], place[p, 1] - place[0, 1]
        way[p, 0] = out_x * toward_x + out_y * toward_y
        way[p, 1] = toward_x * out_y - toward_y * out_x
    begin, end = way[:, 0].argmin(), way[:, 0].argmax()
    # Farther along than this no disc is the highest or lowest: the nearest one, a spacing away, reaches farther.
    near = offset - np.sqrt(max(offset * offset - spacing * spacing, 0.0)) + way[:, 1].max() - way[:, 1].min()
    window = np.sqrt(offset * offset - max(offset - near, 0.0) ** 2) + spacing
    # Abreast of a place the border lies on its disc: between two such, a chord leaves out no scallop between discs.
    abreast = _with_notches(way, np.sort(way[:, 0]), offset, window)
    quarter = int(np.ceil(0.5 * np.pi * offset / spacing))
    round_end = offset * np.cos(0.5 * np.pi * np.arange(1, quarter) / quarter)
    stations = np.concatenate((way[begin, 0] - round_end, abreast, way[end, 0] + round_end[::-1]))
    border, n = _sections(way, stations, offset, window), len(stations)
    ring = np.empty((2 * n + 2, 2))
    ring[0, 0], ring[0, 1] = way[begin, 0] - offset, way[begin, 1]
    ring[n + 1, 0], ring[n + 1, 1] = way[end, 0] + offset, way[end, 1]
    for k in range(n):
        ring[1 + k, 0], ring[1 + k, 1] = stations[k], border[k, 0]
        ring[2 * n + 1 - k, 0], ring[2 * n + 1 - k, 1] = stations[k], border[k, 1]
    is_kept = np.empty(len(ring), dtype=np.bool_)
    thin(ring, SIMPLER_UM, is_kept)
    corners = np.empty((is_kept.sum() + 1, 2))
    made = 0
    for k in range(len(ring)):
        if is_kept[k]:
            corners[made, 0] = place[0, 0] + ring[k, 0] * toward_x - ring[k, 1] * toward_y
            corners[made, 1] = place[0, 1] + ring[k, 0] * toward_y + ring[k, 1] * toward_x
            made += 1
    corners[made] = corners[0]
    return corners
