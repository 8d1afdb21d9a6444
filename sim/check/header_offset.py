"""The offset that the header gives, held against the wire, and against what the controller adds besides."""

from itertools import product

import numpy as np

from parser.findings.findings import Finding, Value
from parser.geometry.curves import Bools, Ints, total_before
from parser.program import Program
from parser.shape.contours import runs
from parser.shape.loops import find_loops
from sim.check.travel import extents

TOLERANCE_UM = 5.0
"""Within this the gap of a wire is not known (docs/3b.md §5: 0.005 to 0.025 mm)."""
_PASS_UM = 500.0  # passes over one edge lie nearer to each other
_OVERCUT_UM = 5000.0  # longest way behind a loop, besides a lead-out as long as the lead-in


def header_offset_findings(
    program: Program, contour: Ints, reach_um: float | None, added_um: float | None
) -> list[Finding]:
    """No offset in the path at all (3B111), another than the wire needs (3B112), one that is added twice (3B113).

    `contour` (n,) is each row's contour, −1 where it has none. `reach_um` is how far from the wire's centre it cuts,
    `added_um` what the controller adds; None where that is not known. Programs of several passes have one offset in
    their header and several in their paths: they are not judged.
    """
    told, span = program.header.get("offset_um"), program.reading.offset_span
    if not isinstance(told, float) or span is None or _is_four_b(program).any():
        return []
    values: dict[str, Value] = {"header": abs(told)}
    if added_um is not None:
        values["added"] = added_um
        return [program.lines.finding("3B113", span, 0, **values)] if told != 0.0 else []
    if reach_um is None or not _one_pass(program, contour):
        return []
    values["reach"] = reach_um
    if told == 0.0:
        return [program.lines.finding("3B111", span, 0, **values)]
    differs = abs(abs(told) - reach_um) > TOLERANCE_UM
    return [program.lines.finding("3B112", span, 0, **values)] if differs else []


def _is_four_b(program: Program) -> Bools:
    words = program.toolpath.words
    return np.zeros(1, dtype=np.bool_) if words is None else words.radius_um >= 0


def _one_pass(program: Program, contour: Ints) -> bool:
    """Whether each contour is one closed loop with its leads, and no two loops lie on one another."""
    toolpath = program.toolpath
    numbers = np.unique(contour[contour >= 0])
    if not len(numbers):
        return False
    loops = find_loops(toolpath, contour, numbers)
    if len(loops.contour) < len(numbers):
        return False
    before_um = total_before(toolpath.length_um)
    cut = runs(toolpath)[loops.contour]
    lead_in_um = before_um[loops.first] - before_um[cut[:, 0]]
    behind_um = before_um[cut[:, 1]] - before_um[loops.last + 1]
    if (behind_um > lead_in_um + _OVERCUT_UM).any():
        return False
    low, high = extents(toolpath)
    rows = [slice(first, last + 1) for first, last in zip(loops.first.tolist(), loops.last.tolist(), strict=True)]
    boxes = np.array([[*low[of].min(axis=0), *high[of].max(axis=0)] for of in rows])
    cells = (np.floor(boxes / (2.0 * _PASS_UM) + np.array(half) / 2.0) for half in product((0, 1), repeat=4))
    return all(len(np.unique(cell, axis=0)) == len(boxes) for cell in cells)
