"""A program against a drawing: its edge, and whether the offset is to the wrong side or missing."""

from collections.abc import Sequence
from dataclasses import replace

from parser.drawing.model import Drawing
from parser.findings.errors import SettingsError
from parser.findings.remarks import Remark
from parser.geometry.curves import Ints
from parser.toolpath import Toolpath
from parser.units import mm
from sim.cut.regions import RegionError
from sim.measure.compare.compare import compare
from sim.measure.compare.contour_names import contour_names, failing_contours, most_left_um, offset_faults
from sim.measure.compare.program_edge import ProgramEdges, edge_at, program_edges, with_gouges
from sim.measure.compare.result import Asked, Comparison


def compare_program(toolpath: Toolpath, offset_um: float, drawing: Drawing, asked: Asked) -> Comparison:
    """The edge of a program whose wire cuts `offset_um` past its path, against a drawing.

    SettingsError where no contour closes, where there are more than are compared (`rings_of`), where the offset leaves
    no edge, or where it could not be worked out.
    """
    of = program_edges(toolpath, offset_um)
    if not of.rings.rings:
        raise SettingsError("no contour of the program closes a loop, so that there is no edge to compare")
    try:
        tried = [(edge_at(of, sides, offset_um), sides) for sides in of.sides]
    except RegionError as error:
        raise SettingsError(f"{error}, so that there is no edge to compare") from None
    tried = [(with_gouges(of, edge), sides) for edge, sides in tried if len(edge.curves)]
    if not tried:
        raise SettingsError(f"an offset of {mm(offset_um):g} mm leaves no edge of the program's contours")
    results = [(compare(edge, drawing, asked), sides) for edge, sides in tried]
    best, sides = min(results, key=lambda result: result[0].edge_to_drawing.rms_um)
    if len(of.sides) > 1:
        best = replace(best, notes=(*best.notes, Remark("side-tried")))
    if best.passes or best.scale != 1.0:
        return best
    return replace(best, names=(*best.names, *_faults(best, of, sides)))


def _faults(found: Comparison, of: ProgramEdges, sides: Ints) -> Sequence[Remark]:
    """What is wrong with the contours that fail, or with the offset of the whole, which is wrong where all have it."""
    failing = failing_contours(found, of)
    if len(of.rings.rings) == 1:
        return _offset_names(found, of, sides)
    named = contour_names(found, of, sides, failing)
    told = [remark for remark in named if remark is not None]
    alike = {remark.name for remark in told} in ({"contour-wrong-side"}, {"contour-offset-missing"})
    if len(failing) == len(of.rings.rings) and (alike or len(told) < len(failing)):
        return _offset_names(found, of, sides) or told
    return told


def _offset_names(found: Comparison, of: ProgramEdges, sides: Ints) -> list[Remark]:
    """Whether another edge of the same path fits the drawing far better: on its other side, or the path itself.

    Either way the part loses what the names tell, all along its edge.
    """
    if of.offset_um <= found.asked.tolerance_um:
        return []
    for name, other_um, inside_um in offset_faults(of.offset_um):
        edge = edge_at(of, sides, other_um)
        if len(edge.curves) and _far_better(compare(edge, found.drawing, found.asked), found):
            return [Remark(name, {"inside_mm": mm(inside_um)})]
    return []


def _far_better(other: Comparison, found: Comparison) -> bool:
    """Whether the other edge lies on the drawing; what of that nobody cut tells nothing."""
    most = most_left_um(float(found.edge_to_drawing.max_um.max()), found.asked.tolerance_um)
    return float(other.edge_to_drawing.max_um.max()) <= most
