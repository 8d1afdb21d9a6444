"""Where a contour crosses itself: places where two of its blocks run through each other.

Only a clear crossing counts. Sound programs touch, overlap and retrace their own path all the time (lead-out along the
lead-in, overcut), each time off by a rounding of 1 µm or two: none of these is a crossing. Where an edge is cut by
several passes, leads and steps to one of them run through the others: nor are these, so near their ends.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.geometry.along import headings_at
from parser.geometry.curves import Bools, Floats, Ints
from parser.geometry.distance import Meets, by_xy, curves_meet
from parser.geometry.near import near_pairs, turn_rad
from parser.shape.parallel_runs import BESIDE_UM
from parser.shape.passes import Passes
from parser.toolpath import Point, Toolpath

CLEAR_UM = 5.0
"""In a crossing both ends of each block lie this far off the other, measured across it; two curves overlap this far at
their lens."""

_CORNER_LOOP_UM = 5000.0
_LEAST_SINE = 0.05
MOST_PAIRS = 4_000_000
_PART = 1 << 15  # pairs looked at in one go; measured: from 2 to the 15 to 2 to the 16 is fastest


class Crossing(NamedTuple):
    """Two blocks, by their rows, and the place where the later one runs through the earlier."""

    later_row: int
    earlier_row: int
    place_um: Point


class Crossings(NamedTuple):
    """Crossings of one contour.

    Attributes
    ----------
    contour
        Its number.
    crossings
        How many were found.
    first
        The one that the wire meets first; None where none was found.
    is_complete
        Whether all its blocks were looked at.
    """

    contour: int
    crossings: int
    first: Crossing | None
    is_complete: bool


class _Found(NamedTuple):
    """Crossings (k,): rows, places (k, 2) µm, and how far along the later block each lies."""

    early: Ints
    late: Ints
    place_um: Floats
    on_late_um: Floats


def find_crossings(
    toolpath: Toolpath, contour_of_row: Ints, passes: Passes, most_pairs: int = MOST_PAIRS
) -> tuple[Crossings, ...]:
    """Contours that cross themselves, and those too dense to be looked at to the end, in the order they are cut.

    Parameters
    ----------
    contour_of_row
        (n,) contour number of each row, −1 on jumps; see `parser.shape.contours`.
    passes
        Those of the toolpath.
    most_pairs
        How many pairs of pieces of blocks are compared at most.
    """
    pairs = near_pairs(toolpath, contour_of_row, 2.0 * CLEAR_UM, most_pairs)
    is_lead = _leads_to_passes(contour_of_row, passes)
    parts = [_none(), *(_crossing(toolpath, is_lead, *some) for some in _in_parts(pairs.early, pairs.late))]
    found = _Found(*(np.concatenate(column) for column in zip(*parts, strict=True)))
    count = np.bincount(contour_of_row[found.late], minlength=1)
    firsts = _firsts(found, contour_of_row[found.late], len(toolpath))
    incomplete = set(pairs.incomplete.tolist())
    return tuple(
        Crossings(
            contour=number,
            crossings=int(count[number]) if number in firsts else 0,
            first=firsts.get(number),
            is_complete=number not in incomplete,
        )
        for number in sorted(firsts.keys() | incomplete)
    )


def _in_parts(early: Ints, late: Ints) -> Iterator[tuple[Ints, Ints]]:
    """The pairs, some thousands at a time: what is worked out of these stays in the processor's cache."""
    for begin in range(0, len(early), _PART):
        yield early[begin : begin + _PART], late[begin : begin + _PART]


def _none() -> _Found:
    rows = np.empty(0, dtype=np.int64)
    return _Found(rows, rows, np.empty((0, 2)), np.empty(0))


def _firsts(found: _Found, contour: Ints, rows: int) -> dict[int, Crossing]:
    """The crossing that the wire meets first in each contour, by the number of that; `contour` (k,) is each one's."""
    row = np.full(int(contour.max(initial=-1)) + 1, rows, dtype=np.int64)
    np.minimum.at(row, contour, found.late)
    at = np.flatnonzero(found.late == row[contour])
    at = at[np.lexsort((found.on_late_um[at], contour[at]))]
    at = at[np.diff(contour[at], prepend=-1) > 0]
    columns = (contour[at], found.late[at], found.early[at], found.place_um[at])
    return {
        number: Crossing(late, early, Point(*place))
        for number, late, early, place in zip(*(column.tolist() for column in columns), strict=True)
    }


