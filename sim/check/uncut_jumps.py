"""Ways cut from one closed figure to another, where a pause and a jump were meant."""

import numpy as np

from parser.dialect.at_block import at_block
from parser.findings.facts import WrongBlock
from parser.findings.findings import Finding
from parser.geometry.curves import Bools, Ints
from parser.geometry.distance import distance_to_curves
from parser.program import Program
from parser.shape.passes import Passes
from parser.shape.returns import loops_in_order
from parser.toolpath import Toolpath

_APART_UM = 1000.0
"""Passes of one cut lie within the kerf of each other; figures this far apart are two."""


def uncut_jump_findings(program: Program, contour: Ints, passes: Passes) -> list[Finding]:
    """Finding 3B310 at the first line cut on the way from a closed figure to the next one.

    `contour` (n,) is each row's contour, −1 where it has none. By its hole the wire goes to the next pass over an edge.
    """
    toolpath = program.toolpath
    is_arc = toolpath.is_arc
    first, last = loops_in_order(toolpath, contour)
    encloses = _enclose(toolpath, first, last)
    first, last = first[encloses], last[encloses]
    found = []
    for here, there in zip(range(len(first) - 1), range(1, len(first)), strict=True):
        begin, arrival = int(last[here]) + 1, int(first[there])
        if contour[begin - 1] != contour[arrival] or arrival <= begin or is_arc[begin:arrival].any():
            continue
        around = passes.around(begin)
        if around and around[0].edge == around[1].edge:
            continue
        if _distance(toolpath, arrival, np.arange(first[here], begin)) > _APART_UM:
            way = float(toolpath.length_um[begin:arrival].sum())
            jump = program.reading.spelling.jump
            told = at_block(toolpath, program.lines, "3B310", begin, length=way, jump=jump)
            found.append(told.with_fact(WrongBlock()))
    return found


def _enclose(toolpath: Toolpath, first: Ints, last: Ints) -> Bools:
    """Which of k figures enclose anything: two lines there and back, such as the set-up of an offset, do not."""
    arcs = np.concatenate([[0], np.cumsum(toolpath.is_arc)])
    encloses: Bools = (last - first >= 2) | (arcs[last + 1] > arcs[first])
    return encloses


def _distance(toolpath: Toolpath, row: int, figure: Ints) -> float:
    """Distance µm of a row's start from the blocks of a figure."""
    x, y = toolpath.start_um[row]
    off, _ = distance_to_curves(toolpath, figure, np.full(len(figure), x), np.full(len(figure), y))
    return float(off.min())
