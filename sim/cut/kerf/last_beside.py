"""The compiled search for the last of the wire's places among those that came as near to a place as any."""

import math
from typing import Final

import numpy as np

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats, Ints

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
    low, cell = np.minimum(wire_um.min(axis=0), place_um.min(axis=0)), within_um + alike_um
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


@compiled("void(i8[::1], i8, i8[:,::1])")
def _about(wire_cell: Ints, cell: int, ranges: Ints) -> None:
    """Fill in which entries (3, 2), first and one past the last, stand in a cell and in those around it, by columns."""
    for at in range(3):
        middle = cell + (at - 1) * _ROWS
        ranges[at, 0] = np.searchsorted(wire_cell, middle - 1)
        ranges[at, 1] = np.searchsorted(wire_cell, middle + 1, side="right")


@compiled("f8(f8[:,::1], i8[:,::1], f8, f8)")
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
