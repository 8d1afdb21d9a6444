"""Stops within a contour: the tab that is left when the machine stops before a part comes free."""

from collections.abc import Iterator

import numpy as np

from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.curves import Ints, total_before
from parser.program import Program
from parser.shape.loops import find_loops

_WIDEST_TAB = 0.25  # of the length of a loop: what is longer is no tab


def tab_stop_findings(program: Program, contour: Ints) -> Iterator[Finding]:
    """Finding ISO309 at the first block behind a stop within the last part of a loop; `contour` (n,) is each row's."""
    toolpath = program.toolpath
    after = np.array([stop.after for stop in toolpath.stops if stop.kind == "pause"], dtype=np.int64)
    after = after[(after > 0) & (after < len(toolpath))]
    after = after[(contour[after] >= 0) & (contour[after - 1] == contour[after])]
    if not program.reading.spelling.rapid or not len(after):
        return
    loops = find_loops(toolpath, contour, np.array(sorted(set(contour[after].tolist()))))
    run_um = total_before(toolpath.length_um)
    for number, first, last, _ in zip(*(column.tolist() for column in loops), strict=True):
        for row in after[contour[after] == number].tolist():
            left_um, whole_um = float(run_um[last + 1] - run_um[row]), float(run_um[last + 1] - run_um[first])
            if first < row <= last and left_um <= _WIDEST_TAB * whole_um:
                yield at_block(toolpath, program.lines, "ISO309", row, left=left_um)
