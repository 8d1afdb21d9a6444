"""How thick the material is that a pass takes off, at stations along it.

A first pass cuts through solid material: it takes the whole width of its kerf. A later one takes what its kerf reaches
beyond those of the passes before it, on the part's side, or on both where that is not known::

        part
    ------------------ edge of the kerf of this pass    |
    ------------------ edge of the kerf before it       | stock
          o            this wire, at the station: the kerf reaches as far as the wire's reach to all sides
          x            the wire of the pass before it, at its place nearest to the station

Both wires are where they really were: a place on the ideal path of the earlier pass is moved aside by what the wire was
off there.
"""

from collections import deque
from collections.abc import Iterable, Sequence
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.along import along_um
from parser.geometry.broad_phase_places import near_places
from parser.geometry.curves import Floats, Ints
from parser.geometry.directions import headings_at, to_left
from parser.geometry.distance import distance_to_curves
from parser.geometry.feet import feet
from parser.shape.passes import Pass
from parser.toolpath import Toolpath

_SPACING_UM: Final = 20.0
"""Of stations: a fifth of the usual reach of a wire, which smooths over more than that."""
_MOST_BEFORE: Final = 8
"""Passes to look back at. More than nine over one edge are no trims; a path may run round in one place 1,900 times."""


class Stock(NamedTuple):
    """Thickness of the material that a pass takes off, µm: where it is thinnest and thickest, and its mean."""

    least_um: float
    most_um: float
    mean_um: float


class WireTaken(NamedTuple):
    """The way that the wire took, m samples.

    Attributes
    ----------
    row
        (m,) int64, row of the toolpath that was running; never falls.
    place_um
        (m, 2) float64, where the wire was.
    along_um
        (m,) float64, planned length of the path by then; never falls.
    off_um
        (m,) float64, distance of the wire from the ideal path, left of the direction of travel positive.
    t_s
        (m,) float64.
    """

    row: Ints
    place_um: Floats
    along_um: Floats
    off_um: Floats
    t_s: Floats

    def on(self, one: Pass) -> "WireTaken":
        """The part of the way on a pass."""
        part = slice(*np.searchsorted(self.row, (one.first, one.last + 1)).tolist())
        return WireTaken(self.row[part], self.place_um[part], self.along_um[part], self.off_um[part], self.t_s[part])


class _Cut(NamedTuple):
    """The path with the length before each row, the wire's way along it, and half the width of its kerf."""

    toolpath: Toolpath
    before_um: Floats
    way: WireTaken
    reach_um: float


class _Stations(NamedTuple):
    """Places (k, 2) of the wire, and the direction (k, 2) of the ideal path there."""

    place_um: Floats
    heading: Floats


class _Beside(NamedTuple):
    """How far an earlier wire is ahead of each station (k,) and to the left of it; NaN where it is far off."""

    ahead_um: Floats
    left_um: Floats


def stocks_of(toolpath: Toolpath, passes: Iterable[Pass], way: WireTaken, reach_um: float) -> list[Stock | None]:
    """Stock of each pass, in the order they are cut; None where the wire did not come to one.

    `reach_um` is half the width of the kerf. Along parallel passes the stock is the difference of their offsets.
    """
    cut = _Cut(toolpath, toolpath.before_um, way, reach_um)
    over: dict[int, deque[Pass]] = {}
    found = []
    for one in passes:
        before = over.setdefault(one.edge, deque(maxlen=_MOST_BEFORE))
        found.append(_stock(cut, one, before))
        before.append(one)
    return found


def _stock(cut: _Cut, one: Pass, before: Sequence[Pass]) -> Stock | None:
    taken = cut.way.on(one)
    if not len(taken.row):
        return None
    at = np.flatnonzero(np.diff(np.floor(taken.along_um / _SPACING_UM), prepend=-1.0) > 0.0)
    stations = _Stations(taken.place_um[at], headings_at(cut.toolpath, taken.row[at], taken.place_um[at]))
    seen = [_beside(cut, other, stations) for other in before]
    sides = (one.part_side,) if one.part_side else (-1, 1)
    thick = np.full(len(at), 2.0 * cut.reach_um)
    for beside in seen:
        thick = np.fmin(thick, np.max([_beyond(beside, side, cut.reach_um) for side in sides], axis=0))
    return Stock(float(thick.min()), float(thick.max()), float(thick.mean()))


def _beside(cut: _Cut, other: Pass, stations: _Stations) -> _Beside:
    """Where the wire of another pass was that came nearest to each station, as far as their kerfs may meet."""
    place, taken = stations.place_um, cut.way.on(other)
    ahead, left = np.full((2, len(place)), np.nan)
    curves = cut.toolpath.picked(slice(other.first, other.last + 1))
    near = near_places(curves, place, 2.0 * cut.reach_um)
    if not len(near.row) or not len(taken.row):
        return _Beside(ahead, left)
    off, _ = distance_to_curves(curves, near.row, place[near.other, 0], place[near.other, 1])
    order = np.lexsort((off, near.other))
    at = order[np.flatnonzero(np.diff(near.other[order], prepend=-1))]
    station, row = near.other[at], near.row[at]
    foot = feet(curves, row, place[station]).place_um
    along = cut.before_um[other.first + row] + along_um(curves, row, foot)
    moved = np.interp(along, taken.along_um, taken.off_um)
    by = foot + moved[:, None] * to_left(headings_at(curves, row, foot)) - place[station]
    heading = stations.heading[station]
    ahead[station] = (by * heading).sum(axis=1)
    left[station] = (by * to_left(heading)).sum(axis=1)
    return _Beside(ahead, left)


def _beyond(beside: _Beside, side: int, reach_um: float) -> Floats:
    """How far the kerf reaches beyond an earlier one on a side (k,), at most its width; NaN where they do not meet."""
    chord = reach_um**2 - beside.ahead_um**2
    half = np.sqrt(np.where(chord >= 0.0, chord, np.nan))
    thick: Floats = np.clip(reach_um - (side * beside.left_um + half), 0.0, 2.0 * reach_um)
    return thick
