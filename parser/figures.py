"""Figures of a program: start nodes become rows, and the lines that run in the air between two figures become jumps.

3B has no word for a jump: after a ``D`` the wire is taken out, and the lines to the next figure look like any other.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.reader import Mark, RawBlocks
from parser.toolpath import Floats, Ints

CLOSED_WITHIN_UM = 5.0
"""A figure whose end is this near its start is closed: 1 µm exact per arc, 5 µm stepped (docs/3b.md §3)."""
_MOST_JUMPS = 3  # lines in one way to the next figure; a figure of lines and the jump to it make more


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
    moved, inserted = [], 0
    for mark in marks:
        inserted += mark.kind == "node" and mark.after > 0
        moved.append(mark._replace(after=mark.after + inserted))
    rows = np.array([mark.after - 1 for mark in moved if mark.kind == "node" and mark.after > 0], dtype=np.int64)
    target = np.array([(node.x_um, node.y_um) for node in nodes]).reshape(-1, 2)
    return _insert(blocks, nodes), tuple(moved), Nodes(origin, rows, target)


def air_lines(end_um: Floats, start_um: Floats, is_arc: NDArray[np.bool_], pauses: Sequence[int]) -> Ints:
    """Rows that are jumps: the lines in the air between two figures.

    Parameters
    ----------
    end_um, start_um, is_arc
        Columns of the n blocks.
    pauses
        How many blocks run before each ``D``, rising.

    Notes
    -----
    Up to three lines alone between two pauses (wire out, wire in) are jumps, however badly the figure before them
    closed; more of them are a figure with the jump to it. Else the first line after a pause is the jump if the figure
    before is closed: a pause inside an open figure (to clamp the slug before the last cut) makes none.
    """
    rows: list[int] = []
    begin = 0  # first row of the figure being cut
    stops = [*pauses, len(end_um)]
    for at, until in pairwise(stops):
        if at >= until or at <= begin or is_arc[at]:
            continue
        few_lines = until - at <= _MOST_JUMPS and not is_arc[at:until].any()
        if few_lines and until < len(end_um):
            rows.extend(range(at, until))
            begin = until
        elif _closed(end_um[at - 1], start_um[begin:at]):
            rows.append(at)
            begin = at + 1
    return np.array(rows, dtype=np.int64)


def _closed(end_um: Floats, corners_um: Floats) -> bool:
    """Whether a figure ends at its start or at another corner of its own, such as the end of a lead-in."""
    off = corners_um - end_um
    return bool((np.hypot(off[:, 0], off[:, 1]) <= CLOSED_WITHIN_UM).any())


def _insert(blocks: RawBlocks, nodes: Sequence[Mark]) -> RawBlocks:
    """A row with zero count for each node, named after the source line of the node."""
    if not nodes:
        return blocks
    at = [node.after for node in nodes]
    columns = blocks._asdict()
    for name in ("x_um", "y_um", "count_um", "count_axis", "turn"):
        columns[name] = np.insert(columns[name], at, 0)
    columns["quadrant"] = np.insert(blocks.quadrant, at, 1)
    columns["line"] = np.insert(blocks.line, at, [node.line for node in nodes])
    columns["span"] = np.insert(blocks.span, at, [node.span for node in nodes], axis=0)
    columns["printed_um"] = np.insert(blocks.printed_um, at, np.nan, axis=0)
    columns["label"] = tuple(np.insert(np.array(blocks.label, dtype=object), at, ""))
    return RawBlocks(**columns)
