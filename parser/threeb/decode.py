"""Records to toolpath: exact geometry of every block at once, chained from end to start.

"Exact" is what the CAM prints: no steps, the radius unrounded, the count length J deciding where a block ends.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints, Kind
from parser.threeb.arcs import arc_ends
from parser.threeb.figures import Nodes, air_lines, with_node_rows
from parser.threeb.reader import Records
from parser.threeb.words import words_of_lines
from parser.toolpath import Axis, Source, Stop, Toolpath, Words

# (X, Y) of a line that leaves both out and so runs along the axis its digit names (`BBB40000GXL1`).
_AXIS_OF_LABEL = np.array([[0, 0], [1, 0], [0, 1], [1, 0], [0, 1]], dtype=np.int64)


class Moves(NamedTuple):
    """What each block does relative to its own start; (n,) or (n, 2) float64, µm and rad, NaN where a line has none."""

    by_um: Floats
    center_um: Floats
    radius_um: Floats
    start_angle_rad: Floats
    sweep_rad: Floats
    length_um: Floats


def decode(records: Records) -> Toolpath:
    """Exact toolpath of the records.

    A block that no machine can finish (`endless`) keeps its row with length 0, so that the next block starts where it
    stood.
    """
    blocks, marks, nodes = with_node_rows(records.blocks, records.marks)
    words = with_axes_named(Words(**{name: getattr(blocks, name) for name in Words.__slots__}))
    is_arc = (words.turn != 0) & ~endless(words)
    made = moves(words)
    start, end = _chain(made.by_um, nodes)
    toolpath = Toolpath(
        kind=np.where(is_arc, Kind.ARC, Kind.LINE).astype(np.int64),
        start_um=start,
        end_um=end,
        center_um=start + made.center_um,
        radius_um=made.radius_um,
        start_angle_rad=made.start_angle_rad,
        sweep_rad=made.sweep_rad,
        length_um=made.length_um,
        printed_end_um=blocks.printed_um,
        words=words,
        source=Source(records.text, np.arange(1, len(start) + 1), blocks.span, blocks.line, blocks.label),
        stops=tuple(Stop("end" if m.kind == "end" else "pause", m.after, m.line) for m in marks if m.kind != "node"),
    )
    jumps = air_lines(toolpath, [m.after for m in marks if m.kind == "pause"])
    return _with_node_words(_with_jumps(toolpath, np.concatenate([jumps, nodes.row])), nodes)


def endless(words: Words) -> NDArray[np.bool_]:
    """(n,) True on blocks that a controller would never count out.

    An arc needs a radius of more than 1 µm (at 1 µm the step-by-step rule swings between two points), a line a
    component on its counted axis.
    """
    counted = np.where(words.count_axis == Axis.X, words.x_um, words.y_um)
    no_radius = words.x_um**2 + words.y_um**2 <= 1
    return np.where(words.turn != 0, no_radius, (counted == 0) & (words.count_um > 0))


def with_axes_named(words: Words) -> Words:
    """Words as the controller reads them: a line without X and Y gets the axis its digit names."""
    bare = (words.turn == 0) & (words.x_um == 0) & (words.y_um == 0)
    named = _AXIS_OF_LABEL[words.quadrant]
    return replace(words, x_um=np.where(bare, named[:, 0], words.x_um), y_um=np.where(bare, named[:, 1], words.y_um))


def moves(words: Words) -> Moves:
    """What each block does relative to its own start."""
    is_arc = (words.turn != 0) & ~endless(words)
    n = len(is_arc)
    signs = words.signs
    by = np.where(endless(words)[:, None], 0.0, _line_by(words) * signs)
    center = np.full((n, 2), np.nan)
    radius, angle, sweep = np.full(n, np.nan), np.full(n, np.nan), np.zeros(n)
    start = (np.stack([words.x_um, words.y_um], axis=1) * signs)[is_arc]
    arcs = arc_ends(start, words.count_um[is_arc], words.count_axis[is_arc], words.turn[is_arc])
    by[is_arc] = arcs.end_um - arcs.start_um
    center[is_arc] = -arcs.start_um
    radius[is_arc], angle[is_arc], sweep[is_arc] = arcs.radius_um, arcs.start_angle_rad, arcs.sweep_rad
    length = np.hypot(by[:, 0], by[:, 1])
    length[is_arc] = arcs.radius_um * np.abs(arcs.sweep_rad)
    return Moves(by, center, radius, angle, sweep, length)


def _line_by(words: Words) -> Floats:
    """(n, 2) absolute displacement of every row read as a line: J along the counted axis, the ratio X:Y across it."""
    on_x = words.count_axis == Axis.X
    counted = np.where(on_x, words.x_um, words.y_um)
    other = np.where(on_x, words.y_um, words.x_um)
    finite = counted > 0
    along = np.where(finite, words.count_um, 0).astype(np.float64)
    across = words.count_um * other / np.where(finite, counted, 1) * finite
    return np.stack([np.where(on_x, along, across), np.where(on_x, across, along)], axis=1)


def _chain(by_um: Floats, nodes: Nodes) -> tuple[Floats, Floats]:
    """Starts and ends of blocks that each begin where the last one ended, or where a start node puts them."""
    end = np.cumsum(by_um, axis=0)
    shifts = np.concatenate([nodes.origin_um[None, :], nodes.target_um - end[nodes.row]])
    end = end + shifts[np.searchsorted(nodes.row, np.arange(len(by_um)), side="right")]
    return np.concatenate([nodes.origin_um[None, :], end[:-1]]), end


def _with_jumps(toolpath: Toolpath, rows: Ints) -> Toolpath:
    kind = toolpath.kind.copy()
    kind[rows] = Kind.JUMP
    return replace(toolpath, kind=kind)


def _with_node_words(toolpath: Toolpath, nodes: Nodes) -> Toolpath:
    """Toolpath whose start nodes carry the words and the length of the move to them."""
    if not len(nodes.row):
        return toolpath
    by = toolpath.end_um[nodes.row] - toolpath.start_um[nodes.row]
    length, columns = toolpath.length_um.copy(), {n: getattr(toolpath.words, n).copy() for n in Words.__slots__}
    length[nodes.row] = np.hypot(by[:, 0], by[:, 1])
    words = words_of_lines(by)
    for name, column in columns.items():
        column[nodes.row] = getattr(words, name)
    return replace(toolpath, words=Words(**columns), length_um=length)
