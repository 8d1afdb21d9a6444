"""Findings about the offset that a controller adds: what vanishes, what is cut into, what no longer is one path."""

from collections.abc import Iterator, Sequence

import numpy as np

from controller.offset.gouges import TOLERANCE_UM, Gouge
from controller.offset.path import OffsetPath
from controller.offset.sections import Section
from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.along import places
from parser.geometry.curves import Floats
from parser.program import Program
from parser.units import mm
from sim.setup.part import Offset


def vanished_findings(program: Program, offset: Offset, path: OffsetPath, left_um: Floats) -> Iterator[Finding]:
    """Blocks that the offset path has no room for: arcs too tight (3B501), and others where material stays (3B502).

    `left_um` (v,) is the material that stays at each row that vanished.
    """
    drawn, lines, gone = program.toolpath, program.lines, path.vanished
    middle_mm = mm(places(drawn, gone, np.full(len(gone), 0.5)))
    for row, left, (x_mm, y_mm) in zip(gone.tolist(), left_um.tolist(), middle_mm.tolist(), strict=True):
        values = {"offset": offset.by_um, "left": left, "x_mm": x_mm, "y_mm": y_mm}
        radius_um = float(drawn.radius_um[row])
        if drawn.is_arc[row] and radius_um <= offset.by_um and drawn.sweep_rad[row] * offset.side > 0.0:
            yield at_block(drawn, lines, "3B501", row, radius=radius_um, **values)
        elif left > TOLERANCE_UM:
            yield at_block(drawn, lines, "3B502", row, **values)


def gouge_findings(program: Program, offset: Offset, path: OffsetPath, gouges: Sequence[Gouge]) -> Iterator[Finding]:
    """Blocks of whose offset path the wire cuts into the contour (3B503)."""
    drawn = program.toolpath
    for gouge in gouges:
        yield at_block(
            drawn,
            program.lines,
            "3B503",
            int(path.source_row[gouge.path_row]),
            other=int(drawn.source.block[gouge.row]),
            depth=gouge.depth_um,
            offset=offset.by_um,
            x_mm=mm(gouge.place_um.x),
            y_mm=mm(gouge.place_um.y),
        )


def loop_findings(
    program: Program, offset: Offset, closed: Sequence[Section], loops: Sequence[int]
) -> Iterator[Finding]:
    """Closed sections of the contour that allow no path without a gouge, or more than one (3B504)."""
    for section, paths in zip(closed, loops, strict=True):
        if paths != 1:
            values = {"loops": paths, "offset": offset.by_um}
            yield at_block(program.toolpath, program.lines, "3B504", section.first, **values)
