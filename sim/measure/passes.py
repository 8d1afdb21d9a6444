"""What each pass over an edge comes to, and how much material it takes off; out comes `PassFigures`.

How thick the material is that a pass takes off, at stations along it.

A first pass cuts through solid material: it takes the whole width of its kerf. A later one takes what its kerf reaches
beyond those of the passes before it, on the part's side, or on both where that is not known::

        part
    ------------------ edge of the kerf of this pass    |
    ------------------ edge of the kerf before it       | stock
          o            this wire, at the station: the kerf reaches as far as the wire's reach to all sides
          x            the wire of the pass before it, at its place nearest to the station

Both wires are where they really were: a place on the ideal path of the earlier pass is moved aside by what the wire was
off there.

Figures of each pass: length, time, stock and largest deviation.
"""

from collections import deque
from collections.abc import Iterable, Sequence
from typing import Final, NamedTuple

import numpy as np

from controller.motion.plan import Plan
from parser.geometry.along import along_um, headings_at, to_left
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.distance import distance_to_curves, feet
from parser.geometry.near import near_places
from parser.shape.passes import Pass, Passes
from parser.toolpath import Point, Toolpath
from sim.measure.deviation import across_um, farthest
from sim.table.trace import Trace

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

    def on(self, pass_: Pass) -> "WireTaken":
        """The part of the way on a pass."""
        part = slice(*np.searchsorted(self.row, (pass_.first, pass_.last + 1)).tolist())
        return WireTaken(self.row[part], self.place_um[part], self.along_um[part], self.off_um[part], self.t_s[part])

    def bounds_um(self, pass_: Pass) -> tuple[float, float]:
        """The planned length of the path where the wire was first and last on a pass that it came to."""
        along = self.on(pass_).along_um
        return float(along[0]), float(along[-1])


class _Cut(NamedTuple):
    """The path with the length before each row (n,), the wire's way along it, and half the width of its kerf (n,)."""

    toolpath: Toolpath
    before_um: Floats
    way: WireTaken
    reach_um: Floats


class _Stations(NamedTuple):
    """Places (k, 2) of the wire, and the direction (k, 2) of the ideal path there."""

    place_um: Floats
    heading: Floats


class _EarlierWires(NamedTuple):
    """How far p earlier wires are ahead of each station (p, k) and to the left of it; NaN where one is far off.

    `reach_um` (p, 1) is half the width of the kerf of each.
    """

    ahead_um: Floats
    left_um: Floats
    reach_um: Floats


def stocks_of(toolpath: Toolpath, passes: Iterable[Pass], way: WireTaken, reach_um: Floats) -> list[Stock | None]:
    """Stock of each pass, in the order they are cut; None where the wire did not come to one.

    `reach_um` (n,) is half the width of the kerf in each row. Along parallel passes of one reach the stock is the
    difference of their offsets.
    """
    cut = _Cut(toolpath, toolpath.before_um, way, reach_um)
    over: dict[int, deque[Pass]] = {}
    found = []
    for pass_ in passes:
        before = over.setdefault(pass_.edge, deque(maxlen=_MOST_BEFORE))
        found.append(_stock(cut, pass_, before))
        before.append(pass_)
    return found


def _stock(cut: _Cut, pass_: Pass, before: Sequence[Pass]) -> Stock | None:
    taken = cut.way.on(pass_)
    if not len(taken.row):
        return None
    at = np.flatnonzero(np.diff(np.floor(taken.along_um / _SPACING_UM), prepend=-1.0) > 0.0)
    stations = _Stations(taken.place_um[at], headings_at(cut.toolpath, taken.row[at], taken.place_um[at]))
    earlier = _earlier_wires(cut, before, stations)
    sides = (pass_.part_side,) if pass_.part_side else (-1, 1)
    reach_um = float(cut.reach_um[pass_.first])
    reached = np.max([_beyond(earlier, side, reach_um) for side in sides], axis=0)
    thick = np.fmin.reduce([np.full(len(at), 2.0 * reach_um), *reached])
    return Stock(float(thick.min()), float(thick.max()), float(thick.mean()))


def _earlier_wires(cut: _Cut, before: Sequence[Pass], stations: _Stations) -> _EarlierWires:
    """Where the wires of other passes were that came nearest to each station, as far as their kerfs may meet."""
    place, others = stations.place_um, [other for other in before if len(cut.way.on(other).row)]
    ahead, left = np.full((2, len(others), len(place)), np.nan)
    reach_um = cut.reach_um[np.array([other.first for other in others], dtype=np.int64)][:, None]
    if not others:
        return _EarlierWires(ahead, left, reach_um)
    row = np.concatenate([np.arange(other.first, other.last + 1) for other in others])
    of = np.repeat(np.arange(len(others)), [other.last - other.first + 1 for other in others])
    station, at = _nearest(cut.toolpath.picked(row), of, place, 2.0 * float(cut.reach_um.max()))
    by = _wire(cut, row[at], np.array([cut.way.bounds_um(other) for other in others])[of[at]], place[station])
    heading = stations.heading[station]
    ahead[of[at], station] = (by * heading).sum(axis=1)
    left[of[at], station] = (by * to_left(heading)).sum(axis=1)
    return _EarlierWires(ahead, left, reach_um)


