"""The closed loops of a contour, behind its lead-in, and which side of them the part lies on.

Loops of contours that close more than one: by their corners, and where these miss, by the places that they pass.

Where a path comes back to a place that it left: the loops that it closes, one behind the other.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.along import places
from parser.geometry.curves import Bools, Curves, Floats, Ints, extents, is_inside, total_before, turned_about
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import cell_keys
from parser.shape.contours import CLOSED_WITHIN_UM, contour_rows, runs
from parser.toolpath import Toolpath

_LEAD_IN_BLOCKS = 4  # at most; the loop begins no later
_MOST_PAIRS = 1_000_000  # of blocks of a loop and corners of the turns within it
_ROUNDING_UM = 1.0
_THIN_UM = 3.0  # of area to the length of a loop: of a slot it is half of its width


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
    long = np.flatnonzero((first == begin) & (number > _LEAD_IN_BLOCKS))
    around = _around_turns(toolpath, contour_of_row, begin[long]) if len(long) else {}
    for at in long.tolist() if around else []:
        first[at], last[at] = around.get(int(begin[at]), (first[at], last[at]))
    closed = np.flatnonzero(last < len(toolpath))
    contour, begin, first, last = (column[closed] for column in (contour, begin, first, last))
    return Loops(contour, first, last, part_sides(toolpath, begin, first, last))


def rounds_from_within(toolpath: Toolpath) -> Ints:
    """First rows (k,) of the first loops of contours whose wire is threaded within them, as in a hole."""
    contour = contour_rows(toolpath)
    loops = find_loops(toolpath, contour, np.arange(contour.max(initial=-1) + 1))
    begin = toolpath.start_um[runs(toolpath)[loops.contour, 0]]
    led = loops.part_side != 0
    inside = _is_inside(toolpath, _ring(toolpath, loops.first, loops.last), begin)
    first: Ints = loops.first[led & inside]
    return first


def _around_turns(toolpath: Toolpath, contour_of_row: Ints, begin: Ints) -> dict[int, tuple[int, int]]:
    """First and last row of the loop round all of the way to it, by the row that a contour begins with.

    Of the contours that begin with the rows `begin` (k,). A hole without a core is cut so: the wire takes the slug away
    in turns of which none closes, and then goes round.
    """
    wanted = np.isin(contour_of_row, contour_of_row[begin])
    begins = np.full(int(contour_of_row.max(initial=-1)) + 1, len(toolpath))
    begins[contour_of_row[begin]] = begin
    found: dict[int, tuple[int, int]] = {}
    for first, last in zip(*loops_in_order(toolpath, np.where(wanted, contour_of_row, -1)), strict=True):
        start = int(begins[contour_of_row[first]])
        if first - start > _LEAD_IN_BLOCKS and start not in found and _holds(toolpath, start, first, last):
            found[start] = int(first), int(last)
    return found


def _holds(toolpath: Toolpath, begin: int, first: int, last: int) -> bool:
    """Whether the corners of the way from one row to the start of a loop lie within the loop."""
    ring, way_um = toolpath.picked(slice(first, last + 1)), toolpath.start_um[begin:first]
    low, high = (edge(ends, axis=0) for edge, ends in zip((np.min, np.max), extents(ring), strict=True))
    # The start hole first: a long way may close many small loops, and lies beside all of them.
    for some_um in (way_um[:1], way_um):
        if (some_um < low).any() or (some_um > high).any():
            return False
    if len(ring) * len(way_um) > _MOST_PAIRS:
        return False
    return bool(is_inside(ring, way_um).all())


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


def are_there_and_back(toolpath: Toolpath, first: Ints, last: Ints) -> Bools:
    """Whether loops (k,) go out and back on one way, as over a tab or by an overcut: they have no area to speak of."""
    ring, before = _ring(toolpath, first, last), toolpath.before_um
    joint = toolpath.start_um[first][ring.of]
    doubled = _doubled_areas(ring.start_um - joint, ring.end_um - joint, ring.turn_rad, toolpath.radius_um[ring.row])
    enclosed_um2 = 0.5 * np.abs(np.bincount(ring.of, doubled, len(first)))
    thin: Bools = enclosed_um2 <= _THIN_UM * (before[last + 1] - before[first])
    return thin


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


_CELLS = 1 << 31  # more cells than any path has across


def loops_in_order(toolpath: Toolpath, contour: Ints) -> tuple[Ints, Ints]:
    """First and last rows (m,) of loops that follow each other: each ends where one of its rows began.

    `contour` (n,) is each row's contour, −1 where it has none.
    """
    back = latest_return(toolpath, contour)
    first, last = [], []
    free = 0  # first row that no loop holds yet
    for row in np.flatnonzero(back >= 0).tolist():
        if back[row] >= free:
            first.append(int(back[row]))
            last.append(row)
            free = row + 1
    return np.array(first, dtype=np.int64), np.array(last, dtype=np.int64)


def latest_return(toolpath: Toolpath, contour: Ints) -> Ints:
    """(n,) for each row the latest row of its contour that starts where it ends; itself for a circle, −1 for none.

    Corners within 5 µm of each other share a cell of one of four grids of 10 µm that lie 5 µm apart.
    """
    back = np.full(len(toolpath), -1, dtype=np.int64)
    full = np.flatnonzero(toolpath.is_arc & (np.abs(toolpath.sweep_rad) > np.pi))
    near = np.hypot(*(toolpath.end_um[full] - toolpath.start_um[full]).T) <= CLOSED_WITHIN_UM
    back[full[near]] = full[near]
    # Each row ends where the next one starts.
    corner = np.concatenate([toolpath.start_um[:1], toolpath.end_um])
    for shift in np.ndindex(2, 2):
        cells = np.floor(corner / (2.0 * CLOSED_WITHIN_UM) + np.array(shift) / 2.0).astype(np.int64)
        key = cells[:, 0] * _CELLS + cells[:, 1]
        shared = _may_share(key)
        order = shared[np.argsort(key[shared], kind="stable")]
        before = np.append(-1, order[:-1])
        # The corner before one in its cell may be the start of the same row; then it is the one before that.
        before = np.where(before == order - 1, np.append([-1, -1], order[:-2])[: len(order)], before)
        at = np.flatnonzero((before >= 0) & (key[before] == key[order]))
        row, earlier = order[at] - 1, before[at]
        gap = corner[order[at]] - corner[earlier]
        hit = (row > earlier) & (contour[row] >= 0) & (contour[earlier] == contour[row])
        hit &= np.hypot(gap[:, 0], gap[:, 1]) <= CLOSED_WITHIN_UM
        back[row[hit]] = np.maximum(back[row[hit]], earlier[hit])
    return back


def _may_share(key: Ints) -> Ints:
    """Which of the keys (m,) may occur more than once, in order: the others need not be sorted."""
    bits = len(key).bit_length() + 1
    tally = cell_keys(key, 0) >> (63 - bits) & ((1 << bits) - 1)  # the upper bits are mixed best
    return np.flatnonzero(np.bincount(tally)[tally] > 1)


_NEAR_START_UM = 12.0  # ends of many arcs in a row drift so far; passes over one edge may begin nearer to each other
_MOST_ROUNDS = 6  # loops behind each other that end at no corner where they began


def several_loops(toolpath: Toolpath, contour: Ints) -> tuple[Ints, Ints, Bools]:
    """First and last rows (k,) of the loops of contours that close several, and whether they end at a corner.

    `contour` (n,) is each row's, −1 on jumps. A way from the start hole back to it is looked at within.
    """
    at_hole = _at_hole(toolpath, contour)
    first, last = _by_corners(toolpath, contour, at_hole)
    by_corner = len(first)
    count = np.bincount(contour[np.concatenate([first, np.flatnonzero(at_hole)])], minlength=1)
    sought = (contour >= 0) & (count > 1)[contour]
    for _ in range(_MOST_ROUNDS):
        gap = _gaps(contour, at_hole, sought & ~_inside(first, last, len(toolpath)))
        found = find_loops(toolpath, gap, np.arange(gap.max(initial=-1) + 1), _NEAR_START_UM)
        if not len(found.first):
            break
        first, last = np.append(first, found.first), np.append(last, found.last)
        sought &= np.isin(gap, found.contour)
    is_sure = np.arange(len(first)) < by_corner
    several = np.bincount(contour[first], minlength=1)[contour[first]] > 1
    order = np.argsort(first[several])
    return first[several][order], last[several][order], is_sure[several][order]


def _at_hole(toolpath: Toolpath, contour: Ints) -> Bools:
    """(n,) True on rows that start where their contour begins: in the start hole, where there is a lead-in."""
    begin = toolpath.start_um[runs(toolpath)[:, 0]]
    row = np.flatnonzero(contour >= 0)
    result = np.zeros(len(toolpath), dtype=np.bool_)
    result[row] = np.hypot(*(toolpath.start_um[row] - begin[contour[row]]).T) <= CLOSED_WITHIN_UM
    return result


def _by_corners(toolpath: Toolpath, contour: Ints, at_hole: Bools) -> tuple[Ints, Ints]:
    """First and last rows (k,) of loops that end at a corner where they began.

    A way out and back is none, nor is one by the start hole.
    """
    first, last = loops_in_order(toolpath, contour)
    row = last - 1
    # Short arcs in whole µm have centres that lie far apart: their middles lie together.
    middle = [places(toolpath, each, np.full(len(each), 0.5)) for each in (row, last)]
    out_and_back = (first == row) & (np.hypot(*(middle[0] - middle[1]).T) <= CLOSED_WITHIN_UM)
    before = np.append(0, np.cumsum(at_hole))
    is_kept = ~out_and_back & ~are_there_and_back(toolpath, first, last) & (before[first] == before[last + 1])
    return first[is_kept], last[is_kept]


def _inside(first: Ints, last: Ints, rows: int) -> Bools:
    """(n,) True on the rows of loops."""
    steps = np.zeros(rows + 1, dtype=np.int64)
    np.add.at(steps, first, 1)
    np.add.at(steps, last + 1, -1)
    inside: Bools = np.cumsum(steps[:-1]) > 0
    return inside


def _gaps(contour: Ints, at_hole: Bools, sought: Bools) -> Ints:
    """(n,) number from 0 of each stretch of `sought` rows (n,) of one contour, those at the hole first; else −1."""
    begins = sought & (np.append(True, ~sought[:-1]) | (np.diff(contour, prepend=-1) != 0) | at_hole)
    return np.where(sought, np.cumsum(begins) - 1, -1)
