"""A program against a drawing: its edge, and whether the offset is to the wrong side or missing."""

from dataclasses import replace

from parser.drawing.model import Drawing
from parser.findings.errors import SettingsError
from parser.findings.remarks import Remark
from parser.geometry.curves import Ints
from parser.toolpath import Toolpath
from parser.units import mm
from sim.measure.compare.compare import compare
from sim.measure.compare.program_edge import ProgramEdges, edge_at, program_edges, with_gouges
from sim.measure.compare.result import Comparison

_FAR_BETTER = 0.25  # of the deviations: what another edge of the same path must come to, to be named


def compare_program(
    toolpath: Toolpath, offset_um: float, drawing: Drawing, tolerance_um: float, *, fitted: bool = True
) -> Comparison:
    """The edge of a program whose wire cuts `offset_um` past its path, against a drawing.

    SettingsError where no contour closes, or where the offset leaves no edge.
    """
    of = program_edges(toolpath, offset_um)
    if not of.rings.rings:
        raise SettingsError("no contour of the program closes a loop, so that there is no edge to compare")
    tried = [(edge_at(of, sides, offset_um), sides) for sides in of.sides]
    tried = [(with_gouges(of, edge), sides) for edge, sides in tried if len(edge.curves)]
    if not tried:
        raise SettingsError(f"an offset of {mm(offset_um):g} mm leaves no edge of the program's contours")
    results = [(compare(edge, drawing, tolerance_um, fitted=fitted), sides) for edge, sides in tried]
    best, sides = min(results, key=lambda result: result[0].edge_to_drawing.rms_um)
    if len(of.sides) > 1:
        best = replace(best, notes=(*best.notes, Remark("side-tried")))
    return best if best.passes else replace(best, names=(*best.names, *_offset_names(best, of, sides)))


def _offset_names(found: Comparison, of: ProgramEdges, sides: Ints) -> list[Remark]:
    """Whether another edge of the same path fits the drawing far better: on its other side, or the path itself.

    Either way the part loses what the names tell, all along its edge.
    """
    if found.scale != 1.0 or of.offset_um <= found.tolerance_um:
        return []
    lost = (
        (-of.offset_um, "wrong-side", 2.0),
        (0.0, "offset-missing", 1.0),
    )
    for other_um, name, times in lost:
        edge = edge_at(of, sides, other_um)
        if len(edge.curves) and _far_better(
            compare(edge, found.drawing, found.tolerance_um, fitted=found.fitted), found
        ):
            return [Remark(name, {"inside_mm": mm(times * of.offset_um)})]
    return []


def _far_better(other: Comparison, found: Comparison) -> bool:
    """Whether the other edge lies on the drawing; what of that nobody cut tells nothing."""
    most = max(found.tolerance_um, _FAR_BETTER * float(found.edge_to_drawing.max_um.max()))
    return float(other.edge_to_drawing.max_um.max()) <= most
