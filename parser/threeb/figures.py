"""Figures of a program: start nodes become rows, and the lines that run in the air between two figures become jumps.

3B has no word for a jump: after a ``D`` the wire is taken out, and the lines to the next figure look like any other.
"""

from bisect import bisect_left
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import CurveKind, Floats, Ints
from parser.shape.closing import corners_at, ends_closed, late_first
from parser.shape.parallel_runs import BESIDE_UM
from parser.threeb.columns import RawBlocks
from parser.threeb.reader import Mark
from parser.toolpath import Toolpath

_MOST_JUMPS = 3  # lines in one way to the next figure; a figure of lines and the jump to it make more
_MOST_TABS = 8  # of one figure, each behind a pause of its own
_KERF_SHARE = 0.05  # of the length of a figure: no kerf is wider


class Nodes(NamedTuple):
    """Start nodes: `origin_um` where the program starts, and m rows that go to absolute places.

    `row` is (m,) int64, `target_um` (m, 2) float64.
    """

    origin_um: Floats
    row: Ints
    target_um: Floats


def with_node_rows(blocks: RawBlocks, marks: Sequence[Mark]) -> tuple[RawBlocks, tuple[Mark, ...], Nodes]:
    """Blocks with an empty row for each start node past the first block, marks moved along, and the nodes.

    The last node before the first block is the origin; without one it is (0, 0).
    """
    first = [mark for mark in marks if mark.kind == "node" and mark.after == 0]
    nodes = [mark for mark in marks if mark.kind == "node" and mark.after > 0]
    origin = np.array([first[-1].x_um, first[-1].y_um] if first else [0.0, 0.0])
    moved = placed_marks(marks)
    rows = np.array([row for row, mark in moved if mark.kind == "node" and mark.after > 0], dtype=np.int64)
    target = np.array([(node.x_um, node.y_um) for node in nodes]).reshape(-1, 2)
    placed = tuple(mark._replace(after=row) for row, mark in moved)
    return _insert(blocks, nodes), placed, Nodes(origin, rows, target)


def placed_marks(marks: Sequence[Mark]) -> list[tuple[int, Mark]]:
    """Marks with how many rows of the toolpath stand before each: its blocks and the start nodes past the first."""
    placed, nodes = [], 0
    for mark in marks:
        placed.append((mark.after + nodes, mark))
        nodes += mark.kind == "node" and mark.after > 0
    return placed


def air_lines(toolpath: Toolpath, pauses: Sequence[int]) -> Ints:
    """Rows that are jumps: the lines in the air between two figures. `pauses` are the rows before each ``D``, rising.

    Notes
    -----
    Up to three lines alone between two pauses (wire out, wire in) are jumps, even if the figure before them did not
    close. But if they close it, or what follows them does, they are cut, behind a pause in which the slug is clamped:
    a figure may have several tabs. More blocks after a
    pause are a figure with the jump to it: their first line is the jump if the figure before is closed, and if their
    own figure does not need that line to close. No wire is threaded where the figure before has a corner: a line that
    ends within a kerf of one goes to another pass over its edge, or cuts the tab that held the slug; and so do blocks
    of which the last one ends there, since a figure of its own ends by its own thread point. More lines than three are
    the way to a figure that closes where they end.
    """
    rows: list[int] = []
    begin = 0  # first row of the figure being cut
    stops = [*pauses, len(toolpath)]
    for at, until, after in zip(stops, stops[1:], [*stops[2:], len(toolpath)], strict=False):
        if at >= until or at <= begin or toolpath.kind[at] == CurveKind.ARC:
            continue
        is_closed = ends_closed(toolpath, begin, at)
        lines = until < len(toolpath) and not (toolpath.kind[at:until] == CurveKind.ARC).any()
        if until - at <= _MOST_JUMPS:
            is_way = is_closed or not (_close(toolpath, begin, at, until) or _closed_later(toolpath, begin, at, stops))
        else:
            is_way = is_closed and ends_closed(toolpath, until, after) and is_open_way(toolpath, at, until, after)
        if lines and is_way:
            past = until
        elif is_closed and not (ends_closed(toolpath, at, until) and not ends_closed(toolpath, at + 1, until)):
            past = at + 1
        else:
            continue
        if not any(_at_cut_corner(toolpath, begin, at, row) for row in (past - 1, until - 1)):
            rows.extend(range(at, past))
            begin = past
    return np.array(rows, dtype=np.int64)


def _closed_later(toolpath: Toolpath, begin: int, at: int, stops: Sequence[int]) -> bool:
    """Whether what follows the lines from `at` ends at a corner of the figure begun at `begin`, left before them.

    What follows are further such lines, up to `_MOST_TABS` of them, and the rows up to the next pause. `stops` are the
    rows before each pause, and the number of all rows.
    """
    stop = bisect_left(stops, at) + 1
    last = min(stop + _MOST_TABS, len(stops) - 2)
    while stop < last and stops[stop + 1] - stops[stop] <= _MOST_JUMPS:
        stop += 1
    end = stops[min(stop + 1, len(stops) - 1)]
    place = toolpath.end_um[end - 1]
    return any(corners_at(toolpath, first, at, place).size > 0 for first in late_first(begin, at))


def is_open_way(toolpath: Toolpath, at: int, until: int, after: int) -> bool:
    """Whether the rows from `at` up to but without `until` close no figure, neither with the first nor without it.

    Nor may the rows from there up to but without `after` close it, behind a pause in which the slug is clamped.
    """
    closed = ends_closed(toolpath, at, until) or ends_closed(toolpath, at + 1, until)
    return not closed and not _close(toolpath, at + 1, until, after)


def _close(toolpath: Toolpath, begin: int, at: int, until: int) -> bool:
    """Whether one of the rows from `at` up to but without `until` ends at a corner of the figure begun at `begin`."""
    return any(corners_at(toolpath, begin, at, end).size for end in toolpath.end_um[at:until])


def _at_cut_corner(toolpath: Toolpath, begin: int, at: int, row: int) -> bool:
    """Whether a row ends within a kerf of a corner that the rows from `begin` up to but without `at` have."""
    return any(_by_corner(toolpath, first, at, row) for first in late_first(begin, at))


def _by_corner(toolpath: Toolpath, begin: int, at: int, row: int) -> bool:
    corner = np.concatenate([toolpath.start_um[begin:at], toolpath.end_um[at - 1 : at]])
    off = np.hypot(*(corner - toolpath.end_um[row]).T)
    return bool((off <= min(BESIDE_UM, _KERF_SHARE * float(toolpath.length_um[begin:at].sum()))).any())


def _insert(blocks: RawBlocks, nodes: Sequence[Mark]) -> RawBlocks:
    """A row with zero count for each node, named after the source line of the node."""
    if not nodes:
        return blocks
    at = [node.after for node in nodes]
    columns = blocks._asdict()
    for name in ("x_um", "y_um", "count_um", "count_axis", "turn", "curve"):
        columns[name] = np.insert(columns[name], at, 0)
    columns["radius_um"] = np.insert(columns["radius_um"], at, -1)
    columns["quadrant"] = np.insert(blocks.quadrant, at, 1)
    columns["line"] = np.insert(blocks.line, at, [node.line for node in nodes])
    columns["span"] = np.insert(blocks.span, at, [node.span for node in nodes], axis=0)
    columns["printed_um"] = np.insert(blocks.printed_um, at, np.nan, axis=0)
    columns["label"] = tuple(np.insert(np.array(blocks.label, dtype=object), at, ""))
    return RawBlocks(**columns)
