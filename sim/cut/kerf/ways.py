"""The wire's real way through each contour, and the last of its places that came near a place of the edge.

The wire's real way through each contour, as places so near each other that discs about them make a smooth kerf.

Which row's wire made an edge: the row that ran where the wire came nearest to it.

An edge that a cut leaves lies one reach, wire radius and gap, from a place of the wire's real way, and no place of any
way comes nearer to it. So the nearest place tells the row, whatever passes ran beside it.

The compiled search for the last of the wire's places among those that came as near to a place as any.
"""

import math
from collections.abc import Iterable, Sequence
from typing import Final, NamedTuple

import numpy as np
import shapely

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Floats, Ints, box_of, total_before
from parser.shape.contours import Contour
from sim.table.trace import Trace

NOBODY: Final = -1
"""In place of a row: no wire came within its reach, as at the edge of the work."""

_ROWS: Final = 1 << 31  # more cells than any path has across


def last_beside(wire_um: Floats, place_um: Floats, within_um: float, alike_um: float) -> Ints:
    """Numbers (m,) of the last of the wire's places (w, 2) beside places (m, 2), which need not be near any.

    Beside a place lies the nearest one, if nearer than `within_um`, and those that are farther off than that one by
    `alike_um` at most. NOBODY where none does.
    """
    last = np.full(len(place_um), NOBODY, dtype=np.int64)
    if not len(wire_um) or not len(place_um):
        return last
    low, cell = np.minimum(box_of(wire_um)[0], box_of(place_um)[0]), within_um + alike_um
    wire, place = (_cells((each - low) / cell) for each in (wire_um, place_um))
    order = np.argsort(wire, kind="stable")
    sorted_ = np.ascontiguousarray(wire_um[order]), wire[order], order
    ranges = np.zeros((3, 2), dtype=np.int64)
    _search(sorted_, (np.ascontiguousarray(place_um), place), (within_um, alike_um), ranges, last)
    return last


def _cells(at: Floats) -> Ints:
    """Numbers (m,) of cells, those of one column one after the other."""
    column, row = np.floor(at).astype(np.int64).T
    cells: Ints = column * _ROWS + row
    return cells


@loop_part("void(i8[::1], i8, i8[:,::1])")
def _about(wire_cell: Ints, cell: int, ranges: Ints) -> None:
    """Fill in which entries (3, 2), first and one past the last, stand in a cell and in those around it, by columns."""
    for at in range(3):
        middle = cell + (at - 1) * _ROWS
        ranges[at, 0] = np.searchsorted(wire_cell, middle - 1)
        ranges[at, 1] = np.searchsorted(wire_cell, middle + 1, side="right")


@loop_part("f8(f8[:,::1], i8[:,::1], f8, f8)")
def _nearest_squared(wire_um: Floats, ranges: Ints, x: float, y: float) -> float:
    """Square of the distance of a place from the nearest of some entries."""
    nearest = math.inf
    for first, past in ranges:
        for entry in range(first, past):
            by_x, by_y = wire_um[entry, 0] - x, wire_um[entry, 1] - y
            nearest = min(nearest, by_x * by_x + by_y * by_y)
    return nearest


@compiled(
    "void(Tuple((f8[:,::1], i8[::1], i8[::1])), Tuple((f8[:,::1], i8[::1])), UniTuple(f8, 2), i8[:,::1], i8[::1])"
)
def _search(
    wire: tuple[Floats, Ints, Ints], places: tuple[Floats, Ints], within: tuple[float, float], ranges: Ints, last: Ints
) -> None:
    """Fill in the last numbers: of the wire, sorted by its cells, and of places with theirs, as wide as `within`.

    `ranges` (3, 2) is room for the entries about a place.
    """
    (wire_um, wire_cell, number), (place_um, place_cell), (within_um, alike_um) = wire, places, within
    for at in range(len(place_um)):
        if at == 0 or place_cell[at] != place_cell[at - 1]:
            _about(wire_cell, place_cell[at], ranges)
        x, y = place_um[at, 0], place_um[at, 1]
        nearest_um = math.sqrt(_nearest_squared(wire_um, ranges, x, y))
        if nearest_um >= within_um:
            continue
        most = (nearest_um + alike_um) ** 2
        for first, past in ranges:
            for entry in range(first, past):
                by_x, by_y = wire_um[entry, 0] - x, wire_um[entry, 1] - y
                if by_x * by_x + by_y * by_y <= most:
                    last[at] = max(last[at], number[entry])


_SCALLOP_UM = 0.02  # left standing between two discs one behind the other; steps are 1 µm
_STANDING_UM = 0.25  # places nearer to the one before add nothing: a wire that waits


class WireWay(NamedTuple):
    """The wire's way through one contour, m places.

    Attributes
    ----------
    place_um
        (m, 2) float64, the wire's centre.
    along_um
        (m,) float64, length of the way from its start.
    t_s
        (m,) float64.
    row
        (m,) int64, row of the toolpath that was running.
    """

    place_um: Floats
    along_um: Floats
    t_s: Floats
    row: Ints


