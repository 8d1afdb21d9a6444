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
    """Rows that are jumps: the lines in the air after a pause that ends a closed figure.

    Parameters
    ----------
    end_um, start_um, is_arc
        Columns of the n blocks.
    pauses
        How many blocks run before each ``D``, rising.

    Notes
    -----
    Two pauses round the jump (wire out, wire in) tell all of its lines. With one, or where the lines close on
    themselves and so are a figure, only the first line can be the jump. A pause inside an open figure (to clamp the
    slug before the last cut) makes none.
    """
    rows: list[int] = []
    begin = 0  # first row of the figure being cut
    stops = [*pauses, len(end_um)]
    for at, until in pairwise(stops):
        if at >= until or at <= begin or is_arc[at] or not _closed(end_um[at - 1], start_um[begin]):
            continue
        between_pauses = until < len(end_um) and not is_arc[at:until].any()
        begin = until if between_pauses and not _closed(end_um[until - 1], end_um[at]) else at + 1
        rows.extend(range(at, begin))
    return np.array(rows, dtype=np.int64)


def _closed(end_um: Floats, start_um: Floats) -> bool:
    return float(np.hypot(*(end_um - start_um))) <= CLOSED_WITHIN_UM


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
