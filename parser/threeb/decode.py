"""Records to toolpath: exact geometry of every block at once, start nodes, and lines that run in the air.

"Exact" is what the CAM prints: no steps, the radius unrounded, the count length J deciding where a block ends.

Figures of a program: start nodes become rows, and the lines that run in the air between two figures become jumps.

3B has no word for a jump: after a ``D`` the wire is taken out, and the lines to the next figure look like any other.
"""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.controller_words import StepWords
from parser.geometry.curves import CurveKind, Floats, Ints
from parser.shape.contours import corners_at, ends_closed, late_first
from parser.shape.parallel_runs import BESIDE_UM
from parser.step_words.words import moves, with_axes_named, words_of_lines
from parser.text.source import Source
from parser.threeb.columns import RawBlocks
from parser.threeb.reader import Mark, Records
from parser.threeb.tokens import fields_of
from parser.toolpath import Stop, Toolpath

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
    while stop < last and _are_lines(toolpath, stops[stop], stops[stop + 1]):
        stop += 1
    end = stops[min(stop + 1, len(stops) - 1)]
    place = toolpath.end_um[end - 1]
    return any(corners_at(toolpath, first, at, place).size > 0 for first in late_first(begin, at))


def _are_lines(toolpath: Toolpath, at: int, until: int) -> bool:
    """Whether the rows from `at` up to but without `until` may be lines to a tab: a hole may be of as many blocks."""
    return until - at <= _MOST_JUMPS and not (toolpath.kind[at:until] == CurveKind.ARC).any()


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


def decode(records: Records) -> Toolpath:
    """Exact toolpath of the records.

    A block that no machine can finish (`StepWords.is_endless`) keeps its row with length 0, so that the next block
    starts where it stood.
    """
    blocks, marks, nodes = with_node_rows(records.blocks, records.marks)
    words = with_axes_named(StepWords(**{name: getattr(blocks, name) for name in StepWords.__slots__}))
    is_arc = (words.turn != 0) & ~words.is_endless
    made = moves(words)
    start, end = _chain(made.by_um, nodes)
    toolpath = Toolpath(
        kind=np.where(is_arc, CurveKind.ARC, CurveKind.LINE).astype(np.int64),
        start_um=start,
        end_um=end,
        center_um=start + made.center_um,
        radius_um=made.radius_um,
        start_angle_rad=made.start_angle_rad,
        sweep_rad=made.sweep_rad,
        length_um=made.length_um,
        printed_end_um=blocks.printed_um,
        words=words,
        source=Source(records.text, np.arange(1, len(start) + 1), blocks.span, blocks.line, blocks.label, fields_of),
        stops=tuple(Stop("end" if m.kind == "end" else "pause", m.after, m.line) for m in marks if m.kind != "node"),
    )
    jumps = air_lines(toolpath, [m.after for m in marks if m.kind == "pause"])
    return _with_node_words(_with_jumps(toolpath, np.concatenate([jumps, nodes.row])), nodes)


def decoded_words(toolpath: Toolpath) -> StepWords:
    """Words of a decoded toolpath. TypeError for that of a dialect without words."""
    if toolpath.words is None:
        raise TypeError("the blocks of this toolpath have no words")
    return toolpath.words


def _chain(by_um: Floats, nodes: Nodes) -> tuple[Floats, Floats]:
    """Starts and ends of blocks that each begin where the last one ended, or where a start node puts them."""
    end = np.cumsum(by_um, axis=0)
    shifts = np.concatenate([nodes.origin_um[None, :], nodes.target_um - end[nodes.row]])
    end = end + shifts[np.searchsorted(nodes.row, np.arange(len(by_um)), side="right")]
    return np.concatenate([nodes.origin_um[None, :], end[:-1]]), end


def _with_jumps(toolpath: Toolpath, rows: Ints) -> Toolpath:
    kind = toolpath.kind.copy()
    kind[rows] = CurveKind.JUMP
    return replace(toolpath, kind=kind)


def _with_node_words(toolpath: Toolpath, nodes: Nodes) -> Toolpath:
    """Toolpath whose start nodes carry the words and the length of the move to them."""
    if not len(nodes.row):
        return toolpath
    by = toolpath.end_um[nodes.row] - toolpath.start_um[nodes.row]
    of_blocks = decoded_words(toolpath)
    length, columns = toolpath.length_um.copy(), {n: getattr(of_blocks, n).copy() for n in StepWords.__slots__}
    length[nodes.row] = np.hypot(by[:, 0], by[:, 1])
    words = words_of_lines(by)
    for name, column in columns.items():
        column[nodes.row] = getattr(words, name)
    return replace(toolpath, words=StepWords(**columns), length_um=length)
