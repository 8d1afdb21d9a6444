"""Bands: the union of the discs about the places of a straight stretch of the wire's way, as a polygon.

Across the way, every line through the union meets it in one piece: where the places lie so nearly on a line that each
disc overlaps the next on every such line, it runs from the lowest border of the discs that it meets to the highest. A
disc of radius r about a place (u, v) along and across the way reaches from v − √(r² − (s − u)²) to v + √(…) at s. So a
band is known in closed form, as a star is, and may be as long as the way is straight: a straight block of 30 mm takes
some ten bands where it takes 160 stars, and the union of few regions is made in a tenth of the time.

At its ends, two discs side by side leave a notch that a band fills: of places no farther apart than 2 µm across the way
it is (1 µm)² / 2r deep, 0.005 µm of a wire that cuts 0.2 mm wide.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np
import shapely

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Bools, Floats, Ints
from sim.cut.kerf.stars import SIMPLER_UM, thin, thinning_room
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
    made: Regions = np.empty(len(bounds), dtype=np.object_)
    if len(bounds):
        quarter = max(math.ceil(0.5 * math.pi * offset_um / spacing), 1)
        room = _room(int(np.diff(bounds).max()), quarter)
        for at, (low, high) in enumerate(bounds.tolist()):
            corners = _band(places[low:high], offset_um, spacing, quarter, (*room,))
            made[at] = shapely.Polygon(room.corner[:corners])
    return made


class _Room(NamedTuple):
    """Room for one band, of m places at most, and of k stations.

    Attributes
    ----------
    way
        (m, 2) its places, along and across.
    abreast, station
        (k,) where the border is worked out along the way: abreast of places and in notches, then round the ends too.
    between, off
        (k,) places between stations, and how far the border is from the chord there at most.
    border, other
        (k, 2) lowest and highest border at stations, and at places between them.
    ring, corner
        (2 k + 2, 2) corners of the band, along and across, and (2 k + 3, 2) those that are kept, as places.
    is_kept, waiting
        As `thin` has them, of 2 k + 2 corners.
    """

    way: Floats
    abreast: Floats
    station: Floats
    between: Floats
    off: Floats
    border: Floats
    other: Floats
    ring: Floats
    corner: Floats
    is_kept: Bools
    waiting: Ints


def _room(places: int, quarter: int) -> _Room:
    """Room for a band of so many places, whose ends have so many stations a quarter."""
    k = places + _IN_A_NOTCH * (places - 1) + 2 * quarter
    is_kept, waiting = thinning_room(2 * k + 2)
    return _Room(
        way=np.empty((places, 2)),
        abreast=np.empty(k),
        station=np.empty(k),
        between=np.empty(k),
        off=np.empty(k),
        border=np.empty((k, 2)),
        other=np.empty((k, 2)),
        ring=np.empty((2 * k + 2, 2)),
        corner=np.empty((2 * k + 3, 2)),
        is_kept=is_kept,
        waiting=waiting,
    )


@loop_part("Tuple((f8, f8))(f8[:,::1], i8, i8, f8, f8)")
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


@loop_part("void(f8[:,::1], f8[::1], f8, f8, f8[:,::1])")
def _sections(way: Floats, stations: Floats, offset: float, window: float, border: Floats) -> None:
    """Fill in lowest and highest border (k, 2) at stations in order, of discs about places (u, v).

    The places go back along the way by a step. Between its ends no disc farther off than `window` is the highest or
    lowest.
    """
    m = way.shape[0]
    begin, end = np.inf, -np.inf
    for p in range(m):
        begin, end = min(begin, way[p, 0]), max(end, way[p, 0])
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


_COLUMNS: Final = "f8[:,::1], f8[::1], f8[::1], f8[::1], f8[::1], f8[:,::1], f8[:,::1], f8[:,::1], f8[:,::1]"
_ROOM: Final = f"Tuple(({_COLUMNS}, b1[::1], i8[:,::1]))"


@loop_part("i8(f8[:,::1], f8[::1], UniTuple(f8, 2), Tuple((f8[::1], f8[::1])), Tuple((f8[:,::1], f8[:,::1])), f8[::1])")
def _with_notches(  # noqa: PLR0913, PLR0917 - a compiled loop takes the columns that it fills one by one
    way: Floats,
    sorted_: Floats,
    reach: tuple[float, float],
    columns: tuple[Floats, Floats],
    borders: tuple[Floats, Floats],
    stations: Floats,
) -> int:
    """Fill in the stations: those that are sorted, and more where the border between two leaves their chord.

    There it does so by more than even discs do: it has a notch between discs that lie apart, as those between them are
    lower. `reach` are offset and window. Gives the number of stations.
    """
    (offset, window), (between, off), (border, other) = reach, columns, borders
    gaps = len(sorted_) - 1
    _sections(way, sorted_, offset, window, border)
    for k in range(gaps):
        off[k] = 0.0
    for share in (0.25, 0.5, 0.75):
        for k in range(gaps):
            between[k] = sorted_[k] + share * (sorted_[k + 1] - sorted_[k])
        _sections(way, between[:gaps], offset, window, other)
        for k in range(gaps):
            for side in range(2):
                chord = border[k, side] + share * (border[k + 1, side] - border[k, side])
                off[k] = max(off[k], abs(other[k, side] - chord))
    made = 0
    for k in range(gaps + 1):
        stations[made] = sorted_[k]
        made += 1
        gap = sorted_[k + 1] - sorted_[k] if k < gaps else 0.0
        if k < gaps and off[k] > gap * gap / (8.0 * offset) + 0.5 * SIMPLER_UM:
            for part in range(1, _IN_A_NOTCH + 1):
                stations[made] = sorted_[k] + gap * part / (_IN_A_NOTCH + 1)
                made += 1
    return made


@loop_part("UniTuple(f8, 2)(f8[:,::1], f8[:,::1])")
def _lay(place: Floats, way: Floats) -> tuple[float, float]:
    """Fill in places (m, 2) along and across the line from the first to the last; gives its direction."""
    m = place.shape[0]
    by_x, by_y = place[m - 1, 0] - place[0, 0], place[m - 1, 1] - place[0, 1]
    length = np.sqrt(by_x * by_x + by_y * by_y)
    toward_x, toward_y = by_x / length, by_y / length
    for p in range(m):
        out_x, out_y = place[p, 0] - place[0, 0], place[p, 1] - place[0, 1]
        way[p, 0] = out_x * toward_x + out_y * toward_y
        way[p, 1] = toward_x * out_y - toward_y * out_x
    return toward_x, toward_y


@loop_part("void(f8[:,::1], f8[::1])")
def _sort_along(way: Floats, sorted_: Floats) -> None:
    """Fill in where places (m, 2) lie along the way, in order: they are so already but for steps back."""
    for p in range(way.shape[0]):
        at = p
        while at > 0 and sorted_[at - 1] > way[p, 0]:
            sorted_[at] = sorted_[at - 1]
            at -= 1
        sorted_[at] = way[p, 0]


@loop_part("f8(f8[:,::1], f8, f8)")
def _window(way: Floats, offset: float, spacing: float) -> float:
    """How far along the way a disc may be the highest or lowest: farther off, the nearest one reaches farther."""
    lowest, highest = np.inf, -np.inf
    for p in range(way.shape[0]):
        lowest, highest = min(lowest, way[p, 1]), max(highest, way[p, 1])
    near = offset - np.sqrt(max(offset * offset - spacing * spacing, 0.0)) + highest - lowest
    return float(np.sqrt(offset * offset - max(offset - near, 0.0) ** 2) + spacing)


@compiled(f"i8(f8[:,::1], f8, f8, i8, {_ROOM})")
def _band(place: Floats, offset: float, spacing: float, quarter: int, room: tuple[Any, ...]) -> int:
    """Fill in the corners of the band of the places (m, 2) of one stretch, as a closed ring; gives their number.

    Places along it lie so far apart at most; `room` is that of `_Room`.
    """
    way, abreast, station, between, off, border, other, ring, corner, is_kept, waiting = room
    m = place.shape[0]
    way = way[:m]
    toward_x, toward_y = _lay(place, way)
    begin, end = 0, 0
    for p in range(m):
        begin = p if way[p, 0] < way[begin, 0] else begin
        end = p if way[p, 0] > way[end, 0] else end
    window = _window(way, offset, spacing)
    # Abreast of a place the border lies on its disc: between two such, a chord leaves out no scallop between discs.
    _sort_along(way, station[:m])
    number = _with_notches(way, station[:m], (offset, window), (between, off), (border, other), abreast)
    ends = quarter - 1
    n = number + 2 * ends
    for k in range(ends):
        out = offset * np.cos(0.5 * np.pi * (k + 1) / quarter)
        station[k], station[n - 1 - k] = way[begin, 0] - out, way[end, 0] + out
    for k in range(number):
        station[ends + k] = abreast[k]
    _sections(way, station[:n], offset, window, border)
    ring[0, 0], ring[0, 1] = way[begin, 0] - offset, way[begin, 1]
    ring[n + 1, 0], ring[n + 1, 1] = way[end, 0] + offset, way[end, 1]
    for k in range(n):
        ring[1 + k, 0], ring[1 + k, 1] = station[k], border[k, 0]
        ring[2 * n + 1 - k, 0], ring[2 * n + 1 - k, 1] = station[k], border[k, 1]
    corners = 2 * n + 2
    thin(ring[:corners], SIMPLER_UM, is_kept[:corners], waiting)
    made = 0
    for k in range(corners):
        if is_kept[k]:
            corner[made, 0] = place[0, 0] + ring[k, 0] * toward_x - ring[k, 1] * toward_y
            corner[made, 1] = place[0, 1] + ring[k, 0] * toward_y + ring[k, 1] * toward_x
            made += 1
    corner[made, 0], corner[made, 1] = corner[0, 0], corner[0, 1]
    return made + 1
