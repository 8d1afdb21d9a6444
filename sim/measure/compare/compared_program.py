"""A program against a drawing: its edge, and whether the offset is to the wrong side or missing.

What is wrong with one contour of several: cut on the wrong side of its path, without offset, or off its place.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.drawing.model import Drawing
from parser.findings.catalogue import Remark
from parser.findings.errors import SettingsError
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.toolpath import Toolpath
from parser.units import mm
from sim.cut.regions import RegionError
from sim.measure.compare.compare import compare
from sim.measure.compare.consensus import shifted_onto
from sim.measure.compare.directed import directed
from sim.measure.compare.nearest import Index, indexed
from sim.measure.compare.program_edge import ProgramEdges, edge_at, program_edges, with_gouges
from sim.measure.compare.result import Comparison, FitRequest
from sim.measure.compare.rings import PathEdge
from sim.measure.compare.starts import centroid, placed, spread

_FAR_BETTER = 0.25  # of the deviations: what another edge of the same path must come to, to be named
_MOST = 50  # contours that are looked at; more that fail have a fault in common
_ALIKE = 0.02  # lengths of loops that may be one and the same
_PLACES = 400


class FailingContour(NamedTuple):
    """Number of a program's contour, and how far its edge lies off the drawing at most."""

    at: int
    off_um: float


def failing_contours(found: Comparison, of: ProgramEdges) -> list[FailingContour]:
    """The contours that lie past the tolerance, in their order."""
    failing = (FailingContour(at, _off(found, ring)) for at, ring in enumerate(of.rings.rings))
    return [contour for contour in failing if contour.off_um > found.request.tolerance_um]


def contour_names(
    found: Comparison, of: ProgramEdges, sides: Ints, failing: Sequence[FailingContour]
) -> list[Remark | None]:
    """A remark on each of the first contours that fail, None where no one fault explains it."""
    drawn = indexed(placed(found.drawing.curves, found.placement))
    return [_named(found, of.alone(at), sides[[at]], off_um, drawn) for at, off_um in failing[:_MOST]]


def offset_faults(offset_um: float) -> Iterator[tuple[str, float, float]]:
    """Names of faults of an offset, at which offset the edge would fit then, and how far it lies inside the part."""
    yield "wrong-side", -offset_um, 2.0 * offset_um
    yield "offset-missing", 0.0, offset_um


def most_left_um(off_um: float, tolerance_um: float) -> float:
    """What may be left of deviations of `off_um` by a fault that explains them."""
    return max(tolerance_um, _FAR_BETTER * off_um)


def _off(found: Comparison, ring: PathEdge) -> float:
    """How far the edge of a contour lies off the drawing at most."""
    return float(found.edge_to_drawing.max_um[np.isin(found.edge.block, ring.block)].max(initial=0.0))


def _named(found: Comparison, of: ProgramEdges, sides: Ints, off_um: float, drawn: Index) -> Remark | None:
    """The fault of a program's one contour `of`, whose edge is off by `off_um`."""
    span = dict(zip(("first", "last"), of.rings.rings[0].last_blocks, strict=True))
    most = most_left_um(off_um, found.request.tolerance_um)
    if of.offset_um > found.request.tolerance_um:
        for name, other_um, inside_um in offset_faults(of.offset_um):
            edge = edge_at(of, sides, other_um).curves
            if len(edge) and float(directed(edge, drawn).max_um.max()) <= most:
                return Remark(f"contour-{name}", {**span, "inside_mm": mm(inside_um)})
    shift = _shift(found, edge_at(of, sides, of.offset_um).curves, most)
    if shift is None or float(np.hypot(*shift)) <= found.request.tolerance_um:
        return None
    return Remark("contour-shifted", {**span, "shift_x_mm": mm(float(shift[0])), "shift_y_mm": mm(float(shift[1]))})


def _shift(found: Comparison, edge: Curves, most_um: float) -> Floats | None:
    """How far (2,) an edge lies off a loop of the drawing that it is of; None where no shift explains it."""
    if not len(edge):
        return None
    index = indexed(found.laid)
    tried = [shifted_onto(edge, index, start) for start in (np.zeros(2), *_starts(found, edge))]
    # Of loops that are alike the nearest one is meant.
    shifts = [-fitted.motion.shift_um for fitted in tried if fitted.max_um <= most_um]
    return min(shifts, key=lambda shift: float(np.hypot(*shift)), default=None)


def _starts(found: Comparison, edge: Curves) -> Iterator[Floats]:
    """Shifts (2,) of an edge on to loops of the drawing that are as long, and that nothing was cut along."""
    length, middle = float(edge.length_um.sum()), centroid(spread(edge, _PLACES))
    back, loop = found.drawing_to_edge.max_um, found.target.loop
    for number in range(int(loop.max(initial=-1)) + 1):
        rows: Bools = loop == number
        alike = abs(float(found.laid.length_um[rows].sum()) - length) <= _ALIKE * length
        if alike and float(back[rows].max()) > found.request.tolerance_um:
            yield centroid(spread(found.laid.picked(rows), _PLACES)) - middle


def compare_program(toolpath: Toolpath, offset_um: float, drawing: Drawing, request: FitRequest) -> Comparison:
    """The edge of a program whose wire cuts `offset_um` past its path, against a drawing.

    SettingsError where no contour closes, where there are more than are compared (`rings_of`), where the offset leaves
    no edge, or where it could not be worked out.
    """
    of = program_edges(toolpath, offset_um)
    if not of.rings.rings:
        raise SettingsError("no-closed-contour")
    try:
        tried = [(edge_at(of, sides, offset_um), sides) for sides in of.sides]
    except RegionError as error:
        raise SettingsError("no-edge-worked-out", first=error.first, last=error.last) from None
    tried = [(with_gouges(of, edge), sides) for edge, sides in tried if len(edge.curves)]
    if not tried:
        raise SettingsError("offset-leaves-no-edge", offset_mm=mm(offset_um))
    results = [(compare(edge, drawing, request), sides) for edge, sides in tried]
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
    faults = [remark for remark in named if remark is not None]
    alike = {remark.name for remark in faults} in ({"contour-wrong-side"}, {"contour-offset-missing"})
    if len(failing) == len(of.rings.rings) and (alike or len(faults) < len(failing)):
        return _offset_names(found, of, sides) or faults
    return faults


def _offset_names(found: Comparison, of: ProgramEdges, sides: Ints) -> list[Remark]:
    """Whether another edge of the same path fits the drawing far better: on its other side, or the path itself.

    Either way the part loses what the names tell, all along its edge.
    """
    if of.offset_um <= found.request.tolerance_um:
        return []
    for name, other_um, inside_um in offset_faults(of.offset_um):
        edge = edge_at(of, sides, other_um)
        if len(edge.curves) and _far_better(compare(edge, found.drawing, found.request), found):
            return [Remark(name, {"inside_mm": mm(inside_um)})]
    return []


def _far_better(other: Comparison, found: Comparison) -> bool:
    """Whether the other edge lies on the drawing; what of that nobody cut tells nothing."""
    most = most_left_um(float(found.edge_to_drawing.max_um.max()), found.request.tolerance_um)
    return float(other.edge_to_drawing.max_um.max()) <= most
