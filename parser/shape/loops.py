"""The closed loop of a contour, behind its lead-in, and which side of it the part lies on."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Curves, Floats, Ints, total_before, turned_about
from parser.geometry.distance import distance_to_curves
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.toolpath import Toolpath

_LEAD_IN_BLOCKS = 4  # at most; the loop begins no later
_ROUNDING_UM = 1.0


class Loops(NamedTuple):
    """The first loop that each of k contours closes.

    Attributes
    ----------
    contour
        (k,) contour numbers, those of contours without a loop left out.
    first, last
        (k,) rows. The last one ends where the first begins, or passes that place.
    part_side
        (k,) +1 with the part on the left of the path, −1 on the right, 0 unknown for want of a lead-in. The lead-in
        comes from the scrap: from inside the loop of a die, from outside that of a punch.
    """

    contour: Ints
    first: Ints
    last: Ints
    part_side: Ints


class _Ring(NamedTuple):
    """Blocks (m,) of k loops: their rows, which loop each is of, their ends (m, 2), and the angle each turns."""

    row: Ints
    of: Ints
    start_um: Floats
    end_um: Floats
    turn_rad: Floats


class _Part(NamedTuple):
    """Rows (m,) of k contours, and which of the k each is of."""

    row: Ints
    of: Ints

    def take(self, at: NDArray[np.bool_]) -> "_Part":
        """Those rows where `at` (m,) is True."""
        return _Part(self.row[at], self.of[at])


def find_loops(toolpath: Toolpath, contour_of_row: Ints, wanted: Ints, within_um: float = CLOSED_WITHIN_UM) -> Loops:
    """Loops of the contours `wanted` (k,), numbers that occur in `contour_of_row` (n,), in order.

    A path comes back where it passes a place within `within_um` of its start.
    """
    row = np.flatnonzero(np.isin(contour_of_row, wanted))
    contour, begin, of, number = np.unique(
        contour_of_row[row], return_index=True, return_inverse=True, return_counts=True
    )
    begin, run = row[begin], total_before(toolpath.length_um)
    lead_past = np.minimum(begin + _LEAD_IN_BLOCKS, len(toolpath))
    near = _may_pass(toolpath, row, toolpath.start_um[begin][of], (run[lead_past] - run[begin] + within_um)[of])
    part = _Part(row, of).take(near)
    first, last = begin.copy(), np.full(len(contour), len(toolpath), dtype=np.int64)
    for skipped in range(_LEAD_IN_BLOCKS + 1):
        met = np.where(
            skipped < number,
            _first_met(toolpath, part, np.minimum(begin + skipped, len(toolpath) - 1), run, within_um),
            len(toolpath),
        )
        earlier = met < last
        first[earlier], last[earlier] = begin[earlier] + skipped, met[earlier]
    closed = np.flatnonzero(last < len(toolpath))
    contour, begin, first, last = (column[closed] for column in (contour, begin, first, last))
    return Loops(contour, first, last, part_sides(toolpath, begin, first, last))


def _first_met(toolpath: Toolpath, part: _Part, first: Ints, run_um: Floats, within_um: float) -> Ints:
    """Rows (k,) that are the first to pass the start of the rows `first` (k,) again; n where none does.

    `run_um` (n + 1,) is the length of the path before each row.
    """
    part = part.take(_may_pass(toolpath, part.row, toolpath.start_um[first][part.of], within_um))
    place = toolpath.start_um[first][part.of]
    off, _ = distance_to_curves(toolpath, part.row, place[:, 0], place[:, 1])
    since = run_um[part.row] - run_um[first][part.of]
    # Short first blocks are still near the place they leave; a circle comes back by itself.
    met = (off <= within_um) & (part.row > first[part.of]) & (since > 2.0 * within_um)
    met |= (part.row == first[part.of]) & is_circle(toolpath.picked(first))[part.of]
    at = np.flatnonzero(met)
    which, once = np.unique(part.of[at], return_index=True)
    result = np.full(len(first), len(toolpath), dtype=np.int64)
    result[which] = part.row[at[once]]
    return result


def _may_pass(toolpath: Toolpath, row: Ints, place_um: Floats, within_um: Floats | float) -> NDArray[np.bool_]:
    """Rows (m,) that may come so near to places (m, 2): no block leads farther from its start than it is long."""
    reach = toolpath.length_um[row] + (within_um + _ROUNDING_UM)
    near: NDArray[np.bool_] = np.abs(toolpath.start_um[:, 0][row] - place_um[:, 0]) <= reach
    near &= np.abs(toolpath.start_um[:, 1][row] - place_um[:, 1]) <= reach
    return near


def is_circle(curves: Curves) -> NDArray[np.bool_]:
    """(n,) True on arcs of a full turn or more, and on those that J leaves a few µm short of it."""
    turn = np.abs(curves.sweep_rad)
    circle: NDArray[np.bool_] = turn >= 2.0 * np.pi
    large = np.flatnonzero(turn > np.pi)
    chord = np.hypot(*(curves.end_um[large] - curves.start_um[large]).T)
    circle[large] |= chord <= CLOSED_WITHIN_UM
    return circle


def end_in_waste(toolpath: Toolpath, contour_of_row: Ints, wanted: Ints) -> Ints:
    """Those of the contours `wanted` (k,) that close a loop behind a lead-in and end on the side they came in from."""
    loops = find_loops(toolpath, contour_of_row, wanted)
    led = loops.part_side != 0
    contour, first, last = loops.contour[led], loops.first[led], loops.last[led]
    row = np.flatnonzero(np.isin(contour_of_row, contour))
    edge = np.diff(contour_of_row[row], prepend=-1) != 0
    begin, end = row[edge], row[np.append(edge[1:], True)] if len(row) else row
    ring = _ring(toolpath, first, last)
    came = _is_inside(toolpath, ring, toolpath.start_um[begin])
    went = _is_inside(toolpath, ring, toolpath.end_um[end])
    in_waste: Ints = contour[came == went]
    return in_waste


def part_sides(toolpath: Toolpath, begin: Ints, first: Ints, last: Ints) -> Ints:
    """Side (k,) of the loops from `first` to `last` that the part lies on, the wire coming in from row `begin`."""
    ring = _ring(toolpath, first, last)
    joint = toolpath.start_um[first][ring.of]
    areas = _doubled_areas(ring.start_um - joint, ring.end_um - joint, ring.turn_rad, toolpath.radius_um[ring.row])
    side = np.sign(np.bincount(ring.of, areas, len(first)))
    side = side * np.where(_is_inside(toolpath, ring, toolpath.start_um[begin]), -1.0, 1.0)
    return np.where(first > begin, side, 0.0).astype(np.int64)


def _ring(toolpath: Toolpath, first: Ints, last: Ints) -> _Ring:
    """Blocks of the loops (k,) from `first` to `last`, the last of each cut off where the first begins."""
    number = last - first + 1
    of = np.repeat(np.arange(len(first)), number)
    row = np.arange(len(of)) + (first - np.cumsum(number) + number)[of]
    start, end = toolpath.start_um[row], toolpath.end_um[row].copy()
    end[row == last[of]] = toolpath.start_um[first]
    return _Ring(row, of, start, end, _turn(toolpath, row, end))


def _is_inside(toolpath: Toolpath, ring: _Ring, place_um: Floats) -> NDArray[np.bool_]:
    """Whether places (k, 2) lie inside their loops."""
    place = place_um[ring.of]
    radial = toolpath.center_um[ring.row] - place
    in_disc = np.hypot(radial[:, 0], radial[:, 1]) < toolpath.radius_um[ring.row]
    turned = turned_about(ring.start_um - place, ring.end_um - place, ring.turn_rad, in_disc)
    inside: NDArray[np.bool_] = np.rint(np.bincount(ring.of, turned, len(place_um)) / (2.0 * np.pi)) != 0.0
    return inside


def _turn(toolpath: Toolpath, row: Ints, end: Floats) -> Floats:
    """Signed angles (m,) that the blocks turn up to the places `end` (m, 2), at most a full turn; 0 on lines."""
    sweep = np.clip(toolpath.sweep_rad[row], -2.0 * np.pi, 2.0 * np.pi)
    radial = end - toolpath.center_um[row]
    angle = np.arctan2(radial[:, 1], radial[:, 0]) - toolpath.start_angle_rad[row]
    reached = np.minimum(np.mod(angle * np.sign(sweep), 2.0 * np.pi), np.abs(sweep)) * np.sign(sweep)
    whole = np.hypot(*(end - toolpath.end_um[row]).T) <= CLOSED_WITHIN_UM
    turn = np.where(toolpath.is_arc[row] & ~whole, reached, sweep)
    # J may leave a full circle a little short.
    return np.where(is_circle(toolpath)[row], np.copysign(2.0 * np.pi, sweep), turn)


def _doubled_areas(start: Floats, end: Floats, turn: Floats, radius: Floats) -> Floats:
    """Twice the signed areas (m,) µm² between the origin and the blocks."""
    segment = np.where(turn == 0.0, 0.0, np.nan_to_num(radius) ** 2 * (turn - np.sin(turn)))
    return start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0] + segment