def wire_ways(trace: Trace, contours: Sequence[Contour], offset_um: float) -> tuple[WireWay, ...]:
    """Ways through the contours, empty where the trace ends before one begins."""
    first = np.searchsorted(trace.row, [contour.first - 1 for contour in contours])
    past = np.searchsorted(trace.row, [contour.last for contour in contours])
    # The discharge begins where the wire stands after the jump.
    first = np.where(past > first, np.maximum(first - 1, 0), first)
    spacing = spacing_um(offset_um)
    return tuple(_wire_way(trace, slice(low, high), spacing) for low, high in zip(first, past, strict=True))


def spacing_um(offset_um: float) -> float:
    """Distance of discs of radius `offset_um` that leave scallops of 0.02 µm between them: d²/8r high."""
    return float(np.sqrt(8.0 * offset_um * _SCALLOP_UM))


def _wire_way(trace: Trace, samples: slice, spacing: float) -> WireWay:
    place, t_s, row = trace.wire_um[samples], trace.t_s[samples], trace.row[samples]
    if not len(row):
        return WireWay(place, t_s, t_s, row)
    number = np.maximum(np.ceil(_steps_um(place) / spacing), 1.0).astype(np.int64)
    before = np.repeat(np.arange(len(number)), number)
    share = (np.arange(len(before)) - np.repeat(np.cumsum(number) - number, number) + 1.0) / number[before]
    place = np.concatenate([place[:1], place[before] + share[:, None] * np.diff(place, axis=0)[before]])
    t_s = np.concatenate([t_s[:1], t_s[before] + share * np.diff(t_s)[before]])
    row = np.concatenate([row[1:2], row[before + 1]]) if len(before) else row
    along = total_before(_steps_um(place))
    moved = np.diff(np.floor(along / _STANDING_UM), prepend=-1.0) > 0.0
    return WireWay(place[moved], along[moved], t_s[moved], row[moved])


def _steps_um(place: Floats) -> Floats:
    by = np.diff(place, axis=0)
    return np.hypot(by[:, 0], by[:, 1])


_INEXACT_UM = 0.2  # an edge may lie beside the discs of the wire by so much: outlines are simplified by 0.05 µm
_SPACING = 0.25  # reaches between the places of an edge that is looked at
_MOST_PLACES = 2000  # of them
_IN_A_STRIP = 500_000  # places of the wire: some 50 MB while they are sorted
_ALIKE_UM = 0.04  # passes on one way come equally near but for this: each way is known at places some 4 µm apart


def rows_that_made(ways: Iterable[WireWay], place_um: Floats, reach_um: float) -> Ints:
    """Rows (m,) of the toolpath whose wire made the places (m, 2) on an edge; NOBODY where none did.

    Where several ran over the same way, it is the last of them. Places are looked at strip by strip along X, so that no
    more of the wire's places are sorted at a time than lie near one strip.
    """
    made = np.full(len(place_um), NOBODY, dtype=np.int64)
    parts = [way for way in ways if len(way.row)]
    if not parts or not len(made):
        return made
    within, x = reach_um + _INEXACT_UM, place_um[:, 0]
    spans = np.array([(way.place_um[:, 0].min(), way.place_um[:, 0].max()) for way in parts])
    for strip in _strips(x, sum(len(way.row) for way in parts)):
        low, high = float(x[strip].min()) - within - _ALIKE_UM, float(x[strip].max()) + within + _ALIKE_UM
        near = [parts[at] for at in np.flatnonzero((spans[:, 0] <= high) & (spans[:, 1] >= low)).tolist()]
        picked = [(way, (way.place_um[:, 0] >= low) & (way.place_um[:, 0] <= high)) for way in near]
        # Ways are in the order they are cut.
        wire = np.concatenate([np.empty((0, 2)), *(way.place_um[which] for way, which in picked)])
        row = np.concatenate([np.empty(0, dtype=np.int64), *(way.row[which] for way, which in picked)])
        last = last_beside(wire, place_um[strip], within, _ALIKE_UM)
        is_made = last != NOBODY
        made[strip[is_made]] = row[last[is_made]]
    return made


def _strips(x_um: Floats, wire: int) -> list[Ints]:
    """Indices of places (m,), in strips along X, of which each has its share of the wire's places."""
    number = -(-wire // _IN_A_STRIP)
    if number == 1:
        return [np.arange(len(x_um))]
    return [strip for strip in np.array_split(np.argsort(x_um, kind="stable"), number) if len(strip)]


def lines_of(way_um: Sequence[Floats]) -> shapely.MultiLineString:
    """Stretches of the wire's way as lines, each places (p, 2) one after the other; prepared, as many edges may ask."""
    lines = shapely.MultiLineString([places for places in way_um if len(places) > 1])
    shapely.prepare(lines)
    return lines


def share_made(edge_um: shapely.LinearRing, way_um: shapely.MultiLineString, reach_um: float) -> float:
    """Share of an edge that the wire made on some stretches of its way (`lines_of`)."""
    if way_um.is_empty:
        return 0.0
    spacing = max(_SPACING * reach_um, edge_um.length / _MOST_PLACES)
    places = shapely.line_interpolate_point(edge_um, np.arange(0.0, edge_um.length, spacing))
    return float(np.mean(shapely.dwithin(way_um, places, reach_um + _INEXACT_UM)))
