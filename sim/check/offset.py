"""Findings on the offset that a controller adds: what it leaves uncut, gouges, contours that it closes or divides."""

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from controller.offset.gouges import TOLERANCE_UM, Gouge
from controller.offset.path import OffsetPath
from controller.offset.sections import OffsetSection
from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.program import Program
from parser.units import mm
from sim.setup.part import Offset


def uncut_findings(program: Program, offset: Offset, gone: Ints, left_um: Floats) -> Iterator[Finding]:
    """Findings at the rows `gone` (v,) of a program as read, along which the offset leaves `left_um` (v,) of material.

    3B501 at an inner arc no larger than the offset, 3B502 where some material stays along another block.
    """
    drawn = program.toolpath
    middle_mm = mm(places(drawn, gone, np.full(len(gone), 0.5)))
    for row, left, (x_mm, y_mm) in zip(gone.tolist(), left_um.tolist(), middle_mm.tolist(), strict=True):
        values = {"offset": offset.by_um, "left": left, "x_mm": x_mm, "y_mm": y_mm}
        radius_um = float(drawn.radius_um[row])
        if drawn.is_arc[row] and radius_um <= offset.by_um and drawn.sweep_rad[row] * offset.side > 0.0:
            yield at_block(drawn, program.lines, "3B501", row, radius=radius_um, **values)
        elif left > TOLERANCE_UM:
            yield at_block(drawn, program.lines, "3B502", row, **values)


def gouge_findings(program: Program, offset: Offset, path: OffsetPath, gouges: Iterable[Gouge]) -> Iterator[Finding]:
    """Finding 3B503 for each place where the wire cuts into the contour of the program as read."""
    drawn = program.toolpath
    for gouge in gouges:
        values = {
            "other": int(drawn.source.block[gouge.row]),
            "depth": gouge.depth_um,
            "offset": offset.by_um,
            "x_mm": mm(gouge.place_um.x),
            "y_mm": mm(gouge.place_um.y),
        }
        yield at_block(drawn, program.lines, "3B503", int(path.source_row[gouge.path_row]), **values)


def loop_findings(program: Program, offset: Offset, loops: Mapping[OffsetSection, int]) -> Iterator[Finding]:
    """Finding 3B504 at each closed section that does not allow one closed path without a gouge, but none or several."""
    for section, count in loops.items():
        if count != 1:
            yield at_block(program.toolpath, program.lines, "3B504", section.first, loops=count, offset=offset.by_um)