def _nearest(curves: Curves, of: Ints, place: Floats, within_um: float) -> tuple[Ints, Ints]:
    """Pairs (m,) of a place and the curve nearest to it among those of one pass each, `of` (n,) which; within a limit.

    Curves and places are told by their numbers.
    """
    near = near_places(curves, place, within_um)
    off, _ = distance_to_curves(curves, near.row, place[near.other, 0], place[near.other, 1])
    near, off = near.take(np.flatnonzero(off <= within_um)), off[off <= within_um]
    group = of[near.row] * len(place) + near.other
    order = np.lexsort((off, group))
    at = order[np.flatnonzero(np.diff(group[order], prepend=-1))]
    return near.other[at], near.row[at]


def _wire(cut: _Cut, row: Ints, bounds_um: Floats, place: Floats) -> Floats:
    """Ways (m, 2) from places (m, 2) to the wire on the rows (m,) nearest to them.

    `bounds_um` (m, 2) is the length of the path from and to which the wire was on the pass of the row.
    """
    foot = feet(cut.toolpath, row, place).place_um
    along = np.clip(cut.before_um[row] + along_um(cut.toolpath, row, foot), *bounds_um.T)
    moved = np.interp(along, cut.way.along_um, cut.way.off_um)
    return foot + moved[:, None] * to_left(headings_at(cut.toolpath, row, foot)) - place


def _beyond(earlier_wires: _EarlierWires, side: int, reach_um: float) -> Floats:
    """How far a kerf reaches beyond earlier ones on a side (p, k), at most its width; NaN where they do not meet."""
    chord = earlier_wires.reach_um**2 - earlier_wires.ahead_um**2
    half = np.sqrt(np.where(chord >= 0.0, chord, np.nan))
    thick: Floats = np.clip(reach_um - (side * earlier_wires.left_um + half), 0.0, 2.0 * reach_um)
    return thick


class Worst(NamedTuple):
    """The largest deviation of the wire, µm, and where it was met first."""

    deviation_um: float
    place_um: Point


class PassFigures(NamedTuple):
    """What a pass came to.

    Attributes
    ----------
    of
        The pass.
    length_um, time_s
        Length of its ideal path, and planned time on it.
    stock
        How much it takes off; None where the wire did not come to it.
    worst
        Where the wire deviates most; None where it did not come to it.
    """

    of: Pass
    offset_um: float
    length_um: float
    time_s: float
    stock: Stock | None
    worst: Worst | None


def figures_of_passes(
    toolpath: Toolpath, passes: Passes, block_time_s: Floats, way: WireTaken, reach_um: Floats
) -> tuple[PassFigures, ...]:
    """Figures of all passes, in the order they are cut, of the way that the wire took as far as the machine ran.

    `block_time_s` (n,) is the planned time in each block, `reach_um` (n,) half the width of the kerf.
    """
    edge_um = {
        (pass_.edge, pass_.is_tab): float(reach_um[pass_.first])
        for pass_ in passes.passes
        if pass_.shift_um <= pass_.edge_um
    }
    stocks = stocks_of(toolpath, passes.passes, way, reach_um)
    return tuple(
        PassFigures(
            of=pass_,
            offset_um=pass_.offset_um(edge_um[pass_.edge, pass_.is_tab]),
            length_um=float(toolpath.length_um[pass_.first : pass_.last + 1].sum()),
            time_s=float(block_time_s[pass_.first : pass_.last + 1].sum()),
            stock=stock,
            worst=_worst(way.on(pass_)),
        )
        for pass_, stock in zip(passes.passes, stocks, strict=True)
    )


def wire_taken(toolpath: Toolpath, plan: Plan, trace: Trace) -> WireTaken:
    """The way that the wire took in a trace."""
    along = plan.at(trace.t_s).along_um
    off = across_um(toolpath, trace, trace.wire_um, along)
    return WireTaken(trace.row, trace.wire_um, along, off, trace.t_s)


def _worst(way: WireTaken) -> Worst | None:
    """The place of a way that lies farthest from the path, the first such; None where there is none."""
    if not len(way.row):
        return None
    away = np.abs(way.off_um)
    at = farthest(away)
    return Worst(float(away.max()), Point(*way.place_um[at].tolist()))
