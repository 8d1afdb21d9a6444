"""What is looked at of a path before its blocks are told one by one: on which axis they count, and what lies across.

Places to which a path comes again, and the arcs that decide how near it can end to them.

A line goes whole µm, and so does an arc on its count axis, unless it passes an extreme of it. On the other axis an arc
ends anywhere. So the last arc of a way that is free on an axis decides which part of a µm the way has there.
"""

from typing import NamedTuple

import numpy as np

from parser.controller_words import Axis
from parser.geometry.curves import Bools, Curves, Floats, Ints

_SAME_UM = 1e-6


class Pin(NamedTuple):
    """An arc ends whole µm from a place, by its number, on an axis: 0 for X, 1 for Y."""

    place: int
    axis: int


class Revisits(NamedTuple):
    """The places of a path of n rows.

    Attributes
    ----------
    first
        Number of the place where it begins.
    place
        (n,) numbers of the places where the rows end; the same number for the same place.
    closing
        Numbers of the rows that end behind each stretch that comes to where the path was before.
    pinned
        Arcs, by their rows, that decide how near the path ends to where it was before.
    """

    first: int
    place: list[int]
    closing: list[int]
    pinned: dict[int, list[Pin]]


def revisits(curves: Curves, counted: Ints, radii: Ints) -> Revisits:
    """The places of a path of one row or more; `counted` and `radii` as in `LookedAt`."""
    number = _numbered(np.concatenate([curves.start_um[:1], curves.end_um]))
    _, first, inverse = np.unique(number, return_index=True, return_inverse=True)
    since = first[inverse][1:]  # so many rows end before the path comes to the place of a row for the first time
    is_again = since <= np.arange(len(curves))
    begins = np.flatnonzero(is_again & ~np.append(False, is_again[:-1]))
    place = number[1:].tolist()
    pinned: dict[int, list[Pin]] = {}
    for axis in (0, 1):
        is_free = curves.is_arc & ((counted != axis) | (radii != 0))
        last = np.maximum.accumulate(np.where(is_free, np.arange(len(curves)), -1))
        taken: set[int] = set()
        for row in begins.tolist():
            arc = int(last[row])
            if arc >= since[row] and not is_again[arc] and arc not in taken:
                taken.add(arc)
                pinned.setdefault(arc, []).append(Pin(place[row], axis))
    closing = [past for past in (begins + 1).tolist() if past < len(place)]
    return Revisits(int(number[0]), place, closing, pinned)


def _numbered(places: Floats) -> Ints:
    """(m,) a number for each place (m, 2), the same for the same place but for rounding of its numbers."""
    x, y = (_columns_numbered(column) for column in places.T)
    return x * len(places) + y


def _columns_numbered(column: Floats) -> Ints:
    order = np.argsort(column)
    number = np.empty(len(column), dtype=np.int64)
    number[order] = np.cumsum(np.append(False, np.diff(column[order]) > _SAME_UM))
    return number


_SHARES = np.array([0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0])
"""Places of an arc that are looked at: between two of them an arc of a whole turn bows out by 8 % of what it is off."""
_ON_EXTREME_RAD = 1e-9


class LookedAt(NamedTuple):
    """What is looked at of a path of n rows.

    Attributes
    ----------
    end, is_arc, is_placed
        (n) of the rows: placed ones end at the very place.
    again
        Where the path comes to places again.
    across, across_next
        (n) unit vectors across the end of each row, and across the beginning of the one behind it; along the last row.
    counted
        (n) count axis that the rule of the trade names, 0 for X and 1 for Y.
    radii
        (n) by how many radii an arc goes on its count axis, beside whole µm: 0 where it passes no extreme of it.
    at
        (n) place among the arcs.
    center, radius, sweep
        Of the k arcs, as in `Curves`.
    ways
        (k, 8, 2) unit vectors from the centre to the places that are looked at, the last one the end.
    """

    end: list[tuple[float, float]]
    is_arc: list[bool]
    is_placed: list[bool]
    again: Revisits
    across: list[list[float]]
    across_next: list[list[float]]
    counted: list[int]
    radii: list[int]
    at: list[int]
    center: list[list[float]]
    radius: list[float]
    sweep: list[float]
    ways: Floats


