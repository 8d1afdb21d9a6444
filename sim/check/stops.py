"""Stops before a part comes free: the tab that is left until then."""

from collections.abc import Iterator

import numpy as np

from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.curves import Ints, total_before
from parser.program import Program
from parser.shape.loops import find_loops
from parser.shape.passes import Pass, Passes

_WIDEST_TAB = 0.25  # of the length of a loop: what is longer is no tab


def tab_stop_findings(program: Program, contour: Ints, passes: Passes) -> Iterator[Finding]:
    """Finding ISO309 at the first block behind a stop that leaves a tab; `contour` (n,) is each row's.

    The tab is the last part of a loop, or what a pass of its own cuts behind the passes along the edge.
    """
    after = np.array([stop.after for stop in program.toolpath.stops if stop.kind == "pause"], dtype=np.int64)
    if not program.reading.spelling.rapid or not len(after):
        return
    run_um = total_before(program.toolpath.length_um)
    tabs = {**_in_loops(program, contour, after), **_before_passes(passes, after)}
    for row, past in sorted(tabs.items()):
        if contour[row] >= 0:
            left = float(run_um[past] - run_um[row])
            yield at_block(program.toolpath, program.lines, "ISO309", row, left=left)


def _in_loops(program: Program, contour: Ints, after: Ints) -> dict[int, int]:
    """First rows behind stops within the last part of a loop, and one past its last row."""
    run_um = total_before(program.toolpath.length_um)
    after = after[(after > 0) & (after < len(contour))]
    after = after[(contour[after] >= 0) & (contour[after - 1] == contour[after])]
    loops = find_loops(program.toolpath, contour, np.array(sorted(set(contour[after].tolist())), dtype=np.int64))
    found = {}
    for number, first, last, _ in zip(*(column.tolist() for column in loops), strict=True):
        for row in after[contour[after] == number].tolist():
            left_um, whole_um = float(run_um[last + 1] - run_um[row]), float(run_um[last + 1] - run_um[first])
            if first < row <= last and left_um <= _WIDEST_TAB * whole_um:
                found[row] = last + 1
    return found


def _before_passes(passes: Passes, after: Ints) -> dict[int, int]:
    """First rows of passes over a tab with a stop between them and the pass before, and one past their last rows."""
    before: dict[int, Pass] = {}
    found = {}
    for one in passes.passes:
        last = before.get(one.edge, one)
        if one.is_tab and not last.is_tab and ((after > last.last) & (after <= one.first)).any():
            found[one.first] = one.last + 1
        before[one.edge] = one
    return found
