"""Records to toolpath: exact geometry of every block at once, chained from end to start.

"Exact" is what the CAM prints: no steps, the radius unrounded, the count length J deciding where a block ends.
"""

from dataclasses import replace

import numpy as np

from parser.controller_words.step_words import StepWords
from parser.geometry.curves import CurveKind, Floats, Ints
from parser.step_words.moves import moves, with_axes_named
from parser.step_words.rules import words_of_lines
from parser.text.source import Source
from parser.threeb.figures import Nodes, air_lines, with_node_rows
from parser.threeb.reader import Records
from parser.threeb.tokens import fields_of
from parser.toolpath import Stop, Toolpath


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
