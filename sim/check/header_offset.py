"""The offset that the header gives, held against the wire, and against what the controller adds besides."""

import numpy as np

from parser.findings.findings import Finding, Value
from parser.geometry.curves import Bools
from parser.program import Program
from parser.shape.passes import Passes

TOLERANCE_UM = 5.0
"""Within this the gap of a wire is not known (docs/3b.md §5: 0.005 to 0.025 mm)."""


def header_offset_findings(
    program: Program, passes: Passes, reach_um: float | None, added_um: float | None
) -> list[Finding]:
    """No offset in the path at all (3B111), another than the wire needs (3B112), one that is added twice (3B506).

    `reach_um` is how far from the wire's centre it cuts, `added_um` what the controller adds; None where that is not
    known. Programs of several passes have one offset in
    their header and several in their paths: they are not judged.
    """
    offset_um, span = program.header.get("offset_um"), program.reading.offset_span
    if not isinstance(offset_um, float) or span is None or _is_four_b(program).any():
        return []
    values: dict[str, Value] = {"header": abs(offset_um)}
    if added_um is not None:
        values["added"] = added_um
        return [program.lines.finding("3B506", span, 0, **values)] if offset_um != 0.0 else []
    if reach_um is None or not _one_pass(passes):
        return []
    values["reach"] = reach_um
    if offset_um == 0.0:
        return [program.lines.finding("3B111", span, 0, **values)]
    differs = abs(abs(offset_um) - reach_um) > TOLERANCE_UM
    return [program.lines.finding("3B112", span, 0, **values)] if differs else []


def _is_four_b(program: Program) -> Bools:
    words = program.toolpath.words
    return np.zeros(1, dtype=np.bool_) if words is None else words.radius_um >= 0


def _one_pass(passes: Passes) -> bool:
    """Whether there are closed contours alone, and each is cut once."""
    return bool(passes.passes) and all(pass_.is_closed and pass_.number == 1 for pass_ in passes.passes)
