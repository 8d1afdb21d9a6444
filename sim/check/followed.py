"""Passes of a program that compensates: each is to follow the contour of the others, as it is programmed.

How far the wire then runs from the part, the compensated path tells (sim/check/passes.py).
"""

from collections.abc import Iterator

import numpy as np

from parser.dialect.reader import at_block
from parser.findings.findings import Finding
from parser.geometry.curves import Ints
from parser.program import Program
from parser.shape.passes import Passes, row_shifts_um

_STRAY_UM = 20.0
"""Contours of two passes in whole µm, each from its own start, drift apart by less."""


def followed_findings(program: Program, contour: Ints, passes: Passes) -> Iterator[Finding]:
    """Finding ISO306 at the block of an earlier pass that lies farthest from the contour of the last over its edge.

    `contour` (n,) is each row's, −1 where it is not judged.
    """
    if program.toolpath.compensation is None or len(passes.passes) < 2:
        return
    off_um = np.abs(row_shifts_um(program.toolpath, passes))
    for pass_ in passes.passes:
        of_pass = off_um[pass_.first : pass_.last + 1]
        if contour[pass_.first] < 0 or np.isnan(of_pass).all():
            continue
        row = pass_.first + int(np.nanargmax(of_pass))
        if off_um[row] > _STRAY_UM:
            yield at_block(program.toolpath, program.lines, "ISO306", row, number=pass_.number, by=float(off_um[row]))