def looked_at(curves: Curves, is_placed: Bools) -> LookedAt:
    """What is looked at of a path of one row or more."""
    row = np.flatnonzero(curves.is_arc)
    at = np.zeros(len(curves), dtype=np.int64)
    at[row] = np.arange(len(row))
    angle = curves.start_angle_rad[row, None] + curves.sweep_rad[row, None] * _SHARES
    counted = counted_axes(curves)
    radii = radii_counted(curves, counted)
    begin, end = _across(curves)
    return LookedAt(
        end=[(x, y) for x, y in curves.end_um.tolist()],
        is_arc=curves.is_arc.tolist(),
        is_placed=is_placed.tolist(),
        again=revisits(curves, counted, radii),
        across=end.tolist(),
        across_next=[*begin[1:].tolist(), [-end[-1, 1], end[-1, 0]]],
        counted=counted.tolist(),
        radii=radii.tolist(),
        at=at.tolist(),
        center=curves.center_um[row].tolist(),
        radius=curves.radius_um[row].tolist(),
        sweep=curves.sweep_rad[row].tolist(),
        ways=np.stack([np.cos(angle), np.sin(angle)], axis=2),
    )


def counted_axes(curves: Curves) -> Ints:
    """(n,) axes that rows count on by the trade's rule (docs/3b.md §1); of lines that of an arc, which is no matter."""
    out = np.abs(curves.end_um - np.where(curves.is_arc[:, None], curves.center_um, 0.0))
    return np.where(out[:, 0] > out[:, 1], np.int64(Axis.Y), np.int64(Axis.X))


def radii_counted(curves: Curves, counted: Ints) -> Ints:
    """(n,) by how many radii arcs go on their count axis, signed, beside whole µm.

    From a start s to an extreme r of a circle of radius R the controller counts R − s, and back to an end e again
    R − e. So e = 2R − s − J: beside whole µm it lies 2R off, behind q extremes 2qR, to the side of the first one or of
    the other in turn.
    """
    turn = np.sign(curves.sweep_rad)
    low = np.where(curves.is_arc, curves.start_angle_rad, 0.0) - np.where(counted == Axis.Y, 0.5 * np.pi, 0.0)
    high = low + curves.sweep_rad
    first = np.where(
        turn > 0.0, np.floor((low + _ON_EXTREME_RAD) / np.pi) + 1.0, np.ceil((low - _ON_EXTREME_RAD) / np.pi) - 1.0
    )
    last = np.where(
        turn > 0.0, np.ceil((high - _ON_EXTREME_RAD) / np.pi) - 1.0, np.floor((high + _ON_EXTREME_RAD) / np.pi) + 1.0
    )
    passed = np.where(curves.is_arc, np.maximum(turn * (last - first) + 1.0, 0.0), 0.0)
    sign = np.where((first + passed) % 2.0 == 1.0, 1.0, -1.0)
    return (2.0 * sign * passed).astype(np.int64)


def _across(curves: Curves) -> tuple[Floats, Floats]:
    """Unit vectors (n, 2) across the beginnings of rows, and across their ends; 0 where a line has no length."""
    by = curves.end_um - curves.start_um
    length = np.hypot(by[:, 0], by[:, 1])
    line = np.column_stack([-by[:, 1], by[:, 0]]) / np.where(length > 0.0, length, 1.0)[:, None]
    low = np.where(curves.is_arc, curves.start_angle_rad, 0.0)
    begin, end = (np.column_stack([np.cos(angle), np.sin(angle)]) for angle in (low, low + curves.sweep_rad))
    is_arc: Bools = curves.is_arc[:, None]
    return np.where(is_arc, begin, line), np.where(is_arc, end, line)