def _crossing(toolpath: Toolpath, is_lead: Bools, early: Ints, late: Ints) -> _Found:
    """The crossings of pairs of rows, in their order."""
    meets = curves_meet(toolpath, early, late, CLEAR_UM)
    meets = meets.take(np.flatnonzero(_in_reach(toolpath, meets.early, meets.place_um)))
    meets = meets.take(np.flatnonzero(_in_reach(toolpath, meets.late, meets.place_um)))
    early_um = np.minimum(*_along(toolpath, meets.early, meets.place_um))
    clear = np.flatnonzero(early_um > CLEAR_UM)
    meets, early_um = meets.take(clear), early_um[clear]
    before, after = _along(toolpath, meets.late, meets.place_um)
    late_um = np.minimum(before, after)
    clear = np.flatnonzero(late_um > CLEAR_UM)
    meets, early_um, late_um, on_late = meets.take(clear), early_um[clear], late_um[clear], before[clear]
    sine = _sines(toolpath, meets)
    sides = early_um * sine, late_um * sine
    corner_loop = _is_corner_loop(toolpath, meets)
    clearance = np.minimum(*sides)
    at_pass = _to_passes(is_lead, meets, sides)
    crossing = np.flatnonzero((sine > _LEAST_SINE) & (clearance > CLEAR_UM) & ~corner_loop & ~at_pass)
    return _Found(*meets.take(crossing), on_late[crossing])


def _in_reach(toolpath: Toolpath, row: Ints, place_um: Floats) -> Bools:
    """Whether places (k, 2) lie no farther from the starts of blocks than these are long, as all on them do."""
    reach = toolpath.length_um[row]
    near: Bools = np.abs(place_um[:, 0] - toolpath.start_um[:, 0][row]) <= reach
    near &= np.abs(place_um[:, 1] - toolpath.start_um[:, 1][row]) <= reach
    return near


def _is_corner_loop(toolpath: Toolpath, meets: Meets) -> Bools:
    """Where a CAM overshoots a sharp corner and comes back by a loop of one block, short beside the corner's sides."""
    length = toolpath.length_um
    loop, sides = length[meets.late - 1], np.minimum(length[meets.early], length[meets.late])
    is_loop: Bools = (meets.late - meets.early == 2) & (loop <= np.minimum(_CORNER_LOOP_UM, sides / 2.0))
    return is_loop


def _leads_to_passes(contour_of_row: Ints, passes: Passes) -> Bools:
    """(n,) True on leads and steps of the contours that trim an edge."""
    trimmed = {pass_.edge for pass_ in passes.passes if pass_.number > 1}
    first = [pass_.first for pass_ in passes.passes if pass_.edge in trimmed]
    is_lead: Bools = (passes.of_row < 0) & np.isin(contour_of_row, contour_of_row[first])
    return is_lead


def _to_passes(is_lead: Bools, meets: Meets, sides: tuple[Floats, Floats]) -> Bools:
    """Where a lead or a step ends at another pass over the edge than the one that it runs through.

    `sides` are how far µm the nearer end of the earlier and of the later block lies off the other one.
    """
    early, late = is_lead[meets.early], is_lead[meets.late]
    ends: Bools = (early & late) | (early & (sides[0] <= BESIDE_UM)) | (late & (sides[1] <= BESIDE_UM))
    return ends


def _sines(toolpath: Toolpath, meets: Meets) -> Floats:
    """Sines (k,) of the angles at which blocks meet."""
    a, b = (headings_at(toolpath, row, meets.place_um) for row in (meets.early, meets.late))
    sine: Floats = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    return sine


def _along(toolpath: Toolpath, row: Ints, place_um: Floats) -> tuple[Floats, Floats]:
    """Lengths (k,) µm along the blocks from their start to a place on their curve, and on to their end."""
    by_x, by_y = by_xy(toolpath, row)
    from_x = place_um[:, 0] - toolpath.start_um[:, 0][row]
    from_y = place_um[:, 1] - toolpath.start_um[:, 1][row]
    length = np.hypot(by_x, by_y)
    before = (from_x * by_x + from_y * by_y) / np.where(length > 0.0, length, 1.0)
    after = length - before
    arc = np.flatnonzero(toolpath.is_arc[row])
    if len(arc):
        on = row[arc]
        radial = place_um[arc] - toolpath.center_um[on]
        turned = (np.arctan2(radial[:, 1], radial[:, 0]) - toolpath.start_angle_rad[on]) * np.sign(
            toolpath.sweep_rad[on]
        )
        turned = np.mod(turned, 2.0 * np.pi)
        before[arc] = turned * toolpath.radius_um[on]
        after[arc] = (turn_rad(toolpath)[on] - turned) * toolpath.radius_um[on]
    return before, after
